//! A small wall that tests of load histories share.

use masonry::scene::{Brick, Joint, Load, Material, Plane, Scene, Stage, Support, Wall};
use masonry::units::Units;

/// A small elastic wall on a floor, loaded from above and then from the side.
pub fn wall() -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    Scene::new("Small wall", Units::SI)
        .plane(Plane::Stress)
        .thickness(0.1)
        .material("stone", Material::elastic(1e8, 0.2))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .wall(Wall::running_bond("wall", "stone", brick, 0.6, 4).mesh([2, 1]))
        .support(Support::new("floor", [0.0, 0.0], [0.6, 0.0], "bed"))
        .load(Load::pressure("top", [0.0, 0.4], [0.6, 0.4], 1e5))
        .load(Load::pressure("side", [0.0, 0.0], [0.0, 0.4], 7e4))
}

/// The wall loaded, pushed and released, each in so many steps.
pub fn pushed(steps: u32) -> Scene {
    wall()
        .stage(Stage::new("weight").steps(steps).load("top", 1.0))
        .stage(Stage::new("push").steps(steps).load("side", 1.0))
        .stage(Stage::new("release").steps(steps).load("side", 0.0))
}
