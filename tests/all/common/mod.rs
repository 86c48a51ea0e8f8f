//! Scenes and questions that the cross-crate tests share.

#![allow(dead_code, reason = "every test binary uses its own part of this module")]
#![allow(unreachable_pub, reason = "a module of helpers, compiled into each test binary")]

pub mod films;
pub mod histories;
pub mod panels;
pub mod routes;

use lcp::Status;
use masonry::analysis::outcome::{Outcome, State};
use masonry::analysis::solve::solve;
use masonry::ids::BlockId;
use masonry::model::{Anchor, Body, Model};
use masonry::recover::contact_force;
use masonry::scene::{Block, Scene};
use masonry::units::{ForceUnit, LengthUnit, Units};
use nalgebra::{Point2, Vector2};

/// Acceleration of gravity \[m/s^2\].
pub const GRAVITY: f64 = 9.81;

/// Metres and kilonewtons.
pub const M_KN: Units = Units { length: LengthUnit::M, force: ForceUnit::Kn };

/// An axis-parallel block of `material`.
pub fn rectangle(name: &str, material: &str, x: [f64; 2], y: [f64; 2]) -> Block {
    Block::new(name, material, [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]])
}

/// Whether an equilibrium is found.
pub fn stands(scene: &Scene) -> bool {
    solve(scene).unwrap().solve.status == Status::Solved
}

/// The outcome of a scene that has an equilibrium, with its balances checked.
pub fn solved(scene: &Scene) -> Outcome {
    let outcome = solve(scene).unwrap();
    assert_eq!(outcome.solve.status, Status::Solved, "{:#?}", outcome.solve.attempts);
    assert_sound(&outcome, 1e-9);
    outcome
}

/// All checks of the judge, to a relative `tolerance`.
pub fn assert_sound(outcome: &Outcome, tolerance: f64) {
    let checks = outcome.checks.as_ref().unwrap();
    assert!(checks.worst() <= tolerance && checks.hold(tolerance), "{checks:?}");
}

/// The largest load factor in `range` at which a structure stands, by bisection to a relative
/// accuracy of 1e-7.
///
/// It has to stand at the lower and fall at the upper end.
pub fn critical(range: [f64; 2], stands: impl Fn(f64) -> bool) -> f64 {
    let [mut low, mut high] = range;
    assert!(stands(low), "falls at {low}");
    assert!(!stands(high), "stands at {high}");
    while high - low > 1e-7 * high {
        let middle = 0.5 * (low + high);
        if stands(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The state of a solved scene.
pub fn state(outcome: &Outcome) -> &State {
    outcome.state.as_ref().unwrap()
}

/// The block of this name.
pub fn block_named(model: &Model, name: &str) -> BlockId {
    BlockId::new(model.blocks.iter().position(|block| block.name == name).unwrap())
}

/// The displacements \[m\] of the nodes of a block.
pub fn displacements<'a>(outcome: &'a Outcome, name: &str) -> &'a [Vector2<f64>] {
    &state(outcome).displacements[block_named(&outcome.model, name).index()]
}

/// The resultant \[N\] of a joint on its block in front, from one body to another.
pub fn joint_resultant(outcome: &Outcome, a: Body, b: BlockId) -> Vector2<f64> {
    let model = &outcome.model;
    let between = |joint: &masonry::model::PlacedJoint| joint.a == a && joint.b == b;
    model
        .contacts
        .iter()
        .zip(&state(outcome).contacts)
        .filter(|(contact, _)| between(&model.joints[contact.joint.index()]))
        .map(|(contact, it)| contact_force(model, contact, it))
        .sum()
}

/// A number is `expected`, to a relative tolerance.
#[track_caller]
pub fn assert_close(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs() / expected.abs();
    assert!(error <= tolerance, "{found} instead of {expected}: off by {error:e}");
}

/// The resultant of self weights and edge loads \[N\].
pub fn applied_load(model: &Model) -> Vector2<f64> {
    masonry_report::summary::applied_load(model).force
}

/// The mechanism closes no joint beyond contact, and the loads do work on it.
pub fn assert_admissible(outcome: &Outcome) {
    let (model, rates) = (&outcome.model, outcome.mechanism.as_ref().unwrap());
    let largest = rates.iter().flatten().fold(0.0, |m: f64, rate| m.max(rate.amax()));
    assert_close(largest, 1.0, 1e-12);
    let at = |anchor: Anchor| {
        let corners = &rates[anchor.block.index()];
        let next = (anchor.edge + 1) % corners.len();
        corners[anchor.edge] * (1.0 - anchor.at) + corners[next] * anchor.at
    };
    for contact in &model.contacts {
        let relative = at(contact.b) - contact.a.map_or_else(Vector2::zeros, at);
        let opening = relative.dot(&model.joints[contact.joint.index()].normal);
        assert!(opening > -1e-9, "a joint closes at a rate of {opening:e}: {rates:?}");
    }
    let power: f64 =
        model.blocks.iter().zip(rates).map(|(block, corners)| power(model, block, corners)).sum();
    assert!(power > 0.0, "the loads do the work {power:e} on {rates:?}");
}

/// The power of the loads of a block whose corners move at these rates.
fn power(model: &Model, block: &masonry::model::PlacedBlock, corners: &[Vector2<f64>]) -> f64 {
    let edges: f64 = block
        .edge_loads()
        .map(|load| {
            let [start, end] = [load.edge, (load.edge + 1) % corners.len()];
            let area = (block.corners[end] - block.corners[start]).norm() * model.thickness;
            let middle = 0.5 * (load.from + load.to);
            let rate = corners[start] * (1.0 - middle) + corners[end] * middle;
            load.traction[0].dot(&rate) * area * (load.to - load.from)
        })
        .sum();
    // Good for parallelograms, whose centroid is the mean of their corners.
    let centre = corners.iter().sum::<Vector2<f64>>() / corners.len() as f64;
    let mass = block.density.unwrap_or(0.0) * area(&block.corners) * model.thickness;
    edges + mass * model.gravity.dot(&centre)
}

fn area(corners: &[Point2<f64>]) -> f64 {
    let twice = |k: usize| corners[k].coords.perp(&corners[(k + 1) % corners.len()].coords);
    0.5 * (0..corners.len()).map(twice).sum::<f64>()
}

/// The largest difference of two lists, relative to the largest entry of the first.
pub fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let largest = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let apart = a.iter().zip(b).fold(0.0, |m: f64, (x, y)| m.max((x - y).abs()));
    if apart > 0.0 { apart / largest } else { 0.0 }
}

/// All displacement components \[m\], block by block.
pub fn all_displacements(outcome: &Outcome) -> Vec<f64> {
    state(outcome).displacements.iter().flatten().flat_map(|u| [u.x, u.y]).collect()
}

/// All stress components \[Pa\], element by element.
pub fn all_stresses(outcome: &Outcome) -> Vec<f64> {
    state(outcome).stresses.iter().flat_map(|it| it.sigma).collect()
}

/// Forces \[N\] and moments \[N m\] of all supports.
pub fn all_reactions(outcome: &Outcome) -> Vec<f64> {
    outcome.reactions.iter().flat_map(|it| [it.fx, it.fy, it.m]).collect()
}
