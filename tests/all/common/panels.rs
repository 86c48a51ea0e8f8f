//! Scenes of the repository.

use std::path::Path;

use masonry::analysis::outcome::{Outcome, Reaction};
use masonry::scene::Scene;

pub fn scene(name: &str) -> Scene {
    // A bench of another crate uses this, too.
    let folders = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().map(|it| it.join("scenes"));
    let folder = folders.into_iter().find(|it| it.is_dir()).unwrap();
    Scene::read(&folder.join(name).with_extension("toml")).unwrap()
}

pub fn solved(name: &str) -> Outcome {
    super::solved(&scene(name))
}

/// Forces and moment of foot and wall of the left side together, then of the right: between the two faces of a
/// lower corner brick any part of the force may be shifted.
pub fn sides(reactions: &[Reaction]) -> Vec<f64> {
    let sum = |side: &str| {
        let of_side = reactions.iter().filter(|it| it.support.starts_with(side));
        of_side.fold([0.0; 3], |[x, y, m], it| [x + it.fx, y + it.fy, m + it.m])
    };
    [sum("left"), sum("right")].concat()
}
