//! Loads that are weights of masses: accelerations act on these masses too.

use masonry::analysis::limit::{Laws, limit_by};
use masonry::analysis::solve::solve;
use masonry::model::Plane;
use masonry::scene::{Joint, Load, Material, Scene, Support, Wall};
use masonry::units::Units;

use super::common::{M_KN, assert_close, rectangle};

/// A block of 0.2 m x 1 m and 200 kg, pushed by an acceleration; gravity is 10 m/s2.
fn pushed(material: Material, load: Option<Load>) -> Scene {
    let scene = Scene::new("Pushed", Units::SI)
        .plane(Plane::Stress)
        .thickness(1.0)
        .gravity([0.0, -10.0])
        .material("stone", material.density(1000.0))
        .joint("floor", Joint::mu(0.9))
        .block(rectangle("block", "stone", [0.0, 0.2], [0.0, 1.0]).mesh([2, 6]))
        .support(Support::new("ground", [-1.0, 0.0], [1.0, 0.0], "floor"))
        .load(Load::acceleration("quake", [10.0, 0.0]));
    load.into_iter().fold(scene, Scene::load).limit_group("quake")
}

/// The weight of the block again, spread over its top or in the middle of it.
fn roofs() -> [Load; 2] {
    [
        Load::pressure("roof", [0.0, 1.0], [0.2, 1.0], 10_000.0),
        Load::force("roof", "block", [0.1, 1.0], [0.0, -2000.0]),
    ]
}

/// It tips over when `a (m h / 2 + M h) = (m + psi_0 M) g b / 2`, with all of the load pressing down: without a mass of
/// the load at 0.4 of gravity, with half of it at 0.2, and with all of it at 0.4 / 3.
#[test]
fn a_mass_on_top_tips_a_block() {
    for roof in roofs() {
        for (part, factor) in [(0.0, 0.4), (0.5, 0.2), (1.0, 0.4 / 3.0)] {
            let scene = pushed(Material::rigid(), Some(roof.clone().mass(part)));
            let found = limit_by(&scene, Laws::Associative).unwrap().associative.unwrap();
            assert_close(found.load_factor.unwrap(), factor, 1e-4);
        }
    }
}

/// The floor has to hold both masses, under rigid and under elastic blocks.
#[test]
fn reactions_have_the_inertia_of_both_masses() {
    for material in [Material::rigid(), Material::elastic(1e9, 0.2)] {
        for roof in roofs() {
            let mut gentle = pushed(material, Some(roof.mass(1.0)));
            gentle.loads[0].factor = 0.1;
            let outcome = solve(&gentle).unwrap();
            let [fx, fy] = [outcome.reactions[0].fx, outcome.reactions[0].fy];
            assert_close(fx, -400.0, 1e-6);
            assert_close(fy, 4000.0, 1e-6);
        }
    }
}

/// A facade whose roof has its mass falls as one with the inertia of the roof as a load of its own.
#[test]
fn a_mass_is_the_traction_that_it_stands_for() {
    let facade = |roof: Load| {
        Scene::new("Facade", M_KN)
            .thickness(0.45)
            .gravity([0.0, -9.81])
            .material("stone", Material::rigid().density(2000.0))
            .joint("bed", Joint::mu(0.6))
            .joint("head", Joint::mu(0.6))
            .support(Support::new("ground", [0.0, 0.0], [3.0, 0.0], "bed"))
            .wall(Wall::running_bond(
                "wall",
                "stone",
                masonry::scene::Brick { length: 0.5, height: 0.25 },
                3.0,
                8,
            ))
            .load(roof)
            .load(Load::acceleration("mass of stone", [0.981, 0.0]).group("quake"))
            .limit_group("quake")
    };
    let factor =
        |scene: &Scene| limit_by(scene, Laws::Associative).unwrap().associative.unwrap().bound;
    let roof = || Load::pressure("roof", [0.0, 2.0], [3.0, 2.0], 15.0);
    let inertia = Load::traction("inertia", [0.0, 2.0], [3.0, 2.0], [1.5, 0.0]).group("quake");
    let by_hand = facade(roof().mass(0.0)).load(inertia);
    let [own, by_hand, none] = [facade(roof().mass(1.0)), by_hand, facade(roof().mass(0.0))]
        .map(|scene| factor(&scene).unwrap());
    assert_close(own, by_hand, 1e-4);
    assert!(none > 1.2 * own, "{none} without the mass, {own} with it");
}

/// Blocks without a density under a roof: the roof alone is accelerated.
#[test]
fn the_mass_of_a_load_is_enough() {
    let [roof, _] = roofs();
    let mut scene = pushed(Material::rigid(), Some(roof.mass(1.0)));
    scene.materials.insert("stone".to_owned(), Material::rigid());
    let found = limit_by(&scene, Laws::Associative).unwrap().associative.unwrap();
    assert_close(found.load_factor.unwrap(), 0.1, 1e-4);
}

/// Who does not say whether a load has a mass is asked.
#[test]
fn a_load_without_a_word_on_its_mass_is_told() {
    let warned = |load: Load| {
        let warnings =
            limit_by(&pushed(Material::rigid(), Some(load)), Laws::Associative).unwrap().warnings;
        warnings.iter().any(|it| it.contains("the `mass` of that load") && it.contains("\"roof\""))
    };
    for roof in roofs() {
        assert!(warned(roof.clone()));
        assert!(!warned(roof.clone().mass(0.0)) && !warned(roof.mass(1.0)));
    }
    assert!(!warned(Load::traction("roof", [0.0, 1.0], [0.2, 1.0], [100.0, 0.0])));
    let outcome = solve(&pushed(Material::rigid(), Some(roofs()[0].clone().factor(0.1)))).unwrap();
    assert!(outcome.judgement.warnings.iter().any(|it| it.contains("the `mass` of that load")));
}

#[test]
fn what_is_no_weight_has_no_mass() {
    let error = |scene: Scene| solve(&scene).unwrap_err().to_string();
    let lifted = Load::pressure("roof", [0.0, 1.0], [0.2, 1.0], -100.0).mass(1.0);
    assert!(error(pushed(Material::rigid(), Some(lifted))).contains("acts against gravity"));
    let more = Load::acceleration("more", [0.0, 1.0]).mass(0.5);
    assert!(error(pushed(Material::rigid(), Some(more))).contains("accelerations take none"));
    let mut floating = pushed(Material::rigid(), Some(roofs()[0].clone().mass(1.0)));
    floating.gravity = None;
    assert!(error(floating).contains("no load is a weight if gravity is missing or zero"));
    let [roof, _] = roofs();
    assert!(error(pushed(Material::rigid(), Some(roof.mass(1.5)))).contains("from 0 to 1"));
    let text = "name = \"roof\"\nfrom = [0, 1]\nto = [0.2, 1]\npressure = 1\nmass = \"all\"";
    let error = toml_error(text);
    assert!(error.contains("true, false, or a number from 0 to 1"), "{error}");
}

fn toml_error(load: &str) -> String {
    Scene::from_toml(&format!("title = \"\"\n[[loads]]\n{load}\n")).unwrap_err().to_string()
}
