//! Walls of bricks in courses.

use nalgebra::{Point2, Rotation2, Vector2};
use serde::{Deserialize, Serialize};

use super::{BED, Bond, Brick, HEAD, Opening, strict};

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
    /// Returns the names of the classes of bed and head joints.
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
    /// Angle by which the wall is turned about `origin` after its bricks are laid, counter-clockwise \[degrees\].
    #[serde(default, skip_serializing_if = "is_upright")]
    pub turn_deg: f64,
    /// A point towards which the bottom of the wall runs from `origin` \[length\], instead of the angle. The point is
    /// the lower right corner of the wall if `courses` is a number and no width is given.
    #[serde(default, deserialize_with = "strict::read", skip_serializing_if = "Option::is_none")]
    pub to: Option<[f64; 2]>,
    /// The size of a whole brick.
    #[serde(deserialize_with = "strict::read")]
    pub brick: Brick,
    /// Width of the wall \[length\]; allowed only if `courses` is a number.
    pub width: Option<f64>,
    /// The courses, bottom to top.
    pub courses: Courses,
    /// The bond of the courses, running bond by default; allowed only if `courses` is a number.
    pub bond: Option<Bond>,
    /// Openings of the wall; allowed only if `courses` is a number.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::read")]
    pub openings: Vec<Opening>,
    /// The classes of the joints within the wall, instead of `bed` and `head`.
    #[serde(default, deserialize_with = "strict::read", skip_serializing_if = "is_usual")]
    pub joints: WallJoints,
    /// Numbers of elements along the length and the height of a whole brick; required if the material is elastic. A
    /// cut brick gets its share of the elements along the length, rounded up.
    #[serde(default, deserialize_with = "strict::mesh")]
    #[cfg_attr(test, schemars(with = "Option<super::Elements>"))]
    pub mesh: Option<[u32; 2]>,
}

impl Wall {
    /// Returns the place \[length\] to which a place of the upright wall comes when the wall is turned about its
    /// origin.
    ///
    /// ```
    /// use masonry::scene::{Brick, Wall};
    /// let brick = Brick { length: 0.2, height: 0.1 };
    /// let wall = Wall::running_bond("wall", "brick", brick, 1.0, 2).origin([1.0, 0.0]).turn_deg(90.0);
    /// let [x, y] = wall.turned([3.0, 0.5]);
    /// assert!((x - 0.5).abs() < 1e-15 && (y - 2.0).abs() < 1e-15);
    /// ```
    pub fn turned(&self, place: [f64; 2]) -> [f64; 2] {
        let turn = self.turn();
        if turn.to_bits() == 0_f64.to_bits() {
            return place;
        }
        let origin = Point2::from(self.origin);
        (origin + Rotation2::new(turn) * (Point2::from(place) - origin)).into()
    }

    /// Returns the angle by which the wall is turned about its origin \[rad\].
    pub fn turn(&self) -> f64 {
        let along = self.along();
        along.map_or(self.turn_deg.to_radians(), |along| along.y.atan2(along.x))
    }

    /// Returns the width that the scene gives \[length\], as a number or by the distance between the lower corners;
    /// `None` if it gives neither.
    pub fn width_given(&self) -> Option<f64> {
        self.width.or_else(|| self.along().map(|along| along.norm()))
    }

    /// Returns the vector from the lower left corner to the point `to` \[length\]; `None` if `to` is not given.
    fn along(&self) -> Option<Vector2<f64>> {
        self.to.map(|to| Point2::from(to) - Point2::from(self.origin))
    }
}

/// The courses of a wall: their number in a bond, or lists of bricks.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Courses {
    /// A number of courses in running bond, or in the bond of the wall. In running bond every second course begins
    /// with a half brick. The last brick of a course is cut to the width.
    RunningBond(u32),
    /// The courses from bottom to top, each a list of brick lengths from left to right in units of one brick; a
    /// negative number is an opening of this length. In a wall with mortar the unit is one brick and one head joint: a
    /// brick of length `f` measures `f (l + t_y) - t_y`, a half brick `(l - t_y) / 2`.
    List(Vec<Vec<f64>>),
}

fn is_usual(joints: &WallJoints) -> bool {
    *joints == WallJoints::default()
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
fn is_upright(turn_deg: &f64) -> bool {
    // The bits are compared, since a value that differs in any bit is written.
    turn_deg.to_bits() == 0_f64.to_bits()
}
