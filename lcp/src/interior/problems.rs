//! The interior-point method on every kind of problem.

use super::kkt::KktProgram;
use super::{InteriorPoint, InteriorPointSettings};
use crate::active::unplanned;
use crate::certify::is_proof_of_mixed;
use crate::conversion::{judged_by, judged_point, solve_in_general_form, solve_in_standard_form};
use crate::solve::Monitor;
use crate::{
    BoxedLcp, Contact2d, Error, Friction2d, HorizontalLcp, Lcp, Method, MixedLcp, Observer,
    Solution, Solver, WarmStart,
};

impl Solver<Contact2d> for InteriorPoint {
    fn method(&self) -> Method {
        Method::Interior
    }

    fn solve_observed(
        &self,
        problem: &Contact2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.run(problem, observer)
    }
}

/// The solution is that of [`MixedLcp::to_general`].
///
/// Convex programs have steps of their own, if the crossover is switched off and the bounded variables act on the free ones
/// only, as forces do on bodies: a step factorises a matrix with the order of the free ones, and a homogeneous problem ends
/// at a solution or at a Farkas vector, [`Status::Infeasible`](crate::Status::Infeasible) (Andersen and Ye 1999).
impl Solver<MixedLcp> for InteriorPoint {
    fn method(&self) -> Method {
        Method::Interior
    }

    fn solve_observed(
        &self,
        problem: &MixedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let InteriorPointSettings { tolerance, crossover, max_iterations, time_limit, .. } =
            self.settings;
        let program = if crossover { None } else { KktProgram::of(problem) };
        let Some(program) = program else { return self.run(problem, observer) };
        self.settings.validate(problem.order())?;
        let mut monitor = Monitor::new(max_iterations, time_limit, observer);
        let mut factors = program.planned().map_err(|error| unplanned(Method::Interior, error))?;
        let is_proof = |pi: &[f64]| is_proof_of_mixed(problem, pi);
        let (z, w, status, certificate) =
            program.solved(&mut factors, tolerance, &mut monitor, is_proof);
        let factorisations = factors.factorisations;
        // The judge needs the space.
        drop((program, factors));
        let pairs = problem.to_pairs(&z, &w);
        let mut solution = judged_point(problem, pairs.0, pairs.1, tolerance, status);
        solution.certificate = certificate;
        solution.info = monitor.info(Method::Interior);
        solution.info.factorisations = factorisations;
        Ok(solution)
    }
}

impl Solver<Lcp> for InteriorPoint {
    fn method(&self) -> Method {
        Method::Interior
    }

    fn solve_observed(
        &self,
        problem: &Lcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let free = vec![false; problem.order()];
        let mixed = MixedLcp::new(problem.m().clone(), problem.q().to_vec(), free)?;
        self.run(&mixed, observer)
    }
}

impl Solver<Friction2d> for InteriorPoint {
    fn method(&self) -> Method {
        Method::Interior
    }

    fn solve_observed(
        &self,
        problem: &Friction2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let solution = self.solve_observed(problem.standard(), observer)?;
        Ok(judged_by(problem, solution, self.settings.tolerance))
    }
}

/// Problems that can be converted to the standard form ([`HorizontalLcp::to_standard`]).
impl Solver<HorizontalLcp> for InteriorPoint {
    fn method(&self) -> Method {
        Method::Interior
    }

    fn solve_observed(
        &self,
        problem: &HorizontalLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        let refused = || {
            Error::NotTreated {
            method: Method::Interior,
            reason:
                "it cannot be converted to the standard form: take Lemke's method, or give the mixed or \
                     the contact problem that it comes from"
                    .to_owned(),
        }
        };
        let (start, tolerance) = (&self.settings.start, self.settings.tolerance);
        solve_in_standard_form(problem, start, tolerance, refused, |lcp, start| {
            let settings = InteriorPointSettings { start, ..self.settings.clone() };
            Self::new(settings).solve_observed(lcp, observer)
        })
    }
}

/// Problems without free variables, by [`BoxedLcp::to_general`].
impl Solver<BoxedLcp> for InteriorPoint {
    fn method(&self) -> Method {
        Method::Interior
    }

    fn solve_observed(
        &self,
        problem: &BoxedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        solve_in_general_form(problem, self.settings.tolerance, |general, is_other| {
            let start = if is_other { WarmStart::None } else { self.settings.start.clone() };
            let settings = InteriorPointSettings { start, ..self.settings.clone() };
            Self::new(settings).solve_observed(general, observer)
        })
    }
}
