//! The matrix of the steps of a program.

use faer::sparse::FaerError;

use super::constants::BALANCINGS;
use super::program::Program;
use super::variables::Variables;
use crate::sparse::Gram;
use crate::vector::{ROUNDING, max_abs};

/// The matrix of the steps of a program: order, pattern and factors.
pub(super) struct Factors {
    pub(super) gram: Gram,
    /// The springs in the place of the pairs that the factors are of.
    pub(super) stiffness: Vec<f64>,
    pub(super) factorisations: usize,
}

impl Factors {
    pub(super) fn of(program: &Program) -> Result<Self, FaerError> {
        let gram = Gram::new(Some(program.k.symbolic()), program.a.symbolic())?;
        Ok(Self { gram, stiffness: Vec::new(), factorisations: 0 })
    }

    /// `None` where numbers overflow.
    pub(super) fn factorise(
        &mut self,
        program: &Program,
        stiffness: Vec<f64>,
        spring: f64,
    ) -> Option<()> {
        let (k, a) = (program.k.as_ref(), program.a.as_ref());
        self.gram.factorise(Some(k), a, &stiffness, spring).ok()?;
        self.stiffness = stiffness;
        self.factorisations += 1;
        Some(())
    }

    /// A solution of a program without stiffness whose forces balance its loads to the last digit of every row, by those of
    /// the springs of the last step: displacements of these change forces so that products of pairs stay.
    pub(super) fn balanced(&self, program: &Program, at: &Variables) -> Variables {
        let lack = |t: &[f64]| {
            let mut rest = program.f.clone();
            program.add_forces(t, &mut rest);
            rest
        };
        let mut at = at.clone();
        let mut rest = lack(&at.t);
        // The largest does not grow but for rounding; the others are made good beside it.
        let most = max_abs(&rest).max(ROUNDING * max_abs(&at.t));
        for _ in 0..BALANCINGS {
            self.gram.solve(&mut rest);
            let u: Vec<f64> = at.u.iter().zip(&rest).map(|(u, change)| u + change).collect();
            let pairs = at.t.iter().zip(&self.stiffness).zip(program.opened(&rest));
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
}
