//! Elongations of the strips of mortar that touch elastic blocks.

use super::body::{BodyStretch, BodySystem, entries};
use super::kinematics::stretched;
use crate::ids::ContactId;
use crate::model::Model;

/// The bar in one part of a strip of mortar: a spring between the blocks of its joint that always acts.
///
/// The elongation is `e = L u`, the mean over both faces of the change of distance of the part's two ends along the
/// joint, and the force on them `q = -k e`. No rigid motion of a block stretches the bar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StretchRow {
    /// The contact point that stands for the part.
    pub contact: ContactId,
    /// `k` \[N/m\].
    pub stiffness: f64,
}

/// Builds the rows of all strips that touch an elastic block, and adds them to these blocks.
pub(super) fn add_rows(model: &Model, bodies: &mut [BodySystem]) -> Vec<StretchRow> {
    let mut rows = Vec::new();
    for (k, contact) in model.contacts.iter().enumerate() {
        let Some(stretch) = contact.film.and_then(|film| film.stretch) else { continue };
        let terms = stretched(model, contact);
        if terms.is_empty() {
            continue;
        }
        // Both ends of a face lie on one block.
        for face in terms.chunks_exact(2) {
            let id = face[0].0.block.index();
            let Some(mesh) = &model.blocks[id].mesh else { continue };
            let entries = face.iter().flat_map(|(anchor, along)| entries(mesh, *anchor, *along));
            let entries = summed(entries.collect());
            bodies[id].stretches.push(BodyStretch { row: rows.len(), entries });
        }
        rows.push(StretchRow { contact: ContactId::new(k), stiffness: stretch.stiffness });
    }
    rows
}

/// One entry for every degree of freedom. Both ends of a short part depend on the same nodes, and the sum of their
/// entries is small: the product with the stiff bar would lose it among products that cancel if the entries stayed
/// apart.
fn summed(mut entries: Vec<(usize, f64)>) -> Vec<(usize, f64)> {
    entries.sort_by_key(|(dof, _)| *dof);
    let same = entries.chunk_by(|(a, _), (b, _)| a == b);
    same.map(|list| (list[0].0, list.iter().map(|(_, v)| v).sum())).collect()
}
