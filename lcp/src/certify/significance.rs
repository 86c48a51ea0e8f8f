//! The rows of a point that matter to those that carry the loads.
//!
//! If all terms of a row are zero at the solution, a near point has only errors in that row, and the row never holds
//! compared with its terms. The row would hold with its variables set to zero. A row matters by the shares of its
//! variables in the largest terms of other rows, times the weights of those rows. A row with a load has the weight one,
//! and any other the largest product of such shares along a chain from it to a row with a load. The weights do not
//! depend on units.

use std::collections::BinaryHeap;

use lcp_linalg::Columns;

use crate::vector::WEAK;

/// The size of a coefficient times the value of its variable at a point, above zero.
pub(super) struct Term {
    pub row: usize,
    pub variable: usize,
    pub size: f64,
}

/// The factor of every row, between zero and one. `sources` are the weights of rows by their right-hand sides. `burden`
/// is the size of the terms of a row relative to the loads that act on it, at most one, and zero for a row without
/// terms.
pub(super) fn significance(
    terms: &[Term],
    variables: usize,
    sources: &[f64],
    burden: impl Fn(usize) -> f64,
) -> Vec<f64> {
    let rows = sources.len();
    let mut largest = vec![0.0_f64; rows];
    for term in terms {
        largest[term.row] = largest[term.row].max(term.size);
    }
    // Rows and, numbered behind them, variables. Rows with the weight one, most rows in a structure with weight, have
    // no links.
    let mut worth = sources.to_vec();
    worth.resize(rows + variables, 0.0);
    let mut links = Vec::new();
    for &Term { row, variable, size } in terms {
        let (variable, share) = (rows + variable, size / largest[row]);
        if sources[row] >= 1.0 {
            worth[variable] = share.max(worth[variable]);
        } else {
            // Every variable that is not weak passes its weight to its row.
            links.extend([(row, variable, share), (variable, row, (share / WEAK).min(1.0))]);
        }
    }
    let links = Columns::by_rows(worth.len(), links.iter().copied());
    spread(&links, &mut worth);
    // Rows that no load reaches are measured by the loads around them, if any.
    for (i, worth) in worth[..rows].iter_mut().enumerate().filter(|(_, worth)| **worth == 0.0) {
        *worth = burden(i);
    }
    spread(&links, &mut worth);
    worth.truncate(rows);
    // Loads are reached on other ways than chains, too: a row with a weight far above weak counts in full.
    worth.into_iter().map(|worth| (worth / WEAK.sqrt()).min(1.0)).collect()
}

/// Raises each value to the largest product of another value and the shares on the links of a chain from that value;
/// shares are at most one (Dijkstra 1959).
pub(super) fn spread(links: &Columns, values: &mut [f64]) {
    // Positive numbers are in the order of their bits.
    let begun = values.iter().enumerate().filter(|(_, value)| **value > 0.0);
    let mut waiting: BinaryHeap<_> = begun.map(|(node, value)| (value.to_bits(), node)).collect();
    while let Some((bits, node)) = waiting.pop() {
        let value = f64::from_bits(bits);
        if value < values[node] {
            continue;
        }
        for (to, share) in links.entries(node) {
            let by = value * share;
            if by > values[to] {
                values[to] = by;
                waiting.push((by.to_bits(), to));
            }
        }
    }
}
