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
