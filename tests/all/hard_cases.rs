//! Hard cases: by every route, either an answer that is right, or the word that there is none.
//!
//! Scenes, and problems of `lcp` itself. The cases are also pages, `docs/hard_cases.md` and
//! `docs/hard_problems.md`, which are written by
//! `HARD_CASES=write cargo test --features long-tests --test all hard_cases`. Without the feature the routes that take seconds
//! are left out.

#![allow(dead_code, reason = "the bench of stability uses all of it")]
#![allow(unreachable_pub, reason = "its modules are compiled into this test only")]

mod balance;
mod case;
use crate::common;
mod double;
mod friction;
mod geometry;
mod limits;
mod page;
mod problems;
mod scenes;
mod stiffness;
mod sweep;
mod walls;

use std::path::Path;
use std::sync::LazyLock;

use case::{Case, End, Theme};
use common::{all_displacements, all_reactions, difference};
use masonry::analysis::outcome::{Outcome, PointStatus, State};
use masonry::ids::BlockId;
use masonry::model::{JointPoint, Model};
use masonry::verify::checks::Checks;
use nalgebra::Vector2;

/// Whether all routes are tried that end within a minute.
const IS_LONG: bool = cfg!(feature = "long-tests");

/// A theme whose cases are solved once, for all tests.
type Solved = LazyLock<Theme>;

static GEOMETRY: Solved = Solved::new(|| tried(geometry::TITLE, geometry::cases()));
static STIFFNESS: Solved = Solved::new(|| tried(stiffness::TITLE, stiffness::cases()));
static FRICTION: Solved = Solved::new(|| tried(friction::TITLE, friction::cases()));
static LIMITS: Solved = Solved::new(|| tried(limits::TITLE, limits::cases()));
static WALLS: Solved = Solved::new(|| tried(walls::TITLE, walls::cases()));

fn tried(title: &'static str, cases: Vec<Case>) -> Theme {
    let chosen = |case: Case| if IS_LONG { case } else { case.shortened() };
    Theme { title, cases: cases.into_iter().map(|case| chosen(case).tried()).collect() }
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
#[cfg(feature = "long-tests")]
mod sweeps {
    use super::{friction, geometry, limits, stiffness, sweep, walls};

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

    /// Larger walls and smaller settlements take long, and are left to the bench.
    #[test]
    fn sweeps_of_growth() {
        let mut sweeps = walls::sweeps();
        let [grown, settled] = &mut sweeps[..] else { panic!("there are two sweeps") };
        grown.values.retain(|length| *length <= 8.0);
        settled.values.retain(|share| *share > 5e-11);
        assert_no_jump(&sweeps);
    }
}

/// What the judge calls balanced is so in numbers of twice the digits: its sums lose none that count. Light blocks
/// have those of the heavy ones that they touch.
#[test]
fn blocks_balance_in_twice_the_digits() {
    let themes = [&GEOMETRY, &STIFFNESS, &FRICTION, &LIMITS, &WALLS];
    for tried in themes.iter().flat_map(|theme| &theme.cases) {
        for end in &tried.ends {
            let End::Solved { checks, outcome } = end else { continue };
            let (model, state) = (&outcome.model, common::state(outcome));
            let forces = 2 * model.contacts.len() + model.blocks.len();
            let digits = f64::EPSILON * forces as f64 * checks.spread;
            let left = balance::left_over(model, state);
            assert!(left <= 1e-9 + digits, "{}: {left:e}, {checks:?}", tried.case.name);
        }
    }
}

/// The judge on the state of an outcome.
fn judged(outcome: &Outcome) -> Checks {
    Checks::of(&outcome.model, common::state(outcome))
}

/// The panel without a floor stands where its topmost course does: the bricks below, which weigh nothing, can
/// be anywhere under it. What soft springs say is evidence, and here it is wrong.
#[test]
fn panel_without_a_floor_is_an_arch() {
    let errors = |mu: f64| {
        let course = common::solved(&limits::arch(mu.max(1.2)).scene);
        let scene = limits::hanging(mu).scene;
        let mut panel = masonry::analysis::solve::solve(&scene).unwrap();
        // Where a motion leads to a state of its own, slips are measured from there.
        panel.model = Model::from_scene(&scene).unwrap();
        panel.state = Some(above_dropped_bricks(&course, &panel.model));
        judged(&panel)
    };
    for mu in [1.2, 1.4, 1.6, 3.0] {
        // Dropped bricks have no forces but the rounding errors of their stiffness times a millimetre.
        assert!(errors(mu).hold(1e-9), "{mu}: {:?}", errors(mu));
    }
    assert!(errors(1.19).cone_violation > 1e-3 && errors(1.0).cone_violation > 1e-2);
}

/// Forces and displacements of a course in a panel, and a millimetre for the bricks below it.
fn above_dropped_bricks(course: &Outcome, panel: &Model) -> State {
    let found = common::state(course);
    let in_course = |block: BlockId| {
        let last = |name: &str| name.rsplit('/').next().unwrap().to_owned();
        let (row, brick) = panel.blocks[block.index()].name.rsplit_once('/').unwrap();
        let is_brick = |it: &&masonry::model::PlacedBlock| last(&it.name) == brick;
        let place = course.model.blocks.iter().find(is_brick).filter(|_| row.ends_with("/3"));
        place.map(|it| common::block_named(&course.model, &it.name))
    };
    let blocks =
        |contact: &JointPoint| [Some(contact.b), contact.a].map(|it| it.map(|anchor| anchor.block));
    let none = masonry::analysis::outcome::PointState {
        t_n: 0.0,
        t_t: 0.0,
        y_n: 0.0,
        y_t: 0.0,
        status: PointStatus::Open,
    };
    let of_contact = |contact: &JointPoint| {
        let between = blocks(contact).map(|it| it.map(in_course));
        let mut pairs = course.model.contacts.iter().zip(&found.contacts);
        let same = pairs.find(|(other, _)| {
            (other.position - contact.position).norm() < 1e-12
                && blocks(other).map(|it| it.map(Some)) == between
        });
        same.map_or(none, |(_, state)| *state)
    };
    let moved = |block: usize, count: usize| match in_course(BlockId::new(block)) {
        Some(id) => found.displacements[id.index()].clone(),
        None => vec![Vector2::new(0.0, -1e-3); count],
    };
    let counts = panel.blocks.iter().map(|block| block.mesh.as_ref().unwrap().nodes.len());
    State {
        displacements: counts.enumerate().map(|(block, count)| moved(block, count)).collect(),
        contacts: panel.contacts.iter().map(of_contact).collect(),
        ..found.clone()
    }
}

/// A millionth more or less of any number of an answer is seen.
#[test]
fn checks_see_what_is_wrong() {
    let scene = scenes::stack(2, [1.0, 1.0], 0.2, scenes::elastic());
    let right = common::solved(&scene);
    assert!(judged(&right).worst() < 1e-12);
    let seen = |change: &dyn Fn(&mut State)| {
        let mut wrong = right.clone();
        change(wrong.state.as_mut().unwrap());
        judged(&wrong).worst() > 1e-8
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
                (End::Slow, End::Slow) => {}
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
    // A page has all routes.
    if IS_LONG && std::env::var_os("HARD_CASES").is_some_and(|it| it == "write") {
        std::fs::write(&file, page).unwrap();
    }
    let mut written = std::fs::read_to_string(&file).unwrap();
    if !IS_LONG {
        written = page::as_far_as_tried(&written, page);
    }
    if let Some(line) = page::difference(&written, page) {
        panic!(
            "{line}; write it anew: HARD_CASES=write cargo test --features long-tests --test all hard_cases"
        );
    }
}
