//! Kinds of loads: forces at places of blocks and accelerations of all mass against statics, and groups and factors
//! against what they stand for.

use crate::common;
mod earth;
mod groups;
mod inside;
mod linear;
mod mass;
mod moments;

use common::routes::{answer_by, rounding, routes_for};
use common::{
    GRAVITY, M_KN, all_displacements, all_reactions, assert_close, critical, difference, rectangle,
    solved, stands, state,
};
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::data::verdict::Verdict;
use masonry::model::mesh::BlockMesh;
use masonry::model::{Model, Plane};
use masonry::scene::{Brick, Joint, Load, Material, Route, RouteSetting, Scene, Support, Wall};
use masonry_report::summary;

/// Weight of the stone, kN/m3.
const WEIGHT: f64 = 2.0 * GRAVITY;

fn materials() -> [Material; 2] {
    [Material::rigid(), Material::elastic(1e7, 0.2)].map(|material| material.density(2000.0))
}

/// One block, its lower left corner at the origin, on a floor; nothing acts.
fn block(material: Material, [width, height]: [f64; 2], mu: f64) -> Scene {
    Scene::new("Block", M_KN)
        .plane(Plane::Stress)
        .thickness(0.5)
        .material("stone", material)
        .joint("floor", Joint::mu(mu))
        .block(rectangle("block", "stone", [0.0, width], [0.0, height]).mesh([4, 2]))
        .support(Support::new("floor", [-1.0, 0.0], [3.0, 0.0], "floor"))
}

/// A wall of two courses in running bond on a floor, under its weight.
fn wall(material: Material) -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    Scene::new("Wall", M_KN)
        .plane(Plane::Stress)
        .thickness(0.25)
        .gravity([0.0, -GRAVITY])
        .material("brick", material)
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .wall(Wall::running_bond("wall", "brick", brick, 0.6, 2).mesh([2, 2]))
        .support(Support::new("floor", [0.0, 0.0], [0.6, 0.0], "bed"))
}

/// The scene with one more load of each kind.
fn loaded(scene: Scene) -> Scene {
    scene
        .load(Load::pressure("top", [0.0, 0.2], [0.6, 0.2], 10.0))
        .load(Load::force("beam", "wall/2/2", [0.23, 0.17], [0.1, -1.5]))
        .load(Load::acceleration("quake", [0.1 * GRAVITY, 0.0]))
}

/// Everything that an answer is, relative to its size.
fn assert_same(found: &Outcome, expected: &Outcome, tolerance: f64) {
    let figures = [all_displacements, all_reactions];
    for figure in figures {
        let apart = difference(&figure(found), &figure(expected));
        assert!(apart <= tolerance, "{apart:e}");
    }
}

/// A block slides where `a / g = mu`, and rocks about its corner where `a / g = b / h`.
#[test]
fn a_block_slides_or_rocks_under_an_acceleration() {
    for material in materials() {
        for (sizes, mu, limit) in [([0.6, 1.0], 0.5, 0.5), ([0.2, 1.0], 0.7, 0.2)] {
            let shaken = |alpha: f64| {
                let quake = Load::acceleration("quake", [GRAVITY, 0.0]).factor(alpha);
                block(material, sizes, mu).gravity([0.0, -GRAVITY]).load(quake)
            };
            assert_close(critical([0.0, 1.0], |alpha| stands(&shaken(alpha))), limit, 1e-6);
            for (part, verdict) in [(1.0 - 1e-5, Verdict::Stands), (1.0 + 1e-5, Verdict::Falls)] {
                let scene = shaken(part * limit);
                assert_eq!(scene.solver.route, RouteSetting::Auto);
                assert_eq!(solve(&scene).unwrap().judgement.verdict, verdict, "{sizes:?}");
            }
        }
    }
}

/// The two corners of a rigid block carry a force by the lever rule, whatever place on its line it acts at, and
/// friction carries what is horizontal.
#[test]
fn the_corners_of_a_block_carry_a_force_by_the_lever_rule() {
    let (width, [h, v]) = (2.0, [1.5, 10.0]);
    for [x, y] in [[0.5, 0.25], [1.7, 0.0], [1.0, 1.0], [1.2, 0.6]] {
        let push = Load::force("push", "block", [x, y], [h, -v]);
        let scene = block(Material::rigid(), [width, 1.0], 0.6).load(push);
        for route in routes_for(&scene) {
            let Some(outcome) = answer_by(&scene, route) else { continue };
            let right = 1e3 * (v * x + h * y) / width;
            let expected = [1e3 * v - right, right];
            let contacts = outcome.model.contacts.iter().zip(&state(&outcome).contacts);
            let mut sides = [0.0; 2];
            for (point, contact) in contacts {
                sides[usize::from(point.position.x > 1.0)] += contact.t_n;
            }
            for (found, expected) in sides.into_iter().zip(expected) {
                assert_close(found, expected, rounding(route));
            }
            assert_close(outcome.reactions[0].fx, -1e3 * h, rounding(route));
        }
    }
}

/// A force beyond the foot of a weightless block tips it, and one within does not: at the corner stands the last.
#[test]
fn a_force_beyond_the_foot_tips_a_block() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    for material in [Material::rigid(), Material::elastic(1e7, 0.2)] {
        let at = |x: f64| {
            let mut scene = block(material, [1.0, 1.0], 0.6);
            scene.blocks[0].corners = corners.into();
            scene.load(Load::force("push", "block", [x, 1.0], [0.0, -10.0]))
        };
        assert_close(critical([0.5, 1.5], |x| stands(&at(x))), 1.0, 1e-6);
        assert_eq!(solve(&at(1.01)).unwrap().judgement.verdict, Verdict::Falls);
    }
}

/// The shape functions share a force among the nodes around it, so that shares at these nodes are the same load; so
/// is a uniform traction on a part of an edge that has the place in its middle and no node within.
#[test]
fn a_force_on_an_elastic_block_is_that_of_its_nodes() {
    let on = |loads: &[Load]| {
        let scene = block(materials()[1], [1.2, 0.8], 0.6).gravity([0.0, -GRAVITY]);
        solved(&loads.iter().cloned().fold(scene, Scene::load))
    };
    let at = |place, share: f64| {
        Load::force(&format!("{place:?}"), "block", place, [2.0 * share, -30.0 * share])
    };
    // In the second element of the upper row, a third of its length and a quarter of its height from its corner.
    let inside = on(&[at([0.4, 0.5], 1.0)]);
    let shares = [
        at([0.3, 0.4], 2.0 / 3.0 * 0.75),
        at([0.6, 0.4], 1.0 / 3.0 * 0.75),
        at([0.6, 0.8], 1.0 / 3.0 * 0.25),
        at([0.3, 0.8], 2.0 / 3.0 * 0.25),
    ];
    assert_same(&inside, &on(&shares), 1e-11);
    let edge = on(&[at([0.4, 0.8], 1.0)]);
    assert_same(&edge, &on(&[at([0.3, 0.8], 2.0 / 3.0), at([0.6, 0.8], 1.0 / 3.0)]), 1e-11);
    let area = 0.1 * 0.5;
    let narrow = Load::traction("narrow", [0.35, 0.8], [0.45, 0.8], [2.0 / area, -30.0 / area]);
    assert_same(&edge, &on(&[narrow]), 1e-11);
    // Rigid and elastic blocks balance the same forces.
    for (outcome, y) in [(&inside, 0.5), (&edge, 0.8)] {
        let weight = WEIGHT * 1.2 * 0.8 * 0.5;
        let reaction = &outcome.reactions[0];
        assert_close(reaction.fy, 1e3 * (30.0 + weight), 1e-10);
        assert_close(reaction.fx, -2e3, 1e-10);
        assert_close(reaction.m, 1e3 * (30.0 * 0.4 + 2.0 * y + weight * 0.6), 1e-10);
    }
}

/// A wall that is shaken by a tenth of gravity is one that leans.
#[test]
fn an_acceleration_is_gravity_that_leans() {
    for material in materials() {
        let shaken = wall(material).load(Load::acceleration("quake", [0.1 * GRAVITY, 0.0]));
        let leaning = wall(material).gravity([0.1 * GRAVITY, -GRAVITY]);
        let two = wall(material)
            .load(Load::acceleration("one", [0.3 * GRAVITY, -0.2]))
            .load(Load::acceleration("other", [-0.2 * GRAVITY, 0.2]));
        for route in [RouteSetting::Auto, Route::Lemke.into(), Route::Interior.into()] {
            let [shaken, leaning, two] =
                [&shaken, &leaning, &two].map(|scene| solved(&scene.clone().route(route)));
            assert_same(&shaken, &leaning, 1e-12);
            assert_same(&two, &leaning, 1e-10);
        }
    }
}

/// What acts is what the reports sum up, load by load, and what the floor carries.
#[test]
fn resultants_of_all_kinds() {
    for material in materials() {
        let outcome = solved(&loaded(wall(material)));
        let mass = 2000.0 * 0.6 * 0.2 * 0.25;
        // Force and moment about the origin.
        let expected = [
            ("top", [0.0, -1500.0, -450.0]),
            ("beam", [100.0, -1500.0, 0.23 * -1500.0 - 0.17 * 100.0]),
            ("quake", [0.1 * GRAVITY * mass, 0.0, -0.1 * GRAVITY * mass * 0.1]),
        ];
        let groups = summary::load_groups(&outcome.model);
        let mut sum = [0.0, -GRAVITY * mass, -GRAVITY * mass * 0.3];
        for (group, (name, expected)) in groups.iter().zip(expected) {
            assert_eq!((group.name, group.loads[0].0.name.as_str()), (name, name));
            let found = [group.sum.force.x, group.sum.force.y, group.sum.moment];
            assert!(difference(&found, &expected) < 1e-12, "{name}: {found:?}");
            sum.iter_mut().zip(expected).for_each(|(sum, it)| *sum += it);
        }
        assert_eq!(groups.len(), 3);
        let applied = summary::applied_load(&outcome.model);
        let applied = [applied.force.x, applied.force.y, applied.moment];
        assert!(difference(&applied, &sum) < 1e-12, "{applied:?}");
        let floor = &outcome.reactions[0];
        assert!(difference(&[-floor.fx, -floor.fy, -floor.m], &sum) < 1e-9, "{floor:?}");
    }
}

/// A place that a node stands at, on the edge between two blocks too, needs no room around it.
#[test]
fn forces_at_corners_and_in_joints() {
    for material in materials() {
        let scene = wall(material)
            .load(Load::force("corner", "wall/2/1", [0.0, 0.2], [0.0, -1.0]))
            .load(Load::force("joint", "wall/1/2", [0.3, 0.1], [0.0, -1.0]));
        let outcome = solved(&scene);
        let weight = WEIGHT * 0.6 * 0.2 * 0.25;
        assert_close(outcome.reactions[0].fy, 1e3 * (2.0 + weight), 1e-9);
        let model = Model::from_scene(&scene).unwrap();
        let joint: Vec<_> = model.blocks[1].point_loads().collect();
        let is_on_top = |mesh: &BlockMesh| {
            let shares = mesh.interpolate_inside(joint[0].at).into_iter();
            shares
                .filter(|(_, share)| *share != 0.0)
                .all(|(node, _)| mesh.edge_nodes(2).contains(&node))
        };
        let mesh = model.blocks[1].mesh.as_ref();
        assert!(joint.len() == 1 && mesh.is_none_or(is_on_top), "{joint:?}");
    }
}
