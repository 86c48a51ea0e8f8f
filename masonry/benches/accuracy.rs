//! What accuracy costs: the panels by all routes to many tolerances on many meshes, and walls of many sizes.
//!
//! `cargo bench --bench accuracy` prints the tables; with `-- --write` it also writes `docs/accuracy.md`, further
//! tables and the same numbers as CSV into `docs/data/`, further pictures into `target/accuracy/`, and a section of
//! `docs/performance.md`. Every solve is a whole one, from the scene to the checked solution, on one thread; of short ones
//! the median of three.

#[path = "../../benches/common/mod.rs"]
mod common;
#[path = "accuracy/data.rs"]
mod data;
#[path = "accuracy/digits.rs"]
mod digits;
#[path = "accuracy/extrapolated.rs"]
mod extrapolated;
#[path = "../../benches/common/machine.rs"]
mod machine;
#[path = "accuracy/page.rs"]
mod page;
#[path = "accuracy/pictures.rs"]
mod pictures;
#[path = "accuracy/sentences.rs"]
mod sentences;
#[path = "accuracy/springs.rs"]
mod springs;
#[path = "accuracy/tables.rs"]
mod tables;

use std::ops::ControlFlow;
use std::time::Duration;

use digits::Refining;
use masonry::analysis::study::{Exact, MeshErrors, Settings, Study, refined, study};
use masonry::scene::{Brick, Joint, Load, Material, Plane, Scene, Support, Wall};
use masonry::units::Units;
use masonry_report as report;
use springs::Springs;

/// Elements of a square in each direction; the first are those of the scenes.
const MESHES: [u32; 4] = [2, 1, 4, 8];
/// What one solve may take.
const LIMIT: Duration = Duration::from_secs(3);
/// Courses, and bricks in a course.
const WALLS: [u32; 4] = [5, 10, 20, 40];
/// Of the walls.
const TOLERANCES: [f64; 2] = [1e-4, 1e-8];

/// A panel with what is more than a study of it.
struct Panel {
    name: &'static str,
    study: Study,
    /// For every mesh what the last digits of its reference cost.
    refinings: Vec<Vec<Refining>>,
    /// For every mesh its errors against the limit of the finest.
    extrapolated: Vec<MeshErrors>,
    /// On the first mesh.
    springs: Vec<Springs>,
}

fn main() {
    if !common::is_bench() {
        return;
    }
    let panels = ["panel_rectangular", "panel_square"].map(panel);
    let walls = WALLS.map(wall);
    if std::env::args().any(|argument| argument == "--write") {
        page::write(&common::root(), &panels, &walls);
    }
}

/// A panel of the paper, from one element a square on.
fn panel(name: &'static str) -> Panel {
    let path = common::root().join(format!("scenes/{name}.toml"));
    let mut scene = Scene::read(&path).expect("the scene is part of the repository");
    for wall in &mut scene.walls {
        // Rectangular bricks are two squares long.
        let squares = if wall.brick.length > 1.5 * wall.brick.height { 2 } else { 1 };
        wall.mesh = Some([squares, 1]);
    }
    let mesh_names = MESHES.iter().enumerate().map(|(position, factor)| {
        let elements = format!("{factor} x {factor} elements a square");
        if position == 0 { format!("the mesh of the scene ({elements})") } else { elements }
    });
    let mesh_names = mesh_names.collect();
    let settings = Settings { meshes: MESHES.into(), mesh_names, ..Settings::default() };
    let study = told(&scene, settings);
    let references = digits::references(&scene, &study);
    let of = |exact: &Option<Exact>| exact.as_ref().map(digits::refinings).unwrap_or_default();
    let first = references[0].as_ref().map(|exact| &exact.state);
    let panel = Panel {
        name,
        refinings: references.iter().map(of).collect(),
        extrapolated: extrapolated::errors(&study.meshes),
        springs: springs::springs(&refined(&scene, MESHES[0]), LIMIT, first),
        study,
    };
    println!("{}\n{}", tables::refinings(&panel), tables::springs(&panel));
    panel
}

/// A square wall of elastic bricks with friction on a full floor, under its weight and a load that leans.
fn wall(bricks: u32) -> Study {
    let [width, height] = [0.2, 0.1].map(|size| size * f64::from(bricks));
    let brick = Brick { length: 0.2, height: 0.1 };
    let scene = Scene::new(&format!("{bricks} courses of {bricks} bricks"), Units::SI)
        .plane(Plane::Stress)
        .thickness(0.1)
        .gravity([0.0, -9.81])
        .material("brick", Material::elastic(1e9, 0.15).density(2000.0))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .wall(Wall::running_bond("wall", "brick", brick, width, bricks).mesh([1, 1]))
        .support(Support::new("floor", [0.0, 0.0], [width, 0.0], "bed"))
        .load(Load::traction("top", [0.0, height], [width, height], [1000.0, -10_000.0]));
    let settings = Settings {
        tolerances: TOLERANCES.into(),
        meshes: vec![1],
        mesh_names: vec!["this mesh".to_owned()],
        ..Settings::default()
    };
    told(&scene, settings)
}

fn told(scene: &Scene, settings: Settings) -> Study {
    let machine = Some(machine::machine_and_date());
    let settings = Settings { time_limit: LIMIT, machine, ..settings };
    let mut shown = None;
    let study = study(scene, &settings, &mut |at| {
        if shown != Some(at) {
            let (title, route) = (&scene.title, at.route.name());
            eprintln!("{title}: mesh {}, {route} to {:e}", at.mesh, at.tolerance);
            shown = Some(at);
        }
        ControlFlow::Continue(())
    });
    let study = study.expect("the scene is sound");
    println!("{}", report::study::table(&study));
    study
}
