//! What changes from step to step: loads, gaps, and slips by supports that move.

use crate::Contact2d;

/// The loads, gaps and slips without displacements of a problem.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Data {
    pub(super) f: Vec<f64>,
    pub(super) x_0: Vec<f64>,
    pub(super) s_0: Vec<f64>,
}

impl Data {
    pub(super) fn of(problem: &Contact2d) -> Self {
        Self {
            f: problem.loads().to_vec(),
            x_0: problem.initial_gaps().to_vec(),
            s_0: problem.initial_slips().to_vec(),
        }
    }

    /// A part of the way to other data.
    pub(super) fn towards(&self, end: &Self, part: f64) -> Self {
        if part >= 1.0 {
            return end.clone();
        }
        let between = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| a + part * (b - a)).collect()
        };
        Self {
            f: between(&self.f, &end.f),
            x_0: between(&self.x_0, &end.x_0),
            s_0: between(&self.s_0, &end.s_0),
        }
    }
}
