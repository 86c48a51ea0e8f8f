//! Loads on edges: the parts of edges that lie on a segment, and the tractions on them.

use nalgebra::{Point2, Vector2};

use crate::geometry::{self, SAME_PLACE};
use crate::ids::LoadId;
use crate::model::{EdgeLoad, JointPoint, PlacedBlock, PlacedJoint};
use crate::scene::{self, Earth, EdgeStress};
use crate::units::Units;

/// A part of an edge: its start and end as fractions of the edge.
pub(super) type EdgePart = [f64; 2];

/// A load on all free parts of edges that lie on a segment.
pub(super) struct OnEdges<'a> {
    pub(super) load: &'a scene::Load,
    pub(super) id: LoadId,
    pub(super) ends: [Point2<f64>; 2],
    pub(super) stress: EdgeStress,
    /// Whether edges within joints are loaded as well, if the traction presses them.
    pub(super) inside: bool,
    pub(super) units: Units,
    /// The largest distance by which corners were moved \[m\].
    pub(super) moved: f64,
}

impl OnEdges<'_> {
    /// Applies the load to the blocks; returns whether it acts on any block. Parts of edges in joints (`joined`) are
    /// not free: they carry no load unless `inside` is true.
    pub(super) fn place(&self, blocks: &mut [PlacedBlock], joined: &[Vec<Vec<EdgePart>>]) -> bool {
        let mut acts = false;
        for (block, joined) in blocks.iter_mut().zip(joined) {
            for (edge, joined) in joined.iter().enumerate() {
                let corners = &block.corners;
                let parts = match covered_part(corners, edge, self.ends, self.moved) {
                    Some(part) if self.inside => {
                        self.presses(corners, edge).then_some(part).into_iter().collect()
                    }
                    Some(part) => geometry::without(part, joined),
                    None => Vec::new(),
                };
                for part in parts {
                    let Some([from, to]) = self.loaded_part(corners, edge, part) else { continue };
                    let traction = [from, to].map(|at| self.traction(corners, edge, at));
                    block.loads.push(EdgeLoad { edge, from, to, traction, load: self.id }.into());
                    acts = true;
                }
            }
        }
        acts
    }

    /// Returns the traction on the block at a fraction of an edge \[Pa\].
    fn traction(&self, corners: &[Point2<f64>], edge: usize, at: f64) -> Vector2<f64> {
        let in_scene = match self.stress {
            EdgeStress::Traction(traction) => Vector2::from(traction),
            EdgeStress::Pressure(pressure) => {
                let place = self.fraction(geometry::on_edge(corners, edge, at));
                let pressure = pressure.from + (pressure.to - pressure.from) * place;
                -geometry::outward_normal(corners, edge) * pressure
            }
            EdgeStress::Earth(earth) => {
                -geometry::outward_normal(corners, edge)
                    * earth.pressure_at(self.height(corners, edge, at))
            }
        };
        in_scene * self.units.stress_to_si() * self.load.factor
    }

    /// Returns whether the traction of the load, without its factor, presses on an edge.
    fn presses(&self, corners: &[Point2<f64>], edge: usize) -> bool {
        let EdgeStress::Traction(traction) = self.stress else { return false };
        Vector2::from(traction).dot(&geometry::outward_normal(corners, edge)) < 0.0
    }

    /// Returns the part of an edge below the level of earth, if the load is earth; `None` if all of the part is above
    /// the level.
    fn loaded_part(
        &self,
        corners: &[Point2<f64>],
        edge: usize,
        [from, to]: EdgePart,
    ) -> Option<EdgePart> {
        let EdgeStress::Earth(Earth { level, .. }) = self.stress else { return Some([from, to]) };
        let depths = [from, to].map(|at| level - self.height(corners, edge, at));
        let surface = from + (to - from) * (depths[0] / (depths[0] - depths[1]));
        let part = match depths.map(|it| it > 0.0) {
            [true, true] => [from, to],
            [true, false] => [from, surface],
            [false, true] => [surface, to],
            [false, false] => return None,
        };
        (part[1] - part[0] > SAME_PLACE).then_some(part)
    }

    /// Returns the height of a place on an edge, in units of the scene.
    fn height(&self, corners: &[Point2<f64>], edge: usize, at: f64) -> f64 {
        geometry::on_edge(corners, edge, at).y / self.units.length_to_si()
    }

    /// Returns a place on the segment as a fraction of the segment.
    fn fraction(&self, place: Point2<f64>) -> f64 {
        let [from, to] = self.ends;
        (place - from).dot(&(to - from)) / (to - from).norm_squared()
    }
}

/// Returns the part of an edge that lies on a segment; `None` if edge and segment have no length in common.
fn covered_part(
    corners: &[Point2<f64>],
    edge: usize,
    [from, to]: [Point2<f64>; 2],
    moved: f64,
) -> Option<EdgePart> {
    let [start, end] = geometry::edge(corners, edge);
    let length = (end - start).norm();
    let slack = SAME_PLACE * geometry::size(corners) + moved;
    let (normal, along) = (geometry::outward_normal(corners, edge), (end - start) / length);
    let place = |p: Point2<f64>| (p - start).dot(&along);
    let (a, b) = (place(from), place(to));
    if (b - a).abs() <= slack {
        return None;
    }
    let (low, high) = (a.min(b).max(0.0), a.max(b).min(length));
    if high - low <= slack {
        return None;
    }
    // Only the part of the segment beside the edge must lie on the edge: rounding may move parts farther away off the
    // edge's line.
    let distance = |s: f64| (from + (to - from) * ((s - a) / (b - a)) - start).dot(&normal);
    if distance(low).abs() > slack || distance(high).abs() > slack {
        return None;
    }
    Some([low, high].map(|s| geometry::snap(s / length)))
}

/// Returns the parts of every edge of every block that belong to joints.
pub(super) fn joined_parts(
    blocks: &[PlacedBlock],
    joints: &[PlacedJoint],
    contacts: &[JointPoint],
) -> Vec<Vec<Vec<EdgePart>>> {
    let mut joined: Vec<_> =
        blocks.iter().map(|block| vec![Vec::new(); block.corners.len()]).collect();
    // All points of a joint lie on the same two edges, so that the first point suffices.
    let mut last = None;
    for contact in contacts {
        if last.replace(contact.joint) == Some(contact.joint) {
            continue;
        }
        let joint = &joints[contact.joint.index()];
        for anchor in contact.a.into_iter().chain([contact.b]) {
            let block = anchor.block.index();
            let part = projected(&blocks[block].corners, anchor.edge, joint);
            joined[block][anchor.edge].push(part);
        }
    }
    joined
}

/// Returns the part of an edge that lies in front of a joint.
fn projected(corners: &[Point2<f64>], edge: usize, joint: &PlacedJoint) -> EdgePart {
    let [start, end] = geometry::edge(corners, edge);
    let along = (end - start) / (end - start).norm_squared();
    let [a, b] = [joint.from, joint.to].map(|p| geometry::snap((p - start).dot(&along)));
    [a.min(b), a.max(b)]
}
