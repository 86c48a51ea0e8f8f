//! Coefficients by which the displacements of blocks enter the gap, the slip and the elongation at a contact point.
//! The forces of the point act on the blocks with the same coefficients.

use nalgebra::Vector2;

use crate::model::{Anchor, JointPoint, Model, PlacedBlock};

/// A place on a block, and the coefficients of its displacement in the gap (`normal`) and in the slip (`tangent`) of a
/// contact point.
pub(crate) struct Term {
    pub(crate) anchor: Anchor,
    pub(crate) normal: Vector2<f64>,
    pub(crate) tangent: Vector2<f64>,
}

/// Returns the terms of all places whose displacements contribute to the gap and the slip of a contact point.
pub(crate) fn terms(model: &Model, contact: &JointPoint) -> Vec<Term> {
    let joint = &model.joints[contact.joint.index()];
    let (n, t) = (joint.normal, joint.tangent());
    let mut list = vec![Term { anchor: contact.b, normal: n, tangent: t }];
    list.extend(contact.a.map(|anchor| Term { anchor, normal: -n, tangent: -t }));
    if let Some(film) = &contact.film {
        let none = Vector2::zeros();
        // The rotations of both faces shear the film, in addition to their relative displacement.
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

/// Returns the places at the ends of a part of a strip, each with the coefficients of its displacement in the
/// elongation, which is the mean over both faces. Faces on supports and rigid blocks do not stretch. Empty in a dry
/// joint.
pub(crate) fn stretched(model: &Model, contact: &JointPoint) -> Vec<(Anchor, Vector2<f64>)> {
    let Some(film) = contact.film.filter(|film| film.stretch.is_some()) else { return Vec::new() };
    let half = model.joints[contact.joint.index()].tangent() * 0.5;
    let is_elastic = |face: &[Anchor; 2]| model.blocks[face[0].block.index()].elasticity.is_some();
    let faces = film.faces().into_iter().flatten().filter(is_elastic);
    faces.flat_map(|[start, end]| [(end, half), (start, -half)]).collect()
}

/// Returns the two nodes, or corners of a rigid block, whose displacements give that of a place on an edge, each with
/// its coefficient.
pub(crate) fn shares(block: &PlacedBlock, Anchor { edge, at, .. }: Anchor) -> [(usize, f64); 2] {
    match (&block.mesh, block.elasticity) {
        (Some(mesh), Some(_)) => mesh.interpolate(edge, at),
        _ => [(edge, 1.0 - at), ((edge + 1) % block.corners.len(), at)],
    }
}
