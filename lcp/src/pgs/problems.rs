//! The problems of the library.

use super::delassus::Delassus;
use super::rows::{interleaved, parted};
use super::{Constraint, MatrixRows, ProjectedGaussSeidel, Sweeps};
use crate::certify::{BoxedJudge, ContactJudge, GeneralJudge, Precision};
use crate::conversion::standard_form;
use crate::{
    BoxedLcp, Contact2d, ContactForces, Error, Friction2d, HorizontalLcp, Lcp, Method, Observer,
    Solution, Solver,
};
impl Solver<Lcp> for ProjectedGaussSeidel {
    fn solve_pairs(&self, problem: &Lcp, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        let (lower, upper) = (vec![0.0; problem.order()], vec![f64::INFINITY; problem.order()]);
        let boxed = BoxedLcp::new(problem.m().clone(), problem.q().to_vec(), lower, upper)?;
        Ok(Solution { boxed: None, ..self.solve_pairs(&boxed, observer)? })
    }
}

/// The answer is judged by the problem as given.
impl Solver<HorizontalLcp> for ProjectedGaussSeidel {
    fn solve_pairs(
        &self,
        problem: &HorizontalLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let standard = standard_form(Method::GaussSeidel, problem)?;
        let mut monitor = self.monitor(observer);
        let start = self.start(problem.order(), |t, y| standard.to_pairs(t, y).0)?;
        let mut rows = MatrixRows::new(standard.lcp().m());
        let constraints = vec![Constraint::NONNEGATIVE; problem.order()];
        let q = standard.lcp().q();
        let sweeps = Sweeps::new(&self.settings, &mut rows, q, &constraints, start)?;
        let judge = GeneralJudge::new(problem);
        let (best, status) = sweeps.run(&mut monitor, &mut |point, _| {
            let (t, y) = standard.to_pairs(&point.z, &point.allowed);
            judge.residuals(&[&t, &y], Precision::Exact)
        });
        let (t, y) = standard.to_pairs(&best.z, &best.allowed);
        Ok(self.solution(t, y, best.residuals, status, monitor))
    }
}

/// The solution has the pairs of [`BoxedLcp::to_general`].
impl Solver<BoxedLcp> for ProjectedGaussSeidel {
    fn solve_pairs(
        &self,
        problem: &BoxedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let mut monitor = self.monitor(observer);
        let start = self.start(problem.pairs(), |t, y| problem.recover(t, y).0)?;
        let bounds = problem.lower().iter().zip(problem.upper());
        let constraints: Vec<Constraint> =
            bounds.map(|(&lower, &upper)| Constraint::Bounds { lower, upper }).collect();
        let mut rows = MatrixRows::new(problem.m());
        let sweeps = Sweeps::new(&self.settings, &mut rows, problem.q(), &constraints, start)?;
        let judge = BoxedJudge::of_boxed(problem);
        let (best, status) = sweeps.run(&mut monitor, &mut |point, _| {
            judge.residuals(&[&point.z, &point.allowed], Precision::Exact)
        });
        let (t, y) = problem.to_pairs(&best.z, &best.allowed);
        let solution = self.solution(t, y, best.residuals, status, monitor);
        Ok(Solution { boxed: Some((best.z, best.allowed)), ..solution })
    }
}

/// The solution has the pairs of [`Friction2d::standard`].
impl Solver<Friction2d> for ProjectedGaussSeidel {
    fn solve_pairs(
        &self,
        problem: &Friction2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let mut monitor = self.monitor(observer);
        let start = self.start(problem.order(), |t, _| {
            let ContactForces { normal, tangential } = problem.forces(t);
            interleaved(&normal, &tangential)
        })?;
        let mut rows = MatrixRows::new(problem.w());
        let constraints = cones(problem.mu());
        let sweeps = Sweeps::new(&self.settings, &mut rows, problem.q(), &constraints, start)?;
        let (best, status) = sweeps.run(&mut monitor, &mut |point, _| {
            let [normal, tangential] = parted(&point.z);
            problem.residuals(&ContactForces { normal, tangential })
        });
        let (t, y) = problem.to_pairs(&best.z, &best.allowed);
        Ok(self.solution(t, y, best.residuals, status, monitor))
    }
}

/// The unknowns are the forces, and the solution has the pairs of [`Contact2d::to_general`]: the displacements follow
/// from the forces if `K` is positive definite, and the compliances of the contacts are on the diagonal. Bodies that
/// `K` does not couple are eliminated one by one.
impl Solver<Contact2d> for ProjectedGaussSeidel {
    fn solve_pairs(
        &self,
        problem: &Contact2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let mut monitor = self.monitor(observer);
        let start = self.start(problem.order(), |t, y| {
            let state = problem.recover(t, y);
            interleaved(&state.t_n, &state.t_t)
        })?;
        let mut rows = Delassus::new(problem)?;
        let free = rows.state(&vec![0.0; 2 * problem.points()]);
        let q = interleaved(&free.gap, &free.slip);
        let constraints = cones(problem.mu());
        let sweeps = Sweeps::new(&self.settings, &mut rows, &q, &constraints, start)?;
        let judge = ContactJudge::new(problem);
        let (best, status) = sweeps.run(&mut monitor, &mut |point, rows| {
            judge.residuals(&rows.state(&point.z).parts(), Precision::Exact)
        });
        let state = rows.state(&best.z);
        let (t, y) = problem.to_pairs(&state);
        let mut solution = self.solution(t, y, best.residuals, status, monitor);
        solution.info.factorisations = rows.factorisations();
        Ok(Solution { contact: Some(state), ..solution })
    }
}

fn cones(mu: &[f64]) -> Vec<Constraint> {
    mu.iter().map(|&mu| Constraint::Friction { mu }).collect()
}
