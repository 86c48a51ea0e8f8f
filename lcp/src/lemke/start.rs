//! Start bases: one column of every pair, together nonsingular.

use faer::{Mat, MatRef};

use super::path::StartTableau;
use super::tableau::Tableau;
use crate::linear::{Lu, all_finite};
use crate::problem::max_abs;
use crate::random::SplitMix;
use crate::scaling::{columns, equilibrate, scaled};
use crate::{Basis, HorizontalLcp, Side};

/// Columns whose part outside the span of those chosen before is below this multiple of the
/// largest are taken for dependent.
const RANK_TOLERANCE: f64 = 1e-10;
/// Entries of an equilibrated inverse basis beyond this betray a nearly singular basis.
const LARGEST_GROWTH: f64 = 1e10;

/// The problem with equilibrated rows and columns: `row * A * t_factor`, `row * B * y_factor`.
pub(super) struct Equilibrated {
    pub(super) a: Mat<f64>,
    pub(super) b: Mat<f64>,
    pub(super) row: Vec<f64>,
    t_factor: Vec<f64>,
    y_factor: Vec<f64>,
}

impl Equilibrated {
    pub(super) fn new(problem: &HorizontalLcp) -> Self {
        let n = problem.order();
        let (a, b) = problem.matrices();
        let (row, factors) = equilibrate(n, &[columns(a), columns(b)].concat());
        let (t_factor, y_factor) = (factors[..n].to_vec(), factors[n..].to_vec());
        let (a, b) = (scaled(a, &row, &t_factor), scaled(b, &row, &y_factor));
        Self { a, b, row, t_factor, y_factor }
    }

    fn order(&self) -> usize {
        self.row.len()
    }

    fn side(&self, side: Side) -> &Mat<f64> {
        match side {
            Side::T => &self.a,
            Side::Y => &self.b,
        }
    }

    /// Value in the problem's units of one unit of a scaled variable.
    pub(super) fn factor(&self, pair: usize, side: Side) -> f64 {
        match side {
            Side::T => self.t_factor[pair],
            Side::Y => self.y_factor[pair],
        }
    }

    fn columns(&self, sides: impl Fn(usize) -> Side) -> Mat<f64> {
        let n = self.order();
        let mut m = Mat::zeros(n, n);
        for j in 0..n {
            m.col_as_slice_mut(j).copy_from_slice(self.side(sides(j)).col_as_slice(j));
        }
        m
    }

    /// `w + T z = q` for a basis, or `None` when it is singular to working precision.
    pub(super) fn tableau(&self, basis: &Basis, c: &[f64]) -> Option<StartTableau> {
        let n = self.order();
        let sides = basis.sides();
        let matrix = self.columns(|j| sides[j]);
        let mut t = self.columns(|j| sides[j].complement());
        let mut q: Vec<f64> = c.iter().zip(&self.row).map(|(c, row)| c * row).collect();
        if is_diagonal(&matrix) {
            let diagonal: Vec<f64> = (0..n).map(|i| matrix[(i, i)]).collect();
            if diagonal.contains(&0.0) {
                return None;
            }
            for j in 0..n {
                t.col_as_slice_mut(j).iter_mut().zip(&diagonal).for_each(|(v, d)| *v /= d);
            }
            q.iter_mut().zip(&diagonal).for_each(|(v, d)| *v /= d);
        } else {
            let lu = Lu::new(matrix.as_ref())?;
            lu.solve_in_place(t.as_mut());
            lu.solve_vector(&mut q);
            drop_rounding(&mut t);
        }
        if !all_finite(&t) || t.norm_max() > LARGEST_GROWTH || q.iter().any(|q| !q.is_finite()) {
            return None;
        }
        let (rows, cols) = equilibrate(n, &columns(&t));
        q.iter_mut().zip(&rows).for_each(|(q, r)| *q *= r);
        let q_size = max_abs(&q);
        if q_size > 0.0 {
            q = q.iter().map(|q| q / q_size).collect();
        }
        let row_factor = (0..n).map(|i| rows[i] / self.factor(i, sides[i]));
        let col_factor = (0..n).map(|i| cols[i] * self.factor(i, sides[i].complement()));
        Some(StartTableau {
            basis: basis.clone(),
            t: scaled(&t, &rows, &cols),
            q,
            row_factor: row_factor.collect(),
            col_factor: col_factor.collect(),
        })
    }

    /// A nonsingular complementary basis: all `y`, all `t`, or one grown from independent columns
    /// of `B`, of `A`, and exchanges. `None` when there is none to working precision.
    pub(super) fn find_basis(&self) -> Option<Basis> {
        let n = self.order();
        for side in [Side::Y, Side::T] {
            let m = self.side(side);
            if is_diagonal(m) && (0..n).all(|i| m[(i, i)] != 0.0) {
                return Some(Basis::all(side, n));
            }
        }
        let (mut chosen, mut complement) = self.independent_columns();
        while complement.ncols() > 0 {
            let tolerances = [1e-5, 1e-8, 4.0 * n as f64 * f64::EPSILON];
            chosen = tolerances.iter().find_map(|&it| self.exchange(&chosen, &complement, it))?;
            complement = orthogonal_complement(self.partial(&chosen).as_ref());
        }
        let sides = chosen.into_iter().collect::<Option<Vec<Side>>>()?;
        Some(Basis::new(sides))
    }

    /// As many independent columns as two pivoted QR factorisations find, first among `B`, then
    /// among the columns of `A` of the other pairs outside the span of the first, with an
    /// orthonormal basis of what they leave out.
    fn independent_columns(&self) -> (Vec<Option<Side>>, Mat<f64>) {
        let n = self.order();
        let mut chosen = vec![None; n];
        let (independent, complement) = pivot_columns(&self.b, 0.0);
        for k in independent {
            chosen[k] = Some(Side::Y);
        }
        let others: Vec<usize> = (0..n).filter(|&k| chosen[k].is_none()).collect();
        let mut a = Mat::zeros(n, others.len());
        for (j, &k) in others.iter().enumerate() {
            a.col_as_slice_mut(j).copy_from_slice(self.a.col_as_slice(k));
        }
        let (independent, rest) = pivot_columns(&(complement.transpose() * &a), a.norm_max());
        for j in independent {
            chosen[others[j]] = Some(Side::T);
        }
        (chosen, complement * rest)
    }

    fn partial(&self, chosen: &[Option<Side>]) -> Mat<f64> {
        let picked: Vec<(usize, Side)> =
            chosen.iter().enumerate().filter_map(|(k, side)| side.map(|side| (k, side))).collect();
        Mat::from_fn(self.order(), picked.len(), |i, j| self.side(picked[j].1)[(i, picked[j].0)])
    }

    /// Raises the number of pairs with a chosen column by one, through the shortest chain of
    /// exchanges: a column of a free pair takes the place of one chosen before, whose complement
    /// takes the next place, until one of them reaches outside the present span (an augmenting
    /// path of the matroid intersection of independence and pairs; Edmonds 1970).
    fn exchange(
        &self,
        chosen: &[Option<Side>],
        complement: &Mat<f64>,
        tolerance: f64,
    ) -> Option<Vec<Option<Side>>> {
        let n = self.order();
        let picked: Vec<usize> = (0..n).filter(|&k| chosen[k].is_some()).collect();
        let partial = self.partial(chosen);
        let spanning = Mat::from_fn(n, n, |i, j| {
            if j < picked.len() { partial[(i, j)] } else { complement[(i, j - picked.len())] }
        });
        let lu = Lu::new(spanning.as_ref())?;
        let coordinates = |pair: usize, side: Side| {
            let mut x = self.side(side).col_as_slice(pair).to_vec();
            lu.solve_vector(&mut x);
            x
        };

        // Breadth first over columns (pair, side); `from` remembers how a pair's column came up.
        let mut queue: Vec<(usize, Side, Option<usize>)> = Vec::new();
        for pair in (0..n).filter(|&k| chosen[k].is_none()) {
            queue.extend([(pair, Side::Y, None), (pair, Side::T, None)]);
        }
        let mut seen = vec![false; n];
        let mut head = 0;
        while head < queue.len() {
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

impl StartTableau {
    /// Another start basis: principal pivots on pairs drawn at random, where the pivot is sound.
    pub(super) fn flipped(&self, seed: u64) -> Basis {
        const SOUND: f64 = 1e-2;
        let n = self.q.len();
        let mut random = SplitMix::new(seed);
        let mut tableau = Tableau::new(self.t.clone());
        let (mut column, mut row) = (vec![0.0; n], vec![0.0; n]);
        let mut sides = self.basis.sides().to_vec();
        for (pair, side) in sides.iter_mut().enumerate() {
            if random.next_f64() < 0.5 {
                continue;
            }
            tableau.column(pair, &mut column);
            if column[pair].abs() >= SOUND * max_abs(&column) && column[pair] != 0.0 {
                tableau.pivot(pair, pair, &column, &mut row);
                *side = side.complement();
            }
        }
        Basis::new(sides)
    }
}

fn is_diagonal(m: &Mat<f64>) -> bool {
    (0..m.ncols()).all(|j| m.col_as_slice(j).iter().enumerate().all(|(i, &v)| i == j || v == 0.0))
}

/// Sets to zero what the solution of an equilibrated system leaves in place of zeros: a row of
/// nothing else would be scaled up to coefficients.
fn drop_rounding(t: &mut Mat<f64>) {
    const ROUNDING: f64 = 1e-14;
    for j in 0..t.ncols() {
        let column = t.col_as_slice_mut(j);
        let least = ROUNDING * max_abs(column).max(1.0);
        column.iter_mut().filter(|v| v.abs() < least).for_each(|v| *v = 0.0);
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
