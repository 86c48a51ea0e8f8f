//! Just below and just above the load at which a structure falls, and without any equilibrium.

use masonry::model::Plane;
use masonry::scene::{Brick, Joint, Load, Material, Scene, Support, Wall};

use super::case::Case;
use super::common::{M_KN, rectangle};
use super::scenes::{elastic, reactions_off, rigid, scene, stack};

pub const TITLE: &str = "Limits";

/// How far from a limit.
const NEAR: f64 = 1e-6;

pub fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    for (kind, material) in [("rigid", rigid()), ("elastic", elastic())] {
        let sliding = |lean| stack(1, [2.0, 1.0], lean, material);
        let tipping = |lean| stack(1, [0.2, 1.0], lean, material);
        let high = |lean| stack(5, [1.0, 0.5], lean, material);
        let held = |force| held(force, material);
        let stack_limit = "five blocks 1 x 0.5 m, mu = 0.5, limit b / (n h) = 0.4 of the weight";
        list.extend(around(
            &format!("sliding block, {kind}"),
            "2 x 1 m, limit mu = 0.5 of the weight",
            0.5,
            sliding,
        ));
        list.extend(around(
            &format!("tipping block, {kind}"),
            "0.2 x 1 m, limit b / h = 0.2 of the weight",
            0.2,
            tipping,
        ));
        list.extend(around(&format!("tipping stack, {kind}"), stack_limit, 0.4, high));
        list.extend(around(
            &format!("block held by thrust, {kind}"),
            "1 x 1 m, H = 25 kN, mu = 0.3, limit 2 mu H = 15 kN",
            15.0,
            held,
        ));
        list.push(lifted(kind, material));
    }
    list.push(hanging());
    list
}

/// A structure at both sides of a limit.
fn around(name: &str, parameters: &str, limit: f64, loaded: impl Fn(f64) -> Scene) -> [Case; 2] {
    let why = "What carries is used up but for a millionth, or is too little by a millionth.";
    let below = Case::new(&format!("{name}, just below"), why, loaded(limit * (1.0 - NEAR)))
        .parameters(&format!("{parameters}, less 1e-6 of it"))
        .known("the sum of the reactions is the load", reactions_off);
    let above = Case::new(&format!("{name}, just above"), why, loaded(limit * (1.0 + NEAR)))
        .parameters(&format!("{parameters}, and 1e-6 of it more"))
        .falls("nothing stands");
    [below, above]
}

/// A block without weight between a wall and a platen that is pressed against it, loaded on top.
fn held(force: f64, material: Material) -> Scene {
    // The platen is as elastic as the block, so that all routes treat it.
    let material = Material { density: None, ..material };
    scene("Held block", 0.3)
        .material("stone", material)
        .joint("guide", Joint::mu(0.0))
        .block(rectangle("block", "stone", [0.0, 1.0], [0.0, 1.0]).mesh([2, 2]))
        .block(rectangle("platen", "stone", [1.0, 1.2], [0.0, 1.0]).mesh([1, 2]))
        .support(Support::new("wall", [0.0, 0.0], [0.0, 1.0], "head"))
        .support(Support::new("lower guide", [1.0, 0.0], [1.2, 0.0], "guide"))
        .support(Support::new("upper guide", [1.0, 1.0], [1.2, 1.0], "guide"))
        .load(Load::pressure("thrust", [1.2, 0.0], [1.2, 1.0], 25.0))
        .load(Load::pressure("top", [0.0, 1.0], [1.0, 1.0], force))
}

fn lifted(kind: &str, material: Material) -> Case {
    let pull = Load::traction("pull", [0.0, 1.0], [1.0, 1.0], [0.0, 20.0]);
    Case::new(
        &format!("block pulled up, {kind}"),
        "Nothing carries the load, whatever friction is.",
        stack(1, [1.0, 1.0], 0.0, material).load(pull),
    )
    .parameters("1 x 1 m, 19.62 kN heavy, pulled by 20 kN")
    .falls("nothing stands")
}

/// Only friction could carry it, and the walls are pressed too little.
fn hanging() -> Case {
    let brick = Brick { length: 0.1, height: 0.1 };
    let panel = Scene::new("Panel without a floor", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .material("brick", Material::elastic(1e5, 0.15))
        .joint("bed", Joint::mu(1.0))
        .joint("head", Joint::mu(1.0))
        .wall(Wall::running_bond("panel", "brick", brick, 0.3, 3).mesh([2, 2]))
        .support(Support::new("left wall", [0.0, 0.0], [0.0, 0.3], "head"))
        .support(Support::new("right wall", [0.3, 0.0], [0.3, 0.3], "head"))
        .load(Load::pressure("top", [0.0, 0.3], [0.3, 0.3], 10.0));
    Case::new(
        "panel without a floor",
        "It spreads under the load and presses the walls apart, but by too little to hang there; no condition \
         that is linear shows it.",
        panel,
    )
    .parameters("three courses of three bricks 0.1 x 0.1 m between two walls, mu = 1, E = 1e5 kN/m2, 10 kN/m2 on top")
    .falls("nothing stands: it would take mu near 1.9")
}
