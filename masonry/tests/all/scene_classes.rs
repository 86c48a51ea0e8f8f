//! Joint classes by wall and by pair of blocks, places of contact points by class, and what is unusual about magnitudes.

use masonry::model::joints::PointRule;
use masonry::model::{Body, Model};
use masonry::scene::{
    Block, Brick, Joint, Load, Material, Route, RouteSetting, Scene, SceneErrorKind, Support, Wall,
};
use masonry::{Units, solve};

const BRICK: Brick = Brick { length: 0.2, height: 0.1 };

/// Two walls side by side, and a lintel on both.
fn walls() -> Scene {
    let wall =
        |name: &str, x: f64| Wall::running_bond(name, "stone", BRICK, 0.4, 2).origin([x, 0.0]);
    let corners = [[0.0, 0.2], [0.8, 0.2], [0.8, 0.3], [0.0, 0.3]];
    Scene::new("Two walls", Units::SI)
        .thickness(0.1)
        .gravity([0.0, -9.81])
        .material("stone", Material::rigid().density(2000.0))
        .joint("bed", Joint::mu(0.5))
        .joint("head", Joint::mu(0.4))
        .joint("old", Joint::mu(0.3))
        .joint("glue", Joint::mu(0.6).cohesion(1e4).points(PointRule::Gauss))
        .wall(wall("left", 0.0))
        .wall(wall("right", 0.4))
        .block(Block::new("lintel", "stone", corners))
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "bed"))
}

/// For every joint between blocks, the names of its sides and of its class.
fn classes(scene: &Scene) -> Vec<[String; 3]> {
    let model = Model::from_scene(scene).unwrap();
    let of_joint = |joint: &masonry::model::PlacedJoint| {
        let Body::Block(a) = joint.a else { return None };
        let name = |id: masonry::ids::BlockId| model.blocks[id.index()].name.clone();
        Some([name(a), name(joint.b), model.joint_classes[joint.class].name.clone()])
    };
    model.joints.iter().filter_map(of_joint).collect()
}

#[test]
fn a_wall_has_classes_of_its_own_within_it() {
    let mut scene = walls();
    scene.walls[0] = scene.walls[0].clone().joints("old", "glue");
    for [a, b, class] in classes(&scene) {
        let of = |wall: &str| a.starts_with(wall) && b.starts_with(wall);
        let is_bed = a.split('/').nth(1) != b.split('/').nth(1) || b == "lintel";
        let expected = match (of("left"), is_bed) {
            (true, true) => "old",
            (true, false) => "glue",
            (false, true) => "bed",
            (false, false) => "head",
        };
        assert_eq!(class, expected, "{a} {b}");
    }
}

#[test]
fn a_pair_of_blocks_or_walls_has_a_class_of_its_own() {
    let scene = walls()
        .between("left", "right", "old")
        .between("lintel", "left", "glue")
        .between("left/2/1", "lintel", "old");
    let found = classes(&scene);
    assert!(found.iter().any(|[a, b, _]| a == "left/2/1" && b == "lintel"));
    for [a, b, class] in found {
        let expected = match (&a[..], &b[..]) {
            ("left/2/1", "lintel") => "old",
            (a, "lintel") if a.starts_with("left") => "glue",
            (a, b) if a.starts_with("left") && b.starts_with("right") => "old",
            (a, b) if a.split('/').nth(1) == b.split('/').nth(1) => "head",
            _ => "bed",
        };
        assert_eq!(class, expected, "{a} {b}");
    }
    let error = Model::from_scene(&walls().between("lintle", "left", "glue")).unwrap_err();
    assert_eq!(error.key(), "between[0].blocks[0]");
    assert!(error.to_string().contains("no block, wall or arch \"lintle\""), "{error}");
    assert!(error.to_string().contains("did you mean \"lintel\"?"), "{error}");
    let error = walls().between("lintel", "left", "gleu").check().unwrap_err();
    assert!(matches!(error.kind(), SceneErrorKind::Unknown { .. }));
    assert!(error.to_string().contains("did you mean \"glue\"?"), "{error}");
}

#[test]
fn contact_points_follow_their_class() {
    let scene = walls().between("lintel", "left", "glue");
    let model = Model::from_scene(&scene).unwrap();
    for (k, joint) in model.joints.iter().enumerate() {
        let class = &model.joint_classes[joint.class];
        let at_ends = model
            .contacts
            .iter()
            .filter(|point| point.joint.index() == k)
            .any(|point| (point.position - joint.from).norm() < 1e-9);
        assert_eq!(at_ends, class.name != "glue");
    }
    for route in [RouteSetting::Auto, Route::Lemke.into(), Route::Interior.into()] {
        let outcome = solve(&scene.clone().route(route)).unwrap();
        assert_eq!(outcome.solve.status, lcp::Status::Solved, "{route:?}");
    }
}

#[test]
fn written_scenes_read_back() {
    let mut scene = walls().between("lintel", "left", "glue");
    scene.walls[1] = scene.walls[1].clone().joints("old", "head");
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    // What is not used is not written.
    assert!(!walls().to_toml().unwrap().contains("between"));
}

#[test]
fn unusual_magnitudes_are_warnings() {
    let warned = |scene: &Scene, words: &str| {
        let outcome = solve(scene).unwrap();
        let found = outcome.judgement.warnings.iter().any(|warning| warning.contains(words));
        assert!(found, "{words}: {:?}", outcome.judgement.warnings);
    };
    let usual = walls();
    let warnings = Model::from_scene(&usual).unwrap().unusual();
    assert!(warnings.is_empty(), "{warnings:?}");
    warned(&usual.clone().gravity([0.0, -9810.0]), "Gravity is 9.81e3 m/s2");
    warned(&usual.clone().material("stone", Material::rigid().density(2.0)), "2e0 kg/m3");
    warned(
        &usual.clone().material("stone", Material::rigid()).load(Load::pressure(
            "top",
            [0.0, 0.3],
            [0.8, 0.3],
            10.0,
        )),
        "Gravity acts on nothing",
    );
    warned(
        &usual.clone().material("stone", Material::rigid()).load(Load::pressure(
            "top",
            [0.0, 0.3],
            [0.8, 0.3],
            10.0,
        )),
        "are the units right?",
    );
    let soft = usual.clone().joint("bed", Joint::mu(0.5).stiffness([4.0, 4e9]));
    warned(&soft, "The stiffness 4e0 N/m3 of a joint is 4e0 Pa/m");
    let mut weightless = usual.clone();
    weightless.gravity = None;
    warned(&weightless.load(Load::pressure("top", [0.0, 0.3], [0.8, 0.3], 1e4)), "no gravity");
    let mut elastic = usual
        .plane(masonry::model::Plane::Stress)
        .material("stone", Material::elastic(3e13, 0.2).density(2000.0));
    elastic.walls.iter_mut().for_each(|wall| wall.mesh = Some([1, 1]));
    elastic.blocks[0].mesh = Some([1, 1]);
    warned(&elastic, "E = 3e13 N/m2");
}
