//! The ratio test, which determines the leaving variable.

use super::constants::{TIE_WINDOW, VANISHING};
use super::path::Path;
use crate::vector::{HALF_DIGITS, SMALL, max_abs};

impl Path<'_> {
    /// The row that leaves, or `None` if nothing blocks the entering variable. There are two passes: the longest step
    /// that brings no variable below zero by more than the window, then among the rows that block within this step
    /// those with sound pivots.
    pub(super) fn leaving_row(&self, column: &[f64]) -> Option<usize> {
        let smallest_pivot = (VANISHING * max_abs(column)).max(SMALL);
        let blocks = |&i: &usize| column[i] > smallest_pivot && self.is_bounded(i);
        let value = |i: usize| self.values[i].max(0.0);

        let shortest =
            (0..column.len()).filter(blocks).map(|i| value(i) / column[i]).reduce(f64::min)?;
        if let Some(row) = self.artificial_row().filter(|_| !self.is_parametric) {
            let after = self.values[row] - shortest * column[row];
            if column[row] > SMALL && after <= VANISHING * self.artificial_start {
                return Some(row);
            }
        }
        let window = TIE_WINDOW * self.scale;
        let tied: Vec<usize> = (0..column.len())
            .filter(blocks)
            .filter(|&i| value(i) - shortest * column[i] <= window)
            .collect();
        // An exchange must not cost more than a quarter of all digits.
        let best = tied.iter().fold(0.0_f64, |max, &i| max.max(column[i]));
        let least = HALF_DIGITS.sqrt() * best;
        let sound: Vec<usize> = tied.into_iter().filter(|&i| column[i] >= least).collect();
        if let [only] = sound[..] {
            return Some(only);
        }
        match self.kernel.parting() {
            Some(parting) => first_parted(&parting, column, &sound),
            None => Some(self.lexicographic_minimum(column, &sound)),
        }
    }

    /// The tied row whose row of the inverse basis, divided by its pivot, comes first in lexicographic order. No basis
    /// recurs along a path of such choices in exact arithmetic.
    fn lexicographic_minimum(&self, column: &[f64], tied: &[usize]) -> usize {
        // Rows are computed when they are first needed.
        let mut left: Vec<(usize, Option<Vec<f64>>)> = tied.iter().map(|&i| (i, None)).collect();
        for k in 0..column.len() {
            if left.len() == 1 {
                break;
            }
            // The column of the inverse is a unit column if `w_k` is basic: the entry of that row is positive, and not
            // the least among zeros.
            if let Some(at) = self.row_of[k] {
                left.retain(|(i, _)| *i != at);
                continue;
            }
            let key = |(i, row): &mut (usize, Option<Vec<f64>>)| {
                let row = row.get_or_insert_with(|| self.kernel.row(*i));
                self.kernel.entry(*i, row, k) / column[*i]
            };
            let keys: Vec<f64> = left.iter_mut().map(key).collect();
            let least = keys.iter().copied().fold(f64::INFINITY, f64::min);
            // Entries of an equilibrated tableau are of order one: keys that are all rounding errors of zero must not
            // be measured against each other.
            let smallest_pivot = left.iter().fold(f64::INFINITY, |min, (i, _)| min.min(column[*i]));
            let scale = keys.iter().fold(1.0 / smallest_pivot, |max, key| max.max(key.abs()));
            let mut is_least = keys.iter().map(|key| key - least <= TIE_WINDOW * scale);
            left.retain(|_| is_least.next() == Some(true));
        }
        left.first().map_or(tied[0], |(i, _)| *i)
    }
}

/// The tied row that would come first after a small change of the right-hand side, constant along the path; the change
/// separates all ties in exact arithmetic, except by chance.
fn first_parted(parting: &[f64], column: &[f64], tied: &[usize]) -> Option<usize> {
    let key = |&i: &usize| parting[i] / column[i];
    let least = tied.iter().map(key).fold(f64::INFINITY, f64::min);
    let scale = tied.iter().map(key).fold(0.0_f64, |max, key| max.max(key.abs()));
    let is_first = |i: &&usize| key(i) - least <= TIE_WINDOW * scale;
    let first = tied.iter().filter(is_first);
    first.max_by(|&&i, &&j| column[i].total_cmp(&column[j])).copied()
}
