//! Walls of bricks in courses.

use serde::{Deserialize, Serialize};

use super::{BED, Bond, HEAD, Opening, strict};

/// The classes of the joints between the bricks of a wall.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct WallJoints {
    /// Class of the bed joints, instead of `bed`.
    pub bed: Option<String>,
    /// Class of the head joints, instead of `head`.
    pub head: Option<String>,
}

impl WallJoints {
    /// The names of the classes of beds and heads.
    pub fn names(&self) -> [&str; 2] {
        [(&self.bed, BED), (&self.head, HEAD)].map(|(name, usual)| name.as_deref().unwrap_or(usual))
    }
}

/// A wall of bricks in courses, built by [`bond`](super::bond).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Wall {
    /// Name of the wall; its bricks are `name/course/place`, both counted from 1.
    pub name: String,
    /// Name of the bricks' material.
    pub material: String,
    /// Lower left corner \[length\].
    #[serde(deserialize_with = "strict::read")]
    pub origin: [f64; 2],
    /// The whole brick.
    #[serde(deserialize_with = "strict::read")]
    pub brick: Brick,
    /// Width of the wall \[length\]; only if `courses` is a number.
    pub width: Option<f64>,
    /// The courses, bottom to top.
    pub courses: Courses,
    /// How they are laid, if not in running bond; only if `courses` is a number.
    pub bond: Option<Bond>,
    /// Its openings; only if `courses` is a number.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::read")]
    pub openings: Vec<Opening>,
    /// The classes of its joints, if not `bed` and `head`.
    #[serde(default, deserialize_with = "strict::read", skip_serializing_if = "is_usual")]
    pub joints: WallJoints,
    /// Elements along the length and height of a whole brick; required when the material is
    /// elastic. A cut brick gets its share of the first, rounded up.
    #[serde(default, deserialize_with = "strict::read")]
    pub mesh: Option<[u32; 2]>,
}

/// Size of a whole brick.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Brick {
    /// Length along the course, without mortar \[length\].
    pub length: f64,
    /// Height of the course, without mortar \[length\].
    pub height: f64,
}

/// The courses of a wall: their number in a bond, or a list of bricks.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Courses {
    /// A number of courses in running bond, or in the bond of the wall. The second, fourth and so on begin with a
    /// half brick, and the last brick of a course is cut to the width.
    RunningBond(u32),
    /// Bottom to top, each a list of brick lengths in units of one brick from left to right; a
    /// negative number is an opening of that length. In a wall with mortar the unit is one brick and one head
    /// joint: a brick of length `f` measures `f (l + t_y) - t_y`, a half brick `(l - t_y) / 2`.
    List(Vec<Vec<f64>>),
}

fn is_usual(joints: &WallJoints) -> bool {
    *joints == WallJoints::default()
}
