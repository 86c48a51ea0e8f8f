//! The load history of a scene: ordered stages.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::setters::setters;
use super::strict;

/// A stage of the load history. Stages follow one another; loads and supports change in equal steps from their current
/// values to those of the stage.
///
/// Values of loads are factors of those of the scene. A load that is named in no stage acts in full from the first
/// stage on; any other load is zero before the first stage that names it, and keeps its value until the next one. Every
/// step starts from the slip of the previous one, if there is friction.
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
    /// Factor of gravity at the end of the stage \[-\].
    pub gravity: Option<f64>,
    /// Factors of loads at the end of the stage \[-\] in addition to their own, by the name of the load or of its group.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub loads: BTreeMap<String, f64>,
    /// The positions of supports at the end of the stage, by the name of the support.
    #[serde(
        default,
        skip_serializing_if = "BTreeMap::is_empty",
        deserialize_with = "strict::read"
    )]
    pub moves: BTreeMap<String, Movement>,
}

/// Displacement of a support from its place in the scene. Displacements are small: the normal of its joints does not rotate.
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
    /// A stage of one step in which nothing changes.
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
        /// Changes gravity to a factor of that of the scene \[-\].
        pub fn gravity(mut self, factor: f64) { self.gravity = Some(factor) }
        /// Changes a load, or all loads of a group, to a factor of the values in the scene \[-\].
        pub fn load(mut self, name: &str, factor: f64) {
            self.loads.insert(name.to_owned(), factor);
        }
        /// Moves a support to another place.
        pub fn moves(mut self, support: &str, movement: Movement) {
            self.moves.insert(support.to_owned(), movement);
        }
    }
}

impl Movement {
    /// A displacement \[length\] without rotation.
    pub fn by(x: f64, y: f64) -> Self {
        Self { x, y, turn: 0.0 }
    }

    /// The movement with lengths in a unit that is `1 / factor` times as long.
    #[must_use]
    pub fn in_lengths(self, factor: f64) -> Self {
        Self { x: self.x * factor, y: self.y * factor, turn: self.turn }
    }

    /// The movement `fraction` of the way from this one to another.
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
