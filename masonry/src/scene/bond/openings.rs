//! Cutting of courses at openings, and placement of the lintels above the openings.

use super::{JointThickness, Span, snap};
use crate::geometry::SAME_PLACE;
use crate::scene::opening::FlatArch;
use crate::scene::{Arch, Courses, Fault, KeyPath, Opening, Wall, arch};

/// Length in bricks below which a piece is laid as one with its neighbour.
const SHORT: f64 = 0.25;

/// Returns the stretch of a course that an opening or its lintel takes, in units of one brick and its head joint, and
/// whether one block fills the stretch. The stretch of a flat arch is that at the top of the course. `None` if neither
/// the opening nor its lintel lies in the course.
pub(crate) fn taken(
    wall: &Wall,
    joints: JointThickness,
    opening: &Opening,
    course: usize,
) -> Option<(Span, bool)> {
    let pitch = wall.brick.length + joints.head;
    let rows = opening.rows();
    let unit = |x: f64| snap(x / pitch);
    let (from, to) = (opening.x, opening.x + opening.width);
    if rows.contains(&course) {
        return Some(([unit(from + joints.head), unit(to)], false));
    }
    if !opening.lintel_rows().contains(&course) {
        return None;
    }
    let beside = match opening.arch() {
        Some(arch) => arch.lean(course + 1 - rows.end, wall.brick.height),
        None => opening.bearing_on(wall.brick),
    };
    Some(([unit(from - beside), unit(to + beside + joints.head)], opening.arch().is_none()))
}

/// Cuts a course at its openings, and adds the lintels.
pub(super) fn cut(
    wall: &Wall,
    joints: JointThickness,
    course: usize,
    mut bricks: Vec<Span>,
) -> Vec<Span> {
    let mut lintels = Vec::new();
    for opening in &wall.openings {
        let Some((gap, has_lintel)) = taken(wall, joints, opening, course) else { continue };
        bricks = without(&bricks, gap);
        if has_lintel {
            lintels.push(gap);
        }
    }
    bricks.extend(lintels);
    bricks.sort_by(|a, b| a[0].total_cmp(&b[0]));
    bricks
}

/// Returns the index of the opening whose lintel begins at a place of a course; `None` if no lintel begins at the
/// place.
pub(super) fn lintel_at(
    wall: &Wall,
    joints: JointThickness,
    course: usize,
    start: f64,
) -> Option<usize> {
    wall.openings.iter().position(|opening| {
        let place = taken(wall, joints, opening, course);
        place.is_some_and(|([from, _], is_lintel)| is_lintel && touches(from, start))
    })
}

/// Returns the lengths by which the bottom of a brick beside a flat arch reaches beyond its top, left and right
/// \[length\]; zeros for other bricks.
pub(super) fn leans(
    wall: &Wall,
    joints: JointThickness,
    course: usize,
    [start, end]: Span,
) -> [f64; 2] {
    let mut leans = [0.0; 2];
    for opening in &wall.openings {
        let Some(arch) = opening.arch().filter(|_| opening.lintel_rows().contains(&course)) else {
            continue;
        };
        let Some(([from, to], _)) = taken(wall, joints, opening, course) else { continue };
        let lean = arch.lean(1, wall.brick.height);
        leans[0] += if touches(to, start) { lean } else { 0.0 };
        leans[1] += if touches(from, end) { lean } else { 0.0 };
    }
    leans
}

/// Returns the corners of the voussoirs of the flat arch above an opening, from the left \[length\]; empty if there is
/// no flat arch.
pub(crate) fn voussoirs(
    wall: &Wall,
    opening: &Opening,
    at: &KeyPath,
) -> Result<Vec<[[f64; 2]; 4]>, Fault> {
    let Some((lintel, FlatArch { voussoirs, courses, .. })) =
        opening.lintel.as_ref().zip(opening.arch())
    else {
        return Ok(Vec::new());
    };
    let first = opening.rows().end;
    if !matches!(wall.courses, Courses::RunningBond(count) if first < count as usize) {
        return Ok(Vec::new());
    }
    let top = first as f64 * wall.brick.height;
    let height = f64::from(courses) * wall.brick.height;
    let origin = [wall.origin[0] + opening.x, wall.origin[1] + top];
    let arch = Arch {
        rise: lintel.rise,
        skew_deg: lintel.skew_deg,
        ..Arch::flat("lintel", &wall.material, opening.width, 0.0, height, voussoirs).origin(origin)
    };
    let blocks = arch::blocks(&arch, at)?;
    Ok(blocks.into_iter().map(|it| it.corners.map(|corner| wall.turned(corner))).collect())
}

/// Cuts bricks at a gap; short pieces are joined to their neighbours.
fn without(bricks: &[Span], [from, to]: Span) -> Vec<Span> {
    let mut left: Vec<Span> =
        bricks.iter().copied().filter(|[a, _]| *a < from - SAME_PLACE).collect();
    let mut right: Vec<Span> =
        bricks.iter().copied().filter(|[_, b]| *b > to + SAME_PLACE).collect();
    if let Some(last) = left.last_mut() {
        last[1] = last[1].min(from);
        let [start, end] = *last;
        let beside = left.len().checked_sub(2).map(|k| left[k]);
        if end - start < SHORT - SAME_PLACE && beside.is_some_and(|[_, b]| touches(b, start)) {
            left.pop();
            left.iter_mut().last().into_iter().for_each(|before| before[1] = end);
        }
    }
    if let Some(first) = right.first_mut() {
        first[0] = first[0].max(to);
        let [start, end] = *first;
        let beside = right.get(1).copied();
        if end - start < SHORT - SAME_PLACE && beside.is_some_and(|[a, _]| touches(a, end)) {
            right.remove(0);
            right.iter_mut().take(1).for_each(|after| after[0] = start);
        }
    }
    left.extend(right);
    left
}

fn touches(a: f64, b: f64) -> bool {
    (a - b).abs() < SAME_PLACE
}
