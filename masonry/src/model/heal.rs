//! Corners of single blocks, put onto corners and edges of others that they miss by rounding: drawings are written with some
//! decimals, and blocks that touch in them overlap or stand apart by the last one.

use faer::sparse::{SparseColMat, Triplet};
use lcp_linalg::{Gram, HALF_DIGITS};
use nalgebra::{Point2, Vector2};

use super::{PlacedBlock, PlacedSupport};
use crate::geometry::{self, SAME_PLACE};
use crate::model::joints::near_pairs;

/// The tolerance of a scene that gives none, relative to the shortest edge of its single blocks. Theory: coordinates of a wall
/// in metres with six decimals are off by 2e-6 of a brick.
const OF_SHORTEST_EDGE: f64 = 1e-5;
/// Steps of Gauss and Newton. Theory: each leaves the square of an error, and half of its digits are those of the regular matrix.
const STEPS: usize = 5;
/// The tolerance, relative to the shortest edge, at most. Theory: the ends of an edge must not meet.
const LARGEST: f64 = 0.25;
/// Corners are moved by so many tolerances at most. Chosen: those of three blocks that meet move by less than two.
const FARTHEST: f64 = 4.0;

/// The corners that were moved, and what reading a drawing had changed before.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Healed {
    /// Corners that were moved.
    pub corners: usize,
    /// The largest distance \[m\].
    pub largest: f64,
    /// The tolerance \[m\].
    pub tolerance: f64,
    /// What was changed and left out of the drawing with the blocks, in sentences.
    pub drawing: Vec<String>,
}

/// Why corners cannot be healed, in words that follow the tolerance.
pub type Unhealed = &'static str;

/// Moves corners of the last blocks, so many, by as little as possible, so that each that is nearer than the tolerance \[m\] to a
/// corner or an edge of another block, or to a support, lies on it. `None` if nothing had to be moved.
///
/// # Errors
/// Blocks stay as they were if the tolerance is too large for them, or if not all that is near can meet.
pub fn heal(
    blocks: &mut [PlacedBlock],
    count: usize,
    supports: &[PlacedSupport],
    tolerance: Option<f64>,
) -> Result<Option<Healed>, Unhealed> {
    if count == 0 {
        return Ok(None);
    }
    let first = blocks.len() - count;
    let shortest = shortest_edge(&blocks[first..]);
    let tolerance = tolerance.unwrap_or(OF_SHORTEST_EDGE * shortest);
    if tolerance > LARGEST * shortest {
        return Err("corners are moved by less than a quarter of the shortest edge");
    }
    let mut drawing = Drawing::of(blocks, first);
    let meetings = drawing.meetings(blocks, supports, tolerance);
    let sizes = blocks[first..].iter().map(|it| geometry::size(&it.corners));
    let touching = SAME_PLACE * sizes.fold(f64::INFINITY, f64::min);
    let is_met = |it: &Touch, drawing: &Drawing| {
        let (distance, terms) = it.distance(&drawing.points);
        distance.abs() <= touching || terms.iter().all(|(point, _)| *point < drawing.free)
    };
    if meetings.iter().all(|it| is_met(it, &drawing)) {
        return Ok(None);
    }
    let before = drawing.points.clone();
    for _ in 0..STEPS {
        drawing.step(&meetings).ok_or("the corners are too many for the memory")?;
    }
    let moved = before.iter().zip(&drawing.points).map(|(from, to)| (to - from).norm());
    let moved: Vec<f64> = moved.filter(|it| *it > 0.0).collect();
    let largest = moved.iter().copied().fold(0.0, f64::max);
    let is_far = largest.is_nan() || largest > FARTHEST * tolerance;
    if is_far || !meetings.iter().all(|it| is_met(it, &drawing)) {
        return Err("not all corners that are so near to others can be put onto them");
    }
    drawing.write(blocks);
    Ok(Some(Healed { corners: moved.len(), largest, tolerance, drawing: Vec::new() }))
}

fn shortest_edge(blocks: &[PlacedBlock]) -> f64 {
    let edges = blocks.iter().flat_map(|block| {
        (0..block.corners.len()).map(|k| {
            let [from, to] = geometry::edge(&block.corners, k);
            (to - from).norm()
        })
    });
    edges.fold(f64::INFINITY, f64::min)
}

/// The corners of all blocks, those of bricks and voussoirs fixed.
struct Drawing {
    points: Vec<Point2<f64>>,
    /// The first corner of every block, and one past the last.
    starts: Vec<usize>,
    /// The first corner that may move.
    free: usize,
}

/// Corners and lines that have to meet.
#[derive(Debug, Clone, Copy)]
enum Touch {
    /// Two corners, along an axis.
    Corners { corners: [usize; 2], axis: Vector2<f64> },
    /// A corner and the edge between two others.
    Edge { corner: usize, ends: [usize; 2] },
    /// A corner and a line that does not move.
    Line { corner: usize, through: Point2<f64>, normal: Vector2<f64> },
}

impl Touch {
    /// The distance that has to vanish, and its derivatives by the points.
    fn distance(&self, points: &[Point2<f64>]) -> (f64, Vec<(usize, Vector2<f64>)>) {
        match *self {
            Self::Corners { corners: [a, b], axis } => {
                (axis.dot(&(points[a] - points[b])), vec![(a, axis), (b, -axis)])
            }
            Self::Edge { corner, ends: [from, to] } => {
                let (place, normal) = beside(points[corner], [from, to].map(|end| points[end]));
                let apart = normal.dot(&(points[corner] - points[from]));
                (
                    apart,
                    vec![(corner, normal), (from, normal * (place - 1.0)), (to, normal * -place)],
                )
            }
            Self::Line { corner, through, normal } => {
                (normal.dot(&(points[corner] - through)), vec![(corner, normal)])
            }
        }
    }
}

/// Where a point is along a segment, as a fraction of it, and the normal of the segment.
fn beside(point: Point2<f64>, [from, to]: [Point2<f64>; 2]) -> (f64, Vector2<f64>) {
    let along = to - from;
    ((point - from).dot(&along) / along.norm_squared(), geometry::turn_right(along) / along.norm())
}

/// Whether a point is beside a segment, or beyond its end by no more than the tolerance, and nearer than that to its line.
fn is_near(point: Point2<f64>, ends: [Point2<f64>; 2], tolerance: f64) -> bool {
    let (place, normal) = beside(point, ends);
    let beyond = tolerance / (ends[1] - ends[0]).norm();
    (-beyond..=1.0 + beyond).contains(&place) && normal.dot(&(point - ends[0])).abs() <= tolerance
}

impl Drawing {
    fn of(blocks: &[PlacedBlock], first: usize) -> Self {
        let mut starts = vec![0];
        starts.extend(blocks.iter().scan(0, |sum, block| {
            *sum += block.corners.len();
            Some(*sum)
        }));
        let points = blocks.iter().flat_map(|block| block.corners.iter().copied()).collect();
        Self { points, free: starts[first], starts }
    }

    fn meetings(
        &self,
        blocks: &[PlacedBlock],
        supports: &[PlacedSupport],
        tolerance: f64,
    ) -> Vec<Touch> {
        let mut list = Vec::new();
        for [a, b] in near_pairs(blocks, tolerance) {
            if self.starts[a.index().max(b.index())] < self.free {
                continue;
            }
            for (a, b) in [(a.index(), b.index()), (b.index(), a.index())] {
                for corner in self.starts[a]..self.starts[a + 1] {
                    self.meet(corner, b, a < b, tolerance, &mut list);
                }
            }
        }
        for (corner, point) in self.points.iter().enumerate().skip(self.free) {
            for support in supports {
                let ends = [support.from, support.to];
                if is_near(*point, ends, tolerance) {
                    let (_, normal) = beside(*point, ends);
                    list.push(Touch::Line { corner, through: support.from, normal });
                }
            }
        }
        list
    }

    /// The meeting of a corner with another block, if it is near: two of its corners meet once.
    fn meet(
        &self,
        corner: usize,
        block: usize,
        is_first: bool,
        tolerance: f64,
        list: &mut Vec<Touch>,
    ) {
        let (begin, end) = (self.starts[block], self.starts[block + 1]);
        let point = self.points[corner];
        let distance = |it: &usize| (self.points[*it] - point).norm();
        let nearest = (begin..end).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(other) = nearest.filter(|it| distance(it) <= tolerance) {
            if is_first {
                let along = |axis| Touch::Corners { corners: [corner, other], axis };
                list.extend([Vector2::x(), Vector2::y()].map(along));
            }
            return;
        }
        for from in begin..end {
            let to = if from + 1 < end { from + 1 } else { begin };
            if is_near(point, [self.points[from], self.points[to]], tolerance) {
                list.push(Touch::Edge { corner, ends: [from, to] });
            }
        }
    }

    /// The least changes of the corners that may move for which all meetings hold, to first order; `None` if memory does not
    /// suffice.
    fn step(&mut self, meetings: &[Touch]) -> Option<()> {
        let (mut entries, mut apart) = (Vec::new(), Vec::with_capacity(meetings.len()));
        for (row, meeting) in meetings.iter().enumerate() {
            let (distance, terms) = meeting.distance(&self.points);
            apart.push(distance);
            for (point, by) in terms.into_iter().filter(|(point, _)| *point >= self.free) {
                let column = 2 * (point - self.free);
                entries
                    .extend([Triplet::new(row, column, by.x), Triplet::new(row, column + 1, by.y)]);
            }
        }
        let columns = 2 * (self.points.len() - self.free);
        let matrix =
            SparseColMat::<usize, f64>::try_new_from_triplets(meetings.len(), columns, &entries);
        let matrix = matrix.ok()?;
        let mut gram = Gram::new(None, matrix.symbolic()).ok()?;
        gram.factorise(None, matrix.as_ref(), &vec![1.0; columns], HALF_DIGITS).ok()?;
        gram.solve(&mut apart);
        for entry in matrix.triplet_iter() {
            let by = entry.val * apart[entry.row];
            self.points[self.free + entry.col / 2][entry.col % 2] -= by;
        }
        Some(())
    }

    fn write(&self, blocks: &mut [PlacedBlock]) {
        for (block, start) in blocks.iter_mut().zip(&self.starts) {
            let count = block.corners.len();
            block.corners.copy_from_slice(&self.points[*start..*start + count]);
        }
    }
}
