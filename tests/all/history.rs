//! Load histories: hysteresis, energy, order of loads, steps that fail.

use crate::common;

use common::assert_close;
use common::histories::{pushed, wall};
use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::scene::{
    Block, Brick, Joint, Load, Material, Movement, Plane, Route, RouteSetting, Scene, Stage,
    Support, Wall,
};
use masonry::units::Units;

const ROUTES: [Route; 4] = [Route::Lemke, Route::Interior, Route::Qp, Route::Pgs];
const WIDTH: f64 = 1.0;
const HEIGHT: f64 = 0.4;
const PRESSURE: f64 = 2e3;
const MU: f64 = 0.3;
/// Friction that the weight on the block mobilises.
const LIMIT: f64 = MU * PRESSURE * WIDTH;

/// A rigid block under a pressure, on a floor that can be moved, between two walls that press pads on it.
fn shaken_block(young: f64) -> Scene {
    let thickness = 0.01;
    let ([l, h], t) = ([WIDTH, HEIGHT], thickness);
    Scene::new("Block between pads", Units::SI)
        .plane(Plane::Stress)
        .thickness(1.0)
        .material("stone", Material::rigid())
        .material("pad", Material::elastic(young, 0.0))
        .joint("floor", Joint::mu(MU).stiffness([STIFFER * stiffness(young); 2]))
        .joint("pads", Joint::mu(0.0).mortar(thickness, "pad"))
        .block(Block::new("block", "stone", [[0.0, 0.0], [l, 0.0], [l, h], [0.0, h]]))
        .support(Support::new("floor", [0.0, 0.0], [l, 0.0], "floor"))
        .support(Support::new("left", [-t, 0.0], [-t, h], "pads"))
        .support(Support::new("right", [l + t, 0.0], [l + t, h], "pads"))
        .load(Load::pressure("top", [0.0, h], [l, h], PRESSURE))
}

/// Stiffness of both pads together.
fn stiffness(young: f64) -> f64 {
    2.0 * young * HEIGHT / 0.01
}

/// The floor of a rigid block gives way as well, by so much less than the pads.
const STIFFER: f64 = 1e5;

/// The clamping, one way, and a full cycle.
fn cycle(scene: Scene, reach: f64, steps: u32) -> Scene {
    let floor = |name: &str, x: f64, steps: u32| {
        Stage::new(name).steps(steps).moves("floor", Movement::by(x, 0.0))
    };
    let clamp = 3.0 * reach;
    scene
        .stage(
            Stage::new("clamp")
                .moves("left", Movement::by(clamp, 0.0))
                .moves("right", Movement::by(-clamp, 0.0)),
        )
        .stage(floor("out", reach, steps))
        .stage(floor("back", -reach, 2 * steps))
        .stage(floor("out again", reach, 2 * steps))
}

fn dissipated_in(outcome: &Outcome, stages: &[&str]) -> f64 {
    let records = &outcome.history.as_ref().unwrap().records;
    let within = records.iter().filter(|record| stages.contains(&record.step.stage.as_str()));
    within.map(|record| record.dissipation).sum()
}

/// The area of the loop of a block on springs: `4 mu N (d - mu N / k)`, in however many steps. Its floor gives way with the pads:
/// sideways, and at its two edges, over which the pads turn it.
#[test]
fn hysteresis_of_a_block_on_springs() {
    let young = 1e6;
    let floor = STIFFER * stiffness(young) * WIDTH;
    let turned = (HEIGHT / WIDTH).powi(2) / floor;
    let slips_at = LIMIT * (1.0 / stiffness(young) + 1.0 / floor + turned);
    // Edges carry unlike parts of the weight at the end of the first way, and each other's of the second.
    let eccentricity = MU * HEIGHT / WIDTH;
    let first_slips_at = slips_at + LIMIT * eccentricity.powi(2) / floor;
    for route in ROUTES {
        for (reach, steps) in [(5.0 * slips_at, 1), (5.0 * slips_at, 7), (1.5 * slips_at, 4)] {
            let outcome = solve(&cycle(shaken_block(young).route(route), reach, steps)).unwrap();
            assert_eq!(outcome.solve.status, Status::Solved, "{route:?} {:?}", outcome.solve);
            let area = 4.0 * LIMIT * (reach - slips_at);
            let close = |stages: &[&str], energy: f64| {
                assert_close(dissipated_in(&outcome, stages), energy, 1e-9);
            };
            close(&["back", "out again"], area);
            close(&["out"], LIMIT * (reach - first_slips_at));
            assert!(dissipated_in(&outcome, &["clamp"]).abs() <= 1e-9 * area);
            let history = outcome.history.as_ref().unwrap();
            for record in history.records.iter().filter(|it| it.dissipation > 1e-6 * area) {
                assert_close(record.friction_power.unwrap(), 1.0, 1e-8);
                assert!(record.energy_created <= 1e-9 * area);
            }
            assert_eq!(history.steps_against_law(), 0, "{route:?}");
            assert!(outcome.judgement.sentence.contains("Coulomb's law verified"));
        }
    }
}

/// Below the friction of the edge that the pads lift nothing slides and everything comes back.
#[test]
fn no_hysteresis_below_the_limit() {
    let young = 1e6;
    let of_the_lighter_edge = LIMIT / (1.0 + MU * HEIGHT / WIDTH);
    let reach = 0.99 * of_the_lighter_edge / stiffness(young);
    for route in ROUTES {
        let outcome = solve(&cycle(shaken_block(young).route(route), reach, 3)).unwrap();
        assert_eq!(outcome.solve.status, Status::Solved);
        let history = outcome.history.as_ref().unwrap();
        assert!(history.dissipation() <= 1e-9 * history.work());
        let stored = outcome.state.as_ref().unwrap().strain_energy;
        assert_close(history.work(), stored, 1e-9);
    }
}

/// `W = U + D`, the better the shorter the steps, and `D` never falls.
#[test]
fn energy_is_accounted_for() {
    for route in [Route::Lemke, Route::Interior, Route::Qp, Route::Alm] {
        let rest = [16, 64].map(|steps| {
            let outcome = solve(&pushed(steps).route(route).tolerance(1e-9)).unwrap();
            assert_eq!(outcome.solve.status, Status::Solved, "{route:?}");
            let history = outcome.history.as_ref().unwrap();
            let least = -1e-12 * history.work().abs();
            assert!(history.records.iter().all(|record| record.dissipation >= least));
            let stored = outcome.state.as_ref().unwrap().strain_energy;
            assert!(history.dissipation() > 1e-3 * history.work());
            (history.work() - stored - history.dissipation()).abs() / history.work()
        });
        // A fourth with steps of a fourth, but for the steps in which points begin to slide.
        assert!(rest[1] < 0.4 * rest[0], "{rest:?}");
    }
}

/// What comes first matters with friction.
#[test]
fn the_order_of_loads() {
    let other_way = wall()
        .stage(Stage::new("both").steps(2).load("top", 1.0).load("side", 1.0))
        .stage(Stage::new("release").steps(2).load("side", 0.0));
    let left_in = |scene: &Scene| {
        let outcome = solve(scene).unwrap();
        assert_eq!(outcome.solve.status, Status::Solved);
        outcome.history.unwrap().dissipation()
    };
    let [one, other] = [pushed(2), other_way].map(|scene| left_in(&scene));
    assert!((one - other).abs() > 0.1 * one.max(other), "{one} {other}");
}

/// Without friction only the last state is computed: it does not depend on the way.
#[test]
fn without_friction_there_is_one_step() {
    let top = |name: &str, x: [f64; 2]| Load::pressure(name, [x[0], 0.4], [x[1], 0.4], 1e5);
    let column = Scene::new("Column in a shaft", Units::SI)
        .plane(Plane::Stress)
        .thickness(0.1)
        .material("stone", Material::elastic(1e8, 0.2))
        .joint("bed", Joint::mu(0.0))
        .wall(
            Wall::running_bond("column", "stone", Brick { length: 0.2, height: 0.2 }, 0.2, 1)
                .mesh([4, 4]),
        )
        .block(
            Block::new("upper", "stone", [[0.0, 0.2], [0.2, 0.2], [0.2, 0.4], [0.0, 0.4]])
                .mesh([4, 4]),
        )
        .support(Support::new("floor", [0.0, 0.0], [0.2, 0.0], "bed"))
        .support(Support::new("left", [0.0, 0.0], [0.0, 0.4], "bed"))
        .support(Support::new("right", [0.2, 0.0], [0.2, 0.4], "bed"))
        .load(top("left half", [0.0, 0.1]))
        .load(top("right half", [0.1, 0.2]));
    let both = |stage: Stage| stage.load("left half", 1.0).load("right half", 1.0);
    let staged = column
        .clone()
        .stage(both(Stage::new("both").steps(5)))
        .stage(Stage::new("half").steps(5).load("right half", 0.0));
    let outcome = solve(&staged).unwrap();
    assert_eq!((outcome.plan.steps, &outcome.history), (1, &None));
    let is_on = |name: &str| outcome.plan.effects.iter().any(|it| it.name == name && it.on);
    assert!(!is_on("load history") && !is_on("dissipation"));
    let mut at_once = column;
    at_once.loads.truncate(1);
    let at_once = solve(&at_once).unwrap();
    let [last, at_once] = [outcome, at_once].map(|it| it.state.unwrap());
    assert_close(last.strain_energy, at_once.strain_energy, 1e-12);
}

/// A stage of one step is the law of one step; one that changes nothing adds nothing.
#[test]
fn neutral_stages() {
    for route in ROUTES {
        let scene = wall().route(route);
        let plain = solve(&scene).unwrap();
        let load = |stage: Stage| stage.load("top", 1.0).load("side", 1.0);
        let one = solve(&scene.clone().stage(load(Stage::new("all")))).unwrap();
        assert_eq!(one.history, None);
        assert_eq!(one.reactions, plain.reactions);
        let waiting = scene.stage(load(Stage::new("all"))).stage(Stage::new("wait").steps(2));
        let waiting = solve(&waiting).unwrap();
        let history = waiting.history.as_ref().unwrap();
        assert_eq!(history.records.len(), 3);
        let first = &history.records[0];
        for record in &history.records[1..] {
            assert!(record.dissipation <= 1e-9 * first.dissipation, "{route:?}");
            assert_close(record.strain_energy, first.strain_energy, 1e-9);
        }
        let plain = plain.state.unwrap();
        for (one, other) in plain.contacts.iter().zip(&waiting.state.unwrap().contacts) {
            assert!((one.y_t - other.y_t).abs() < 1e-10 * first.largest_displacement);
        }
    }
}

/// A block between two frictional walls that are pressed together carries `2 mu H` and no more: the last
/// step that holds is kept.
#[test]
fn a_step_that_fails_keeps_the_one_before() {
    let (thrust, mu) = (1e3, 0.5);
    let scene = |route| {
        Scene::new("Held by friction", Units::SI)
            .thickness(1.0)
            .material("stone", Material::rigid())
            .joint("wall", Joint::mu(mu))
            .joint("slide", Joint::mu(0.0))
            .joint("head", Joint::mu(mu))
            .block(Block::new("held", "stone", [[0.0, 0.0], [0.4, 0.0], [0.4, 0.4], [0.0, 0.4]]))
            .block(Block::new("press", "stone", [[0.4, 0.0], [0.8, 0.0], [0.8, 0.4], [0.4, 0.4]]))
            .support(Support::new("left", [0.0, 0.0], [0.0, 0.4], "wall"))
            .support(Support::new("below", [0.4, 0.0], [0.8, 0.0], "slide"))
            .support(Support::new("above", [0.4, 0.4], [0.8, 0.4], "slide"))
            .load(Load::pressure("thrust", [0.8, 0.0], [0.8, 0.4], thrust / 0.4))
            .load(Load::traction("weight", [0.0, 0.4], [0.4, 0.4], [0.0, -1.01 * thrust / 0.4]))
            .route(route)
            .stage(Stage::new("press"))
            .stage(Stage::new("load").steps(10).load("weight", 1.0))
    };
    for route in [RouteSetting::Auto, Route::Lemke.into(), Route::Interior.into()] {
        let outcome = solve(&scene(route)).unwrap();
        assert_ne!(outcome.solve.status, Status::Solved, "{route:?}");
        let history = outcome.history.as_ref().unwrap();
        assert_eq!(history.records.len(), 10);
        let failed = history.failed.as_ref().unwrap();
        assert_eq!((failed.stage.as_str(), failed.number), ("load", 10));
        assert_close(outcome.reactions[0].fx, thrust, 1e-9);
        let carried: f64 = outcome.reactions.iter().map(|it| it.fy).sum();
        assert_close(carried, 0.9 * 1.01 * thrust, 1e-9);
        let report = masonry_report::table::report(&outcome);
        assert!(report.contains("Step 10 of 10 of stage \"load\" could not be solved"), "{report}");
    }
}

/// A floor that sinks and turns takes a block along, and changes no force; gravity comes as the stage says.
#[test]
fn a_floor_that_moves_takes_the_block_along() {
    let [l, h] = [1.0, 0.5];
    let scene = Scene::new("Block on a floor that moves", Units::SI)
        .plane(Plane::Stress)
        .thickness(1.0)
        .gravity([0.0, -10.0])
        .material("stone", Material::elastic(1e9, 0.2).density(2000.0))
        .joint("floor", Joint::mu(0.6))
        .block(Block::new("block", "stone", [[0.0, 0.0], [l, 0.0], [l, h], [0.0, h]]).mesh([4, 2]))
        .support(Support::new("floor", [0.0, 0.0], [l, 0.0], "floor"))
        .stage(Stage::new("weight").steps(2).gravity(1.0));
    let tilt = Movement { x: 0.01, y: -0.03, turn: 0.02 };
    for route in [Route::Lemke, Route::Interior, Route::Qp, Route::Alm] {
        let scene = scene.clone().route(route).tolerance(1e-9);
        let still = solve(&scene).unwrap();
        let moved = solve(&scene.stage(Stage::new("move").steps(3).moves("floor", tilt))).unwrap();
        for outcome in [&still, &moved] {
            assert_eq!(outcome.solve.status, Status::Solved, "{route:?}");
            let history = outcome.history.as_ref().unwrap();
            let weight = |step: usize| history.records[step].reactions[0].fy;
            assert_close(weight(0), 0.5 * 2000.0 * 10.0 * l * h, 1e-7);
            assert_close(outcome.reactions[0].fy, 2000.0 * 10.0 * l * h, 1e-7);
        }
        let floor = &moved.model.supports[0];
        let nodes = &still.model.blocks[0].mesh.as_ref().unwrap().nodes;
        let states = [&still, &moved].map(|it| &it.state.as_ref().unwrap().displacements[0]);
        for ((place, before), after) in nodes.iter().zip(states[0]).zip(states[1]) {
            let rest = after - before - floor.displacement_at(*place);
            assert!(rest.norm() < 1e-7 * 0.03, "{route:?} {rest}");
        }
    }
}
