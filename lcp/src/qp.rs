//! Convex quadratic programs: an interior-point method, and a polish that makes its answer exact.

mod anderson;
mod contact;
mod coulomb;
mod definite;
mod farkas;
mod form;
mod interior;
mod monotone;
mod polish;
mod program;
mod reduced;
mod scale;
mod settings;
mod soft;
mod start;

use std::time::Instant;

use coulomb::solve_contact;
use definite::indefiniteness;
use farkas::farkas_vector;
use form::{Form, Point};
use interior::{Effort, End};
use monotone::{MixedForm, standard_candidate, standard_form};
use program::{Assemble, Best, Candidate, Proof, solve_convex};
use scale::Scaled;
pub use settings::{ContactForm, QuadraticProgramSettings, SoftConstraints};
pub use soft::SoftSolution;
use start::Rows;

use crate::active::{confirmed_pairs, confirmed_state};
use crate::solve::Monitor;
use crate::{
    Certificate, Contact2d, Error, HorizontalLcp, Lcp, Method, MixedLcp, Observer, Residuals,
    Solution, Solver, Status,
};

/// Complementarity problems that are the conditions of a convex quadratic program.
///
/// * [`Lcp`] with `M` symmetric positive semidefinite: minimise `z M z / 2 + q z` for `z >= 0`;
///   [`HorizontalLcp`], where [`HorizontalLcp::to_standard`] recognises such a problem.
/// * [`MixedLcp`] with `M = [P, -G^T; G, S]`, `P` of the free variables, both `P` and `S` symmetric
///   positive semidefinite: minimise `u P u / 2 + z S z / 2 + p u` for `G u + S z + r >= 0`.
/// * [`Contact2d`]: minimise `u K u / 2 - f u` for gaps `C_n u + x_0 >= 0`, or the same in the forces
///   ([`ContactForm`]). Friction makes it a sequence of such programs: with the bounds `g` of the friction
///   forces frozen (Tresca) the work `g |C_t u + s_0|` is added, and `g` becomes `mu t_n`, accelerated
///   after Anderson, until it stays.
///
/// Symmetry and semidefiniteness are checked. Units are removed by powers of two, Clarabel's
/// interior-point method finds a point near the solution, and the **polish** makes it exact: of every pair
/// what is larger does not vanish, which leaves a linear system; where signs of its answer are wrong,
/// pairs change over, for a few rounds. The interior point alone is only good to the square root of its
/// tolerance where both variables of a pair vanish. The system may be singular but consistent, as for
/// bodies that float or contacts that share a load: proximal steps solve it. For friction it is the system of
/// the states open, stick and slip, so that the fixed point need only come near.
///
/// **Guarantee**: in exact arithmetic a program without friction that has a solution is solved, and one that
/// has none is [`Infeasible`](Status::Infeasible) with a proof, which is itself found as the solution of a
/// convex program. In floating-point numbers that holds as long as the stiffnesses of one problem differ by
/// less than about 1e6; at and beyond that many problems end without an answer and without a proof: see below.
/// For friction the fixed point contracts where `mu` or the ratio of tangential to normal stiffness is small;
/// where it does not, the status is [`Stalled`](Status::Stalled). In every case
/// [`Solved`](Status::Solved) and `Infeasible` are said only after a check in the data as given.
///
/// **Failure**: `Stalled` and [`NumericalTrouble`](Status::NumericalTrouble) for data so badly
/// conditioned that neither point nor proof comes out: where stiffnesses differ by 1e6 the interior point may be
/// too far off to tell which contacts are closed. Then [`Lemke`](crate::Lemke) and
/// [`InteriorPoint`](crate::InteriorPoint) are the methods to take, as [`Auto`](crate::Auto) does.
///
/// **Cost**: 10 to 20 factorisations of the sparse matrix `[K, C^T; C, -D]` for every program, and one for
/// every round of the polish. [`Info::iterations`](crate::Info::iterations) counts programs, and not the
/// iterations within them, which [`max_iterations`](QuadraticProgramSettings::max_iterations) limits;
/// [`Info::factorisations`](crate::Info::factorisations) counts all factorisations. The observer is asked before
/// every program. With [`soft`](QuadraticProgramSettings::soft) both count the times that the springs are
/// centred.
///
/// References: P. J. Goulart and Y. Chen, *Clarabel: an interior-point solver for conic programs with
/// quadratic objectives* (2024), arXiv:2405.12762; B. Stellato et al., *OSQP*, Math. Prog. Comp. 12
/// (2020), section 5.2, for the polish, DOI 10.1007/s12532-020-00179-2; J. Haslinger, *Approximation of the
/// Signorini problem with friction*, Math. Methods Appl. Sci. 5 (1983), for the fixed point; H. F. Walker and
/// P. Ni, *Anderson acceleration for fixed-point iterations*, SIAM J. Numer. Anal. 49 (2011), DOI
/// 10.1137/10078356X.
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

impl QuadraticProgram {
    /// A solver with these settings.
    pub fn new(settings: QuadraticProgramSettings) -> Self {
        Self { settings }
    }

    /// The settings.
    pub fn settings(&self) -> &QuadraticProgramSettings {
        &self.settings
    }

    /// Without springs, of a `K` that is known to be semidefinite.
    fn solve_plain(
        &self,
        contact: &Contact2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let settings = &self.settings;
        let began = Instant::now();
        let effort = || self.effort(began);
        let mut monitor = Monitor::new(settings.max_outer, settings.time_limit, observer);
        let form = contact::primal_form(contact);
        let assemble =
            |point: &Point, places: Option<&[_]>| contact::assemble(contact, point, places);
        if settings.form == ContactForm::Dual && !definite::is_definite(&form.p) {
            return Err(Error::NotTreated {
                method: Method::QuadraticProgram,
                reason:
                    "the dual form needs a positive definite K, and this one is singular, as of \
                         bodies that float: take the primal form"
                        .to_owned(),
            });
        }
        let search = || farkas_vector(&contact.to_general(), effort());
        let proof = Proof::new(&search);
        let scaled = Scaled::new(&form);
        let mut best = Best::new(&scaled, &assemble);
        let rows = Rows::of_contact(contact);
        rows.try_start(&settings.start, &scaled, &assemble, &mut best);
        let end = if best.residual <= settings.tolerance || form.rows() == 0 {
            best.polish_zero(&scaled, &assemble);
            monitor.stop(best.residual).map_or(Ok(End::Point), Err)
        } else if let Some(mut program) =
            contact::ContactProgram::new(form, settings.form, effort())
        {
            let limits = (settings.tolerance, &effort as &dyn Fn() -> Effort);
            solve_contact(contact, &mut program, limits, (&mut best, &mut monitor, &proof))
        } else {
            Ok(End::Failed)
        };
        let confirm = |it: &Candidate| confirmed(contact, it, settings.tolerance);
        Ok(self.concluded(best, end, &monitor, (proof, &confirm)))
    }

    fn solve_form(
        &self,
        form: &Form,
        (general, confirm): (&HorizontalLcp, &Confirm<'_>),
        (rows, assemble): (&Rows, &Assemble<'_>),
        observer: &mut Observer<'_>,
    ) -> Solution {
        let settings = &self.settings;
        let began = Instant::now();
        let mut monitor = Monitor::new(1, settings.time_limit, observer);
        let scaled = Scaled::new(form);
        let mut best = Best::new(&scaled, assemble);
        rows.try_start(&settings.start, &scaled, assemble, &mut best);
        let end = match monitor.stop(best.residual) {
            Some(status) => Err(status),
            None if best.residual <= settings.tolerance => {
                best.polish_zero(&scaled, assemble);
                Ok(End::Point)
            }
            None => {
                let end = solve_convex(&scaled, self.effort(began), assemble, &mut best);
                monitor.history.push(best.residual);
                Ok(end)
            }
        };
        let search = || farkas_vector(general, self.effort(began));
        self.concluded(best, end, &monitor, (Proof::new(&search), confirm))
    }

    /// The solution that the best point is, or the proof that there is none.
    fn concluded(
        &self,
        best: Best,
        end: Result<End, Status>,
        monitor: &Monitor<'_>,
        (proof, confirm): (Proof<'_>, &Confirm<'_>),
    ) -> Solution {
        let tolerance = self.settings.tolerance;
        let mut farkas = None;
        let confirmed = (best.residual <= tolerance).then(|| confirm(&best.candidate));
        let is_solved = confirmed.is_some_and(|residuals| residuals.worst() <= tolerance);
        let otherwise = match end {
            _ if is_solved => Status::Solved,
            Err(status @ (Status::Cancelled | Status::TimeLimit)) => status,
            Ok(End::TimeLimit) => Status::TimeLimit,
            Ok(End::IterationLimit) => Status::IterationLimit,
            Ok(End::Point | End::NoPoint | End::Failed) | Err(_) => {
                farkas = proof.into_farkas();
                match end {
                    _ if farkas.is_some() => Status::Infeasible,
                    Err(status) => status,
                    Ok(End::Failed) => Status::NumericalTrouble,
                    Ok(_) => Status::Stalled,
                }
            }
        };
        let Best { candidate, factorisations, .. } = best;
        let point = (candidate.t, candidate.y);
        let residuals = confirmed.unwrap_or(candidate.residuals);
        let otherwise = if is_solved { Status::Stalled } else { otherwise };
        let mut solution = Solution::judged(point, residuals, tolerance, otherwise);
        solution.contact = candidate.contact;
        solution.certificate = farkas.map(|pi| Certificate::Farkas { pi });
        solution.info.method = Method::QuadraticProgram;
        solution.info.iterations = monitor.iterations();
        solution.info.factorisations = factorisations;
        solution.info.history.clone_from(&monitor.history);
        solution.info.seconds = monitor.seconds();
        solution
    }

    fn confirmed_standard(&self, problem: &Lcp, z: &[f64], w: &[f64]) -> Residuals {
        let (m, q) = (problem.m().clone(), problem.q().to_vec());
        let mixed = MixedLcp::new(m, q, vec![false; problem.order()]);
        let tolerance = self.settings.tolerance;
        mixed.map_or(Residuals::infinite(), |mixed| confirmed_pairs(&mixed, (z, w), tolerance))
    }

    /// How exact the interior points have to be: the polish needs to tell apart what vanishes and what
    /// does not, and does the rest.
    fn effort(&self, began: Instant) -> Effort {
        let settings = &self.settings;
        Effort {
            tolerance: (1e-2 * settings.tolerance).clamp(1e-11, 1e-8),
            max_iterations: settings.max_iterations,
            time: settings.time_limit.map(|limit| limit.saturating_sub(began.elapsed())),
        }
    }
}

/// The residuals of a candidate that is about to be called solved.
type Confirm<'a> = dyn Fn(&Candidate) -> Residuals + 'a;

/// Of a contact problem.
fn confirmed(contact: &Contact2d, candidate: &Candidate, tolerance: f64) -> Residuals {
    let state = candidate.contact.as_ref();
    state.map_or(Residuals::infinite(), |state| confirmed_state(contact, state, tolerance))
}

fn refused(reason: &str) -> Error {
    Error::NotTreated {
        method: Method::QuadraticProgram,
        reason: format!("{reason}; take Lemke's method, which needs no quadratic program"),
    }
}

impl Solver<Lcp> for QuadraticProgram {
    fn method(&self) -> Method {
        Method::QuadraticProgram
    }

    fn solve_observed(
        &self,
        problem: &Lcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        let form = standard_form(problem).map_err(|reason| refused(&reason))?;
        let general = HorizontalLcp::from(problem.clone());
        let assemble = |point: &Point, places: Option<&[_]>| {
            standard_candidate(&form, &general, &|z, w| (z, w), (point, places))
        };
        let confirm = |it: &Candidate| self.confirmed_standard(problem, &it.t, &it.y);
        let rows = Rows::of_pairs(0..problem.order());
        Ok(self.solve_form(&form, (&general, &confirm), (&rows, &assemble), observer))
    }
}

/// Of problems that are standard ones in disguise.
impl Solver<HorizontalLcp> for QuadraticProgram {
    fn method(&self) -> Method {
        Method::QuadraticProgram
    }

    fn solve_observed(
        &self,
        problem: &HorizontalLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        let standard = problem.to_standard().ok_or_else(|| {
            refused(
                "it is no standard problem w = M z + q: not every pair has a column with one entry \
                 in a row of its own",
            )
        })?;
        let form = standard_form(standard.lcp()).map_err(|reason| refused(&reason))?;
        let to_pairs = |z: Vec<f64>, w: Vec<f64>| standard.to_pairs(&z, &w);
        let assemble = |point: &Point, places: Option<&[_]>| {
            standard_candidate(&form, problem, &to_pairs, (point, places))
        };
        let confirm = |it: &Candidate| {
            let (z, w) = standard.from_pairs(&it.t, &it.y);
            self.confirmed_standard(standard.lcp(), &z, &w)
        };
        let rows = Rows::of_standard(&standard);
        Ok(self.solve_form(&form, (problem, &confirm), (&rows, &assemble), observer))
    }
}

/// On the pairs of [`MixedLcp::to_general`].
impl Solver<MixedLcp> for QuadraticProgram {
    fn method(&self) -> Method {
        Method::QuadraticProgram
    }

    fn solve_observed(
        &self,
        problem: &MixedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        let mixed = MixedForm::new(problem).map_err(|reason| refused(&reason))?;
        let assemble =
            |point: &Point, places: Option<&[_]>| mixed.candidate(problem, point, places);
        let rows = Rows::of_pairs((0..problem.order()).filter(|&i| !problem.free()[i]));
        let confirm =
            |it: &Candidate| confirmed_pairs(problem, (&it.t, &it.y), self.settings.tolerance);
        let general = problem.to_general();
        Ok(self.solve_form(&mixed.form, (&general, &confirm), (&rows, &assemble), observer))
    }
}

impl Solver<Contact2d> for QuadraticProgram {
    fn method(&self) -> Method {
        Method::QuadraticProgram
    }

    fn solve_observed(
        &self,
        problem: &Contact2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        if let Some(reason) = indefiniteness("K", problem.stiffness()) {
            return Err(refused(&reason));
        }
        match self.settings.soft {
            Some(soft) => self.solve_recentred(problem, soft, observer),
            None => self.solve_plain(problem, observer),
        }
    }
}
