//! The standard form.

use super::HorizontalLcp;
use crate::vector::{check_length, check_vector};
use crate::{Error, Matrix, Vector};

/// The standard linear complementarity problem `w = M z + q`, `z >= 0`, `w >= 0`, `z.w = 0`.
///
/// The general problem has `t = z`, `y = w`, `A = -M`, `B = 1`, `c = q`.
///
/// ```
/// use lcp::{Lcp, Lemke, Solver};
/// let lcp = Lcp::new([[2.0, 1.0], [1.0, 2.0]], vec![-5.0, -6.0])?;
/// let solution = Lemke::default().solve(&lcp)?;
/// let (z, w) = lcp.variables(&solution);
/// assert!((z[0] - 4.0 / 3.0).abs() < 1e-15 && (z[1] - 7.0 / 3.0).abs() < 1e-15);
/// assert_eq!(w, [0.0, 0.0]);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Lcp {
    m: Matrix,
    q: Vec<f64>,
}

impl Lcp {
    /// A problem of order `n` from `M` (n x n) and `q` (n).
    ///
    /// # Errors
    /// [`Error::Shape`] if the sizes do not agree, [`Error::NotFinite`] for a NaN or an infinity.
    pub fn new(m: impl Into<Matrix>, q: impl Into<Vector>) -> Result<Self, Error> {
        let (m, q) = (m.into(), q.into().into_entries());
        m.check("M", q.len(), q.len())?;
        check_vector("q", &q)?;
        Ok(Self { m, q })
    }

    /// Number of pairs.
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

    /// Replaces the entries of `q`, without allocating.
    ///
    /// # Errors
    /// [`Error::Length`] or [`Error::NotFinite`]; `q` is then unchanged.
    pub fn set_q(&mut self, q: &[f64]) -> Result<(), Error> {
        check_length("q", q.len(), self.q.len())?;
        check_vector("q", q)?;
        self.q.copy_from_slice(q);
        Ok(())
    }
}

impl From<Lcp> for HorizontalLcp {
    fn from(lcp: Lcp) -> Self {
        let n = lcp.order();
        Self::from_parts(lcp.m.negated(), Matrix::identity(n), lcp.q)
    }
}
