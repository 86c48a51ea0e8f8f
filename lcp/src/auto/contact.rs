//! The chains of contact with friction.

use super::facts::Facts;
use super::memory;
use super::method::{Effort, Method, Planned, Step, not_in_chain};
use super::standard::{common_steps, program_step};
use crate::{Contact2d, Error, Friction2d, Solution, Solver, WarmStart};

/// Up to so many contact points pivots are fast.
const FEW: usize = 500;

impl Planned for Friction2d {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn steps(&self) -> Vec<Step> {
        let facts = Facts::of(self.standard().m());
        let w = Facts::of(self.w());
        let mut steps = common_steps(&facts, None, w.has_positive_diagonal);
        for step in &mut steps {
            step.reason = format!("{} contacts, {}", self.contacts(), step.reason);
        }
        steps
    }

    fn attempt(&self, method: Method, effort: &Effort<'_>) -> Result<Solution, Error> {
        match method {
            Method::Lemke => {
                memory::check(self.standard().m().is_sparse(), self.order())?;
                Solver::<Self>::solve(&effort.lemke(), self)
            }
            Method::InteriorPoint => effort.interior_point().solve(self),
            Method::ProjectedGaussSeidel => effort.sweeps().solve(self),
            other => Err(not_in_chain(other)),
        }
    }
}

impl Planned for Contact2d {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn steps(&self) -> Vec<Step> {
        let (points, friction) = (self.points(), self.frictional().len());
        let text = format!(
            "{points} contact points, {friction} of them with friction, {} displacements",
            self.displacements()
        );
        let step = |method, words: &str| Step::new(method, format!("{text}: {words}"));
        let inside = step(
            Method::InteriorPoint,
            "the interior-point method for contact takes tens of sparse factorisations",
        );
        let program = if friction == 0 {
            format!("{text}: a convex quadratic program, if K is positive semidefinite")
        } else {
            format!("{text}: a sequence of quadratic programs with the friction forces held")
        };
        let sweeps = step(
            Method::ProjectedGaussSeidel,
            "sweeps over the contacts, if K is positive definite, promise little",
        );
        let pivots = |words| step(Method::Lemke, words);
        let is_small = points <= FEW;
        let program = program_step(Some(program));
        let mut steps = vec![inside];
        if is_small && friction > 0 {
            steps.push(pivots("pivots are fast, need no convergence and may find a proof"));
            steps.extend(program);
            steps.push(sweeps);
        } else {
            steps.extend(program);
            if is_small {
                steps.push(pivots("pivots are fast, need no convergence and may find a proof"));
                steps.push(sweeps);
            } else {
                steps.push(sweeps);
                steps.push(pivots("pivots take long at this number, but need no convergence"));
            }
        }
        steps
    }

    fn attempt(&self, method: Method, effort: &Effort<'_>) -> Result<Solution, Error> {
        match method {
            // A start has the pairs of the general problem, and this works on others.
            Method::Lemke => Solver::<Self>::solve(&effort.from(&WarmStart::None).lemke(), self),
            Method::InteriorPoint => effort.interior_point().solve(self),
            #[cfg(feature = "clarabel")]
            Method::QuadraticProgram => effort.quadratic_program().solve(self),
            Method::ProjectedGaussSeidel => effort.sweeps().solve(self),
            other => Err(not_in_chain(other)),
        }
    }

    fn is_worth_a_proof(&self, method: Method) -> bool {
        self.points() <= FEW
            || program_step(Some(String::new())).is_some_and(|it| it.method == method)
    }
}
