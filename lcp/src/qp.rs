//! Convex quadratic programs: an interior-point method, and the exact solutions by states of contacts that follow from
//! its points.

mod constants;
mod contact;
mod coulomb;
mod farkas;
mod form;
mod interior;
mod monotone;
mod program;
mod settings;
mod soft;

use contact::{contact_form, forces};
use coulomb::solve_programs;
use form::{Form, ProgramPoint};
use interior::{End, Interior};
use monotone::MixedProgram;
use program::ProgramRun;
pub use settings::{QuadraticProgramSettings, SoftConstraints};
pub use soft::SoftSolution;

use crate::conversion::{solve_in_mixed_form, solve_in_standard_form};
use crate::solve::named;
use crate::states::Scaled;
use crate::{
    BoxedLcp, Contact2d, Error, HorizontalLcp, Lcp, Method, MixedLcp, Observer, Solution, Solver,
};

/// Complementarity problems that are the conditions of a convex quadratic program.
///
/// * [`Lcp`] with `M` symmetric positive semidefinite: minimise `z M z / 2 + q z` for `z >= 0`;
///   [`HorizontalLcp`], if [`HorizontalLcp::to_standard`] recognises such a problem.
/// * [`MixedLcp`] with `M = [P, -G^T; G, S]`, both `P` and `S` symmetric positive semidefinite, whatever is free: minimise
///   `u P u / 2 + z S z / 2 + p u` for `G u + S z + r >= 0`, or `= 0` if the variable of the row is free. Such an [`Lcp`] is
///   treated, too.
/// * [`BoxedLcp`] with such an `M`: its bounds become rows of a mixed problem.
/// * [`Contact2d`]: minimise `u K u / 2 - f u` for gaps `C_n u + x_0 >= 0`. A problem with friction is a sequence of
///   such programs: the work `g |C_t u + s_0|` of friction forces with fixed bounds `g` (Tresca) is added, and `g` goes half
///   the way to `mu t_n`, until it converges.
///
/// Symmetry and semidefiniteness are checked. Clarabel's interior-point method finds a point near the solution, which
/// the **exchange of states** makes exact, as for [`InteriorPoint`](crate::InteriorPoint): the larger variable of every
/// pair is taken as nonzero, which gives a linear system; pairs with wrong signs are exchanged, as long as their number
/// decreases. The page `docs/methods/quadratic_programs.md` has the details.
///
/// **Guarantee**: in exact arithmetic a program without friction is solved if it has a solution, and is otherwise
/// [`Infeasible`](crate::Status::Infeasible) with a proof, by the interior-point method for least forces. In
/// floating-point arithmetic this holds as long as the stiffnesses of one problem differ by less than about 1e6. The
/// fixed-point iteration for friction contracts if `mu` or the ratio of tangential to normal stiffness is small;
/// otherwise the status is [`Stalled`](crate::Status::Stalled).
///
/// **Failure**: `Stalled` and [`NumericalTrouble`](crate::Status::NumericalTrouble) for data so ill-conditioned that
/// neither a solution nor a proof is found. [`Lemke`](crate::Lemke) or [`InteriorPoint`](crate::InteriorPoint) should
/// then be used, as by [`Auto`](crate::Auto).
///
/// **Cost**: 10 to 20 factorisations of the sparse matrix `[K, C^T; C, -D]` for every program, and one for every
/// round of exchanges. [`Info::iterations`](crate::Info::iterations) and the observer count programs, or, with
/// [`soft`](QuadraticProgramSettings::soft), re-centrings of the springs;
/// [`Info::factorisations`](crate::Info::factorisations) counts all factorisations.
///
/// References: P. J. Goulart and Y. Chen, *Clarabel: an interior-point solver for conic programs with
/// quadratic objectives* (2024), arXiv:2405.12762; J. Haslinger, *Approximation of the
/// Signorini problem with friction*, Math. Methods Appl. Sci. 5 (1983), for the fixed point.
///
/// ```
/// use faer::mat;
/// use lcp::{Lcp, QuadraticProgram, Solver};
/// // Both variables of the second pair vanish.
/// let m = mat![[2.0, 1.0, 0.0], [1.0, 2.0, 1.0], [0.0, 1.0, 2.0]];
/// let lcp = Lcp::new(m, vec![-1.0, -1.0, -1.0])?;
/// let solution = QuadraticProgram::default().solve(&lcp)?;
/// assert!(solution.is_solved());
/// assert!(solution.t[1].abs() < 1e-14 && (solution.t[0] - 0.5).abs() < 1e-14);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct QuadraticProgram {
    settings: QuadraticProgramSettings,
}

named!(QuadraticProgram, QuadraticProgramSettings, Method::QuadraticProgram);

impl QuadraticProgram {
    /// Solves a problem without springs, with a `K` that is known to be semidefinite.
    fn solve_plain(
        &self,
        contact: &Contact2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let settings = &self.settings;
        let general = || contact.to_general();
        let run = ProgramRun::new(settings, contact, &general, settings.max_outer, observer)?;
        let form = contact_form(&run.search.scaled);
        let to_scaled =
            |scaled: &Scaled, point: &ProgramPoint| (point.x.clone(), forces(scaled, point));
        Ok(self.solve_form(run, form, to_scaled))
    }

    fn solve_form(
        &self,
        mut run: ProgramRun<'_>,
        form: Form,
        to_scaled: impl Fn(&Scaled, &ProgramPoint) -> (Vec<f64>, Vec<(f64, f64)>),
    ) -> Solution {
        let end = if run.is_tried(&form) {
            run.monitor.stop(run.search.residual()).map_or(Ok(End::ProgramPoint), Err)
        } else if let Some(mut program) = Interior::new(form, self.settings.max_iterations) {
            solve_programs(&mut run, &mut program, to_scaled)
        } else {
            Ok(End::Failed)
        };
        run.finish(end)
    }

    /// Solves a mixed problem, with a proof in the rows of a general one.
    fn solve_mixed(
        &self,
        problem: &MixedLcp,
        general: &dyn Fn() -> HorizontalLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        let run = ProgramRun::new(&self.settings, problem, general, 1, observer)?;
        let mixed = MixedProgram::new(problem, &run.search.scaled).map_err(|it| refused(&it))?;
        let to_scaled = |scaled: &Scaled, point: &ProgramPoint| mixed.to_scaled(scaled, point);
        Ok(self.solve_form(run, mixed.form.clone(), to_scaled))
    }
}

fn refused(reason: &str) -> Error {
    Error::NotTreated {
        method: Method::QuadraticProgram,
        reason: format!("{reason}; take Lemke's method, which needs no quadratic program"),
    }
}
impl Solver<Lcp> for QuadraticProgram {
    fn solve_pairs(&self, problem: &Lcp, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        let mixed = MixedLcp::of_standard(problem)?;
        self.solve_mixed(&mixed, &|| problem.clone().into(), observer)
    }
}

/// The problem must have a standard form.
impl Solver<HorizontalLcp> for QuadraticProgram {
    fn solve_pairs(
        &self,
        problem: &HorizontalLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        let (start, tolerance) = (&self.settings.start, self.settings.tolerance);
        solve_in_standard_form(Method::QuadraticProgram, problem, start, tolerance, |lcp, start| {
            let solver = Self::new(QuadraticProgramSettings { start, ..self.settings.clone() });
            solver.solve_mixed(&MixedLcp::of_standard(lcp)?, &|| problem.clone(), observer)
        })
    }
}

/// The solution has the pairs of [`MixedLcp::to_general`].
impl Solver<MixedLcp> for QuadraticProgram {
    fn solve_pairs(
        &self,
        problem: &MixedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.solve_mixed(problem, &|| problem.to_general(), observer)
    }
}

/// The problem is solved in mixed form, by the distances from bounds.
impl Solver<BoxedLcp> for QuadraticProgram {
    fn solve_pairs(
        &self,
        problem: &BoxedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let QuadraticProgramSettings { start, tolerance, .. } = &self.settings;
        solve_in_mixed_form(problem, start, *tolerance, |mixed, start| {
            let solver = Self::new(QuadraticProgramSettings { start, ..self.settings.clone() });
            solver.solve_pairs(mixed, observer)
        })
    }
}

impl Solver<Contact2d> for QuadraticProgram {
    fn solve_pairs(
        &self,
        problem: &Contact2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        match self.settings.soft {
            Some(soft) => self.solve_recentred(problem, soft, observer),
            None => self.solve_plain(problem, observer),
        }
    }
}
