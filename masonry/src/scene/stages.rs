//! The load history of a scene, as an ordered list of stages.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::setters::setters;
use super::strict;

/// A stage of the load history. Stages follow one another; loads and supports change in equal steps from their current
/// values to those of the stage.
///
/// Factors of loads multiply the values of the scene. A load that no stage names acts in full from the first stage on.
/// Any other load is zero before the first stage that names it, and keeps its value until the next stage that names
/// it. If there is friction, every step starts from the slip of the previous step.
///
/// ```
/// use masonry::scene::{Movement, Stage};
/// let settlement = Stage::new("settlement").steps(10).moves("floor", Movement::by(0.0, -0.01));
/// assert_eq!(settlement.moves["floor"].y, -0.01);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Stage {
    /// Name of the stage, in reports.
    pub name: String,
    /// Number of steps; 1 by default.
    #[serde(default = "one_step", skip_serializing_if = "is_one_step")]
    pub steps: u32,
    /// Factor of gravity at the end of the stage \[-\]; if it is not given, gravity does not change.
    pub gravity: Option<f64>,
    /// Factors of loads at the end of the stage \[-\], by the name of the load or of its group. They multiply the
    /// factor of the load itself.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub loads: BTreeMap<String, f64>,
    /// The movements of supports from their places in the scene, at the end of the stage, by the name of the support.
    #[serde(
        default,
        skip_serializing_if = "BTreeMap::is_empty",
        deserialize_with = "strict::read"
    )]
    pub moves: BTreeMap<String, Movement>,
}

/// Displacement of a support from its place in the scene. Displacements are small: the normals of its joints do not
/// rotate.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct Movement {
    /// Displacement of the support's middle along x \[length\].
    pub x: f64,
    /// Displacement of the support's middle along y \[length\].
    pub y: f64,
    /// Rotation of the support about its middle \[rad\], counter-clockwise.
    pub turn: f64,
}

impl Stage {
    /// Makes a stage of one step in which nothing changes.
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            steps: 1,
            gravity: None,
            loads: BTreeMap::new(),
            moves: BTreeMap::new(),
        }
    }

    setters! {
        /// Sets the number of steps.
        pub fn steps(mut self, steps: u32) { self.steps = steps }
        /// Sets the factor of gravity at the end of the stage \[-\], relative to gravity in the scene.
        pub fn gravity(mut self, factor: f64) { self.gravity = Some(factor) }
        /// Sets the factor of a load, or of all loads of a group, at the end of the stage \[-\], relative to the
        /// values in the scene.
        pub fn load(mut self, name: &str, factor: f64) {
            self.loads.insert(name.to_owned(), factor);
        }
        /// Moves a support to another place by the end of the stage.
        pub fn moves(mut self, support: &str, movement: Movement) {
            self.moves.insert(support.to_owned(), movement);
        }
    }
}

impl Movement {
    /// Makes a displacement \[length\] without rotation.
    pub fn by(x: f64, y: f64) -> Self {
        Self { x, y, turn: 0.0 }
    }

    /// Converts the movement to a unit of length that is `1 / factor` times as long.
    #[must_use]
    pub fn in_lengths(self, factor: f64) -> Self {
        Self { x: self.x * factor, y: self.y * factor, turn: self.turn }
    }

    /// Returns the movement between this one and `end`, at the fraction `fraction` of the difference.
    #[must_use]
    pub fn towards(self, end: Self, fraction: f64) -> Self {
        let between = |from: f64, to: f64| from + (to - from) * fraction;
        Self {
            x: between(self.x, end.x),
            y: between(self.y, end.y),
            turn: between(self.turn, end.turn),
        }
    }
}

fn one_step() -> u32 {
    1
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
fn is_one_step(steps: &u32) -> bool {
    *steps == 1
}
