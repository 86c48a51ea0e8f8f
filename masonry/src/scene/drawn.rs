//! Drawings that `block_list` names, which a function passed to [`Scene::read_with`] reads.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::source::Source;
use super::{Between, Block, Scene, SceneError, Support};

/// The parts of a scene that are read from a drawing, in the units of the scene.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Drawn {
    /// The blocks of the drawing; their materials are defined in the scene.
    pub blocks: Vec<Block>,
    /// The place of each block in the drawing, for messages.
    #[serde(skip)]
    pub places: Vec<String>,
    /// The supports of the drawing; their joint classes are defined in the scene.
    pub supports: Vec<Support>,
    /// The joint classes between the blocks of the drawing.
    pub between: Vec<Between>,
    /// The changes to the drawing and the omissions from it, one kind in each line.
    #[serde(skip)]
    pub changes: Vec<String>,
}

/// A function that reads a drawing for a scene. Its arguments are the path and the bytes of the drawing, and the
/// scene; its error describes the mistake and the place of the mistake in the drawing.
pub type Drawings<'a> = &'a dyn Fn(&Path, &[u8], &Scene) -> Result<Drawn, String>;

impl Scene {
    /// Reads a scene from a TOML file as [`Scene::read`] does; its `block_list` may also be a drawing.
    ///
    /// # Errors
    /// As [`Scene::read`], and the errors of reading the drawing.
    pub fn read_with(path: &Path, drawings: Drawings) -> Result<Self, SceneError> {
        Self::read_by(path, Some(drawings))
    }

    /// Reads a scene from text, as [`Scene::read_with`] would from a file with this path. The file need not exist; the
    /// `block_list` is looked for beside it.
    ///
    /// # Errors
    /// As [`Scene::read_with`].
    pub fn from_toml_with(text: &str, path: &Path, drawings: Drawings) -> Result<Self, SceneError> {
        Self::parse(&Source::new(text, Some(path)), Some(drawings))
    }
}
