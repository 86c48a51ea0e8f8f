//! Load histories of walls of which a part of the foundation sinks.

use crate::common;

use std::ops::ControlFlow;

use common::assert_close;
use lcp::Status;
use masonry::analysis::solve::{Run, solve};
use masonry::data::info::Way;
use masonry::data::state::PointState;
use masonry::data::verdict::Verdict;
use masonry::scene::{Brick, Joint, Material, Movement, Plane, Route, Scene, Stage, Support, Wall};
use masonry::units::{ForceUnit, LengthUnit, Units};

/// A wall of which a part of the foundation sinks: bricks slide and turn by thousands of times what they are
/// deformed by, and answers are exact all the same.
#[test]
fn a_settlement_moves_bricks_far() {
    let scene = Scene::from_toml(include_str!("../../scenes/wall_settlement.toml")).unwrap();
    let outcome = solve(&scene.route(Route::Interior)).unwrap();
    assert_eq!(outcome.solve.status, Status::Solved, "{:?}", outcome.solve);
    let history = outcome.history.as_ref().unwrap();
    assert_eq!(history.records.len(), 11);
    let carried = history.records.iter().map(|it| it.reactions.iter().map(|it| it.fy).sum::<f64>());
    let carried: Vec<f64> = carried.collect();
    for (record, carried_now) in history.records.iter().zip(&carried) {
        let residuals = record.residuals;
        assert!(residuals.loads < 1e-13, "{:?}: {residuals:?}", record.step);
        assert!(residuals.equation < 1e-11, "{:?}: {residuals:?}", record.step);
        assert!(residuals.natural < 1e-10, "{:?}: {residuals:?}", record.step);
        assert!(record.dissipation >= -1e-12 * history.work().abs());
        assert_close(*carried_now, carried[0], 1e-9);
    }
}

/// Ten courses of ten bricks under their own weight; a part of the floor sinks and tilts in so many steps.
fn on_a_sinking_floor(steps: u32, material: Material, mesh: Option<[u32; 2]>) -> Scene {
    on_a_floor_that_sinks_by(0.004, steps, 0.6, material, mesh)
}

/// The same by a length, and turns by as many radians, with a coefficient of friction.
fn on_a_floor_that_sinks_by(
    depth: f64,
    steps: u32,
    mu: f64,
    material: Material,
    mesh: Option<[u32; 2]>,
) -> Scene {
    let brick = Brick { length: 0.25, height: 0.125 };
    let wall = Wall::running_bond("wall", "brick", brick, 2.5, 10);
    let sinks = Movement { x: 0.0, y: -depth, turn: -depth };
    Scene::new("settlement", Units { force: ForceUnit::Kn, length: LengthUnit::M })
        .plane(Plane::Stress)
        .thickness(0.25)
        .gravity([0.0, -9.81])
        .material("brick", material.density(1800.0))
        .joint("bed", Joint::mu(mu))
        .joint("head", Joint::mu(mu))
        .wall(match mesh {
            Some(mesh) => wall.mesh(mesh),
            None => wall,
        })
        .support(Support::new("left", [0.0, 0.0], [1.5, 0.0], "bed"))
        .support(Support::new("right", [1.5, 0.0], [2.5, 0.0], "bed"))
        .stage(Stage::new("weight"))
        .stage(Stage::new("settlement").steps(steps).moves("right", sinks))
}

/// A part of the foundation sinks and tilts under a wall of which most forces are not unique, whose states leave motions
/// free when they are guessed a little wrong: every step has an equilibrium, in which the supports carry the weight.
#[test]
fn a_settlement_that_tilts_stands_throughout() {
    let scene = on_a_sinking_floor(5, Material::elastic(5e6, 0.15), Some([1, 1]));
    let outcome = solve(&scene).unwrap();
    assert_eq!(outcome.judgement.verdict, Verdict::Stands, "{}", outcome.judgement.sentence);
    let history = outcome.history.as_ref().unwrap();
    assert_eq!(history.records.len(), 6);
    let weight = 2.5 * 1.25 * 0.25 * 1800.0 * 9.81;
    for record in &history.records {
        assert!(record.residuals.worst() <= 1e-10, "{:?}: {:?}", record.step, record.residuals);
        assert_close(record.reactions.iter().map(|it| it.fy).sum(), weight, 1e-9);
        assert!(record.dissipation >= -1e-12 * history.work().abs());
    }
}

/// Corners of three bricks meet in every bed, so that one of their contacts is redundant. All steps, however small, are solved,
/// also where friction turns back and forth: the errors of one do not become those of the next.
#[test]
fn small_steps_with_high_friction_are_solved() {
    let brick = Material::elastic(5e6, 0.15);
    let steps = if cfg!(feature = "long-tests") { 80 } else { 16 };
    let sinks = 0.00005 * f64::from(steps);
    let scene = on_a_floor_that_sinks_by(sinks, steps, 1.0, brick, Some([2, 1]));
    let outcome = solve(&scene).unwrap();
    assert_eq!(outcome.judgement.verdict, Verdict::Stands, "{}", outcome.judgement.sentence);
    let history = outcome.history.as_ref().unwrap();
    assert_eq!(history.records.len(), steps as usize + 1);
    assert_eq!(history.steps_against_law(), 0);
}

/// Friction takes all that it can of every slip: by the two sums that define it, over the slips since the step before.
#[test]
fn steps_keep_the_law_along_the_way() {
    let scene = on_a_sinking_floor(5, Material::elastic(5e6, 0.15), Some([1, 1]));
    let mut run = Run::new(&scene, &mut |_| ControlFlow::Continue(())).unwrap();
    let (mut before, mut powers): (Option<Vec<PointState>>, _) = (None, Vec::new());
    while run.advance(&mut |_| ControlFlow::Continue(())).unwrap() {
        let contacts = run.frame().unwrap().state.contacts;
        let slid = |(i, now): (usize, &PointState)| {
            let was = before.as_ref().map_or(0.0, |it| it[i].y_t);
            (now.t_n, now.t_t, now.y_t - was)
        };
        let slips: Vec<(f64, f64, f64)> = contacts.iter().enumerate().map(slid).collect();
        let taken: f64 = slips.iter().map(|(_, t_t, slip)| -t_t * slip).sum();
        let most: f64 = slips.iter().map(|(t_n, _, slip)| 0.6 * t_n.max(0.0) * slip.abs()).sum();
        powers.push(taken / most);
        before = Some(contacts);
    }
    let outcome = run.finish();
    let history = outcome.history.as_ref().unwrap();
    for (record, power) in history.records.iter().zip(&powers).skip(1) {
        let told = record.friction_power.unwrap();
        assert!(told >= 1.0 - 1e-9, "{told}");
        // Motions of several steps may slide to and fro.
        let is_one_step = record.way == Way::Law;
        assert!(!is_one_step || (told - power).abs() < 1e-6, "{told} instead of {power}");
    }
    assert!(history.records.iter().any(|record| record.way == Way::Law));
    assert_eq!(history.steps_against_law(), 0);
    assert!(outcome.judgement.sentence.contains("Coulomb's law verified"));
}

/// Where a part of the floor sinks, `W = U + D` holds as well, the better the shorter the steps.
#[test]
fn energy_is_accounted_for_where_bricks_come_to_rest() {
    let errors = [5, 20].map(|steps| {
        let scene = on_a_sinking_floor(steps, Material::elastic(5e6, 0.15), Some([1, 1]));
        let outcome = solve(&scene).unwrap();
        let history = outcome.history.as_ref().unwrap();
        assert_eq!(history.records.len(), steps as usize + 1);
        let least = -1e-12 * history.work().abs();
        assert!(history.records.iter().all(|record| record.dissipation >= least));
        let stored = outcome.state.as_ref().unwrap().strain_energy;
        let error = (history.work() - stored - history.dissipation()).abs();
        error / history.dissipation()
    });
    assert!(errors[1] < 0.4 * errors[0] && errors[1] < 0.2, "{errors:?}");
}

/// Rigid bricks on a floor of which a part sinks and tilts: Coulomb's law for the slips of a whole step leads nowhere, and
/// the bricks evolve. In every step all loads come down at the supports, and friction takes energy.
#[test]
fn rigid_bricks_evolve_where_a_part_of_the_floor_sinks() {
    let scene = on_a_sinking_floor(5, Material::rigid(), None);
    let outcome = solve(&scene).unwrap();
    assert_eq!(outcome.judgement.verdict, Verdict::Stands, "{}", outcome.judgement.sentence);
    assert!(outcome.judgement.warnings.iter().any(|it| it.contains("stiffness of dry ones")));
    let history = outcome.history.as_ref().unwrap();
    assert_eq!(history.records.len(), 6);
    assert_eq!(history.records[0].way, Way::Law);
    let weight = 2.5 * 1.25 * 0.25 * 1800.0 * 9.81;
    for record in &history.records {
        assert!(record.residuals.worst() <= 1e-10, "{:?}: {:?}", record.step, record.residuals);
        assert_close(record.reactions.iter().map(|it| it.fy).sum(), weight, 1e-9);
    }
    let settled = &history.records[1..];
    assert_eq!(history.steps_against_law(), 0);
    // The wall is lowered, and what its weight does goes into friction.
    assert!(settled.iter().all(|it| it.dissipation > 0.0) && history.work() > 0.0);
    let sunk = 0.004 + 0.004 * 0.5;
    let largest = history.records[5].largest_displacement;
    assert!(largest > 0.5 * sunk && largest < 2.0 * sunk, "{largest}");
}
