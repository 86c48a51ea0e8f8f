//! Which rows of a point matter to those that carry the loads.
//!
//! Where all terms of a row are zero at the solution, a point that comes near has nothing in it but errors, and
//! compared with these the row never holds. Whether it matters is told by its variables: by what they are of the
//! terms of the other rows in which they appear, and what these are worth. A row is as significant as the weakest link
//! of the best chain of such shares that leads from it to a row with a load. No unit enters.

use crate::matrix::Column;

/// Shares down to two to minus this are as good as one.
const SLACK: f64 = 5.0;
/// Shares of two to minus this are rounding errors.
const ROUNDING: f64 = 50.0;
/// Shares are told apart by factors of two, down to this power.
const LEVELS: usize = 1000;

/// A term of a row at a point.
pub(super) struct Term {
    pub(super) row: usize,
    pub(super) variable: usize,
    pub(super) value: f64,
}

/// Adds the terms of a variable with its column.
pub(super) fn add_terms(terms: &mut Vec<Term>, (variable, x): (usize, f64), column: Column<'_>) {
    column.for_each(|row, v| {
        if v * x != 0.0 {
            terms.push(Term { row, variable, value: v * x });
        }
    });
}

/// For every row a factor between zero and one. `loads` are the right-hand sides, and `felt` is one over the loads
/// that a row feels, zero where there are none.
pub(super) fn significance(terms: &[f64], loads: &[f64], felt: &[f64], all: &[Term]) -> Vec<f64> {
    let rows = terms.len();
    let variables = all.iter().map(|term| term.variable + 1).max().unwrap_or(0);
    let links = Links::new(
        rows + variables,
        all.iter().map(|term| {
            (term.row, rows + term.variable, level(term.value.abs() / terms[term.row]))
        }),
    );
    let mut reached = vec![LEVELS; rows + variables];
    let loaded = (0..rows).filter(|i| loads[*i] > 0.0);
    links.spread(loaded.map(|i| (0, i)).collect(), &mut reached);
    // What no load reaches is measured by the loads around it, if there are any.
    let apart = (0..rows).filter(|i| reached[*i] == LEVELS);
    let size = |i: usize| if felt[i] > 0.0 { level(terms[i] * felt[i]) } else { 0 };
    links.spread(apart.map(|i| (size(i), i)).collect(), &mut reached);
    reached[..rows].iter().map(|level| factor(*level)).collect()
}

/// How many factors of two a share is below what is as good as one. Shares of the size of rounding errors are worth
/// no more than they are.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 1000")]
fn level(share: f64) -> usize {
    let bits = -share.log2();
    let slack = SLACK * (0.5 * (ROUNDING - bits) / SLACK).clamp(0.0, 1.0);
    (bits - slack).ceil().clamp(0.0, LEVELS as f64 - 1.0) as usize
}

fn factor(level: usize) -> f64 {
    i32::try_from(level).map_or(0.0, |level| 2_f64.powi(-level))
}

/// Links between rows and variables, each with the level of its share.
struct Links {
    starts: Vec<usize>,
    ends: Vec<(usize, usize)>,
}

impl Links {
    fn new(nodes: usize, links: impl Iterator<Item = (usize, usize, usize)> + Clone) -> Self {
        let mut starts = vec![0; nodes + 1];
        for (a, b, _) in links.clone() {
            starts[a + 1] += 1;
            starts[b + 1] += 1;
        }
        for i in 0..nodes {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut ends = vec![(0, 0); starts[nodes]];
        for (a, b, level) in links {
            for (from, to) in [(a, b), (b, a)] {
                ends[next[from]] = (to, level);
                next[from] += 1;
            }
        }
        Self { starts, ends }
    }

    /// Lowers the levels to those of the best chains from the sources: at every link the larger of its level and
    /// that of the node before.
    fn spread(&self, sources: Vec<(usize, usize)>, reached: &mut [usize]) {
        let mut waiting: Vec<Vec<usize>> = vec![Vec::new(); LEVELS];
        for (level, node) in sources {
            if level < reached[node] {
                reached[node] = level;
                waiting[level].push(node);
            }
        }
        for level in 0..LEVELS {
            while let Some(node) = waiting[level].pop() {
                if reached[node] < level {
                    continue;
                }
                for &(to, of_link) in &self.ends[self.starts[node]..self.starts[node + 1]] {
                    let by = level.max(of_link);
                    if by < reached[to] {
                        reached[to] = by;
                        waiting[by].push(to);
                    }
                }
            }
        }
    }
}
