//! Just below, at and just above the load at which a structure falls, and without any equilibrium.

use std::ops::Range;
use std::sync::Arc;

use masonry::model::Plane;
use masonry::scene::{Brick, Joint, Load, Material, Scene, Support, Wall};

use super::case::Case;
use super::common::{GRAVITY, M_KN, rectangle};
use super::page::ON_EDGE;
use super::scenes::{elastic, reactions_off, rigid, scene, stack};
use super::sweep::{Sweep, decades};

pub const TITLE: &str = "Limits";

/// How far from a limit.
const NEAR: f64 = 1e-6;

pub fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    for (kind, material) in KINDS {
        for structure in structures(kind, material()) {
            list.push(structure.below(NEAR));
            list.push(structure.at());
            list.push(structure.above(NEAR));
        }
        list.push(lifted(kind, material(), 20.0));
    }
    list.push(hanging(1.0));
    list.push(arch(1.2));
    list
}

pub fn sweeps() -> Vec<Sweep> {
    let distance = "distance from the limit / limit [-]";
    let mut list = Vec::new();
    for (kind, material) in KINDS {
        for structure in structures(kind, material()) {
            let structure = Arc::new(structure);
            let (lower, upper) = (Arc::clone(&structure), structure);
            let [below, above] =
                ["below", "above"].map(|at| format!("{}, {at} its limit", lower.name));
            list.push(Sweep::new(&below, distance, decades(-1, -14, 1), move |by| lower.below(by)));
            list.push(Sweep::new(&above, distance, decades(-1, -14, 1), move |by| upper.above(by)));
        }
        list.push(Sweep::new(
            &format!("block pulled up, {kind}"),
            "pull / weight - 1 [-]",
            decades(1, -14, 1),
            move |by| lifted(kind, material(), 2.0 * GRAVITY * (1.0 + by)),
        ));
    }
    let friction = [0.1, 0.2, 0.5, 1.0, 1.4, 1.6, 1.8, 2.2, 2.5, 3.0, 5.0, 10.0, 100.0];
    list.push(Sweep::new("panel without a floor", "mu [-]", friction, hanging));
    list
}

/// A kind of blocks, and their material.
type Kind = (&'static str, fn() -> Material);

const KINDS: [Kind; 2] = [("rigid", rigid), ("elastic", elastic)];

/// A structure under a load that grows.
struct Structure {
    name: String,
    parameters: &'static str,
    /// What it carries.
    limit: f64,
    loaded: Box<dyn Fn(f64) -> Scene + Send + Sync>,
}

fn structures(kind: &str, material: Material) -> [Structure; 4] {
    let structure = |name: &str, parameters, limit, loaded| Structure {
        name: format!("{name}, {kind}"),
        parameters,
        limit,
        loaded,
    };
    [
        structure(
            "sliding block",
            "2 x 1 m on a floor, limit mu = 0.5 of the weight",
            0.5,
            Box::new(move |lean| stack(1, [2.0, 1.0], lean, material)),
        ),
        structure(
            "tipping block",
            "0.2 x 1 m on a floor, mu = 0.5, limit b / h = 0.2 of the weight",
            0.2,
            Box::new(move |lean| stack(1, [0.2, 1.0], lean, material)),
        ),
        structure(
            "tipping stack",
            "five blocks 1 x 0.5 m on a floor, mu = 0.5, limit b / (n h) = 0.4 of the weight",
            0.4,
            Box::new(move |lean| stack(5, [1.0, 0.5], lean, material)),
        ),
        structure(
            "block held by thrust",
            "1 x 1 m, no weight, pressed against a wall by H = 25 kN on a platen 0.2 x 1 m in smooth guides, mu = 0.3, limit of the load on top 2 mu H = 15 kN",
            15.0,
            Box::new(move |force| held(force, material)),
        ),
    ]
}

const WHY: &str = "The load is a millionth below the limit, at the limit, or a millionth above it.";

impl Structure {
    /// At a load that is so much below the limit.
    fn below(&self, by: f64) -> Case {
        Case::new(
            &format!("{}, just below", self.name),
            WHY,
            (self.loaded)(self.limit * (1.0 - by)),
        )
        .parameters(&format!("{}, 1e-6 below it", self.parameters))
        .known("the sum of the reactions is the load", reactions_off)
    }

    /// At the limit itself, rounded.
    fn at(&self) -> Case {
        Case::new(&format!("{}{ON_EDGE}", self.name), WHY, (self.loaded)(self.limit))
            .parameters(&format!("{}, at the limit", self.parameters))
            .open("stands exactly at the limit; rounding decides, and either result is accepted")
    }

    /// At a load that is so much above it.
    fn above(&self, by: f64) -> Case {
        let name = format!("{}, just above", self.name);
        Case::new(&name, WHY, (self.loaded)(self.limit * (1.0 + by)))
            .parameters(&format!("{}, 1e-6 above it", self.parameters))
            .falls_by(by, "no equilibrium")
    }
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

/// Pulled by a pressure on its top [kN/m2].
fn lifted(kind: &str, material: Material, pull: f64) -> Case {
    let weight = 2.0 * GRAVITY;
    let load = Load::traction("pull", [0.0, 1.0], [1.0, 1.0], [0.0, pull]);
    Case::new(
        &format!("block pulled up, {kind}"),
        "No contact force can carry the load, for any friction.",
        stack(1, [1.0, 1.0], 0.0, material).load(load),
    )
    .parameters("1 x 1 m on a floor, mu = 0.5, 19.62 kN heavy, pulled up by 20 kN")
    .falls_by(pull / weight - 1.0, "no equilibrium")
}

/// Number of courses of the panel without a floor, three bricks of 0.1 x 0.1 m in each.
const COURSES: u32 = 3;

/// Only friction could carry it.
///
/// With `mu` from 1.2 on [its topmost course](arch) carries all, and the bricks below, which weigh nothing, hang
/// anywhere under it.
pub fn hanging(mu: f64) -> Case {
    let case = Case::new(
        "panel without a floor",
        "Only friction carries the load, and no linear condition decides whether it can: the panel widens slightly under the load and presses against the walls. The topmost course alone is an arch; the weightless bricks below it may be anywhere.",
        between_two_walls(mu, 0..COURSES),
    )
    .parameters(
        "three courses of three bricks 0.1 x 0.1 m in 2 x 2 elements each between two walls, mu = 1, E = 1e5 kN/m2, \
         no weight, 10 kN/m2 on top",
    );
    if mu < 1.2 {
        case.open("no equilibrium is known; from mu = 1.2 on there are several")
    } else {
        case.known("the sum of the reactions is the load, in any of several answers", reactions_off)
    }
}

/// The topmost course of that panel.
pub fn arch(mu: f64) -> Case {
    Case::new(
        "topmost course of that panel",
        "The largest ratio of friction to normal force is 1.199, at one point of each wall.",
        between_two_walls(mu, COURSES - 1..COURSES),
    )
    .parameters("the same without the courses below, mu = 1.2")
    .known("an arch of three bricks: the sum of the reactions is the load", reactions_off)
}

/// Some courses of a panel between walls, and a load on the uppermost.
fn between_two_walls(mu: f64, courses: Range<u32>) -> Scene {
    let brick = Brick { length: 0.1, height: 0.1 };
    let [bottom, top] = [courses.start, courses.end].map(|it| 0.1 * f64::from(it));
    let wall = Wall::running_bond("panel", "brick", brick, 0.3, courses.end - courses.start);
    Scene::new("Panel without a floor", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .material("brick", Material::elastic(1e5, 0.15))
        .joint("bed", Joint::mu(mu))
        .joint("head", Joint::mu(mu))
        .wall(wall.origin([0.0, bottom]).mesh([2, 2]))
        .support(Support::new("left wall", [0.0, bottom], [0.0, top], "head"))
        .support(Support::new("right wall", [0.3, bottom], [0.3, top], "head"))
        .load(Load::pressure("top", [0.0, top], [0.3, top], 10.0))
}
