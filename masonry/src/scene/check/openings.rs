//! Checks of openings.

use super::{
    Check, MAGNITUDES, at_least_one, check_mesh, needed, not_negative, positive, unwanted, value,
};
use crate::geometry::SAME_PLACE;
use crate::rounding::rounded;
use crate::scene::bond::{JointThickness, taken, voussoirs};
use crate::scene::rules::exactly_one;
use crate::scene::{Fault, Joint, KeyPath, Lintel, Opening, OpeningError, Scene, Wall};

/// The width of a wall and its number of courses, for the check of openings.
#[derive(Clone, Copy)]
pub(super) struct WallSize {
    /// The width of the wall \[length\].
    pub(super) width: f64,
    pub(super) courses: u32,
}

/// Checks that openings are inside their wall, that their lintels rest on it, and that openings do not overlap.
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
            let highest = opening.lintel_rows().end.min(before.lintel_rows().end);
            let highest = highest.min(size.courses as usize + 1);
            if let Some(course) = (lowest..highest).find(meets) {
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
    let &Opening { x, width, course, courses, bearing, .. } = opening;
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

impl Scene {
    /// Checks the lintel of the opening at `at`: its material, joints and shape.
    pub(super) fn check_lintel(
        &self,
        at_wall: &KeyPath,
        at: &KeyPath,
        wall: &Wall,
        opening: &Opening,
    ) -> Check {
        let Some(lintel) = &opening.lintel else { return Ok(()) };
        let because = "is for a lintel of one block: a flat arch rests on its springings";
        let has_bearing = opening.bearing.is_some() && lintel.voussoirs.is_some();
        unwanted(has_bearing, at, "bearing", because, "")?;
        let at = &at.key("lintel");
        if let Some(material) = &lintel.material {
            check_mesh(at_wall, wall.mesh, self.material_of(at, material)?)?;
        }
        self.check_flat_arch(at, wall, lintel)?;
        voussoirs(wall, opening, at)?;
        let Some(class) = &lintel.joint else { return Ok(()) };
        let at = at.key("joint");
        self.check_class(at.clone(), class)?;
        let thickness = self.joints.get(class).map_or(0.0, Joint::mortar_thickness);
        let JointThickness { bed, head } = JointThickness::of(self, wall);
        let is_same = [bed, head].iter().all(|it| (it - thickness).abs() <= SAME_PLACE * it);
        let wanted =
            "the mortar around a lintel is as thick as that in the beds and heads of its wall";
        value(at, thickness, is_same, wanted)
    }

    /// Checks that a lintel is one block, or a flat arch of voussoirs with a skew or a rise in a dry wall.
    fn check_flat_arch(&self, at: &KeyPath, wall: &Wall, lintel: &Lintel) -> Check {
        let Lintel { voussoirs, skew_deg, rise, courses, .. } = *lintel;
        if voussoirs.is_none() && skew_deg.is_none() && rise.is_none() && courses.is_none() {
            return Ok(());
        }
        let because = "for a flat arch above an opening";
        needed(voussoirs, at, "voussoirs", because, "voussoirs = 7")?;
        exactly_one(at, "skew_deg", skew_deg, "rise", rise)?;
        at_least_one(
            at.key("courses"),
            courses.unwrap_or(1),
            "a flat arch is at least one course high",
        )?;
        let JointThickness { bed, head } = JointThickness::of(self, wall);
        let because = "is for a wall with dry joints, and this wall has mortar";
        let otherwise = ", or build the flat arch of single blocks";
        unwanted(bed.max(head) > 0.0, at, "voussoirs", because, otherwise)
    }
}

/// Checks that the wall on both sides of an opening, up to its end or to another opening, is long enough for the
/// lintel to rest on.
fn check_lintel(at: &KeyPath, wall: &Wall, k: usize, size: WallSize) -> Check {
    let WallSize { width: wide, courses: high } = size;
    let opening = &wall.openings[k];
    let top = opening.rows().end;
    if top >= high as usize {
        return Ok(());
    }
    let courses = opening.lintel_rows().len() as f64;
    let wanted = "a flat arch reaches no higher than its wall";
    let at_courses = at.key("lintel").key("courses");
    value(at_courses, courses, opening.lintel_rows().end <= high as usize, wanted)?;
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
    let bearing = opening.bearing_on(wall.brick);
    for (side, room) in [("left", left), ("right", right)] {
        if bearing > room + SAME_PLACE * wall.brick.length {
            let (bearing, room) = (rounded(bearing), rounded(room.max(0.0)));
            let is_arch = opening.arch().is_some();
            let error = OpeningError::NoBearing { side, bearing, room, is_arch };
            return Err(Fault::new(at.clone(), error));
        }
    }
    Ok(())
}
