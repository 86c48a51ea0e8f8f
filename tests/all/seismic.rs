//! The seismic check of limit loads, against values by hand from the formulas of Circolare 7/2019, C8.7.1.2.1.

use masonry::analysis::limit::{Directions, Governs, Laws, Limit, SeismicCheck, limit_by};
use masonry::scene::{Block, Brick, Joint, Load, Material, Opening, Scene, Seismic, Support, Wall};
use masonry::units::Units;

use crate::common::{M_KN, assert_close, rectangle};

/// Blocks of 10 kN/m3 on the ground, pushed by an acceleration of gravity, which is 10 m/s2.
fn pushed(mu: f64, blocks: impl IntoIterator<Item = Block>) -> Scene {
    let scene = Scene::new("Pushed", Units::SI)
        .thickness(1.0)
        .gravity([0.0, -10.0])
        .material("stone", Material::rigid().density(1000.0))
        .joint("bed", Joint::mu(mu))
        .support(Support::new("ground", [-1.0, 0.0], [9.0, 0.0], "bed"))
        .load(Load::acceleration("quake", [10.0, 0.0]))
        .limit_group("quake");
    blocks.into_iter().fold(scene, Scene::block)
}

/// `alpha_0`, the weight that moves \[N\], and `e*`, by both laws.
#[track_caller]
fn assert_check(scene: &Scene, expected: [f64; 3]) -> SeismicCheck {
    let [associative, path] = [Laws::Associative, Laws::Path].map(|laws| {
        let check = limit_by(scene, laws).unwrap().seismic.unwrap();
        assert_eq!(check.is_of_path, laws == Laws::Path);
        let found = [check.multiplier, check.weight, check.fraction];
        for (found, expected) in found.into_iter().zip(expected) {
            assert_close(found, expected, 2e-4);
        }
        let capacity = check.multiplier * check.gravity / (check.fraction * check.data.confidence);
        assert_close(check.capacity, capacity, 1e-12);
        assert_close(check.mass * check.gravity, check.fraction * check.weight, 1e-12);
        check
    });
    assert!(path.multiplier <= associative.multiplier * (1.0 + 1e-4));
    associative
}

/// It tips at its breadth over its height, and all of its mass takes part: `a_0* = alpha_0 g / FC`.
#[test]
fn one_block_that_tips() {
    let block = rectangle("block", "stone", [0.0, 0.2], [0.0, 1.0]);
    let scene = pushed(0.7, [block]);
    let check = assert_check(&scene, [0.2, 2000.0, 1.0]);
    assert_close(check.capacity, 0.2 * 10.0 / 1.35, 1e-5);
    assert_eq!((check.demand, check.is_satisfied()), (None, None));
    // The demand is 0.25 x 10 x 1.2 / 2 = 1.5 m/s2, and the capacity 2 / FC.
    for (confidence, is_satisfied) in [(1.2, true), (1.35, false)] {
        let site = Seismic::site(0.25, 1.2).confidence(confidence);
        let limit = limit_by(&scene.clone().seismic(site), Laws::Associative).unwrap();
        let check = limit.seismic.unwrap();
        assert_close(check.demand.unwrap(), 1.5, 1e-12);
        assert_eq!(check.is_satisfied(), Some(is_satisfied));
    }
}

/// It slides at the coefficient of friction: all places move alike.
#[test]
fn one_block_that_slides() {
    let scene = pushed(0.3, [rectangle("block", "stone", [0.0, 1.0], [0.0, 1.0])]);
    assert_check(&scene, [0.3, 10_000.0, 1.0]);
}

/// Two blocks tip as one: displacements of 1/4 and 3/4 of that of the top, `e* = 1 / (2 (1/16 + 9/16)) = 0.8`.
#[test]
fn two_blocks_that_tip_as_one() {
    let halves = [("low", [0.0, 0.5]), ("high", [0.5, 1.0])];
    let blocks = halves.map(|(name, y)| rectangle(name, "stone", [0.0, 0.2], y));
    assert_check(&pushed(0.7, blocks), [0.2, 2000.0, 0.8]);
}

/// A slender block tips on a broad one, which rests and is not counted.
#[test]
fn a_block_at_rest_does_not_count() {
    let broad = rectangle("broad", "stone", [0.0, 2.0], [0.0, 0.5]);
    let slender = rectangle("slender", "stone", [1.0, 1.2], [0.5, 1.5]);
    assert_check(&pushed(0.7, [broad, slender]), [0.2, 2000.0, 1.0]);
}

/// The posts turn about their feet and the lintel moves along: displacements of 1/2, 1/2 and 1 of weights of 3, 3 and 3,
/// `e* = 6^2 / (9 x 4.5) = 8/9`; it fails at the breadth of a post over its height.
#[test]
fn a_portal() {
    let posts = [("left", 0.0), ("right", 2.5)];
    let posts = posts.map(|(name, x)| rectangle(name, "stone", [x, x + 0.5], [0.0, 3.0]));
    let lintel = rectangle("lintel", "stone", [0.0, 3.0], [3.0, 3.5]);
    let scene = pushed(0.8, posts.into_iter().chain([lintel]));
    assert_check(&scene, [1.0 / 6.0, 45_000.0, 8.0 / 9.0]);
}

/// A roof as heavy as the block: displacements of 1/2 and 1, `alpha_0 = 2 (b/2) / (h/2 + h)`, `e* = 1.5^2 / (2 x 1.25) = 0.9`. The
/// half of it that has no mass is not counted: `e* = (1/2 + 1/2)^2 / (1.5 x (1/4 + 1/2)) = 8/9`.
#[test]
fn a_roof_with_mass_on_a_block() {
    let roof = Load::pressure("roof", [0.0, 1.0], [0.2, 1.0], 10_000.0);
    let scene = pushed(0.7, [rectangle("block", "stone", [0.0, 0.2], [0.0, 1.0])]);
    let with = |mass| scene.clone().load(roof.clone().mass(mass));
    assert_check(&with(1.0), [0.4 / 3.0, 4000.0, 0.9]);
    assert_check(&with(0.5), [0.2, 3000.0, 8.0 / 9.0]);
}

/// The units of the scene change nothing, nor does the size of the acceleration that grows.
#[test]
fn units_and_the_size_of_the_load_do_not_matter() {
    let mut scene = pushed(0.7, [rectangle("block", "stone", [0.0, 0.2], [0.0, 1.0])]);
    scene.loads[0] = Load::acceleration("quake", [-0.5, 0.0]).factor(0.5);
    assert_check(&scene, [0.2, 2000.0, 1.0]);
    scene.units = M_KN;
    assert_check(&scene, [0.2, 2000.0, 1.0]);
}

/// Other loads than accelerations have no masses that are known.
#[test]
fn groups_with_other_loads_have_no_check() {
    let scene = pushed(0.7, [rectangle("block", "stone", [0.0, 0.2], [0.0, 1.0])])
        .seismic(Seismic::site(0.15, 1.0))
        .load(Load::traction("roof", [0.0, 1.0], [0.2, 1.0], [1000.0, 0.0]).group("quake"));
    assert_left_out(&scene, "other loads than accelerations");
}

#[track_caller]
fn assert_left_out(scene: &Scene, because: &str) {
    for laws in [Laws::Associative, Laws::Path] {
        let limit = limit_by(scene, laws).unwrap();
        let is_told = |it: &String| it.contains("check is left out") && it.contains(because);
        let Limit { seismic, warnings, .. } = &limit;
        assert!(seismic.is_none() && warnings.iter().any(is_told), "{laws:?}: {warnings:?}");
    }
}

/// Who gives a site is told why there is no check: nothing acts to the side, it falls without the earthquake, or no factor is too
/// large for a weight that is pressed into a corner.
#[test]
fn a_check_that_is_left_out_has_a_reason() {
    let block = || rectangle("block", "stone", [0.0, 0.2], [0.0, 1.0]);
    let scene = pushed(0.7, [block()]).seismic(Seismic::site(0.15, 1.0));
    let mut uplift = scene.clone();
    uplift.loads[0] = Load::acceleration("quake", [0.0, 10.0]);
    assert_left_out(&uplift, "no component across gravity");
    let wind = Load::traction("wind", [0.0, 0.0], [0.0, 1.0], [1e4, 0.0]);
    assert_left_out(&scene.clone().load(wind), "falls without");
    let wall = Support::new("wall", [0.2, 1.0], [0.2, 0.0], "bed");
    assert_left_out(&scene.support(wall), "there is no limit");
}

/// It tips when `a_x h / 2 = (g - a_y) b / 2` about its foot, `a_y = a_x / 2`: `alpha_0 = b / (h + b / 2) = 2 / 7` with b = 1, h = 3.
#[test]
fn only_the_component_across_gravity_counts() {
    let mut scene = pushed(0.7, [rectangle("block", "stone", [0.0, 1.0], [0.0, 3.0])]);
    scene.loads[0] = Load::acceleration("quake", [1.0, 0.5]);
    assert_check(&scene, [2.0 / 7.0, 30_000.0, 1.0]);
}

/// All bed joints slide at the same acceleration, so that any part of the courses may move. The whole wall has `e* = 1` and
/// `a_0* = mu g`, which does not meet a demand of 4 m/s2, whatever part the mechanism moves.
#[test]
fn a_wall_that_slides_in_any_joint() {
    let brick = Brick { length: 0.5, height: 0.25 };
    let site = Seismic::site(0.8, 1.0).confidence(1.0);
    let scene = pushed(0.3, [])
        .joint("head", Joint::mu(0.3))
        .wall(Wall::running_bond("wall", "stone", brick, 4.0, 8))
        .seismic(site);
    for laws in [Laws::Associative, Laws::Path] {
        let check = limit_by(&scene, laws).unwrap().seismic.unwrap();
        assert_close(check.demand.unwrap(), 4.0, 1e-12);
        assert_close(check.least_capacity, 3.0, 2e-4);
        assert!(check.capacity >= check.least_capacity * (1.0 - 1e-9), "{check:?}");
        assert_ne!(check.is_satisfied(), Some(true), "{check:?}");
        let modest = scene.clone().seismic(Seismic::site(0.5, 1.0).confidence(1.0));
        assert_eq!(limit_by(&modest, laws).unwrap().seismic.unwrap().is_satisfied(), Some(true));
    }
}

/// Two blocks, the upper one more slender, beside a wall on the left that holds the lower one. To the right both tip as one at 2/7 of
/// gravity and `e* < 1`; to the left the upper one tips at 0.3, at which `a_0*` is 3 m/s2: more, and less than to the right.
#[test]
fn the_direction_that_carries_more_may_have_the_worse_check() {
    let low = rectangle("low", "stone", [0.0, 1.0], [0.0, 2.0]);
    let high = rectangle("high", "stone", [0.2, 0.8], [2.0, 4.0]);
    let scene = pushed(0.9, [low, high])
        .support(Support::new("wall", [0.0, 0.5], [0.0, 2.0], "bed"))
        .seismic(Seismic::site(0.68, 1.0).confidence(1.0));
    let no_break = &mut |_| std::ops::ControlFlow::Continue(());
    let given = limit_by(&scene, Laws::Path).unwrap();
    let opposite = Directions::opposite(&given, &scene, Laws::Path, no_break).unwrap();
    let both = Directions::of(given, opposite);
    assert_eq!(both.governs, Governs::Given);
    let [given, opposite] = [&both.given, &both.opposite].map(|it| it.seismic.unwrap());
    assert_eq!([given, opposite].map(|it| it.is_satisfied()), [None, Some(false)]);
    assert!(given.capacity > 3.4 && opposite.capacity < 3.4, "{given:?} {opposite:?}");
    let is_told = |it: &String| it.contains("that of the opposite direction is worse");
    assert!(both.given.warnings.iter().any(is_told), "{:?}", both.given.warnings);
}

/// A facade with four windows fails at 3.3644 times a tenth of gravity both ways, with its roof as pressure and traction by hand
/// or as a load with mass.
#[test]
fn a_facade_under_a_roof_with_mass_both_ways() {
    let window = |x, below| Opening::door(x, 1.0, 6).above(below).bearing(0.25);
    let brick = Brick { length: 0.5, height: 0.25 };
    let wall = [(2.0, 4), (6.0, 4), (2.0, 16), (6.0, 16)]
        .into_iter()
        .fold(Wall::running_bond("facade", "stone", brick, 9.0, 26), |wall, (x, below)| {
            wall.opening(window(x, below))
        });
    let scene = Scene::new("Facade", M_KN)
        .thickness(0.45)
        .gravity([0.0, -9.81])
        .material("stone", Material::rigid().density(2000.0))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .wall(wall)
        .support(Support::new("ground", [0.0, 0.0], [9.0, 0.0], "bed"))
        .load(Load::pressure("roof", [0.0, 6.5], [9.0, 6.5], 15.0).mass(1.0))
        .load(Load::acceleration("quake", [0.981, 0.0]))
        .limit_group("quake");
    let given = limit_by(&scene, Laws::Associative).unwrap();
    let no_break = &mut |_| std::ops::ControlFlow::Continue(());
    let opposite = Directions::opposite(&given, &scene, Laws::Associative, no_break).unwrap();
    for limit in [given, opposite] {
        let factor = limit.associative.unwrap().load_factor.unwrap();
        assert_close(factor, 3.3644, 2e-5);
        let check = limit.seismic.unwrap();
        assert_close(check.multiplier, 0.1 * factor, 1e-9);
        assert!(check.fraction > 0.5 && check.fraction < 1.0, "{check:?}");
    }
}
