//! Convex programs as part of a homogeneous problem, which always has a solution: that of the program, or a proof that
//! there is none.

use super::constants::{
    BACK, CENTRAL, COMPLIANCE, CORRECTORS, LEAST_AIM, LONG_ENOUGH, LONGER, NO_STEP, PATIENCE,
    PROJECTION, PROVED, ROUNDING, STRICTER,
};
use super::factors::Factors;
use super::program::Program;
use super::variables::{Variables, dot, longest};
use crate::Status;
use crate::states::PROXIMAL;
use crate::vector::max_abs;

/// How exact a solution has to be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Accuracy {
    tolerance: f64,
    /// What the smaller one of a pair counts beside what the equations lack.
    pairs: f64,
    /// The balance is measured by the largest force, and by no more than this multiple of the largest load.
    loads: f64,
}

impl Accuracy {
    /// Equations and pairs alike, relative to the largest force and gap.
    pub(super) fn of_all(tolerance: f64) -> Self {
        Self { tolerance, pairs: 1.0, loads: f64::INFINITY }
    }

    /// Equations to the tolerance, and pairs below a tenth of its root: to that, their products are far below the
    /// tolerance.
    pub(super) fn of_products(tolerance: f64) -> Self {
        Self { pairs: 10.0 * tolerance.sqrt(), ..Self::of_all(tolerance) }
    }

    /// The same with the balance relative to a multiple of the largest load, where forces may be far larger.
    pub(super) fn of_loads(self, loads: f64) -> Self {
        Self { loads, ..self }
    }
}

/// A point of the homogeneous problem of Andersen and Ye (1999),
///
/// ```text
/// K u = f tau + A t,   y = A^T u + D t + x_0 tau,   kappa = f.u - x_0.t - (u.K u + t.D t) / tau,
/// t y = 0,   tau kappa = 0,   t, y, tau, kappa >= 0.
/// ```
///
/// Where `tau > 0`, `u / tau` and `t / tau` are a solution of the problem; where `kappa > 0`, `u` and `t` prove that there
/// is none.
struct Homogeneous<'a> {
    program: &'a Program,
    at: Variables,
    tau: f64,
    kappa: f64,
    /// `K u` and `A^T u`.
    strained: Vec<f64>,
    opened: Vec<f64>,
}

/// A step of all variables.
struct Step {
    at: Variables,
    tau: f64,
    kappa: f64,
}

/// What the equations lack at a point.
struct Defect {
    /// `f tau + A t - K u`
    balance: Vec<f64>,
    /// `A^T u + D t + x_0 tau - y`
    gaps: Vec<f64>,
}

/// The solution of a program; or `u` and `t` that prove that there is none, with [`Status::Infeasible`], as soon as
/// `is_proof` says so. `stop` is asked before every step, with the residual.
pub(super) fn solved(
    program: &Program,
    factors: &mut Factors,
    accuracy: Accuracy,
    mut stop: impl FnMut(f64) -> Option<Status>,
    mut is_proof: impl FnMut(&Variables) -> bool,
) -> (Variables, Status) {
    let Some(at) = Variables::start(program, factors) else {
        return (Variables::zero(program), Status::Stalled);
    };
    let kappa = at.mean_product();
    let mut now = Homogeneous::new(program, at, 1.0, kappa);
    let (mut least, mut since, mut provable) = ([f64::INFINITY; 3], 0, PROVED);
    loop {
        let defect = now.defect();
        let residual = now.residual(&defect, accuracy);
        let error = now.error_of_proof();
        if residual <= accuracy.tolerance {
            return (now.solution(), Status::Solved);
        }
        if error <= provable {
            provable = STRICTER * error;
            if is_proof(&now.at) {
                return (now.at, Status::Infeasible);
            }
            if let Some(at) = now.projected(factors, error)
                && is_proof(&at)
            {
                return (at, Status::Infeasible);
            }
        }
        if let Some(status) = stop(residual.min(error)) {
            return (now.solution(), status);
        }
        // Far from a proof its error may be as small as it will be for long, while the rest goes on.
        let merits = [residual, error, now.mean()];
        let is_better = merits.iter().zip(&least).any(|(merit, least)| *merit < 0.9 * least);
        since = if is_better { 0 } else { since + 1 };
        least = [0, 1, 2].map(|k| least[k].min(merits[k]));
        let alpha = now.advance(factors, defect);
        if alpha < NO_STEP || since > PATIENCE {
            return (now.solution(), Status::Stalled);
        }
    }
}

impl<'a> Homogeneous<'a> {
    fn new(program: &'a Program, at: Variables, tau: f64, kappa: f64) -> Self {
        let (strained, opened) = (program.strained(&at.u), program.opened(&at.u));
        Self { program, at, tau, kappa, strained, opened }
    }

    /// The solution that the point may be near to.
    fn solution(mut self) -> Variables {
        let by = 1.0 / self.tau.max(f64::MIN_POSITIVE);
        let Variables { u, t, y } = &mut self.at;
        u.iter_mut().chain(t).chain(y).for_each(|v| *v *= by);
        self.at
    }

    fn residual(&self, defect: &Defect, Accuracy { tolerance, pairs, loads }: Accuracy) -> f64 {
        let (force, length) = (max_abs(&self.at.t), max_abs(&self.at.y));
        let (force, length) = (force.max(self.tau), length.max(self.tau));
        let load = loads * self.tau * max_abs(&self.program.f);
        // Rounding leaves some last digits of the largest force.
        let rounded = ROUNDING * force / tolerance;
        let unit = if load < force { load.max(rounded).min(force) } else { force };
        let defect = (max_abs(&defect.balance) / unit).max(max_abs(&defect.gaps) / length);
        let natural = self.at.t.iter().zip(&self.at.y).map(|(t, y)| (t / force).min(y / length));
        natural.fold(defect, |max, v| max.max(pairs * v.abs()))
    }

    /// How far the point is from a proof: what has to vanish, relative to the work of loads and gaps, which has to be
    /// positive.
    fn error_of_proof(&self) -> f64 {
        let work = self.work();
        if work <= 0.0 {
            return f64::INFINITY;
        }
        let forces = self.program.compliance.iter().zip(&self.at.t);
        let against = self.opened.iter().zip(forces).map(|(opened, (c, t))| (-opened).max(c * t));
        against.fold(max_abs(&self.strained), f64::max) / work
    }

    fn defect(&self) -> Defect {
        let Self { program, at, tau, .. } = self;
        let mut balance: Vec<f64> =
            program.f.iter().zip(&self.strained).map(|(f, strained)| tau * f - strained).collect();
        program.add_forces(&at.t, &mut balance);
        let data = program.x_0.iter().zip(&program.compliance);
        let pairs = self.opened.iter().zip(data).zip(at.t.iter().zip(&at.y));
        let gaps = pairs.map(|((opened, (x, c)), (t, y))| opened + tau * x + c * t - y).collect();
        Defect { balance, gaps }
    }

    /// The point with the nearest `u` to its own that strains nothing and leaves closed the pairs that the point opens by
    /// no more than the root of its error: a proof whose products vanish has no rounding errors there to contradict it.
    /// Each solve takes all but a part [`PROJECTION`] of these products away.
    fn projected(&self, factors: &mut Factors, error: f64) -> Option<Variables> {
        let most = error.sqrt() * self.work();
        let closed = self.opened.iter().map(|opened| f64::from(u8::from(*opened <= most)));
        factors.factorise(self.program, closed.collect(), PROJECTION)?;
        let mut at = self.at.clone();
        for _ in 0..2 {
            at.u.iter_mut().for_each(|u| *u *= PROJECTION);
            factors.gram.solve(&mut at.u);
        }
        Some(at)
    }

    /// `f.u - x_0.t`
    fn work(&self) -> f64 {
        dot(&self.program.f, &self.at.u) - dot(&self.program.x_0, &self.at.t)
    }

    /// The mean of the products of all pairs.
    fn mean(&self) -> f64 {
        let count = self.at.t.len() as f64;
        (self.at.mean_product() * count + self.tau * self.kappa) / (count + 1.0)
    }

    /// One step of Mehrotra's method with Gondzio's correctors; gives its length.
    fn advance(&mut self, factors: &mut Factors, defect: Defect) -> f64 {
        let Some((newton, affine)) = Newton::of(self, factors, defect) else { return 0.0 };
        let mean = self.mean();
        let free = self.longest(&affine);
        let centring = (1.0 - free).powi(3).min(1.0);
        let aim = centring * mean;
        let mut step = newton.step(1.0 - centring, aim, &affine);
        drop(affine);
        let mut alpha = self.longest(&step);
        for _ in 0..CORRECTORS {
            if alpha >= LONG_ENOUGH {
                break;
            }
            let trial = (1.5 * alpha + 0.3).min(1.0);
            let corrector = newton.corrector(&step.at, trial, aim.max(LEAST_AIM * mean));
            let corrected = step.plus(&corrector);
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
        *self = Self::new(self.program, at, tau, kappa);
        alpha
    }

    /// The largest step, at most one, that leaves all variables positive.
    fn longest(&self, step: &Step) -> f64 {
        let pairs = [(self.tau, step.tau), (self.kappa, step.kappa)];
        longest(pairs.into_iter()).min(self.at.longest(&step.at))
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
    /// With the springs that Newton's method puts in the place of the pairs.
    factors: &'a Factors,
    defect: Defect,
    /// The step of `u` and `t` for a step of one of `tau`.
    of_tau: Variables,
    /// The derivatives of the equation of `kappa` by `u` and `t`.
    border: (Vec<f64>, Vec<f64>),
    /// What is left of that equation.
    rest: f64,
    /// Its coefficient of the step of `tau`, when all others are eliminated.
    pivot: f64,
}

/// What a step has to make good, and the changes of the products of the pairs, to first order: `y dt + t dy = target`.
struct Aim<'a> {
    balance: Vec<f64>,
    gaps: &'a [f64],
    /// The part of the gaps that counts.
    part: f64,
    targets: Vec<f64>,
}

impl<'a> Newton<'a> {
    /// With the step to products of zero.
    fn of(
        now: &'a Homogeneous<'a>,
        factors: &'a mut Factors,
        defect: Defect,
    ) -> Option<(Self, Step)> {
        let Homogeneous { program, at, tau, kappa, strained, .. } = now;
        let pairs = at.t.iter().zip(&at.y).zip(&program.compliance);
        let stiffness: Vec<f64> = pairs.map(|((t, y), c)| 1.0 / (y / t + c + COMPLIANCE)).collect();
        factors.factorise(program, stiffness, PROXIMAL)?;
        let data = program.x_0.iter().zip(&program.compliance).zip(&at.t);
        let by_u = program.f.iter().zip(strained).map(|(f, k)| f - 2.0 * k / tau).collect();
        let by_t = data.map(|((x, c), t)| x + 2.0 * c * t / tau).collect();
        let contacts = program.compliance.iter().zip(&at.t).map(|(c, t)| c * t * t).sum::<f64>();
        let energy = (dot(strained, &at.u) + contacts) / tau;
        let none = Variables { u: Vec::new(), t: Vec::new(), y: Vec::new() };
        let mut newton = Self {
            now,
            factors,
            defect,
            of_tau: none,
            border: (by_u, by_t),
            rest: now.work() - energy - kappa,
            pivot: 0.0,
        };
        let of_data = Aim {
            balance: program.f.clone(),
            gaps: &program.x_0,
            part: 1.0,
            targets: vec![0.0; at.t.len()],
        };
        let to_zero = Aim {
            balance: newton.defect.balance.clone(),
            gaps: &newton.defect.gaps,
            part: 1.0,
            targets: at.t.iter().zip(&at.y).map(|(t, y)| -t * y).collect(),
        };
        let [of_tau, affine] = newton.held(&[of_data, to_zero]);
        newton.pivot = newton.across(&of_tau) + (energy + kappa) / tau;
        newton.of_tau = of_tau;
        let affine = newton.bordered(&affine, newton.rest, -tau * kappa);
        Some((newton, affine))
    }

    /// The product of the border with a step of `u` and `t`.
    fn across(&self, step: &Variables) -> f64 {
        let (by_u, by_t) = &self.border;
        dot(by_u, &step.u) - dot(by_t, &step.t)
    }

    /// The step that reduces the residuals of all equations by a part, with products of an aim in the end, less the
    /// second-order term of a predictor.
    fn step(&self, part: f64, aim: f64, predictor: &Step) -> Step {
        let Homogeneous { at, tau, kappa, .. } = self.now;
        let pairs = at.t.iter().zip(&at.y).zip(predictor.at.t.iter().zip(&predictor.at.y));
        let aims = Aim {
            balance: self.defect.balance.iter().map(|v| part * v).collect(),
            gaps: &self.defect.gaps,
            part,
            targets: pairs.map(|((t, y), (dt, dy))| aim - t * y - dt * dy).collect(),
        };
        let [held] = self.held(&[aims]);
        let second = predictor.tau * predictor.kappa;
        self.bordered(&held, part * self.rest, aim - tau * kappa - second)
    }

    /// The step that brings the products back among those that are central, where another one leads, and changes nothing
    /// else.
    fn corrector(&self, step: &Variables, alpha: f64, aim: f64) -> Step {
        let Variables { t, y, .. } = &self.now.at;
        let (low, high) = (CENTRAL.0 * aim, CENTRAL.1 * aim);
        let correction = |((t, y), (dt, dy)): ((&f64, &f64), (&f64, &f64))| {
            let (t, y) = (t + alpha * dt, y + alpha * dy);
            // Two negative values are as far outside as one.
            let product = if t < 0.0 && y < 0.0 { -t * y } else { t * y };
            if product < low {
                low - product
            } else if product > high {
                (high - product).max(-high)
            } else {
                0.0
            }
        };
        let aims = Aim {
            balance: vec![0.0; self.now.at.u.len()],
            gaps: &self.defect.gaps,
            part: 0.0,
            targets: t.iter().zip(y).zip(step.t.iter().zip(&step.y)).map(correction).collect(),
        };
        let [held] = self.held(&[aims]);
        self.bordered(&held, 0.0, 0.0)
    }

    /// Steps at `tau` as it is.
    fn held<const N: usize>(&self, aims: &[Aim<'_>; N]) -> [Variables; N] {
        let Homogeneous { program, at, .. } = self.now;
        let Factors { gram, stiffness, .. } = self.factors;
        let n = at.u.len();
        let mut all = Vec::with_capacity(N * n);
        // Forces that do not depend on the displacements.
        let fixed = aims.each_ref().map(|aim| {
            let pairs = stiffness.iter().zip(aim.targets.iter().zip(&at.t)).zip(aim.gaps);
            let force = |((stiffness, (target, t)), gap): ((&f64, (&f64, &f64)), &f64)| {
                stiffness * (target / t - aim.part * gap)
            };
            let fixed: Vec<f64> = pairs.map(force).collect();
            let begin = all.len();
            all.extend_from_slice(&aim.balance);
            program.add_forces(&fixed, &mut all[begin..]);
            fixed
        });
        gram.solve(&mut all);
        let mut at_once = fixed.into_iter().zip(aims).enumerate();
        std::array::from_fn(|_| {
            let Some((place, (mut t, aim))) = at_once.next() else {
                unreachable!("one for every aim")
            };
            let u = all[place * n..(place + 1) * n].to_vec();
            let mut y = program.opened(&u);
            t.iter_mut().zip(&y).zip(stiffness).for_each(|((t, y), s)| *t -= s * y);
            let data = aim.gaps.iter().zip(&aim.targets).zip(&program.compliance);
            let pairs = at.t.iter().zip(&at.y).zip(&t).zip(data);
            // Of the two equations for `dy` the one that keeps the digits: the second where `t` is the larger one.
            for (y, (((t, gap), dt), ((lack, target), c))) in y.iter_mut().zip(pairs) {
                *y = if t > gap { (target - gap * dt) / t } else { *y + c * dt + aim.part * lack };
            }
            Variables { u, t, y }
        })
    }

    /// A step at `tau` as it is, with what it takes to make good `rest` of the equation of `kappa` and to change
    /// `tau kappa` by `target`.
    fn bordered(&self, held: &Variables, rest: f64, target: f64) -> Step {
        let Homogeneous { tau, kappa, .. } = self.now;
        let change = (target / tau - rest - self.across(held)) / self.pivot;
        let at = held.moved(&self.of_tau, change);
        Step { at, tau: change, kappa: (target - kappa * change) / tau }
    }
}
