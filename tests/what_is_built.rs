//! What a scene does not call for is not built: no mesh, no stiffness, no tangential rows, no films.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::routes::{ROUTES, answer_by, routes_for};
use common::{GRAVITY, M_KN, state};
use masonry::model::{Model, Plane};
use masonry::plan::{Effect, Plan};
use masonry::scene::{Brick, Joint, Load, Material, Route, Scene, Support, Wall};
use masonry::system::{Direction, System};

/// Two courses of three bricks with given material and joints.
fn wall(bricks: Material, joint: Joint) -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    Scene::new("Wall", M_KN)
        .plane(Plane::Stress)
        .thickness(0.25)
        .gravity([0.0, -GRAVITY])
        .material("brick", bricks.density(1800.0))
        .material("mortar", Material::elastic(8e5, 0.2))
        .joint("bed", joint.clone())
        .joint("head", joint.clone())
        .joint("floor", joint)
        .wall(Wall::running_bond("wall", "brick", brick, 0.6, 2).mesh([2, 2]))
        .support(Support::new("floor", [0.0, 0.0], [0.6, 0.0], "floor"))
        .support(Support::new("left", [0.0, 0.0], [0.0, 0.2], "floor"))
        .support(Support::new("right", [0.6, 0.0], [0.6, 0.2], "floor"))
        .load(Load::pressure("top", [0.0, 0.2], [0.6, 0.2], 10.0))
}

fn elastic() -> Material {
    Material::elastic(1e6, 0.15)
}

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
    let scene = wall(Material::rigid(), Joint::mu(0.6));
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
    }
    for route in routes_for(&scene) {
        let Some(outcome) = answer_by(&scene, route) else { continue };
        assert!(state(&outcome).stresses.is_empty());
    }
    let (plan, model, system) = built(&wall(elastic(), Joint::mu(0.6)), Route::Lemke);
    assert!(effect(&plan, "deformation").on && effect(&plan, "stresses").on);
    assert!(model.blocks.iter().all(|block| block.mesh.is_some()));
    assert_eq!(system.stiffnesses.len(), 2, "of a whole and of a half brick");
}

#[test]
fn joints_without_friction_have_no_tangential_rows() {
    for material in [Material::rigid(), elastic()] {
        for route in ROUTES {
            let (plan, model, system) = built(&wall(material, Joint::mu(0.0)), route);
            assert!(!effect(&plan, "friction").on && effect(&plan, "friction").unknowns == 0);
            let points = model.contacts.len();
            assert_eq!((plan.frictional_points, plan.contact_points), (0, points));
            assert_eq!((system.rows.len(), system.friction.len()), (points, 0));
            assert!(system.rows.iter().all(|row| row.direction == Direction::Normal));

            // Where one class alone has friction, its points alone have the rows.
            let mixed = wall(material, Joint::mu(0.0)).joint("floor", Joint::mu(0.5));
            let (plan, model, system) = built(&mixed, route);
            let rough = model.contacts.iter().filter(|point| point.mu > 0.0).count();
            assert!(rough > 0 && rough < points);
            assert_eq!((plan.frictional_points, system.friction.len()), (rough, rough));
            assert_eq!(effect(&plan, "friction").unknowns, 2 * rough);
        }
    }
}

#[test]
fn films_without_thickness_have_no_rows_and_no_unknowns() {
    let filled = |thickness| Joint::mu(0.6).mortar(thickness, "mortar");
    for route in ROUTES {
        let (dry, ..) = built(&wall(elastic(), Joint::mu(0.6)), route);
        let (plan, model, system) = built(&wall(elastic(), filled(0.0)), route);
        let films = effect(&plan, "mortar films");
        assert!(!films.on && films.unknowns == 0);
        assert_eq!((plan.order, plan.contact_points), (dry.order, dry.contact_points));
        assert_eq!(plan.memory_bytes(), dry.memory_bytes());
        assert!(model.joints.iter().all(|joint| joint.film.is_none()));
        assert!(model.contacts.iter().all(|point| point.film.is_none()));
        assert!(system.rows.iter().all(|row| row.compliance <= 0.0));
    }
}
