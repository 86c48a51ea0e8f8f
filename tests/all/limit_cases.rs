//! Where one model is the limit of another, its answer is the limit of the other's answers, at the rate that
//! the parameter enters with.

use crate::common;

use common::routes::{OF_RIGID_BLOCKS, answer_by, solved_by};
use common::{M_KN, all_displacements, all_reactions, all_stresses, difference, rectangle, state};
use masonry::analysis::outcome::{Outcome, RouteAttempt};
use masonry::model::Plane;
use masonry::scene::{Brick, Joint, Load, Material, Route, Scene, Support, Wall};

/// Three courses of bricks 0.2 long, pushed a little to the side, in joints of this class.
fn wall(bricks: Material, joint: Joint, thickness: f64) -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    let (width, height) =
        (3.0 * (0.2 + thickness) - thickness, 3.0 * (0.1 + thickness) - thickness);
    Scene::new("Limit", M_KN)
        .plane(Plane::Stress)
        .thickness(0.25)
        .material("brick", bricks)
        .material("mortar", Material::elastic(8e5, 0.2))
        .joint("bed", joint.clone())
        .joint("head", joint)
        .joint("floor", Joint::mu(0.7))
        .wall(Wall::running_bond("wall", "brick", brick, width, 3).mesh([1, 1]))
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "floor"))
        .load(Load::pressure("top", [0.0, height], [width, height], 100.0))
        .load(Load::traction("side", [0.0, 0.0], [0.0, height], [20.0, 0.0]))
}

fn corners(outcome: &Outcome) -> Vec<f64> {
    let rows = state(outcome).displacements.iter();
    // Of a mesh of one element the nodes go row by row, the corners of a rigid block around it.
    let is_rigid = outcome.model.blocks[0].mesh.is_none();
    let order = if is_rigid { [0, 1, 3, 2] } else { [0, 1, 2, 3] };
    rows.flat_map(|nodes| order.map(|k| nodes[k])).flat_map(|u| [u.x, u.y]).collect()
}

/// Each error of the list is smaller than the one before by the power `order` of 10.
#[track_caller]
fn assert_rate(errors: &[f64], order: f64, of: &str) {
    for pair in errors.windows(2) {
        let rate = (pair[0] / pair[1]).log10();
        assert!((rate - order).abs() < 0.05, "{of}: rate {rate} in {errors:?}");
    }
}

/// Stiffnesses across and along differ by 1e10, more than reduced forms have digits for: the top sinks by `3 h p / E`.
#[test]
fn flat_bricks_are_refined_after_pivots() {
    const YOUNG: f64 = 1e6;
    const HEIGHT: f64 = 1e-5;
    let column = Scene::new("Flat bricks", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .material("stone", Material::elastic(YOUNG, 0.0))
        .joint("bed", Joint::mu(0.5))
        .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"))
        .load(Load::pressure("top", [0.0, 3.0 * HEIGHT], [1.0, 3.0 * HEIGHT], 1e-3 * YOUNG));
    let names = ["low", "middle", "high"];
    let column = names.iter().zip([0.0, 1.0, 2.0]).fold(column, |scene, (name, k)| {
        scene.block(
            rectangle(name, "stone", [0.0, 1.0], [k * HEIGHT, (k + 1.0) * HEIGHT]).mesh([4, 1]),
        )
    });
    let outcome = solved_by(&column, Route::Lemke);
    assert!(matches!(outcome.solve.attempts.last(), Some(RouteAttempt::Refinement { .. })));
    let sinks = -state(&outcome).displacements[2].iter().map(|u| u.y).fold(0.0, f64::min);
    assert!((sinks / (3e-3 * HEIGHT) - 1.0).abs() < 1e-9, "{sinks}");
}

/// Films give way, so that displacements and the forces of all films are unique for rigid bricks too. Those
/// of elastic bricks differ from them by the ratio of the stiffnesses.
#[test]
fn stiff_bricks_in_mortar_are_rigid() {
    let joint = Joint::mu(0.7).mortar(0.02, "mortar");
    // Sweeps take seconds, and are left to the long tests.
    let is_tried = |route: &Route| *route != Route::Pgs || cfg!(feature = "long-tests");
    for route in OF_RIGID_BLOCKS.into_iter().filter(is_tried) {
        let solved = |bricks: Material| answer_by(&wall(bricks, joint.clone(), 0.02), route);
        let Some(rigid) = solved(Material::rigid()) else { continue };
        let stiff = [1e9, 1e10, 1e11].map(|young| solved(Material::elastic(young, 0.15)));
        let stiff: Vec<Outcome> = stiff.into_iter().flatten().collect();
        assert!(route == Route::Pgs || stiff.len() == 3);
        let in_films = |outcome: &Outcome| -> Vec<f64> {
            state(outcome).films.iter().flat_map(|film| [film.sigma_y, film.tau]).collect()
        };
        let errors = |of: &dyn Fn(&Outcome) -> Vec<f64>| -> Vec<f64> {
            stiff.iter().map(|outcome| difference(&of(&rigid), &of(outcome))).collect()
        };
        assert_rate(&errors(&corners), 1.0, "displacements");
        assert_rate(&errors(&in_films), 1.0, "stresses of films");
    }
}

/// Sweeps stall in dry walls in bond, of which the forces around the ends of head joints are not unique, and
/// the augmented Lagrangian method treats no rigid bricks.
const EXACT: [Route; 3] = [Route::Lemke, Route::Interior, Route::Qp];

/// In a dry wall nothing but the bricks has a stiffness: forces and stresses do not depend on it, and
/// displacements are those of `E = 1` divided by it, down to the rest of rigid bricks.
#[test]
fn stiff_dry_bricks_come_to_rest() {
    for route in EXACT {
        let solved = |bricks| solved_by(&wall(bricks, Joint::mu(0.7), 0.0), route);
        let list = [1e5, 1e7, 1e9].map(|young| (young, solved(Material::elastic(young, 0.15))));
        let scaled = |(young, outcome): &(f64, Outcome)| -> Vec<f64> {
            all_displacements(outcome).iter().map(|u| u * young).collect()
        };
        for pair in list.windows(2) {
            let moved = difference(&scaled(&pair[0]), &scaled(&pair[1]));
            let stressed = difference(&all_stresses(&pair[0].1), &all_stresses(&pair[1].1));
            assert!(moved < 1e-8 && stressed < 1e-8, "{route:?}: {moved:e} and {stressed:e}");
        }
        let rigid = solved(Material::rigid());
        assert!(all_displacements(&rigid).iter().all(|u| u.abs() <= 0.0));
        for (_, outcome) in &list {
            let apart = difference(&all_reactions(&rigid), &all_reactions(outcome));
            assert!(apart < 1e-8, "{route:?}: {apart:e}");
        }
    }
}

/// Bricks in a box, pressed more on one half: what little friction there is takes a share of the load that is
/// proportional to it.
fn boxed(mu: f64) -> Scene {
    let [width, height] = [0.6, 0.3];
    let mut scene = wall(Material::elastic(1e6, 0.3), Joint::mu(mu), 0.0)
        .joint("floor", Joint::mu(mu))
        .support(Support::new("left", [0.0, 0.0], [0.0, height], "floor"))
        .support(Support::new("right", [width, 0.0], [width, height], "floor"))
        .load(Load::pressure("half", [0.0, height], [0.5 * width, height], 30.0));
    scene.loads.retain(|load| load.name != "side");
    scene
}

#[test]
fn without_friction_is_the_limit_of_little() {
    for route in EXACT {
        let smooth = solved_by(&boxed(0.0), route);
        assert_eq!(smooth.plan.frictional_points, 0);
        let rough = [1e-2, 1e-3, 1e-4].map(|mu| solved_by(&boxed(mu), route));
        let errors = |of: fn(&Outcome) -> Vec<f64>| {
            rough.each_ref().map(|outcome| difference(&of(&smooth), &of(outcome)))
        };
        assert_rate(&errors(all_displacements), 1.0, "displacements");
        assert_rate(&errors(all_stresses), 1.0, "stresses");
        assert_rate(&errors(|it| vec![state(it).strain_energy]), 1.0, "strain energy");
        let friction = |outcome: &Outcome| {
            state(outcome).contacts.iter().fold(0.0, |max: f64, it| max.max(it.t_t.abs()))
        };
        assert_rate(&rough.each_ref().map(friction), 1.0, "friction");
    }
}
