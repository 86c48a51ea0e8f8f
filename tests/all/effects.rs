//! Effects are simulated only where a scene calls for them: what it does not call for is not built, and an
//! effect that is called for with its neutral value changes nothing but the unknowns that the plan says.
//!
//! Strips, whose terms along the joint are an effect too, are in `strips.rs`; limits by which one model comes
//! near another in `limit_cases.rs`; one step of a load history, and steps that change nothing, in `history.rs`.

use crate::common;
mod memory;
mod neutral;
mod plan;
mod scenes;

use std::ops::ControlFlow;

use common::routes::{ROUTES, answer_by, routes_for};
use common::state;
use masonry::analysis::solve::{Run, solve};
use masonry::forms::reduction::Reduction;
use masonry::forms::{DenseForm, FormKind, Sparse};
use masonry::model::{Model, PlacedSupport};
use masonry::plan::{Effect, Plan};
use masonry::scene::{Films, Joint, Material, Movement, Route, Scene};
use masonry::system::{Direction, System};
use scenes::{boxed, elastic, piers};

/// The plan of the scene by a route, its model and its system.
fn built(scene: &Scene, route: Route) -> (Plan, Model, System) {
    let model = Model::from_scene(scene).unwrap();
    let plan = Plan::of(&scene.clone().route(route), &model);
    let system = System::new(&model).unwrap();
    (plan, model, system)
}

fn effect<'a>(plan: &'a Plan, name: &str) -> &'a Effect {
    plan.effects.iter().find(|effect| effect.name == name).unwrap()
}

#[test]
fn rigid_blocks_have_no_mesh_no_stiffness_and_no_stress() {
    let scene = boxed(Material::rigid(), Joint::mu(0.6));
    for route in ROUTES {
        let (plan, model, system) = built(&scene, route);
        for name in ["deformation", "stresses"] {
            assert!(!effect(&plan, name).on && effect(&plan, name).unknowns == 0, "{name}");
        }
        assert_eq!((plan.nodes, plan.largest_block), (0, 0));
        assert!(model.blocks.iter().all(|block| block.mesh.is_none()));
        assert!(system.stiffnesses.is_empty());
        let is_bare = |body: &masonry::system::BodySystem| {
            body.stiffness.is_none()
                && body.load.is_empty()
                && body.rows.iter().all(|row| row.entries.is_empty())
        };
        assert!(system.bodies.iter().all(is_bare));
        let sparse = Sparse::new(&system).unwrap().problem;
        assert_eq!(sparse.displacements(), plan.rigid_modes);
        assert_eq!(sparse.stiffness().compute_nnz(), 0);
    }
    let (_, _, system) = built(&scene, Route::Lemke);
    let reduction = Reduction::new(&system, None).unwrap();
    assert_eq!(reduction.a.nrows(), 0);
    for route in routes_for(&scene) {
        let Some(outcome) = answer_by(&scene, route) else { continue };
        assert!(state(&outcome).stresses.is_empty());
    }
    let (plan, model, system) = built(&boxed(elastic(), Joint::mu(0.6)), Route::Lemke);
    assert!(effect(&plan, "deformation").on && effect(&plan, "stresses").on);
    assert!(model.blocks.iter().all(|block| block.mesh.is_some()));
    assert_eq!(system.stiffnesses.len(), 2, "of a whole and of a half brick");
}

#[test]
fn joints_without_friction_have_no_tangential_rows() {
    for material in [Material::rigid(), elastic()] {
        for route in ROUTES {
            let (plan, model, system) = built(&boxed(material, Joint::mu(0.0)), route);
            assert!(!effect(&plan, "friction").on && effect(&plan, "friction").unknowns == 0);
            let points = model.contacts.len();
            assert_eq!((plan.frictional_points, plan.contact_points), (0, points));
            assert_eq!((system.rows.len(), system.friction.len()), (points, 0));
            assert!(system.rows.iter().all(|row| row.direction == Direction::Normal));
            assert_eq!(Sparse::new(&system).unwrap().problem.tangent().compute_nnz(), 0);
            let reduction = Reduction::new(&system, None).unwrap();
            let form = DenseForm::new(FormKind::Coulomb, &system, &reduction).unwrap();
            assert_eq!((form.order(), reduction.isostatic.len()), (points, plan.rigid_modes));

            // Where one class alone has friction, its points alone have the rows.
            let mixed = boxed(material, Joint::mu(0.0)).joint("floor", Joint::mu(0.5));
            let (plan, model, system) = built(&mixed, route);
            let rough = model.contacts.iter().filter(|point| point.law.mu > 0.0).count();
            assert!(rough > 0 && rough < points);
            assert_eq!((plan.frictional_points, system.friction.len()), (rough, rough));
            let unknowns = if route == Route::Alm { 0 } else { 2 * rough };
            assert_eq!(effect(&plan, "friction").unknowns, unknowns, "multipliers are none");
        }
    }
}

#[test]
fn films_without_thickness_have_no_rows_and_no_unknowns() {
    let filled = |thickness| Joint::mu(0.6).mortar(thickness, "mortar");
    for route in ROUTES {
        let (dry, ..) = built(&boxed(elastic(), Joint::mu(0.6)), route);
        let (plan, model, system) = built(&boxed(elastic(), filled(0.0)), route);
        let films = effect(&plan, "mortar films");
        assert!(!films.on && films.unknowns == 0);
        assert_eq!((plan.order, plan.contact_points), (dry.order, dry.contact_points));
        assert_eq!(plan.memory_bytes(), dry.memory_bytes());
        assert!(model.joints.iter().all(|joint| joint.film.is_none()));
        assert!(model.contacts.iter().all(|point| point.film.is_none()));
        assert!(system.rows.iter().all(|row| row.compliance <= 0.0));
        let displacements = Sparse::new(&system).unwrap().problem.displacements();
        assert_eq!(displacements, 2 * plan.nodes);
    }
}

#[test]
fn joints_without_a_stiffness_have_no_rows_and_no_unknowns() {
    for material in [Material::rigid(), elastic()] {
        for route in ROUTES {
            let (plan, model, system) = built(&boxed(material, Joint::mu(0.6)), route);
            let stiffness = effect(&plan, "joint stiffness");
            assert!(!stiffness.on && stiffness.unknowns == 0);
            assert!(model.contacts.iter().all(|point| point.gives().iter().all(|c| *c <= 0.0)));
            assert!(system.rows.iter().all(|row| row.compliance <= 0.0));
            let displacements = Sparse::new(&system).unwrap().problem.displacements();
            let of_blocks = if plan.nodes > 0 { 2 * plan.nodes } else { plan.rigid_modes };
            assert_eq!(displacements, of_blocks);
        }
    }
}

#[test]
fn without_gravity_or_density_there_is_no_weight() {
    let rough = || boxed(elastic(), Joint::mu(0.6));
    let light = rough().material("brick", elastic());
    for scene in [rough().gravity([0.0, 0.0]), light] {
        let mut scene = scene;
        scene.loads.clear();
        let (plan, _, system) = built(&scene, Route::Interior);
        assert!(!effect(&plan, "self weight").on && !effect(&plan, "edge loads").on);
        assert!(system.bodies.iter().all(|body| body.load.iter().all(|f| f.abs() <= 0.0)));
        assert!(system.resultants().iter().all(|f| f.abs() <= 0.0));
    }
}

#[test]
fn stresses_that_no_output_shows_are_not_recovered() {
    for scene in [boxed(elastic(), Joint::mu(0.6)), scenes::in_mortar(elastic(), Films::Strips)] {
        for route in routes_for(&scene) {
            let with = solve(&scene.clone().route(route)).unwrap();
            let without = solve(&scene.clone().route(route).stresses(false)).unwrap();
            assert!(effect(&with.plan, "stresses").on && !effect(&without.plan, "stresses").on);
            let (with, without) = (with.state, without.state);
            let Some((with, without)) = with.zip(without) else { continue };
            assert!(!with.stresses.is_empty());
            assert!(without.stresses.is_empty() && without.films.is_empty());
            assert_eq!(
                (with.displacements, with.contacts),
                (without.displacements, without.contacts)
            );
        }
    }
}

#[test]
fn bodies_that_are_too_far_apart_make_no_pair() {
    let (far, ..) = built(&piers(0.0), Route::Lemke);
    for limit in [0.0, 0.009] {
        let (plan, model, system) = built(&piers(limit), Route::Lemke);
        assert!(model.contacts.iter().all(|point| point.a.is_none()), "the floor alone is met");
        assert_eq!((plan.order, system.rows.len()), (far.order, 2 * far.contact_points));
    }
    let (near, model, system) = built(&piers(0.011), Route::Lemke);
    let between = model.contacts.iter().filter(|point| point.a.is_some()).count();
    assert!(between > 0);
    assert_eq!(near.contact_points, far.contact_points + between);
    assert_eq!(system.rows.len(), 2 * near.contact_points);
}

#[test]
fn one_step_leaves_no_history() {
    for route in ROUTES {
        let scene = scenes::stack(elastic(), Joint::mu(0.6)).route(route);
        for name in ["load history", "support movements", "dissipation"] {
            assert!(!effect(&built(&scene, route).0, name).on, "{name}");
        }
        let mut run = Run::new(&scene, &mut |_| ControlFlow::Continue(())).unwrap();
        while run.advance(&mut |_| ControlFlow::Continue(())).unwrap() {}
        assert_eq!(run.solved_steps(), 1, "{route:?}");
        assert!(run.checkpoint().is_none());
        let outcome = run.finish();
        assert_eq!(outcome.history, None);
        let at_rest = |support: &PlacedSupport| support.movement == Movement::default();
        assert!(outcome.model.supports.iter().all(at_rest));
    }
}
