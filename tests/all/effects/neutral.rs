//! Effects that are called for with a neutral value: the answer is that without them.

use super::common::routes::{ROUTES, answer_by, rounding, routes_for};
use super::common::{
    all_displacements, all_reactions, all_stresses, assert_close, difference, state,
};
use super::scenes::{boxed, column, elastic, in_mortar, piers, stack};
use super::{built, effect};
use masonry::analysis::outcome::Outcome;
use masonry::scene::{Films, Joint, Load, Material, Movement, Route, Scene, Stage};
use masonry_report::summary::total_reaction;

/// What is unique: of a corner between two supports any part of the force may be shifted from one to the other.
fn figures(outcome: &Outcome) -> [Vec<f64>; 4] {
    let total = total_reaction(outcome);
    let reaction = vec![total.force.x, total.force.y, total.moment];
    let energy = vec![state(outcome).strain_energy];
    [reaction, all_displacements(outcome), all_stresses(outcome), energy]
}

/// Both scenes have the same answer on every route, the one with the effect, the other without.
#[track_caller]
fn assert_neutral(name: &str, without: &Scene, with: &Scene) {
    for route in routes_for(with) {
        let [off, on] = [without, with].map(|scene| built(scene, route).0);
        assert!(!effect(&off, name).on && effect(&on, name).on, "{name}");
        let Some((a, b)) = answer_by(without, route).zip(answer_by(with, route)) else { continue };
        for (k, (a, b)) in figures(&a).iter().zip(figures(&b)).enumerate() {
            let apart = difference(a, &b);
            assert!(apart <= rounding(route), "{name}, {route:?}, figure {k}: {apart:e}");
        }
    }
}

/// The list of effects that each test below is about; an effect that is new has to be put to the test.
#[test]
fn every_effect_has_a_test() {
    let tested = [
        "contact",
        "friction",
        "cohesion",
        "tension",
        "joint stiffness",
        "mortar films",
        "longitudinal film terms",
        "deformation",
        "self weight",
        "edge loads",
        "point loads",
        "body acceleration",
        "stresses",
        "dense matrices",
        "load history",
        "support movements",
        "dissipation",
    ];
    let (plan, ..) = built(&stack(elastic(), Joint::mu(0.6)), Route::Lemke);
    let names: Vec<&str> = plan.effects.iter().map(|effect| effect.name).collect();
    assert_eq!(names, tested);
}

/// Bricks that do not swell under an even pressure rub on nothing; and what friction of 1e-12 carries is no
/// more than that share of the load.
#[test]
fn friction_that_is_not_needed() {
    let even = |joint| {
        let mut scene = boxed(Material::elastic(1e6, 0.0), joint).gravity([0.0, 0.0]);
        scene.loads[0].pressure = Some(100.0.into());
        scene
    };
    assert_neutral("friction", &even(Joint::mu(0.0)), &even(Joint::mu(0.6)));
    let pressed = |mu| boxed(elastic(), Joint::mu(mu));
    assert_neutral("friction", &pressed(0.0), &pressed(1e-12));
}

/// Where every joint is pressed and nothing rubs, strength is not needed.
#[test]
fn strength_that_is_not_needed() {
    let pressed = |joint| column(Material::elastic(1e6, 0.0), joint, 0.0);
    let plain = pressed(Joint::mu(0.6));
    assert_neutral("cohesion", &plain, &pressed(Joint::mu(0.6).cohesion(60.0)));
    assert_neutral("tension", &plain, &pressed(Joint::mu(0.6).cohesion(60.0).tension(50.0)));
}

/// A film gives way by its thickness, against that of the bricks, and so does what it changes. Programs come to
/// no end with films that are stiffer than bricks by more than 1e9.
#[test]
fn films_that_are_too_thin_to_give_way() {
    for route in ROUTES {
        let thickness = if route == Route::Qp { 1e-9 } else { 1e-12 };
        let dry = column(elastic(), Joint::mu(0.6), 0.0);
        let thin = column(elastic(), Joint::mu(0.6).mortar(thickness, "mortar"), thickness);
        let Some((dry, thin)) = answer_by(&dry, route).zip(answer_by(&thin, route)) else {
            continue;
        };
        assert!(!effect(&dry.plan, "mortar films").on && effect(&thin.plan, "mortar films").on);
        for (a, b) in figures(&dry).iter().zip(figures(&thin)) {
            let apart = difference(a, &b);
            assert!(apart <= thickness / 0.1 + rounding(route), "{route:?}: {apart:e}");
        }
    }
}

/// A joint gives way by its stiffness, against that of the bricks, and so does what it changes: it has no neutral value
/// but to be left out. Programs come to no end with joints that are stiffer than bricks by more than 1e9.
#[test]
fn joints_that_are_too_stiff_to_give_way() {
    // Young's modulus of the bricks by their height.
    let bricks = 1e6 / 0.1;
    for route in ROUTES {
        let ratio = if route == Route::Qp { 1e-8 } else { 1e-11 };
        let stiffness = [bricks / ratio; 2];
        let plain = column(elastic(), Joint::mu(0.6), 0.0);
        let stiff = column(elastic(), Joint::mu(0.6).stiffness(stiffness), 0.0);
        let Some((plain, stiff)) = answer_by(&plain, route).zip(answer_by(&stiff, route)) else {
            continue;
        };
        let name = "joint stiffness";
        assert!(!effect(&plain.plan, name).on && effect(&stiff.plan, name).on);
        for (a, b) in figures(&plain).iter().zip(figures(&stiff)) {
            let apart = difference(a, &b);
            assert!(apart <= ratio + rounding(route), "{route:?}: {apart:e}");
        }
    }
}

/// Bricks and mortar that do not swell stretch no film.
#[test]
fn films_that_are_not_stretched() {
    let films = |films| {
        let scene = in_mortar(Material::elastic(1e6, 0.0), films);
        scene.material("mortar", Material::elastic(8e5, 0.0))
    };
    let (off, on) = (films(Films::Compliance), films(Films::Strips));
    assert_neutral("longitudinal film terms", &off, &on);
}

/// No elastic block is as good as rigid: displacements and stresses there are, and the rest of rigid blocks is
/// a limit. But what statics alone decides does not depend on how the blocks give way.
#[test]
fn deformation_moves_no_reaction() {
    let scene = |bricks| stack(bricks, Joint::mu(0.6));
    for route in routes_for(&scene(Material::rigid())) {
        let rigid = answer_by(&scene(Material::rigid()), route);
        let soft = answer_by(&scene(Material::elastic(1e4, 0.3)), route);
        let Some((rigid, soft)) = rigid.zip(soft) else { continue };
        assert!(!effect(&rigid.plan, "deformation").on && effect(&soft.plan, "deformation").on);
        let apart = difference(&all_reactions(&rigid), &all_reactions(&soft));
        assert!(apart <= rounding(route), "{route:?}: {apart:e}");
    }
}

/// Weight in a stage that takes gravity away, and a load that is taken away, both in one step.
#[test]
fn loads_of_factor_zero() {
    let joint = Joint::mu(0.6);
    let plain = column(elastic(), joint.clone(), 0.0);
    let heavy = stack(elastic().density(1800.0), joint);
    let none = Stage::new("none").gravity(0.0).load("push", 0.0);
    assert_neutral("self weight", &plain, &heavy.clone().stage(none));
    for route in ROUTES {
        let (plan, ..) = built(&heavy, route);
        assert!(effect(&plan, "edge loads").on && effect(&plan, "edge loads").unknowns == 0);
    }
}

/// A force at a place of a block, and an acceleration of all mass, of the factor zero.
#[test]
fn forces_and_accelerations_of_factor_zero() {
    let plain = stack(elastic().density(1800.0), Joint::mu(0.6));
    let beam = Load::force("beam", "upper", [0.07, 0.24], [3.0, -20.0]).factor(0.0);
    assert_neutral("point loads", &plain, &plain.clone().load(beam));
    let quake = Load::acceleration("quake", [1.0, 2.0]).factor(0.0);
    assert_neutral("body acceleration", &plain, &plain.clone().load(quake));
}

/// Loads that grow together from nothing, in a structure without gaps, slide only on: every step is the same
/// answer, larger.
#[test]
fn steps_that_only_go_on() {
    let joint = Joint::mu(0.3);
    let at_once = boxed(elastic(), joint);
    let grow = |steps| Stage::new("grow").steps(steps).gravity(1.0).load("top", 1.0);
    let in_steps = at_once.clone().stage(grow(4)).stage(Stage::new("wait"));
    for name in ["load history", "dissipation"] {
        assert_neutral(name, &at_once, &in_steps);
    }
}

/// Supports that go to where they are, and supports that all go the same way and take all blocks along.
#[test]
fn supports_that_move_nothing() {
    let scene = stack(elastic(), Joint::mu(0.6));
    let moved = |movement| scene.clone().stage(Stage::new("move").moves("floor", movement));
    let stay = moved(Movement::default());
    let go = Movement::by(2e-4, -1e-4);
    for route in ROUTES {
        assert!(!effect(&built(&stay, route).0, "support movements").on);
        assert!(effect(&built(&moved(go), route).0, "support movements").on);
        let answers = [&scene, &stay, &moved(go)].map(|scene| answer_by(scene, route));
        let [Some(plain), Some(stay), Some(gone)] = answers else { continue };
        for (a, b) in figures(&plain).iter().zip(figures(&stay)) {
            assert!(difference(a, &b) <= 0.0, "{route:?}");
        }
        let taken: Vec<f64> =
            all_displacements(&plain).chunks(2).flat_map(|u| [u[0] + go.x, u[1] + go.y]).collect();
        let [reaction, _, stresses, energy] = figures(&plain);
        for (a, b) in [reaction, taken, stresses, energy].iter().zip(figures(&gone)) {
            let apart = difference(a, &b);
            assert!(apart <= rounding(route), "{route:?}: {apart:e}");
        }
    }
}

/// Rows of a pair that stays open carry nothing.
#[test]
fn pairs_that_stay_open() {
    let (far, near) = (piers(0.0), piers(0.011));
    for route in ROUTES {
        let Some((far, near)) = answer_by(&far, route).zip(answer_by(&near, route)) else {
            continue;
        };
        assert!(near.plan.contact_points > far.plan.contact_points);
        for (a, b) in figures(&far).iter().zip(figures(&near)) {
            let apart = difference(a, &b);
            assert!(apart <= rounding(route), "{route:?}: {apart:e}");
        }
        let between = near.model.contacts.iter().zip(&state(&near).contacts);
        for (_, contact) in between.filter(|(point, _)| point.a.is_some()) {
            assert!(contact.t_n.abs() <= 0.0, "{route:?}: {contact:?}");
            assert_close(contact.y_n, 0.01, 0.01);
        }
    }
}
