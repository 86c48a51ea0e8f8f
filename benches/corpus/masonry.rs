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
/// Rigid bricks, and elastic ones with hard and with dry joints.
const BRICKS: [&str; 5] = ["rigid", "1x1", "2x1", "1x1 dry", "2x1 dry"];

/// Solves all that are chosen.
pub(crate) fn solve(is_chosen: &dyn Fn(&str) -> bool, keep: &mut dyn FnMut(Line)) {
    for courses in [4, 8] {
        for mu in [0.3, 0.6, 1.0] {
            for bricks in BRICKS {
                let mesh = match bricks {
                    "rigid" => None,
                    elastic if elastic.starts_with('1') => Some([1, 1]),
                    _ => Some([2, 1]),
                };
                let joints = if bricks.ends_with("dry") { DRY } else { None };
                let wall = Wall { courses, mu, mesh, joints };
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
