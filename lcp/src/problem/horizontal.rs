//! The general (horizontal) form.

use crate::matrix::Column;
use crate::vector::{check_length, check_vector};
use crate::{Error, Matrix, Side, Vector};

/// The general (horizontal) linear complementarity problem
/// `A t + B y = c`, `t >= 0`, `y >= 0`, `t.y = 0`, with square `A` and `B` of order `n`.
///
/// Both matrices may be singular, and each may be dense or sparse. A pair whose columns are opposite, `B_i = -A_i`, is
/// treated as a free variable `t_i - y_i`.
///
/// ```
/// use faer::mat;
/// use lcp::{HorizontalLcp, Lemke, Solver};
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
    a: Matrix,
    b: Matrix,
    c: Vec<f64>,
}

impl HorizontalLcp {
    /// A problem of order `n` from `A` (n x n), `B` (n x n) and `c` (n).
    ///
    /// # Errors
    /// [`Error::Shape`] if the sizes do not agree, [`Error::NotFinite`] for a NaN or an infinity.
    pub fn new(
        a: impl Into<Matrix>,
        b: impl Into<Matrix>,
        c: impl Into<Vector>,
    ) -> Result<Self, Error> {
        let (a, b, c) = (a.into(), b.into(), c.into().into_entries());
        let n = c.len();
        a.check("A", n, n)?;
        b.check("B", n, n)?;
        check_vector("c", &c)?;
        Ok(Self { a, b, c })
    }

    /// A problem from parts that are known to have matching sizes and to be finite.
    pub(crate) fn from_parts(a: Matrix, b: Matrix, c: Vec<f64>) -> Self {
        Self { a, b, c }
    }

    /// Number of pairs.
    pub fn order(&self) -> usize {
        self.c.len()
    }

    /// The matrix of `t`.
    pub fn a(&self) -> &Matrix {
        &self.a
    }

    /// The matrix of `y`.
    pub fn b(&self) -> &Matrix {
        &self.b
    }

    /// The right-hand side.
    pub fn c(&self) -> &[f64] {
        &self.c
    }

    /// The same problem for another right-hand side.
    ///
    /// # Errors
    /// [`Error::Length`] for a wrong length, [`Error::NotFinite`] for a NaN or an infinity.
    pub fn with_right_hand_side(&self, c: Vec<f64>) -> Result<Self, Error> {
        check_length("c", c.len(), self.order())?;
        check_vector("c", &c)?;
        Ok(Self { a: self.a.clone(), b: self.b.clone(), c })
    }

    /// Whether both matrices are sparse.
    pub fn is_sparse(&self) -> bool {
        self.a.is_sparse() && self.b.is_sparse()
    }

    /// Column `pair` of `A` or of `B`.
    pub(crate) fn column(&self, pair: usize, side: Side) -> Column<'_> {
        side.of(&self.a, &self.b).slice(pair)
    }

    /// All columns, first those of `A`, then those of `B`.
    pub(crate) fn columns(&self) -> Vec<Column<'_>> {
        self.columns_of(&vec![None; self.order()]).collect()
    }

    /// The columns of the sides that may be positive, first those of `A`, then those of `B`; a side `None` has both
    /// columns.
    pub(crate) fn columns_of(&self, sides: &[Option<Side>]) -> impl Iterator<Item = Column<'_>> {
        [Side::T, Side::Y].into_iter().flat_map(move |side| {
            let allowed =
                sides.iter().enumerate().filter(move |(_, it)| it.is_none_or(|it| it == side));
            allowed.map(move |(pair, _)| self.column(pair, side))
        })
    }

    /// The positive `r` with `B_j = -r A_j` of a free pair, entry by entry up to rounding: one unit of `y` is `r` units
    /// of `-t`.
    pub(crate) fn opposite(&self, pair: usize) -> Option<f64> {
        const ROUNDING: f64 = 4.0 * f64::EPSILON;
        let mut a = self.a.column(pair).filter(|(_, v)| *v != 0.0);
        let mut b = self.b.column(pair).filter(|(_, v)| *v != 0.0);
        // Most pairs are excluded by their first entries, without a pass over the others.
        let ((i, a_first), (j, b_first)) = (a.next()?, b.next()?);
        let ratio = -b_first / a_first;
        if i != j || ratio <= 0.0 {
            return None;
        }
        loop {
            match (a.next(), b.next()) {
                (None, None) => return Some(ratio),
                (Some((i, a)), Some((j, b)))
                    if i == j && (b + ratio * a).abs() <= ROUNDING * b.abs() => {}
                _ => return None,
            }
        }
    }
}
