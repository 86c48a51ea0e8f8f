//! Walls of which the truth is known.

use masonry::model::Plane;
use masonry::scene::{Brick, Joint, Load, Material, Scene, Support, Wall};

use super::common::{M_KN, rectangle};

fn scene(title: &str, mu: f64, thickness: f64, gravity: [f64; 2]) -> Scene {
    Scene::new(title, M_KN)
        .plane(Plane::Stress)
        .thickness(thickness)
        .gravity(gravity)
        .joint("bed", Joint::mu(mu))
        .joint("head", Joint::mu(mu))
}

/// The third wall of Ferris and Tin-Loi (2001), rigid, with an acceleration to the side in units of gravity.
pub(crate) fn tall_with_window(alpha: f64) -> Scene {
    let full = || vec![1.0; 4];
    let shifted = || vec![0.5, 1.0, 1.0, 1.0, 0.5];
    let narrow = || vec![0.5, 1.0, -1.0, 1.0, 0.5];
    let wide = || vec![1.0, 0.5, -1.0, 0.5, 1.0];
    let window = [narrow(), wide(), narrow(), wide(), narrow()];
    let mut courses = vec![full(), shifted(), full()];
    courses.extend(window);
    courses.extend([full(), shifted(), full()]);
    let brick = Brick { length: 0.4, height: 0.175 };
    scene("Wall with a window", 0.65, 1.0, [10.0 * alpha, -10.0])
        .material("stone", Material::rigid().density(1000.0))
        .wall(Wall::from_courses("w", "stone", brick, courses))
        .support(Support::new("base", [-0.5, 0.0], [2.1, 0.0], "bed"))
}

/// A door of twelve courses, rigid without a lintel, or elastic (`E` of the bricks) with one of concrete.
pub(crate) fn door(elastic: Option<f64>) -> Scene {
    let brick = Brick { length: 0.25, height: 0.125 };
    let [even, odd] = [
        vec![1.0, 1.0, 1.0, 1.0, -4.0, 1.0, 1.0, 1.0, 1.0],
        vec![0.5, 1.0, 1.0, 1.0, 0.5, -4.0, 0.5, 1.0, 1.0, 1.0, 0.5],
    ];
    let mut courses: Vec<Vec<f64>> =
        std::iter::repeat_n([even.clone(), odd], 6).flatten().collect();
    let above = [vec![1.0; 12], [vec![0.5], vec![1.0; 11], vec![0.5]].concat()];
    courses.push(match elastic {
        Some(_) => vec![1.0, 1.0, 1.0, -6.0, 1.0, 1.0, 1.0],
        None => even,
    });
    courses.extend((0..5).map(|k| above[(k + 1) % 2].clone()));
    let bricks = elastic.map_or(Material::rigid(), |young| Material::elastic(young, 0.2));
    let concrete = Material::elastic(3e7, 0.2).density(2500.0);
    let scene = scene("Wall with a door", 0.6, 0.24, [0.0, -9.81])
        .material("brick", bricks.density(1800.0))
        .wall(Wall::from_courses("wall", "brick", brick, courses).mesh([2, 1]))
        .support(Support::new("ground left", [0.0, 0.0], [1.0, 0.0], "bed"))
        .support(Support::new("ground right", [2.0, 0.0], [3.0, 0.0], "bed"))
        .load(Load::pressure("floor slab", [0.0, 2.25], [3.0, 2.25], 100.0));
    if elastic.is_none() {
        return scene;
    }
    let lintel = rectangle("lintel", "concrete", [0.75, 2.25], [1.5, 1.625]).mesh([24, 2]);
    scene.material("concrete", concrete).block(lintel)
}

/// A block under pressure that nothing holds against sliding, and nothing pushes.
pub(crate) fn on_a_smooth_floor() -> Scene {
    scene("Smooth floor", 0.0, 1.0, [0.0, 0.0])
        .material("brick", Material::elastic(1e5, 0.15))
        .block(rectangle("b", "brick", [0.0, 1.0], [0.0, 0.5]).mesh([8, 4]))
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "bed"))
        .load(Load::pressure("V", [0.0, 0.5], [1.0, 0.5], 10.0))
}

/// An elastic wall of this width \[m\] and number of courses on the ground, tilted by a part of gravity.
pub(crate) fn tilted(tilt: f64, width: f64, courses: u32) -> Scene {
    let brick = Brick { length: 0.25, height: 0.125 };
    let wall = Wall::running_bond("w", "brick", brick, width, courses).mesh([1, 1]);
    scene("Tilted wall", 0.6, 0.25, [9.81 * tilt, -9.81])
        .material("brick", Material::elastic(5e6, 0.15).density(1800.0))
        .wall(wall)
        .support(Support::new("f", [0.0, 0.0], [width, 0.0], "bed"))
}
