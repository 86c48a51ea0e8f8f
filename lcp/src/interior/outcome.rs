//! The outcome of a convex program: its solution, or a proof that there is none.

use faer::sparse::FaerError;

use super::constants::BALANCINGS;
use super::dual::descend;
use super::homogeneous::{Accuracy, End, Homogeneous, iterate};
use super::program::{Program, ProgramFactors};
use super::variables::Variables;
use crate::Status;
use crate::certify::verdict;
use crate::vector::{ROUNDING, max_abs};

/// The outcome of a program, in the units in which the program is given.
pub(super) struct Outcome {
    /// [`Status::Infeasible`] if `u` and `t` are a confirmed proof that there is no solution.
    pub(super) status: Status,
    /// The residual of the point, from the data.
    pub(super) residual: f64,
    pub(super) u: Vec<f64>,
    pub(super) t: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) factorisations: usize,
}

impl Program {
    /// Solves the program, or ends as soon as `is_proof` confirms that `u` and `t` prove that it has no solution.
    /// `stop` is called before every step, with the residual.
    ///
    /// # Errors
    /// If memory does not suffice.
    pub(super) fn solve(
        self,
        accuracy: Accuracy,
        mut stop: impl FnMut(f64) -> Option<Status>,
        mut is_proof: impl FnMut(&[f64], &[f64]) -> bool,
    ) -> Result<Outcome, FaerError> {
        let (program, units) = self.scaled();
        let times = |v: &[f64], unit: f64| -> Vec<f64> { v.iter().map(|v| v * unit).collect() };
        let mut factors = ProgramFactors::of(&program)?;
        let is_proof =
            |at: &Variables| is_proof(&units.displacements(&at.u), &times(&at.t, units.force));
        let descent = descend(&program, &mut factors, accuracy, &mut stop);
        let descent = descent.map(|end| end.balanced(&program, &factors, accuracy));
        let End { at, status } = match descent {
            Some(end) if end.status != Status::Solved || end.balances(&program, accuracy) => end,
            _ => {
                let end = iterate(&program, &mut factors, accuracy, stop, is_proof);
                end.balanced(&program, &factors, accuracy)
            }
        };
        let now = Homogeneous::new(&program, at);
        let residual = now.residual(&now.defect(), accuracy);
        let (tolerance, at) = (accuracy.tolerance(), now.at);
        Ok(Outcome {
            status: if status == Status::Infeasible {
                status
            } else {
                verdict(residual, tolerance, status)
            },
            residual,
            u: units.displacements(&at.u),
            t: times(&at.t, units.force),
            y: times(&at.y, units.length),
            factorisations: factors.factorisations,
        })
    }
}

impl End {
    /// A solution, with the residual of its balance distributed if only the accuracy of forces is wanted.
    fn balanced(self, program: &Program, factors: &ProgramFactors, accuracy: Accuracy) -> Self {
        let (Status::Solved, Accuracy::OfForces(tolerance)) = (self.status, accuracy) else {
            return self;
        };
        let balanced = Homogeneous::new(program, balanced(program, factors, &self.at));
        let is_solution = balanced.residual(&balanced.defect(), accuracy) <= tolerance;
        if is_solution { Self { at: balanced.at, ..self } } else { self }
    }

    /// Whether the point is a solution whose forces balance the loads to more than their own last digits: forces of a
    /// problem without a solution grow until only their last digits balance the loads.
    fn balances(&self, program: &Program, accuracy: Accuracy) -> bool {
        let now = Homogeneous::new(program, self.at.clone());
        let (defect, load, tolerance) = (now.defect(), max_abs(&program.f), accuracy.tolerance());
        now.residual(&defect, accuracy) <= tolerance
            && (load <= 0.0 || max_abs(&defect.balance) <= tolerance * load)
    }
}

/// A solution of a program without stiffness whose forces balance its loads to the last digit of every row. The forces
/// are corrected by displacements of the springs of the last step, so that products of pairs stay.
fn balanced(program: &Program, factors: &ProgramFactors, at: &Variables) -> Variables {
    let lack = |t: &[f64]| {
        let mut rest = program.f.clone();
        program.add_forces(t, &mut rest);
        rest
    };
    let mut at = at.clone();
    let mut rest = lack(&at.t);
    // The largest residual may grow by rounding only, while the others are corrected.
    let most = max_abs(&rest).max(ROUNDING * max_abs(&at.t));
    for _ in 0..BALANCINGS {
        factors.gram.solve(&mut rest);
        let u: Vec<f64> = at.u.iter().zip(&rest).map(|(u, change)| u + change).collect();
        let pairs = at.t.iter().zip(&factors.stiffness).zip(program.opened(&rest));
        let t: Vec<f64> = pairs.map(|((t, s), change)| (t - s * change).max(0.0)).collect();
        rest = lack(&t);
        let left = max_abs(&rest);
        if left.is_nan() || left > most {
            break;
        }
        (at.u, at.t) = (u, t);
    }
    let forces = program.compliance.iter().zip(&at.t);
    let gaps = program.opened(&at.u).into_iter().zip(&program.x_0).zip(forces);
    at.y = gaps.map(|((opened, x), (c, t))| (opened + x + c * t).max(0.0)).collect();
    at
}
