//! Motion of bodies in contact: implicit steps in time, until the bodies rest or flow.

mod account;
mod motion;
mod settings;
mod step;
mod target;

pub use account::Account;
pub use motion::Ending;
pub use settings::EvolutionSettings;

use std::ops::ControlFlow;

use faer::sparse::SparseColMat;

use crate::problem::ContactStatus;
use crate::solve::Monitor;
use crate::vector::{check_length, check_vector};
use crate::{Contact2d, ContactState, Error, Iteration, Matrix, Method, Observer, Status};
use target::{Course, Data, Rest, Taken, Target, close};

/// Bodies with mass in contact, which move under loads, gaps and supports that change.
///
/// # Equations
/// A step of the length `h` leads from displacements `u_k` and velocities `v_k` to
///
/// ```text
/// (K + M/h^2 + c M/h) u = f + (M/h^2) (u_k + h v_k) + (c M/h) u_k + C_n^T t_n + C_t^T t_t,    v = (u - u_k) / h,
/// ```
///
/// with the loads, gaps and supports at its end, and with Coulomb's law exactly on the increment: slips are measured
/// from the end of the step before. Gaps and slips continue from their present values: only the changes of the initial
/// ones of a problem count, and its matrices `K`, `C_n` and `C_t` must be those of the step before. Without
/// [`inertia`](EvolutionSettings::inertia) the terms with `M/h^2` are omitted, and the drag `c M v` is the only effect
/// of the mass.
///
/// A step is solved by the states of the contacts in the step before, if they still hold, else along the path of
/// interior points, else by shorter steps. The page `docs/methods/evolution.md` has the details.
///
/// # Rest and flow
/// [`settle`](Self::settle) keeps loads and gaps constant, and doubles the steps of bodies without inertia until
///
/// * bodies rest: displacements solve the problem without mass, with slips measured from the step before, and
///   judged like every other solution; or
/// * bodies flow: the loads do work, the velocity changes by less than a hundredth in a step of twice the length, no gap
///   closes before bodies are out of [reach](EvolutionSettings::reach), and the strains up to there would take less
///   than a hundredth of the work.
///
/// # Guarantee
/// Every solution of a fixed step that is called solved obeys Coulomb's law on the increment: friction dissipates as
/// much as it can in every slip, and no energy is created ([`Account`]). As steps become shorter, solutions of such
/// schemes converge to one of the differential inclusion of bodies with mass (Anitescu 2006, for the scheme with
/// associated flow). The solution need not be unique: it depends on the path of the loads if there is friction, and
/// may depend on the drag.
///
/// # References
/// * Jean, Computer Methods in Applied Mechanics and Engineering 177 (1999), [doi:10.1016/S0045-7825(98)00383-1](https://doi.org/10.1016/S0045-7825(98)00383-1)
/// * Anitescu, Mathematical Programming 105 (2006), [doi:10.1007/s10107-005-0590-7](https://doi.org/10.1007/s10107-005-0590-7)
///
/// ```
/// use lcp::{Contact2d, ContactPoint, Evolution, EvolutionSettings};
/// // A body of weight 2 on a plane (mu = 0.5) with a spring of stiffness 4 behind it.
/// let pushed = |push: f64| {
///     let mut builder = Contact2d::builder([[4.0, 0.0], [0.0, 0.0]], vec![push, -2.0]);
///     builder.add_point(ContactPoint {
///         normal: &[(1, 1.0)], tangent: &[(0, 1.0)], mu: 0.5, ..Default::default()
///     });
///     builder.build()
/// };
/// let mass = [[0.2, 0.0], [0.0, 0.2]];
/// let mut body = Evolution::new(&pushed(0.0)?, mass, EvolutionSettings::default())?;
/// body.advance(&pushed(1.4)?, 1.0)?;
/// assert!(body.settle(&pushed(1.4)?, 1.0)?.rests());
/// assert!((body.state().u[0] - 0.1).abs() < 1e-12);
/// // Without the push friction holds the spring, which has 0.4 of the 1 that friction can.
/// body.advance(&pushed(0.0)?, 1.0)?;
/// assert!(body.settle(&pushed(0.0)?, 1.0)?.rests());
/// assert!((body.state().u[0] - 0.1).abs() < 1e-12 && (body.state().t_t[0] - 0.4).abs() < 1e-12);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Evolution {
    settings: EvolutionSettings,
    mass: SparseColMat<usize, f64>,
    /// The present loads, gaps and supports.
    data: Data,
    /// The present state; slips are those of the last step.
    state: ContactState,
    velocity: Vec<f64>,
    /// The slip of every point before the last step, and after it.
    slips: [Vec<f64>; 2],
    /// The states of the contacts; empty before the first step.
    contacts: Vec<ContactStatus>,
    account: Account,
    steps: usize,
    factorisations: usize,
}

impl Evolution {
    /// Bodies at rest without displacements and without contact forces, under the loads and gaps of a problem. `K`
    /// is the stiffness of the bodies, `mass` their mass (symmetric, positive semidefinite).
    ///
    /// # Errors
    /// [`Error::Shape`], [`Error::NotFinite`] or [`Error::NotSymmetric`] for the mass, [`Error::Setting`] for the settings.
    pub fn new(
        problem: &Contact2d,
        mass: impl Into<Matrix>,
        settings: EvolutionSettings,
    ) -> Result<Self, Error> {
        settings.validate()?;
        let (n, m) = (problem.displacements(), problem.points());
        let mass = mass.into();
        mass.check("M", n, n)?;
        mass.check_symmetric("M")?;
        let zero = || vec![0.0; m];
        let slips = problem.initial_slips();
        Ok(Self {
            settings,
            mass: mass.into_sparse(),
            data: Data::of(problem),
            state: problem.state(vec![0.0; n], zero(), zero()),
            velocity: vec![0.0; n],
            slips: [slips.to_vec(), slips.to_vec()],
            contacts: Vec::new(),
            account: Account::default(),
            steps: 0,
            factorisations: 0,
        })
    }

    /// The same bodies with other velocities.
    ///
    /// # Errors
    /// [`Error::Length`] or [`Error::NotFinite`].
    pub fn moving(self, velocity: Vec<f64>) -> Result<Self, Error> {
        check_length("velocity", velocity.len(), self.velocity.len())?;
        check_vector("velocity", &velocity)?;
        Ok(Self { velocity, ..self })
    }

    /// The same bodies at rest in another state of the [problem](Self::new), with the slip of every point.
    ///
    /// # Errors
    /// [`Error::Length`] or [`Error::NotFinite`].
    pub fn at(self, mut state: ContactState, slips: Vec<f64>) -> Result<Self, Error> {
        let n = self.velocity.len();
        for (name, vector, length) in [
            ("u", &state.u, n),
            ("t_n", &state.t_n, self.state.t_n.len()),
            ("t_t", &state.t_t, self.state.t_t.len()),
            ("gap", &state.gap, self.state.t_n.len()),
            ("slips", &slips, self.state.t_n.len()),
        ] {
            check_length(name, vector.len(), length)?;
            check_vector(name, vector)?;
        }
        let slips = [slips.clone(), slips];
        close(&mut state, self.settings.tolerance);
        Ok(Self { state, slips, contacts: Vec::new(), velocity: vec![0.0; n], ..self })
    }

    /// Displacements, forces and gaps. Slips are those of the last step.
    pub fn state(&self) -> &ContactState {
        &self.state
    }

    /// The velocities.
    pub fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// The slip of every point so far, without the deformation of its spring; at first it is that of the problem.
    pub fn slips(&self) -> &[f64] {
        &self.slips[1]
    }

    /// The slips before the last step: the state solves the problem [with slips measured from them](Contact2d::slid).
    pub fn slips_before(&self) -> &[f64] {
        &self.slips[0]
    }

    /// Works and energies since the start.
    pub fn account(&self) -> &Account {
        &self.account
    }

    /// Steps since the start.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Factorisations since the start.
    pub fn factorisations(&self) -> usize {
        self.factorisations
    }

    /// Takes one step of the length `h` to the loads, gaps and supports of `problem`: [`Status::Solved`], or the reason
    /// for which it was not taken.
    ///
    /// # Errors
    /// [`Error::Length`] for a problem of other bodies, [`Error::Setting`] for a step that is not positive, and
    /// [`Error::NotTreated`] if memory does not suffice.
    pub fn step(&mut self, problem: &Contact2d, h: f64) -> Result<Status, Error> {
        self.check(problem, h)?;
        self.observed(&mut |_| ControlFlow::Continue(()), |this, course| {
            let target = Target { problem, data: &Data::of(problem), h: Some(h) };
            Ok(match this.taken(target, Rest::Never, course)? {
                Taken::Yes(_) | Taken::Rests => Status::Solved,
                Taken::No(status) => status,
            })
        })
    }

    /// Steps to the loads, gaps and supports of `problem`, which change evenly in a time `duration`: one step, or more
    /// if one is not solved. The bodies may still move at the end.
    ///
    /// # Errors
    /// As for [`step`](Self::step).
    pub fn advance(&mut self, problem: &Contact2d, duration: f64) -> Result<Ending, Error> {
        self.advance_observed(problem, duration, &mut |_| ControlFlow::Continue(()))
    }

    /// Advances and calls the observer before every step and every iteration of its path; `Break` stops with
    /// [`Status::Cancelled`](crate::Status::Cancelled).
    ///
    /// # Errors
    /// As for [`step`](Self::step).
    pub fn advance_observed(
        &mut self,
        problem: &Contact2d,
        duration: f64,
        observer: &mut Observer<'_>,
    ) -> Result<Ending, Error> {
        self.check(problem, duration)?;
        self.observed(observer, |this, course| this.driven(problem, duration, Rest::Never, course))
    }

    /// Takes bodies to the loads, gaps and supports of `problem`, evenly in a time `duration`, and then keeps these
    /// constant until the bodies rest or flow.
    ///
    /// # Errors
    /// As for [`settle`](Self::settle).
    pub fn lead(&mut self, problem: &Contact2d, duration: f64) -> Result<Ending, Error> {
        self.lead_observed(problem, duration, &mut |_| ControlFlow::Continue(()))
    }

    /// Leads with an observer as in [`advance_observed`](Self::advance_observed).
    ///
    /// # Errors
    /// As for [`settle`](Self::settle).
    pub fn lead_observed(
        &mut self,
        problem: &Contact2d,
        duration: f64,
        observer: &mut Observer<'_>,
    ) -> Result<Ending, Error> {
        self.check_settles(problem, duration)?;
        self.observed(observer, |this, course| this.led(problem, duration, course))
    }

    /// Steps under the loads and gaps of `problem` until the bodies rest or flow; the first one has the length `h`.
    ///
    /// # Errors
    /// As for [`step`](Self::step), and [`Error::Setting`] for bodies with inertia: they swing through places at which
    /// forces are balanced, and steps that become longer would leave the swing out. Take [`steps`](Self::step) until
    /// they rest.
    pub fn settle(&mut self, problem: &Contact2d, h: f64) -> Result<Ending, Error> {
        self.settle_observed(problem, h, &mut |_| ControlFlow::Continue(()))
    }

    /// Settles with an observer as in [`advance_observed`](Self::advance_observed).
    ///
    /// # Errors
    /// As for [`settle`](Self::settle).
    pub fn settle_observed(
        &mut self,
        problem: &Contact2d,
        h: f64,
        observer: &mut Observer<'_>,
    ) -> Result<Ending, Error> {
        self.check_settles(problem, h)?;
        self.observed(observer, |this, course| this.settled(problem, h, course))
    }

    fn check(&self, problem: &Contact2d, h: f64) -> Result<(), Error> {
        check_length("displacements", problem.displacements(), self.velocity.len())?;
        check_length("points", problem.points(), self.state.t_n.len())?;
        if h > 0.0 && h.is_finite() {
            return Ok(());
        }
        Err(Error::Setting { name: "step", value: h, range: "above 0 and finite" })
    }

    fn check_settles(&self, problem: &Contact2d, h: f64) -> Result<(), Error> {
        self.check(problem, h)?;
        if !self.settings.inertia {
            return Ok(());
        }
        let range = "switched off where bodies are to settle: it is 1 where they have inertia";
        Err(Error::Setting { name: "inertia", value: 1.0, range })
    }

    /// Runs steps with the limits of the settings.
    fn observed<T>(
        &mut self,
        observer: &mut Observer<'_>,
        run: impl FnOnce(&mut Self, &mut Course<'_, '_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let EvolutionSettings { max_iterations, time_limit, .. } = self.settings;
        let mut forward = |at: &Iteration| observer(at);
        let mut monitor = Monitor::new(Method::Interior, max_iterations, time_limit, &mut forward);
        let last = self.factorisations.saturating_add(max_iterations);
        run(self, &mut Course { plan: None, last, monitor: &mut monitor })
    }
}
