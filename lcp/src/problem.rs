//! Problems: the general (horizontal) form and the standard one.

use faer::{Mat, MatRef};

use crate::{Basis, Error, Residuals, Side};

/// The general (horizontal) linear complementarity problem
/// `A t + B y = c`, `t >= 0`, `y >= 0`, `t.y = 0`, with square `A` and `B` of order `n`.
///
/// Both matrices may be singular.
///
/// ```
/// use faer::mat;
/// use lcp::{HorizontalLcp, Lemke};
///
/// // 2 t + t' - y = 1,  t + 2 t' - y' = 1
/// let a = mat![[2.0, 1.0], [1.0, 2.0]];
/// let b = mat![[-1.0, 0.0], [0.0, -1.0]];
/// let problem = HorizontalLcp::new(a, b, vec![1.0, 1.0])?;
/// let solution = Lemke::default().solve(&problem)?;
/// assert!(solution.is_solved());
/// assert!((solution.t[0] - 1.0 / 3.0).abs() < 1e-15);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct HorizontalLcp {
    a: Mat<f64>,
    b: Mat<f64>,
    c: Vec<f64>,
}

impl HorizontalLcp {
    /// A problem of order `n` from `A` (n x n), `B` (n x n) and `c` (n).
    ///
    /// # Errors
    /// [`Error::Shape`] when the shapes do not fit, [`Error::NotFinite`] for a NaN or an infinity.
    pub fn new(a: Mat<f64>, b: Mat<f64>, c: Vec<f64>) -> Result<Self, Error> {
        let n = c.len();
        for (what, m) in [("A", &a), ("B", &b)] {
            check_square(what, m.as_ref(), n)?;
        }
        check_vector("c", &c)?;
        Ok(Self { a, b, c })
    }

    /// Number of pairs.
    pub fn order(&self) -> usize {
        self.c.len()
    }

    /// The matrix of `t`.
    pub fn a(&self) -> MatRef<'_, f64> {
        self.a.as_ref()
    }

    /// The matrix of `y`.
    pub fn b(&self) -> MatRef<'_, f64> {
        self.b.as_ref()
    }

    /// The right-hand side.
    pub fn c(&self) -> &[f64] {
        &self.c
    }

    pub(crate) fn matrices(&self) -> (&Mat<f64>, &Mat<f64>) {
        (&self.a, &self.b)
    }

    /// Column `pair` of `A` or of `B`.
    pub(crate) fn column(&self, pair: usize, side: Side) -> &[f64] {
        match side {
            Side::T => self.a.col_as_slice(pair),
            Side::Y => self.b.col_as_slice(pair),
        }
    }

    /// Residuals of a point, dimensionless, from the original data.
    ///
    /// * equation: `|A t + B y - c|_i / (|A||t| + |B||y| + |c|)_i`, the largest over the rows.
    ///   A row whose terms are all at the rounding level of the point would divide noise by noise,
    ///   so the denominator is at least 2^-10 of the largest term that the row could have,
    ///   `max|A_i| max|t|` or `max|B_i| max|y|`.
    /// * feasibility, complementarity and natural: `t` is measured in units of `max t` and `y` in
    ///   units of `max y`.
    ///
    /// A NaN in the point makes the residuals infinite.
    ///
    /// # Panics
    /// If `t` or `y` does not have one entry for every pair.
    pub fn residuals(&self, t: &[f64], y: &[f64]) -> Residuals {
        let n = self.order();
        assert!(t.len() == n && y.len() == n, "a point has one entry for every pair");
        if t.iter().chain(y).any(|v| !v.is_finite()) {
            let inf = f64::INFINITY;
            return Residuals {
                equation: inf,
                feasibility: inf,
                complementarity: inf,
                natural: inf,
            };
        }
        let (t_max, y_max) = (max_abs(t), max_abs(y));
        let (feasibility, complementarity, natural) = pair_residuals(t, y, t_max, y_max);
        let equation = self.equation_residual(t, y, t_max, y_max);
        Residuals { equation, feasibility, complementarity, natural }
    }

    fn equation_residual(&self, t: &[f64], y: &[f64], t_max: f64, y_max: f64) -> f64 {
        const FLOOR: f64 = 1.0 / (1 << 10) as f64;
        let n = self.order();
        let mut sum: Vec<f64> = self.c.iter().map(|c| -c).collect();
        let mut size: Vec<f64> = self.c.iter().map(|c| c.abs()).collect();
        let mut largest = vec![0.0_f64; n];
        for (side, x, x_max) in [(Side::T, t, t_max), (Side::Y, y, y_max)] {
            for (pair, &x) in x.iter().enumerate() {
                let column = self.column(pair, side);
                for i in 0..n {
                    let v = column[i];
                    sum[i] += v * x;
                    size[i] += (v * x).abs();
                    largest[i] = largest[i].max(v.abs() * x_max);
                }
            }
        }
        (0..n).fold(0.0, |worst: f64, i| {
            let denominator = size[i].max(FLOOR * largest[i]);
            if denominator > 0.0 { worst.max(sum[i].abs() / denominator) } else { worst }
        })
    }
}

/// The standard linear complementarity problem `w = M z + q`, `z >= 0`, `w >= 0`, `z.w = 0`.
///
/// As a general problem `t = z`, `y = w`, `A = -M`, `B = 1`, `c = q`.
///
/// ```
/// use faer::mat;
/// use lcp::{Lcp, Lemke};
/// let lcp = Lcp::new(mat![[2.0, 1.0], [1.0, 2.0]], vec![-5.0, -6.0])?;
/// let solution = Lemke::default().solve(&lcp.into())?;
/// assert!((solution.t[0] - 4.0 / 3.0).abs() < 1e-15);
/// assert!((solution.t[1] - 7.0 / 3.0).abs() < 1e-15);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Lcp {
    m: Mat<f64>,
    q: Vec<f64>,
}

impl Lcp {
    /// A problem of order `n` from `M` (n x n) and `q` (n).
    ///
    /// # Errors
    /// [`Error::Shape`] when the shapes do not fit, [`Error::NotFinite`] for a NaN or an infinity.
    pub fn new(m: Mat<f64>, q: Vec<f64>) -> Result<Self, Error> {
        check_square("M", m.as_ref(), q.len())?;
        check_vector("q", &q)?;
        Ok(Self { m, q })
    }

    /// Number of pairs.
    pub fn order(&self) -> usize {
        self.q.len()
    }

    /// The matrix.
    pub fn m(&self) -> MatRef<'_, f64> {
        self.m.as_ref()
    }

    /// The vector.
    pub fn q(&self) -> &[f64] {
        &self.q
    }
}

impl From<Lcp> for HorizontalLcp {
    fn from(lcp: Lcp) -> Self {
        let n = lcp.order();
        Self { a: -lcp.m, b: Mat::identity(n, n), c: lcp.q }
    }
}

impl HorizontalLcp {
    /// The matrix of a complementary basis, with row `i` multiplied by `rows[i]` and the column of
    /// pair `j` by `columns(j, side)`.
    pub(crate) fn basis_matrix(
        &self,
        basis: &Basis,
        rows: &[f64],
        columns: impl Fn(usize, Side) -> f64,
    ) -> Mat<f64> {
        let n = self.order();
        let mut matrix = Mat::zeros(n, n);
        for (pair, &side) in basis.sides().iter().enumerate() {
            let scale = columns(pair, side);
            let out = matrix.col_as_slice_mut(pair);
            for ((out, v), row) in out.iter_mut().zip(self.column(pair, side)).zip(rows) {
                *out = row * v * scale;
            }
        }
        matrix
    }
}

fn pair_residuals(t: &[f64], y: &[f64], t_max: f64, y_max: f64) -> (f64, f64, f64) {
    let relative = |v: f64, max: f64| if max > 0.0 { v / max } else { 0.0 };
    let mut residuals = (0.0_f64, 0.0_f64, 0.0_f64);
    for (&t, &y) in t.iter().zip(y) {
        let (t, y) = (relative(t, t_max), relative(y, y_max));
        let least = t.min(y);
        residuals.0 = residuals.0.max(-least + 0.0);
        residuals.1 = residuals.1.max(least);
        residuals.2 = residuals.2.max(least.abs());
    }
    residuals
}

pub(crate) fn max_abs(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |max, x| max.max(x.abs()))
}

fn check_square(what: &'static str, m: MatRef<'_, f64>, n: usize) -> Result<(), Error> {
    if m.nrows() != n || m.ncols() != n {
        return Err(Error::Shape {
            what,
            rows: m.nrows(),
            cols: m.ncols(),
            expected_rows: n,
            expected_cols: n,
        });
    }
    for col in 0..n {
        for row in 0..n {
            let value = m[(row, col)];
            if !value.is_finite() {
                return Err(Error::NotFinite { what, row, col, value });
            }
        }
    }
    Ok(())
}

fn check_vector(what: &'static str, v: &[f64]) -> Result<(), Error> {
    match v.iter().position(|x| !x.is_finite()) {
        Some(row) => Err(Error::NotFinite { what, row, col: 0, value: v[row] }),
        None => Ok(()),
    }
}
