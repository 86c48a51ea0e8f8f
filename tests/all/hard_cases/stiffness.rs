//! Stiff beside soft, heavy beside light, and units.

use masonry::ids::SupportId;
use masonry::model::Body;
use masonry::scene::{Joint, Load, Material, Route, Scene, Support};
use masonry::units::{ForceUnit, LengthUnit, Units};
use nalgebra::Vector2;

use super::case::Case;
use super::common::{GRAVITY, M_KN, block_named, rectangle};
use super::scenes::{
    YOUNG, elastic, joint_off, pressed, reactions_off, scene, sinking_off, stack, wall,
};
use super::sweep::{Sweep, decades};

pub const TITLE: &str = "Stiffness, weight and units";

pub fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    for (ratio, words) in [(1e-6, "softer"), (1e6, "stiffer")] {
        list.push(mortared_column(ratio, words));
        list.push(mortared_wall(ratio, words));
    }
    list.push(heavy("a brick on one that is 1e6 times heavier", vec![1e6, 1.0]));
    list.push(heavy("a brick under one that is 1e6 times heavier", vec![1.0, 1e6]));
    list.push(heavy("a brick that is 1e9 times heavier between two", vec![1.0, 1e9, 1.0]));
    list.push(side_by_side(1e6));
    list.extend(UNITS.map(in_units));
    list
}

pub fn sweeps() -> Vec<Sweep> {
    let ratio = "E of the mortar / E of the bricks [-]";
    let heavier = "weight of the heavy block / weight of the light one [-]";
    let heavy = |title: &str, times: fn(f64) -> Vec<f64>| {
        Sweep::new(title, heavier, decades(0, 14, 1), move |by| heavy("heavy", times(by)))
    };
    vec![
        Sweep::new("mortar in a column", ratio, decades(-9, 9, 1), |by| mortared_column(by, "")),
        Sweep::new("mortar in a wall", ratio, decades(-9, 9, 1), |by| mortared_wall(by, "")),
        heavy("light block on a heavy one", |by| vec![by, 1.0]),
        heavy("light block under a heavy one", |by| vec![1.0, by]),
        heavy("heavy block between light ones", |by| vec![1.0, by, 1.0]),
        Sweep::new("light block beside a heavy one", heavier, decades(0, 14, 1), side_by_side),
        Sweep::new("size of a wall", "length of a brick [m]", decades(-12, 12, 2), sized),
    ]
}

const RATIO: &str =
    "Displacements of bricks and films differ by the ratio, and so do the terms of one equation.";

fn mortared_column(ratio: f64, words: &str) -> Case {
    let film = 0.01;
    let base = scene("Column in mortar", 0.5)
        .material("brick", Material::elastic(YOUNG, 0.0))
        .material("mortar", Material::elastic(ratio * YOUNG, 0.0))
        .joint("bed", Joint::mu(0.5).mortar(film, "mortar"))
        .joint("floor", Joint::mu(0.5))
        .support(Support::new("floor", [0.0, 0.0], [0.2, 0.0], "floor"));
    let bricks = (0..4).map(f64::from).fold(base, |scene, k| {
        let y = k * (0.1 + film);
        scene.block(rectangle(&format!("{k}"), "brick", [0.0, 0.2], [y, y + 0.1]).mesh([2, 1]))
    });
    let sinks = (0.4 + 3.0 * film / ratio) * 1e-6;
    Case::new(
        &format!("mortar {words} than the bricks by 1e6, column"),
        RATIO,
        pressed(bricks, 0.2, 0.4 + 3.0 * film, 1e-6 * YOUNG),
    )
    .parameters("four bricks 0.2 x 0.1 m in 2 x 1 elements, three films of 0.01 m, pressure E/1e6, no weight, nu = 0, mu = 0.5")
    .known("the top sinks by p (4 h / E + 3 t_y / E_m)", move |outcome| {
        sinking_off(outcome, "3", sinks)
    })
}

fn mortared_wall(ratio: f64, words: &str) -> Case {
    let film = 0.01;
    let joint = Joint::mu(0.6).mortar(film, "mortar");
    let (width, height) = (3.0 * (0.2 + film) - film, 3.0 * (0.1 + film) - film);
    let filled = wall(width, 3, 0.6, elastic())
        .material("mortar", Material::elastic(ratio * YOUNG, 0.15))
        .joint("floor", Joint::mu(0.6))
        .joint("bed", joint.clone())
        .joint("head", joint);
    let mut filled = pressed(filled, width, height, 10.0);
    "floor".clone_into(&mut filled.supports[0].joint);
    Case::new(&format!("mortar {words} than the bricks by 1e6, wall"), RATIO, filled)
        .long_by(&[Route::Pgs])
        .parameters("three courses of three bricks, films of 0.01 m, mu = 0.6, pressed by 10 kN/m2, weight inclined by 0.1")
        .known("the sum of the reactions is the load", reactions_off)
}

/// Digits of forces below this part of the largest are rounding errors of these.
const LIGHTEST: f64 = 1e-6;

const WEIGHT: &str = "Rounding errors of the forces on the heavy block may be as large as the forces on the light one.";

/// Weight of a block of density 2000 and size 1 \[N\].
const LIGHT: f64 = 2000.0 * GRAVITY;

/// Blocks on a floor, from below, so many times as heavy as stone.
fn heavy(name: &str, times: Vec<f64>) -> Case {
    let lean = 0.2;
    let blocks = u32::try_from(times.len()).unwrap();
    let mut scene = stack(blocks, [1.0, 1.0], lean, elastic());
    for (block, times) in scene.blocks.iter_mut().zip(&times) {
        block.material = format!("{times}");
    }
    let scene = times.iter().fold(scene, |scene: Scene, times| {
        scene.material(&format!("{times}"), elastic().density(2000.0 * times))
    });
    Case::new(name, WEIGHT, scene)
        .parameters("blocks 1 x 1 m on top of each other on a floor, mu = 0.5, pushed by 0.2 of their weight")
        .known(
            "every joint carries the weight above it, with an error relative to that weight or to a millionth of the total",
            move |outcome| {
                let below = |k: usize| match k.checked_sub(1) {
                    Some(k) => Body::Block(block_named(&outcome.model, &k.to_string())),
                    None => Body::Support(SupportId(0)),
                };
                let off = |k: usize| {
                    let [carried, all] = [k, 0].map(|k| times[k..].iter().sum::<f64>());
                    let expected = Vector2::new(-lean, 1.0) * (carried * LIGHT);
                    let off = joint_off(outcome, below(k), &k.to_string(), expected);
                    off * carried / carried.max(LIGHTEST * all)
                };
                (0..times.len()).map(off).fold(0.0, f64::max)
            },
        )
}

fn side_by_side(times: f64) -> Case {
    let scene = scene("Neighbours", 0.0)
        .material("light", Material::elastic(YOUNG, 0.0).density(2000.0))
        .material("heavy", Material::elastic(YOUNG, 0.0).density(2000.0 * times))
        .block(rectangle("light", "light", [0.0, 1.0], [0.0, 1.0]).mesh([2, 2]))
        .block(rectangle("heavy", "heavy", [1.0, 2.0], [0.0, 1.0]).mesh([2, 2]))
        .support(Support::new("floor", [0.0, 0.0], [2.0, 0.0], "bed"))
        .support(Support::new("left", [0.0, 0.0], [0.0, 1.0], "head"))
        .support(Support::new("right", [2.0, 0.0], [2.0, 1.0], "head"));
    Case::new("a brick beside one that is 1e6 times heavier", WEIGHT, scene)
        .parameters("two blocks 1 x 1 m between two walls, mu = 0, nu = 0")
        .known("the floor carries each", move |outcome| {
            let floor = Body::Support(SupportId(0));
            let off = |name: &str, carried: f64| {
                let off = joint_off(outcome, floor, name, Vector2::new(0.0, carried * LIGHT));
                off * carried / carried.max(LIGHTEST * times)
            };
            off("light", 1.0).max(off("heavy", times))
        })
}

/// Units of one scene.
pub const UNITS: [Units; 3] = [
    M_KN,
    Units { length: LengthUnit::Mm, force: ForceUnit::N },
    Units { length: LengthUnit::Km, force: ForceUnit::Gn },
];

fn in_units(units: Units) -> Case {
    let scene = pressed(wall(0.6, 3, 0.6, elastic()), 0.6, 0.3, 10.0);
    let names = format!("{} and {}", units.length_name(), units.force_name());
    Case::new(
        &format!("one wall in {names}"),
        "The numbers of the scene differ by up to 1e12; statuses and solutions must be the same.",
        converted(scene, units),
    )
    .long_by(&[Route::Pgs])
    .parameters(
        "three courses of three bricks, mu = 0.6, pressed by 10 kN/m2, weight inclined by 0.1",
    )
    .known("the sum of the reactions is the load; one answer in all units", reactions_off)
}

/// The wall with bricks of a length \[m\], as heavy in all as it is.
fn sized(length: f64) -> Case {
    let scale = length / 0.2;
    let mut scene = scaled(pressed(wall(0.6, 3, 0.6, elastic()), 0.6, 0.3, 10.0), scale, 1.0);
    for material in scene.materials.values_mut() {
        material.density = material.density.map(|it| it / scale);
    }
    Case::new("wall of any size", "Nothing but the unit of length changes.", scene)
        .known("the sum of the reactions is the load", reactions_off)
}

/// A scene of blocks, walls and pressures in other units.
fn converted(scene: Scene, units: Units) -> Scene {
    let length = scene.units.length_to_si() / units.length_to_si();
    let stress = scene.units.stress_to_si() / units.stress_to_si();
    let mut scene = scaled(scene, length, stress);
    scene.units = units;
    scene
}

/// Lengths and stresses times these.
fn scaled(mut scene: Scene, length: f64, stress: f64) -> Scene {
    let moved = |point: [f64; 2]| point.map(|x| x * length);
    scene.thickness = scene.thickness.map(|it| it * length);
    for material in scene.materials.values_mut() {
        material.young = material.young.map(|it| it * stress);
    }
    for wall in &mut scene.walls {
        wall.origin = moved(wall.origin);
        wall.width = wall.width.map(|it| it * length);
        [wall.brick.length, wall.brick.height] = moved([wall.brick.length, wall.brick.height]);
    }
    for support in &mut scene.supports {
        [support.from, support.to] = [support.from, support.to].map(moved);
    }
    for load in &mut scene.loads {
        let Load { from, to, pressure, .. } = load;
        [*from, *to] = [*from, *to].map(|end| end.map(moved));
        *pressure = pressure.map(|it| (it.from * stress).into());
    }
    scene
}
