//! Tractions within joints: floors and beams on the blocks below them.

use masonry::analysis::limit::{Laws, limit_by};
use masonry::model::Model;
use masonry::scene::{Load, Scene, Support};
use masonry_report::summary;

use super::common::{assert_close, difference, rectangle, solved};
use super::{GRAVITY, WEIGHT, assert_same, block, materials, wall};

/// A floor from the left end of the wall to the middle of its second brick, on the first course; it pushes to the right, too.
fn floor() -> Load {
    Load::traction("floor", [0.5, 0.1], [0.0, 0.1], [1.0, -12.0]).inside()
}

/// The blocks below carry the floor, each its part of it, as if it were put on them by hand.
#[test]
fn a_floor_acts_on_the_blocks_below_it() {
    let by_hand = |from: f64, to: f64, brick: &str| {
        let area = (to - from) * 0.25;
        let middle = [0.5 * (from + to), 0.1];
        Load::force(brick, brick, middle, [area, -12.0 * area])
    };
    let [rigid, elastic] = materials();
    let parts = [[0.0, 0.2], [0.2, 0.4], [0.4, 0.5]];
    let hands = parts.into_iter().enumerate();
    let hands = hands.map(|(k, [from, to])| by_hand(from, to, &format!("wall/1/{}", k + 1)));
    let expected = solved(&hands.fold(wall(rigid), Scene::load));
    assert_same(&solved(&wall(rigid).load(floor())), &expected, 1e-10);
    // Elastic bricks are loaded along their edges.
    let outcome = solved(&wall(elastic).load(floor()));
    let loaded: Vec<_> =
        outcome.model.blocks.iter().filter(|it| it.edge_loads().count() > 0).collect();
    assert_eq!(
        loaded.iter().map(|it| it.name.as_str()).collect::<Vec<_>>(),
        ["wall/1/1", "wall/1/2", "wall/1/3"]
    );
    let reaction = &outcome.reactions[0];
    let weight = WEIGHT * 0.6 * 0.2 * 0.25;
    let area = 0.5 * 0.25;
    let moment = 0.3 * weight + area * (12.0 * 0.25 + 0.1);
    let expected = [-1e3 * area, 1e3 * (weight + 12.0 * area), 1e3 * moment];
    assert!(difference(&expected, &[reaction.fx, reaction.fy, reaction.m]) < 1e-9, "{reaction:?}");
}

/// What pulls up acts on the blocks above, and on a free edge a load that presses it is the same with and without the key.
#[test]
fn the_side_that_a_traction_presses() {
    let model = |load: Load| Model::from_scene(&wall(materials()[0]).load(load)).unwrap();
    let names = |model: &Model| -> Vec<String> {
        let loaded = model.blocks.iter().filter(|it| !it.loads.is_empty());
        loaded.map(|it| it.name.clone()).collect()
    };
    let mut up = floor();
    up.traction = Some([0.0, 3.0]);
    assert_eq!(names(&model(up)), ["wall/2/1", "wall/2/2", "wall/2/3"]);
    assert_eq!(names(&model(floor().factor(0.0))), ["wall/1/1", "wall/1/2", "wall/1/3"]);
    let top = Load::traction("top", [0.0, 0.2], [0.6, 0.2], [2.0, -5.0]);
    let sum = |load: Load| summary::load_groups(&model(load))[0].sum;
    assert_eq!(sum(top.clone()), sum(top.inside()));
}

/// Two blocks of a width of 1 m stand on 0.6 m of it. A floor on the last 0.2 m of the joint between them, at 0.3 m beyond the
/// support, tips both when its moment is that of their weight at 0.1 m.
#[test]
fn a_bearing_tips_the_blocks() {
    let mut scene = block(materials()[0], [1.0, 1.0], 0.7).gravity([0.0, -GRAVITY]);
    scene.supports = vec![Support::new("floor", [0.0, 0.0], [0.6, 0.0], "floor")];
    let scene = scene
        .block(rectangle("upper", "stone", [0.0, 1.0], [1.0, 2.0]))
        .joint("bed", masonry::scene::Joint::mu(0.7))
        .load(Load::traction("bearing", [0.8, 1.0], [1.0, 1.0], [0.0, -1.0]).inside())
        .limit_group("bearing");
    let weight = WEIGHT * 0.5;
    let found = limit_by(&scene, Laws::Associative).unwrap().associative.unwrap();
    assert_close(found.load_factor.unwrap(), 2.0 * weight * 0.1 / (0.2 * 0.5 * 0.3), 1e-6);
}
