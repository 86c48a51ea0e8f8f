//! Which rows of a point matter to those that carry the loads.
//!
//! Where all terms of a row are zero at the solution, a point that comes near has nothing in it but errors, and
//! compared with these the row never holds. Whether it matters is told by what would change if its variables were
//! set to zero, which makes it hold: the share that they are of the largest term of other rows, times what these are
//! worth. A row with a load is worth one, and any other the largest product of such shares along a chain from it to a
//! row with a load. No unit enters.

use crate::matrix::Column;

/// A row that is worth this counts in full: chains are not the only way to the loads.
const IN_FULL: f64 = 1.0 / 32.0;
/// Every variable with more than this of the largest term of a row speaks for the row.
const SPEAKS: f64 = 1.0 / 1024.0;
/// Factors are told apart by eighths of powers of two, down to two to minus a thousand.
const PER_POWER: f64 = 8.0;
const LEVELS: usize = 8000;

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
    let mut largest = vec![0.0_f64; rows];
    for term in all {
        largest[term.row] = largest[term.row].max(term.value.abs());
    }
    let links = Links::new(
        rows + variables,
        all.iter().map(|term| {
            let share = term.value.abs() / largest[term.row];
            (term.row, rows + term.variable, [level(share), level(share / SPEAKS)])
        }),
    );
    let mut reached = vec![LEVELS; rows + variables];
    let loaded = (0..rows).filter(|i| loads[*i] != 0.0);
    links.spread(loaded.map(|i| (0, i)).collect(), &mut reached);
    // What no load reaches is measured by the loads around it, if there are any.
    let apart = (0..rows).filter(|i| reached[*i] == LEVELS);
    let size = |i: usize| if felt[i] > 0.0 { level(terms[i] * felt[i]) } else { 0 };
    links.spread(apart.map(|i| (size(i), i)).collect(), &mut reached);
    reached[..rows].iter().map(|level| factor(*level)).collect()
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 8000")]
fn level(share: f64) -> usize {
    (-share.log2() * PER_POWER).round().clamp(0.0, LEVELS as f64 - 1.0) as usize
}

fn factor(level: usize) -> f64 {
    ((level as f64 / -PER_POWER).exp2() / IN_FULL).min(1.0)
}

/// Links between rows and variables, each with the levels from the row to the variable and back.
struct Links {
    starts: Vec<usize>,
    ends: Vec<(usize, usize)>,
}

impl Links {
    fn new(nodes: usize, links: impl Iterator<Item = (usize, usize, [usize; 2])> + Clone) -> Self {
        let mut starts = vec![0; nodes + 1];
        for (row, variable, _) in links.clone() {
            starts[row + 1] += 1;
            starts[variable + 1] += 1;
        }
        for i in 0..nodes {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut ends = vec![(0, 0); starts[nodes]];
        for (row, variable, [there, back]) in links {
            for (from, to, level) in [(row, variable, there), (variable, row, back)] {
                ends[next[from]] = (to, level);
                next[from] += 1;
            }
        }
        Self { starts, ends }
    }

    /// Lowers the levels to those of the best chains from the sources: sums of the levels of their links.
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
                    let by = level + of_link;
                    if by < reached[to] {
                        reached[to] = by;
                        waiting[by].push(to);
                    }
                }
            }
        }
    }
}
