//! Pressures that are linear along an edge.

use masonry::analysis::limit::{Laws, limit_by};
use masonry::model::Model;
use masonry::scene::{Load, Scene};
use masonry_report::summary;

use super::common::{assert_close, difference, solved};
use super::{GRAVITY, WEIGHT, assert_same, block, materials, wall};

/// Force and moment about the origin of the only load \[N, N m\].
fn resultant(scene: &Scene) -> [f64; 3] {
    let model = Model::from_scene(scene).unwrap();
    let sum = summary::load_groups(&model)[0].sum;
    [sum.force.x, sum.force.y, sum.moment]
}

/// A trapezoid has the area `(a + b) L / 2`, and its centroid at `L (a + 2 b) / (3 (a + b))` from the side `a`, whatever edges
/// it is divided among.
#[test]
fn the_resultant_of_a_trapezoid() {
    let ([a, b], thickness) = ([4.0, 10.0], 0.25);
    for material in materials() {
        for [from, to] in [[0.0, 0.6], [0.05, 0.47], [0.6, 0.0], [0.47, 0.13]] {
            let scene = wall(material).load(Load::pressure("top", [from, 0.2], [to, 0.2], [a, b]));
            let length: f64 = to - from;
            let force = -0.5e3 * (a + b) * length.abs() * thickness;
            let place = from + length * (a + 2.0 * b) / (3.0 * (a + b));
            let found = resultant(&scene);
            assert!(difference(&[0.0, force, force * place], &found) < 1e-12, "{found:?}");
            // The floor carries it, and the weight.
            let (floor, weight) = (&solved(&scene).reactions[0], 1e3 * WEIGHT * 0.6 * 0.2 * 0.25);
            let [expected, moment] = [weight - force, 0.3 * weight - force * place];
            assert!(difference(&[expected, moment], &[floor.fy, floor.m]) < 1e-9, "{floor:?}");
        }
    }
}

/// Beyond the ends of the block the segment goes on, and so does the pressure.
#[test]
fn a_segment_that_covers_more_than_the_edge() {
    let [material, _] = materials();
    let long = block(material, [0.6, 0.4], 0.6);
    let long = long.load(Load::pressure("top", [-0.2, 0.4], [1.0, 0.4], [0.0, 12.0]));
    let force = -1e3 * 0.5 * (2.0 + 8.0) * 0.6 * 0.5;
    let place = 0.6 * (2.0 + 2.0 * 8.0) / (3.0 * (2.0 + 8.0));
    assert!(difference(&[0.0, force, force * place], &resultant(&long)) < 1e-12);
}

/// On an edge of one element the nodes get `L (2 a + b) / 6` and `L (a + 2 b) / 6`; on finer edges the part of a line
/// between two nodes is a linear load as well.
#[test]
fn nodes_share_a_linear_pressure() {
    let on = |mesh: [u32; 2], loads: &[Load]| {
        let mut scene = block(materials()[1], [1.2, 0.8], 0.6).gravity([0.0, -GRAVITY]);
        scene.blocks[0].mesh = Some(mesh);
        solved(&loads.iter().cloned().fold(scene, Scene::load))
    };
    let force =
        |x: f64, share: f64| Load::force(&x.to_string(), "block", [x, 0.8], [0.0, -share * 0.5]);
    let (a, b, length) = (20.0, 50.0, 1.2);
    let linear = Load::pressure("linear", [0.0, 0.8], [length, 0.8], [a, b]);
    let ends =
        [force(0.0, length * (2.0 * a + b) / 6.0), force(length, length * (a + 2.0 * b) / 6.0)];
    assert_same(&on([1, 1], std::slice::from_ref(&linear)), &on([1, 1], &ends), 1e-11);
    let part = |k: f64| {
        let [x, y] = [k, k + 1.0].map(|it| it / 3.0);
        let [from, to] = [x, y].map(|it| [length * it, 0.8]);
        Load::pressure(&k.to_string(), from, to, [x, y].map(|it| a + (b - a) * it))
    };
    assert_same(&on([3, 2], &[linear]), &on([3, 2], &[0.0, 1.0, 2.0].map(part)), 1e-11);
}

/// A pressure from `-p` to `p` has no force but the moment `p L^2 / 6`, which tips a block at `W b / 2`.
#[test]
fn a_pressure_without_a_force_tips_a_block() {
    let (width, height, thickness) = (0.6, 1.0, 0.5);
    let scene = block(materials()[0], [width, height], 0.6)
        .gravity([0.0, -GRAVITY])
        .load(Load::pressure("top", [0.0, height], [width, height], [-1.0, 1.0]))
        .limit_group("top");
    let weight = WEIGHT * width * height * thickness;
    let moment = thickness * width * width / 6.0;
    let found = limit_by(&scene, Laws::Associative).unwrap().associative.unwrap();
    assert_close(found.load_factor.unwrap(), weight * width / 2.0 / moment, 1e-6);
}
