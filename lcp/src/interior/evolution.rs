//! Contact that evolves: motions against viscosity, until the bodies rest or flow.

use std::ops::ControlFlow;
use std::time::Duration;

use super::constants::{
    BLUNT, LEAST_VISCOSITY, MOST_VISCOSITY, MOVED, SETTLING, SHARPER, SMOOTH, STEADIER, STEADY,
    STEADY_MOTIONS, TRIES,
};
use super::continuation::is_free;
use super::evolved::{Evolved, Way};
use super::motion::{Jerks, Motions, Moved, Viscosity};
use super::rest::settled;
use super::start::start;
use crate::active::{Effort, Search, unplanned};
use crate::lower::judged_point;
use crate::settings::check_tolerance;
use crate::solve::Monitor;
use crate::states::{PROXIMAL, Point};
use crate::vector::{check_length, check_vector, max_abs};
use crate::{Certificate, Contact2d, Error, Method, Observer, SoftSprings, Solution, Status};

/// Settings of [`Evolution`].
#[derive(Debug, Clone, PartialEq)]
pub struct EvolutionSettings {
    /// Largest residual, dimensionless, of the state at rest. In `(0, 1)`.
    pub tolerance: f64,
    /// Steps of interior points in all motions together, each with one factorisation.
    pub max_iterations: usize,
    /// Wall-clock time, looked at before every step; `None` is no limit.
    pub time_limit: Option<Duration>,
    /// Whether rest is looked for without a motion first. Where supports move far it is seldom found so.
    pub at_once: bool,
}

impl Default for EvolutionSettings {
    fn default() -> Self {
        Self { tolerance: 1e-10, max_iterations: 1000, time_limit: None, at_once: true }
    }
}

/// From one state of bodies in contact to the next.
///
/// Under loads or gaps that have changed, a contact problem with friction may have several solutions, or none that a
/// method finds, since its law relates total slips. Bodies do not solve it: they move, and friction opposes the velocity
/// at every moment. Three ways lead to a state at rest, one after the other ([`Way`](crate::Way)):
///
/// 1. **Smooth friction.** Gaps and normal forces are complementary as always, but friction turns over a short slip `e`, a
///    thousandth of the displacements: `(mu t_n + t_t) s_+ = (mu t_n - t_t) s_- = e mu t_n`. These equations have a smooth path
///    of interior points, and forces inside the friction cones.
/// 2. **The law itself**, from the states of the contacts that this leads to, as in
///    [`InteriorPoint`](crate::InteriorPoint).
/// 3. **Motion.** The bodies move against a viscosity `eta` from displacements `u_k` to
///
///    ```text
///    K u + eta V (u - u_k) = f + C_n^T t_n + C_t^T t_t,    slip measured from u_k,
///    ```
///
///    with the unit `V` of the equilibrated problem, again and again. Friction has associated flow in a motion: a slip `s`
///    opens the gap by `mu |s|`, which the next motion closes. So every motion is the solution of a convex program, and
///    where the bodies come to rest nothing slips and the law is Coulomb's (Anitescu 2006). There is less viscosity from
///    motion to motion as long as motions do not become much longer for it. Then rest is looked for by smooth friction.
///    Motions that go on, with the same viscosity and the same length each, are those of bodies that flow.
///
/// The first motion measures slips as the problem does, so that supports which are moved drag along what rests on them.
///
/// At rest means: the forces balance the loads, are inside the friction cones, and are zero where a gap is open, at
/// displacements `u` where no body moves any further. Slips of that state are measured from `u` itself, so that they
/// are zero, and the solution is one of [`problem.after(&u)`](Contact2d::after), judged like every other.
///
/// # Failure
/// [`Status::NoEquilibrium`] where the bodies flow, with the velocities in [`Certificate::Springs`]: evidence, and no
/// proof. [`Status::Stalled`] where no rest is found after motions that decrease, and the statuses of limits.
///
/// ```
/// use lcp::{Contact2d, ContactPoint, Evolution};
/// // A body of weight 2 on a plane (mu = 0.5) with a spring of stiffness 4 behind it.
/// let pushed = |push: f64| {
///     let mut builder = Contact2d::builder([[4.0, 0.0], [0.0, 0.0]], vec![push, -2.0]);
///     builder.add_point(ContactPoint {
///         normal: &[(1, 1.0)], tangent: &[(0, 1.0)], gap: 0.0, slip: 0.0, mu: 0.5,
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

    /// The same, calling the observer before every step; `Break` stops with [`Status::Cancelled`].
    ///
    /// # Errors
    /// As for [`advance`](Self::advance).
    pub fn advance_observed(
        &self,
        problem: &Contact2d,
        from: &[f64],
        observer: &mut Observer<'_>,
    ) -> Result<Evolved, Error> {
        let EvolutionSettings { tolerance, max_iterations, time_limit, at_once } = self.settings;
        check_tolerance(tolerance)?;
        check_length("from", from.len(), problem.displacements())?;
        check_vector("from", from)?;
        let search = Search::new(Method::Interior, problem, tolerance)?;
        let at = search.scaled.of_displacements(from);
        let monitor = Monitor::new(max_iterations, time_limit, observer);
        let origin = at.clone();
        let (limit, dissipation) = (None, 0.0);
        let moving = Moving { problem, tolerance, search, monitor, origin, at, limit, dissipation };
        moving.until_rest(at_once)
    }
}

/// Where bodies rest.
enum Found {
    /// The best point of the search solves the problem itself.
    Law,
    /// Displacements from which slips are measured, and the solution there.
    Rest(Vec<f64>, Box<Solution>),
}

/// A state at rest with smooth friction, scaled.
struct Settled {
    found: Found,
    /// The slip over which friction turns.
    slip: f64,
    /// The largest displacement on the way.
    moved: f64,
    dissipation: f64,
}

/// Bodies on their way.
struct Moving<'a, 'b> {
    problem: &'a Contact2d,
    tolerance: f64,
    /// With slips from where the last motion ended.
    search: Search<'a>,
    monitor: Monitor<'b>,
    /// Where they were at the beginning.
    origin: Vec<f64>,
    /// Where the last motion ended.
    at: Vec<f64>,
    /// What has stopped it.
    limit: Option<Status>,
    /// In units of the scaled problem.
    dissipation: f64,
}

impl Moving<'_, '_> {
    fn until_rest(mut self, at_once: bool) -> Result<Evolved, Error> {
        let mut path = SoftSprings::default();
        match at_once.then(|| self.rest(true)).flatten() {
            Some(Found::Law) => return Ok(self.by_law(path)),
            Some(Found::Rest(from, solution)) => {
                return Ok(self.concluded((Way::SmoothFriction, from, *solution), path));
            }
            None => {}
        }
        let mut motions =
            Motions::of(&self.search.scaled).map_err(|it| unplanned(Method::Interior, it))?;
        let load: f64 = self.search.scaled.f.iter().map(|f| f.abs()).sum();
        let (mut viscosity, mut tries) = (Viscosity::default(), 0);
        let mut forces = vec![(0.0, 0.0); self.problem.points()];
        let status = loop {
            if let Some(limit) = self.limit {
                break limit;
            }
            let Some(moved) = self.motion(&mut motions, (viscosity.value, MOVED)) else {
                viscosity.increase();
                if viscosity.value > MOST_VISCOSITY {
                    break self.limit.unwrap_or(Status::Stalled);
                }
                continue;
            };
            let velocity = self.follow(&moved, viscosity.value);
            forces = moved.forces;
            let length: f64 = velocity.iter().map(|v| v.abs()).sum();
            viscosity.follow(length);
            path.stiffness.push(viscosity.value);
            path.shares.push(if load > 0.0 { viscosity.value * length / load } else { length });
            path.motion = self.search.scaled.displacements(&velocity);
            if viscosity.flows() {
                let flows = self.is_steady(&mut motions, viscosity.value, velocity, &mut path);
                let otherwise = if flows { Status::NoEquilibrium } else { Status::Stalled };
                break self.limit.filter(|it| *it != Status::IterationLimit).unwrap_or(otherwise);
            }
            if viscosity.may_rest() {
                tries += 1;
                if let Some(Found::Rest(from, solution)) = self.rest(false) {
                    self.search.condensed.factorisations += motions.factorisations();
                    return Ok(self.concluded((Way::Motion, from, *solution), path));
                }
            }
            if tries == TRIES || viscosity.value <= LEAST_VISCOSITY {
                break self.limit.unwrap_or(Status::Stalled);
            }
            viscosity.decrease();
        };
        self.search.condensed.factorisations += motions.factorisations();
        self.given_up(&forces, path, status)
    }

    /// The state at rest that smooth friction leads to, with slips from there, if the judge agrees; or the solution of the
    /// problem itself next to it, where that is wanted. Where bodies move hardly farther than friction needs to turn, it
    /// turns over a shorter slip; what vanishes with that slip is no movement.
    fn rest(&mut self, by_law: bool) -> Option<Found> {
        let mut slip = None;
        for _ in 1..SHARPER {
            let settled = self.settled(by_law, slip)?;
            if settled.slip <= BLUNT * settled.moved {
                return Some(self.found(settled));
            }
            slip = Some(SMOOTH * settled.moved);
        }
        let settled = self.settled(by_law, slip)?;
        Some(self.found(settled))
    }

    fn found(&mut self, settled: Settled) -> Found {
        self.dissipation += settled.dissipation;
        settled.found
    }

    /// The same with friction that turns over a slip, by default one that fits the displacements of the start.
    fn settled(&mut self, by_law: bool, slip: Option<f64>) -> Option<Settled> {
        let Self { problem, tolerance, search, monitor, limit, origin, .. } = self;
        let (mut best, mut left) = (f64::INFINITY, SETTLING);
        let go_on = |residual| {
            (best, left) =
                if residual <= 0.5 * best { (residual, SETTLING) } else { (best, left - 1) };
            *limit = monitor.stop(residual);
            limit.is_none() && left > 0
        };
        let Search { scaled, condensed, .. } = search;
        let mut begin = start(scaled, condensed, PROXIMAL);
        let slip = slip.unwrap_or_else(|| SMOOTH * max_abs(&begin.u));
        begin.smooth = slip;
        let mut states = None;
        let found = settled(scaled, condensed, begin, go_on, |condensed, at, (u, forces)| {
            let from = scaled.displacements(&u);
            let there = problem.after(&from).ok()?;
            let mut other = Search::new(Method::Interior, &there, *tolerance).ok()?;
            other.try_point((&u, &forces), Some(&Effort::held(PROXIMAL)));
            condensed.factorisations += other.condensed.factorisations;
            let solution = other.found()?;
            let slid = |(point, (_, t_t)): (&Point, &(f64, f64))| -t_t * point.slip(&u);
            let dissipation = scaled.points.iter().zip(&forces).map(slid).sum();
            let moved =
                u.iter().zip(&*origin).fold(0.0, |max: f64, (u, at)| max.max((u - at).abs()));
            states = Some((at.u.clone(), at.forces(), at.contacts(scaled)));
            let found = Found::Rest(from, Box::new(solution));
            Some(Settled { found, slip, moved, dissipation })
        });
        if let Some((u, forces, contacts)) = states.filter(|_| by_law)
            && search.cross_over((&u, &forces), contacts, &Effort::QUICK)
        {
            return Some(Settled { found: Found::Law, slip: 0.0, moved: 0.0, dissipation: 0.0 });
        }
        found
    }

    /// One motion; `None` where it cannot be computed, or a limit is reached.
    fn motion(&mut self, motions: &mut Motions, with: (f64, f64)) -> Option<Moved> {
        let Self { search, monitor, at, limit, .. } = self;
        motions.advance(&search.scaled, at, with, |residual| {
            *limit = monitor.stop(residual);
            *limit
        })
    }

    /// Moves on until the motion does not change any more, which is the mechanism then. On a soft spring every motion is
    /// shorter than the one before by the same part. Where contacts close and open in turn, motions change and do not become
    /// shorter: the mechanism is their mean.
    fn is_steady(
        &mut self,
        motions: &mut Motions,
        viscosity: f64,
        mut last: Vec<f64>,
        path: &mut SoftSprings,
    ) -> bool {
        let mut first = None;
        let mut change = f64::INFINITY;
        let (mut jerks, mut all) = (Jerks::default(), last.clone());
        for _ in 0..STEADY_MOTIONS {
            let Some(moved) = self.motion(motions, (viscosity, STEADY)) else { break };
            let velocity = self.follow(&moved, viscosity);
            let changes: Vec<f64> = velocity.iter().zip(&last).map(|(v, last)| v - last).collect();
            change = max_abs(&changes) / max_abs(&velocity);
            path.motion = self.search.scaled.displacements(&velocity);
            last = velocity;
            if change <= STEADY {
                return is_free(&self.search.scaled, &last, viscosity);
            }
            first.get_or_insert(change);
            jerks.follow(&last, change);
            all.iter_mut().zip(&last).for_each(|(all, v)| *all += v);
        }
        if jerks.go_on() {
            path.motion = self.search.scaled.displacements(&all);
            return true;
        }
        first.is_some_and(|first| change <= STEADIER * first)
    }

    /// Takes the bodies to the end of a motion, from which slips are measured then, and gives its displacements.
    fn follow(&mut self, moved: &Moved, viscosity: f64) -> Vec<f64> {
        let velocity: Vec<f64> = moved.u.iter().zip(&self.at).map(|(u, at)| u - at).collect();
        self.dissipation += viscosity * velocity.iter().map(|v| v * v).sum::<f64>();
        for (point, (_, t_t)) in self.search.scaled.points.iter_mut().zip(&moved.forces) {
            self.dissipation -= t_t * point.slip(&moved.u);
            point.s_0 = -point.moved(&moved.u).1;
        }
        self.at.clone_from(&moved.u);
        velocity
    }

    /// Where the bodies were when the last motion ended.
    fn given_up(
        self,
        forces: &[(f64, f64)],
        motions: SoftSprings,
        status: Status,
    ) -> Result<Evolved, Error> {
        let scaled = &self.search.scaled;
        let from = scaled.displacements(&self.at);
        let problem = self.problem.after(&from)?;
        let (t_n, t_t) =
            forces.iter().map(|(n, t)| (n * scaled.force(), t * scaled.force())).unzip();
        let pairs = problem.to_pairs(&problem.state(from.clone(), t_n, t_t));
        let mut solution = judged_point(&problem, pairs, self.tolerance, status);
        if solution.status == Status::NoEquilibrium {
            solution.certificate = Some(Certificate::Springs(motions.clone()));
        }
        Ok(self.concluded((Way::Motion, from, solution), motions))
    }

    fn by_law(self, motions: SoftSprings) -> Evolved {
        let solution = self.search.finish(Status::Stalled, self.monitor);
        Evolved { way: Way::Law, from: None, solution, motions, dissipation: 0.0 }
    }

    fn concluded(
        self,
        (way, from, mut solution): (Way, Vec<f64>, Solution),
        motions: SoftSprings,
    ) -> Evolved {
        let Search { scaled, condensed, .. } = &self.search;
        let dissipation = self.dissipation * scaled.energy();
        let factorisations = condensed.factorisations;
        solution.info = self.monitor.info(Method::Interior);
        solution.info.factorisations = factorisations;
        Evolved { way, from: Some(from), solution, motions, dissipation }
    }
}
