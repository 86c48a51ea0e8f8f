//! Convex problems as part of a homogeneous one, which always has a solution: that of the problem, or a proof that there
//! is none.

use super::constants::{
    BACK, CORRECTORS, LEAST_AIM, LONG_ENOUGH, LONGER, NO_STEP, PATIENCE, PROVED, STRICTER,
};
use super::iterate::{Defect, Iterate, Tangent};
use super::path::{corrections, targets};
use super::start::start;
use crate::Status;
use crate::problem::column_of;
use crate::states::{Condensed, PROXIMAL, Point, Scaled};
use crate::vector::max_abs;

/// A point of the homogeneous problem of Andersen and Ye (1999),
///
/// ```text
/// K u = f tau + N^T t,   y = N u + D t + x_0 tau,   kappa = f.u - x_0.t - (u.K u + t.D t) / tau,
/// t y = 0,   tau kappa = 0,   t, y, tau, kappa >= 0.
/// ```
///
/// Where `tau > 0`, `u / tau` and `t / tau` are a solution of the problem; where `kappa > 0`, `u` and `t` prove that there
/// is none.
struct Homogeneous<'a> {
    problem: &'a Scaled,
    /// A stiffness that comes on top of `K` on every displacement.
    spring: f64,
    at: Iterate,
    tau: f64,
    kappa: f64,
}

/// A step of all variables.
struct Step {
    at: Iterate,
    tau: f64,
    kappa: f64,
}

/// The solution of a problem without friction, with a spring on every displacement, to a tolerance; or `u` and `t` that may
/// prove that there is none, with [`Status::Infeasible`] if `is_proof` says so, which is asked wherever they are near.
/// `stop` is asked before every step, with the residual.
pub(super) fn solved(
    problem: &Scaled,
    condensed: &mut Condensed,
    (spring, tolerance): (f64, f64),
    mut stop: impl FnMut(f64) -> Option<Status>,
    mut is_proof: impl FnMut(&Iterate) -> bool,
) -> (Iterate, Status) {
    let at = start(problem, condensed, spring.max(PROXIMAL));
    let kappa = at.gap(problem);
    let mut now = Homogeneous { problem, spring, at, tau: 1.0, kappa };
    let (mut least, mut since, mut provable) = (f64::INFINITY, 0, PROVED);
    loop {
        let (residual, error) = (now.residual(), now.error_of_proof());
        if residual <= tolerance {
            return (now.solution(), Status::Solved);
        }
        if error <= provable {
            provable = STRICTER * error;
            if is_proof(&now.at) {
                return (now.at, Status::Infeasible);
            }
            if error <= tolerance {
                return (now.at, Status::Stalled);
            }
        }
        let merit = residual.min(error);
        if let Some(status) = stop(merit) {
            return (now.solution(), status);
        }
        since = if merit < 0.9 * least { 0 } else { since + 1 };
        least = least.min(merit);
        let alpha = now.advance(condensed);
        if alpha < NO_STEP || since > PATIENCE {
            return (now.solution(), Status::Stalled);
        }
    }
}

impl Homogeneous<'_> {
    /// The solution that the point may be near to.
    fn solution(self) -> Iterate {
        self.at.multiple(1.0 / self.tau.max(f64::MIN_POSITIVE))
    }

    fn residual(&self) -> f64 {
        let (force, length) = self.at.sizes();
        let units = (force.max(self.tau), length.max(self.tau));
        let defect = self.defect().relative(units);
        self.at.natural(self.problem, units).max(defect)
    }

    /// How far the point is from a proof: what has to vanish, relative to the work of loads and gaps, which has to be
    /// positive.
    fn error_of_proof(&self) -> f64 {
        let work = self.work();
        if work <= 0.0 {
            return f64::INFINITY;
        }
        let against =
            self.points().map(|(point, t)| (-point.moved(&self.at.u).0).max(point.compliance * t));
        against.fold(max_abs(&self.strained()), f64::max) / work
    }

    fn defect(&self) -> Defect {
        Defect::of_multiple(self.problem, &self.at, (self.spring, self.tau))
    }

    fn points(&self) -> impl Iterator<Item = (&Point, f64)> {
        self.problem.points.iter().zip(self.at.points.iter().map(|pairs| pairs.t_n))
    }

    /// `f.u - x_0.t`
    fn work(&self) -> f64 {
        let loads: f64 = self.problem.f.iter().zip(&self.at.u).map(|(f, u)| f * u).sum();
        loads - self.points().map(|(point, t)| point.x_0 * t).sum::<f64>()
    }

    /// `K u`
    fn strained(&self) -> Vec<f64> {
        let mut strained: Vec<f64> = self.at.u.iter().map(|u| self.spring * u).collect();
        for (j, u) in self.at.u.iter().enumerate() {
            column_of(&self.problem.k, j).for_each(|(i, v)| strained[i] += v * u);
        }
        strained
    }

    /// The mean of the products of all pairs.
    fn mean(&self) -> f64 {
        let count = self.problem.points.len() as f64;
        (self.at.gap(self.problem) * count + self.tau * self.kappa) / (count + 1.0)
    }

    /// One step of Mehrotra's method with Gondzio's correctors; gives its length.
    fn advance(&mut self, condensed: &mut Condensed) -> f64 {
        let newton = Newton::of(self, condensed);
        let mean = self.mean();
        let affine = newton.step((1.0, 0.0), None);
        let free = self.longest(&affine);
        let centring = (1.0 - free).powi(3).min(1.0);
        let aim = centring * mean;
        let mut step = newton.step((1.0 - centring, aim), Some(&affine));
        let mut alpha = self.longest(&step);
        for _ in 0..CORRECTORS {
            if alpha >= LONG_ENOUGH {
                break;
            }
            let trial = self.at.moved(&step.at, (1.5 * alpha + 0.3).min(1.0));
            let corrections = corrections(self.problem, &trial, aim.max(LEAST_AIM * mean));
            let corrected = step.plus(&newton.corrector(&corrections));
            let reached = self.longest(&corrected);
            if reached < alpha + LONGER {
                break;
            }
            (step, alpha) = (corrected, reached);
        }
        let alpha = (BACK * alpha).min(1.0);
        let at = self.at.moved(&step.at, alpha);
        let (tau, kappa) = (self.tau + alpha * step.tau, self.kappa + alpha * step.kappa);
        if !at.is_finite() || !(tau + kappa).is_finite() {
            return 0.0;
        }
        (self.at, self.tau, self.kappa) = (at, tau, kappa);
        alpha
    }

    /// The largest step, at most one, that leaves all variables positive.
    fn longest(&self, step: &Step) -> f64 {
        let pairs = [(self.tau, step.tau), (self.kappa, step.kappa)];
        let shrinking = pairs.into_iter().filter(|(_, change)| *change < 0.0);
        shrinking
            .map(|(v, change)| -v / change)
            .fold(self.at.longest(self.problem, &step.at), f64::min)
    }
}

impl Step {
    fn plus(&self, other: &Self) -> Self {
        let (tau, kappa) = (self.tau + other.tau, self.kappa + other.kappa);
        Self { at: self.at.moved(&other.at, 1.0), tau, kappa }
    }
}

/// Newton's equations at a point: those of the problem, bordered by those of `tau` and `kappa`.
struct Newton<'a> {
    now: &'a Homogeneous<'a>,
    tangent: Tangent<'a>,
    defect: Defect,
    /// The step of `u` and `t` for a step of one of `tau`.
    of_tau: Iterate,
    /// The derivatives of the equation of `kappa` by `u` and `t`.
    border: (Vec<f64>, Vec<f64>),
    /// What is left of that equation.
    rest: f64,
    /// Its coefficient of the step of `tau`, when all others are eliminated.
    pivot: f64,
}

impl<'a> Newton<'a> {
    fn of(now: &'a Homogeneous<'a>, condensed: &'a mut Condensed) -> Self {
        let Homogeneous { problem, spring, at, tau, kappa } = now;
        let strained = now.strained();
        let tangent = Tangent::new(problem, condensed, at, spring.max(PROXIMAL));
        let none = vec![[0.0; 3]; problem.points.len()];
        let of_tau = tangent.step(&Defect::of_data(problem), &none);
        let by_u = problem.f.iter().zip(&strained).map(|(f, k)| f - 2.0 * k / tau).collect();
        let by_t = now.points().map(|(it, t)| it.x_0 + 2.0 * it.compliance * t / tau).collect();
        let bodies: f64 = strained.iter().zip(&at.u).map(|(k, u)| k * u).sum();
        let contacts: f64 = now.points().map(|(point, t)| point.compliance * t * t).sum();
        let energy = (bodies + contacts) / tau;
        let mut newton = Self {
            now,
            tangent,
            defect: now.defect(),
            of_tau,
            border: (by_u, by_t),
            rest: now.work() - energy - kappa,
            pivot: 0.0,
        };
        newton.pivot = newton.across(&newton.of_tau) + (energy + kappa) / tau;
        newton
    }

    /// The product of the border with a step of `u` and `t`.
    fn across(&self, step: &Iterate) -> f64 {
        let (by_u, by_t) = &self.border;
        let u: f64 = by_u.iter().zip(&step.u).map(|(v, du)| v * du).sum();
        u - by_t.iter().zip(&step.points).map(|(v, pairs)| v * pairs.t_n).sum::<f64>()
    }

    /// The step that reduces the residuals of all equations by a part, with products of an aim in the end, less the
    /// second-order term of a predictor.
    fn step(&self, (part, aim): (f64, f64), predictor: Option<&Step>) -> Step {
        let Homogeneous { problem, at, tau, kappa, .. } = self.now;
        let targets = targets(problem, at, aim, predictor.map(|it| &it.at));
        let second = predictor.map_or(0.0, |it| it.tau * it.kappa);
        let rest = (part * self.rest, aim - tau * kappa - second);
        self.bordered(&self.tangent.step(&self.defect.reduced(part), &targets), rest)
    }

    /// The step that changes the products of the pairs by `targets`, and nothing else.
    fn corrector(&self, targets: &[[f64; 3]]) -> Step {
        self.bordered(&self.tangent.step(&Defect::none(self.now.problem), targets), (0.0, 0.0))
    }

    /// A step at `tau` as it is, with what it takes to make good `rest` of the equation of `kappa` and to change
    /// `tau kappa` by `target`.
    fn bordered(&self, held: &Iterate, (rest, target): (f64, f64)) -> Step {
        let Homogeneous { tau, kappa, .. } = self.now;
        let change = (target / tau - rest - self.across(held)) / self.pivot;
        let at = held.moved(&self.of_tau, change);
        Step { at, tau: change, kappa: (target - kappa * change) / tau }
    }
}
