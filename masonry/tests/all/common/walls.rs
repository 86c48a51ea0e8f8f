//! Walls of several tests.

use masonry::Units;
use masonry::scene::{Brick, Joint, Load, Material, Plane, Scene, Support, Wall};

/// Two courses of elastic bricks between a floor and a load that leans.
pub fn leaning_wall() -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    Scene::new("Wall", Units::SI)
        .plane(Plane::Stress)
        .thickness(0.1)
        .material("brick", Material::elastic(1e8, 0.15))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .wall(Wall::running_bond("wall", "brick", brick, 0.4, 2).mesh([1, 1]))
        .support(Support::new("floor", [0.0, 0.0], [0.4, 0.0], "bed"))
        .load(Load::traction("top", [0.0, 0.2], [0.4, 0.2], [500.0, -1e4]))
}
