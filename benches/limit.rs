//! Limit loads of rigid walls: wall 3 of Ferris and Tin-Loi by both laws, and a wall of a thousand bricks with six windows
//! with associated flow.
//!
//! `cargo bench --bench limit` prints a table; with `-- --write` it also goes into
//! `docs/reference/limit.md`. Bound to one core (`taskset -c 0`) all is on one thread.

mod common;

use std::fmt::Write;
use std::time::Instant;

use masonry::analysis::limit::{Laws, limit_by};
use masonry::scene::{Brick, Joint, Load, Material, Opening, Scene, Support, Wall};
use masonry::units::Units;

fn main() {
    if !common::is_bench() {
        return;
    }
    let path = common::root().join("scenes/ferris_wall_3.toml");
    let ferris = Scene::read(&path).expect("a scene of the repository");
    let mut table =
        String::from("| wall | bricks | contact points | bound | gap | path | time \\[s\\] |\n");
    table += "|:--|--:|--:|--:|--:|--:|--:|\n";
    let walls = [
        ("Ferris and Tin-Loi, wall 3", ferris, Laws::Both),
        ("six windows", windows(), Laws::Associative),
    ];
    for (name, scene, laws) in walls {
        let began = Instant::now();
        let found = limit_by(&scene, laws).expect("a scene with one load");
        let seconds = began.elapsed().as_secs_f64();
        let known = found.associative.and_then(|it| it.bound.zip(it.load_factor));
        let (bound, factor) = known.unwrap_or((f64::NAN, f64::NAN));
        let gap = bound - factor;
        let path = found.path.and_then(|path| path.load_factor);
        let path = path.map_or("-".to_owned(), |factor| format!("{factor:.4}"));
        let _ = writeln!(
            table,
            "| {name} | {} | {} | {bound:.6} | {gap:.0e} | {path} | {seconds:.3} |",
            found.model.blocks.len(),
            found.model.contacts.len(),
        );
    }
    println!("{table}");
    common::write_if_asked("docs/reference/limit.md", "limit", &table);
}

/// 34 courses of 36 bricks, less six windows in two rows.
fn windows() -> Scene {
    let brick = Brick { length: 0.25, height: 0.125 };
    let (width, courses) = (36.0 * brick.length, 34);
    let wall = Wall::running_bond("wall", "brick", brick, width, courses);
    let wall = [5, 20].into_iter().fold(wall, |wall, course| {
        [1.5, 4.0, 6.5].into_iter().fold(wall, |wall, x| {
            let bearing = Some(brick.length);
            wall.opening(Opening { x, width: 1.0, course, courses: 9, bearing, lintel: None })
        })
    });
    Scene::new("Wall with six windows", Units::SI)
        .thickness(0.25)
        .gravity([0.0, -9.81])
        .material("brick", Material::rigid().density(1800.0))
        .joint("bed", Joint::mu(0.65))
        .joint("head", Joint::mu(0.65))
        .wall(wall)
        .support(Support::new("floor", [0.0, 0.0], [width, 0.0], "bed"))
        .load(Load::acceleration("sideways", [9.81, 0.0]))
}
