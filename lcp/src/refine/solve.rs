//! Passes with one factorisation, and the conditions for their end.

use web_time::Instant;

use super::answer::{Refined, Refinement};
use super::constants::{ALL_DIGITS, PASSES, PATIENCE, WEIGHTS, Weights};
use super::law::{self, Margin};
use super::point::ExtendedPoint;
use super::residual::{self, EquationResidual, Shifts};
use crate::certify::ratio;
use crate::extended::Extended;
use crate::matrix::DATA_ROUNDING;
use crate::problem::ContactStatus;
use crate::states::{Condensed, PointRef, Scaled, Springs};
use crate::vector::{HALF_DIGITS, max_abs};
use crate::{ContactState, Error};

/// The answer, and the slacks of the inequalities of every contact.
pub(super) fn solved(
    scaled: &Scaled,
    state: &ContactState,
    statuses: &[ContactStatus],
    refinement: Refinement,
) -> Result<(Refined, Vec<(f64, ContactStatus)>), Error> {
    let began = Instant::now();
    let mut condensed = planned(scaled)?;
    let mut solved = |weights, passes| {
        let at = ExtendedPoint::from(scaled, state);
        let mut solve = Solve::new(scaled, &mut condensed, at, statuses, weights);
        solve.run(refinement);
        solve.passes += passes;
        (solve.rest().largest, solve.finish(began.elapsed().as_secs_f64()))
    };
    let (residual, answer) = solved(WEIGHTS[0], 0);
    // Other weights are tried if less than three quarters of all digits are right.
    if refinement == Refinement::Extended && residual > HALF_DIGITS.powi(3) {
        let (other_residual, other) = solved(WEIGHTS[1], answer.0.passes);
        if other_residual < residual {
            return Ok(other);
        }
    }
    Ok(answer)
}

/// Displacements in units of the data, and forces in those of the scaled problem.
pub(crate) type Exact = (Vec<Extended>, Vec<[Extended; 2]>);

/// The solutions of the equations of the states from a scaled point, one for each of the weights, refined to a
/// residual of `enough`, such as [`ALL_DIGITS`](super::ALL_DIGITS) or [`ROUNDED`](super::ROUNDED).
pub(crate) fn refined_states(
    scaled: &Scaled,
    condensed: &mut Condensed,
    at: PointRef<'_>,
    statuses: &[ContactStatus],
    enough: f64,
) -> impl Iterator<Item = Exact> {
    let at = ExtendedPoint::of(at.u, at.forces);
    WEIGHTS.into_iter().map(move |weights| {
        let mut solve = Solve::new(scaled, &mut *condensed, at.clone(), statuses, weights);
        solve.refine(enough);
        (solve.at.displacements(scaled), solve.at.forces)
    })
}

/// The matrix of the equations of any states.
pub(crate) fn planned(scaled: &Scaled) -> Result<Condensed, Error> {
    Condensed::new(scaled).map_err(|error| Error::Factors { what: "K", reason: error.to_string() })
}

/// One solve.
struct Solve<'a> {
    scaled: &'a Scaled,
    statuses: &'a [ContactStatus],
    springs: Vec<Springs>,
    condensed: &'a mut Condensed,
    /// Displacements that are not changed.
    floating: Vec<bool>,
    shifts: Shifts,
    at: ExtendedPoint,
    /// The change of `C^T t` by the last pass, relative to the largest.
    correction: f64,
    /// The largest correction before a shift.
    shifted: f64,
    passes: usize,
}

impl<'a> Solve<'a> {
    fn new(
        scaled: &'a Scaled,
        condensed: &'a mut Condensed,
        mut at: ExtendedPoint,
        statuses: &'a [ContactStatus],
        weights: Weights,
    ) -> Self {
        let all = scaled.points.iter().zip(statuses);
        let springs: Vec<Springs> =
            all.clone().map(|(point, status)| status.springs(point, weights.stiff)).collect();
        for ((point, status), forces) in all.zip(&mut at.forces) {
            *forces = status.on_cone(point.mu, *forces);
        }
        condensed.factorise(scaled, &springs, weights.proximal);
        Self {
            scaled,
            statuses,
            springs,
            condensed,
            floating: residual::floating(scaled, statuses),
            shifts: Shifts::new(scaled),
            at,
            correction: 0.0,
            shifted: 0.0,
            passes: 0,
        }
    }

    fn run(&mut self, refinement: Refinement) {
        let passes = match refinement {
            Refinement::Plain => 1,
            Refinement::Single => 2,
            Refinement::Extended => return self.refine(ALL_DIGITS),
        };
        for _ in 0..passes {
            let rest =
                EquationResidual::usual(self.scaled, self.statuses, &self.at, &self.floating);
            self.pass(&rest);
            let (u, forces) = self.at.rounded();
            self.at = ExtendedPoint::of(&u, &forces);
        }
    }

    fn refine(&mut self, enough: f64) {
        let given = self.at.clone();
        let (mut rest, mut since) = (self.rest(), 0);
        while self.passes < PASSES && rest.largest.is_finite() && rest.largest > enough {
            let residual = rest.largest;
            let before = (self.at.clone(), self.correction);
            self.pass(&rest);
            rest = self.rest();
            since = if rest.largest <= 0.5 * residual { 0 } else { since + 1 };
            if since < PATIENCE {
                continue;
            }
            if rest.largest > DATA_ROUNDING {
                if rest.largest > residual {
                    (self.at, self.correction) = before;
                }
                break;
            }
            // The rest cannot be reduced by displacements and forces, which would only grow.
            self.shifts.absorb(&rest);
            self.shifted = self.shifted.max(self.correction);
            self.at = given.clone();
            (rest, since) = (self.rest(), 0);
        }
    }

    fn rest(&self) -> EquationResidual {
        let Self { scaled, statuses, shifts, at, floating, .. } = self;
        EquationResidual::extended(scaled, statuses, at, shifts, floating)
    }

    /// Solves for the corrections that remove the residual.
    fn pass(&mut self, rest: &EquationResidual) {
        let unbalanced = rest.unbalanced.iter().map(|v| v.rounded()).collect();
        let opened = rest.opened.iter().map(|[gap, slip]| (gap.rounded(), slip.rounded()));
        let (step, of_forces) = self.condensed.step(self.scaled, &self.springs, unbalanced, opened);
        let (mut changes, mut size) = (vec![0.0; step.len()], vec![0.0; step.len()]);
        for (i, (point, change)) in self.scaled.points.iter().zip(of_forces).enumerate() {
            point.add_forces(change.0, change.1, &mut changes);
            let forces = &mut self.at.forces[i];
            forces[0] += change.0.into();
            forces[1] += change.1.into();
            // The forces are on the edge of the cone to the last digit.
            *forces = self.statuses[i].on_cone(point.mu, *forces);
            point.add_forces(forces[0].rounded(), forces[1].rounded(), &mut size);
        }
        for (u, du) in self.at.u.iter_mut().zip(&step) {
            *u += (*du).into();
        }
        self.correction = ratio(max_abs(&changes), max_abs(&size));
        self.passes += 1;
    }

    fn finish(self, seconds: f64) -> (Refined, Vec<(f64, ContactStatus)>) {
        let (residual, correction) = (self.rest().largest, self.correction.max(self.shifted));
        let Self { scaled, statuses, at, shifts, floating, passes, .. } = self;
        let floats = |i: usize| residual::touched(scaled.points.get(i)).any(|j| floating[j]);
        let slacks: Vec<(f64, ContactStatus)> = law::slacks(scaled, statuses, &at)
            .enumerate()
            // A floating body can be moved aside by a rounding error.
            .map(|(i, (slack, next))| {
                let is_free = slack > -HALF_DIGITS && floats(i);
                (if is_free { f64::INFINITY } else { slack }, next)
            })
            .collect();
        let force = scaled.force();
        let forces = |k: usize| at.forces.iter().map(|it| it[k].scaled(force)).collect();
        let on_bodies = residual::on_bodies(scaled, &at.forces);
        let on_bodies = on_bodies.iter().enumerate().map(|(j, f)| f.scaled(scaled.force_of(j)));
        let refined = Refined {
            u: at.displacements(scaled),
            t_n: forces(0),
            t_t: forces(1),
            on_bodies: on_bodies.collect(),
            residual,
            shift: shifts.largest,
            correction,
            margin: Margin::of(slacks.iter().copied()),
            passes,
            floating: floating.iter().filter(|it| **it).count(),
            seconds,
        };
        (refined, slacks)
    }
}
