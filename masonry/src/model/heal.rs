//! Moves corners of single blocks onto the corners and edges of other blocks that they miss by rounding. Drawings are
//! written with a limited number of decimals, so that blocks that touch in a drawing overlap or stand apart by the
//! last decimal.
//!
//! # Equations
//! Corners that are nearer to each other than the tolerance share one place `x`, whose weight `w` is the number of
//! these corners. A place that is nearer to an edge than the tolerance lies on the line through the ends of the edge.
//! Places move such that `sum w |dx|^2` is least and all lines are straight, by Gauss-Newton steps: `dx = -W^-1 A^T (A
//! W^-1 A^T)^-1 r`.
//!
//! Every condition must occur only once. Two conditions that are equal on straight lines differ on lines that are not
//! straight yet. If an edge of length `l` has an error `e`, the difference is of the order of `e`. It would make
//! places slide along the line by the error of second order, `e^2 / l`, divided by the difference of the two
//! directions, `e / l`: by as much as `e` for every pair of such conditions. So corners at one place are one unknown.
//! A corner is put on one edge of another block only: if it is near to two edges, it is near to their common corner
//! once it is on the first edge. Lines that have two separate places in common are one line, whatever edges and
//! supports they come from: the lines of a bed joint are linked through the corners on both of its sides. A line
//! through `n` places has `n - 2` conditions: the middle place is on the line between the first and the last place,
//! and so on in both halves. These conditions are independent, since each has a place that the conditions before it do
//! not have. A line with two places that do not move has one condition for each place that moves.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use faer::sparse::{SparseColMat, Triplet};
use lcp_linalg::{Gram, HALF_DIGITS};
use nalgebra::{Point2, Vector2};

use super::{PlacedBlock, PlacedSupport};
use crate::geometry::{self, SAME_PLACE};
use crate::model::joints::near_pairs;

/// Default tolerance, relative to the shortest edge of the single blocks of a scene \[-\]. Theory: coordinates of a
/// wall in metres with six decimals have errors of 2e-6 of a brick.
const OF_SHORTEST_EDGE: f64 = 1e-5;
/// Largest number of Gauss-Newton steps. Theory: each step squares the error, and the regularised matrix gives half of
/// the digits. The number is doubled for places that come near to others only during the first steps.
const STEPS: usize = 10;
/// Largest tolerance, relative to the shortest edge \[-\]. Theory: the two ends of an edge must not meet.
const LARGEST: f64 = 0.25;

/// A record of corners that were moved, and of changes that were made when a drawing was read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Healed {
    /// Number of corners that were moved.
    pub corners: usize,
    /// The largest distance \[m\] by which a corner was moved.
    pub largest: f64,
    /// The tolerance that was used \[m\].
    pub tolerance: f64,
    /// Changes to the drawing of the blocks and omissions from it, in sentences.
    pub drawing: Vec<String>,
}

/// The reason why corners could not be moved onto others, in words that follow the tolerance in a sentence.
pub type Unhealed = &'static str;

/// Moves corners of the last `count` blocks by as little as possible, so that each corner that is nearer than the
/// tolerance \[m\] to a corner or an edge of another block, or to a support, lies on it. Returns `None` if nothing had
/// to be moved.
///
/// # Errors
/// The tolerance is too large for the blocks, or some corners cannot be put onto their neighbours by movements within
/// the tolerance. In both cases the blocks are not changed.
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
    let sizes = blocks[first..].iter().map(|it| geometry::size(&it.corners));
    let touching = SAME_PLACE * sizes.fold(f64::INFINITY, f64::min);
    let mut drawing = Drawing::of(blocks, first, supports, [touching, tolerance]);
    let before = drawing.points.clone();
    let moved = |drawing: &Drawing| -> Vec<f64> {
        before.iter().zip(&drawing.points).map(|(from, to)| (to - from).norm()).collect()
    };
    for _ in 0..STEPS {
        let apart = drawing.step().ok_or("the corners are too many for the memory")?;
        let moved = moved(&drawing);
        let largest = moved.iter().copied().fold(0.0, f64::max);
        if largest.is_nan() || largest > tolerance {
            break;
        }
        // A step from corners that touch leaves rounding errors only.
        if apart <= touching {
            let corners = moved.into_iter().filter(|it| *it > touching).count();
            if corners == 0 {
                return Ok(None);
            }
            drawing.write(blocks);
            return Ok(Some(Healed { corners, largest, tolerance, drawing: Vec::new() }));
        }
    }
    Err("not all corners that are so near to others can be put onto them")
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

/// The points of a structure whose corners are moved: the corners of all blocks, and the ends of supports.
struct Drawing {
    points: Vec<Point2<f64>>,
    /// The ranges of points of every block, then of every support, which has an edge in both directions.
    bodies: Vec<Range<usize>>,
    /// The range of points that may move; bricks, voussoirs and supports stay.
    free: Range<usize>,
    /// The pairs of bodies that are near each other.
    pairs: Vec<[usize; 2]>,
    /// The distances below which points meet \[m\]: first if both bodies are fixed, then if one of them may move.
    reach: [f64; 2],
}

/// The condition that a place is on the line through two others.
struct Collinear {
    place: usize,
    ends: [usize; 2],
}

impl Drawing {
    fn of(
        blocks: &[PlacedBlock],
        first: usize,
        supports: &[PlacedSupport],
        reach: [f64; 2],
    ) -> Self {
        let supports = supports.iter().map(|it| [it.from, it.to].to_vec());
        let shapes: Vec<Vec<_>> =
            blocks.iter().map(|it| it.corners.clone()).chain(supports).collect();
        let bodies: Vec<Range<usize>> = shapes
            .iter()
            .scan(0, |sum, shape| {
                let start = *sum;
                *sum += shape.len();
                Some(start..*sum)
            })
            .collect();
        let free = bodies[first].start..bodies[blocks.len() - 1].end;
        // Corners move by the tolerance at most.
        let pairs = near_pairs(shapes.iter().map(|it| &it[..]), 2.0 * reach[1]);
        Self { points: shapes.concat(), bodies, free, pairs, reach }
    }

    /// Makes one step that puts points near each other together, to first order. Returns the largest distance of such
    /// points before the step \[m\]; `None` if memory does not suffice.
    fn step(&mut self) -> Option<f64> {
        let Neighbours { mut joined, beside } = self.neighbours();
        let places: Vec<usize> = (0..self.points.len()).map(|it| joined.root(it)).collect();
        let (weights, gathered) = self.gather(&places);
        let on_lines = beside.into_iter().map(|it| it.into_iter().map(|it| places[it]).collect());
        let on_lines = on_lines.filter(|it: &BTreeSet<usize>| it.len() > 2).collect();
        let lines = self.one_line_each(on_lines);
        let rows: Vec<Collinear> = lines.into_iter().flat_map(|line| self.rows(line)).collect();
        let apart = self.straighten(&rows, &weights)?;
        for k in self.free.clone() {
            self.points[k] = self.points[places[k]];
        }
        Some(apart.max(gathered))
    }

    /// Finds all corners that meet other corners, and for every edge the points on it with the two ends of the edge.
    fn neighbours(&self) -> Neighbours {
        let mut joined = Joined((0..self.points.len()).collect());
        let mut beside = vec![BTreeSet::new(); self.points.len()];
        for [a, b] in self.pairs.iter().flat_map(|[a, b]| [[*a, *b], [*b, *a]]) {
            let body = &self.bodies[b];
            let is_free = [a, b].iter().any(|it| self.free.contains(&self.bodies[*it].start));
            let reach = self.reach[usize::from(is_free)];
            let ends =
                |from: usize| [from, if from + 1 < body.end { from + 1 } else { body.start }];
            for point in self.bodies[a].clone() {
                let here = self.points[point];
                let distance = |at: Point2<f64>| (at - here).norm();
                let to_corner = |corner: usize| distance(self.points[corner]);
                let to_edge = |from: usize| {
                    let ends = ends(from).map(|it| self.points[it]);
                    distance(geometry::nearest_on_segment(ends, here))
                };
                if let Some(corner) = nearest(body, to_corner, reach)
                    && corner < self.free.end
                {
                    // A block may end beside the end of a support without sharing its place.
                    if point < self.free.end {
                        joined.join(point, corner);
                    }
                } else if let Some(from) = nearest(body, to_edge, reach) {
                    beside[from].extend(ends(from).into_iter().chain([point]));
                }
            }
        }
        Neighbours { joined, beside }
    }

    /// Moves the first corner of every place to the mean of all corners of the place, unless it is fixed. Returns the
    /// number of corners of each place, and the largest distance of a corner from its place \[m\].
    fn gather(&mut self, places: &[usize]) -> (Vec<f64>, f64) {
        let before = self.points.clone();
        let mut weights = vec![0.0; self.points.len()];
        let mut sums = vec![Vector2::zeros(); self.points.len()];
        for (point, place) in self.points.iter().zip(places) {
            weights[*place] += 1.0;
            sums[*place] += point - self.points[*place];
        }
        for place in self.free.clone() {
            if places[place] == place {
                self.points[place] += sums[place] / weights[place];
            }
        }
        let apart = places.iter().zip(&before).map(|(place, it)| (self.points[*place] - it).norm());
        (weights, apart.fold(0.0, f64::max))
    }

    /// Joins lines that have two separate places in common, until no such lines are left.
    fn one_line_each(&self, mut lines: Vec<BTreeSet<usize>>) -> Vec<BTreeSet<usize>> {
        let mut through: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (k, line) in lines.iter().enumerate() {
            for place in line {
                through.entry(*place).or_default().push(k);
            }
        }
        let mut whole = Vec::new();
        for k in 0..lines.len() {
            let mut line = std::mem::take(&mut lines[k]);
            let mut new: Vec<usize> = line.iter().copied().collect();
            // For each other line, the first place that it has in common with this line.
            let mut common: BTreeMap<usize, usize> = BTreeMap::new();
            while let Some(place) = new.pop() {
                for other in &through[&place] {
                    let first = *common.entry(*other).or_insert(place);
                    if (self.points[first] - self.points[place]).norm() > self.reach[1] {
                        let more = std::mem::take(&mut lines[*other]);
                        new.extend(more.into_iter().filter(|it| line.insert(*it)));
                    }
                }
            }
            whole.push(line);
        }
        whole
    }

    /// Returns the conditions that put the places of a line onto one straight line.
    fn rows(&self, line: BTreeSet<usize>) -> Vec<Collinear> {
        let (free, fixed): (Vec<_>, Vec<_>) =
            line.iter().copied().partition(|it| self.free.contains(it));
        if let [from, .., to] = self.along(fixed)[..] {
            return free.into_iter().map(|place| Collinear { place, ends: [from, to] }).collect();
        }
        let mut rows = Vec::new();
        halve(&self.along(line.into_iter().collect()), &mut rows);
        rows
    }

    /// Sorts the places of a line from one of its ends to the other.
    fn along(&self, mut places: Vec<usize>) -> Vec<usize> {
        let Some(any) = places.first().copied() else { return places };
        let distance = |a: usize, b: usize| (self.points[a] - self.points[b]).norm();
        let farther = |a: &usize, b: &usize| distance(any, *a).total_cmp(&distance(any, *b));
        let end = places.iter().copied().max_by(farther).unwrap_or(any);
        places.sort_by(|a, b| distance(end, *a).total_cmp(&distance(end, *b)));
        places
    }

    /// Makes the least movements of places for which all conditions hold, to first order. Returns the largest
    /// violation of a condition before the movements \[m\]; `None` if memory does not suffice.
    fn straighten(&mut self, rows: &[Collinear], weights: &[f64]) -> Option<f64> {
        let (mut entries, mut apart) = (Vec::new(), Vec::with_capacity(rows.len()));
        let mut columns = BTreeMap::new();
        for (row, Collinear { place, ends: [from, to] }) in rows.iter().enumerate() {
            let [point, start, end] = [place, from, to].map(|it| self.points[*it]);
            let along = end - start;
            let normal = geometry::turn_right(along) / along.norm();
            let at = (point - start).dot(&along) / along.norm_squared();
            apart.push(normal.dot(&(point - start)));
            for (place, by) in [(place, 1.0), (from, at - 1.0), (to, -at)] {
                if self.free.contains(place) {
                    let count = columns.len();
                    let column = 2 * *columns.entry(*place).or_insert(count);
                    let entry = |axis| Triplet::new(row, column + axis, by * normal[axis]);
                    entries.extend([0, 1].map(entry));
                }
            }
        }
        let largest = apart.iter().map(|it: &f64| it.abs()).fold(0.0, f64::max);
        let mut ease = vec![0.0; 2 * columns.len()];
        let mut places = vec![0; columns.len()];
        for (place, column) in columns {
            places[column] = place;
            ease[2 * column..2 * column + 2].fill(1.0 / weights[place]);
        }
        let matrix =
            SparseColMat::<usize, f64>::try_new_from_triplets(rows.len(), ease.len(), &entries);
        let matrix = matrix.ok()?;
        let mut gram = Gram::new(None, matrix.symbolic()).ok()?;
        gram.factorise(None, matrix.as_ref(), &ease, HALF_DIGITS).ok()?;
        gram.solve(&mut apart);
        for entry in matrix.triplet_iter() {
            let by = entry.val * apart[entry.row] * ease[entry.col];
            self.points[places[entry.col / 2]][entry.col % 2] -= by;
        }
        Some(largest)
    }

    fn write(&self, blocks: &mut [PlacedBlock]) {
        for (block, points) in blocks.iter_mut().zip(&self.bodies) {
            block.corners.copy_from_slice(&self.points[points.clone()]);
        }
    }
}

/// The points that are near each other, and the points on every edge.
struct Neighbours {
    joined: Joined,
    beside: Vec<BTreeSet<usize>>,
}

/// Disjoint sets of points, each a tree whose root is the point with the least index.
struct Joined(Vec<usize>);

impl Joined {
    fn root(&mut self, point: usize) -> usize {
        let mut root = point;
        while self.0[root] != root {
            self.0[root] = self.0[self.0[root]];
            root = self.0[root];
        }
        root
    }

    fn join(&mut self, a: usize, b: usize) {
        let [a, b] = [a, b].map(|it| self.root(it));
        self.0[a.max(b)] = a.min(b);
    }
}

/// Returns the nearest point of a body; `None` if its distance exceeds `reach`.
fn nearest(body: &Range<usize>, distance: impl Fn(usize) -> f64, reach: f64) -> Option<usize> {
    let distances = body.clone().map(|it| (it, distance(it)));
    let nearest = distances.min_by(|(_, a), (_, b)| a.total_cmp(b));
    nearest.filter(|(_, distance)| *distance <= reach).map(|(it, _)| it)
}

/// Adds the conditions that put the middle place on the line between the first and the last one, and so on in both
/// halves.
fn halve(places: &[usize], rows: &mut Vec<Collinear>) {
    if let [from, _, .., to] = *places {
        let middle = places.len() / 2;
        rows.push(Collinear { place: places[middle], ends: [from, to] });
        halve(&places[..=middle], rows);
        halve(&places[middle..], rows);
    }
}
