//! Hard cases: by every route, either an answer that is right, or the word that there is none.
//!
//! Scenes, and problems of `lcp` itself. The cases are also pages, `docs/hard_cases.md` and
//! `docs/hard_problems.md`, which are written by `HARD_CASES=write cargo test --test hard_cases`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(dead_code, reason = "the bench of stability uses all of it")]
#![allow(unreachable_pub, reason = "its modules are compiled into this test only")]

#[path = "hard_cases/case.rs"]
mod case;
#[path = "hard_cases/checks.rs"]
mod checks;
mod common;
#[path = "hard_cases/double.rs"]
mod double;
#[path = "hard_cases/friction.rs"]
mod friction;
#[path = "hard_cases/geometry.rs"]
mod geometry;
#[path = "hard_cases/limits.rs"]
mod limits;
#[path = "hard_cases/page.rs"]
mod page;
#[path = "hard_cases/problems.rs"]
mod problems;
#[path = "hard_cases/scenes.rs"]
mod scenes;
#[path = "hard_cases/stiffness.rs"]
mod stiffness;
#[path = "hard_cases/sweep.rs"]
mod sweep;
#[path = "hard_cases/walls.rs"]
mod walls;

use std::path::Path;
use std::sync::LazyLock;

use case::{Case, End, Theme};
use checks::Errors;
use common::{all_displacements, all_reactions, difference};
use masonry::outcome::State;

/// A theme whose cases are solved once, for all tests.
type Solved = LazyLock<Theme>;

static GEOMETRY: Solved = Solved::new(|| tried(geometry::TITLE, geometry::cases()));
static STIFFNESS: Solved = Solved::new(|| tried(stiffness::TITLE, stiffness::cases()));
static FRICTION: Solved = Solved::new(|| tried(friction::TITLE, friction::cases()));
static LIMITS: Solved = Solved::new(|| tried(limits::TITLE, limits::cases()));
static WALLS: Solved = Solved::new(|| tried(walls::TITLE, walls::cases()));

fn tried(title: &'static str, cases: Vec<Case>) -> Theme {
    Theme { title, cases: cases.into_iter().map(Case::tried).collect() }
}

/// Nothing that is called solved is wrong.
#[track_caller]
fn assert_honest(theme: &Theme) {
    let wrong: Vec<String> =
        theme.cases.iter().flat_map(|tried| tried.wrong(case::strict)).collect();
    for tried in &theme.cases {
        assert!(!tried.is_unsolved(), "{}: solved by no route", tried.case.name);
    }
    assert!(wrong.is_empty(), "{}:\n{}", theme.title, wrong.join("\n"));
}

#[test]
fn contacts_and_shapes() {
    assert_honest(&GEOMETRY);
}

#[test]
fn stiffness_and_weight() {
    assert_honest(&STIFFNESS);
}

#[test]
fn friction_of_every_size() {
    assert_honest(&FRICTION);
}

#[test]
fn around_limits() {
    assert_honest(&LIMITS);
}

#[test]
fn growing_walls() {
    assert_honest(&WALLS);
}

/// From harmless to hopeless: nowhere on its way an answer is worse than promised.
#[track_caller]
fn assert_no_jump(sweeps: &[sweep::Sweep]) {
    let points = sweeps.iter().flat_map(|it| it.coarse().into_iter().map(|value| it.at(value)));
    let wrong: Vec<String> = points.flat_map(|point| point.wrong).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn sweeps_of_contacts_and_shapes() {
    assert_no_jump(&geometry::sweeps());
}

#[test]
fn sweeps_of_stiffness_and_weight() {
    assert_no_jump(&stiffness::sweeps());
}

#[test]
fn sweeps_of_friction() {
    assert_no_jump(&friction::sweeps());
}

#[test]
fn sweeps_around_limits() {
    assert_no_jump(&limits::sweeps());
}

/// A millionth more or less of any number of an answer is seen.
#[test]
fn checks_see_what_is_wrong() {
    let scene = scenes::stack(2, [1.0, 1.0], 0.2, scenes::elastic());
    let right = common::solved(&scene);
    assert!(Errors::of(&right).worst() < 1e-12);
    let seen = |change: &dyn Fn(&mut State)| {
        let mut wrong = right.clone();
        change(wrong.state.as_mut().unwrap());
        Errors::of(&wrong).worst() > 1e-8
    };
    let state = right.state.as_ref().unwrap();
    for (k, contact) in state.contacts.iter().enumerate() {
        assert!(contact.t_n <= 0.0 || seen(&|state| state.contacts[k].t_n *= 1.0 + 1e-6), "{k}");
        assert!(contact.t_n <= 0.0 || seen(&|state| state.contacts[k].t_t *= 1.0 + 1e-6), "{k}");
        assert!(seen(&|state| state.contacts[k].t_n = f64::NAN), "{k}");
    }
    let largest = all_displacements(&right).into_iter().fold(0.0, f64::max);
    for (block, nodes) in state.displacements.iter().enumerate() {
        for node in 0..nodes.len() {
            let moved = |state: &mut State| state.displacements[block][node].x += 1e-6 * largest;
            assert!(seen(&moved), "{block}, {node}");
        }
    }
    assert!(seen(&|state| state.strain_energy *= 1.0 + 1e-6));
}

/// One wall in all units: the same status by every route, and one answer.
#[test]
fn units_make_no_difference() {
    let in_units: Vec<_> =
        STIFFNESS.cases.iter().filter(|tried| tried.case.name.starts_with("one wall in")).collect();
    assert_eq!(in_units.len(), stiffness::UNITS.len());
    for pair in in_units.windows(2) {
        for (first, second) in pair[0].ends.iter().zip(&pair[1].ends) {
            match (first, second) {
                (End::Solved { outcome: first, .. }, End::Solved { outcome: second, .. }) => {
                    for numbers in [all_reactions, all_displacements] {
                        let apart = difference(&numbers(first), &numbers(second));
                        assert!(apart < 1e-9, "{:?}: {apart:e}", first.solve.route);
                    }
                }
                (End::GaveUp { outcome: first }, End::GaveUp { outcome: second }) => {
                    assert_eq!(first.solve.status, second.solve.status);
                }
                _ => panic!("{} and {}", pair[0].case.name, pair[1].case.name),
            }
        }
    }
}

#[test]
fn page_of_the_catalogue() {
    let page = page::page(&[&GEOMETRY, &STIFFNESS, &FRICTION, &LIMITS, &WALLS]);
    assert_written("docs/hard_cases.md", &page);
}

#[test]
fn page_of_the_problems() {
    assert_written("docs/hard_problems.md", &problems::page(&problems::THEMES));
}

/// That a page says what was found; or it is written.
#[track_caller]
fn assert_written(name: &str, page: &str) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    if std::env::var_os("HARD_CASES").is_some_and(|it| it == "write") {
        std::fs::write(&file, page).unwrap();
    }
    let written = std::fs::read_to_string(&file).unwrap();
    if let Some(line) = page::difference(&written, page) {
        panic!("{line}; write it anew: HARD_CASES=write cargo test --test hard_cases");
    }
}
