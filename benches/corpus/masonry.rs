//! Walls, with small ones of every case of the bench of hard walls.

use std::ops::ControlFlow;

use masonry::analysis::solve::{Event, Run};
use masonry::scene::Scene;

use crate::common;
use crate::line::Line;
use crate::walls::{Case, DRY, Wall};

const CASES: [Case; 6] = [
    Case::Lean,
    Case::OpenBase,
    Case::Tilt(0.9),
    Case::Tilt(0.99),
    Case::Tilt(1.3),
    Case::Settlement(5),
];
/// Elements of the bricks, and stiffness of the joints between them.
const BRICKS: [(Option<[u32; 2]>, Option<[f64; 2]>); 5] = [
    (None, None),
    (Some([1, 1]), None),
    (Some([2, 1]), None),
    (Some([1, 1]), DRY),
    (Some([2, 1]), DRY),
];

/// Solves all that are chosen.
pub(crate) fn solve(is_chosen: &dyn Fn(&str) -> bool, keep: &mut dyn FnMut(Line)) {
    for courses in [4, 8] {
        for mu in [0.3, 0.6, 1.0] {
            for (mesh, joints) in BRICKS {
                let wall = Wall { courses, mu, mesh, joints };
                let bricks = mesh.map_or("rigid".to_owned(), |[x, y]| format!("{x}x{y}"));
                let bricks = bricks + if joints.is_some() { " dry" } else { "" };
                let names = CASES.map(|case| format!("walls/{case} {courses} {mu} {bricks}"));
                if !names.iter().any(|name| is_chosen(name)) {
                    continue;
                }
                let limit = wall.largest_tilt();
                for (case, name) in CASES.into_iter().zip(names).filter(|it| is_chosen(&it.1)) {
                    keep(line(name, &wall.scene(case, limit)));
                }
            }
        }
    }
    let folder = common::root().join("scenes");
    for path in std::fs::read_dir(folder).expect("scenes").filter_map(Result::ok) {
        let name = format!("scenes/{}", path.path().file_stem().unwrap_or_default().display());
        let scene = std::fs::read_to_string(path.path()).expect("a text");
        if is_chosen(&name)
            && let Ok(scene) = Scene::from_toml(&scene)
        {
            keep(line(name, &scene));
        }
    }
}

fn line(case: String, scene: &Scene) -> Line {
    let mut iterations = 0;
    let mut observer = |event: Event| {
        iterations += usize::from(matches!(event, Event::Iteration { .. }));
        ControlFlow::Continue(())
    };
    let mut run = Run::new(scene, &mut observer).expect("a sound scene");
    while run.advance(&mut observer).expect("sound data") {}
    let outcome = run.finish();
    Line {
        case,
        end: outcome.judgement.verdict.to_string(),
        residual: f64::NAN,
        method: format!("{:?}", outcome.judgement.evidence),
        pivots: 0,
        // Steps of all methods that were tried, if there is no history.
        factorisations: outcome.history.as_ref().map_or(iterations, |history| {
            history.records.iter().map(|record| record.factorisations).sum()
        }),
    }
}
