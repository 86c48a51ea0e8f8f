//! Scenes in which single effects are switched on and off.

use super::common::{GRAVITY, M_KN, rectangle};
use masonry::model::Plane;
use masonry::scene::{Brick, Films, Joint, Load, Material, PointRule, Scene, Support, Wall};

/// Two courses of three bricks in a box, with given material and joints.
pub(crate) fn boxed(bricks: Material, joint: Joint) -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    bare()
        .gravity([0.0, -GRAVITY])
        .material("brick", bricks.density(1800.0))
        .joint("bed", joint.clone())
        .joint("head", joint.clone())
        .joint("floor", joint)
        .wall(Wall::running_bond("wall", "brick", brick, 0.6, 2).mesh([2, 2]))
        .support(Support::new("floor", [0.0, 0.0], [0.6, 0.0], "floor"))
        .support(Support::new("left", [0.0, 0.0], [0.0, 0.2], "floor"))
        .support(Support::new("right", [0.6, 0.0], [0.6, 0.2], "floor"))
        .load(Load::pressure("top", [0.0, 0.2], [0.6, 0.2], 10.0))
}

pub(crate) fn elastic() -> Material {
    Material::elastic(1e6, 0.15)
}

/// Three elastic bricks, one on the other, pressed and pushed. Each rests on its two lower corners, so that
/// contact forces are unique too.
pub(crate) fn stack(bricks: Material, joint: Joint) -> Scene {
    column(bricks, joint, 0.0).gravity([0.0, -GRAVITY]).load(Load::traction(
        "push",
        [0.0, 0.0],
        [0.0, 0.3],
        [5.0, 0.0],
    ))
}

/// The same with mortar of this thickness between the bricks, pressed from above alone.
pub(crate) fn column(bricks: Material, joint: Joint, thickness: f64) -> Scene {
    let bottom = |course: f64| course * (0.1 + thickness);
    let mut scene = bare()
        .material("brick", bricks)
        .joint("bed", joint)
        .joint("floor", Joint::mu(0.6))
        .support(Support::new("floor", [-0.1, 0.0], [0.3, 0.0], "floor"));
    for (name, course) in [("lower", 0.0), ("middle", 1.0), ("upper", 2.0)] {
        let height = [bottom(course), bottom(course) + 0.1];
        scene = scene.block(rectangle(name, "brick", [0.0, 0.2], height).mesh([1, 2]));
    }
    let top = bottom(2.0) + 0.1;
    scene.load(Load::pressure("top", [0.0, top], [0.2, top], 100.0))
}

/// Two piers with a gap of a centimetre between them, each pulled away from it by a little.
pub(crate) fn piers(gap_limit: f64) -> Scene {
    let pull = |name, x: f64, force| Load::traction(name, [x, 0.0], [x, 0.6], [force, 0.0]);
    bare()
        .gravity([0.0, -GRAVITY])
        .material("brick", elastic().density(1800.0))
        .joint("floor", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .block(rectangle("left", "brick", [0.0, 0.2], [0.0, 0.6]).mesh([1, 3]))
        .block(rectangle("right", "brick", [0.21, 0.41], [0.0, 0.6]).mesh([1, 3]))
        .support(Support::new("floor", [-0.1, 0.0], [0.5, 0.0], "floor"))
        .load(pull("to the left", 0.0, -0.5))
        .load(pull("to the right", 0.41, 0.5))
        .gap_limit(gap_limit)
}

/// A column in mortar whose films act in these ways.
pub(crate) fn in_mortar(bricks: Material, films: Films) -> Scene {
    let joint = Joint::mu(0.6).mortar(0.01, "mortar");
    column(bricks, joint, 0.01).contact_points(PointRule::Gauss).films(films)
}

/// A wall of so many bricks on a floor, pressed by what is next to nothing.
pub(crate) fn long_wall(bricks: u32) -> Scene {
    let (brick, width) = (Brick { length: 0.2, height: 0.1 }, 0.2 * f64::from(bricks / 10));
    bare()
        .gravity([0.0, -GRAVITY])
        .material("brick", elastic().density(1800.0))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .wall(Wall::running_bond("wall", "brick", brick, width, 10).mesh([1, 1]))
        .support(Support::new("floor", [0.0, 0.0], [width, 0.0], "bed"))
}

fn bare() -> Scene {
    Scene::new("Effects", M_KN)
        .plane(Plane::Stress)
        .thickness(0.25)
        .material("mortar", Material::elastic(8e5, 0.2))
}
