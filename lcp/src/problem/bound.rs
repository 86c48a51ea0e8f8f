//! Bounds of the distance of a point from the solution of a monotone problem.

use faer::{Mat, Side as Triangle};

use super::Lcp;
use crate::Error;
use crate::vector::{check_length, max_abs, norm};

/// The monotonicity of the problem `w = M z + q`, by the symmetric part of `M`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Monotonicity {
    /// Positive definite: there is exactly one solution, whatever `q`.
    Strong {
        /// A lower bound on the smallest eigenvalue of the symmetric part.
        modulus: f64,
    },
    /// Positive semidefinite up to rounding: the solutions form a convex set, empty only if the problem
    /// is infeasible.
    Weak,
    /// The problem is not monotone.
    None,
}

/// The error of a point. See [`Lcp::error_bound`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ErrorBound {
    /// The monotonicity of the problem.
    pub monotonicity: Monotonicity,
    /// Euclidean norm of the components of `z` that are set to zero to make the point complementary.
    pub moved: f64,
    /// Euclidean norm of the change of `q` that makes the complementary point an exact solution: its backward error.
    pub perturbation: f64,
    /// Bound of the Euclidean distance of the solution from `z`, if the problem is strongly monotone.
    pub distance: Option<f64>,
}

impl Lcp {
    /// The monotonicity of the problem, from the eigenvalues of the symmetric part of `M`. An eigenvalue within
    /// `n eps` of zero, relative to the largest, counts as zero.
    ///
    /// The cost is `O(n^3)`, and memory for a dense matrix.
    pub fn monotonicity(&self) -> Monotonicity {
        let n = self.order();
        let m = self.m().to_dense();
        let symmetric = Mat::from_fn(n, n, |i, j| 0.5 * m[(i, j)] + 0.5 * m[(j, i)]);
        let Ok(eigenvalues) = symmetric.self_adjoint_eigenvalues(Triangle::Lower) else {
            return Monotonicity::None;
        };
        let rounding = n as f64 * f64::EPSILON * max_abs(&eigenvalues);
        let least = eigenvalues.into_iter().fold(f64::INFINITY, f64::min);
        if n == 0 || least > 2.0 * rounding {
            Monotonicity::Strong { modulus: if n == 0 { 1.0 } else { least - rounding } }
        } else if least >= -rounding {
            Monotonicity::Weak
        } else {
            Monotonicity::None
        }
    }

    /// Bounds the backward error of `z >= 0` and, for a strongly monotone problem, its distance from the solution.
    ///
    /// The smaller of `z_i max|M e_i|` and `w_i` in every pair is set to zero, the first by moving `z` by `r`, the
    /// second by changing `q` by `v`. So `z - r` solves the problem with another `q`. Solutions of strongly monotone
    /// problems depend on `q` with the constant `1 / modulus`, so the solution is within `|r| + |v + M r| / modulus`
    /// of `z`. The rounding errors of computing `w` are included. If the problem is only monotone, every solution
    /// `s` satisfies `(z - r - s) M (z - r - s) <= perturbation |z - r - s|`.
    ///
    /// The cost is that of [`monotonicity`](Self::monotonicity).
    ///
    /// ```
    /// use faer::mat;
    /// use lcp::Lcp;
    /// let lcp = Lcp::new(mat![[2.0, 1.0], [1.0, 2.0]], vec![-5.0, -6.0])?;
    /// let bound = lcp.error_bound(&[1.3, 2.3])?.distance.expect("positive definite");
    /// let error = f64::hypot(4.0 / 3.0 - 1.3, 7.0 / 3.0 - 2.3);
    /// assert!(error <= bound && bound < 4.0 * error);
    /// # Ok::<(), lcp::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] if `z` has a wrong length, [`Error::Setting`] for a component that is negative or not a
    /// number.
    pub fn error_bound(&self, z: &[f64]) -> Result<ErrorBound, Error> {
        let n = self.order();
        check_length("z", z.len(), n)?;
        if let Some(&value) = z.iter().find(|&&z| !(z >= 0.0 && z.is_finite())) {
            return Err(Error::Setting { name: "z", value, range: "nonnegative and finite" });
        }
        let monotonicity = self.monotonicity();
        let mut w = self.q().to_vec();
        let mut size: Vec<f64> = w.iter().map(|q| q.abs()).collect();
        for (j, &z) in z.iter().enumerate() {
            self.m().slice(j).add_with_sizes(z, &mut w, &mut size);
        }
        let rounding = (n as f64 + 2.0) * f64::EPSILON;
        let largest = |j| self.m().column(j).map(|(_, v)| v.abs()).fold(0.0, f64::max);
        let stiffness: Vec<f64> = (0..n).map(largest).collect();
        let (mut r, mut v) = (vec![0.0; n], vec![0.0; n]);
        for i in 0..n {
            let error = rounding * size[i];
            if z[i] * stiffness[i] < w[i] {
                r[i] = z[i];
                v[i] = if w[i] >= error { 0.0 } else { error - w[i] };
            } else if z[i] > 0.0 {
                v[i] = w[i].abs() + error;
            } else {
                v[i] = (-w[i]).max(0.0) + error;
            }
        }
        for (j, &r) in r.iter().enumerate().filter(|(_, r)| **r > 0.0) {
            self.m().slice(j).for_each(|i, m| v[i] += (m * r).abs());
        }
        let (moved, perturbation) = (norm(r), norm(v));
        let distance = match monotonicity {
            Monotonicity::Strong { modulus } => Some(moved + perturbation / modulus),
            _ => None,
        };
        Ok(ErrorBound { monotonicity, moved, perturbation, distance })
    }
}
