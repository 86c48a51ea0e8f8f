//! Cohesion and tensile strength of joints, against answers in closed form, by every route.

use crate::common;

use common::routes::{routes_for, solved_by};
use common::{GRAVITY, M_KN, assert_admissible, assert_close, rectangle};
use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::data::verdict::{Evidence, Verdict};
use masonry::model::Plane;
use masonry::scene::{Joint, Load, Material, Movement, Route, Scene, Stage, Support};

/// Width, height and thickness of the block \[m\], its weight \[kN\] and its joint: mu, cohesion and tensile
/// strength \[kN/m2\].
const B: f64 = 0.8;
const H: f64 = 0.5;
const W: f64 = 2.0 * GRAVITY * B * H;
const MU: f64 = 0.6;
const C: f64 = 30.0;
const F_T: f64 = 20.0;

/// Nearer to a limit than this part of it nothing is decided.
const NEAR: f64 = 1e-4;

fn materials() -> [Material; 2] {
    [Material::rigid(), Material::elastic(1e7, 0.2)].map(|material| material.density(2000.0))
}

/// One block that is as thick as a metre, on a floor.
fn block(material: Material, joint: Joint) -> Scene {
    Scene::new("A block and its joint", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .gravity([0.0, -GRAVITY])
        .material("stone", material)
        .joint("bed", joint)
        .block(rectangle("block", "stone", [0.0, B], [0.0, H]).mesh([2, 2]))
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "bed"))
}

fn strong() -> Joint {
    Joint::mu(MU).cohesion(C).tension(F_T)
}

/// A horizontal force \[kN\] at the foot of the block, spread over its lowest fifth.
fn pushed(scene: Scene, force: f64) -> Scene {
    let foot = 0.2 * H;
    scene.load(Load::traction("push", [0.0, 0.0], [0.0, foot], [force / foot, 0.0]))
}

/// A vertical force \[kN\] upwards on the part of the top between two places.
fn pulled(scene: Scene, force: f64, [from, to]: [f64; 2]) -> Scene {
    scene.load(Load::traction("pull", [from, H], [to, H], [0.0, force / (to - from)]))
}

/// Stands just below a limit by every route, and falls just above it, which is proved.
#[track_caller]
fn assert_limit(of: impl Fn(f64) -> Scene, limit: f64) {
    let below = of(limit * (1.0 - NEAR));
    for route in routes_for(&below) {
        // Multipliers converge too slowly at a limit.
        let at = if route == Route::Alm { of(0.9 * limit) } else { below.clone() };
        let outcome = solved_by(&at, route);
        assert_eq!(outcome.judgement.verdict, Verdict::Stands, "{route:?}");
    }
    assert_eq!(solve(&below).unwrap().judgement.verdict, Verdict::Stands);
    let above = of(limit * (1.0 + NEAR));
    let proved = solve(&above).unwrap();
    assert_eq!(proved.judgement.verdict, Verdict::Falls, "{:#?}", proved.solve.attempts);
    assert_eq!(proved.judgement.evidence, Evidence::NoAdmissibleForces);
    assert_admissible(&proved);
    for route in routes_for(&above) {
        let outcome = solve(&above.clone().route(route)).unwrap();
        assert_ne!(outcome.solve.status, Status::Solved, "{route:?}");
    }
}

#[test]
fn friction_and_cohesion_hold_mu_n_and_c_a() {
    for material in materials() {
        let joint = || Joint::mu(MU).cohesion(C);
        assert_limit(|force| pushed(block(material, joint()), force), MU * W + C * B);
    }
}

#[test]
fn cohesion_without_friction_holds_c_a() {
    for material in materials() {
        let joint = || Joint::mu(0.0).cohesion(C);
        assert_limit(|force| pushed(block(material, joint()), force), C * B);
    }
}

#[test]
fn tensile_strength_changes_nothing_of_what_sliding_takes() {
    for material in materials() {
        assert_limit(|force| pushed(block(material, strong()), force), MU * W + C * B);
    }
}

#[test]
fn a_pulled_block_holds_its_weight_and_f_t_a() {
    for material in materials() {
        assert_limit(|force| pulled(block(material, strong()), force, [0.0, B]), W + F_T * B);
    }
}

/// About the far end, the tensile strength of the whole bed and the weight have the arm `B / 2`, the pull `B / 2 + e`.
#[test]
fn an_eccentric_pull_holds_less() {
    let length = 0.2;
    for material in materials() {
        for middle in [0.5 * B, 0.6 * B, 0.8 * B] {
            let part = [middle - 0.5 * length, middle + 0.5 * length];
            assert_limit(
                |force| pulled(block(material, strong()), force, part),
                (W + F_T * B) * 0.5 * B / middle,
            );
        }
    }
}

/// A horizontal force at the top turns the block about its toe.
#[test]
fn a_tall_block_rocks_against_weight_and_tensile_strength() {
    let limit = (W + F_T * B) * 0.5 * B / (0.9 * H);
    assert!(limit < MU * W + C * B, "it does not slide before");
    for material in materials() {
        let at = |force: f64| {
            let traction = [force / (0.2 * H), 0.0];
            block(material, strong()).load(Load::traction(
                "push",
                [0.0, 0.8 * H],
                [0.0, H],
                traction,
            ))
        };
        assert_limit(at, limit);
    }
}

/// The forces at the limit are those of the law: everything slides.
#[test]
fn forces_are_those_of_the_law() {
    for material in materials() {
        let scene = pulled(pushed(block(material, strong()), 12.0), 0.5 * F_T * B, [0.0, B]);
        for route in routes_for(&scene) {
            let outcome = solved_by(&scene, route);
            let [reaction] = &outcome.reactions[..] else { panic!("one support") };
            let near = if route == Route::Alm { 1e-6 } else { 1e-8 };
            assert_close(reaction.fx, -12e3, near * 12e3);
            assert_close(reaction.fy, (W - 0.5 * F_T * B) * 1e3, near * W * 1e3);
            assert!(reaction.fy < 0.0, "the floor holds the block down");
            let state = outcome.state.as_ref().unwrap();
            for (point, force) in outcome.model.contacts.iter().zip(&state.contacts) {
                assert!(point.law.violation(force.t_n, force.t_t) <= near * W * 1e3);
            }
        }
    }
}

/// A bar that is pulled by less than its strength is stretched by `P H / (E B)`.
#[test]
fn a_closed_joint_passes_tension_on() {
    let material = Material::elastic(1e7, 0.0);
    let scene = pulled(block(material, strong()), 10.0, [0.0, B]).gravity([0.0, 0.0]);
    for route in routes_for(&scene) {
        let outcome = solved_by(&scene, route);
        let state = outcome.state.as_ref().unwrap();
        let top = state.displacements[0].iter().map(|u| u.y).fold(0.0, f64::max);
        assert_close(top, 10.0 * H / (1e7 * B), 1e-6 * 10.0 * H / (1e7 * B));
    }
}

/// Of a scene without them, the keys with zeros change no digit.
#[test]
fn without_strength_nothing_changes() {
    let text = |outcome: &Outcome| {
        let state = outcome.state.as_ref().unwrap();
        format!("{:?} {:?} {:?}", state.displacements, state.contacts, outcome.plan)
    };
    for material in materials() {
        let of = |joint: Joint| pushed(block(material, joint), 0.5 * MU * W);
        let neutral = of(Joint::mu(MU).cohesion(0.0).tension(0.0));
        for route in routes_for(&neutral) {
            let [plain, neutral] =
                [of(Joint::mu(MU)), neutral.clone()].map(|scene| solved_by(&scene, route));
            assert_eq!(text(&plain), text(&neutral), "{route:?}");
        }
    }
}

#[test]
fn the_plan_says_what_strength_costs() {
    let plan = |joint: Joint, route: Route| {
        let scene = block(Material::elastic(1e7, 0.2), joint).route(route);
        let model = masonry::model::Model::from_scene(&scene).unwrap();
        masonry::plan::Plan::of(&scene, &model)
    };
    for route in [Route::Lemke, Route::Interior] {
        let (plain, strong) = (plan(Joint::mu(MU), route), plan(strong(), route));
        let cohesion = strong.effects.iter().find(|effect| effect.name == "cohesion").unwrap();
        assert!(cohesion.on);
        assert_eq!(strong.order - plain.order, cohesion.unknowns);
        // A point, its friction and a displacement on the sparse routes; nothing by pivots.
        let more = if route == Route::Lemke { 0 } else { 4 * strong.contact_points };
        assert_eq!(cohesion.unknowns, more);
        for name in ["cohesion", "tension"] {
            assert!(plain.effects.iter().any(|effect| effect.name == name && !effect.on));
            assert!(strong.effects.iter().any(|effect| effect.name == name && effect.on));
        }
    }
}

/// A block that a floor is drawn away from is held until the strength of the bed is reached, then it falls behind;
/// what opening takes is in the account of energy.
#[test]
fn opening_takes_energy() {
    let drop = 1e-3;
    let joint = || Joint::mu(0.0).tension(0.2 * W / B);
    let scene = block(Material::elastic(1e5, 0.0).density(2000.0), joint())
        .support(Support::new("ceiling", [-1.0, H], [2.0, H], "glue"))
        .joint("glue", Joint::mu(0.0).tension(100.0 * W / B))
        .joint("bed", Joint::mu(0.1).cohesion(10.0 * W).tension(0.2 * W / B))
        .stage(Stage::new("weight"))
        .stage(Stage::new("draw").steps(80).moves("floor", Movement::by(0.0, -drop)));
    for route in [Route::Interior, Route::Lemke, Route::Qp] {
        let outcome = solved_by(&scene.clone().route(route), route);
        let history = outcome.history.as_ref().unwrap();
        let energy = outcome.state.as_ref().unwrap().strain_energy;
        let (work, taken) = (history.work(), history.dissipation());
        assert!(taken > 0.0, "{route:?}");
        let size = work.abs().max(energy).max(taken);
        assert!((work - energy - taken).abs() < 0.01 * size, "{route:?}: {work} {energy} {taken}");
    }
}
