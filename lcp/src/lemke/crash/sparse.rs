//! Start bases of sparse problems.
//!
//! Columns are offered to a factorisation that refuses those that depend on the ones before: first
//! those of the preferred sides, then the others of the pairs that have none yet. Where pairs stay
//! without a column the sides of a structural matching are tried in the same way.

use web_time::Instant;

use super::found::Crash;
use super::matching::matched_sides;
use crate::lemke::constants::{ENLARGED, GAIN, RANK_TOLERANCE, SOLVES};
use crate::lemke::kernel::Var;
use crate::lemke::start::Equilibrated;
use crate::solve::is_over;
use crate::sparse::{Columns, Growing, elimination_order, row_counts};
use crate::{Basis, Matrix, Side};

/// A complementary basis, or as many columns as were found, completed by unit columns.
pub(super) fn find_sparse(
    problem: &Equilibrated<'_>,
    preferred: &Basis,
    deadline: Option<Instant>,
) -> Crash {
    let n = problem.order();
    let all_t = Basis::all(Side::T, n);
    let mut best: Option<Chosen> = None;
    for sides in [Some(preferred.sides()), Some(all_t.sides()), None] {
        if is_over(deadline) {
            return Crash::Late;
        }
        let search = Search::new(problem, sides.unwrap_or(preferred.sides()));
        let first = if sides.is_none() {
            matched_sides(&search.columns, search.preferred)
        } else {
            search.preferred.iter().copied().map(Some).collect()
        };
        let found = search.independent(&first);
        let is_complete = found.missing.is_empty();
        if best.as_ref().is_none_or(|best| found.missing.len() < best.missing.len()) {
            best = Some(found);
        }
        if is_complete {
            break;
        }
    }
    match best.map_or(Crash::Late, |best| best.into_crash(n)) {
        Crash::Complete(basis) if n <= ENLARGED => {
            Crash::Complete(enlarged(problem, basis, deadline))
        }
        found => found,
    }
}

/// A basis whose determinant no exchange of a single pair makes larger, as for dense problems.
fn enlarged(problem: &Equilibrated<'_>, basis: Basis, deadline: Option<Instant>) -> Basis {
    let n = basis.len();
    let Some(start) = problem.start(&basis) else { return basis };
    let covering = vec![0.0; n];
    let mut kernel = start.kernel(&covering, None);
    let (mut column, mut values) = (vec![0.0; n], vec![0.0; n]);
    let mut basic: Vec<Var> = (0..n).collect();
    let mut settled = 0;
    for k in (0..n).cycle().take(SOLVES) {
        if settled == n || is_over(deadline) || !kernel.tidy(&basic, &mut values) {
            break;
        }
        settled += 1;
        let entering = if basic[k] == k { n + k } else { k };
        kernel.column(entering, &mut column);
        if column[k].abs() > GAIN {
            kernel.exchange(k, entering, basic[k], &column);
            basic[k] = entering;
            settled = 0;
        }
    }
    start.basis_with(&basic.iter().map(|&var| var >= n).collect::<Vec<_>>())
}

/// Independent columns.
struct Chosen {
    sides: Vec<Option<Side>>,
    /// The pairs without a column, and rows whose unit columns take their places.
    missing: Vec<(usize, usize)>,
}

impl Chosen {
    fn into_crash(self, n: usize) -> Crash {
        if let Some(sides) = self.sides.iter().copied().collect::<Option<Vec<Side>>>() {
            return Crash::Complete(Basis::new(sides));
        }
        let units = self.missing.iter().enumerate().map(|(k, &(_, row))| (row, k, 1.0));
        let complement = Matrix::from_entries(n, self.missing.len(), units);
        Crash::Partial { chosen: self.sides, complement }
    }
}

struct Search<'a> {
    preferred: &'a [Side],
    /// The columns of the preferred sides, then the others.
    columns: Columns,
}

impl<'a> Search<'a> {
    fn new(problem: &Equilibrated<'_>, preferred: &'a [Side]) -> Self {
        let own = preferred.iter().copied().enumerate();
        let others = own.clone().map(|(pair, side)| (pair, side.complement()));
        Self { preferred, columns: problem.sparse_columns(own.chain(others)) }
    }

    fn order(&self) -> usize {
        self.preferred.len()
    }

    /// Position of a column in `columns`.
    fn position(&self, pair: usize, side: Side) -> usize {
        if side == self.preferred[pair] { pair } else { self.order() + pair }
    }

    /// As many of the given columns as are independent, then other columns of the pairs without one.
    fn independent(&self, first: &[Option<Side>]) -> Chosen {
        let n = self.order();
        let given = (0..n).filter_map(|pair| Some((pair, first[pair]?)));
        let others = |pair: usize| match first[pair] {
            Some(side) => vec![(pair, side.complement())],
            None => vec![(pair, self.preferred[pair]), (pair, self.preferred[pair].complement())],
        };
        let mut sides = vec![None; n];
        let mut growing = Growing::new(row_counts(n, &self.columns));
        for candidates in [given.collect::<Vec<_>>(), (0..n).flat_map(others).collect()] {
            let open = candidates.into_iter().filter(|&(pair, _)| sides[pair].is_none());
            let open: Vec<(usize, Side)> = open.collect();
            let mut columns = Columns::default();
            for &(pair, side) in &open {
                let entries = self.columns.entries(self.position(pair, side));
                entries.for_each(|(i, v)| columns.push(i, v));
                columns.close();
            }
            for turn in elimination_order(n, &columns) {
                let (pair, side) = open[turn.column];
                if sides[pair].is_none() && growing.offer(pair, &columns, turn, RANK_TOLERANCE) {
                    sides[pair] = Some(side);
                }
            }
        }
        let (_, missing) = growing.finish();
        Chosen { sides, missing }
    }
}
