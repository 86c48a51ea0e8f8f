//! Variables between bounds.

use std::ops::{Add, Neg, Sub};

use super::HorizontalLcp;
use crate::matrix::check_sums;
use crate::vector::{check_bounds, check_length, check_vector};
use crate::{Error, Matrix, Vector};

/// The problem `w = M z + q`, `lower <= z <= upper` of order `n`, with `w_i >= 0` if `z_i` is at its lower bound,
/// `w_i <= 0` if `z_i` is at its upper one, and `w_i = 0` in between.
///
/// Bounds may be infinite. The problem is the standard one for `lower = 0` and `upper = inf`, and a system of equations
/// without bounds.
///
/// ```
/// use faer::mat;
/// use lcp::{BoxedLcp, Lemke, Solver};
/// let m = mat![[2.0, 1.0], [1.0, 2.0]];
/// let boxed = BoxedLcp::new(m, vec![-9.0, 2.0], vec![-1.0, -1.0], vec![3.0, f64::INFINITY])?;
/// let solution = Lemke::default().solve(&boxed)?;
/// let (z, w) = boxed.variables(&solution);
/// assert_eq!((z, w), (vec![3.0, -1.0], vec![-4.0, 3.0]));
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct BoxedLcp {
    m: Matrix,
    q: Vec<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

/// The kind of a variable by its bounds, and its pairs `(t, y)` in the general form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BoundKind {
    /// `z = t - y`, `w = 0`.
    Free,
    /// `z = lower + t`, `w = y`.
    Lower,
    /// `z = upper - t`, `w = -y`.
    Upper,
    /// `z` is known, `w = y - t`.
    Fixed,
    /// `z = lower + t`, `w = y - y'`, with the pair `(t', y')` of this index and `t + t' = upper - lower`.
    Both(usize),
}

/// `z = shift + sign t` with the pair of `t`, and the pair of the distance from the other bound.
pub(super) struct Distance {
    pub(super) shift: f64,
    pub(super) sign: f64,
    pub(super) pair: usize,
    pub(super) other: Option<usize>,
}

impl BoxedLcp {
    /// A problem of order `n` from `M` (n x n), `q`, `lower` and `upper` (n).
    ///
    /// # Errors
    /// [`Error::Shape`] or [`Error::Length`] if the sizes do not agree, [`Error::NotFinite`] for a NaN or an infinity
    /// other than those of bounds, [`Error::Bounds`] for a lower bound above the upper one, a lower bound of `+inf` or
    /// an upper one of `-inf`, [`Error::Overflow`] if sums of these data exceed the range of numbers.
    pub fn new(
        m: impl Into<Matrix>,
        q: impl Into<Vector>,
        lower: impl Into<Vector>,
        upper: impl Into<Vector>,
    ) -> Result<Self, Error> {
        let (m, q) = (m.into(), q.into().into_entries());
        let [lower, upper] = [lower.into(), upper.into()].map(Vector::into_entries);
        let n = q.len();
        m.check("M", n, n)?;
        check_vector("q", &q)?;
        check_length("lower", lower.len(), n)?;
        check_length("upper", upper.len(), n)?;
        check_bounds("variable", &lower, &upper)?;
        let problem = Self { m, q, lower, upper };
        check_sums(
            "the terms of q + M z, with z at the bounds nearest to zero,",
            &problem.loads(),
        )?;
        Ok(problem)
    }

    /// Number of variables.
    pub fn order(&self) -> usize {
        self.q.len()
    }

    /// The matrix.
    pub fn m(&self) -> &Matrix {
        &self.m
    }

    /// The vector.
    pub fn q(&self) -> &[f64] {
        &self.q
    }

    /// The lower bounds.
    pub fn lower(&self) -> &[f64] {
        &self.lower
    }

    /// The upper bounds.
    pub fn upper(&self) -> &[f64] {
        &self.upper
    }

    /// The general problem: `n` pairs, and one more for every variable with two finite, different bounds. Row `i` is
    /// `w - M z = q` for variable `i`, with `z` as its distance from the bound nearer to zero; the additional rows are
    /// the distances between the two bounds.
    pub fn to_general(&self) -> HorizontalLcp {
        let mut c = self.q.clone();
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for (j, kind) in self.kinds().into_iter().enumerate() {
            let Distance { shift, sign, pair, other } = self.distance(j, kind);
            if shift != 0.0 {
                self.m.slice(j).add_to(shift, &mut c);
            }
            if kind == BoundKind::Fixed {
                a.push((j, j, -1.0));
                b.push((j, j, 1.0));
                continue;
            }
            let column = || self.m.column(j).filter(|(_, v)| *v != 0.0);
            a.extend(column().map(|(i, v)| (i, pair, -sign * v)));
            if kind == BoundKind::Free {
                b.extend(column().map(|(i, v)| (i, pair, v)));
            } else {
                b.push((j, pair, sign));
            }
            if let Some(other) = other {
                let row = pair.max(other);
                a.extend([(row, pair, 1.0), (row, other, 1.0)]);
                b.push((j, other, -sign));
                c.push(self.upper[j] - self.lower[j]);
            }
        }
        let a = Matrix::assembled(c.len(), self.m.is_sparse(), a.into_iter());
        HorizontalLcp::from_parts(a, Matrix::from_entries(c.len(), c.len(), b.into_iter()), c)
    }

    /// `(z, w)` from a point of the general problem.
    ///
    /// # Panics
    /// If `t` or `y` does not have one entry for every pair of the general problem.
    pub fn recover(&self, t: &[f64], y: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let pairs = self.pairs();
        assert!(t.len() == pairs && y.len() == pairs, "a point has one entry for every pair");
        self.recover_in(t, y, |bound| bound)
    }

    /// [`recover`](Self::recover) in numbers of another kind, such as rational ones.
    ///
    /// # Panics
    /// If `t` or `y` does not have one entry for every pair of the general problem.
    pub fn recover_in<T>(&self, t: &[T], y: &[T], number: impl Fn(f64) -> T) -> (Vec<T>, Vec<T>)
    where
        T: Clone + PartialOrd + Add<Output = T> + Sub<Output = T> + Neg<Output = T>,
    {
        let [lower, upper] = [&self.lower, &self.upper].map(|bounds| |i: usize| number(bounds[i]));
        let (t, y) = (|i: usize| t[i].clone(), |i: usize| y[i].clone());
        let value = |(i, kind): (usize, BoundKind)| match kind {
            BoundKind::Free => (t(i) - y(i), number(0.0)),
            BoundKind::Lower => (lower(i) + t(i), y(i)),
            BoundKind::Upper => (upper(i) - t(i), -y(i)),
            BoundKind::Fixed => (lower(i), y(i) - t(i)),
            // The value is computed from the nearer bound, so that it can meet that bound exactly.
            BoundKind::Both(k) if t(k) < t(i) => (upper(i) - t(k), y(i) - y(k)),
            BoundKind::Both(k) => (lower(i) + t(i), y(i) - y(k)),
        };
        self.kinds().into_iter().enumerate().map(value).unzip()
    }

    /// The point of the general problem that belongs to `(z, w)`.
    ///
    /// # Panics
    /// If `z` or `w` does not have `n` entries.
    pub fn to_pairs(&self, z: &[f64], w: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let n = self.order();
        assert!(z.len() == n && w.len() == n, "one entry for every variable");
        let (kinds, pairs) = (self.kinds(), self.pairs());
        let (mut t, mut y) = (vec![0.0; pairs], vec![0.0; pairs]);
        for (i, &kind) in kinds.iter().enumerate() {
            let (z, w) = (z[i], w[i]);
            match kind {
                BoundKind::Free => (t[i], y[i]) = (z.max(0.0), (-z).max(0.0)),
                BoundKind::Lower => (t[i], y[i]) = (z - self.lower[i], w),
                BoundKind::Upper => (t[i], y[i]) = (self.upper[i] - z, -w),
                BoundKind::Fixed => (t[i], y[i]) = ((-w).max(0.0), w.max(0.0)),
                BoundKind::Both(k) => {
                    (t[i], y[i]) = (z - self.lower[i], w.max(0.0));
                    (t[k], y[k]) = (self.upper[i] - z, (-w).max(0.0));
                }
            }
        }
        (t, y)
    }

    /// The problem with variables at a bound fixed there, and the others free; `None` if none is free.
    pub(crate) fn held(&self, z: &[f64], w: &[f64]) -> Option<Self> {
        let is_inside = |j: usize| w[j] == 0.0 && self.lower[j] < z[j] && z[j] < self.upper[j];
        let mut held = Self { lower: z.to_vec(), upper: z.to_vec(), ..self.clone() };
        let mut has_any = false;
        for j in (0..self.order()).filter(|&j| is_inside(j)) {
            (held.lower[j], held.upper[j]) = (f64::NEG_INFINITY, f64::INFINITY);
            has_any = true;
        }
        has_any.then_some(held)
    }

    /// `M z + q`, without the parts that the bounds do not allow.
    pub(crate) fn forces(&self, z: &[f64]) -> Vec<f64> {
        let mut w = self.image(z);
        for (j, w) in w.iter_mut().enumerate() {
            let (is_low, is_high) = (z[j] <= self.lower[j], z[j] >= self.upper[j]);
            *w = if is_low { *w } else { w.min(0.0) };
            *w = if is_high { *w } else { w.max(0.0) };
        }
        w
    }

    /// `M z + q`
    pub(crate) fn image(&self, z: &[f64]) -> Vec<f64> {
        let mut w = self.q.clone();
        z.iter().enumerate().for_each(|(j, &z)| self.m.slice(j).add_to(z, &mut w));
        w
    }

    /// The variables with one value only.
    pub(super) fn fixed(&self) -> Vec<usize> {
        let kinds = self.kinds();
        (0..self.order()).filter(|&i| kinds[i] == BoundKind::Fixed).collect()
    }

    /// The value nearest to zero that the bounds of a variable allow.
    fn nearest(&self, i: usize) -> f64 {
        self.lower[i].max(0.0) + self.upper[i].min(0.0)
    }

    /// The sizes of the right-hand sides: bounds that keep a variable from zero are loads, too.
    pub(crate) fn loads(&self) -> Vec<f64> {
        let mut loads: Vec<f64> = self.q.iter().map(|q| q.abs()).collect();
        for j in 0..self.order() {
            let nearest = self.nearest(j);
            if nearest != 0.0 {
                self.m.slice(j).for_each(|i, v| loads[i] += (v * nearest).abs());
            }
        }
        loads
    }

    /// Number of pairs of the general problem.
    pub(crate) fn pairs(&self) -> usize {
        self.order() + self.upper_pairs().into_iter().flatten().count()
    }

    /// The second pair of every variable with two bounds in the general problem.
    pub(crate) fn upper_pairs(&self) -> Vec<Option<usize>> {
        let pair = |kind| if let BoundKind::Both(pair) = kind { Some(pair) } else { None };
        self.kinds().into_iter().map(pair).collect()
    }

    pub(super) fn kinds(&self) -> Vec<BoundKind> {
        let mut next = self.order();
        let kind = |(&lower, &upper): (&f64, &f64)| match (lower.is_finite(), upper.is_finite()) {
            (false, false) => BoundKind::Free,
            (true, false) => BoundKind::Lower,
            (false, true) => BoundKind::Upper,
            (true, true) if lower.total_cmp(&upper).is_eq() => BoundKind::Fixed,
            (true, true) => {
                next += 1;
                BoundKind::Both(next - 1)
            }
        };
        self.lower.iter().zip(&self.upper).map(kind).collect()
    }

    /// A variable by its distance from the bound nearer to zero, which keeps more digits of the value than the distance
    /// from the other one.
    pub(super) fn distance(&self, j: usize, kind: BoundKind) -> Distance {
        let (lower, upper) = (self.lower[j], self.upper[j]);
        let (shift, sign, pair, other) = match kind {
            BoundKind::Free => (0.0, 1.0, j, None),
            BoundKind::Lower | BoundKind::Fixed => (lower, 1.0, j, None),
            BoundKind::Upper => (upper, -1.0, j, None),
            BoundKind::Both(second) if upper.abs() < lower.abs() => (upper, -1.0, second, Some(j)),
            BoundKind::Both(second) => (lower, 1.0, j, Some(second)),
        };
        Distance { shift, sign, pair, other }
    }
}
