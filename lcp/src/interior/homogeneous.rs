//! Convex programs as part of a homogeneous problem, which always has a solution: the solution of the program, or a
//! proof that there is none.

use super::constants::{
    FRACTION_TO_BOUNDARY, LEAST_AIM, LOADS, PATIENCE, TRIAL_REDUCTION, TRIAL_RESIDUAL,
};
use super::program::{Program, ProgramFactors};
use super::step::{correction, lengthened};
use super::variables::{Variables, dot};
use crate::Status;
use crate::states::PROXIMAL;
use crate::vector::{HALF_DIGITS, ROUNDING, max_abs};

/// The accuracy that a solution must have.
#[derive(Debug, Clone, Copy)]
pub(super) enum Accuracy {
    /// Equations and pairs to this tolerance, relative to the largest force and gap.
    OfAll(f64),
    /// Equations to this tolerance, with the balance relative to at most a multiple of the largest load; the smaller
    /// one of each pair to a tenth of the root of the tolerance. The residual of the balance is then distributed.
    OfForces(f64),
}

impl Accuracy {
    pub(super) fn tolerance(self) -> f64 {
        let (Self::OfAll(tolerance) | Self::OfForces(tolerance)) = self;
        tolerance
    }
}

/// The end of an iteration: a point, and the reason for which it is the last.
pub(super) struct End {
    pub(super) at: Variables,
    pub(super) status: Status,
}

/// A point of the homogeneous problem of Andersen and Ye (1999),
///
/// ```text
/// K u = f tau + A t,   y = A^T u + D t + x_0 tau,   kappa = f.u - x_0.t - (u.K u + t.D t) / tau,
/// t y = 0,   tau kappa = 0,   t, y, tau, kappa >= 0.
/// ```
///
/// `u / tau` and `t / tau` are a solution of the problem if `tau > 0`; `u` and `t` prove that there is none if
/// `kappa > 0`.
pub(super) struct Homogeneous<'a> {
    program: &'a Program,
    pub(super) at: Variables,
    /// `K u` and `A^T u`.
    strained: Vec<f64>,
    opened: Vec<f64>,
}

/// The residuals of the equations at a point.
pub(super) struct HomogeneousDefect {
    /// `f tau + A t - K u`
    pub(super) balance: Vec<f64>,
    /// `A^T u + D t + x_0 tau - y`
    gaps: Vec<f64>,
}

/// The solution of a program, or `u` and `t` that prove that there is none.
pub(super) fn iterate(
    program: &Program,
    factors: &mut ProgramFactors,
    accuracy: Accuracy,
    mut stop: impl FnMut(f64) -> Option<Status>,
    mut is_proof: impl FnMut(&Variables) -> bool,
) -> End {
    let Some(at) = Variables::start(program, factors) else {
        return End { at: Variables::zero(program), status: Status::Stalled };
    };
    let mut now = Homogeneous::new(program, at);
    let tolerance = accuracy.tolerance();
    let (mut least, mut since, mut provable) = ([f64::INFINITY; 3], 0, TRIAL_RESIDUAL);
    loop {
        let defect = now.defect();
        let residual = now.residual(&defect, accuracy);
        let error = now.error_of_proof();
        if residual <= tolerance {
            // Rounding by the division may take a point beyond the tolerance again.
            let solved = Homogeneous::new(program, now.at.clone().solution());
            if solved.residual(&solved.defect(), accuracy) <= tolerance {
                return End { at: solved.at, status: Status::Solved };
            }
        }
        if error <= provable {
            provable = TRIAL_REDUCTION * error;
            if is_proof(&now.at) {
                return End { at: now.at, status: Status::Infeasible };
            }
            if let Some(at) = now.projected(factors, error)
                && is_proof(&at)
            {
                return End { at, status: Status::Infeasible };
            }
        }
        if let Some(status) = stop(residual.min(error)) {
            return End { at: now.at.solution(), status };
        }
        // The error of a point far from a proof may stay at its minimum for long, while the other merits go on.
        let merits = [residual, error, now.at.mean_product()];
        let is_better = merits.iter().zip(&least).any(|(merit, least)| *merit < 0.9 * least);
        since = if is_better { 0 } else { since + 1 };
        least = [0, 1, 2].map(|k| least[k].min(merits[k]));
        let alpha = now.advance(factors, defect);
        // Some iterations make no progress for twenty steps and then go on.
        if alpha < HALF_DIGITS || since > 2 * PATIENCE {
            return End { at: now.at.solution(), status: Status::Stalled };
        }
    }
}

impl<'a> Homogeneous<'a> {
    pub(super) fn new(program: &'a Program, at: Variables) -> Self {
        let (strained, opened) = (program.strained(&at.u), program.opened(&at.u));
        Self { program, at, strained, opened }
    }

    pub(super) fn residual(&self, defect: &HomogeneousDefect, accuracy: Accuracy) -> f64 {
        let Variables { u, t, y, tau, .. } = &self.at;
        let (force, length) = (max_abs(t).max(*tau), max_abs(y).max(*tau));
        let (unit, opening, part) = match accuracy {
            Accuracy::OfAll(_) => (force, length, 1.0),
            Accuracy::OfForces(tolerance) => {
                // Rounding leaves some last digits of the largest force, and of the largest free variable.
                let rounded = |size: f64| ROUNDING * size / tolerance;
                let load = LOADS * tau * max_abs(&self.program.f);
                let unit = load.max(rounded(force)).min(force);
                (unit, length.max(rounded(max_abs(u))), 10.0 * tolerance.sqrt())
            }
        };
        let defect = (max_abs(&defect.balance) / unit).max(max_abs(&defect.gaps) / opening);
        let natural = t.iter().zip(y).map(|(t, y)| (t / force).min(y / length));
        natural.fold(defect, |max, v| max.max(part * v.abs()))
    }

    /// Distance of the point from a proof: the largest quantity that has to vanish, relative to the work of loads and
    /// gaps, which has to be positive.
    fn error_of_proof(&self) -> f64 {
        let work = self.work();
        if work <= 0.0 {
            return f64::INFINITY;
        }
        let forces = self.program.compliance.iter().zip(&self.at.t);
        let against = self.opened.iter().zip(forces).map(|(opened, (c, t))| (-opened).max(c * t));
        against.fold(max_abs(&self.strained), f64::max) / work
    }

    pub(super) fn defect(&self) -> HomogeneousDefect {
        let Self { program, at, .. } = self;
        let tau = at.tau;
        let mut balance: Vec<f64> =
            program.f.iter().zip(&self.strained).map(|(f, strained)| tau * f - strained).collect();
        program.add_forces(&at.t, &mut balance);
        let data = program.x_0.iter().zip(&program.compliance);
        let pairs = self.opened.iter().zip(data).zip(at.t.iter().zip(&at.y));
        let gaps = pairs.map(|((opened, (x, c)), (t, y))| opened + tau * x + c * t - y).collect();
        HomogeneousDefect { balance, gaps }
    }

    /// The point with the nearest `u` that strains nothing and leaves closed the pairs that the point opens by no more
    /// than the root of its error: a proof whose products vanish is not contradicted by rounding errors there. Each
    /// solve reduces these products to a part [`HALF_DIGITS`].
    fn projected(&self, factors: &mut ProgramFactors, error: f64) -> Option<Variables> {
        let most = error.sqrt() * self.work();
        let closed = self.opened.iter().map(|opened| f64::from(u8::from(*opened <= most)));
        factors.factorise(self.program, closed.collect(), HALF_DIGITS)?;
        let mut at = self.at.clone();
        for _ in 0..2 {
            at.u.iter_mut().for_each(|u| *u *= HALF_DIGITS);
            factors.gram.solve(&mut at.u);
        }
        Some(at)
    }

    /// `f.u - x_0.t`
    fn work(&self) -> f64 {
        dot(&self.program.f, &self.at.u) - dot(&self.program.x_0, &self.at.t)
    }

    /// Takes one step of Mehrotra's method with Gondzio's correctors; returns its length.
    fn advance(&mut self, factors: &mut ProgramFactors, defect: HomogeneousDefect) -> f64 {
        let Some((newton, affine)) = Newton::of(self, factors, defect) else { return 0.0 };
        let at = &self.at;
        let mean = at.mean_product();
        let centring = (1.0 - at.longest(&affine)).powi(3).min(1.0);
        let aim = centring * mean;
        let step = newton.step(1.0 - centring, aim, &affine);
        drop(affine);
        let corrector = |step: &Variables, trial: f64| {
            let trial = at.moved(step, trial);
            step.moved(&newton.corrector(&trial, aim.max(LEAST_AIM * mean)), 1.0)
        };
        let (step, alpha) = lengthened(step, |step| at.longest(step), corrector);
        let alpha = (FRACTION_TO_BOUNDARY * alpha).min(1.0);
        let next = at.moved(&step, alpha);
        if !next.is_finite() {
            return 0.0;
        }
        *self = Self::new(self.program, next);
        alpha
    }
}

/// Newton's equations at a point: those of the problem, bordered by those of `tau` and `kappa`.
struct Newton<'a> {
    program: &'a Program,
    at: &'a Variables,
    /// Factors with the springs by which Newton's method replaces the pairs.
    factors: &'a ProgramFactors,
    defect: HomogeneousDefect,
    /// The step of `u` and `t` for a unit step of `tau`.
    of_tau: Variables,
    /// The derivatives of the equation of `kappa` by `u` and `t`.
    border: (Vec<f64>, Vec<f64>),
    /// The residual of the equation of `kappa`.
    rest: f64,
    /// The coefficient of the step of `tau` in the equation of `kappa`, when all other steps are eliminated.
    pivot: f64,
}

/// The residuals that a step has to remove, and the changes of the products of the pairs, to first order: `y dt + t dy = target`.
struct Aim<'a> {
    balance: Vec<f64>,
    gaps: &'a [f64],
    /// The part of the residuals of the gaps that the step removes.
    part: f64,
    targets: Vec<f64>,
}

impl<'a> Newton<'a> {
    /// The equations of a point, with the step to products of zero.
    fn of(
        now: &'a Homogeneous<'a>,
        factors: &'a mut ProgramFactors,
        defect: HomogeneousDefect,
    ) -> Option<(Self, Variables)> {
        let Homogeneous { program, at, strained, .. } = now;
        let Variables { u, t, y, tau, kappa } = at;
        let pairs = t.iter().zip(y).zip(&program.compliance);
        let stiffness: Vec<f64> =
            pairs.map(|((t, y), c)| 1.0 / (y / t + c + HALF_DIGITS)).collect();
        factors.factorise(program, stiffness, PROXIMAL)?;
        let data = program.x_0.iter().zip(&program.compliance).zip(t);
        let by_u = program.f.iter().zip(strained).map(|(f, k)| f - 2.0 * k / tau).collect();
        let by_t = data.map(|((x, c), t)| x + 2.0 * c * t / tau).collect();
        let contacts = program.compliance.iter().zip(t).map(|(c, t)| c * t * t).sum::<f64>();
        let energy = (dot(strained, u) + contacts) / tau;
        let rest = now.work() - energy - kappa;
        let border = (by_u, by_t);
        let of_tau = Variables::zero(program);
        let mut newton =
            Self { program, at, factors, defect, of_tau, border, rest, pivot: f64::NAN };
        let of_data = Aim {
            balance: program.f.clone(),
            gaps: &program.x_0,
            part: 1.0,
            targets: vec![0.0; t.len()],
        };
        let to_zero = Aim {
            balance: newton.defect.balance.clone(),
            gaps: &newton.defect.gaps,
            part: 1.0,
            targets: t.iter().zip(y).map(|(t, y)| -t * y).collect(),
        };
        let [of_tau, affine] = newton.held(&[of_data, to_zero]);
        newton.pivot = newton.across(&of_tau) + (energy + kappa) / tau;
        newton.of_tau = of_tau;
        let affine = newton.bordered(&affine, rest, -tau * kappa);
        Some((newton, affine))
    }

    /// The product of the border with a step of `u` and `t`.
    fn across(&self, step: &Variables) -> f64 {
        let (by_u, by_t) = &self.border;
        dot(by_u, &step.u) - dot(by_t, &step.t)
    }

    /// The step that reduces the residuals of all equations by `part` and takes the products to `aim`, with the
    /// second-order correction of a predictor.
    fn step(&self, part: f64, aim: f64, predictor: &Variables) -> Variables {
        let Variables { t, y, tau, kappa, .. } = self.at;
        let pairs = t.iter().zip(y).zip(predictor.t.iter().zip(&predictor.y));
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

    /// The step that brings the products at a trial point back among those that are central, and changes nothing else.
    fn corrector(&self, trial: &Variables, aim: f64) -> Variables {
        let pairs = trial.t.iter().zip(&trial.y);
        let aims = Aim {
            balance: vec![0.0; trial.u.len()],
            gaps: &self.defect.gaps,
            part: 0.0,
            targets: pairs.map(|(t, y)| correction(*t, *y, aim)).collect(),
        };
        let [held] = self.held(&[aims]);
        self.bordered(&held, 0.0, 0.0)
    }

    /// Steps at constant `tau` and `kappa`.
    fn held<const N: usize>(&self, aims: &[Aim<'_>; N]) -> [Variables; N] {
        let Self { program, at, .. } = self;
        let ProgramFactors { gram, stiffness, .. } = self.factors;
        let n = at.u.len();
        let mut all = Vec::with_capacity(N * n);
        // Forces that do not depend on the displacements.
        let mut fixed = aims.each_ref().map(|aim| {
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
        std::array::from_fn(|k| {
            let (aim, mut t) = (&aims[k], std::mem::take(&mut fixed[k]));
            let u = all[k * n..(k + 1) * n].to_vec();
            let mut y = program.opened(&u);
            t.iter_mut().zip(&y).zip(stiffness).for_each(|((t, y), s)| *t -= s * y);
            let data = aim.gaps.iter().zip(&aim.targets).zip(&program.compliance);
            let pairs = at.t.iter().zip(&at.y).zip(&t).zip(data);
            // The equation for `dy`, one of two, that keeps the digits: the second if `t` is the larger one.
            for (y, (((t, gap), dt), ((lack, target), c))) in y.iter_mut().zip(pairs) {
                *y = if t > gap { (target - gap * dt) / t } else { *y + c * dt + aim.part * lack };
            }
            Variables { u, t, y, tau: 0.0, kappa: 0.0 }
        })
    }

    /// A step at constant `tau`, plus the step that removes the residual `rest` of the equation of `kappa` and changes
    /// `tau kappa` by `target`.
    fn bordered(&self, held: &Variables, rest: f64, target: f64) -> Variables {
        let Variables { tau, kappa, .. } = self.at;
        let change = (target / tau - rest - self.across(held)) / self.pivot;
        let kappa = (target - kappa * change) / tau;
        Variables { tau: change, kappa, ..held.moved(&self.of_tau, change) }
    }
}
