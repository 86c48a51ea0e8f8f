//! Walls of many bricks as contact problems.

use lcp::Contact2d;
use masonry::forms::Sparse;
use masonry::model::Model;
use masonry::scene::{Brick, Joint, Load, Material, Plane, Scene, Support, Wall};
use masonry::system::System;
use masonry::units::Units;

/// A wall in running bond of elastic bricks on a full floor, under its weight and a load on top that is
/// five times as heavy as the upper course and leans by a tenth. Gives the number of blocks, too.
pub(crate) fn wall(width: f64, courses: u32, mu: f64) -> (usize, Contact2d) {
    let top = 0.1 * f64::from(courses);
    let brick = Brick { length: 0.2, height: 0.1 };
    let scene = Scene::new("A wall", Units::SI)
        .plane(Plane::Stress)
        .thickness(0.1)
        .material("brick", Material::elastic(1e9, 0.15).density(2000.0))
        .joint("bed", Joint::mu(mu))
        .joint("head", Joint::mu(mu))
        .joint("floor", Joint::mu(mu))
        .wall(Wall::running_bond("wall", "brick", brick, width, courses).mesh([1, 1]))
        .support(Support::new("floor", [0.0, 0.0], [width, 0.0], "floor"))
        .load(Load::traction("top", [0.0, top], [width, top], [1000.0, -10_000.0]));
    let model = Model::from_scene(&scene).expect("the scene is sound");
    let system = System::new(&model).expect("the blocks are sound");
    let problem = Sparse::new(&system).expect("the data are finite").problem;
    (model.blocks.len(), problem)
}
