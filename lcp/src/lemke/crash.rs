//! Start bases: one column of every pair, together nonsingular.
//!
//! Sparse columns are offered to a factorisation that refuses those that depend on the ones before: first those of the
//! preferred sides, then the others of the pairs that have none yet. If pairs remain without a column, the sides of a
//! structural matching are tried in the same way. Dense columns are chosen by pivoted QR factorisations, then by
//! exchanges.

mod matching;

use web_time::Instant;

use faer::{Mat, MatRef};
use lcp_linalg::{Columns, GrowingLu, Lu, elimination_order, row_counts};

use matching::matched_sides;

use super::constants::{DENSE_SEARCH, GAIN, GAIN_SWEEPS, VANISHING};
use super::dense::Dense;
use super::kernel::{Kernel, Var, complement};
use super::start::Equilibrated;
use crate::solve::is_over;
use crate::vector::max_abs;
use crate::{Basis, Matrix, Side};

/// A largest set of independent columns, at most one of every pair.
pub(super) enum Crash {
    /// One column of every pair.
    Complete(Basis),
    /// Pairs without a column, as many as there are columns that complete the chosen ones: an orthonormal basis of the
    /// complement of their span, or unit columns.
    Partial { chosen: Vec<Option<Side>>, complement: Box<Matrix> },
    /// The time limit was reached first.
    Late,
}

/// A nonsingular complementary basis: one of columns with a single entry, or one grown from independent columns.
pub(super) fn find_basis(
    problem: &Equilibrated<'_>,
    preferred: Option<&Basis>,
    deadline: Option<Instant>,
) -> Crash {
    let n = problem.order();
    let all_y = vec![Side::Y; n];
    let preferred = preferred.map_or(&all_y[..], Basis::sides);
    if let Some(basis) = single_entries(problem, preferred) {
        return Crash::Complete(basis);
    }
    if problem.problem.is_sparse() {
        match grown(problem, preferred, deadline) {
            Crash::Complete(basis) if n <= DENSE_SEARCH => {
                return Crash::Complete(enlarged(problem, basis, deadline));
            }
            Crash::Partial { .. } if n <= DENSE_SEARCH => {}
            found => return found,
        }
    }
    if is_over(deadline) {
        return Crash::Late;
    }
    let exchanges = CrashExchanges { problem, preferred, deadline };
    let (mut chosen, mut complement) = exchanges.independent_columns();
    while complement.ncols() > 0 {
        let tolerances = [1e-5, 1e-8, 4.0 * n as f64 * f64::EPSILON];
        let next = tolerances.iter().find_map(|&it| exchanges.next(&chosen, &complement, it));
        if is_over(deadline) {
            return Crash::Late;
        }
        let Some(next) = next else { break };
        chosen = next;
        complement = orthogonal_complement(exchanges.columns(&chosen).as_ref());
    }
    match chosen.iter().copied().collect::<Option<Vec<Side>>>() {
        Some(sides) => Crash::Complete(enlarged(problem, Basis::new(sides), deadline)),
        None => Crash::Partial { chosen, complement: Box::new(complement.into()) },
    }
}

/// The basis given by the structure of the problem, as by slack variables: a column with a single entry of every pair,
/// all in different rows.
fn single_entries(problem: &Equilibrated<'_>, preferred: &[Side]) -> Option<Basis> {
    let mut singles = Columns::default();
    for (pair, side) in both_sides(preferred) {
        if let Some((row, v)) = problem.problem.column(pair, side).single() {
            singles.push(row, v);
        }
        singles.close();
    }
    let sides = matched_sides(&singles, preferred);
    sides.into_iter().collect::<Option<Vec<Side>>>().map(Basis::new)
}

/// All variables, those of the preferred sides first.
fn both_sides(preferred: &[Side]) -> impl Iterator<Item = (usize, Side)> + '_ {
    let own = preferred.iter().copied().enumerate();
    own.clone().chain(own.map(|(pair, side)| (pair, side.complement())))
}

/// The largest of the sets of independent columns found from the preferred sides, all `t`, or the sides of a matching,
/// completed by unit columns.
fn grown(problem: &Equilibrated<'_>, preferred: &[Side], deadline: Option<Instant>) -> Crash {
    let n = preferred.len();
    let all_t = vec![Side::T; n];
    let mut best: Option<(Vec<Option<Side>>, Vec<usize>)> = None;
    for (preferred, is_matched) in [(preferred, false), (&all_t, false), (preferred, true)] {
        if is_over(deadline) {
            return Crash::Late;
        }
        let columns = problem.sparse_columns(both_sides(preferred).map(Some));
        let first = if is_matched {
            matched_sides(&columns, preferred)
        } else {
            preferred.iter().copied().map(Some).collect()
        };
        let (sides, missing) = independent(&columns, preferred, &first);
        if let Some(sides) = sides.iter().copied().collect::<Option<Vec<Side>>>() {
            return Crash::Complete(Basis::new(sides));
        }
        if best.as_ref().is_none_or(|best| missing.len() < best.1.len()) {
            best = Some((sides, missing));
        }
    }
    let (chosen, missing) = best.unwrap_or_default();
    let units = missing.iter().enumerate().map(|(k, &row)| (row, k, 1.0));
    let complement = Box::new(Matrix::from_entries(n, missing.len(), units));
    Crash::Partial { chosen, complement }
}

/// Chooses independent columns, `first` ones before others of their pairs, at most one of a pair; also returns the rows
/// without a column. `columns` are those of [`both_sides`].
fn independent(
    columns: &Columns,
    preferred: &[Side],
    first: &[Option<Side>],
) -> (Vec<Option<Side>>, Vec<usize>) {
    let n = preferred.len();
    let given = (0..n).filter_map(|pair| Some((pair, first[pair]?)));
    let others = |pair: usize| match first[pair] {
        Some(side) => vec![(pair, side.complement())],
        None => vec![(pair, preferred[pair]), (pair, preferred[pair].complement())],
    };
    let mut sides = vec![None; n];
    let mut growing = GrowingLu::new(row_counts(n, columns));
    for candidates in [given.collect::<Vec<_>>(), (0..n).flat_map(others).collect()] {
        let open = candidates.into_iter().filter(|&(pair, _)| sides[pair].is_none());
        let open: Vec<(usize, Side)> = open.collect();
        let mut offered = Columns::default();
        for &(pair, side) in &open {
            let position = if side == preferred[pair] { pair } else { n + pair };
            columns.entries(position).for_each(|(i, v)| offered.push(i, v));
            offered.close();
        }
        for turn in elimination_order(n, &offered) {
            let (pair, side) = open[turn.column];
            if sides[pair].is_none() && growing.offer(pair, &offered, turn, VANISHING) {
                sides[pair] = Some(side);
            }
        }
    }
    let (_, missing) = growing.finish();
    (sides, missing.into_iter().map(|(_, row)| row).collect())
}

/// A basis whose determinant is not enlarged by the exchange of any single pair: bases found by independence alone may
/// be so poor that every path from them ends on a ray.
fn enlarged(problem: &Equilibrated<'_>, basis: Basis, deadline: Option<Instant>) -> Basis {
    let n = problem.order();
    let zeros = vec![0.0; n];
    let mut sides = basis.sides().to_vec();
    let columns = |sides: &[Side]| -> Mat<f64> {
        problem.columns(&sides.iter().copied().enumerate().collect::<Vec<_>>())
    };
    let (start, mut t);
    let mut kernel: Box<dyn Kernel> = if problem.problem.is_sparse() {
        start = problem.start(&basis);
        let Some(start) = &start else { return basis };
        start.kernel(&zeros)
    } else {
        let Some(lu) = Lu::new(columns(&sides).as_ref()) else { return basis };
        let others: Vec<Side> = sides.iter().map(|side| side.complement()).collect();
        t = columns(&others);
        lu.solve_in_place(t.as_mut());
        Box::new(Dense::new(t.as_ref(), &zeros, &zeros))
    };
    let (mut column, mut values) = (vec![0.0; n], vec![0.0; n]);
    let mut basic: Vec<Var> = (0..n).collect();
    let mut settled = 0;
    for k in (0..n).cycle().take(GAIN_SWEEPS * n) {
        if settled == n || is_over(deadline) || !kernel.tidy(&basic, &mut values) {
            break;
        }
        settled += 1;
        let entering = complement(basic[k], n);
        kernel.column(entering, &mut column);
        if column[k].abs() > GAIN {
            kernel.exchange(k, entering, basic[k], &column);
            basic[k] = entering;
            sides[k] = sides[k].complement();
            settled = 0;
        }
    }
    Basis::new(sides)
}

struct CrashExchanges<'a> {
    problem: &'a Equilibrated<'a>,
    preferred: &'a [Side],
    deadline: Option<Instant>,
}

impl CrashExchanges<'_> {
    fn columns(&self, chosen: &[Option<Side>]) -> Mat<f64> {
        let picked: Vec<(usize, Side)> =
            chosen.iter().enumerate().filter_map(|(k, side)| Some((k, (*side)?))).collect();
        self.problem.columns(&picked)
    }

    /// The independent columns that two pivoted QR factorisations find, first among the preferred sides, then among the
    /// other columns of the other pairs outside the span of the first, with an orthonormal basis of the complement of
    /// their span.
    fn independent_columns(&self) -> (Vec<Option<Side>>, Mat<f64>) {
        let n = self.preferred.len();
        let mut chosen = vec![None; n];
        let own: Vec<_> = self.preferred.iter().copied().enumerate().collect();
        let (independent, complement) = pivot_columns(&self.problem.columns(&own), 0.0);
        for &k in &independent {
            chosen[k] = Some(self.preferred[k]);
        }
        let open = own.into_iter().filter(|&(k, _)| chosen[k].is_none());
        let others: Vec<_> = open.map(|(k, side)| (k, side.complement())).collect();
        let columns = self.problem.columns(&others);
        let outside = complement.transpose() * &columns;
        let (independent, rest) = pivot_columns(&outside, columns.norm_max());
        for (k, side) in independent.into_iter().map(|j| others[j]) {
            chosen[k] = Some(side);
        }
        (chosen, complement * rest)
    }

    /// Raises the number of pairs with a chosen column by one, through the shortest chain of exchanges: a column of a
    /// free pair takes the place of one chosen before, whose complement takes the next place, until one of them reaches
    /// outside the present span (an augmenting path of the matroid intersection of independence and pairs; Edmonds
    /// 1970). `None` also if the time limit is reached.
    fn next(
        &self,
        chosen: &[Option<Side>],
        complement: &Mat<f64>,
        tolerance: f64,
    ) -> Option<Vec<Option<Side>>> {
        let n = self.problem.order();
        let picked: Vec<usize> = (0..n).filter(|&k| chosen[k].is_some()).collect();
        let mut spanning = self.columns(chosen);
        spanning.resize_with(n, n, |i, j| complement[(i, j - picked.len())]);
        let lu = Lu::new(spanning.as_ref())?;
        let coordinates = |pair: usize, side: Side| {
            let mut x = vec![0.0; n];
            self.problem.add_column(pair, side, 1.0, &mut x);
            lu.solve_vector(&mut x);
            x
        };

        // Breadth-first search over columns (pair, side), each with the position in the queue of the column that it
        // replaces.
        let open = (0..n).filter(|&k| chosen[k].is_none());
        let both = |k: usize| [self.preferred[k], self.preferred[k].complement()].map(|it| (k, it));
        let mut queue: Vec<(usize, Side, Option<usize>)> =
            open.flat_map(both).map(|(k, side)| (k, side, None)).collect();
        let mut seen = vec![false; n];
        let mut head = 0;
        while head < queue.len() && !is_over(self.deadline) {
            let (pair, side, _) = queue[head];
            let x = coordinates(pair, side);
            let tolerance = tolerance * max_abs(&x);
            if max_abs(&x[picked.len()..]) > tolerance {
                let mut next = chosen.to_vec();
                let mut at = Some(head);
                while let Some(i) = at {
                    let (pair, side, from) = queue[i];
                    next[pair] = Some(side);
                    at = from;
                }
                return Some(next);
            }
            for (j, &other) in picked.iter().enumerate() {
                if x[j].abs() > tolerance && !seen[other] {
                    seen[other] = true;
                    if let Some(side) = chosen[other] {
                        queue.push((other, side.complement(), Some(head)));
                    }
                }
            }
            head += 1;
        }
        None
    }
}

/// Independent columns by QR with column pivoting, up to the numerical rank, and an orthonormal basis of the complement
/// of their span. `reference` is the size of the data from which `m` was computed: a matrix of nothing but rounding
/// errors has rank zero.
fn pivot_columns(m: &Mat<f64>, reference: f64) -> (Vec<usize>, Mat<f64>) {
    let (rows, size) = (m.nrows(), m.nrows().min(m.ncols()));
    if size == 0 || m.norm_max() == 0.0 {
        return (Vec::new(), Mat::identity(rows, rows));
    }
    let qr = m.col_piv_qr();
    let r = qr.R();
    let least = VANISHING * r[(0, 0)].abs().max(reference);
    let rank = (0..size).take_while(|&k| r[(k, k)].abs() > least).count();
    let columns = qr.P().arrays().0[..rank].to_vec();
    if rank == rows {
        return (columns, Mat::zeros(rows, 0));
    }
    (columns, qr.compute_Q().subcols(rank, rows - rank).to_owned())
}

/// An orthonormal basis of the orthogonal complement of independent columns.
fn orthogonal_complement(m: MatRef<'_, f64>) -> Mat<f64> {
    let (n, k) = (m.nrows(), m.ncols());
    if k == 0 {
        return Mat::identity(n, n);
    }
    let q = m.qr().compute_Q();
    q.subcols(k, n - k).to_owned()
}
