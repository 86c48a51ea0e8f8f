//! Elimination forests of the matrices of free sets.

use crate::Matrix;

pub(super) const NONE: usize = usize::MAX;

/// An order of the free pairs with the same fill as the given one, in which the columns of one
/// supernode are neighbours: a postorder of the elimination forest. `place` has in the end the place of
/// every free pair in it, and [`NONE`] for the others.
///
/// A part of an order that is a postorder for the whole matrix is not one for the part.
pub(super) fn postordered(
    m: &Matrix,
    order: impl Iterator<Item = usize>,
    place: &mut [usize],
) -> Vec<usize> {
    place.fill(NONE);
    let order: Vec<usize> = order.collect();
    order.iter().enumerate().for_each(|(k, &j)| place[j] = k);
    let parents = parents(m, &order, place);
    let order: Vec<usize> = postorder(&parents).into_iter().map(|k| order[k]).collect();
    order.iter().enumerate().for_each(|(k, &j)| place[j] = k);
    order
}

/// The parent of every place, or [`NONE`] for a root (Liu 1990).
fn parents(m: &Matrix, order: &[usize], place: &[usize]) -> Vec<usize> {
    let mut parents = vec![NONE; order.len()];
    let mut ancestors = vec![NONE; order.len()];
    for (k, &j) in order.iter().enumerate() {
        m.slice(j).for_each(|i, _| {
            let mut at = place[i];
            // Also false for pairs that are not free.
            while at < k {
                let next = std::mem::replace(&mut ancestors[at], k);
                if next == NONE {
                    parents[at] = k;
                }
                at = next;
            }
        });
    }
    parents
}

fn postorder(parents: &[usize]) -> Vec<usize> {
    let n = parents.len();
    let (mut first_child, mut sibling) = (vec![NONE; n], vec![NONE; n]);
    let mut first_root = NONE;
    for k in (0..n).rev() {
        let head = match parents[k] {
            NONE => &mut first_root,
            parent => &mut first_child[parent],
        };
        sibling[k] = std::mem::replace(head, k);
    }
    let mut order = Vec::with_capacity(n);
    let mut path = Vec::new();
    let mut at = first_root;
    loop {
        while at != NONE {
            path.push(at);
            at = first_child[at];
        }
        let Some(done) = path.pop() else { return order };
        order.push(done);
        at = sibling[done];
    }
}
