//! The parts of the blocks' displacements in the gap, the slip and the elongation at a contact point, and so the
//! actions of the forces there on the blocks.

use nalgebra::Vector2;

use crate::model::{Anchor, JointPoint, Model, PlacedBlock};

/// The part of a place in the gap and in the slip of a contact point.
pub(crate) struct Term {
    pub(crate) anchor: Anchor,
    pub(crate) normal: Vector2<f64>,
    pub(crate) tangent: Vector2<f64>,
}

/// The terms of all places that move a contact point.
pub(crate) fn terms(model: &Model, contact: &JointPoint) -> Vec<Term> {
    let joint = &model.joints[contact.joint.index()];
    let (n, t) = (joint.normal, joint.tangent());
    let mut list = vec![Term { anchor: contact.b, normal: n, tangent: t }];
    list.extend(contact.a.map(|anchor| Term { anchor, normal: -n, tangent: -t }));
    if let Some(film) = &contact.film {
        let none = Vector2::zeros();
        // The rotation of both faces also shears a film.
        let turn = n * (film.half / film.length);
        for [start, end] in film.faces().into_iter().flatten() {
            list.push(Term { anchor: end, normal: none, tangent: turn });
            list.push(Term { anchor: start, normal: none, tangent: -turn });
        }
        let opened = film.gap_per_elongation();
        let stretched = stretched(model, contact).into_iter();
        list.extend(stretched.map(|(anchor, along)| Term {
            anchor,
            normal: along * opened,
            tangent: none,
        }));
    }
    list
}

/// The parts of the ends of a part of a strip in its elongation, the mean of both faces; faces on supports and rigid
/// blocks do not stretch. Empty in a dry joint.
pub(crate) fn stretched(model: &Model, contact: &JointPoint) -> Vec<(Anchor, Vector2<f64>)> {
    let Some(film) = contact.film.filter(|film| film.stretch.is_some()) else { return Vec::new() };
    let half = model.joints[contact.joint.index()].tangent() * 0.5;
    let is_elastic = |face: &[Anchor; 2]| model.blocks[face[0].block.index()].elasticity.is_some();
    let faces = film.faces().into_iter().flatten().filter(is_elastic);
    faces.flat_map(|[start, end]| [(end, half), (start, -half)]).collect()
}

/// The displacement of a place on an edge as a sum over nodes, or over the corners of a rigid block.
pub(crate) fn shares(block: &PlacedBlock, Anchor { edge, at, .. }: Anchor) -> [(usize, f64); 2] {
    match (&block.mesh, block.elasticity) {
        (Some(mesh), Some(_)) => mesh.interpolate(edge, at),
        _ => [(edge, 1.0 - at), ((edge + 1) % block.corners.len(), at)],
    }
}
