//! What the scenes of several themes are made of, and numbers that are read off their answers.

use masonry::analysis::outcome::Outcome;
use masonry::model::{Body, Plane};
use masonry::scene::{Brick, Joint, Load, Material, Scene, Support, Wall};
use nalgebra::Vector2;

use super::common::{GRAVITY, M_KN, applied_load, displacements, joint_resultant, rectangle};

/// Young's modulus of bricks, kN/m2.
pub const YOUNG: f64 = 1e6;

/// Metres and kilonewtons, weight, and one friction for all joints.
pub fn scene(title: &str, mu: f64) -> Scene {
    Scene::new(title, M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .gravity([0.0, -GRAVITY])
        .joint("bed", Joint::mu(mu))
        .joint("head", Joint::mu(mu))
}

pub fn elastic() -> Material {
    Material::elastic(YOUNG, 0.15).density(2000.0)
}

pub fn rigid() -> Material {
    Material::rigid().density(2000.0)
}

/// `count` blocks on top of each other on a floor, `size` wide and high, whose weight leans by `lean`.
pub fn stack(count: u32, [width, height]: [f64; 2], lean: f64, material: Material) -> Scene {
    let base = scene("Stack", 0.5).gravity([lean * GRAVITY, -GRAVITY]).material("stone", material);
    let floor = Support::new("floor", [-10.0 * width, 0.0], [11.0 * width, 0.0], "bed");
    (0..count).map(f64::from).fold(base.support(floor), |scene, k| {
        let y = [height * k, height * (k + 1.0)];
        scene.block(rectangle(&format!("{k}"), "stone", [0.0, width], y).mesh([2, 2]))
    })
}

/// A wall in running bond on a floor, its bricks 0.2 by 0.1, whose weight leans by a tenth.
pub fn wall(width: f64, courses: u32, mu: f64, material: Material) -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    scene("Wall", mu)
        .gravity([0.1 * GRAVITY, -GRAVITY])
        .material("brick", material)
        .wall(Wall::running_bond("wall", "brick", brick, width, courses).mesh([1, 1]))
        .support(Support::new("floor", [0.0, 0.0], [width, 0.0], "bed"))
}

/// A pressure on top of everything from `x = 0` to `width`.
pub fn pressed(scene: Scene, width: f64, height: f64, pressure: f64) -> Scene {
    scene.load(Load::pressure("top", [0.0, height], [width, height], pressure))
}

/// How far all reactions together are from what the loads ask for, relative to the loads.
pub fn reactions_off(outcome: &Outcome) -> f64 {
    let load = applied_load(&outcome.model);
    let sum: Vector2<f64> = outcome.reactions.iter().map(|it| Vector2::new(it.fx, it.fy)).sum();
    (sum + load).norm() / load.norm()
}

/// How far the resultant of the joints of `above` on `below` (a block, or the floor) is from `expected` \[N\],
/// relative to that.
pub fn joint_off(outcome: &Outcome, below: Body, above: &str, expected: Vector2<f64>) -> f64 {
    let above = super::common::block_named(&outcome.model, above);
    (joint_resultant(outcome, below, above) - expected).norm() / expected.norm()
}

/// How far the highest nodes of a block are from having sunk by `expected` \[m\], relative to that.
pub fn sinking_off(outcome: &Outcome, block: &str, expected: f64) -> f64 {
    let id = super::common::block_named(&outcome.model, block);
    let nodes = &outcome.model.blocks[id.index()].mesh.as_ref().unwrap().nodes;
    let top = nodes.iter().map(|p| p.y).fold(f64::MIN, f64::max);
    let of_top = nodes.iter().zip(displacements(outcome, block)).filter(|(p, _)| p.y >= top);
    of_top.map(|(_, u)| (u.y / -expected - 1.0).abs()).fold(0.0, f64::max)
}
