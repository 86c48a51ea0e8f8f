//! The paper's dry panels against values found independently, with other solvers, on the same
//! discretisation: 1 m x 1 m, bricks 0.1 m high, elements of 0.05 m, a contact pair at every pair
//! of coincident nodes, friction coefficient 1, 10 kN/m2 on top.

use crate::common;

use std::sync::LazyLock;

use common::panels;

use masonry::analysis::outcome::{Outcome, State};
use masonry::analysis::solve::solve;
use masonry::data::verdict::Verdict;
use masonry::model::{Body, JointPoint};
use masonry::scene::{Route, Scene};

static OPEN: LazyLock<Outcome> = LazyLock::new(|| {
    // By pivots, as published: where the two loose bricks in the lowest course are is theirs.
    common::solved(&panels::scene("panel_square").route(Route::Lemke))
});
static FULL: LazyLock<Outcome> = LazyLock::new(|| panels::solved("panel_square_full_floor"));
static RECTANGULAR: LazyLock<Outcome> = LazyLock::new(|| panels::solved("panel_rectangular"));

fn state(outcome: &Outcome) -> &State {
    outcome.state.as_ref().unwrap()
}

/// Within 1e-5, and half a unit of the last of the six digits that were given.
fn assert_close(found: f64, expected: f64, what: &str) {
    let error = (found / expected - 1.0).abs();
    assert!(error <= 1e-5, "{what}: {found:e} is not {expected:e}, relative error {error:.1e}");
}

fn largest_displacement(outcome: &Outcome) -> f64 {
    let components = state(outcome).displacements.iter().flatten().flat_map(|u| [u.x, u.y]);
    components.fold(0.0, |max: f64, u| max.max(u.abs()))
}

fn assert_trustworthy(outcome: &Outcome) {
    let residuals = outcome.solve.residuals;
    assert!(residuals.equation <= 1e-10 && residuals.complementarity <= 1e-10, "{residuals:?}");
    let paper = outcome.solve.coulomb_residuals.unwrap_or(residuals);
    assert!(paper.worst() <= 1e-10, "in the paper's form: {paper:?}");
    let checks = outcome.checks.as_ref().unwrap();
    assert!(checks.hold(1e-9), "{checks:?}");
}

fn counts(outcome: &Outcome) -> [usize; 3] {
    let checks = outcome.checks.as_ref().unwrap();
    [checks.open, checks.stick, checks.slip]
}

/// Sum of the contact forces \[kN\] of the named supports on the structure at points that `choose`.
fn force(outcome: &Outcome, supports: &[&str], choose: impl Fn(f64, f64) -> bool) -> [f64; 2] {
    let mut sum = [0.0, 0.0];
    for (contact, s) in outcome.model.contacts.iter().zip(&state(outcome).contacts) {
        let joint = &outcome.model.joints[contact.joint.index()];
        let Body::Support(id) = joint.a else { continue };
        let name = outcome.model.supports[id.index()].name.as_str();
        if supports.contains(&name) && choose(contact.position.x, contact.position.y) {
            let force = (joint.normal * s.t_n + joint.tangent() * s.t_t) / 1e3;
            sum = [sum[0] + force.x, sum[1] + force.y];
        }
    }
    sum
}

/// The published reactions of floor and walls \[kN\] hold one of many equally exact splits of the force
/// at each lower corner, where floor and wall touch the same node. So: with that part of the
/// corner's force moved to the wall that makes up the published reaction of the wall, both parts
/// stay inside their friction cones, and the floor's published reaction follows.
/// `digit` is one unit of the last digit that was given.
fn assert_reactions(outcome: &Outcome, floor: &[&str], [floor_y, wall, digit]: [f64; 3]) {
    let is_corner = |_: f64, y: f64| y < 1e-9;
    let mut moved = 0.0;
    for (name, inwards) in [("left wall", 1.0), ("right wall", -1.0)] {
        let at_corner = |x: f64, y: f64| is_corner(x, y) && (x < 0.5) == (inwards > 0.0);
        let above = force(outcome, &[name], |x, y| !is_corner(x, y));
        let (n, t) = (wall - inwards * above[0], wall - above[1]);
        let both: Vec<&str> = floor.iter().copied().chain([name]).collect();
        let corner = force(outcome, &both, at_corner);
        let tolerance = 1e-5 * wall + digit;
        assert!(n >= -tolerance && t.abs() <= n + tolerance, "{name}: normal {n}, tangential {t}");
        let left = [inwards * corner[0] - n, corner[1] - t];
        assert!(left[0].abs() <= left[1] + tolerance, "{name}: {left:?} outside the floor's cone");
        moved += t - force(outcome, &[name], at_corner)[1];
    }
    let total = force(outcome, floor, |_, _| true);
    let error = (total[1] - moved - floor_y).abs();
    // Half a digit of the floor's reaction and of both walls'.
    assert!(error <= 1e-6 * floor_y + 1.5 * digit, "{} is not {floor_y}", total[1] - moved);
}

/// Identities whatever the discretisation.
fn assert_identities(outcome: &Outcome) {
    let sum: f64 = outcome.reactions.iter().map(|r| r.fy).sum();
    assert_close(sum, 10e3, "sum of the vertical reactions");
    let named = |name: &str| outcome.reactions.iter().find(|r| r.support == name).unwrap();
    let (left, right) = (named("left wall"), named("right wall"));
    assert!((left.fx + right.fx).abs() <= 1e-9 * left.fx, "{} and {}", left.fx, right.fx);
    for wall in [left, right] {
        assert!(wall.fy.abs() <= wall.fx.abs() * (1.0 + 1e-9), "friction of {}", wall.support);
    }
}

#[test]
fn square_panel_on_two_corners() {
    let outcome = &*OPEN;
    assert_trustworthy(outcome);
    assert_identities(outcome);
    assert_eq!((outcome.plan.blocks, outcome.plan.nodes), (105, 915));
    assert_eq!((outcome.plan.contact_points, outcome.plan.order), (711, 3 * 711));
    assert_close(largest_displacement(outcome), 2.01471e-4, "largest displacement");
    assert_close(state(outcome).strain_energy, 8.66520e-1, "strain energy [J]");
    assert_reactions(outcome, &["left foot", "right foot"], [7.32768, 1.33616, 1e-5]);
    // The counts that were given, 86, 485 and 134, leave six of the 711 points in no class. By what
    // moves, which is how points are classed here, those six slide.
    assert_eq!(counts(outcome), [86, 485, 140]);
}

#[test]
fn square_panel_on_a_full_floor() {
    let outcome = &*FULL;
    assert_trustworthy(outcome);
    assert_identities(outcome);
    assert_eq!(outcome.plan.contact_points, 735);
    assert_close(largest_displacement(outcome), 8.95566e-5, "largest displacement");
    assert_close(state(outcome).strain_energy, 3.97357e-1, "strain energy [J]");
    assert_reactions(outcome, &["floor"], [7.5227, 1.2387, 1e-4]);
    assert_eq!(counts(outcome), [2, 677, 56]);
}

/// Two exact solutions are known: the middle bricks of the lowest course hang by friction, or drop.
#[test]
fn rectangular_panel_is_one_of_the_two_solutions() {
    let outcome = &*RECTANGULAR;
    assert_trustworthy(outcome);
    assert_identities(outcome);
    assert_eq!((outcome.plan.blocks, outcome.plan.nodes), (55, 765));
    assert_eq!(outcome.plan.contact_points, 475);
    let feet = ["left foot", "right foot"];
    if counts(outcome)[0] == 29 {
        assert_close(state(outcome).strain_energy, 5.67259e-1, "strain energy, hanging [J]");
        assert_close(largest_displacement(outcome), 1.27927e-4, "largest displacement, hanging");
        assert_reactions(outcome, &feet, [7.90715, 1.04643, 1e-5]);
    } else {
        assert_close(state(outcome).strain_energy, 6.37095e-1, "strain energy, dropped [J]");
        assert_reactions(outcome, &feet, [7.72555, 1.13722, 1e-5]);
    }
}

/// The default contact points lie at the nodes of either side; on these panels those are the
/// coincident node pairs, and both rules give the same points.
#[test]
fn the_default_contact_points_are_the_nodal_pairs_here() {
    for name in ["panel_square", "panel_rectangular"] {
        let scene = panels::scene(name);
        let mut pairs = scene.clone();
        pairs.contact.points = masonry::model::joints::PointRule::NodalPairs;
        let model = |scene: &Scene| masonry::model::Model::from_scene(scene).unwrap();
        let (points, pairs) = (model(&scene).contacts, model(&pairs).contacts);
        assert_eq!(points.len(), pairs.len());
        let has_its_pair = |point: &JointPoint| {
            let close = |p: &&JointPoint| (p.position - point.position).norm() < 1e-9;
            let mut same = pairs.iter().filter(|p| p.joint == point.joint).filter(close);
            same.next().is_some_and(|p| (p.weight / point.weight - 1.0).abs() < 1e-9)
        };
        assert!(points.iter().all(has_its_pair), "{name}");
    }
}

/// Without any floor the friction of the walls cannot carry the load at mu = 1: the blocks move and do not stop.
#[test]
fn without_a_floor_there_is_no_equilibrium() {
    let outcome = solve(&panels::scene("panel_no_floor")).unwrap();
    assert_eq!(outcome.judgement.verdict, Verdict::Falls);
    assert!(outcome.state.is_none());
}

/// By dense pivots on problems of order 3500, which take seconds.
#[cfg(feature = "long-tests")]
mod by_pivots {
    use masonry::scene::Form;

    use super::{FULL, Route, panels, solve, state};

    #[test]
    fn without_a_floor_pivots_end_on_rays() {
        let outcome = solve(&panels::scene("panel_no_floor").route(Route::Lemke)).unwrap();
        assert_eq!(outcome.solve.status, lcp::Status::RayTermination);
        assert!(outcome.state.is_none());
        let tried =
            |form: &str| outcome.solve.attempts.iter().any(|it| it.to_string().starts_with(form));
        assert!(tried("coulomb") && tried("mixed"), "{:?}", outcome.solve.attempts);
        let rates = outcome.mechanism.as_ref().unwrap();
        assert!(rates.iter().flatten().all(|rate| rate.y < 0.0), "all blocks fall");
    }

    /// The forms are different problems with the same answer.
    #[test]
    fn the_mixed_form_alone_gives_the_same_answer() {
        let mut scene = panels::scene("panel_square_full_floor");
        scene.solver.form = Form::Mixed;
        let outcome = solve(&scene).unwrap();
        let (a, b) = (state(&outcome).strain_energy, state(&FULL).strain_energy);
        assert!((a / b - 1.0).abs() < 1e-10, "{a} and {b}");
    }
}
