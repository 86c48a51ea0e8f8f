//! The matrix of the steps of a program.

use faer::sparse::FaerError;

use super::program::Program;
use crate::sparse::Gram;

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
}
