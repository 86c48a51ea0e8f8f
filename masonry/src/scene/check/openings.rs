//! Checks of openings.

use super::{Check, MAGNITUDES, at_least_one, not_negative, positive, value};
use crate::geometry::SAME_PLACE;
use crate::rounding::rounded;
use crate::scene::bond::{JointThickness, taken};
use crate::scene::{Fault, KeyPath, Opening, OpeningError, Wall};

/// How large a wall is.
#[derive(Clone, Copy)]
pub(super) struct WallSize {
    /// Its width \[length\].
    pub(super) width: f64,
    pub(super) courses: u32,
}

/// Openings inside their wall, whose lintels rest on it and that do not meet.
pub(super) fn check(at: &KeyPath, wall: &Wall, joints: JointThickness, size: WallSize) -> Check {
    for (k, opening) in wall.openings.iter().enumerate() {
        let at = at.key("openings").item(k);
        check_place(&at, wall, opening, size)?;
        for (other, before) in wall.openings[..k].iter().enumerate() {
            let meets = |course: &usize| {
                let gap = |it: &Opening| taken(wall, joints, it, *course).map(|(gap, _)| gap);
                let both = gap(opening).zip(gap(before));
                both.is_some_and(|([a, b], [c, d])| a < d - SAME_PLACE && c < b - SAME_PLACE)
            };
            let lowest = opening.rows().start.max(before.rows().start);
            let highest = opening.rows().end.min(before.rows().end);
            if let Some(course) = (lowest..=highest).find(meets) {
                let error = OpeningError::Meets { other, course: course + 1 };
                return Err(Fault::new(at, error));
            }
        }
    }
    for k in 0..wall.openings.len() {
        check_lintel(&at.key("openings").item(k), wall, k, size)?;
    }
    Ok(())
}

fn check_place(at: &KeyPath, wall: &Wall, opening: &Opening, size: WallSize) -> Check {
    let WallSize { width: wide, courses: high } = size;
    let Opening { x, width, course, courses, bearing } = *opening;
    not_negative(at.key("x"), x)?;
    positive(at.key("width"), width)?;
    let room = wide - x;
    if width > room + SAME_PLACE * wall.brick.length {
        let error = OpeningError::TooWide { width, x, wall: wide, room: rounded(room.max(0.0)) };
        return Err(Fault::new(at.key("width"), error));
    }
    at_least_one(at.key("course"), course, "courses are counted from 1")?;
    at_least_one(at.key("courses"), courses, "an opening is at least one course high")?;
    let room = (high + 1).saturating_sub(course);
    if courses > room {
        let error = OpeningError::TooHigh { courses, first: course, wall: high, room };
        return Err(Fault::new(at.key("courses"), error));
    }
    let wanted =
        "a lintel rests on some length of wall on both sides; leave the key out for half a brick";
    bearing.map_or(Ok(()), |it| value(at.key("bearing"), it, MAGNITUDES.contains(&it), wanted))
}

/// The wall on both sides of an opening is as wide as its lintel needs: up to the end, or to another opening.
fn check_lintel(at: &KeyPath, wall: &Wall, k: usize, size: WallSize) -> Check {
    let WallSize { width: wide, courses: high } = size;
    let opening = &wall.openings[k];
    let top = opening.rows().end;
    if top >= high as usize {
        return Ok(());
    }
    let others = wall.openings.iter().enumerate();
    let others = others.filter(|(other, it)| *other != k && it.rows().contains(&(top - 1)));
    let (mut left, mut right) = (opening.x, wide - opening.x - opening.width);
    for (_, other) in others {
        if other.x < opening.x {
            left = left.min(opening.x - other.x - other.width);
        } else {
            right = right.min(other.x - opening.x - opening.width);
        }
    }
    let bearing = opening.bearing_on(wall.brick.length);
    for (side, room) in [("left", left), ("right", right)] {
        if bearing > room + SAME_PLACE * wall.brick.length {
            let (bearing, room) = (rounded(bearing), rounded(room.max(0.0)));
            let error = OpeningError::NoBearing { side, bearing, room };
            return Err(Fault::new(at.clone(), error));
        }
    }
    Ok(())
}
