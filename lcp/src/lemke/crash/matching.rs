//! A structural basis: a row for every pair, different for each, in which one of its columns has an
//! entry.

use lcp_linalg::Columns;

use crate::Side;

/// The side of the column by which every pair was matched to a row of its own, for the largest possible
/// number of pairs (a maximum bipartite matching by augmenting paths; Kuhn 1955, Duff 1981). `columns`
/// are those of the preferred sides, then the others. A preferred side is left only if that raises the
/// number of matched pairs.
pub(super) fn matched_sides(columns: &Columns, preferred: &[Side]) -> Vec<Option<Side>> {
    let n = preferred.len();
    let mut matching = Matching {
        columns,
        n,
        pair_of_row: vec![None; n],
        is_other: vec![None; n],
        seen: vec![usize::MAX; n],
    };
    let mut round = 0;
    for with_others in [false, true] {
        for pair in 0..n {
            if matching.is_other[pair].is_none() {
                matching.augment(pair, with_others, round);
                round += 1;
            }
        }
    }
    let sides = matching.is_other.iter().zip(preferred);
    sides
        .map(|(is_other, side)| is_other.map(|it| if it { side.complement() } else { *side }))
        .collect()
}

struct Matching<'a> {
    columns: &'a Columns,
    n: usize,
    pair_of_row: Vec<Option<usize>>,
    /// Whether a matched pair has the column of the other side.
    is_other: Vec<Option<bool>>,
    /// Round in which a row was last seen.
    seen: Vec<usize>,
}

/// A pair on an augmenting path: its entries up to `at` have been tried, the last one is `row`.
struct Visit {
    pair: usize,
    at: usize,
    row: usize,
    is_other: bool,
}

impl Matching<'_> {
    fn augment(&mut self, pair: usize, with_others: bool, round: usize) {
        let mut path = vec![Visit { pair, at: 0, row: 0, is_other: false }];
        while let Some(step) = path.last_mut() {
            let Some((row, is_other)) = self.next_row(step, with_others, round) else {
                path.pop();
                continue;
            };
            (step.row, step.is_other) = (row, is_other);
            self.seen[row] = round;
            if let Some(pair) = self.pair_of_row[row] {
                path.push(Visit { pair, at: 0, row: 0, is_other: false });
                continue;
            }
            for step in path {
                self.pair_of_row[step.row] = Some(step.pair);
                self.is_other[step.pair] = Some(step.is_other);
            }
            return;
        }
    }

    /// The next row not seen in this round in which a column of the pair has an entry.
    fn next_row(&self, step: &mut Visit, with_others: bool, round: usize) -> Option<(usize, bool)> {
        let own = self.columns.rows(step.pair);
        let others: &[u32] = if with_others { self.columns.rows(self.n + step.pair) } else { &[] };
        let mut entries = own.iter().chain(others).enumerate().skip(step.at);
        let (at, &row) = entries.find(|(_, row)| self.seen[**row as usize] != round)?;
        step.at = at + 1;
        Some((row as usize, at >= own.len()))
    }
}
