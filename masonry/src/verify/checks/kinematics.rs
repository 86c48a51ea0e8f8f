//! How displacements of blocks enter the gap, the slip and the elongation at a contact point.

use nalgebra::Vector2;

use crate::data::state::State;
use crate::model::mesh::BlockMesh;
use crate::model::{Anchor, Block, ContactPoint, Model};

/// How the displacement of a place enters gap and slip of a contact point, and so how its forces act there.
pub(super) struct Term {
    pub(super) anchor: Anchor,
    pub(super) normal: Vector2<f64>,
    pub(super) tangent: Vector2<f64>,
}

/// All places that move a contact point.
pub(super) fn terms(model: &Model, contact: &ContactPoint) -> Vec<Term> {
    let joint = &model.joints[contact.joint.index()];
    let (n, t) = (joint.normal, joint.tangent());
    let mut list = vec![Term { anchor: contact.b, normal: n, tangent: t }];
    list.extend(contact.a.map(|anchor| Term { anchor, normal: -n, tangent: -t }));
    if let Some(film) = &contact.film {
        // The rotation of both faces shears a film, too.
        let turn = n * (film.half / film.length);
        for [start, end] in film.faces().into_iter().flatten() {
            let none = Vector2::zeros();
            list.push(Term { anchor: end, normal: none, tangent: turn });
            list.push(Term { anchor: start, normal: none, tangent: -turn });
        }
        let opened = film.gap_per_elongation();
        list.extend(stretched(model, contact).into_iter().map(|(anchor, along)| Term {
            anchor,
            normal: along * opened,
            tangent: Vector2::zeros(),
        }));
    }
    list
}

/// How displacements of the ends of a part of a film enter its elongation, the mean of both faces.
pub(super) fn stretched(model: &Model, contact: &ContactPoint) -> Vec<(Anchor, Vector2<f64>)> {
    let Some(film) = contact.film.filter(|film| film.stretch.is_some()) else { return Vec::new() };
    let half = model.joints[contact.joint.index()].tangent() * 0.5;
    let is_elastic = |face: &[Anchor; 2]| model.blocks[face[0].block.index()].elasticity.is_some();
    let faces = film.faces().into_iter().flatten().filter(is_elastic);
    faces.flat_map(|[start, end]| [(start, -half), (end, half)]).collect()
}

/// The displacement of a place on an edge.
pub(super) fn displaced(model: &Model, state: &State, anchor: Anchor) -> Vector2<f64> {
    let block = anchor.block.index();
    let shares = shares(&model.blocks[block], anchor);
    shares.iter().map(|(node, part)| state.displacements[block][*node] * *part).sum()
}

/// The displacement of a place on an edge as a sum over nodes.
pub(super) fn shares(block: &Block, Anchor { edge, at, .. }: Anchor) -> [(usize, f64); 2] {
    let on_mesh = |mesh: &BlockMesh| mesh.interpolate(edge, at);
    let next = (edge + 1) % block.corners.len();
    block.mesh.as_ref().map_or([(edge, 1.0 - at), (next, at)], on_mesh)
}
