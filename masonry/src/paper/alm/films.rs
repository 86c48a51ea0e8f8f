//! Whole films between blocks, with displacements of the nodes of the blocks as their only unknowns.

use std::collections::HashMap;

use nalgebra::{Matrix2, Point2, RowVector3, Vector2};

use crate::data::state::ContactStatus;
use crate::geometry::SAME_PLACE;
use crate::law::JointLaw;
use crate::model::{Anchor, ContactPoint, Joint, Model};
use crate::paper::film::change::{ChangeError, NodalChange};
use crate::paper::film::law::FilmState;
use crate::paper::film::pointwise::{FilmResponse, PointwiseFilm};
use crate::paper::film::strip::{Strip, local_axes};
use crate::paper::film::{FilmError, Matrix8, Vector8};

/// A part of a film on which both faces are straight however the nodes move.
#[derive(Debug, Clone)]
pub struct Segment {
    /// The joint of the model.
    pub joint: usize,
    /// Its middle along the tangent, from the start of the joint \[m\].
    middle: f64,
    /// The strip with its law.
    pub film: PointwiseFilm,
    /// States of the Gauss points before the step.
    before: Vec<FilmState>,
    /// What its ends are apart, in its own axes, before any block moves.
    apart: Vector8,
    /// The displacements of its ends, in its own axes, from those of the nodes it is attached to.
    from_nodes: Matrix8,
    /// The unknowns of `u` and `v` of every one of these nodes; none on a support.
    unknowns: [Option<usize>; 8],
}

/// Why films could not be attached to the blocks.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AttachError {
    /// The film itself.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// The move of one of its nodes to those of a block.
    #[error(transparent)]
    Change(#[from] ChangeError),
    /// A block without a mesh has no nodes.
    #[error(
        "block \"{block}\" is rigid, and films are attached to nodes: give it an elastic modulus"
    )]
    Rigid {
        /// Its name.
        block: String,
    },
    /// The law of the film has friction only.
    #[error(
        "the joint class \"{class}\" has cohesion or tensile strength, which films as strips do not have"
    )]
    Strength {
        /// Its name.
        class: String,
    },
    /// The law of the film has its own stiffness only.
    #[error(
        "the joint class \"{class}\" has a stiffness beside that of its mortar, which films as strips do not have"
    )]
    Stiffness {
        /// Its name.
        class: String,
    },
    /// Contact points and segments of films were divided in different ways.
    #[error(
        "the films have {points} contact points and {segments} segments, which should have two each: let nodes of \
         both faces coincide, or lie farther apart"
    )]
    Points {
        /// Contact points of strips.
        points: usize,
        /// Segments between nodes.
        segments: usize,
    },
}

/// The segments of all films of a model; `start` is the first unknown of every block.
pub(super) fn attached(model: &Model, start: &[usize]) -> Result<Vec<Segment>, AttachError> {
    let mut anchors = HashMap::new();
    for contact in &model.contacts {
        anchors.entry(contact.joint.index()).or_insert((contact.a, contact.b));
    }
    let mut segments = Vec::new();
    for (joint, it) in model.joints.iter().enumerate() {
        if let (Some(_), Some(&(a, b))) = (it.film, anchors.get(&joint)) {
            of_joint(model, joint, it, [a, Some(b)], start, &mut segments)?;
        }
    }
    start_from_points(model, &mut segments)?;
    Ok(segments)
}

/// Gaps and slips of a model with contact points at the Gauss points of all segments; without such points films
/// start closed and from rest.
fn start_from_points(model: &Model, segments: &mut [Segment]) -> Result<(), AttachError> {
    let in_strips = |it: &&ContactPoint| it.film.is_some_and(|film| film.stretch.is_some());
    let points: Vec<&ContactPoint> = model.contacts.iter().filter(in_strips).collect();
    let (points_found, segments_found) = (points.len(), segments.len());
    if points_found > 0 && points_found != 2 * segments_found {
        return Err(AttachError::Points { points: points_found, segments: segments_found });
    }
    for (segment, points) in segments.iter_mut().zip(points.chunks_exact(2)) {
        segment.start_from(points[0], points[1]);
    }
    Ok(())
}

fn of_joint(
    model: &Model,
    index: usize,
    joint: &Joint,
    sides: [Option<Anchor>; 2],
    start: &[usize],
    segments: &mut Vec<Segment>,
) -> Result<(), AttachError> {
    let Some(film) = joint.film else { return Ok(()) };
    let (tangent, length) = (joint.tangent(), joint.length());
    let along = |p: &Point2<f64>| (p - joint.from).dot(&tangent);
    // The joint may run either way along its tangent.
    let [first, last] = [along(&joint.from), along(&joint.to)];
    let [first, last] = [first.min(last), first.max(last)];
    let [low, up] = [edge_of(model, sides[0], along)?, edge_of(model, sides[1], along)?];
    let near = SAME_PLACE * length;
    let mut ends: Vec<f64> =
        [&low, &up].into_iter().flatten().flatten().map(|node| node.place).collect();
    ends.retain(|x| *x > first + near && *x < last - near);
    ends.extend([first, last]);
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|b, a| *b - *a < near);
    let class = &model.joint_classes[joint.class];
    if class.law.stiffness.is_some() {
        return Err(AttachError::Stiffness { class: class.name.clone() });
    }
    if class.law != JointLaw::friction(class.law.mu) {
        return Err(AttachError::Strength { class: class.name.clone() });
    }
    let mu = class.law.mu;
    for pair in ends.windows(2) {
        let (middle, length) = (0.5 * (pair[0] + pair[1]), pair[1] - pair[0]);
        let mut faces = [[-0.5 * length, 0.5 * length]; 2];
        let mut unknowns = [None; 8];
        for (side, edge) in [&low, &up].into_iter().enumerate() {
            let around = edge.as_ref().and_then(|edge| {
                edge.windows(2).find(|ends| ends[0].place <= middle && middle <= ends[1].place)
            });
            let (Some(around), Some(anchor)) = (around, sides[side]) else { continue };
            for (end, node) in around.iter().enumerate() {
                faces[side][end] = node.place - middle;
                let first = start[anchor.block.index()] + 2 * node.index;
                let place = 4 * side + 2 * end;
                (unknowns[place], unknowns[place + 1]) = (Some(first), Some(first + 1));
            }
        }
        let name = || format!("the film of joint {index}");
        let change = NodalChange::of_film(&name(), length, faces)?;
        let both = change.matrix().kronecker(&Matrix2::identity());
        let strip =
            Strip::new(length, film.mortar.thickness, model.thickness, &film.mortar.material)?;
        let film = PointwiseFilm::new(strip, mu, 1)?;
        segments.push(Segment {
            joint: index,
            middle,
            before: film.initial(),
            apart: Vector8::zeros(),
            film,
            from_nodes: both.transpose() * local_axes(tangent),
            unknowns,
        });
    }
    Ok(())
}

/// A node on an edge.
struct EdgeNode {
    /// Along the tangent of the joint \[m\].
    place: f64,
    /// In the mesh of the block.
    index: usize,
}

/// The nodes of an edge along the tangent; none of a support.
fn edge_of(
    model: &Model,
    anchor: Option<Anchor>,
    along: impl Fn(&Point2<f64>) -> f64,
) -> Result<Option<Vec<EdgeNode>>, AttachError> {
    let Some(anchor) = anchor else { return Ok(None) };
    let block = &model.blocks[anchor.block.index()];
    let Some(mesh) = &block.mesh else {
        return Err(AttachError::Rigid { block: block.name.clone() });
    };
    let mut nodes: Vec<EdgeNode> = mesh
        .edge_nodes(anchor.edge)
        .into_iter()
        .map(|index| EdgeNode { place: along(&mesh.nodes[index]), index })
        .collect();
    nodes.sort_by(|a, b| a.place.total_cmp(&b.place));
    Ok(Some(nodes))
}

impl Segment {
    /// Initial gaps and slips at its two Gauss points; gaps are linear between them.
    fn start_from(&mut self, first: &ContactPoint, last: &ContactPoint) {
        let strip = self.film.strip();
        let places: Vec<f64> = self.film.places().collect();
        let slope = (last.gap - first.gap) / (places[1] - places[0]);
        for (node, end) in [2, 3].into_iter().zip(strip.ends()) {
            self.apart[2 * node + 1] = first.gap + slope * (end - places[0]);
        }
        for ((state, place), point) in self.before.iter_mut().zip(places).zip([first, last]) {
            // Faces that are apart at an angle are no shear of the mortar.
            let turned = (strip.strain_matrix(place) * self.apart).z;
            state.slip = strip.thickness() * turned - point.slip;
        }
    }

    /// Displacements of the ends of the segment in its own axes, with what they are apart before.
    pub fn displacements(&self, u: &[f64]) -> Vector8 {
        self.motion(u) + self.apart
    }

    /// What the displacements of the blocks make of them.
    pub(super) fn motion(&self, u: &[f64]) -> Vector8 {
        let nodes = self.unknowns.map(|unknown| unknown.map_or(0.0, |j| u[j]));
        self.from_nodes * Vector8::from(nodes)
    }

    /// What the law answers to displacements of all blocks.
    pub fn respond(&self, u: &[f64]) -> FilmResponse {
        self.film.respond(&self.displacements(u), &self.before)
    }

    /// The tangent with the friction of points that slip held: symmetric, and the same as long as no point
    /// changes its state.
    pub(super) fn matrix(&self, response: &FilmResponse) -> Matrix8 {
        let strip = self.film.strip();
        let points = self.film.places().zip(&response.points).map(|(x, point)| {
            let b = strip.strain_matrix(x);
            let mut tangent = point.tangent;
            if point.contact == ContactStatus::Slip {
                tangent.set_row(2, &RowVector3::zeros());
            }
            b.transpose() * tangent * b * self.volume()
        });
        points.sum()
    }

    /// Volume of the film around a Gauss point \[m^3\].
    fn volume(&self) -> f64 {
        let strip = self.film.strip();
        strip.length() * strip.wall() * strip.thickness() / self.before.len() as f64
    }

    /// Adds forces at its ends to those of all unknowns.
    pub(super) fn add_force(&self, force: &Vector8, all: &mut [f64]) {
        let force = self.from_nodes.transpose() * force;
        for (unknown, value) in self.unknowns.iter().zip(force.iter()) {
            if let Some(j) = unknown {
                all[*j] += value;
            }
        }
    }

    /// The entries of a matrix at its ends among those of all unknowns.
    pub(super) fn entries(&self, k: &Matrix8) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let k = self.from_nodes.transpose() * k * self.from_nodes;
        (0..8).flat_map(move |i| {
            (0..8).filter_map(move |j| Some((self.unknowns[i]?, self.unknowns[j]?, k[(i, j)])))
        })
    }

    /// Places and forces, in global axes, of what holds the ends of the lower face.
    pub(super) fn lower_forces(
        &self,
        joint: &Joint,
        response: &FilmResponse,
    ) -> [(Point2<f64>, Vector2<f64>); 2] {
        let (tangent, strip) = (joint.tangent(), self.film.strip());
        let middle = joint.from + tangent * self.middle - joint.normal * (0.5 * strip.thickness());
        [0, 1].map(|end| {
            let force = response.force.fixed_rows::<2>(2 * end);
            let place = middle + tangent * strip.ends()[end];
            (place, tangent * force[0] + joint.normal * force[1])
        })
    }

    /// Elastic energy of the mortar for displacements of all blocks \[J\].
    pub fn energy(&self, u: &[f64]) -> f64 {
        let strip = self.film.strip();
        let compliance = strip.elasticity().try_inverse().unwrap_or_default();
        let points = self.respond(u).points;
        points.iter().map(|p| 0.5 * p.stress.dot(&(compliance * p.stress)) * self.volume()).sum()
    }
}
