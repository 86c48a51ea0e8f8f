//! Scenes of the repository.

use std::path::Path;

use masonry::outcome::Outcome;
use masonry::scene::Scene;

pub fn scene(name: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    Scene::read(&folder.join(name).with_extension("toml")).unwrap()
}

pub fn solved(name: &str) -> Outcome {
    super::solved(&scene(name))
}

/// Forces and moment of foot and wall of the left side together, then of the right: between the two faces of a
/// lower corner brick any part of the force may be shifted.
pub fn sides(outcome: &Outcome) -> Vec<f64> {
    let sum = |names: [&str; 2]| {
        let of = outcome.reactions.iter().filter(|it| names.contains(&it.support.as_str()));
        of.fold([0.0; 3], |[x, y, m], it| [x + it.fx, y + it.fy, m + it.m])
    };
    [sum(["left foot", "left wall"]), sum(["right foot", "right wall"])].concat()
}
