//! Moments at places of blocks.

use masonry::analysis::limit::{Laws, limit_by};
use masonry::analysis::solve::solve;
use masonry::data::verdict::Verdict;
use masonry::scene::{Load, Scene};

use super::common::{assert_close, difference, solved};
use super::{GRAVITY, WEIGHT, assert_same, block, materials};

const SIZES: [f64; 2] = [0.6, 0.8];

fn turned(material: masonry::scene::Material, at: [f64; 2], moment: f64) -> Scene {
    let scene = block(material, SIZES, 0.6).gravity([0.0, -GRAVITY]);
    scene.load(Load::moment("turn", "block", at, moment)).limit_group("turn")
}

/// The moment `W b / 2` tips a block to either side, wherever in it the moment acts.
#[test]
fn a_moment_tips_a_block() {
    let limit = WEIGHT * SIZES[0] * SIZES[1] * 0.5 * SIZES[0] / 2.0;
    for (at, sign) in [([0.3, 0.4], 1.0), ([0.0, 0.8], 1.0), ([0.45, 0.1], -1.0)] {
        let scene = turned(materials()[0], at, sign);
        let found = limit_by(&scene, Laws::Associative).unwrap().associative.unwrap();
        assert_close(found.load_factor.unwrap(), limit, 1e-6);
        for material in materials() {
            for (part, verdict) in [(0.99, Verdict::Stands), (1.01, Verdict::Falls)] {
                let outcome = solve(&turned(material, at, sign * part * limit)).unwrap();
                assert_eq!(outcome.judgement.verdict, verdict, "{at:?} {part}");
            }
        }
    }
}

/// The floor takes the moment.
#[test]
fn a_moment_and_its_reaction() {
    let weight = WEIGHT * SIZES[0] * SIZES[1] * 0.5;
    for material in materials() {
        for at in [[0.3, 0.4], [0.6, 0.25], [0.11, 0.67]] {
            let outcome = solved(&turned(material, at, -0.4));
            let floor = &outcome.reactions[0];
            let expected = [0.0, 1e3 * weight, 1e3 * (0.3 * weight + 0.4)];
            assert!(difference(&expected, &[floor.fx, floor.fy, floor.m]) < 1e-9, "{floor:?}");
        }
    }
}

/// In the middle of an element of `a` by `b` the mean rotation has the derivatives `1 / (4 a)` and `1 / (4 b)` by the
/// displacements of its corners.
#[test]
fn a_moment_on_an_element_is_forces_at_its_corners() {
    let (moment, [a, b]) = (0.5, SIZES);
    let elastic = |scene: Scene| {
        let mut scene = scene;
        scene.blocks[0].mesh = Some([1, 1]);
        solved(&scene)
    };
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let forces = corners.map(|[x, y]: [f64; 2]| {
        let at = [0.5 * a * (1.0 + x), 0.5 * b * (1.0 + y)];
        let force = [-y * moment / (4.0 * b), x * moment / (4.0 * a)];
        Load::force(&format!("{at:?}"), "block", at, force)
    });
    let by_hand = block(materials()[1], SIZES, 0.6).gravity([0.0, -GRAVITY]);
    let by_hand = forces.into_iter().fold(by_hand, Scene::load);
    let middle = turned(materials()[1], [0.5 * a, 0.5 * b], moment);
    assert_same(&elastic(middle), &elastic(by_hand), 1e-11);
}
