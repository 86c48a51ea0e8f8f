//! Elongations of the strips of mortar that touch elastic blocks.

use crate::ids::ContactId;
use crate::model::{Anchor, Model};

use super::body::{BodyStretch, BodySystem, entries};

/// The bar in one part of a strip of mortar: a spring between the blocks of its joint that always acts.
///
/// Its elongation is `e = L u`, the mean over both faces of the change of distance of the part's two ends along the
/// joint, and its force `q = -k e` on them. No rigid motion of a block stretches it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StretchRow {
    /// The contact point that stands for the part.
    pub contact: ContactId,
    /// `k` \[N/m\].
    pub stiffness: f64,
}

/// The rows of all strips between blocks of which at least one is elastic, given also to these blocks.
pub(super) fn add_rows(model: &Model, bodies: &mut [BodySystem]) -> Vec<StretchRow> {
    let mut rows = Vec::new();
    for (k, contact) in model.contacts.iter().enumerate() {
        let Some((film, stretch)) = contact.film.and_then(|film| Some((film, film.stretch?)))
        else {
            continue;
        };
        let tangent = model.joints[contact.joint.index()].tangent();
        let is_elastic = |face: &[Anchor; 2]| bodies[face[0].block.index()].stiffness.is_some();
        let elastic: Vec<_> = film.faces().into_iter().flatten().filter(is_elastic).collect();
        if elastic.is_empty() {
            continue;
        }
        for [start, end] in elastic {
            let id = start.block.index();
            let Some(mesh) = &model.blocks[id].mesh else { continue };
            let mut entries = entries(mesh, end, tangent * 0.5);
            entries.extend(self::entries(mesh, start, tangent * -0.5));
            bodies[id].stretches.push(BodyStretch { row: rows.len(), entries: summed(entries) });
        }
        rows.push(StretchRow { contact: ContactId::new(k), stiffness: stretch.stiffness });
    }
    rows
}

/// One entry for every degree of freedom. Both ends of a short part hang on the same nodes, and what remains of their
/// entries is small: left apart, the stiff bar would lose it among products that cancel.
fn summed(mut entries: Vec<(usize, f64)>) -> Vec<(usize, f64)> {
    entries.sort_by_key(|(dof, _)| *dof);
    let same = entries.chunk_by(|(a, _), (b, _)| a == b);
    same.map(|list| (list[0].0, list.iter().map(|(_, v)| v).sum())).collect()
}
