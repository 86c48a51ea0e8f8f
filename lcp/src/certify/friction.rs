//! Forces of a contact problem that is reduced to the contacts.

use std::borrow::Cow;

use super::rows::{self, Entry, InRow, Measure, Point, Precision, RowResiduals, Rows};
use super::significance::{Term, Terms, terms_of};
use super::{Residuals, weights};
use crate::extended::Extended;
use crate::matrix::Column;
use crate::{ContactForces, Friction2d};

impl Friction2d {
    /// Residuals of forces, dimensionless, from the data as given. The velocities `v = W r + q` follow from the
    /// forces, so that no equation is left; pairs are the normal force with the normal velocity, and the two
    /// distances `mu r_N + r_T` and `mu r_N - r_T` to the borders of the friction cone with the sliding
    /// forwards and backwards. See [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
    ///
    /// ```
    /// use faer::mat;
    /// use lcp::{Friction2d, Lemke, Solver};
    /// let friction = Friction2d::new(mat![[1.0, 0.0], [0.0, 1.0]], vec![-2.0, -3.0], vec![0.5])?;
    /// let solution = Solver::<Friction2d>::solve(&Lemke::default(), &friction)?;
    /// let mut forces = friction.forces(&solution.t);
    /// assert_eq!(friction.residuals(&forces).worst(), 0.0);
    /// forces.tangential[0] = 1.1;
    /// assert!(friction.residuals(&forces).worst() > 0.01);
    /// # Ok::<(), lcp::Error>(())
    /// ```
    ///
    /// # Panics
    /// If there is not one normal and one tangential force for every contact.
    pub fn residuals(&self, forces: &ContactForces) -> Residuals {
        let ContactForces { normal, tangential } = forces;
        let contacts = self.contacts();
        assert!(normal.len() == contacts && tangential.len() == contacts, "two forces a contact");
        let columns: Vec<Column<'_>> = (0..2 * contacts).map(|j| self.w().slice(j)).collect();
        let loads: Vec<f64> = self.q().iter().map(|q| q.abs()).collect();
        let weights = weights::weights(&columns, &loads);
        let forces: Vec<f64> = normal.iter().zip(tangential).flat_map(|(n, t)| [*n, *t]).collect();
        if forces.iter().any(|v| !v.is_finite()) {
            return Residuals::infinite();
        }
        let mut rows = Rows::<Extended>::new(self.q().iter().map(|q| (*q, q.abs())));
        for (column, &force) in columns.iter().zip(&forces) {
            column.for_each(|i, v| rows.add(i, v, force.into()));
        }
        let (velocities, terms) = rows.rounded();
        let at = JudgedPoint { problem: self, columns, forces, velocities, terms };
        let length = 2.0 * contacts as f64 + 1.0;
        rows::residuals(&at, Measure { weights: &weights, length }, Precision::Rounded)
    }
}

/// Forces with the velocities that follow from them.
struct JudgedPoint<'a> {
    problem: &'a Friction2d,
    columns: Vec<Column<'a>>,
    forces: Vec<f64>,
    velocities: Vec<f64>,
    terms: Vec<f64>,
}

impl Terms for JudgedPoint<'_> {
    fn for_each_term(&self, mut visit: impl FnMut(Term)) {
        let rows = self.terms.len();
        for (row, v) in self.velocities.iter().enumerate().filter(|(_, v)| **v != 0.0) {
            visit(Term { row, variable: rows + row, value: *v });
        }
        for (variable, (column, force)) in self.columns.iter().zip(&self.forces).enumerate() {
            terms_of(&mut visit, variable, *force, *column);
        }
    }
}

impl Point for JudgedPoint<'_> {
    /// The velocities are defined by the rows, which hold.
    fn rows(&self) -> (Cow<'_, [f64]>, Cow<'_, [f64]>) {
        (vec![0.0; self.terms.len()].into(), self.terms[..].into())
    }

    fn sources(&self) -> Vec<f64> {
        rows::in_full(self.problem.q())
    }

    fn conditions(&self, out: &mut RowResiduals<'_>) {
        for (i, mu) in self.problem.mu().iter().enumerate() {
            let [of_n, of_t] = [0, 1].map(|k| self.columns[2 * i + k]);
            let [of_normal, of_slip] = [0, 1].map(|k| InRow(2 * i + k));
            let (v_n, v_t) = (self.velocities[2 * i], self.velocities[2 * i + 1]);
            let (normal, tangential) = (self.forces[2 * i], self.forces[2 * i + 1]);
            out.pair(
                Entry { value: normal, column: of_n },
                Entry { value: v_n, column: of_normal },
            );
            let bound = mu * normal.max(0.0);
            for (force, slip) in [(bound + tangential, v_t), (bound - tangential, -v_t)] {
                out.pair(
                    Entry { value: force, column: of_t },
                    Entry { value: slip.max(0.0), column: of_slip },
                );
            }
        }
    }
}
