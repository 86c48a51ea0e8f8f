//! Answers in the variables of the problem as given.

use crate::{
    BoxedLcp, Contact2d, ContactForces, ContactState, Friction2d, Lcp, MixedLcp, Qp, QpPoint,
    Solution,
};

impl Lcp {
    /// The variables of an answer, `(z, w)`: its `t` and `y`.
    ///
    /// # Panics
    /// If the answer is that of a problem of another size.
    pub fn variables(&self, solution: &Solution<Self>) -> (Vec<f64>, Vec<f64>) {
        let (t, y) = (&solution.t, &solution.y);
        assert!(t.len() == self.order() && y.len() == self.order(), "an answer of this problem");
        (t.clone(), y.clone())
    }
}

impl MixedLcp {
    /// The variables of an answer, `(z, w)`.
    ///
    /// # Panics
    /// If the answer is that of a problem of another size.
    pub fn variables(&self, solution: &Solution<Self>) -> (Vec<f64>, Vec<f64>) {
        self.recover(&solution.t, &solution.y)
    }
}

impl BoxedLcp {
    /// The variables of an answer, `(z, w)`.
    ///
    /// # Panics
    /// If the answer is that of a problem of another size.
    pub fn variables(&self, solution: &Solution<Self>) -> (Vec<f64>, Vec<f64>) {
        let recovered = || self.recover(&solution.t, &solution.y);
        solution.boxed.clone().unwrap_or_else(recovered)
    }
}

impl Qp {
    /// The variables, multipliers and objective of an answer to its [conditions](Self::mixed).
    ///
    /// # Panics
    /// If the answer is that of a problem of another size.
    pub fn variables(&self, solution: &Solution<MixedLcp>) -> QpPoint {
        let (z, w) = self.mixed().variables(solution);
        self.point(z, w)
    }
}

impl Friction2d {
    /// The forces at the contacts of an answer.
    ///
    /// # Panics
    /// If the answer is that of a problem of another size.
    pub fn variables(&self, solution: &Solution<Self>) -> ContactForces {
        self.forces(&solution.t)
    }
}

impl Contact2d {
    /// The displacements, forces, gaps and slips of an answer.
    ///
    /// # Panics
    /// If the answer is that of a problem of another size.
    pub fn variables(&self, solution: &Solution<Self>) -> ContactState {
        match &solution.contact {
            Some(state) => state.clone(),
            None => self.recover(&solution.t, &solution.y),
        }
    }
}
