//! Blocks that are drawn by single lines: the smallest loops that the lines of a layer form.
//!
//! A line may be drawn once for two blocks or once for each, may end on the middle of another line, and may cross other
//! lines.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Point2;

use super::outline::distance;
use super::{ImportError, ImportErrorKind};
use masonry::geometry::{self, cross};
use masonry_drawing::{Change, DrawnLine, Outline, Place};

/// The largest number of pieces of lines. Theory: four pieces for each of the allowed blocks, and as many again for
/// arcs.
const MOST_PIECES: usize = 160_000;

/// The largest average number of points, or of lines, whose extent along the longer axis overlaps that of a line.
/// Chosen: as many as beside a bed joint through a wall of 20 000 stones.
const MOST_ABREAST: usize = 1000;

/// Returns the outlines that lines form, layer by layer.
pub(crate) fn of(
    lines: &[DrawnLine],
    tolerance: f64,
    changes: &mut Vec<Change>,
) -> Result<Vec<Outline>, ImportError> {
    let mut layers: BTreeMap<&str, Vec<&DrawnLine>> = BTreeMap::new();
    for line in lines {
        layers.entry(&line.layer).or_default().push(line);
    }
    let mut outlines = Vec::new();
    for (layer, lines) in layers {
        let mut graph = Graph::default();
        for line in &lines {
            for pair in line.points.windows(2) {
                graph.add([pair[0], pair[1]], &line.place, tolerance);
            }
            if graph.pieces.len() > MOST_PIECES {
                return Err(ImportErrorKind::TooMany { what: "lines", limit: MOST_PIECES }
                    .at(&[&line.place]));
            }
        }
        graph.cross(tolerance)?;
        let mut net = graph.net(tolerance)?;
        for place in net.prune() {
            changes.push(Change::new("lines that end freely were dropped", &place));
        }
        for (corners, place) in net.faces() {
            changes.push(Change::new("blocks were joined from lines", &place));
            let (layer, name) = (layer.to_owned(), None);
            outlines.push(Outline { corners, layer, name, is_fixed: false, place });
        }
    }
    Ok(outlines)
}

/// Lines between points whose distances are larger than the tolerance.
#[derive(Default)]
struct Graph {
    points: Vec<Point2<f64>>,
    /// Indices of points by the cells of a square grid, whose width is the tolerance.
    cells: BTreeMap<[i64; 2], Vec<usize>>,
    pieces: Vec<([usize; 2], Place)>,
}

impl Graph {
    fn add(&mut self, ends: [Point2<f64>; 2], place: &Place, tolerance: f64) {
        let ends = ends.map(|end| self.point(end, tolerance));
        if ends[0] != ends[1] {
            self.pieces.push((ends, place.clone()));
        }
    }

    /// Returns the index of the point that is nearer than the tolerance, or of a new point.
    fn point(&mut self, at: Point2<f64>, tolerance: f64) -> usize {
        // Coordinates far from the origin have too few digits for cells; the distances of points are compared in any
        // case.
        #[allow(clippy::cast_possible_truncation, reason = "saturates")]
        let [x, y] = [at.x, at.y].map(|it| (it / tolerance).floor() as i64);
        let around = |x: i64| [x.saturating_sub(1), x, x.saturating_add(1)];
        for cell in around(x).into_iter().flat_map(|x| around(y).map(|y| [x, y])) {
            let here = self.cells.get(&cell).into_iter().flatten();
            let mut near = here.filter(|k| (self.points[**k] - at).norm() <= tolerance);
            if let Some(found) = near.next() {
                return *found;
            }
        }
        self.cells.entry([x, y]).or_default().push(self.points.len());
        self.points.push(at);
        self.points.len() - 1
    }

    /// Returns the axis along which the points extend farther: fewer lines overlap along it.
    fn axis(&self) -> usize {
        let extent = |axis: usize| {
            let along = self.points.iter().map(|it| it[axis]);
            let [low, high] = [
                along.clone().fold(f64::INFINITY, f64::min),
                along.fold(f64::NEG_INFINITY, f64::max),
            ];
            high - low
        };
        usize::from(extent(1) > extent(0))
    }

    /// Adds the points at which lines cross.
    ///
    /// # Errors
    /// More lines overlap along the axis, or cross, than the lines of blocks can.
    fn cross(&mut self, tolerance: f64) -> Result<(), ImportError> {
        let axis = self.axis();
        let mut lines: Vec<([Point2<f64>; 2], &Place)> = Vec::new();
        for (ends, place) in &self.pieces {
            let [a, b] = ends.map(|end| self.points[end]);
            lines.push((if a[axis] <= b[axis] { [a, b] } else { [b, a] }, place));
        }
        lines.sort_by(|(a, _), (b, _)| a[0][axis].total_cmp(&b[0][axis]));
        let mut active: Vec<[Point2<f64>; 2]> = Vec::new();
        let mut crossings = Vec::new();
        let mut left = MOST_ABREAST * lines.len();
        for (line, place) in lines {
            active.retain(|other| other[1][axis] >= line[0][axis]);
            left = left
                .checked_sub(active.len())
                .filter(|_| crossings.len() <= MOST_PIECES)
                .ok_or_else(|| ImportErrorKind::Crowded.at(&[place]))?;
            crossings.extend(active.iter().filter_map(|other| crossing(line, *other)));
            active.push(line);
        }
        for at in crossings {
            self.point(at, tolerance);
        }
        Ok(())
    }

    /// Divides the lines at the points that lie on them, and keeps each piece once.
    ///
    /// # Errors
    /// More points lie beside a line than the lines of blocks can have.
    fn net(self, tolerance: f64) -> Result<Net, ImportError> {
        let axis = self.axis();
        let place_of = |k: usize| self.points[k][axis];
        let mut order: Vec<usize> = (0..self.points.len()).collect();
        order.sort_by(|a, b| place_of(*a).total_cmp(&place_of(*b)));
        let places: Vec<f64> = order.iter().map(|k| place_of(*k)).collect();
        let mut sides = BTreeMap::new();
        let mut left = MOST_ABREAST * self.pieces.len();
        for (ends, place) in self.pieces {
            let [from, to] = ends.map(|end| self.points[end]);
            let low = places.partition_point(|it| *it < from[axis].min(to[axis]) - tolerance);
            let high = places.partition_point(|it| *it <= from[axis].max(to[axis]) + tolerance);
            left = left
                .checked_sub(high.saturating_sub(low))
                .ok_or_else(|| ImportErrorKind::Crowded.at(&[&place]))?;
            let along = |k: &usize| (self.points[*k] - from).dot(&(to - from));
            let mut on: Vec<usize> = order[low..high.max(low)].to_vec();
            on.retain(|k| ends.contains(k) || distance(self.points[*k], [from, to]) <= tolerance);
            on.sort_by(|a, b| along(a).total_cmp(&along(b)));
            for pair in on.windows(2) {
                let side = [pair[0].min(pair[1]), pair[0].max(pair[1])];
                sides.entry(side).or_insert_with(|| place.clone());
            }
        }
        Ok(Net::of(self.points, sides))
    }
}

/// Returns the point at which two lines cross or touch; `None` if there is no such point, and for parallel lines.
fn crossing([a, b]: [Point2<f64>; 2], [c, d]: [Point2<f64>; 2]) -> Option<Point2<f64>> {
    let (first, second) = (b - a, d - c);
    let turn = cross(first, second);
    let at = cross(c - a, second) / turn;
    let is_inside = |it: f64| (0.0..=1.0).contains(&it);
    (is_inside(at) && is_inside(cross(c - a, first) / turn)).then(|| a + first * at)
}

/// A planar graph: points, the neighbours of each point, and the lines between neighbours with their places.
struct Net {
    points: Vec<Point2<f64>>,
    around: Vec<BTreeSet<usize>>,
    sides: BTreeMap<[usize; 2], Place>,
}

impl Net {
    fn of(points: Vec<Point2<f64>>, sides: BTreeMap<[usize; 2], Place>) -> Self {
        let mut around = vec![BTreeSet::new(); points.len()];
        for [a, b] in sides.keys() {
            around[*a].insert(*b);
            around[*b].insert(*a);
        }
        Self { points, around, sides }
    }

    /// Removes lines with a free end until there are none, and returns the places of the removed lines.
    fn prune(&mut self) -> BTreeSet<Place> {
        let mut gone = BTreeSet::new();
        let mut free: Vec<usize> =
            (0..self.points.len()).filter(|k| self.around[*k].len() == 1).collect();
        while let Some(end) = free.pop() {
            let Some(other) = self.around[end].pop_first() else { continue };
            self.around[other].remove(&end);
            gone.extend(self.sides.remove(&[end.min(other), end.max(other)]));
            if self.around[other].len() == 1 {
                free.push(other);
            }
        }
        gone
    }

    /// Returns the faces around which lines go counter-clockwise, each with the place of its first line.
    fn faces(&self) -> Vec<(Vec<Point2<f64>>, Place)> {
        let turned: Vec<Vec<usize>> = (0..self.points.len()).map(|k| self.by_angle(k)).collect();
        let mut open: BTreeSet<[usize; 2]> =
            self.sides.keys().flat_map(|[a, b]| [[*a, *b], [*b, *a]]).collect();
        let mut faces = Vec::new();
        while let Some(first) = open.pop_first() {
            let mut corners = vec![self.points[first[0]]];
            let mut side = first;
            loop {
                let [from, at] = side;
                // The sharpest turn to the left: the next line clockwise from the line on which the point was reached.
                let around = &turned[at];
                let back = around.iter().position(|k| *k == from).unwrap_or(0);
                side = [at, around[(back + around.len() - 1) % around.len()]];
                if !open.remove(&side) {
                    break;
                }
                corners.push(self.points[at]);
            }
            if geometry::area(&corners) > 0.0 {
                let place = self.sides.get(&[first[0].min(first[1]), first[0].max(first[1])]);
                faces.push((corners, place.cloned().unwrap_or_default()));
            }
        }
        faces
    }

    fn by_angle(&self, k: usize) -> Vec<usize> {
        let angle = |other: &usize| {
            let way = self.points[*other] - self.points[k];
            way.y.atan2(way.x)
        };
        let mut around: Vec<usize> = self.around[k].iter().copied().collect();
        around.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        around
    }
}
