//! Certificates that a problem has no solution.

use super::Residuals;
use super::farkas::{is_proof, is_proof_of};
use super::judge::Precision;
use super::problems::GeneralJudge;
use crate::{HorizontalLcp, Side};

/// A proof that there is no solution, or the secondary ray found instead of a solution. See
/// [`Solution::certificate`](crate::Solution::certificate).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "kind", rename_all = "lowercase"))]
#[non_exhaustive]
pub enum Certificate {
    /// A proof that the linear conditions have no solution: a vector `pi` with one entry per row, with `A^T pi <= 0`,
    /// `B^T pi <= 0` and `c.pi > 0` (Farkas 1902). The largest entry of `pi` is one.
    Farkas {
        /// The vector.
        pi: Vec<f64>,
    },
    /// A proof that the linear conditions have no complementary solution: a Farkas vector for every choice of the
    /// variables that may be positive, one of each pair.
    Choices {
        /// One leaf for every set of choices; together they cover all choices.
        leaves: Vec<Leaf>,
    },
    /// A secondary ray on which Lemke's method ended, which proves nothing.
    Ray(Ray),
}

/// Choices of sides for which the linear conditions have no solution.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Leaf {
    /// The side of every pair that may be positive; `None` if both may.
    pub sides: Vec<Option<Side>>,
    /// A Farkas vector for the columns of these sides.
    pub pi: Vec<f64>,
}

/// The secondary ray on which an attempt ended.
///
/// `A dt + B dy = covering dz0` with `dt, dy, dz0 >= 0` and `dt.dy = 0`: for every `s >= 0` the last point of the
/// attempt plus `s (dt, dy, dz0)` satisfies `A t + B y = c + covering z0`, so that the artificial variable `z0` does
/// not decrease along the ray.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Ray {
    /// Direction in `t`.
    pub dt: Vec<f64>,
    /// Direction in `y`.
    pub dy: Vec<f64>,
    /// Rate of the artificial variable.
    pub dz0: f64,
    /// The covering vector in the rows of the problem.
    pub covering: Vec<f64>,
}

impl Certificate {
    /// Whether the certificate proves that there is no solution, if it [holds](Self::holds).
    pub fn is_proof(&self) -> bool {
        matches!(self, Self::Farkas { .. } | Self::Choices { .. })
    }

    /// Checks the certificate against the data of the general form of the problem. Products with the columns are
    /// summed in double-double arithmetic, with a tolerance for the rounding errors of the vector.
    ///
    /// ```
    /// use faer::mat;
    /// use lcp::{Certificate, HorizontalLcp, Lcp, Lemke, Solver, Status};
    /// // w = -1 whatever z
    /// let problem = HorizontalLcp::from(Lcp::new(mat![[0.0]], vec![-1.0])?);
    /// let solution = Lemke::default().solve(&problem)?;
    /// assert_eq!(solution.status, Status::Infeasible);
    /// assert!(solution.certificate.is_some_and(|it| it.is_proof() && it.holds(&problem)));
    /// assert!(!Certificate::Farkas { pi: vec![1.0] }.holds(&problem));
    /// # Ok::<(), lcp::Error>(())
    /// ```
    pub fn holds(&self, problem: &HorizontalLcp) -> bool {
        match self {
            Self::Farkas { pi } => is_proof(problem, pi),
            Self::Choices { leaves } => {
                let is_proof = |leaf: &Leaf| {
                    is_proof_of(problem.columns_of(&leaf.sides), problem.c(), &leaf.pi)
                };
                covers_all(leaves, problem.order()) && leaves.iter().all(is_proof)
            }
            Self::Ray(ray) => is_ray(problem, ray),
        }
    }
}

/// Whether every choice of one side of every pair belongs to exactly one leaf: no two leaves share a choice, and
/// their shares of all choices add up to one.
fn covers_all(leaves: &[Leaf], n: usize) -> bool {
    let are_apart = |a: &Leaf, b: &Leaf| {
        let mut pairs = a.sides.iter().zip(&b.sides);
        pairs.any(|(a, b)| matches!((a, b), (Some(a), Some(b)) if a != b))
    };
    let share = |leaf: &Leaf| {
        let fixed = leaf.sides.iter().filter(|side| side.is_some()).count();
        i32::try_from(fixed).map_or(0.0, |fixed| 2_f64.powi(-fixed))
    };
    leaves.iter().all(|leaf| leaf.sides.len() == n)
        && leaves.iter().enumerate().all(|(k, a)| leaves[..k].iter().all(|b| are_apart(a, b)))
        && (leaves.iter().map(share).sum::<f64>() - 1.0).abs() < f64::EPSILON
}

/// Whether `A dt + B dy = covering dz0`, nothing is negative, and `dt.dy = 0`, up to rounding errors.
fn is_ray(problem: &HorizontalLcp, ray: &Ray) -> bool {
    let n = problem.order();
    let Ray { dt, dy, dz0, covering } = ray;
    if [dt, dy, covering].iter().any(|v| v.len() != n) {
        return false;
    }
    let c: Vec<f64> = covering.iter().map(|d| d * dz0).collect();
    let sizes = c.iter().map(|c| c.abs()).collect();
    let judge = GeneralJudge::with_right_hand_side(problem, c, sizes);
    let Residuals { equation, .. } = judge.residuals(&[dt, dy], Precision::Quick);
    // A ray proves nothing: half of the digits are enough.
    let holds = equation <= f64::EPSILON.sqrt();
    let is_free = |pair: usize| problem.opposite(pair).is_some();
    let fits = |pair: usize| {
        dt[pair] >= 0.0 && dy[pair] >= 0.0 && (is_free(pair) || dt[pair].min(dy[pair]) == 0.0)
    };
    holds && *dz0 >= 0.0 && (0..n).all(fits)
}
