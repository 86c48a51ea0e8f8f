//! States of uniform stress: every mesh, every joint and every route has to reproduce them exactly.
//!
//! The contact patch test is that of `Code_Aster`, SSNP121 (after Taylor and Papadopoulos): two blocks whose
//! meshes do not match, pressed together.

use crate::common;

use common::routes::{ROUTES, answer_by, rounding, solved_by};
use common::{M_KN, assert_close, displacements, rectangle, state};
use masonry::analysis::outcome::Outcome;
use masonry::model::Plane;
use masonry::model::joints::PointRule;
use masonry::scene::{Block, Joint, Load, Material, Movement, Route, Scene, Stage, Support};
use masonry::units::Units;

/// Pressure on top of the blocks, Pa.
const PRESSURE: f64 = 1e5;
/// Young's modulus of the blocks, Pa.
const YOUNG: f64 = 2e6;

/// Blocks in courses of height 1 between `x = 0` and `x = 2` under a uniform pressure.
fn compressed(points: PointRule, blocks: Vec<Block>) -> Scene {
    let scene = Scene::new("Patch", Units::SI)
        .plane(Plane::Strain)
        .thickness(1.0)
        .material("stone", Material::elastic(YOUNG, 0.0))
        .joint("bed", Joint::mu(0.5))
        .joint("head", Joint::mu(0.5))
        .support(Support::new("floor", [0.0, 0.0], [2.0, 0.0], "bed"))
        .load(Load::pressure("top", [0.0, 2.0], [2.0, 2.0], PRESSURE))
        .contact_points(points);
    blocks.into_iter().fold(scene, Scene::block)
}

fn stone(name: &str, x: [f64; 2], y: [f64; 2], mesh: [u32; 2]) -> Block {
    rectangle(name, "stone", x, y).mesh(mesh)
}

/// Two blocks one above the other, their nodes meeting at the corners only.
fn two_blocks() -> Vec<Block> {
    vec![
        stone("lower", [0.0, 2.0], [0.0, 1.0], [3, 2]),
        stone("upper", [0.0, 2.0], [1.0, 2.0], [2, 3]),
    ]
}

/// A running bond of two and three blocks, all meshed differently.
fn five_blocks() -> Vec<Block> {
    vec![
        stone("left", [0.0, 1.1], [0.0, 1.0], [3, 2]),
        stone("right", [1.1, 2.0], [0.0, 1.0], [2, 1]),
        stone("upper left", [0.0, 0.4], [1.0, 2.0], [1, 2]),
        stone("upper middle", [0.4, 1.5], [1.0, 2.0], [2, 3]),
        stone("upper right", [1.5, 2.0], [1.0, 2.0], [4, 2]),
    ]
}

/// Every stress is the pressure, and `u_y = -p y / E` everywhere.
fn assert_uniform(outcome: &Outcome) {
    let near = rounding(outcome.solve.route);
    let state = state(outcome);
    assert!(!state.stresses.is_empty());
    for it in &state.stresses {
        let [x, y, shear] = it.sigma;
        let wrong = x.abs().max((y + PRESSURE).abs()).max(shear.abs());
        assert!(wrong < near * PRESSURE, "{:?}", it.sigma);
    }
    for (block, moved) in outcome.model.blocks.iter().zip(&state.displacements) {
        for (node, u) in block.mesh.as_ref().unwrap().nodes.iter().zip(moved) {
            let expected = -PRESSURE * node.y / YOUNG;
            assert!((u.y - expected).abs().max(u.x.abs()) < near * 0.1, "{}: {u}", block.name);
        }
    }
}

/// Every contact point carries the pressure on the area that it stands for, and no shear.
fn assert_uniform_traction(outcome: &Outcome) {
    let near = rounding(outcome.solve.route);
    let model = &outcome.model;
    for (contact, it) in model.contacts.iter().zip(&state(outcome).contacts) {
        let bed = model.joints[contact.joint.index()].normal.y > 0.5;
        let expected = if bed { PRESSURE * contact.weight } else { 0.0 };
        let scale = PRESSURE * contact.weight;
        assert!((it.t_n - expected).abs() < near * scale, "{} != {expected}", it.t_n);
        assert!(it.t_t.abs() < near * scale, "{}", it.t_t);
    }
}

/// Points at the vertices of the joint integrate products of shape functions with a uniform
/// pressure exactly, so that the point forces are those of the pressure.
#[test]
fn vertices_pass_the_contact_patch_test() {
    for route in ROUTES {
        let outcome = solved_by(&compressed(PointRule::Vertices, two_blocks()), route);
        assert_uniform(&outcome);
        assert_uniform_traction(&outcome);
        let near = rounding(route);
        assert_close(displacements(&outcome, "upper").last().unwrap().y, -0.1, near);
        assert_close(displacements(&outcome, "lower").last().unwrap().y, -0.05, near);

        let scene = compressed(PointRule::Vertices, five_blocks());
        let Some(outcome) = answer_by(&scene, route) else { continue };
        // Around the foot of a head joint forces of points can circulate, the stresses are the same.
        assert_uniform(&outcome);
        assert_close(outcome.reactions[0].fy, 2.0 * PRESSURE, rounding(route));
    }
}

/// Gauss points pass too. They are more than the nodes of an edge, so that point forces are not
/// unique: stresses, displacements and the resultant are.
#[test]
fn gauss_points_pass_the_contact_patch_test() {
    for route in ROUTES {
        for blocks in [two_blocks(), five_blocks()] {
            let scene = compressed(PointRule::Gauss, blocks);
            let Some(outcome) = answer_by(&scene, route) else { continue };
            assert_uniform(&outcome);
            assert_close(outcome.reactions[0].fy, 2.0 * PRESSURE, rounding(route));
        }
    }
}

/// Pairs of nodes pass where meshes match. Where only the corners meet, these carry the whole load, which
/// is no uniform pressure: the rule is for meshes that match.
#[test]
fn nodal_pairs_pass_on_matching_meshes_only() {
    let mut matching = two_blocks();
    matching[1].mesh = matching[0].mesh;
    for route in ROUTES {
        let outcome = solved_by(&compressed(PointRule::NodalPairs, matching.clone()), route);
        assert_uniform(&outcome);
        assert_uniform_traction(&outcome);

        let outcome = solved_by(&compressed(PointRule::NodalPairs, two_blocks()), route);
        let lowest = state(&outcome).stresses.iter().map(|it| it.sigma[1]).fold(0.0, f64::min);
        assert!(lowest < -1.5 * PRESSURE, "{lowest} Pa");
    }
}

/// Two blocks of other heights and stiffnesses between a floor and a smooth support that comes down by `D`:
/// the pressure everywhere is `D / (h1 / E1 + h2 / E2)`, and `E D / (h1 + h2)` where both are of one
/// material. In the published case it is 1e5 for `D = 0.1`, `E = 2e6` and heights of 1.
#[test]
fn a_prescribed_displacement_presses_blocks_of_two_materials() {
    let down = 0.1;
    for ([(h1, e1), (h2, e2)], pressure) in
        [([(1.0, 2e6), (1.0, 2e6)], 1e5), ([(0.7, 2e6), (1.9, 3e5)], 0.1 / (0.35e-6 + 1.9 / 3e5))]
    {
        for points in [PointRule::Vertices, PointRule::Gauss] {
            let top = h1 + h2;
            let scene = Scene::new("Two materials", Units::SI)
                .plane(Plane::Strain)
                .thickness(1.0)
                .material("lower", Material::elastic(e1, 0.0))
                .material("upper", Material::elastic(e2, 0.0))
                .joint("bed", Joint::mu(0.5))
                .joint("smooth", Joint::mu(0.0))
                .block(rectangle("lower", "lower", [0.0, 2.0], [0.0, h1]).mesh([3, 2]))
                .block(rectangle("upper", "upper", [0.0, 2.0], [h1, top]).mesh([4, 3]))
                .support(Support::new("floor", [0.0, 0.0], [2.0, 0.0], "bed"))
                .support(Support::new("press", [0.0, top], [2.0, top], "smooth"))
                .stage(Stage::new("press").moves("press", Movement::by(0.0, -down)))
                .contact_points(points);
            for route in ROUTES {
                let near = rounding(route);
                let Some(outcome) = answer_by(&scene, route) else { continue };
                for (block, sunk) in [("lower", pressure * h1 / e1), ("upper", down)] {
                    let moved = displacements(&outcome, block);
                    // The nodes go row by row, upwards.
                    assert_close(moved[moved.len() - 1].y, -sunk, near);
                    assert!(moved.iter().all(|u| u.x.abs() < near * down), "{route:?}");
                }
                for it in &state(&outcome).stresses {
                    let [x, y, shear] = it.sigma;
                    let wrong = x.abs().max((y + pressure).abs()).max(shear.abs());
                    assert!(wrong < near * pressure, "{route:?}: {:?}", it.sigma);
                }
                for (reaction, force) in outcome.reactions.iter().zip([2.0, -2.0]) {
                    assert_close(reaction.fy, force * pressure, near);
                }
            }
        }
    }
}

/// `sigma_x`, `sigma_y`, `tau_xy` in kN/m2. The principal stresses are -1 and -11, the first at
/// 18.435 degrees from the x axis.
const SIGMA: [f64; 3] = [-2.0, -10.0, 3.0];

/// Blocks that carry [`SIGMA`] on a rough floor at `y = 0`.
///
/// The floor keeps its contact points from moving along x. With nu = 0.2 in plane stress the
/// strain `(sigma_x - nu sigma_y) / E` is zero, so that this disturbs nothing.
fn sheared(blocks: &[Block], free_edges: &[[[f64; 2]; 2]]) -> Scene {
    let mut scene = Scene::new("Patch", M_KN)
        .plane(Plane::Stress)
        .thickness(0.3)
        .material("stone", Material::elastic(1e4, 0.2))
        .joint("bed", Joint::mu(0.6))
        .support(Support::new("floor", [-1.0, 0.0], [3.0, 0.0], "bed"));
    for (k, [from, to]) in free_edges.iter().enumerate() {
        // Outwards is to the right of an edge of a block, which runs counter-clockwise.
        let (x, y) = (to[1] - from[1], from[0] - to[0]);
        let [sigma_x, sigma_y, tau] = SIGMA;
        let length = x.hypot(y);
        let traction = [(sigma_x * x + tau * y) / length, (tau * x + sigma_y * y) / length];
        scene = scene.load(Load::traction(&format!("edge {k}"), *from, *to, traction));
    }
    blocks.iter().cloned().fold(scene, Scene::block)
}

fn assert_principal_stresses(scene: &Scene, route: Route) {
    let near = rounding(route);
    let Some(outcome) = answer_by(scene, route) else { return };
    let stresses = &state(&outcome).stresses;
    assert!(stresses.len() > 1 || outcome.model.blocks.len() == 1);
    for it in stresses {
        for (found, expected) in it.sigma.iter().zip(SIGMA) {
            assert!((found - 1e3 * expected).abs() < near * 1e4, "{:?}", it.sigma);
        }
        assert!((it.principal.sigma_1 + 1e3).abs() < near * 1e4);
        assert!((it.principal.sigma_2 + 11e3).abs() < near * 1e4);
        assert_close(it.principal.theta.to_degrees(), 18.434_948_822_922, near);
    }
    let [_, sigma_y, tau] = SIGMA.map(|sigma| 1e3 * 0.3 * 2.0 * sigma);
    assert_close(outcome.reactions[0].fx, -tau, near);
    assert_close(outcome.reactions[0].fy, -sigma_y, near);
}

/// Blocks from a rectangle to a distorted quadrilateral, on a foot 2 wide.
#[test]
fn every_mesh_of_one_block_reproduces_uniform_stress() {
    let shapes = [
        [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]],
        [[0.0, 0.0], [2.0, 0.0], [2.5, 1.0], [0.5, 1.0]],
        [[0.0, 0.0], [2.0, 0.0], [1.7, 1.3], [0.3, 0.8]],
        [[0.0, 0.0], [2.0, 0.0], [2.6, 0.4], [0.9, 1.9]],
    ];
    for corners in shapes {
        for mesh in [[1, 1], [2, 1], [3, 2], [4, 5]] {
            let block = Block::new("block", "stone", corners).mesh(mesh);
            let [_, right, top_right, top_left] = corners;
            let edges = [[right, top_right], [top_right, top_left], [top_left, corners[0]]];
            let scene = sheared(&[block], &edges);
            for route in ROUTES {
                assert_principal_stresses(&scene, route);
            }
        }
    }
}

/// Triangles, pentagons, hexagons, an L and a rectangle with a corner on a straight edge, on a foot 2 wide.
#[test]
fn every_mesh_of_a_polygon_reproduces_uniform_stress() {
    let shapes: [&[[f64; 2]]; 5] = [
        &[[0.0, 0.0], [2.0, 0.0], [0.7, 1.4]],
        &[[0.0, 0.0], [2.0, 0.0], [2.3, 0.8], [1.1, 1.7], [-0.2, 1.1]],
        &[[0.0, 0.0], [2.0, 0.0], [2.6, 0.9], [2.0, 1.8], [0.0, 1.8], [-0.6, 0.9]],
        &[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]],
        &[[0.0, 0.0], [2.0, 0.0], [2.0, 0.3], [2.0, 1.0], [0.0, 1.0]],
    ];
    for corners in shapes {
        for mesh in [1, 3] {
            let block = Block::new("block", "stone", corners).mesh([mesh; 2]);
            let edges = corners[1..].windows(2).map(|ends| [ends[0], ends[1]]);
            let last = [corners[corners.len() - 1], corners[0]];
            let edges: Vec<_> = edges.chain([last]).collect();
            let scene = sheared(&[block], &edges);
            for route in ROUTES {
                assert_principal_stresses(&scene, route);
            }
        }
    }
}

/// An inclined joint of nodes that do not match carries normal stress and shear exactly.
#[test]
fn a_joint_transmits_uniform_stress() {
    let (left, right) = ([-0.1, 1.1], [2.1, 0.8]);
    let (top_left, top_right) = ([0.2, 1.8], [1.9, 2.1]);
    let lower = [[0.0, 0.0], [2.0, 0.0], right, left];
    let upper = [left, right, top_right, top_left];
    let edges = [
        [lower[1], right],
        [right, top_right],
        [top_right, top_left],
        [top_left, left],
        [left, lower[0]],
    ];
    for [first, second] in [[[2, 2], [2, 2]], [[3, 2], [2, 1]], [[2, 1], [5, 2]]] {
        let lower = Block::new("lower", "stone", lower).mesh(first);
        let upper = Block::new("upper", "stone", upper).mesh(second);
        let scene = sheared(&[lower, upper], &edges);
        for route in ROUTES {
            assert_principal_stresses(&scene, route);
        }
    }
}
