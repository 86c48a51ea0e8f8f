//! Drawings that `block_list` names: the function that reads them is passed to [`Scene::read_with`].

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::source::Source;
use super::{Between, Block, Scene, SceneError, Support};

/// The parts that a drawing adds to a scene, in the units of the scene.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Drawn {
    /// The blocks, whose materials are those of the scene.
    pub blocks: Vec<Block>,
    /// The places of the blocks in the drawing, for messages.
    #[serde(skip)]
    pub places: Vec<String>,
    /// Supports, whose joint classes are those of the scene.
    pub supports: Vec<Support>,
    /// Joint classes between the blocks of the drawing.
    pub between: Vec<Between>,
    /// Changes of the drawing and omissions, one kind in each line.
    #[serde(skip)]
    pub changes: Vec<String>,
}

/// A function that reads a drawing for a scene, from its path and its bytes; the error has the mistake and its place in
/// the drawing.
pub type Drawings<'a> = &'a dyn Fn(&Path, &[u8], &Scene) -> Result<Drawn, String>;

impl Scene {
    /// Reads a scene from a TOML file as [`Scene::read`] does, whose `block_list` may be a drawing.
    ///
    /// # Errors
    /// As [`Scene::read`], and the error of the drawing.
    pub fn read_with(path: &Path, drawings: Drawings) -> Result<Self, SceneError> {
        Self::read_by(path, Some(drawings))
    }

    /// Reads a scene from text as [`Scene::read_with`] does from a file of this path, which need not exist: the `block_list` is
    /// beside it.
    ///
    /// # Errors
    /// As [`Scene::read_with`].
    pub fn from_toml_with(text: &str, path: &Path, drawings: Drawings) -> Result<Self, SceneError> {
        Self::parse(&Source::new(text, Some(path)), Some(drawings))
    }
}
