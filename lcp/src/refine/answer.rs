//! Solutions, and the level of their refinement.

use super::law::Margin;
use crate::extended::Extended;
use crate::problem::ContactStatus;
use crate::{Contact2d, ContactState};

/// The level of refinement by [`Contact2d::refine`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
pub enum Refinement {
    /// One solve with the factors.
    Plain,
    /// One more solve, for a residual in `f64`.
    Single,
    /// Solves for residuals in [`Extended`], as long as these decrease.
    Extended,
}

/// Displacements and forces that belong to the states of the contacts, from [`Contact2d::refine`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Refined {
    /// The displacements.
    pub u: Vec<Extended>,
    /// The normal forces.
    pub t_n: Vec<Extended>,
    /// The tangential forces.
    pub t_t: Vec<Extended>,
    /// The forces of all contacts on the displacements, `C^T t`: unique even if single forces are not.
    pub on_bodies: Vec<Extended>,
    /// The largest residual of an equation, relative to the terms of its row, computed in [`Extended`]: of
    /// equilibrium, and of gap and slip if the states require them to be zero.
    pub residual: f64,
    /// The change of the data, relative to the terms of their row. The change removes the contradiction between
    /// redundant contacts, and the stiffness due to rounding errors of the data against motions of free bodies. Zero
    /// if neither occurs.
    pub shift: f64,
    /// The change of `on_bodies` by the last pass, relative to the largest: the remaining error is smaller. If the
    /// data were changed, the largest change by a pass just before.
    pub correction: f64,
    /// The margin by which the inequalities of the contact law hold.
    pub margin: Margin,
    /// Number of solves with the factors.
    pub passes: usize,
    /// Number of displacements of bodies without loads that no contact presses: these bodies stay in place. Their
    /// gaps are in the margin only if they are more negative than rounding errors.
    pub floating: usize,
    /// Wall-clock time of analysis, factorisation and passes \[s\].
    pub seconds: f64,
}

impl Refined {
    /// The nearest state in `f64`.
    pub fn rounded(&self, problem: &Contact2d) -> ContactState {
        let [u, t_n, t_t] =
            [&self.u, &self.t_n, &self.t_t].map(|v| v.iter().map(|v| v.rounded()).collect());
        problem.state(u, t_n, t_t)
    }

    /// The distance of other forces on the displacements from `self.on_bodies`: the largest difference, relative to
    /// the largest entry of `self.on_bodies`; `None` if all its entries are zero.
    ///
    /// # Panics
    /// If the numbers of displacements differ.
    pub fn distance(&self, on_bodies: &[Extended]) -> Option<f64> {
        assert!(self.on_bodies.len() == on_bodies.len(), "answers of one problem are compared");
        let largest = |size: f64, it: Extended| size.max(it.rounded().abs());
        let size = self.on_bodies.iter().copied().fold(0.0, largest);
        let differences = self.on_bodies.iter().zip(on_bodies).map(|(a, b)| *a - *b);
        (size > 0.0).then(|| differences.fold(0.0, largest) / size)
    }
}

/// A solution with the states of its contacts, from [`Contact2d::verify`].
#[derive(Debug, Clone, PartialEq)]
pub struct Verified {
    /// The states of the contacts.
    pub statuses: Vec<ContactStatus>,
    /// Displacements and forces.
    pub refined: Refined,
}
