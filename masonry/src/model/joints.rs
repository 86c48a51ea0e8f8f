//! Joints and contact points: where blocks can touch each other and the supports.
//!
//! A joint is the overlap of two edges that face each other. Its contact points are places on both
//! edges, in general between nodes: the relative displacement is interpolated on each side by
//! that side's own shape functions, so that meshes need not match.
//!
//! In a joint class with mortar the two edges are apart by the thickness of the mortar, and the joint is a film
//! between them: a gap is the excess of their distance over that thickness.
//!
//! # Orientation
//! Normals of joints between blocks point upwards in beds (within 45 degrees of the vertical) and to
//! the right in heads, whatever the order of the blocks; normals of supports point into the block.

use nalgebra::{Point2, Vector2};

pub(crate) use self::search::near_pairs;
use crate::geometry::{self, SegmentOverlap};
use crate::ids::{BlockId, FilmId, JointId, SupportId};
use crate::law::JointLaw;
use crate::model::{
    Anchor, Block, Body, ContactPoint, Film, FilmPoint, Joint, JointClass, Mortar, Support,
};
pub use crate::scene::{ContactError, Films, PointRule};

mod points;
mod search;

/// The kind of joint that two sides make, which decides its class.
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
    /// The largest initial gap across which two edges make a joint \[m\], beyond the mortar.
    pub gap_limit: f64,
    /// Distances below this fraction of the size of the smaller block count as zero.
    pub tolerance: f64,
    /// The terms of mortar films that are kept; strips need [`PointRule::Gauss`].
    pub films: Films,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            points: PointRule::Vertices,
            gap_limit: 0.0,
            tolerance: 1e-9,
            films: Films::Compliance,
        }
    }
}

/// Finds all joints and places their contact points.
///
/// `class_of` maps the kind of a joint and its two sides to an index into `classes`, `thickness` \[m\] turns lengths
/// into the areas that points stand for. Joints come in the order of their blocks, those with supports
/// after those between blocks; points come joint by joint, along the joint's tangent. Blocks that
/// only touch at a corner make no joint.
///
/// # Errors
/// [`ContactError::NoNodalPair`] with [`PointRule::NodalPairs`] on meshes that do not match, and
/// [`ContactError::NoRoomForFilm`] for edges closer than the mortar between them is thick.
///
/// # Panics
/// If `class_of` returns an index outside `classes`.
pub fn find(
    blocks: &[Block],
    supports: &[Support],
    classes: &[JointClass],
    class_of: impl Fn(JointKind, Body, BlockId) -> usize,
    thickness: f64,
    options: &Options,
) -> Result<(Vec<Joint>, Vec<ContactPoint>), ContactError> {
    let mut joints: Vec<Joint> = Vec::new();
    let mut contacts = Vec::new();
    let mut films = 0;
    let name = |body: Body| match body {
        Body::Block(id) => blocks[id.index()].name.clone(),
        Body::Support(id) => supports[id.index()].name.clone(),
    };
    let mut add = |candidate: &Candidate| {
        let class = class_of(candidate.kind, candidate.a, candidate.b);
        let mortar = classes[class].mortar;
        let meeting = match candidate.meet(mortar, options) {
            Ok(Some(meeting)) => meeting,
            Ok(None) => return Ok(()),
            Err([nearest, farthest]) => {
                return Err(ContactError::NoRoomForFilm {
                    a: name(candidate.a),
                    b: name(Body::Block(candidate.b)),
                    class: classes[class].name.clone(),
                    nearest,
                    farthest,
                    thickness: mortar.map_or(0.0, |mortar| mortar.thickness),
                });
            }
        };
        let rule = classes[class].points.unwrap_or(options.points);
        let points = meeting.points(blocks, rule, options.tolerance);
        if points.is_empty() {
            return Err(ContactError::NoNodalPair {
                a: name(meeting.a),
                b: name(Body::Block(meeting.b)),
            });
        }
        let joint = JointId::new(joints.len());
        let film = mortar.map(|mortar| Film { id: FilmId::new(films), mortar });
        films += usize::from(film.is_some());
        let law = classes[class].law;
        let filling = mortar.map(|mortar| Filling { mortar, films: options.films });
        contacts.extend(
            points.iter().map(|p| meeting.contact(blocks, p, joint, filling, law, thickness)),
        );
        joints.push(meeting.joint(blocks, class, film));
        Ok(())
    };
    let thickest = classes.iter().filter_map(|class| class.mortar).map(|it| it.thickness);
    let reach = options.gap_limit + thickest.fold(0.0, f64::max);
    for [first, second] in near_pairs(blocks, reach, options.tolerance) {
        for candidate in between_blocks(blocks, first, second, options) {
            add(&candidate)?;
        }
    }
    for (k, support) in supports.iter().enumerate() {
        for (b, block) in blocks.iter().enumerate() {
            for candidate in on_support(support, SupportId::new(k), block, BlockId::new(b), options)
            {
                add(&candidate)?;
            }
        }
    }
    Ok((joints, contacts))
}

/// Two edges that look at each other, at whatever distance.
struct Candidate {
    kind: JointKind,
    a: Body,
    a_edge: usize,
    b: BlockId,
    b_edge: usize,
    /// The edge of side `a`, and of side `b`.
    edges: [[Point2<f64>; 2]; 2],
    /// The distance that counts as touching \[m\].
    slack: f64,
}

/// Two sides that meet, before points are given to them.
struct Meeting {
    a: Body,
    a_edge: usize,
    b: BlockId,
    b_edge: usize,
    /// Side `a` is the first segment of the overlap.
    overlap: SegmentOverlap,
}

/// The pairs of edges of two blocks that could make a joint.
fn between_blocks(
    blocks: &[Block],
    first: BlockId,
    second: BlockId,
    options: &Options,
) -> Vec<Candidate> {
    let corners = |id: BlockId| &blocks[id.index()].corners;
    let size = geometry::size(corners(first)).min(geometry::size(corners(second)));
    let slack = options.tolerance * size;
    let mut candidates = Vec::new();
    for k1 in 0..corners(first).len() {
        for k2 in 0..corners(second).len() {
            let edges = [geometry::edge(corners(first), k1), geometry::edge(corners(second), k2)];
            let Some(normal) = geometry::facing_normal(edges[0], edges[1]) else { continue };
            let (kind, forward) = classify(normal, options.tolerance);
            let (a, a_edge, b, b_edge, edges) = if forward {
                (first, k1, second, k2, edges)
            } else {
                (second, k2, first, k1, [edges[1], edges[0]])
            };
            let a = Body::Block(a);
            candidates.push(Candidate { kind, a, a_edge, b, b_edge, edges, slack });
        }
    }
    candidates
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

/// The edges of a block that could rest on a support, which may lie on either side of its line.
fn on_support(
    support: &Support,
    id: SupportId,
    block: &Block,
    b: BlockId,
    options: &Options,
) -> Vec<Candidate> {
    let slack = options.tolerance * geometry::size(&block.corners);
    let lines = [[support.from, support.to], [support.to, support.from]];
    let edges = (0..block.corners.len()).flat_map(|k| lines.map(|line| (k, line)));
    edges
        .map(|(b_edge, line)| Candidate {
            kind: JointKind::Support(id),
            a: Body::Support(id),
            a_edge: 0,
            b,
            b_edge,
            edges: [line, geometry::edge(&block.corners, b_edge)],
            slack,
        })
        .collect()
}

impl Candidate {
    /// The overlap of the two edges, with mortar on that of side `a` if there is any; `None` if they do
    /// not meet.
    ///
    /// The error holds their smallest and largest distance where the mortar does not fit between them.
    fn meet(&self, mortar: Option<Mortar>, options: &Options) -> Result<Option<Meeting>, [f64; 2]> {
        let Self { a, a_edge, b, b_edge, edges: [edge_a, edge_b], slack, .. } = *self;
        let of = |overlap| Meeting { a, a_edge, b, b_edge, overlap };
        let Some(thickness) = mortar.map(|mortar| mortar.thickness) else {
            let overlap = geometry::facing_overlap(edge_a, edge_b, slack, options.gap_limit);
            return Ok(overlap.map(of));
        };
        let up = geometry::turn_right((edge_a[1] - edge_a[0]).normalize()) * thickness;
        let face = edge_a.map(|end| end + up);
        let filled = geometry::facing_overlap(face, edge_b, slack, options.gap_limit);
        let Some(overlap) = filled else {
            let bare = geometry::facing_overlap(edge_a, edge_b, slack, 2.0 * thickness);
            let gap = bare.map_or([f64::INFINITY; 2], |overlap| overlap.gap);
            let [nearest, farthest] = [gap[0].min(gap[1]), gap[0].max(gap[1])];
            let fits = nearest >= thickness - slack;
            return if fits { Ok(None) } else { Err([nearest, farthest]) };
        };
        Ok(Some(of(overlap)))
    }
}

/// What fills a joint.
#[derive(Clone, Copy)]
struct Filling {
    mortar: Mortar,
    films: Films,
}

impl Meeting {
    /// The overlap runs along the first segment, which is against the joint's tangent.
    fn joint(&self, blocks: &[Block], class: usize, film: Option<Film>) -> Joint {
        let normal = self.overlap.normal;
        let half = normal * (0.5 * film.map_or(0.0, |film| film.mortar.thickness));
        let [to, from] = self.overlap.on_second.map(|at| self.on_b(blocks, at) - half);
        Joint { a: self.a, b: self.b, class, from, to, normal, film }
    }

    fn on_b(&self, blocks: &[Block], at: f64) -> Point2<f64> {
        geometry::on_edge(&blocks[self.b.index()].corners, self.b_edge, at)
    }

    fn points(&self, blocks: &[Block], rule: PointRule, tolerance: f64) -> Vec<points::PointPlace> {
        let b = &blocks[self.b.index()];
        let [b_start, b_end] = geometry::edge(&b.corners, self.b_edge);
        let b_side = points::Face {
            fractions: edge_fractions(b, self.b_edge),
            overlap: [self.overlap.on_second[1], self.overlap.on_second[0]],
        };
        let a_side = match self.a {
            Body::Support(_) => None,
            Body::Block(id) => Some(points::Face {
                fractions: edge_fractions(&blocks[id.index()], self.a_edge),
                overlap: [self.overlap.on_first[1], self.overlap.on_first[0]],
            }),
        };
        let length =
            (b_end - b_start).norm() * (self.overlap.on_second[0] - self.overlap.on_second[1]);
        let slack = tolerance * geometry::size(&b.corners) / length;
        points::place(rule, a_side.as_ref(), &b_side, length, slack)
    }

    fn contact(
        &self,
        blocks: &[Block],
        place: &points::PointPlace,
        joint: JointId,
        filling: Option<Filling>,
        law: JointLaw,
        thickness: f64,
    ) -> ContactPoint {
        let on_a = |at| match self.a {
            Body::Block(block) => Some(Anchor { block, edge: self.a_edge, at }),
            Body::Support(_) => None,
        };
        let on_b = |at| Anchor { block: self.b, edge: self.b_edge, at };
        let [gap_to, gap_from] = self.overlap.gap;
        let weight = place.weight * thickness;
        let film = filling.map(|Filling { mortar, films }| FilmPoint {
            half: 0.5 * mortar.thickness,
            length: place.weight,
            a: on_a(place.span_on_a[0]).zip(on_a(place.span_on_a[1])).map(<[Anchor; 2]>::from),
            b: place.span_on_b.map(on_b),
            compliance: mortar.compliance(weight),
            stretch: (films == Films::Strips).then(|| mortar.stretch(place.weight, thickness)),
        });
        let half = self.overlap.normal * film.map_or(0.0, |film| film.half);
        ContactPoint {
            joint,
            position: self.on_b(blocks, place.on_b) - half,
            weight,
            a: on_a(place.on_a),
            b: on_b(place.on_b),
            gap: gap_from + (gap_to - gap_from) * place.along,
            slip: 0.0,
            law: law.at(weight),
            compliance: law.compliance(weight),
            film,
        }
    }
}

/// Places of the nodes of a block's edge; a rigid block has its corners only.
fn edge_fractions(block: &Block, edge: usize) -> Vec<f64> {
    block.mesh.as_ref().map_or_else(|| vec![0.0, 1.0], |mesh| mesh.edge_fractions(edge))
}
