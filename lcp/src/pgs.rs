//! Projected Gauss-Seidel sweeps.

mod block;
mod coulomb;
mod delassus;
mod problems;
mod rows;
mod settings;
mod sweep;

pub use rows::{Constraint, MatrixRows, Rows};
pub use settings::ProjectedGaussSeidelSettings;

use std::ops::ControlFlow;

use sweep::{Sweeps, Swept};

use crate::solve::{Monitor, named};
use crate::{Error, Info, Method, Observer, Residuals, Solution, Status, WarmStart};

/// Projected Gauss-Seidel, with over-relaxation: for `w = M z + q` with bounds on `z`, and for contact
/// with friction.
///
/// A sweep solves each row in turn for its own variable and projects the variable onto its bounds,
/// `z_i <- mid(lower_i, z_i - omega w_i / M_ii, upper_i)`, with `w_i` from the newest `z`. The normal and the
/// tangential row of a contact with friction are solved together, as an exact 2 x 2 problem with Coulomb's law: open,
/// sticking, or sliding to either side. If none of these states applies, which requires a coefficient of friction above
/// `W_NN / |W_NT|` or an indefinite block, the normal force is corrected first, then the tangential one.
/// Over-relaxation divides the diagonal block by `omega`, so that forces within the cone stay there.
///
/// The point `z` with the part of `w` that its bounds allow is always feasible and complementary, so all of the error
/// is in the equation; for [`Contact2d`](crate::Contact2d) the error is in the gaps and slips of the displacements that
/// follow from the forces. The best point is returned.
///
/// # Problems
/// [`Lcp`](crate::Lcp); [`BoxedLcp`](crate::BoxedLcp) in the pairs of its general form;
/// [`HorizontalLcp`](crate::HorizontalLcp) if [`to_standard`](crate::HorizontalLcp::to_standard) applies;
/// [`Friction2d`](crate::Friction2d) by contacts; [`Contact2d`](crate::Contact2d) with positive definite `K`, by
/// contacts, on the matrix `C K^-1 C^T`, which is not formed; and any type that has [`Rows`], by
/// [`solve_rows`](Self::solve_rows). All relaxed rows must have positive diagonal entries, else the result is
/// [`Error::NotTreated`].
///
/// # Guarantee
/// The method converges linearly, if diagonals are positive, for symmetric positive definite `M` with `omega` in
/// `(0, 2)`, and for strictly diagonally dominant `M` with `omega` in `(0, 1]` (Cryer 1971; Cottle, Pang and Stone
/// 1992, section 5.2), and converges for symmetric positive semidefinite `M` if there is a solution (Luo and Tseng
/// 1991). These results hold for contact without friction.
///
/// # Failure
/// There is no guarantee with friction, nor for skew or indefinite parts: the iteration may cycle or diverge, and end
/// as [`Status::Stalled`]. Long chains of bodies and large differences of mass or stiffness are slow.
///
/// # Cost
/// A sweep is one product with the matrix. The number of sweeps grows with the condition of `M`, and every further digit costs
/// the same number.
///
/// # References
/// * Cryer, SIAM Journal on Control 9 (1971), [doi:10.1137/0309028](https://doi.org/10.1137/0309028)
/// * Luo, Tseng, SIAM Journal on Control and Optimization 29 (1991)
/// * Jean, Computer Methods in Applied Mechanics and Engineering 177 (1999), [doi:10.1016/S0045-7825(98)00383-1](https://doi.org/10.1016/S0045-7825(98)00383-1)
/// * Cottle, Pang, Stone, The Linear Complementarity Problem, 1992, chapter 5
///
/// ```
/// use lcp::{ProjectedGaussSeidel, Solver};
/// use lcp_problems::families;
/// let problem = families::obstacle(16).problem;
/// let solution = ProjectedGaussSeidel::default().solve(&problem)?;
/// assert!(solution.is_solved() && solution.residuals.worst() <= 1e-8);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProjectedGaussSeidel {
    settings: ProjectedGaussSeidelSettings,
}

/// The solution of a problem given by its [`Rows`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct RowsSolution {
    /// The status of the iteration at its end.
    pub status: Status,
    /// The point, which satisfies the constraints exactly.
    pub z: Vec<f64>,
    /// `M z + q`, computed anew.
    pub w: Vec<f64>,
    /// The largest part of a `w_i` that the constraints do not allow at `z`, relative to the larger of
    /// `|q_i| + sum_j |M_ij z_j|` ([`Rows::size`]) and 2^-10 of `M_ii max|z|`.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
    pub residual: f64,
    /// The cost.
    pub info: Info,
}

named!(ProjectedGaussSeidel, ProjectedGaussSeidelSettings, Method::GaussSeidel);

impl ProjectedGaussSeidel {
    /// Solves a problem given by the products of its rows, with constraints on the entries of `z`. If the settings
    /// have a point to start from, its `t` is `z`.
    ///
    /// # Errors
    /// [`Error::Length`] if `q` or the constraints have a wrong length, [`Error::Bounds`] or [`Error::Setting`] for a
    /// constraint that no value meets, [`Error::NotTreated`] for a row without a positive diagonal entry, and errors of
    /// the settings.
    pub fn solve_rows<R: Rows + ?Sized>(
        &self,
        rows: &mut R,
        q: &[f64],
        constraints: &[Constraint],
    ) -> Result<RowsSolution, Error> {
        self.solve_rows_observed(rows, q, constraints, &mut |_| ControlFlow::Continue(()))
    }

    /// Solves, and calls the observer before every sweep; `Break` stops with [`Status::Cancelled`].
    ///
    /// # Errors
    /// As for [`solve_rows`](Self::solve_rows).
    pub fn solve_rows_observed<R: Rows + ?Sized>(
        &self,
        rows: &mut R,
        q: &[f64],
        constraints: &[Constraint],
        observer: &mut Observer<'_>,
    ) -> Result<RowsSolution, Error> {
        let mut monitor = self.monitor(observer);
        let start = self.start(rows.order(), |t, _| t.to_vec())?;
        let sweeps = Sweeps::new(&self.settings, rows, q, constraints, start)?;
        let (best, status) = sweeps.run(&mut monitor, &mut |point, _| residuals_of_rows(point));
        let Swept { z, w, residuals, .. } = best;
        let (info, status) = (monitor.info(), residuals.verdict(self.settings.tolerance, status));
        Ok(RowsSolution { status, z, w, residual: residuals.worst(), info })
    }

    fn monitor<'a>(&self, observer: &'a mut Observer<'a>) -> Monitor<'a> {
        Monitor::new(
            Method::GaussSeidel,
            self.settings.max_iterations,
            self.settings.time_limit,
            observer,
        )
    }

    /// The start `z`, from the point `(t, y)` of the settings, which are checked for this number of pairs.
    fn start(
        &self,
        pairs: usize,
        z: impl Fn(&[f64], &[f64]) -> Vec<f64>,
    ) -> Result<Option<Vec<f64>>, Error> {
        self.settings.validate(pairs)?;
        match &self.settings.start {
            WarmStart::None => Ok(None),
            WarmStart::Point { t, y } => Ok(Some(z(t, y))),
            WarmStart::Basis(_) => Err(Self::not_treated(
                "sweeps cannot start from a basis: give a point, or take Lemke's method",
            )),
        }
    }

    fn not_treated(reason: impl Into<String>) -> Error {
        Error::NotTreated { method: Method::GaussSeidel, reason: reason.into() }
    }

    /// The solution with the pairs of the best point.
    fn solution(
        &self,
        t: Vec<f64>,
        y: Vec<f64>,
        residuals: Residuals,
        status: Status,
        monitor: Monitor<'_>,
    ) -> Solution {
        let mut solution = Solution::judged(t, y, residuals, self.settings.tolerance, status);
        solution.info = monitor.info();
        solution
    }
}

/// See [`RowsSolution::residual`].
fn residuals_of_rows(point: &Swept) -> Residuals {
    let rows = point.w.iter().zip(&point.allowed).zip(&point.sizes);
    let relative = rows.map(|((w, allowed), size)| {
        let error = (w - allowed).abs();
        if error > 0.0 { error / size } else { 0.0 }
    });
    let equation = relative.fold(0.0, f64::max);
    Residuals { equation, ..Residuals::default() }
}
