//! The chains of contact with friction.

use super::constants::{FEW_POINTS, VERY_FEW_POINTS};
use super::facts::Facts;
use super::method::{Effort, Planned, Step, named};
use super::standard::{common_steps, program_step};
use crate::definite::is_definite;
use crate::{Contact2d, Friction2d, Method, Solver};

impl Planned for Friction2d {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn is_sparse(&self) -> bool {
        self.standard().m().is_sparse()
    }

    fn steps(&self) -> Vec<Step> {
        let facts = Facts::of(self.standard().m());
        let w = Facts::of(self.w());
        let steps = common_steps(&facts, None, w.has_positive_diagonal);
        named(&format!("{} contacts", self.contacts()), steps)
    }

    fn solver(&self, method: Method, effort: &Effort<'_>) -> Option<Box<dyn Solver<Self>>> {
        match method {
            Method::GaussSeidel => Some(Box::new(effort.sweeps())),
            _ => effort.common(method),
        }
    }
}

impl Planned for Contact2d {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn is_sparse(&self) -> bool {
        true
    }

    fn steps(&self) -> Vec<Step> {
        let (points, friction) = (self.points(), self.frictional().len());
        let text = format!(
            "{points} contact points, {friction} of them with friction, {} displacements",
            self.displacements()
        );
        let step = |method, words: &str| Step::new(method, format!("{text}: {words}"));
        let inside = step(
            Method::Interior,
            "the interior-point method for contact takes tens of sparse factorisations",
        );
        let program = if friction == 0 {
            format!("{text}: a convex quadratic program, if K is positive semidefinite")
        } else {
            format!("{text}: a sequence of quadratic programs with the friction forces held")
        };
        let sweeps = step(
            Method::GaussSeidel,
            "sweeps over the contacts, if K is positive definite, promise little",
        );
        let program = program_step(Some(program));
        let pivots = step(
            Method::Lemke,
            if points <= FEW_POINTS {
                "pivots are fast, need no convergence and may find a proof"
            } else {
                "pivots take long at this number, but need no convergence"
            },
        );
        let in_order = |steps: [Option<Step>; 4]| steps.into_iter().flatten().collect();
        let (pivots, inside, sweeps) = (Some(pivots), Some(inside), Some(sweeps));
        // Bodies with mass, or held by springs, have a solution: there is no proof to be found.
        if points <= VERY_FEW_POINTS && !is_definite(self.stiffness()) {
            in_order([pivots, inside, program, sweeps])
        } else if points <= FEW_POINTS {
            in_order([inside, program, pivots, sweeps])
        } else {
            in_order([inside, program, sweeps, pivots])
        }
    }

    fn solver(&self, method: Method, effort: &Effort<'_>) -> Option<Box<dyn Solver<Self>>> {
        match method {
            #[cfg(feature = "clarabel")]
            Method::QuadraticProgram => Some(Box::new(effort.quadratic_program())),
            Method::GaussSeidel => Some(Box::new(effort.sweeps())),
            _ => effort.common(method),
        }
    }

    fn is_worth_a_proof(&self, method: Method) -> bool {
        let is_cheap = !matches!(method, Method::Lemke | Method::GaussSeidel);
        self.points() <= FEW_POINTS || is_cheap
    }
}
