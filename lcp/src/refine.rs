//! The equations of given states of all contacts, solved in double-double arithmetic.

mod answer;
mod constants;
mod law;
mod point;
mod residual;
mod solve;

pub use answer::{Refined, Refinement, Verified};
pub use law::Margin;

pub use crate::extended::Extended;
pub use crate::problem::ContactStatus;
pub(crate) use constants::{ALL_DIGITS, ROUNDED};
pub(crate) use solve::{Exact, refined_states};

use point::ExtendedPoint;
use solve::solved;

use crate::problem::column_of;
use crate::states::Scaled;
use crate::vector::{HALF_DIGITS, check_length, check_vector};
use crate::{Contact2d, ContactState, Error};

impl Contact2d {
    /// The states nearest to a solution: a contact is open if its gap, relative to the largest displacement, is larger
    /// than its force, relative to the largest force. A contact slides if its slip is larger than the difference
    /// between its friction force and the bound.
    ///
    /// # Panics
    /// If the lengths are not those of the problem.
    pub fn statuses(&self, state: &ContactState) -> Vec<ContactStatus> {
        let scaled = Scaled::of_contact(self);
        let at = ExtendedPoint::from(&scaled, state);
        at.nearest(&scaled)
    }

    /// Solves the equations that follow from the states of the contacts:
    ///
    /// ```text
    /// K u = f + C_n^T t_n + C_t^T t_t,
    /// t = 0 (open),   g = s = 0 (stick),   g = 0, t_t = -mu t_n (forwards) or mu t_n (backwards)
    /// ```
    ///
    /// where `g` and `s` contain the compression of compliant contacts by their forces. The factors are in `f64`;
    /// displacements and forces are refined with residuals in [`Extended`] (Björck, in Cox and Hammarling, Reliable
    /// Numerical Computation, 1990), starting from the given state. If the inequalities hold too, which
    /// [`Refined::margin`] shows, the result is a solution of the problem, and its equations hold to
    /// [`Refined::residual`].
    ///
    /// The forces of redundant contacts stay as near to the given ones as the equations allow. If their gaps contradict
    /// each other in the last digits of the data, or bodies move freely, the data are changed by the remaining residual
    /// ([`Refined::shift`]). If the states have no solution the residual stops decreasing.
    ///
    /// # Errors
    /// [`Error::Length`] if the lengths are not those of the problem, [`Error::NotFinite`] for a state with NaN or
    /// infinities, [`Error::NotTreated`] if the factors do not fit into memory.
    ///
    /// ```
    /// use faer::mat;
    /// use lcp::refine::{ContactStatus, Extended, Refinement};
    /// use lcp::Contact2d;
    /// // A spring of 3 that is pushed by 1 against a wall at 1/9: t = 1 - 3/9
    /// let contact = Contact2d::new(
    ///     mat![[3.0]], vec![1.0], mat![[-1.0]], mat![[0.0]], vec![1.0 / 9.0], vec![0.0], vec![0.0],
    /// )?;
    /// let rest = contact.state(vec![0.0], vec![0.0], vec![0.0]);
    /// let refined = contact.refine(&rest, &[ContactStatus::Stick], Refinement::Extended)?;
    /// let exact = Extended::from(1.0) - Extended::from(1.0 / 9.0) * 3.0;
    /// assert!((refined.t_n[0] - exact).rounded().abs() < 1e-31 && refined.margin.least > 0.0);
    /// # Ok::<(), lcp::Error>(())
    /// ```
    pub fn refine(
        &self,
        state: &ContactState,
        statuses: &[ContactStatus],
        refinement: Refinement,
    ) -> Result<Refined, Error> {
        self.check_state(state, statuses)?;
        let scaled = Scaled::of_contact(self);
        Ok(solved(&scaled, state, statuses, refinement)?.0)
    }

    /// The exact solution nearest to the given one: [`refine`](Self::refine) for its [`statuses`](Self::statuses).
    /// Bodies without loads that no contact presses float, with all their contacts open: their position is not
    /// determined, and they stay in place. If the inequality of a contact is then violated by no more than a rounding
    /// error of the solution, the contact takes the state on the other side, as long as the change increases the
    /// margin.
    ///
    /// # Errors
    /// The errors of [`refine`](Self::refine).
    pub fn verify(&self, state: &ContactState) -> Result<Verified, Error> {
        self.check_state(state, &vec![ContactStatus::Open; self.points()])?;
        let scaled = Scaled::of_contact(self);
        let at = ExtendedPoint::from(&scaled, state);
        let mut statuses = residual::without_idle(&scaled, &at.nearest(&scaled), &at);
        let (mut refined, mut slacks) = solved(&scaled, state, &statuses, Refinement::Extended)?;
        while (-HALF_DIGITS..0.0).contains(&refined.margin.least) {
            let better = statuses.iter().zip(&slacks);
            let better =
                better.map(|(status, (slack, next))| if *slack < 0.0 { *next } else { *status });
            let better: Vec<ContactStatus> = better.collect();
            let next = solved(&scaled, state, &better, Refinement::Extended)?;
            if next.0.margin.least <= refined.margin.least {
                break;
            }
            (statuses, (refined, slacks)) = (better, next);
        }
        Ok(Verified { statuses, refined })
    }

    /// The forces of all contacts on the displacements, `C_n^T t_n + C_t^T t_t`.
    ///
    /// # Panics
    /// If the lengths are not those of the problem.
    pub fn forces_on_bodies(&self, t_n: &[Extended], t_t: &[Extended]) -> Vec<Extended> {
        let m = self.points();
        assert!(t_n.len() == m && t_t.len() == m, "a force for every contact");
        let column = |j: usize| {
            let normal = column_of(self.normal(), j).map(|(i, v)| t_n[i] * v);
            let with_friction = |(i, _): &(usize, f64)| self.mu()[*i] > 0.0;
            let tangent = column_of(self.tangent(), j).filter(with_friction);
            let terms = normal.chain(tangent.map(|(i, v)| t_t[i] * v));
            terms.fold(Extended::ZERO, |sum, term| sum + term)
        };
        (0..self.displacements()).map(column).collect()
    }

    fn check_state(&self, state: &ContactState, statuses: &[ContactStatus]) -> Result<(), Error> {
        let (n, m) = (self.displacements(), self.points());
        let ContactState { u, t_n, t_t, .. } = state;
        for (what, vector, len) in [("u", u, n), ("t_n", t_n, m), ("t_t", t_t, m)] {
            check_length(what, vector.len(), len)?;
            check_vector(what, vector)?;
        }
        check_length("statuses", statuses.len(), m)
    }
}
