//! Bricks, their bonds, and openings between them.

use serde::{Deserialize, Serialize};

use super::setters::setters;
use super::strict;
use crate::geometry;
use crate::rounding::rounded;

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

/// The bond of the bricks of a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Bond {
    /// Every second course begins with a half brick.
    #[default]
    Running,
    /// All courses are alike, so that head joints lie above each other.
    Stack,
    /// Courses of whole bricks alternate with courses of half bricks, in which a quarter brick lies beside the first
    /// and the last half brick: the face of an English bond, with its stretchers, headers and closers.
    English,
    /// Whole and half bricks alternate in each course, with half bricks above and below the middle of whole bricks:
    /// the face of a Flemish bond. Every second course begins and ends with a half brick and a quarter brick. A wall
    /// that is `1.5 n + 1` bricks wide needs no other pieces.
    Flemish,
}

/// An opening in a wall, with a lintel above it.
///
/// Bricks are cut at the sides of the opening. A piece shorter than a quarter of a brick is laid as one with its
/// neighbour. The lintel is one block in the course above the opening, and is named like a brick; there is no lintel
/// if the opening reaches the top of the wall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Opening {
    /// Distance of the left side of the opening from the left end of the wall \[length\].
    pub x: f64,
    /// Width of the opening \[length\].
    pub width: f64,
    /// The lowest course of the opening, from 1; 1 by default, as for a door.
    #[serde(default = "first")]
    pub course: u32,
    /// Height of the opening, as a number of courses.
    pub courses: u32,
    /// Length on which the lintel rests on either side \[length\]; half a brick by default.
    pub bearing: Option<f64>,
    /// The material, joints and shape of the lintel.
    #[serde(default, deserialize_with = "strict::read")]
    pub lintel: Option<Lintel>,
}

/// A lintel of its own material, or a flat arch with a straight or an arc-shaped intrados, beside which bricks are
/// cut.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Lintel {
    /// Name of the lintel's material, instead of that of the wall.
    pub material: Option<String>,
    /// Class of all joints of the lintel, instead of those of the wall.
    pub joint: Option<String>,
    /// Number of voussoirs of a flat arch; the lintel is one block by default.
    pub voussoirs: Option<u32>,
    /// Angle between the springings and the vertical, of a flat arch with a straight intrados \[degrees\].
    pub skew_deg: Option<f64>,
    /// Rise of the intrados of a flat arch \[length\], if the intrados is an arc.
    pub rise: Option<f64>,
    /// Height of a flat arch, as a number of courses; 1 by default.
    pub courses: Option<u32>,
}

/// The flat arch above an opening.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlatArch {
    pub(crate) voussoirs: u32,
    /// Tangent of the angle between the springings and the vertical \[-\].
    slope: f64,
    /// Height of the arch, as a number of courses.
    pub(crate) courses: u32,
}

impl FlatArch {
    /// Returns the distance \[length\] by which the springings lean outwards over a number of courses of this height
    /// \[length\].
    pub(crate) fn lean(&self, courses: usize, height: f64) -> f64 {
        courses as f64 * height * self.slope
    }
}

impl Opening {
    /// Makes a door: an opening of a width \[length\] that begins in the lowest course and is `courses` high, at the
    /// distance `x` \[length\] from the left end of the wall.
    ///
    /// ```
    /// use masonry::scene::Opening;
    /// let window = Opening::door(1.0, 0.8, 4).above(3).bearing(0.2);
    /// assert_eq!((window.course, window.courses), (4, 4));
    /// ```
    pub fn door(x: f64, width: f64, courses: u32) -> Self {
        Self { x, width, course: first(), courses, bearing: None, lintel: None }
    }

    setters! {
        /// Puts the opening above this number of courses, as for a window.
        pub fn above(mut self, courses: u32) { self.course = courses.saturating_add(1) }
        /// Sets the length on which the lintel rests on either side \[length\].
        pub fn bearing(mut self, length: f64) { self.bearing = Some(length) }
        /// Sets the material of the lintel and the class of its joints.
        pub fn lintel(mut self, material: &str, joint: &str) {
            let (material, joint) = (Some(material.to_owned()), Some(joint.to_owned()));
            self.lintel = Some(Lintel { material, joint, ..Lintel::default() });
        }
    }

    /// Returns the class of the joints of the lintel; `None` if it is that of the wall.
    pub(crate) fn lintel_joint(&self) -> Option<&str> {
        self.lintel.as_ref()?.joint.as_deref()
    }

    /// Returns the flat arch above the opening; `None` if the lintel is one block.
    pub(crate) fn arch(&self) -> Option<FlatArch> {
        let lintel = self.lintel.as_ref()?;
        let voussoirs = lintel.voussoirs?;
        let of_arc = lintel.rise.map(|rise| geometry::half_angle(rise, self.width));
        let angle = of_arc.or(lintel.skew_deg.map(f64::to_radians))?;
        Some(FlatArch { voussoirs, slope: angle.tan(), courses: lintel.courses.unwrap_or(1) })
    }

    /// Returns the courses of the lintel, counted from 0.
    pub(crate) fn lintel_rows(&self) -> std::ops::Range<usize> {
        let first = self.rows().end;
        first..first.saturating_add(self.arch().map_or(1, |it| it.courses as usize))
    }

    /// Returns the courses of the opening, counted from 0.
    pub(crate) fn rows(&self) -> std::ops::Range<usize> {
        let first = self.course.saturating_sub(1) as usize;
        first..first.saturating_add(self.courses as usize)
    }

    /// Returns the length of wall \[length\] that the lintel needs on either side: its bearing, or a quarter of a
    /// brick beside a flat arch.
    pub(crate) fn bearing_on(&self, brick: Brick) -> f64 {
        match self.arch() {
            Some(arch) => arch.lean(arch.courses as usize, brick.height) + 0.25 * brick.length,
            None => self.bearing.unwrap_or(0.5 * brick.length),
        }
    }
}

/// A mistake in the data of an opening. Lengths are in units of the scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OpeningError {
    /// The opening reaches beyond the end of the wall.
    #[error(
        "an opening of {width} at x = {x} reaches beyond the wall, which is {wall} wide: give a width of at most {room}"
    )]
    TooWide {
        /// The given width of the opening.
        width: f64,
        /// The coordinate of the left end of the opening.
        x: f64,
        /// Width of the wall.
        wall: f64,
        /// The largest possible width: the length of wall to the right of `x`.
        room: f64,
    },
    /// The opening reaches beyond the top of the wall.
    #[error(
        "an opening of {courses} courses from course {first} on reaches beyond the {wall} of the wall: give at most {room}"
    )]
    TooHigh {
        /// The given height of the opening, as a number of courses.
        courses: u32,
        /// The lowest course of the opening, from 1.
        first: u32,
        /// The number of courses of the wall.
        wall: u32,
        /// The largest possible height, as a number of courses.
        room: u32,
    },
    /// The wall beside an opening is too short for the lintel to rest on.
    #[error(
        "the lintel needs {bearing} of wall on its {side} to rest on, and has {room}: move the opening by at least {}{}",
        rounded(bearing - room), otherwise(*is_arch, *room)
    )]
    NoBearing {
        /// The side of the opening: `left` or `right`.
        side: &'static str,
        /// The length of wall that the lintel needs.
        bearing: f64,
        /// The length of wall that there is on this side.
        room: f64,
        /// Whether the lintel is a flat arch, whose springings lean by the bearing.
        is_arch: bool,
    },
    /// Two openings, or an opening and the lintel of another one, overlap.
    #[error(
        "the opening or its lintel runs into openings[{other}] in course {course}: move them apart, or make one smaller"
    )]
    Meets {
        /// The index of the other opening, from 0.
        other: usize,
        /// The course in which they overlap, from 1.
        course: usize,
    },
}

/// Returns the words for another remedy; empty if there is no other remedy.
fn otherwise(is_arch: bool, room: f64) -> String {
    match (is_arch, room > 0.0) {
        (true, _) => ", or let the springings of the arch lean less".to_owned(),
        (false, true) => format!(", or give a `bearing` of at most {room}"),
        (false, false) => String::new(),
    }
}

fn first() -> u32 {
    1
}
