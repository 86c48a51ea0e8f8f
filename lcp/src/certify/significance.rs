//! Which rows of a point matter to those that carry the loads.
//!
//! Where all terms of a row are zero at the solution, a point that comes near has nothing in it but errors, and
//! compared with these the row never holds. Whether it matters is told by what would change if its variables were
//! set to zero, which makes it hold: the share that they are of the largest term of other rows, times what these are
//! worth. A row with a load is worth one, and any other the largest product of such shares along a chain from it to a
//! row with a load. No unit enters.

use std::collections::VecDeque;

use super::constants::{IN_FULL, SPEAKS};
use crate::matrix::Column;

/// A term of a row at a point.
pub(super) struct Term {
    pub(super) row: usize,
    pub(super) variable: usize,
    pub(super) value: f64,
}

/// The terms of a point.
pub(super) trait Terms {
    /// Shows all that are not zero, always in the same order.
    fn for_each_term(&self, visit: impl FnMut(Term));
}

/// The terms of a variable with its column.
pub(super) fn terms_of(visit: &mut impl FnMut(Term), variable: usize, x: f64, column: Column<'_>) {
    if x != 0.0 {
        column.for_each(|row, v| {
            if v * x != 0.0 {
                visit(Term { row, variable, value: v * x });
            }
        });
    }
}

/// For every row a factor between zero and one. `sources` are what rows count by their right-hand sides, and `felt`
/// is one over the loads that a row feels, zero where there are none.
pub(super) fn significance(
    terms: &[f64],
    sources: &[f64],
    felt: &[f64],
    all: &impl Terms,
) -> Vec<f64> {
    let rows = terms.len();
    let (links, mut worth) = Links::new(sources, all);
    let loaded: Vec<_> =
        (0..worth.len()).filter(|i| worth[*i] > 0.0).map(|i| (i, worth[i])).collect();
    links.spread(&loaded, &mut worth);
    // What no load reaches is measured by the loads around it, if there are any.
    let apart = (0..rows).filter(|i| worth[*i] == 0.0 && terms[*i] > 0.0);
    let size = |i: usize| if felt[i] > 0.0 { (terms[i] * felt[i]).min(1.0) } else { 1.0 };
    let apart: Vec<_> = apart.map(|i| (i, size(i))).collect();
    links.spread(&apart, &mut worth);
    worth.truncate(rows);
    worth.into_iter().map(|worth| (worth / IN_FULL).min(1.0)).collect()
}

/// Links between rows and, numbered behind them, variables, each with the share that the end makes of what the
/// beginning is worth. Rows that are worth one from the beginning, most in a structure with weight, have none.
struct Links {
    starts: Vec<usize>,
    ends: Vec<u32>,
    shares: Vec<f64>,
}

impl Links {
    /// With what rows and variables are worth by the sources, and by rows that are worth one.
    fn new(sources: &[f64], all: &impl Terms) -> (Self, Vec<f64>) {
        let rows = sources.len();
        let is_full = |row: usize| sources[row] >= 1.0;
        let mut largest = vec![0.0_f64; rows];
        let mut starts = vec![0; rows + 1];
        all.for_each_term(|Term { row, variable, value }| {
            largest[row] = largest[row].max(value.abs());
            let last = rows + variable + 1;
            if last >= starts.len() {
                starts.resize(last + 1, 0);
            }
            if !is_full(row) {
                starts[row + 1] += 1;
                starts[last] += 1;
            }
        });
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut worth = sources.to_vec();
        worth.resize(starts.len() - 1, 0.0);
        let mut next = starts.clone();
        let count = starts.last().copied().unwrap_or(0);
        let (mut ends, mut shares) = (vec![0; count], vec![0.0; count]);
        all.for_each_term(|Term { row, variable, value }| {
            let (variable, share) = (rows + variable, value.abs() / largest[row]);
            if is_full(row) {
                worth[variable] = share.max(worth[variable]);
                return;
            }
            for (from, to, share) in
                [(row, variable, share), (variable, row, (share / SPEAKS).min(1.0))]
            {
                (ends[next[from]], shares[next[from]]) = (index(to), share);
                next[from] += 1;
            }
        });
        (Self { starts, ends, shares }, worth)
    }

    /// Raises what rows and variables are worth to the largest products of shares along chains from the sources: octave
    /// by octave of values, as no share is above one (Dial 1969), and first come, first served within one.
    fn spread(&self, sources: &[(usize, f64)], worth: &mut [f64]) {
        for &(node, value) in sources {
            worth[node] = value;
        }
        // Only what the sources raise is waited for: most rows are sources.
        let mut is_raised = vec![false; worth.len()];
        for (node, _) in sources {
            self.raise(*node, worth, &mut |to, _| is_raised[to] = true);
        }
        let mut waiting: [VecDeque<(f64, usize)>; OCTAVES] =
            std::array::from_fn(|_| VecDeque::new());
        for (node, value) in worth.iter().enumerate().filter(|(node, _)| is_raised[*node]) {
            waiting[octave(*value)].push_back((*value, node));
        }
        for at in 0..OCTAVES {
            while let Some((value, node)) = waiting[at].pop_front() {
                if value >= worth[node] {
                    self.raise(node, worth, &mut |to, by| waiting[octave(by)].push_back((by, to)));
                }
            }
        }
    }

    /// Raises the neighbours of a node.
    fn raise(&self, node: usize, worth: &mut [f64], raised: &mut impl FnMut(usize, f64)) {
        let value = worth[node];
        let range = self.starts[node]..self.starts[node + 1];
        for (to, share) in self.ends[range.clone()].iter().zip(&self.shares[range]) {
            let (to, by) = (*to as usize, value * share);
            if by > worth[to] {
                worth[to] = by;
                raised(to, by);
            }
        }
    }
}

fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or_else(|_| unreachable!("2^32 rows do not fit in memory"))
}

/// Octaves of values that are told apart; the last has all that is smaller.
const OCTAVES: usize = 64;

/// Of a value up to one, from one downwards.
fn octave(value: f64) -> usize {
    const ONE: u64 = 1023;
    let below = ONE.saturating_sub(value.to_bits() >> 52);
    usize::try_from(below).map_or(OCTAVES - 1, |below| below.min(OCTAVES - 1))
}
