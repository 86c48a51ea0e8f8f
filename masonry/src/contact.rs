//! Joints and contact points: where blocks can touch each other and the supports.
//!
//! A joint is the overlap of two edges that face each other. Its contact points are places on both
//! edges, in general between nodes: the relative displacement is interpolated on each side by
//! that side's own shape functions, so that meshes need not match.
//!
//! # Orientation
//! Normals of joints between blocks point upwards in beds (within 45 degrees of the vertical) and to
//! the right in heads, whatever the order of the blocks; normals of supports point into the block.

use nalgebra::{Point2, Vector2};

pub(crate) use self::search::near_pairs;
use crate::geometry::{self, SegmentOverlap};
use crate::ids::{BlockId, JointId, SupportId};
use crate::model::{Anchor, Block, Body, ContactPoint, Joint, JointClass, Support};
pub use crate::scene::PointRule;

mod points;
mod search;

/// What kind of joint two sides make; it decides the joint's class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Between two blocks, the normal within 45 degrees of the vertical.
    Bed,
    /// Between two blocks, the normal closer to the horizontal.
    Head,
    /// Between a support and a block.
    Support(SupportId),
}

/// How joints are searched and points placed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// The places of the contact points.
    pub points: PointRule,
    /// The largest initial gap across which two edges make a joint \[m\].
    pub gap_limit: f64,
    /// Distances below this fraction of the size of the smaller block count as zero.
    pub tolerance: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { points: PointRule::Vertices, gap_limit: 0.0, tolerance: 1e-9 }
    }
}

/// Why contact points could not be placed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContactError {
    /// A joint has no place where nodes of both sides coincide.
    #[error(
        "the joint between {a} and {b} has no coincident nodes: \
         refine the mesh so that nodes match, or place contact points at vertices"
    )]
    NoNodalPair {
        /// Name of side `a`.
        a: String,
        /// Name of side `b`.
        b: String,
    },
}

/// Finds all joints and places their contact points.
///
/// `class_of` maps the kind of a joint to an index into `classes`, `thickness` \[m\] turns lengths
/// into the areas that points stand for. Joints come in the order of their blocks, those with supports
/// after those between blocks; points come joint by joint, along the joint's tangent. Blocks that
/// only touch at a corner make no joint.
///
/// # Errors
/// [`ContactError::NoNodalPair`] with [`PointRule::NodalPairs`] on meshes that do not match.
///
/// # Panics
/// If `class_of` returns an index outside `classes`.
pub fn find(
    blocks: &[Block],
    supports: &[Support],
    classes: &[JointClass],
    class_of: impl Fn(JointKind) -> usize,
    thickness: f64,
    options: &Options,
) -> Result<(Vec<Joint>, Vec<ContactPoint>), ContactError> {
    let mut joints = Vec::new();
    let mut contacts = Vec::new();
    let mut add = |meeting: &Meeting| {
        let points = meeting.points(blocks, options);
        if points.is_empty() {
            let name = |body: Body| match body {
                Body::Block(id) => blocks[id.index()].name.clone(),
                Body::Support(id) => supports[id.index()].name.clone(),
            };
            return Err(ContactError::NoNodalPair {
                a: name(meeting.a),
                b: name(Body::Block(meeting.b)),
            });
        }
        let joint = JointId::new(joints.len());
        let class = class_of(meeting.kind);
        let mu = classes[class].mu;
        contacts.extend(points.iter().map(|p| meeting.contact(blocks, p, joint, mu, thickness)));
        joints.push(meeting.joint(blocks, class));
        Ok(())
    };
    for [first, second] in near_pairs(blocks, options) {
        for meeting in between_blocks(blocks, first, second, options) {
            add(&meeting)?;
        }
    }
    for (k, support) in supports.iter().enumerate() {
        for (b, block) in blocks.iter().enumerate() {
            for meeting in on_support(support, SupportId::new(k), block, BlockId::new(b), options) {
                add(&meeting)?;
            }
        }
    }
    Ok((joints, contacts))
}

/// Two sides that face each other, before a class and points are given to them.
struct Meeting {
    kind: JointKind,
    a: Body,
    a_edge: usize,
    b: BlockId,
    b_edge: usize,
    /// Side `a` is the first segment of the overlap.
    overlap: SegmentOverlap,
}

/// The joints between two blocks: at most one, unless a gap limit lets more edges see each other.
fn between_blocks(
    blocks: &[Block],
    first: BlockId,
    second: BlockId,
    options: &Options,
) -> Vec<Meeting> {
    let corners = |id: BlockId| &blocks[id.index()].corners;
    let size = geometry::size(corners(first)).min(geometry::size(corners(second)));
    let slack = options.tolerance * size;
    let overlap = |a: BlockId, ka: usize, b: BlockId, kb: usize| {
        let (a, b) = (geometry::edge(corners(a), ka), geometry::edge(corners(b), kb));
        geometry::facing_overlap(a, b, slack, options.gap_limit)
    };
    let mut meetings = Vec::new();
    for k1 in 0..4 {
        for k2 in 0..4 {
            let Some(found) = overlap(first, k1, second, k2) else { continue };
            let (kind, forward) = classify(found.normal, options.tolerance);
            let meeting = if forward {
                Some((first, k1, second, k2, found))
            } else {
                overlap(second, k2, first, k1).map(|o| (second, k2, first, k1, o))
            };
            meetings.extend(meeting.map(|(a, a_edge, b, b_edge, overlap)| Meeting {
                kind,
                a: Body::Block(a),
                a_edge,
                b,
                b_edge,
                overlap,
            }));
        }
    }
    meetings
}

/// Bed or head, and whether the normal already points the agreed way.
fn classify(normal: Vector2<f64>, tolerance: f64) -> (JointKind, bool) {
    // At exactly 45 degrees rounding must not decide.
    if normal.y.abs() >= normal.x.abs() * (1.0 - tolerance) {
        (JointKind::Bed, normal.y > 0.0)
    } else {
        (JointKind::Head, normal.x > 0.0)
    }
}

/// The joints between a support and a block; the support may lie on either side of its line.
fn on_support(
    support: &Support,
    id: SupportId,
    block: &Block,
    b: BlockId,
    options: &Options,
) -> Vec<Meeting> {
    let slack = options.tolerance * geometry::size(&block.corners);
    let mut meetings = Vec::new();
    for b_edge in 0..4 {
        let edge = geometry::edge(&block.corners, b_edge);
        for line in [[support.from, support.to], [support.to, support.from]] {
            let overlap = geometry::facing_overlap(line, edge, slack, options.gap_limit);
            meetings.extend(overlap.map(|overlap| Meeting {
                kind: JointKind::Support(id),
                a: Body::Support(id),
                a_edge: 0,
                b,
                b_edge,
                overlap,
            }));
        }
    }
    meetings
}

impl Meeting {
    /// The overlap runs along the first segment, which is against the joint's tangent.
    fn joint(&self, blocks: &[Block], class: usize) -> Joint {
        let [to, from] = self.overlap.on_second.map(|at| self.on_b(blocks, at));
        Joint { a: self.a, b: self.b, class, from, to, normal: self.overlap.normal }
    }

    fn on_b(&self, blocks: &[Block], at: f64) -> Point2<f64> {
        geometry::on_edge(&blocks[self.b.index()].corners, self.b_edge, at)
    }

    fn points(&self, blocks: &[Block], options: &Options) -> Vec<points::Place> {
        let b = &blocks[self.b.index()];
        let [b_start, b_end] = geometry::edge(&b.corners, self.b_edge);
        let b_side = points::Side {
            fractions: edge_fractions(b, self.b_edge),
            overlap: [self.overlap.on_second[1], self.overlap.on_second[0]],
        };
        let a_side = match self.a {
            Body::Support(_) => None,
            Body::Block(id) => Some(points::Side {
                fractions: edge_fractions(&blocks[id.index()], self.a_edge),
                overlap: [self.overlap.on_first[1], self.overlap.on_first[0]],
            }),
        };
        let length =
            (b_end - b_start).norm() * (self.overlap.on_second[0] - self.overlap.on_second[1]);
        let slack = options.tolerance * geometry::size(&b.corners) / length;
        points::place(options.points, a_side.as_ref(), &b_side, length, slack)
    }

    fn contact(
        &self,
        blocks: &[Block],
        place: &points::Place,
        joint: JointId,
        mu: f64,
        thickness: f64,
    ) -> ContactPoint {
        let a = match self.a {
            Body::Block(block) => Some(Anchor { block, edge: self.a_edge, at: place.on_a }),
            Body::Support(_) => None,
        };
        let [gap_to, gap_from] = self.overlap.gap;
        ContactPoint {
            joint,
            position: self.on_b(blocks, place.on_b),
            weight: place.weight * thickness,
            a,
            b: Anchor { block: self.b, edge: self.b_edge, at: place.on_b },
            gap: gap_from + (gap_to - gap_from) * place.along,
            mu,
        }
    }
}

/// Places of the nodes of a block's edge; a rigid block has its corners only.
fn edge_fractions(block: &Block, edge: usize) -> Vec<f64> {
    block.mesh.as_ref().map_or_else(|| vec![0.0, 1.0], |mesh| mesh.edge_fractions(edge))
}
