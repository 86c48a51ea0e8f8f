//! Courses cut at openings, and the lintels above these.

use super::{JointThickness, Span, snap};
use crate::geometry::SAME_PLACE;
use crate::scene::{Opening, Wall};

/// Pieces shorter than this part of a brick are laid as one with their neighbours.
const SHORT: f64 = 0.25;

/// The stretch of a course in the place of an opening or its lintel, in units of one brick and its head joint.
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
    let bearing = opening.bearing_on(wall.brick.length);
    let lintel = [unit(from - bearing), unit(to + bearing + joints.head)];
    (course == rows.end).then_some((lintel, true))
}

/// A course without its openings, and with its lintels.
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

/// Bricks cut at a gap; short pieces go to their neighbours.
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
