//! The equations of given states of all contacts, solved to twice the usual digits.

mod at;
mod lack;
mod law;
mod solve;

pub use law::Margin;

pub use crate::extended::Extended;
pub use crate::problem::ContactStatus;
pub(crate) use solve::{Exact, planned, refined_states};

use at::At;
use solve::solved;

use crate::active::Scaled;
use crate::problem::column_of;
use crate::vector::{check_length, check_vector};
use crate::{Contact2d, ContactState, Error};

/// How far [`Contact2d::refine`] goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
pub enum Refinement {
    /// One solve with the factors.
    Plain,
    /// One more, for a residual in `f64`.
    Single,
    /// Solves for residuals in [`Extended`], as long as these fall.
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
    /// The forces of all contacts on the displacements, `C^T t`: unique where single forces are not.
    pub on_bodies: Vec<Extended>,
    /// The largest lack of an equation, relative to the terms of its row, computed in [`Extended`]: of
    /// equilibrium, and of gap and slip where the states allow none.
    pub residual: f64,
    /// By how much the data were changed, relative to the terms of their row: what redundant contacts
    /// contradict each other, and what bodies that move freely have of a stiffness against that, by the
    /// rounding errors of the data. Zero where there is nothing of that sort.
    pub shift: f64,
    /// What the last pass changed of `on_bodies`, relative to the largest: the error that is left is smaller.
    /// Where data were changed, the largest that a pass did just before.
    pub correction: f64,
    /// How well the inequalities of the contact law hold.
    pub margin: Margin,
    /// Solves with the factors.
    pub passes: usize,
    /// Displacements of bodies without loads that no contact presses: they stay where they were. Their gaps are
    /// in the margin only where they are more negative than a rounding error makes them.
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

    /// How far other forces on the displacements are from these: the largest difference, relative to the
    /// largest of these; `None` where these are all zero.
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

/// Inequalities that are violated by less than this part of the largest force or displacement may hold but for
/// rounding errors of the answer.
const DOUBT: f64 = 1e-8;
/// Rounds of exchanges.
const EXCHANGES: usize = 10;

impl Contact2d {
    /// The states that an answer is nearest to: a contact is open where its gap, in units of the largest
    /// displacement, is larger than its force, in units of the largest; and slides where its slip is larger than
    /// what its force lacks to the bound of friction.
    ///
    /// # Panics
    /// If the lengths are not those of the problem.
    pub fn statuses(&self, state: &ContactState) -> Vec<ContactStatus> {
        let scaled = Scaled::of_contact(self);
        let at = At::from(&scaled, state);
        at.nearest(&scaled)
    }

    /// Solves the equations that the states of the contacts leave:
    ///
    /// ```text
    /// K u = f + C_n^T t_n + C_t^T t_t,
    /// t = 0 (open),   g = s = 0 (stick),   g = 0, t_t = -mu t_n (forwards) or mu t_n (backwards)
    /// ```
    ///
    /// by factors in `f64`, and refines displacements and forces with residuals in [`Extended`] (Björck
    /// 1990), from the given state on. [`Refined::margin`] tells whether the inequalities hold, too: then this
    /// is a solution of the problem, and its equations are known to hold to [`Refined::residual`].
    ///
    /// Redundant contacts leave a choice of forces: they stay as near to the given ones as the equations
    /// allow. Where their gaps contradict each other in the last digits of the data, or bodies move freely,
    /// the data are changed by what is left ([`Refined::shift`]). Where the states have no solution the residual
    /// stops falling, and tells.
    ///
    /// # Errors
    /// [`Error::Length`] when the lengths are not those of the problem, [`Error::NotFinite`] for a state with
    /// NaN or infinities, [`Error::NotTreated`] when the factors do not fit into memory.
    ///
    /// # References
    /// * Å. Björck, Iterative refinement and reliable computing, in: M. G. Cox, S. Hammarling (eds.), Reliable
    ///   Numerical Computation (1990)
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

    /// The answer that the given one is nearest to, as exact as it can be had: [`refine`](Self::refine) for
    /// its [`statuses`](Self::statuses). Bodies without loads that no contact presses float, with all their
    /// contacts open: where they are nothing says, and they stay there. Contacts whose inequalities are then
    /// violated by no more than a rounding error of the answer take the status on the other side of it, so
    /// long as this makes the margin larger.
    ///
    /// # Errors
    /// As [`refine`](Self::refine).
    pub fn verify(&self, state: &ContactState) -> Result<Verified, Error> {
        self.check_state(state, &vec![ContactStatus::Open; self.points()])?;
        let scaled = Scaled::of_contact(self);
        let at = At::from(&scaled, state);
        let mut statuses = lack::without_idle(&scaled, &at.nearest(&scaled), &at);
        let mut best: Option<Verified> = None;
        for _ in 0..EXCHANGES {
            let (refined, slacks) = solved(&scaled, state, &statuses, Refinement::Extended)?;
            let least = refined.margin.least;
            if best.as_ref().is_some_and(|best| best.refined.margin.least >= least) {
                break;
            }
            best = Some(Verified { statuses: statuses.clone(), refined });
            if !(-DOUBT..0.0).contains(&least) {
                break;
            }
            for (status, (slack, next)) in statuses.iter_mut().zip(slacks) {
                *status = if slack < 0.0 { next } else { *status };
            }
        }
        Ok(best.unwrap_or_else(|| unreachable!("the first round has an answer")))
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

/// An answer with the states of its contacts, from [`Contact2d::verify`].
#[derive(Debug, Clone, PartialEq)]
pub struct Verified {
    /// What the contacts do.
    pub statuses: Vec<ContactStatus>,
    /// Displacements and forces.
    pub refined: Refined,
}
