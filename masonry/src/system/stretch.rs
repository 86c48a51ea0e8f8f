//! Elongations of the strips of mortar that touch elastic blocks.

use super::body::{BodyStretch, BodySystem, entries};
use super::kinematics::stretched;
use crate::ids::ContactId;
use crate::model::Model;

/// The bar that stands for one part of a mortar strip along its joint: a spring that always acts between the blocks of
/// the joint.
///
/// The elongation is `e = L u`, the change of distance between the two ends of the part along the joint, as a mean
/// over both faces. The force on the ends is `q = -k e`. No rigid motion of a block stretches the bar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StretchRow {
    /// The contact point of the part of the strip.
    pub contact: ContactId,
    /// Stiffness `k` of the bar \[N/m\].
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

/// Returns one entry for every degree of freedom, the sum of all its entries. Both ends of a short part depend on the
/// same nodes, and the sum of their entries is small: with separate entries, products with the large stiffness of the
/// bar would cancel, and the sum would be lost among their rounding errors.
fn summed(mut entries: Vec<(usize, f64)>) -> Vec<(usize, f64)> {
    entries.sort_by_key(|(dof, _)| *dof);
    let same = entries.chunk_by(|(a, _), (b, _)| a == b);
    same.map(|list| (list[0].0, list.iter().map(|(_, v)| v).sum())).collect()
}
