//! Contact that evolves: motions against viscosity, until the bodies rest or flow.

use std::ops::ControlFlow;

use super::evolved::Evolved;
use super::moving::Moving;
use super::settings::EvolutionSettings;
use crate::active::Search;
use crate::solve::Monitor;
use crate::vector::{check_length, check_vector};
use crate::{Contact2d, Error, Method, Observer};

/// From one state of bodies in contact to the next.
///
/// Under loads or gaps that have changed, a contact problem with friction may have several solutions, or none that a
/// method finds, since its law relates total slips. Bodies do not solve it: they move, and friction opposes the velocity
/// at every moment. Four ways lead to a state at rest, one after the other ([`Way`](crate::Way)):
///
/// 1. **Reduced friction**, where settings say so. The law as given, but with coefficients of friction that are smaller by a
///    thousandth, say. Walls on which interior points jam are often solved with them. The forces are inside the friction cones
///    of the problem. Smooth friction is tried before, as long as it advances fast.
/// 2. **Smooth friction.** Gaps and normal forces are complementary as always, but friction turns over a slip `e`, a
///    thousandth of the displacements, or as long as they are: `(mu t_n + t_t) s_+ = (mu t_n - t_t) s_- = e mu t_n`. These
///    equations have a smooth path of interior points, and forces inside the friction cones.
/// 3. **The law itself**, from the states of the contacts that this leads to, as in
///    [`InteriorPoint`](crate::InteriorPoint).
/// 4. **Motion.** The bodies move against a viscosity `eta` from displacements `u_k` to
///
///    ```text
///    K u + eta V (u - u_k) = f + C_n^T t_n + C_t^T t_t,    slip measured from u_k,
///    ```
///
///    with the unit `V` of the equilibrated problem, again and again. Friction has associated flow in a motion: a slip `s`
///    opens the gap by `mu |s|`, which the next motion closes. So every motion is the solution of a convex program, and
///    where the bodies come to rest nothing slips and the law is Coulomb's (Anitescu 2006). There is less viscosity from
///    motion to motion as long as motions do not become much longer for it. Then rest is looked for by smooth friction.
///    Motions that go on, with the same viscosity and the same length each, are those of bodies that flow, if neither bodies
///    nor closed contacts resist them.
///
/// The first motion measures slips as the problem does, so that supports which are moved drag along what rests on them.
///
/// At rest means: the forces balance the loads, are inside the friction cones, and are zero where a gap is open, at
/// displacements `u` where no body moves any further. Slips of that state are measured from `u` itself, so that they
/// are zero, and the solution is one of [`problem.after(&u)`](Contact2d::after), judged like every other.
///
/// # Failure
/// [`Status::NoEquilibrium`](crate::Status::NoEquilibrium) where the bodies flow, with the velocities in
/// [`Certificate::Springs`](crate::Certificate::Springs): evidence, and no proof.
/// [`Status::Stalled`](crate::Status::Stalled) where no rest is found after motions that decrease, and the statuses of
/// limits.
///
/// ```
/// use lcp::{Contact2d, ContactPoint, Evolution};
/// // A body of weight 2 on a plane (mu = 0.5) with a spring of stiffness 4 behind it.
/// let pushed = |push: f64| {
///     let mut builder = Contact2d::builder([[4.0, 0.0], [0.0, 0.0]], vec![push, -2.0]);
///     builder.add_point(ContactPoint {
///         normal: &[(1, 1.0)], tangent: &[(0, 1.0)], mu: 0.5, ..Default::default()
///     });
///     builder.build()
/// };
/// let there = Evolution::default().advance(&pushed(1.4)?, &[0.0, 0.0])?;
/// assert!(there.rests());
/// let u = there.state().u.clone();
/// assert!((u[0] - 0.1).abs() < 1e-3);
/// // Without the push friction holds the spring, which has 0.4 of the 1 that friction can.
/// let back = Evolution::default().advance(&pushed(0.0)?.after(&u)?, &u)?;
/// assert!((back.state().u[0] - u[0]).abs() < 1e-3 && (back.state().t_t[0] - 0.4).abs() < 1e-2);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Evolution {
    settings: EvolutionSettings,
}

impl Evolution {
    /// With these settings.
    pub fn new(settings: EvolutionSettings) -> Self {
        Self { settings }
    }

    /// The settings.
    pub fn settings(&self) -> &EvolutionSettings {
        &self.settings
    }

    /// Moves the bodies from displacements `from` until they rest or flow.
    ///
    /// # Errors
    /// [`Error::Length`] or [`Error::NotFinite`] for `from`, [`Error::Setting`] for the tolerance, and
    /// [`Error::NotTreated`] where memory does not suffice.
    pub fn advance(&self, problem: &Contact2d, from: &[f64]) -> Result<Evolved, Error> {
        self.advance_observed(problem, from, &mut |_| ControlFlow::Continue(()))
    }

    /// The same, calling the observer before every step; `Break` stops with
    /// [`Status::Cancelled`](crate::Status::Cancelled).
    ///
    /// # Errors
    /// As for [`advance`](Self::advance).
    pub fn advance_observed(
        &self,
        problem: &Contact2d,
        from: &[f64],
        observer: &mut Observer<'_>,
    ) -> Result<Evolved, Error> {
        self.settings.validate()?;
        let EvolutionSettings { tolerance, max_iterations, time_limit, .. } = self.settings;
        check_length("from", from.len(), problem.displacements())?;
        check_vector("from", from)?;
        let search = Search::new(Method::Interior, problem, tolerance)?;
        let monitor = Monitor::new(max_iterations, time_limit, observer);
        Moving::new(problem, tolerance, search, monitor, from).until_rest(&self.settings)
    }
}
