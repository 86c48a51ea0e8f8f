//! Joints and contact points: the places at which blocks can touch each other and the supports.
//!
//! A joint is the overlap of two edges that face each other. Its contact points are places on both
//! edges, in general between nodes: the relative displacement is interpolated on each side by
//! that side's own shape functions, so that meshes need not match.
//!
//! The two edges of a joint with mortar are apart by the thickness of the mortar, and the joint is a film between them:
//! a gap is the excess of the distance of the edges over that thickness.
//!
//! # Orientation
//! Normals of joints between blocks point upwards in beds (within 45 degrees of the vertical) and to
//! the right in heads, whatever the order of the blocks; normals of supports point into the block.

use nalgebra::{Point2, Vector2};

pub(crate) use self::search::near_pairs;
use crate::geometry::{self, SAME_PLACE, SegmentOverlap};
use crate::ids::{BlockId, FilmId, JointId, SupportId};
use crate::model::{
    Anchor, Body, Film, FilmPoint, JointClass, JointPoint, Mortar, PlacedBlock, PlacedJoint,
    PlacedSupport,
};
pub use crate::scene::{ContactError, Films, PointRule};

mod points;
mod search;

/// The bodies that a joint is between, which decide its class.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointKind {
    /// A joint between two blocks; the value is the unit normal of the joint.
    Blocks(Vector2<f64>),
    /// A joint between a support and a block.
    Support(SupportId),
}

/// The settings of the search for joints and of the positions of contact points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointSearch {
    /// The rule for the positions of the contact points.
    pub points: PointRule,
    /// The largest initial gap \[m\], in addition to the thickness of mortar, at which two edges make a joint.
    pub gap_limit: f64,
    /// The terms of mortar films that are kept; strips need [`PointRule::Gauss`].
    pub films: Films,
}

/// Finds all joints and places their contact points.
///
/// `class_of` maps the kind of a joint and its two sides to an index into `classes`. Lengths times the `thickness`
/// \[m\] are the areas that points stand for. Joints between blocks come first, in the order of their blocks, and then
/// joints with supports. Points come joint by joint, along the tangent of the joint. Blocks that touch only at a
/// corner make no joint.
///
/// # Errors
/// [`ContactError::NoNodalPair`] if [`PointRule::NodalPairs`] is used on meshes that do not match, and
/// [`ContactError::NoRoomForFilm`] if the distance of two edges is less than the thickness of the mortar between them.
///
/// # Panics
/// If `class_of` returns an index outside `classes`.
pub fn find(
    blocks: &[PlacedBlock],
    supports: &[PlacedSupport],
    classes: &[JointClass],
    class_of: impl Fn(JointKind, Body, BlockId) -> usize,
    thickness: f64,
    options: &JointSearch,
) -> Result<(Vec<PlacedJoint>, Vec<JointPoint>), ContactError> {
    let mut joints: Vec<PlacedJoint> = Vec::new();
    let mut contacts = Vec::new();
    let mut films = 0;
    let name = |body: Body| match body {
        Body::Block(id) => blocks[id.index()].name.clone(),
        Body::Support(id) => supports[id.index()].name.clone(),
    };
    let mut add = |candidate: &Candidate| {
        let sides = candidate.sides;
        let index = class_of(candidate.kind, sides.a, sides.b);
        let class = &classes[index];
        let names = || [sides.a, Body::Block(sides.b)].map(name);
        let overlap = candidate.overlap(class.mortar, options.gap_limit).map_err(|gap| {
            let [a, b] = names();
            let [nearest, farthest] = [gap[0].min(gap[1]), gap[0].max(gap[1])];
            let thickness = class.mortar.map_or(0.0, |mortar| mortar.thickness);
            let class = class.name.clone();
            ContactError::NoRoomForFilm { a, b, class, nearest, farthest, thickness }
        })?;
        let Some(overlap) = overlap else { return Ok(()) };
        let meeting = Meeting { blocks, sides, overlap, class, films: options.films, thickness };
        let points = meeting.points(class.points.unwrap_or(options.points));
        if points.is_empty() {
            let [a, b] = names();
            return Err(ContactError::NoNodalPair { a, b });
        }
        let joint = JointId::new(joints.len());
        let film = class.mortar.map(|mortar| Film { id: FilmId::new(films), mortar });
        films += usize::from(film.is_some());
        contacts.extend(points.iter().map(|place| meeting.contact(place, joint)));
        joints.push(meeting.joint(index, film));
        Ok(())
    };
    let thickest = classes.iter().filter_map(|class| class.mortar).map(|it| it.thickness);
    let reach = options.gap_limit + thickest.fold(0.0, f64::max);
    for pair in near_pairs(blocks.iter().map(|it| &it.corners[..]), reach) {
        let [first, second] = pair.map(BlockId::new);
        between_blocks(blocks, first, second).iter().try_for_each(&mut add)?;
    }
    for (k, support) in supports.iter().enumerate() {
        for (b, block) in blocks.iter().enumerate() {
            let candidates = on_support(support, SupportId::new(k), block, BlockId::new(b));
            candidates.iter().try_for_each(&mut add)?;
        }
    }
    Ok((joints, contacts))
}

/// The edges of two bodies between which joints are sought; the edge of a support is edge 0.
#[derive(Clone, Copy)]
struct Sides {
    a: Body,
    a_edge: usize,
    b: BlockId,
    b_edge: usize,
}

/// Two edges that face each other, at any distance, and so could make a joint.
struct Candidate {
    kind: JointKind,
    sides: Sides,
    /// The edge of side `a`, and of side `b`.
    edges: [[Point2<f64>; 2]; 2],
    /// The largest distance of edges that count as touching \[m\].
    slack: f64,
}

/// Returns the pairs of edges of two blocks that could make a joint.
fn between_blocks(blocks: &[PlacedBlock], first: BlockId, second: BlockId) -> Vec<Candidate> {
    let [p, q] = [first, second].map(|id| &blocks[id.index()].corners);
    let slack = SAME_PLACE * geometry::size(p).min(geometry::size(q));
    let pairs = (0..p.len()).flat_map(|k1| (0..q.len()).map(move |k2| [k1, k2]));
    let candidate = |[k1, k2]: [usize; 2]| {
        let [of_first, of_second] = [geometry::edge(p, k1), geometry::edge(q, k2)];
        let normal = geometry::facing_normal(of_first, of_second)?;
        let kind = JointKind::Blocks(normal);
        let is_forward = if is_bed(normal) { normal.y > 0.0 } else { normal.x > 0.0 };
        let (sides, edges) = if is_forward {
            let sides = Sides { a: Body::Block(first), a_edge: k1, b: second, b_edge: k2 };
            (sides, [of_first, of_second])
        } else {
            let sides = Sides { a: Body::Block(second), a_edge: k2, b: first, b_edge: k1 };
            (sides, [of_second, of_first])
        };
        Some(Candidate { kind, sides, edges, slack })
    };
    pairs.filter_map(candidate).collect()
}

/// Returns whether a joint between blocks is a bed joint, whose normal is within 45 degrees of the vertical, and not a
/// head joint.
pub fn is_bed(normal: Vector2<f64>) -> bool {
    // Rounding must not decide at exactly 45 degrees.
    normal.y.abs() >= normal.x.abs() * (1.0 - SAME_PLACE)
}

/// Returns the edges of a block that could rest on a support, on either side of the support's line.
fn on_support(
    support: &PlacedSupport,
    id: SupportId,
    block: &PlacedBlock,
    b: BlockId,
) -> Vec<Candidate> {
    let slack = SAME_PLACE * geometry::size(&block.corners);
    let lines = [[support.from, support.to], [support.to, support.from]];
    let edges = (0..block.corners.len()).flat_map(|k| lines.map(|line| (k, line)));
    let candidate = |(b_edge, line)| Candidate {
        kind: JointKind::Support(id),
        sides: Sides { a: Body::Support(id), a_edge: 0, b, b_edge },
        edges: [line, geometry::edge(&block.corners, b_edge)],
        slack,
    };
    edges.map(candidate).collect()
}

impl Candidate {
    /// Returns the overlap of the two edges, after the edge of side `a` is shifted by the thickness of mortar; `None`
    /// if the edges do not meet.
    ///
    /// The error has the distances of the edges at both ends of the overlap, if the mortar does not fit between the
    /// edges.
    fn overlap(
        &self,
        mortar: Option<Mortar>,
        gap_limit: f64,
    ) -> Result<Option<SegmentOverlap>, [f64; 2]> {
        let Self { edges: [edge_a, edge_b], slack, .. } = *self;
        let Some(Mortar { thickness, .. }) = mortar else {
            return Ok(geometry::facing_overlap(edge_a, edge_b, slack, gap_limit));
        };
        let up = geometry::turn_right((edge_a[1] - edge_a[0]).normalize()) * thickness;
        let face = edge_a.map(|end| end + up);
        let filled = geometry::facing_overlap(face, edge_b, slack, gap_limit);
        if filled.is_some() {
            return Ok(filled);
        }
        let bare = geometry::facing_overlap(edge_a, edge_b, slack, 2.0 * thickness);
        let gap = bare.map_or([f64::INFINITY; 2], |overlap| overlap.gap);
        if gap.iter().all(|it| *it >= thickness - slack) { Ok(None) } else { Err(gap) }
    }
}

/// Two edges that meet in a joint of some class.
struct Meeting<'a> {
    blocks: &'a [PlacedBlock],
    sides: Sides,
    /// The overlap of the edges; its first segment is that of side `a`.
    overlap: SegmentOverlap,
    class: &'a JointClass,
    films: Films,
    /// Thickness of the wall \[m\].
    thickness: f64,
}

impl Meeting<'_> {
    /// Makes the joint. The overlap runs along the first segment, opposite to the tangent of the joint.
    fn joint(&self, class: usize, film: Option<Film>) -> PlacedJoint {
        let Sides { a, b, .. } = self.sides;
        let normal = self.overlap.normal;
        let half = normal * (0.5 * film.map_or(0.0, |film| film.mortar.thickness));
        let [to, from] = self.overlap.on_second.map(|at| self.on_b(at) - half);
        PlacedJoint { a, b, class, from, to, normal, film }
    }

    fn on_b(&self, at: f64) -> Point2<f64> {
        geometry::on_edge(&self.blocks[self.sides.b.index()].corners, self.sides.b_edge, at)
    }

    fn points(&self, rule: PointRule) -> Vec<points::PointPlace> {
        let SegmentOverlap { on_first, on_second, .. } = self.overlap;
        let face = |id: BlockId, edge: usize, [end, start]: [f64; 2]| points::Face {
            fractions: edge_fractions(&self.blocks[id.index()], edge),
            overlap: [start, end],
        };
        let a_side = match self.sides.a {
            Body::Support(_) => None,
            Body::Block(id) => Some(face(id, self.sides.a_edge, on_first)),
        };
        let b_side = face(self.sides.b, self.sides.b_edge, on_second);
        let corners = &self.blocks[self.sides.b.index()].corners;
        let [start, end] = geometry::edge(corners, self.sides.b_edge);
        let length = (end - start).norm() * (on_second[0] - on_second[1]);
        let slack = SAME_PLACE * geometry::size(corners) / length;
        points::place(rule, a_side.as_ref(), &b_side, length, slack)
    }

    fn contact(&self, place: &points::PointPlace, joint: JointId) -> JointPoint {
        let Sides { a, a_edge, b, b_edge } = self.sides;
        let on_a = |at| match a {
            Body::Block(block) => Some(Anchor { block, edge: a_edge, at }),
            Body::Support(_) => None,
        };
        let on_b = |at| Anchor { block: b, edge: b_edge, at };
        let [gap_to, gap_from] = self.overlap.gap;
        let weight = place.weight * self.thickness;
        let has_strips = self.films == Films::Strips;
        let film = self.class.mortar.map(|mortar| FilmPoint {
            half: 0.5 * mortar.thickness,
            length: place.weight,
            a: on_a(place.span_on_a[0]).zip(on_a(place.span_on_a[1])).map(<[Anchor; 2]>::from),
            b: place.span_on_b.map(on_b),
            compliance: mortar.compliance(weight),
            stretch: has_strips.then(|| mortar.stretch(place.weight, self.thickness)),
        });
        let half = self.overlap.normal * film.map_or(0.0, |film| film.half);
        JointPoint {
            joint,
            position: self.on_b(place.on_b) - half,
            weight,
            a: on_a(place.on_a),
            b: on_b(place.on_b),
            gap: gap_from + (gap_to - gap_from) * place.along,
            slip: 0.0,
            law: self.class.law.at(weight),
            compliance: self.class.law.compliance(weight),
            film,
        }
    }
}

/// Returns the places of the nodes of a block's edge as fractions of the edge; the edge of a rigid block has only its
/// two corners.
fn edge_fractions(block: &PlacedBlock, edge: usize) -> Vec<f64> {
    block.mesh.as_ref().map_or_else(|| vec![0.0, 1.0], |mesh| mesh.edge_fractions(edge))
}
