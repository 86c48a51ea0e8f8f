//! Mortar films as strips between blocks, whose only unknowns are the displacements of the nodes of the blocks.

use faer::sparse::Triplet;
use nalgebra::{Matrix2, Point2, RowVector3, Vector2, Vector3};

use super::AlmError;
use crate::data::state::PointStatus;
use crate::law::JointLaw;
use crate::model::{Anchor, JointPoint, Model, PlacedJoint};
use crate::paper::film::law::FilmState;
use crate::paper::film::pointwise::{FilmResponse, PointwiseFilm};
use crate::paper::film::strip::Strip;
use crate::paper::film::{Matrix8, Vector8};
use crate::system::kinematics::shares;

/// A part of a film whose faces stay straight under all displacements of the nodes: the part that the contact points
/// at its two Gauss points stand for.
///
/// The ends follow the edges of the blocks. The corresponding change of nodes is (3.40)-(3.53), `u = T^T u'`, for
/// straight edges.
#[derive(Debug, Clone)]
pub struct Segment {
    /// The joint of the segment, an index into the joints of the model.
    pub joint: usize,
    /// The middle of the segment, halfway between the faces \[m\].
    middle: Point2<f64>,
    /// The strip of the segment, with the law at its Gauss points.
    pub film: PointwiseFilm,
    /// The states of the Gauss points before the step.
    before: Vec<FilmState>,
    /// The initial displacements of the ends \[m\], in axes of the segment, that stand for the initial gaps.
    apart: Vector8,
    /// The rotation matrix from global axes to the axes of the segment.
    axes: Matrix2<f64>,
    /// The nodes around each of the four ends of the segment, each by the index of its first unknown and its share of
    /// the displacement of the end; empty for an end on a support.
    ends: [Vec<(usize, f64)>; 4],
}

/// Builds the segments of all films of a model; `start` has the index of the first unknown of every block.
pub(super) fn attached(model: &Model, start: &[usize]) -> Result<Vec<Segment>, AlmError> {
    let in_films: Vec<&JointPoint> = model.contacts.iter().filter(|it| it.film.is_some()).collect();
    in_films
        .chunks(2)
        .map(|points| match points {
            [first, last] => Segment::of(model, first, last, start),
            _ => Err(AlmError::Points),
        })
        .collect()
}

impl Segment {
    /// Builds the segment from the start of the length of its first contact point to the end of the length of the
    /// second one.
    fn of(
        model: &Model,
        first: &JointPoint,
        last: &JointPoint,
        start: &[usize],
    ) -> Result<Self, AlmError> {
        let joint = &model.joints[first.joint.index()];
        let class = &model.joint_classes[joint.class];
        if class.law.stiffness.is_some() {
            return Err(AlmError::Stiffness { class: class.name.clone() });
        }
        if class.law != JointLaw::friction(class.law.mu) {
            return Err(AlmError::Strength { class: class.name.clone() });
        }
        let (Some(mortar), [Some(from), Some(to)]) =
            (joint.film.map(|film| film.mortar), [first.film, last.film])
        else {
            return Err(AlmError::Points);
        };
        let has_pair = from.stretch.is_some() && first.joint == last.joint;
        if !has_pair || from.b[1] != to.b[0] {
            return Err(AlmError::Points);
        }
        let strip = Strip::new(
            from.length + to.length,
            mortar.thickness,
            model.thickness,
            &mortar.material,
        )?;
        let nodes = |end: Option<Anchor>| -> Result<Vec<(usize, f64)>, AlmError> {
            let Some(anchor) = end else { return Ok(Vec::new()) };
            let block = &model.blocks[anchor.block.index()];
            if block.elasticity.is_none() {
                return Err(AlmError::Rigid { block: block.name.clone() });
            }
            let first = start[anchor.block.index()];
            Ok(shares(block, anchor).map(|(node, share)| (first + 2 * node, share)).to_vec())
        };
        let lower = [from.a.map(|face| face[0]), to.a.map(|face| face[1])];
        let upper = [Some(from.b[0]), Some(to.b[1])];
        let film = PointwiseFilm::new(strip, class.law.mu, 1)?;
        let tangent = joint.tangent();
        let mut segment = Self {
            joint: first.joint.index(),
            middle: nalgebra::center(&first.position, &last.position),
            before: film.initial(),
            apart: Vector8::zeros(),
            film,
            axes: Matrix2::new(tangent.x, tangent.y, -tangent.y, tangent.x),
            ends: [nodes(lower[0])?, nodes(lower[1])?, nodes(upper[0])?, nodes(upper[1])?],
        };
        segment.start_from(first, last);
        Ok(segment)
    }

    /// Sets the initial gaps and slips at the two Gauss points from two contact points; gaps are linear between the
    /// points.
    fn start_from(&mut self, first: &JointPoint, last: &JointPoint) {
        let strip = self.film.strip();
        let places: Vec<f64> = self.film.places().collect();
        let slope = (last.gap - first.gap) / (places[1] - places[0]);
        for (node, end) in [2, 3].into_iter().zip(strip.ends()) {
            self.apart[2 * node + 1] = first.gap + slope * (end - places[0]);
        }
        for ((state, place), point) in self.before.iter_mut().zip(places).zip([first, last]) {
            // Faces that are apart at an angle do not shear the mortar.
            let turned = (strip.strain_matrix(place) * self.apart).z;
            state.slip = strip.thickness() * turned - point.slip;
        }
    }

    /// Returns the displacements of the ends of the segment in its own axes \[m\], including the initial
    /// displacements that stand for the initial gaps.
    pub fn displacements(&self, u: &[f64]) -> Vector8 {
        self.motion(u) + self.apart
    }

    /// Returns the displacements of the ends of the segment that are due to displacements of the blocks alone \[m\].
    pub(super) fn motion(&self, u: &[f64]) -> Vector8 {
        let mut motion = Vector8::zeros();
        for (end, nodes) in self.ends.iter().enumerate() {
            let moved = nodes.iter().map(|&(j, share)| Vector2::new(u[j], u[j + 1]) * share);
            motion
                .fixed_rows_mut::<2>(2 * end)
                .copy_from(&(self.axes * moved.sum::<Vector2<f64>>()));
        }
        motion
    }

    /// Computes the response of the film to displacements of all blocks.
    pub fn respond(&self, u: &[f64]) -> FilmResponse {
        self.film.respond(&self.displacements(u), &self.before)
    }

    /// Returns the tangent stiffness with zero slip stiffness at slipping points: symmetric, and constant as long as
    /// no point changes its state.
    pub(super) fn matrix(&self, response: &FilmResponse) -> Matrix8 {
        self.film.tangent(response.points.iter().map(|point| {
            let mut tangent = point.tangent;
            if point.contact == PointStatus::Slip {
                tangent.set_row(2, &RowVector3::zeros());
            }
            tangent
        }))
    }

    /// Adds forces at the ends of the segment to the force vector of all unknowns.
    pub(super) fn add_force(&self, force: &Vector8, all: &mut [f64]) {
        for (end, nodes) in self.ends.iter().enumerate() {
            let force = self.axes.transpose() * force.fixed_rows::<2>(2 * end);
            for &(j, share) in nodes {
                all[j] += share * force.x;
                all[j + 1] += share * force.y;
            }
        }
    }

    /// Returns the entries of an 8 x 8 matrix of the segment in the numbering of all unknowns.
    pub(super) fn entries(&self, k: &Matrix8) -> Vec<Triplet<usize, usize, f64>> {
        let mut entries = Vec::new();
        for (row, rows) in self.ends.iter().enumerate() {
            for (column, columns) in self.ends.iter().enumerate() {
                let part = k.fixed_view::<2, 2>(2 * row, 2 * column);
                let part = self.axes.transpose() * part * self.axes;
                for (&(i, w), &(j, v)) in
                    rows.iter().flat_map(|row| columns.iter().map(move |column| (row, column)))
                {
                    let places = [(0, 0), (0, 1), (1, 0), (1, 1)];
                    entries.extend(
                        places.map(|(p, q)| Triplet::new(i + p, j + q, w * v * part[(p, q)])),
                    );
                }
            }
        }
        entries
    }

    /// Returns the forces at the ends of the lower face on its support, each with its place, in global axes.
    pub(super) fn lower_forces(
        &self,
        joint: &PlacedJoint,
        response: &FilmResponse,
    ) -> [(Point2<f64>, Vector2<f64>); 2] {
        let (tangent, strip) = (joint.tangent(), self.film.strip());
        let middle = self.middle - joint.normal * (0.5 * strip.thickness());
        [0, 1].map(|end| {
            let force = self.axes.transpose() * response.force.fixed_rows::<2>(2 * end);
            (middle + tangent * strip.ends()[end], force)
        })
    }

    /// Returns the elastic energy of the mortar for displacements of all blocks \[J\].
    pub fn energy(&self, u: &[f64]) -> f64 {
        let compliance = self.film.strip().elasticity().try_inverse().unwrap_or_default();
        let density = |stress: &Vector3<f64>| 0.5 * stress.dot(&(compliance * stress));
        let points = self.respond(u).points;
        points.iter().map(|point| density(&point.stress) * self.film.volume()).sum()
    }
}
