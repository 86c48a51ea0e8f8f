//! The judge of states says no to answers in which one number is wrong by a thousandth of itself, or which break one
//! law only; of light blocks beside heavy ones too.

use crate::common;

use common::routes::{answer_by, routes_for, solved_by};
use common::{GRAVITY, M_KN, block_named, rectangle, solved, state};
use masonry::analysis::outcome::{Outcome, State};
use masonry::model::Plane;
use masonry::scene::{Brick, Joint, Load, Material, Movement, Scene, Stage, Support, Wall};
use masonry::verify::checks::Checks;
use nalgebra::Vector2;

/// The part of itself by which a number is made wrong.
const WRONG: f64 = 1e-3;
/// How much heavier a heavy block is.
const HEAVY: f64 = 1e6;
/// The loosest tolerance that tests ask routes for.
const LOOSEST: f64 = 1e-8;

fn scene(mu: f64) -> Scene {
    Scene::new("Judged", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .gravity([0.1 * GRAVITY, -GRAVITY])
        .joint("bed", Joint::mu(mu))
        .joint("head", Joint::mu(mu))
}

fn wall(material: Material, joint: Joint) -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    scene(0.5)
        .joint("bed", joint)
        .material("brick", material.density(2000.0))
        .wall(Wall::running_bond("wall", "brick", brick, 0.6, 3).mesh([2, 1]))
        .support(Support::new("floor", [0.0, 0.0], [0.6, 0.0], "bed"))
        .load(Load::pressure("top", [0.0, 0.3], [0.6, 0.3], 10.0))
}

/// A light block at the foot of a heavy one, which leans on it.
fn side_by_side(material: Material) -> Scene {
    scene(0.3)
        .gravity([0.0, -GRAVITY])
        .material("light", material.density(2000.0))
        .material("heavy", material.density(2000.0 * HEAVY))
        .block(rectangle("light", "light", [0.0, 1.0], [0.0, 1.0]).mesh([2, 2]))
        .block(rectangle("heavy", "heavy", [1.0, 2.0], [0.0, 1.0]).mesh([2, 2]))
        .support(Support::new("floor", [0.0, 0.0], [2.0, 0.0], "bed"))
}

/// A light block on a heavy one, in a wind.
fn on_top(material: Material) -> Scene {
    scene(0.3)
        .material("light", material.density(2000.0))
        .material("heavy", material.density(2000.0 * HEAVY))
        .block(rectangle("heavy", "heavy", [0.0, 1.0], [0.0, 1.0]).mesh([2, 2]))
        .block(rectangle("light", "light", [0.0, 1.0], [1.0, 2.0]).mesh([2, 2]))
        .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"))
}

fn elastic() -> Material {
    Material::elastic(1e6, 0.15)
}

fn judged(outcome: &Outcome, change: impl Fn(&mut State)) -> Checks {
    let mut changed = state(outcome).clone();
    change(&mut changed);
    Checks::of(&outcome.model, &changed)
}

#[track_caller]
fn assert_refused(outcome: &Outcome, what: &str, change: impl Fn(&mut State)) {
    let checks = judged(outcome, change);
    assert!(!checks.hold(LOOSEST), "{}, {what}: {checks:?}", outcome.title);
}

/// The largest contact force on a block.
fn largest_on(outcome: &Outcome, block: usize) -> f64 {
    let both = outcome.model.contacts.iter().zip(&state(outcome).contacts);
    let touches = both.filter(|(contact, _)| {
        [Some(contact.b), contact.a].into_iter().flatten().any(|it| it.block.index() == block)
    });
    touches.map(|(_, it)| it.t_n.hypot(it.t_t)).fold(0.0, f64::max)
}

/// Every contact force that is more than a rounding error of the others on the lighter block.
#[track_caller]
fn assert_forces_are_judged(outcome: &Outcome) {
    assert!(judged(outcome, |_| {}).hold(LOOSEST));
    for (k, contact) in outcome.model.contacts.iter().enumerate() {
        let blocks = [Some(contact.b), contact.a].into_iter().flatten();
        let least = blocks.map(|it| largest_on(outcome, it.block.index())).fold(f64::MAX, f64::min);
        let it = state(outcome).contacts[k];
        if it.t_n.abs() > 1e-3 * least {
            assert_refused(outcome, &format!("t_n of {k}"), |state| {
                state.contacts[k].t_n *= 1.0 + WRONG;
            });
        }
        if it.t_t.abs() > 1e-3 * least {
            assert_refused(outcome, &format!("t_t of {k}"), |state| {
                state.contacts[k].t_t *= 1.0 - WRONG;
            });
        }
        assert_refused(outcome, &format!("no number at {k}"), |state| {
            state.contacts[k].t_n = f64::NAN;
        });
    }
}

/// Every displacement that is more than a rounding error of the others of its block.
#[track_caller]
fn assert_displacements_are_judged(outcome: &Outcome) {
    for (block, moved) in state(outcome).displacements.iter().enumerate() {
        let largest = moved.iter().map(Vector2::norm).fold(0.0, f64::max);
        for (node, u) in moved.iter().enumerate() {
            for axis in [0, 1] {
                if u[axis].abs() > 1e-3 * largest {
                    assert_refused(outcome, &format!("{axis} of {node} of {block}"), |state| {
                        state.displacements[block][node][axis] *= 1.0 + WRONG;
                    });
                }
            }
        }
    }
}

#[test]
fn a_thousandth_of_a_force_or_displacement() {
    let strong = Joint::mu(0.5).cohesion(40.0).tension(20.0);
    for joint in [Joint::mu(0.5), strong] {
        let outcome = solved(&wall(elastic(), joint.clone()));
        assert_forces_are_judged(&outcome);
        assert_displacements_are_judged(&outcome);
        assert_forces_are_judged(&solved(&wall(Material::rigid(), joint)));
    }
    for scene in [side_by_side, on_top] {
        let outcome = solved(&scene(elastic()));
        assert_forces_are_judged(&outcome);
        assert_displacements_are_judged(&outcome);
        assert_forces_are_judged(&solved(&scene(Material::rigid())));
    }
}

/// A block that nothing carries, beside one that weighs much more than rounding lets them be compared.
#[test]
fn a_light_block_that_hovers() {
    for times in [1.0, 1e3, HEAVY, 1e9, 1e12, 1e15] {
        for material in [elastic(), Material::rigid()] {
            let mut scene = side_by_side(material);
            scene.materials.get_mut("heavy").unwrap().density = Some(2000.0 * times);
            let outcome = masonry::analysis::solve::solve(&scene).unwrap();
            if outcome.solve.status != lcp::Status::Solved {
                assert!(times > HEAVY, "{times:e}: {:?}", outcome.solve.attempts);
                continue;
            }
            let light = block_named(&outcome.model, "light");
            let carries = |k: usize| {
                let contact = &outcome.model.contacts[k];
                contact.b.block == light || contact.a.is_some_and(|a| a.block == light)
            };
            assert_refused(&outcome, &format!("{times:e}"), |state| {
                for (k, contact) in state.contacts.iter_mut().enumerate() {
                    if carries(k) {
                        (contact.t_n, contact.t_t) = (0.0, 0.0);
                    }
                }
            });
        }
    }
}

/// All blocks moved by a part of the largest displacement: no force changes.
fn moved(outcome: &Outcome, by: Vector2<f64>) -> Checks {
    let all = state(outcome).displacements.iter().flatten();
    let largest = all.map(Vector2::norm).fold(0.0, f64::max);
    judged(outcome, |state| {
        state.displacements.iter_mut().flatten().for_each(|u| *u += by * largest);
    })
}

#[test]
fn forces_across_gaps_and_sliding_below_the_bound() {
    for joint in [Joint::mu(0.5), Joint::mu(0.5).cohesion(40.0).tension(20.0)] {
        let outcome = solved(&wall(elastic(), joint));
        let up = moved(&outcome, Vector2::new(0.0, WRONG));
        assert!(up.complementarity > 1e-4 && up.penetration < 1e-9, "{up:?}");
        let aside = moved(&outcome, Vector2::new(WRONG, 0.0));
        assert!(aside.complementarity > 1e-4 && aside.penetration < 1e-9, "{aside:?}");
        let into = moved(&outcome, Vector2::new(0.0, -WRONG));
        assert!(into.penetration > 1e-4, "{into:?}");
        for checks in [&up, &aside, &into] {
            assert!(checks.force_balance < 1e-9 && checks.nodal_balance < 1e-9, "{checks:?}");
            assert!(!checks.hold(LOOSEST));
        }
    }
}

/// Strain energy is a number of the state like others.
#[test]
fn energy_that_is_not_there() {
    let outcome = solved(&wall(elastic(), Joint::mu(0.5)));
    assert_refused(&outcome, "energy", |state| state.strain_energy *= 1.0 + WRONG);
}

/// Corners of a rigid block that part from each other.
#[test]
fn rigid_blocks_keep_their_shape() {
    let gap = rectangle("block", "stone", [0.0, 1.0], [1e-3, 0.5]);
    let mut scene = scene(0.5)
        .material("stone", Material::rigid().density(2000.0))
        .block(gap)
        .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"));
    scene.contact.gap_limit = 2e-3;
    let outcome = solved(&scene);
    assert_displacements_are_judged(&outcome);
}

/// What slides in a step is not what has slid before it.
#[test]
fn slip_of_a_step_is_judged() {
    let history = scene(0.5)
        .gravity([0.0, -GRAVITY])
        .material("stone", elastic().density(2000.0))
        .joint("stop", Joint::mu(0.0))
        .block(rectangle("block", "stone", [0.0, 1.0], [0.0, 0.5]).mesh([2, 1]))
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "bed"))
        .support(Support::new("stop", [1.0, 0.0], [1.0, 0.5], "stop"))
        .stage(Stage::new("weight"))
        .stage(Stage::new("draw").steps(2).moves("floor", Movement::by(0.01, 0.0)))
        .stage(Stage::new("back").moves("floor", Movement::by(0.0099, 0.0)));
    let outcome = solved(&history);
    assert!(judged(&outcome, |_| {}).hold(LOOSEST));
    assert_forces_are_judged(&outcome);
    let aside = moved(&outcome, Vector2::new(WRONG, 0.0));
    assert!(!aside.hold(LOOSEST), "{aside:?}");
}

/// What every route calls an equilibrium is one, to what it was asked for.
#[test]
fn answers_of_all_routes_hold() {
    for scene in [wall(elastic(), Joint::mu(0.5)), wall(Material::rigid(), Joint::mu(0.5))] {
        for route in routes_for(&scene) {
            assert_forces_are_judged(&solved_by(&scene, route));
        }
    }
}

/// A rigid block at rest beside one that drops: where it is, is known to parts of the drop.
#[test]
fn a_block_at_rest_beside_one_that_drops() {
    for material in [Material::rigid(), elastic()] {
        let mut scene = scene(0.5)
            .material("stone", material.density(2000.0))
            .block(rectangle("rests", "stone", [0.0, 1.0], [0.0, 0.5]).mesh([2, 1]))
            .block(rectangle("drops", "stone", [1.0, 2.0], [1e-3, 0.5]).mesh([2, 1]))
            .support(Support::new("floor", [0.0, 0.0], [2.0, 0.0], "bed"));
        scene.contact.gap_limit = 2e-3;
        for route in routes_for(&scene) {
            if let Some(outcome) = answer_by(&scene, route) {
                assert_forces_are_judged(&outcome);
            }
        }
    }
}
