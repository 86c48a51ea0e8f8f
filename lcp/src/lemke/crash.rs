//! Start bases: one column of every pair, together nonsingular.

mod found;
mod matching;
mod sparse;

use web_time::Instant;

use faer::{Mat, MatRef};

pub(super) use found::Crash;

use matching::matched_sides;
use sparse::find_sparse;

use super::constants::{DENSE_SEARCH, GAIN, GAIN_SWEEPS, RANK_TOLERANCE};
use super::start::Equilibrated;
use super::tableau::Tableau;
use crate::linear::Lu;
use crate::solve::is_over;
use crate::sparse::Columns;
use crate::vector::max_abs;
use crate::{Basis, Side};

/// A nonsingular complementary basis: the preferred sides or all `y` or all `t` where these are
/// diagonal, one of columns with a single entry, or one grown from independent columns of the preferred
/// sides, of the others, and exchanges.
pub(super) fn find_basis(
    problem: &Equilibrated<'_>,
    preferred: Option<&Basis>,
    deadline: Option<Instant>,
) -> Crash {
    let n = problem.order();
    let (all_y, all_t) = (Basis::all(Side::Y, n), Basis::all(Side::T, n));
    for basis in preferred.into_iter().chain([&all_y, &all_t]) {
        let diagonal = problem.diagonal(|j| basis.sides()[j]);
        if diagonal.is_some_and(|diagonal| diagonal.iter().all(|&d| d != 0.0)) {
            return Crash::Complete(basis.clone());
        }
    }
    let preferred = preferred.unwrap_or(&all_y);
    if let Some(basis) = single_entries(problem, preferred) {
        return Crash::Complete(basis);
    }
    if problem.problem.is_sparse() {
        match find_sparse(problem, preferred, deadline) {
            Crash::Partial { .. } if n <= DENSE_SEARCH => {}
            found => return found,
        }
    }
    if is_over(deadline) {
        return Crash::Late;
    }
    let search = Search { problem, preferred: preferred.sides(), deadline };
    let (mut chosen, mut complement) = search.independent_columns();
    while complement.ncols() > 0 {
        let tolerances = [1e-5, 1e-8, 4.0 * n as f64 * f64::EPSILON];
        match tolerances.iter().find_map(|&it| search.exchange(&chosen, &complement, it)) {
            Some(next) => chosen = next,
            None if is_over(deadline) => return Crash::Late,
            None => return Crash::Partial { chosen, complement: complement.into() },
        }
        if is_over(deadline) {
            return Crash::Late;
        }
        complement = orthogonal_complement(search.partial(&chosen).as_ref());
    }
    match chosen.iter().copied().collect::<Option<Vec<Side>>>() {
        Some(sides) => Crash::Complete(enlarged(problem, Basis::new(sides), deadline)),
        None => Crash::Partial { chosen, complement: complement.into() },
    }
}

/// The basis that the structure of the problem offers, as slack variables do: of every pair a column with
/// a single entry, all in different rows.
fn single_entries(problem: &Equilibrated<'_>, preferred: &Basis) -> Option<Basis> {
    let mut singles = Columns::default();
    let own = preferred.sides().iter().copied().enumerate();
    let others = own.clone().map(|(pair, side)| (pair, side.complement()));
    for (pair, side) in own.chain(others) {
        if let Some((row, v)) = problem.problem.column(pair, side).single() {
            singles.push(row, v);
        }
        singles.close();
    }
    let sides = matched_sides(&singles, preferred.sides());
    sides.into_iter().collect::<Option<Vec<Side>>>().map(Basis::new)
}

/// A basis whose determinant no exchange of a single pair makes larger: those found by independence
/// alone may be so poor that every path from them ends on a ray.
fn enlarged(problem: &Equilibrated<'_>, basis: Basis, deadline: Option<Instant>) -> Basis {
    let n = problem.order();
    let pick = |complement: bool| -> Vec<(usize, Side)> {
        let sides = basis.sides().iter().copied().enumerate();
        sides.map(|(k, side)| (k, if complement { side.complement() } else { side })).collect()
    };
    let Some(lu) = Lu::new(problem.columns(&pick(false)).as_ref()) else { return basis };
    let mut t = problem.columns(&pick(true));
    lu.solve_in_place(t.as_mut());
    let mut tableau = Tableau::new(t);
    let mut column = vec![0.0; n];
    let mut sides = basis.sides().to_vec();
    for _ in 0..GAIN_SWEEPS {
        let mut is_settled = true;
        for (k, side) in sides.iter_mut().enumerate() {
            tableau.column(k, &mut column);
            if column[k].abs() > GAIN {
                tableau.pivot(k, k, &column);
                *side = side.complement();
                is_settled = false;
            }
        }
        if is_settled || is_over(deadline) {
            break;
        }
    }
    Basis::new(sides)
}

struct Search<'a> {
    problem: &'a Equilibrated<'a>,
    preferred: &'a [Side],
    deadline: Option<Instant>,
}

impl Search<'_> {
    /// As many independent columns as two pivoted QR factorisations find, first among the preferred
    /// sides, then among the other columns of the other pairs outside the span of the first, with an
    /// orthonormal basis of what they leave out.
    fn independent_columns(&self) -> (Vec<Option<Side>>, Mat<f64>) {
        let n = self.problem.order();
        let mut chosen = vec![None; n];
        let picked: Vec<_> = (0..n).map(|k| (k, self.preferred[k])).collect();
        let (independent, complement) = pivot_columns(&self.problem.columns(&picked), 0.0);
        for k in independent {
            chosen[k] = Some(self.preferred[k]);
        }
        let others: Vec<(usize, Side)> = (0..n)
            .filter(|&k| chosen[k].is_none())
            .map(|k| (k, self.preferred[k].complement()))
            .collect();
        let columns = self.problem.columns(&others);
        let outside = complement.transpose() * &columns;
        let (independent, rest) = pivot_columns(&outside, columns.norm_max());
        for j in independent {
            let (k, side) = others[j];
            chosen[k] = Some(side);
        }
        (chosen, complement * rest)
    }

    fn partial(&self, chosen: &[Option<Side>]) -> Mat<f64> {
        let picked: Vec<(usize, Side)> =
            chosen.iter().enumerate().filter_map(|(k, side)| side.map(|side| (k, side))).collect();
        self.problem.columns(&picked)
    }

    /// Raises the number of pairs with a chosen column by one, through the shortest chain of
    /// exchanges: a column of a free pair takes the place of one chosen before, whose complement
    /// takes the next place, until one of them reaches outside the present span (an augmenting
    /// path of the matroid intersection of independence and pairs; Edmonds 1970). None too where the time is
    /// over.
    fn exchange(
        &self,
        chosen: &[Option<Side>],
        complement: &Mat<f64>,
        tolerance: f64,
    ) -> Option<Vec<Option<Side>>> {
        let n = self.problem.order();
        let picked: Vec<usize> = (0..n).filter(|&k| chosen[k].is_some()).collect();
        let mut spanning = self.partial(chosen);
        spanning.resize_with(n, n, |i, j| complement[(i, j - picked.len())]);
        let lu = Lu::new(spanning.as_ref())?;
        let coordinates = |pair: usize, side: Side| {
            let mut x = vec![0.0; n];
            self.problem.add_column(pair, side, 1.0, &mut x);
            lu.solve_vector(&mut x);
            x
        };

        // Breadth first over columns (pair, side), each with the place in the queue of the one that it takes the place of.
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

/// Independent columns by QR with column pivoting, up to the numerical rank, and an orthonormal basis
/// of the complement of their span. `reference` is the size of the data that `m` was computed from:
/// a matrix of nothing but rounding errors has rank zero.
fn pivot_columns(m: &Mat<f64>, reference: f64) -> (Vec<usize>, Mat<f64>) {
    let (rows, size) = (m.nrows(), m.nrows().min(m.ncols()));
    if size == 0 || m.norm_max() == 0.0 {
        return (Vec::new(), Mat::identity(rows, rows));
    }
    let qr = m.col_piv_qr();
    let r = qr.R();
    let least = RANK_TOLERANCE * r[(0, 0)].abs().max(reference);
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
