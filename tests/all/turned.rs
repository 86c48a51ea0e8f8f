//! Walls that are turned: under gravity that is turned with them they are the walls as they were.

use masonry::analysis::limit::{Laws, limit_by};
use masonry::model::{Body, Model, Plane};
use masonry::scene::{Brick, Joint, Load, Material, Opening, Scene, Support, Wall};
use nalgebra::{Rotation2, Vector2};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::common::{GRAVITY, M_KN, assert_close};

const ORIGIN: [f64; 2] = [0.4, -0.3];

/// A wall of seven courses with a door and a window, on a support below it, under an earthquake that grows; all of it turned
/// about the lower left corner of the wall.
fn turned(degrees: f64, mortar: f64) -> Scene {
    let turn =
        |v: [f64; 2]| <[f64; 2]>::from(Rotation2::new(degrees.to_radians()) * Vector2::from(v));
    let at = |x: f64, y: f64| {
        let [x, y] = turn([x, y]);
        [ORIGIN[0] + x, ORIGIN[1] + y]
    };
    let joint = |mu: f64| {
        if mortar > 0.0 { Joint::mu(mu).mortar(mortar, "mortar") } else { Joint::mu(mu) }
    };
    let brick = Brick { length: 0.4, height: 0.2 };
    Scene::new("Turned", M_KN)
        .plane(Plane::Stress)
        .thickness(0.3)
        .gravity(turn([0.0, -GRAVITY]))
        .material("stone", Material::rigid().density(2000.0))
        .material("mortar", Material::elastic(1e6, 0.2))
        .joint("floor", Joint::mu(0.7))
        .joint("bed", joint(0.6))
        .joint("head", joint(0.2))
        .wall(
            Wall::running_bond("wall", "stone", brick, 2.8, 7)
                .opening(Opening::door(0.5, 0.7, 3))
                .opening(Opening::door(1.7, 0.5, 2).above(3))
                .origin(ORIGIN)
                .turn_deg(degrees),
        )
        .support(Support::new("floor", at(0.0, 0.0), at(2.8, 0.0), "floor"))
        .load(Load::acceleration("quake", turn([GRAVITY, 0.0])))
        .limit_group("quake")
}

fn limit(scene: &Scene) -> f64 {
    limit_by(scene, Laws::Associative).unwrap().associative.unwrap().load_factor.unwrap()
}

/// The blocks that meet, and their class.
fn meetings(scene: &Scene) -> Vec<(Vec<String>, String)> {
    let model = Model::from_scene(scene).unwrap();
    let name = |body| match body {
        Body::Block(id) => model.blocks[id.index()].name.clone(),
        Body::Support(_) => "floor".to_owned(),
    };
    let meeting = |joint: &masonry::model::PlacedJoint| {
        let mut names = vec![name(joint.a), name(Body::Block(joint.b))];
        names.sort();
        (names, model.joint_classes[joint.class].name.clone())
    };
    let mut list: Vec<_> = model.joints.iter().map(meeting).collect();
    list.sort();
    list
}

#[test]
fn openings_joints_and_mortar_turn_with_the_wall() {
    for mortar in [0.0, 0.01] {
        let upright = meetings(&turned(0.0, mortar));
        assert!(upright.iter().any(|(_, class)| class == "head"));
        for degrees in [5.0, 45.0, 90.0, 133.0, 180.0, -20.0, 270.0] {
            assert_eq!(meetings(&turned(degrees, mortar)), upright, "{degrees} {mortar}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 12,
        rng_seed: RngSeed::Fixed(20_270_301),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_turned_wall_has_the_same_limit(degrees in -360.0..360.0) {
        assert_close(limit(&turned(degrees, 0.0)), limit(&turned(0.0, 0.0)), 1e-6);
    }
}
