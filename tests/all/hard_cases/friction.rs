//! Coefficients of friction of every size, wedges, bodies that jam, and several answers.

use masonry::ids::SupportId;
use masonry::model::Body;
use masonry::scene::{Block, Joint, Load, Material, Route, Scene, Support};
use nalgebra::Vector2;

use super::case::Case;
use super::common::{GRAVITY, panels, rectangle};
use super::scenes::{YOUNG, elastic, joint_off, reactions_off, rigid, scene, stack, wall};
use super::sweep::{Sweep, decades};

pub const TITLE: &str = "Friction";

pub fn cases() -> Vec<Case> {
    let mut list: Vec<Case> = [0.0, 1e-8, 1.0, 10.0, 1e6].into_iter().map(pushed).collect();
    list.extend([0.0, 1e-8, 1.0, 10.0, 1e6].map(rough_wall));
    for (kind, material) in [("rigid", rigid()), ("elastic", elastic())] {
        list.push(smooth_wedge(kind, material, 20.0));
        list.push(pulled_wedge(kind, material, 0.6));
        list.push(tight_box(kind, material));
    }
    list.push(panel(1.0));
    list
}

pub fn sweeps() -> Vec<Sweep> {
    let friction = "mu [-]";
    let mut list = vec![
        Sweep::new("pushed block", friction, decades(-12, 12, 1), pushed),
        Sweep::new("leaning wall", friction, decades(0, 12, 1).map(|it| 0.2 * it), rough_wall),
        Sweep::new(
            "panel between walls",
            friction,
            [0.1, 0.2, 0.5, 0.7, 1.0, 1.5, 2.0, 5.0, 10.0, 100.0],
            panel,
        ),
    ];
    for (kind, material) in [("rigid", rigid()), ("elastic", elastic())] {
        let angles = [1e-6, 1e-4, 1e-2, 0.1, 1.0, 5.0, 10.0, 20.0, 26.0];
        list.push(Sweep::new(
            &format!("smooth wedge, {kind}"),
            "angle of the faces from the vertical [degrees]",
            angles,
            move |angle| smooth_wedge(kind, material, angle),
        ));
        list.push(Sweep::new(
            &format!("wedge pulled out, {kind}"),
            friction,
            [0.1, 0.2, 0.3, 0.35, 0.363, 0.364, 0.37, 0.4, 0.6, 1.0, 3.0, 10.0, 100.0],
            move |mu| pulled_wedge(kind, material, mu),
        ));
    }
    list
}

/// A flat block, pushed by half of what slides or tips it.
fn pushed(mu: f64) -> Case {
    let lean = 0.5 * mu.min(4.0);
    let mut scene = stack(1, [4.0, 1.0], lean, elastic()).joint("bed", Joint::mu(mu));
    if mu <= 0.0 {
        scene = between_walls(scene, 4.0, 1.0);
    }
    Case::new(
        &format!("mu = {}, block", number(mu)),
        "The friction cone is nearly a line, or nearly the half plane.",
        scene,
    )
    .parameters(
        "4 x 1 m on a floor, pushed by min(mu, b / h) / 2 of its weight; for mu = 0 between smooth walls",
    )
    .known("the floor carries weight and push, with an error relative to the weight", move |outcome| {
        let weight = 8000.0 * GRAVITY;
        let reaction = &outcome.reactions[0];
        (reaction.fx / weight + lean).hypot(reaction.fy / weight - 1.0)
    })
}

/// Without zeros that nobody counts.
fn number(mu: f64) -> String {
    if mu > 0.0 && !(1e-3..1e3).contains(&mu) { format!("{mu:e}") } else { mu.to_string() }
}

/// Without friction nothing else stops a motion to the side.
fn between_walls(scene: Scene, width: f64, height: f64) -> Scene {
    scene
        .joint("smooth", Joint::mu(0.0))
        .support(Support::new("left", [0.0, 0.0], [0.0, height], "smooth"))
        .support(Support::new("right", [width, 0.0], [width, height], "smooth"))
}

fn rough_wall(mu: f64) -> Case {
    let mut scene = wall(0.6, 3, mu, elastic());
    if mu < 0.1 {
        scene = between_walls(scene.gravity([0.0, -GRAVITY]), 0.6, 0.3);
    }
    Case::new(
        &format!("mu = {}, wall", number(mu)),
        "The problem is not copositive for large friction; without friction, or nearly so, nothing holds bricks sideways.",
        scene,
    )
    .parameters("three courses of three bricks, weight inclined by 0.1; for mu < 0.1 upright, between smooth walls")
    .known("the sum of the reactions is the load", reactions_off)
}

/// A key between faces inclined by an angle in degrees.
fn wedge(angle: f64, mu: f64, material: Material) -> Scene {
    let foot = angle.to_radians().tan();
    let (left, right) = ([foot, 0.0], [1.0 - foot, 0.0]);
    scene("Wedge", mu)
        .material("stone", material)
        .block(Block::new("key", "stone", [left, right, [1.0, 1.0], [0.0, 1.0]]).mesh([2, 3]))
        .support(Support::new("left", left, [0.0, 1.0], "head"))
        .support(Support::new("right", right, [1.0, 1.0], "head"))
}

fn smooth_wedge(kind: &str, material: Material, angle: f64) -> Case {
    Case::new(
        &format!("smooth wedge, {kind}"),
        "No normal is vertical: every contact force both carries the wedge and pushes it sideways.",
        wedge(angle, 0.0, material),
    )
    .parameters("key 1 m high, 1 m wide on top and 0.27 m at the foot, faces inclined by 20 degrees from the vertical, in 2 x 3 elements if elastic, mu = 0, own weight")
    // The forces are as much larger than the weight, and residuals are relative to them.
    .amplified(1.0 / angle.to_radians().sin())
    .known("each face carries W / (2 sin 20)", move |outcome| {
        let (sin, cos) = angle.to_radians().sin_cos();
        let force = 2000.0 * GRAVITY * (1.0 - sin / cos) / (2.0 * sin);
        let off = |face, inwards: Vector2<f64>| {
            joint_off(outcome, Body::Support(SupportId(face)), "key", inwards * force)
        };
        off(0, Vector2::new(cos, sin)).max(off(1, Vector2::new(-cos, sin)))
    })
}

fn pulled_wedge(kind: &str, material: Material, mu: f64) -> Case {
    let pull = [0.0, 30.0];
    let scene =
        wedge(20.0, mu, material).load(Load::traction("pull", [0.0, 1.0], [1.0, 1.0], pull));
    Case::new(
        &format!("wedge pulled out, {kind}"),
        "The friction cone is steeper than the faces: a jammed wedge cannot be pulled out, and the data do not say whether it is jammed.",
        scene,
    )
    .parameters("the same key, mu = 0.6 > tan 20, pulled up by 30 kN against a weight of 12.5 kN")
    .open("a rigid key stands if a large enough force jams it, an elastic one comes out")
}

fn tight_box(kind: &str, material: Material) -> Case {
    let scene = scene("Tight box", 1.0)
        .material("stone", material)
        .block(rectangle("block", "stone", [0.0, 1.0], [0.0, 1.0]).mesh([2, 2]))
        .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"))
        .support(Support::new("left", [0.0, 0.0], [0.0, 1.0], "head"))
        .support(Support::new("right", [1.0, 0.0], [1.0, 1.0], "head"));
    Case::new(
        &format!("block in a tight box, {kind}"),
        "The block may rest on the floor, hang between the walls, or both; the walls may press with any force.",
        scene,
    )
    .parameters("1 x 1 m, mu = 1, own weight")
    .known("the sum of the reactions is the weight", reactions_off)
}

fn panel(mu: f64) -> Case {
    let mut scene = panels::scene("panel_rectangular").stresses(false);
    scene.walls[0].mesh = Some([2, 1]);
    for joint in scene.joints.values_mut() {
        joint.mu = Some(mu);
    }
    Case::new(
        "rectangular panel at mu = 1",
        "Two exact solutions: bricks of the lowest course hang by friction, or drop.",
        scene,
    )
    .slow_by(if mu > 1.5 { &[Route::Pgs] } else { &[] })
    .parameters(&format!(
        "`scenes/panel_rectangular.toml` with a mesh of 2 x 1: 55 bricks, E = {:e} kN/m2",
        0.1 * YOUNG
    ))
    .known("the sum of the reactions is the load, in either solution", reactions_off)
}
