//! Combinations of loads: each is the scene that has its factors.

use masonry::Verdict;
use masonry::analysis::limit::{Laws, limit_by};
use masonry::analysis::solve::solve;
use masonry::scene::{Combination, Joint, Load, Material, Scene, Stage, Support};
use masonry::units::Units;

use crate::common::{assert_close, rectangle};

/// A block of 0.2 m x 1 m and 2 kN with a roof of 2 kN, under wind from the left and in an earthquake; gravity is 10 m/s2.
fn block() -> Scene {
    Scene::new("Block", Units::SI)
        .thickness(1.0)
        .gravity([0.0, -10.0])
        .material("stone", Material::rigid().density(1000.0))
        .joint("floor", Joint::mu(0.9))
        .block(rectangle("block", "stone", [0.0, 0.2], [0.0, 1.0]))
        .support(Support::new("ground", [-1.0, 0.0], [1.0, 0.0], "floor"))
        .load(Load::pressure("roof", [0.0, 1.0], [0.2, 1.0], 10_000.0).mass(1.0))
        .load(Load::traction("wind", [0.0, 0.0], [0.0, 1.0], [100.0, 0.0]))
        .load(Load::acceleration("quake", [1.0, 0.0]))
}

/// The block without its earthquake.
fn without_quake() -> Scene {
    let mut scene = block();
    scene.loads.retain(|load| load.name != "quake");
    scene
}

/// The limit factors of associated flow of a group, by combination.
fn limits(scene: &Scene, group: &str) -> Vec<(String, f64)> {
    let acts = scene.combined().into_iter().filter(|it| it.of.acts(group));
    acts.map(|it| {
        let limit = limit_by(&it.of.limit_group(group), Laws::Associative).unwrap();
        assert_eq!(limit.title, format!("Block, {}", it.name));
        (it.name, limit.associative.unwrap().load_factor.unwrap())
    })
    .collect()
}

/// The factors of all loads, by combination.
fn factors(scene: &Scene) -> Vec<Vec<f64>> {
    let of = |scene: &Scene| scene.loads.iter().map(|load| load.factor).collect();
    scene.combined().iter().map(|it| of(&it.of)).collect()
}

/// The wind `w` tips it when `w h^2 / 2 = (G W + D R) b / 2`: at 800 N/m2 without factors.
#[test]
fn factors_of_weight_and_loads() {
    let scene = without_quake()
        .combination(Combination::new("plain").load("roof", 1.0).load("wind", 1.0))
        .combination(Combination::new("light").gravity(0.9).load("roof", 0.5).load("wind", 1.5))
        .combination(Combination::new("empty").gravity(0.0).load("roof", 1.0).load("wind", -1.0))
        .combination(Combination::new("calm").load("roof", 1.5));
    let found = limits(&scene, "wind");
    let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["plain", "light", "empty"]);
    for ((_, found), expected) in found.iter().zip([8.0, 0.4 * (0.9 + 0.5) * 10.0 / 1.5, 4.0]) {
        assert_close(*found, expected, 1e-4);
    }
}

/// An earthquake comes from both sides, on the mass of the roof that its combination has: `a (m h / 2 + D M h)
/// = (m + D M) g b / 2`. The wind, which another combination names, does not act beside it.
#[test]
fn earthquakes_come_from_both_sides() {
    let scene = block()
        .combination(Combination::new("storm").load("wind", 1.0))
        .combination(Combination::new("quake").load("roof", 0.3).load("quake", 2.0));
    let found = limits(&scene, "quake");
    let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["quake", "quake, opposite"]);
    for (_, factor) in found {
        assert_close(factor, 0.5 * (1.3 * 10.0 * 0.1) / (0.5 + 0.3), 1e-4);
    }
}

/// Who writes both sides has each once.
#[test]
fn both_sides_by_hand_are_not_doubled() {
    let scene = block()
        .combination(Combination::new("right").load("quake", 1.0))
        .combination(Combination::new("left").load("quake", -1.0));
    let names: Vec<String> = scene.combined().into_iter().map(|it| it.name).collect();
    assert_eq!(names, ["right", "left"]);
}

/// A roof in the group of the earthquake is a weight: it presses down in an earthquake from either side. What has no mass is turned.
#[test]
fn weights_keep_their_direction_in_an_earthquake() {
    let mut scene = block();
    for load in &mut scene.loads {
        load.group = Some("quake".to_owned());
    }
    let expected = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0]];
    assert_eq!(
        factors(&scene.clone().combination(Combination::new("quake").load("quake", 1.0))),
        expected
    );
    let reversed: Vec<f64> = scene.reversed("quake").loads.iter().map(|it| it.factor).collect();
    assert_eq!(reversed, expected[1]);
}

/// An earthquake acts across gravity, whatever direction gravity has.
#[test]
fn earthquakes_across_an_inclined_gravity() {
    let is_earthquake = |gravity: [f64; 2], acceleration: [f64; 2]| {
        let mut scene = block().gravity(gravity);
        scene.loads[2] = Load::acceleration("quake", acceleration);
        let sides = scene.clone().combination(Combination::new("quake")).combined().len();
        assert_eq!(sides == 2, scene.is_earthquake("quake"));
        sides == 2
    };
    assert!(is_earthquake([-10.0, 0.0], [0.0, 2.0]));
    assert!(!is_earthquake([-10.0, 0.0], [2.0, 0.0]));
    // Along gravity except for rounding.
    assert!(!is_earthquake([-0.3, -0.9], [0.1, 0.3]));
    assert!(is_earthquake([-0.3, -0.9], [0.1, 0.2]));
}

/// An earthquake that has a factor of zero accelerates nothing, and needs no mass.
#[test]
fn a_combination_without_weight_beside_an_earthquake() {
    let scene = block()
        .combination(Combination::new("wind").gravity(0.0).load("wind", 1.0))
        .combination(Combination::new("quake").load("quake", 1.0));
    let mut without_roof = scene;
    without_roof.loads.remove(0);
    let list = without_roof.combined();
    assert_eq!(list.iter().map(|it| it.of.check().is_ok()).collect::<Vec<_>>(), [true; 3]);
}

/// A load that no combination names acts in full in all, one that others name is zero.
#[test]
fn loads_that_a_combination_does_not_name() {
    let scene = block()
        .combination(Combination::new("weight"))
        .combination(Combination::new("storm").load("wind", 2.0));
    // The earthquake, which none names, acts in both and from both sides.
    let expected = [[1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [1.0, 2.0, 1.0], [1.0, 2.0, -1.0]];
    assert_eq!(factors(&scene), expected);
    assert!(block().combined().is_empty());
}

/// A group may have a member of its own name: the name means them all.
#[test]
fn a_group_with_a_member_of_its_name() {
    let gust = Load::traction("gust", [0.0, 0.0], [0.0, 1.0], [100.0, 0.0]).group("wind");
    let scene = without_quake()
        .load(gust)
        .combination(Combination::new("storm").load("wind", 3.0).load("roof", 1.0));
    let [(_, factor)] = limits(&scene, "wind").try_into().unwrap();
    assert_close(factor, 8.0 / 6.0, 1e-4);
}

/// Each is solved as the scene with its factors: the storm of 8 times the wind and more brings the block down.
#[test]
fn verdicts_of_combinations() {
    let scene = block()
        .combination(Combination::new("breeze").load("roof", 1.0).load("wind", 7.9))
        .combination(Combination::new("storm").load("roof", 1.0).load("wind", 8.1))
        .combination(Combination::new("quake").load("quake", 1.0));
    let verdicts: Vec<Verdict> =
        scene.combined().iter().map(|it| solve(&it.of).unwrap().verdict()).collect();
    let [stands, falls] = [Verdict::Stands, Verdict::Falls];
    assert_eq!(verdicts, [stands, falls, stands, stands]);
}

/// Several sets of loads are refused by what takes one, and beside stages.
#[test]
fn one_set_of_loads_is_wanted() {
    let scene = block().combination(Combination::new("storm").load("wind", 1.0));
    let errors = [
        solve(&scene).unwrap_err().to_string(),
        limit_by(&scene, Laws::Associative).unwrap_err().to_string(),
        masonry::ranges(&scene).unwrap_err().to_string(),
    ];
    for error in errors {
        assert!(error.contains("take one scene of `Scene::combined`"), "{error}");
    }
    let error = scene.stage(Stage::new("weight")).check().unwrap_err();
    assert_eq!(error.key(), "combinations", "{error}");
    assert!(error.to_string().contains("or remove `stages`"), "{error}");
}

/// Text and scene are the same.
#[test]
fn combinations_are_read_and_written() {
    let scene = block()
        .combination(Combination::new("storm").gravity(0.9).load("wind", 1.5))
        .combination(Combination::new("quake").load("quake", 1.0).load("roof", 0.3));
    let text = scene.to_toml().unwrap();
    assert_eq!(Scene::from_toml(&text).unwrap(), scene, "{text}");
    assert!(text.contains("gravity = 0.9") && !text.contains("gravity = 1.0"), "{text}");
}
