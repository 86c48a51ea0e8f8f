//! Convex quadratic programs.

use super::MixedLcp;
use crate::definite::indefiniteness;
use crate::vector::{check_bounds, check_length, check_vector};
use crate::{Error, Matrix, Vector};

/// The convex quadratic program `min x.P x / 2 + q.x + constant` subject to `l <= A x <= u` and `lower <= x <= upper`.
///
/// Solvers treat its conditions, the [mixed problem](Self::mixed) of the variables and of a multiplier for every bound,
/// with the numbers of the program.
///
/// ```
/// use faer::mat;
/// use lcp::{Auto, Qp, Solver};
/// // min (x^2 + y^2) / 2 - 2 x - y, x + y <= 2, 0 <= y <= 1
/// let (free, all) = (f64::NEG_INFINITY, f64::INFINITY);
/// let qp = Qp::new(mat![[1.0, 0.0], [0.0, 1.0]], vec![-2.0, -1.0], mat![[1.0, 1.0]], vec![free], vec![2.0])?;
/// let qp = qp.with_bounds(vec![free, 0.0], vec![all, 1.0])?;
/// let optimum = qp.variables(&Auto::default().solve(qp.mixed())?);
/// assert!((optimum.x[0] - 1.5).abs() < 1e-12 && (optimum.x[1] - 0.5).abs() < 1e-12);
/// assert!((optimum.objective + 2.25).abs() < 1e-12 && (optimum.rows[0] + 0.5).abs() < 1e-12);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Qp {
    p: Matrix,
    q: Vec<f64>,
    a: Matrix,
    rows: RowBounds,
    variables: RowBounds,
    constant: f64,
    limits: Vec<Limit>,
    mixed: MixedLcp,
}

/// A point of a program.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct QpPoint {
    /// The objective, with its constant.
    pub objective: f64,
    /// The variables.
    pub x: Vec<f64>,
    /// The multipliers of the rows of `A`, positive at the lower side, in `P x + q = A^T rows + bounds`.
    pub rows: Vec<f64>,
    /// The multipliers of the bounds of the variables, likewise.
    pub bounds: Vec<f64>,
}

#[derive(Debug, Clone)]
struct RowBounds {
    lower: Vec<f64>,
    upper: Vec<f64>,
}

/// A bound with a multiplier of its own: `w = sign (g - bound)`. `g` is one of the rows of `A x` or, after these, of
/// the variables.
#[derive(Debug, Clone, Copy)]
struct Limit {
    of: usize,
    sign: f64,
    bound: f64,
    is_equation: bool,
}

impl Qp {
    /// A program with free variables, from `P` (n x n), `q` (n), `A` (m x n), `l` and `u` (m), which may be infinite.
    ///
    /// # Errors
    /// [`Error::Shape`] or [`Error::Length`] if the sizes do not agree, [`Error::NotFinite`] for a NaN, or an infinity
    /// other than those of bounds, [`Error::Bounds`] for bounds without a number between them, [`Error::NotSymmetric`]
    /// and [`Error::NotConvex`] for a `P` that is not symmetric positive semidefinite.
    pub fn new(
        p: impl Into<Matrix>,
        q: impl Into<Vector>,
        a: impl Into<Matrix>,
        l: impl Into<Vector>,
        u: impl Into<Vector>,
    ) -> Result<Self, Error> {
        let (p, a, q) = (p.into(), a.into(), q.into().into_entries());
        let [l, u] = [l.into(), u.into()].map(Vector::into_entries);
        let n = q.len();
        p.check("P", n, n)?;
        check_vector("q", &q)?;
        check_length("u", u.len(), l.len())?;
        a.check("A", l.len(), n)?;
        p.check_symmetric("P")?;
        if let Some(reason) = indefiniteness("P", &p.clone().into_sparse()) {
            return Err(Error::NotConvex { reason });
        }
        let free = RowBounds { lower: vec![f64::NEG_INFINITY; n], upper: vec![f64::INFINITY; n] };
        check_bounds("row", &l, &u)?;
        Self::posed(p, q, a, RowBounds { lower: l, upper: u }, free)
    }

    /// The same program with bounds of its variables, which may be infinite.
    ///
    /// # Errors
    /// [`Error::Length`] and [`Error::Bounds`] as [`new`](Self::new).
    pub fn with_bounds(
        self,
        lower: impl Into<Vector>,
        upper: impl Into<Vector>,
    ) -> Result<Self, Error> {
        let [lower, upper] = [lower.into(), upper.into()].map(Vector::into_entries);
        check_length("lower", lower.len(), self.q.len())?;
        check_length("upper", upper.len(), self.q.len())?;
        let Self { p, q, a, rows, constant, .. } = self;
        check_bounds("variable", &lower, &upper)?;
        Ok(Self { constant, ..Self::posed(p, q, a, rows, RowBounds { lower, upper })? })
    }

    /// The same program with this constant in its objective.
    ///
    /// # Errors
    /// [`Error::NotFinite`].
    pub fn with_constant(self, constant: f64) -> Result<Self, Error> {
        check_vector("constant", &[constant])?;
        Ok(Self { constant, ..self })
    }

    fn posed(
        p: Matrix,
        q: Vec<f64>,
        a: Matrix,
        rows: RowBounds,
        variables: RowBounds,
    ) -> Result<Self, Error> {
        let of_variables = variables.limits(a.nrows()).filter(|limit| !limit.is_sign());
        let limits: Vec<Limit> = rows.limits(0).chain(of_variables).collect();
        let mixed = conditions(&p, &q, &a, &variables, &limits)?;
        Ok(Self { p, q, a, rows, variables, constant: 0.0, limits, mixed })
    }

    /// The conditions of the program: `x`, nonnegative if its lower bound is zero, and the multipliers of the other
    /// bounds, free if these are equations.
    pub fn mixed(&self) -> &MixedLcp {
        &self.mixed
    }

    /// The matrix of the objective.
    pub fn p(&self) -> &Matrix {
        &self.p
    }

    /// The vector of the objective.
    pub fn q(&self) -> &[f64] {
        &self.q
    }

    /// The matrix of the constraints.
    pub fn a(&self) -> &Matrix {
        &self.a
    }

    /// The bounds `l` and `u` of `A x`.
    pub fn row_bounds(&self) -> [&[f64]; 2] {
        [&self.rows.lower, &self.rows.upper]
    }

    /// The bounds `lower` and `upper` of `x`.
    pub fn bounds(&self) -> [&[f64]; 2] {
        [&self.variables.lower, &self.variables.upper]
    }

    /// The constant of the objective.
    pub fn constant(&self) -> f64 {
        self.constant
    }

    /// The point from the variables `(z, w)` of the [conditions](Self::mixed).
    ///
    /// # Panics
    /// If `z` or `w` has fewer entries than variables.
    pub fn point(&self, mut x: Vec<f64>, mut w: Vec<f64>) -> QpPoint {
        let multipliers = x.split_off(self.q.len());
        w.truncate(self.q.len());
        let mut rows = vec![0.0; self.a.nrows()];
        rows.append(&mut w);
        for (limit, multiplier) in self.limits.iter().zip(multipliers) {
            rows[limit.of] += limit.sign * multiplier;
        }
        let bounds = rows.split_off(self.a.nrows());
        QpPoint { objective: self.objective(&x), x, rows, bounds }
    }

    /// The objective at a point.
    ///
    /// # Panics
    /// If `x` does not have one entry for every variable.
    pub fn objective(&self, x: &[f64]) -> f64 {
        assert_eq!(x.len(), self.q.len(), "one entry for every variable");
        let column = |j: usize| self.p.column(j).map(|(i, v)| v * x[i]).sum::<f64>();
        let terms = x.iter().enumerate().map(|(j, x)| x * (0.5 * column(j) + self.q[j]));
        terms.sum::<f64>() + self.constant
    }
}

impl RowBounds {
    /// The finite bounds; `first` is the number of the first row or variable.
    fn limits(&self, first: usize) -> impl Iterator<Item = Limit> {
        self.lower.iter().zip(&self.upper).enumerate().flat_map(move |(index, (lower, upper))| {
            let (of, is_equation) = (first + index, lower >= upper);
            let limit = |sign, bound| Limit { of, sign, bound, is_equation };
            let upper = Some(limit(-1.0, *upper)).filter(|_| !is_equation);
            let both = [limit(1.0, *lower)].into_iter().chain(upper);
            both.filter(|limit| limit.bound.is_finite())
        })
    }
}

impl Limit {
    /// Whether a bound requires its variable to be nonnegative, for which no multiplier is needed.
    fn is_sign(&self) -> bool {
        self.sign > 0.0 && self.bound == 0.0 && !self.is_equation
    }
}

/// `[P, -G^T; G, 0]` and `(q, -h)`, for limits `G x >= h`.
fn conditions(
    p: &Matrix,
    q: &[f64],
    a: &Matrix,
    variables: &RowBounds,
    limits: &[Limit],
) -> Result<MixedLcp, Error> {
    let n = q.len();
    let mut of_row = vec![Vec::new(); a.nrows() + n];
    limits.iter().enumerate().for_each(|(k, limit)| of_row[limit.of].push(k));
    let mut rows = Vec::new();
    for j in 0..n {
        for (i, v) in a.column(j).chain([(a.nrows() + j, 1.0)]) {
            rows.extend(of_row[i].iter().map(|&k| (k, j, limits[k].sign * v)));
        }
    }
    let quadratic = (0..n).flat_map(|j| p.column(j).map(move |(i, v)| (i, j, v)));
    let linear = rows.iter().flat_map(|&(k, j, v)| [(n + k, j, v), (j, n + k, -v)]);
    let entries = quadratic.chain(linear).filter(|(_, _, v)| *v != 0.0);
    let order = n + limits.len();
    let m = Matrix::from_entries(order, order, entries);
    let is_free = (0..n).map(|j| !(variables.lower[j] == 0.0 && variables.upper[j] > 0.0));
    let free = is_free.chain(limits.iter().map(|limit| limit.is_equation)).collect();
    let offset = limits.iter().map(|limit| -limit.sign * limit.bound);
    MixedLcp::new(m, q.iter().copied().chain(offset).collect::<Vec<f64>>(), free)
}
