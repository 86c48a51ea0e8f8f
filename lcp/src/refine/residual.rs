//! Residuals of the equations.

use super::point::ExtendedPoint;
use crate::certify::ratio;
use crate::extended::Extended;
use crate::problem::ContactStatus;
use crate::problem::column_of;
use crate::states::{Point, Scaled};
use crate::vector::{HALF_DIGITS, WEAK, max_abs};

/// Residuals of the equations of the states.
pub(super) struct EquationResidual {
    /// `f + C^T t - K u`.
    pub(super) unbalanced: Vec<Extended>,
    /// Gap and slip if the state requires them to be zero.
    pub(super) opened: Vec<[Extended; 2]>,
    /// The largest residual, relative to the terms of its row.
    pub(super) largest: f64,
}

/// Numbers that are added to loads, and to gaps and slips of closed contacts.
#[derive(Debug, Clone)]
pub(super) struct Shifts {
    loads: Vec<Extended>,
    gaps: Vec<[Extended; 2]>,
    /// The largest shift, relative to the terms of its row.
    pub(super) largest: f64,
}

impl Shifts {
    /// Shifts of zero.
    pub(super) fn new(scaled: &Scaled) -> Self {
        let gaps = vec![[Extended::ZERO; 2]; scaled.points.len()];
        Self { loads: vec![Extended::ZERO; scaled.order()], gaps, largest: 0.0 }
    }

    /// Subtracts the residual from the shifts.
    pub(super) fn absorb(&mut self, rest: &EquationResidual) {
        self.largest = self.largest.max(rest.largest);
        self.loads.iter_mut().zip(&rest.unbalanced).for_each(|(load, rest)| *load += -*rest);
        for (gaps, opened) in self.gaps.iter_mut().zip(&rest.opened) {
            *gaps = [gaps[0] - opened[0], gaps[1] - opened[1]];
        }
    }
}

impl EquationResidual {
    /// The residual in double-double arithmetic.
    pub(super) fn extended(
        scaled: &Scaled,
        statuses: &[ContactStatus],
        at: &ExtendedPoint,
        shifts: &Shifts,
        floating: &[bool],
    ) -> Self {
        let (u, forces) = at.rounded();
        let (force, length) = at.sizes(scaled);
        let mut largest = 0.0_f64;
        let mut unbalanced = on_bodies(scaled, &at.forces);
        for ((rest, f), shift) in unbalanced.iter_mut().zip(&scaled.f).zip(&shifts.loads) {
            *rest += *shift + (*f).into();
        }
        for (j, u) in at.u.iter().enumerate() {
            column_of(&scaled.k, j).for_each(|(i, v)| unbalanced[i] += -(*u * v));
        }
        let terms = scaled.terms(&u, &forces);
        for ((rest, terms), floats) in unbalanced.iter_mut().zip(&terms).zip(floating) {
            if *floats {
                *rest = Extended::ZERO;
            }
            largest = largest.max(ratio(rest.rounded(), terms.max(WEAK * force)));
        }
        let mut opened = Vec::with_capacity(statuses.len());
        let points = scaled.points.iter().zip(statuses).zip(at.forces.iter().zip(&forces));
        for (((point, status), ([t_n, t_t], rounded)), shifts) in points.zip(&shifts.gaps) {
            let mut row = |sum: Extended, first: f64, k: usize| {
                let pressed = (point.compliance[k] * [rounded.0, rounded.1][k]).abs();
                let terms = point.columns.iter().zip(point.coefficients);
                let terms = terms.map(|(&j, v)| (u[j] * v[k]).abs());
                let terms = terms.fold(first.abs() + pressed, |sum, term| sum + term);
                largest = largest.max(ratio(sum.rounded(), terms.max(WEAK * length)));
                sum
            };
            let [gap, slip] = status.is_closed(point.mu);
            let gap = gap.then(|| row(shifts[0] + at.gap(point, *t_n), point.x_0, 0));
            let slip = slip.then(|| row(shifts[1] + at.slip(point, *t_t), point.s_0, 1));
            opened.push([gap, slip].map(Option::unwrap_or_default));
        }
        Self { unbalanced, opened, largest }
    }

    /// The residual in `f64`, without a comparison with terms.
    pub(super) fn usual(
        scaled: &Scaled,
        statuses: &[ContactStatus],
        at: &ExtendedPoint,
        floating: &[bool],
    ) -> Self {
        let (u, forces) = at.rounded();
        let mut unbalanced = scaled.unbalanced(&u, forces.iter().copied());
        unbalanced.iter_mut().zip(floating).filter(|(_, is)| **is).for_each(|(v, _)| *v = 0.0);
        let points = scaled.points.iter().zip(statuses).zip(forces);
        let closed = points.map(|((point, status), forces)| {
            let (gap, slip) = status.opened(point, &u, forces.into());
            [gap, slip].map(Extended::from)
        });
        let opened: Vec<[Extended; 2]> = closed.collect();
        let closed = opened.iter().flatten().map(|it| it.rounded().abs());
        let largest = closed.fold(max_abs(&unbalanced), f64::max);
        let unbalanced = unbalanced.into_iter().map(Extended::from).collect();
        Self { unbalanced, opened, largest }
    }
}

/// The forces of all contacts on the displacements.
pub(super) fn on_bodies(scaled: &Scaled, forces: &[[Extended; 2]]) -> Vec<Extended> {
    let mut sum = vec![Extended::ZERO; scaled.order()];
    for (point, [t_n, t_t]) in scaled.points.iter().zip(forces) {
        for (&j, &[n, t]) in point.columns.iter().zip(point.coefficients) {
            sum[j] += *t_n * n + *t_t * t;
        }
    }
    sum
}

/// Displacements of bodies without loads that no closed contact touches: their position is not
/// determined.
pub(super) fn floating(scaled: &Scaled, statuses: &[ContactStatus]) -> Vec<bool> {
    let closed = |i: usize| statuses[i] != ContactStatus::Open;
    unreached(scaled, closed)
}

/// The states with all contacts opened that press, if at all, on bodies without loads that no contact
/// presses.
pub(super) fn without_idle(
    scaled: &Scaled,
    statuses: &[ContactStatus],
    at: &ExtendedPoint,
) -> Vec<ContactStatus> {
    let none = Extended::from(HALF_DIGITS * at.sizes(scaled).0);
    let is_pressed = |i: usize| at.forces[i].iter().any(|t| t.abs() > none);
    let idle = unreached(scaled, |i| statuses[i] != ContactStatus::Open && is_pressed(i));
    let points = scaled.points.iter().zip(statuses);
    let of_point = |(point, status): (Point<'_>, &ContactStatus)| {
        if touched(point).any(|j| idle[j]) { ContactStatus::Open } else { *status }
    };
    points.map(of_point).collect()
}

/// Displacements of bodies without loads that these contacts do not touch.
fn unreached(scaled: &Scaled, touches: impl Fn(usize) -> bool) -> Vec<bool> {
    let mut left: Vec<bool> = scaled.f.iter().map(|f| *f == 0.0).collect();
    for (_, point) in scaled.points.iter().enumerate().filter(|(i, _)| touches(*i)) {
        touched(point).for_each(|j| left[j] = false);
    }
    let mut reached: Vec<usize> = (0..left.len()).filter(|&j| !left[j]).collect();
    while let Some(j) = reached.pop() {
        for (i, _) in column_of(&scaled.k, j) {
            if std::mem::replace(&mut left[i], false) {
                reached.push(i);
            }
        }
    }
    left
}

/// The displacements on which a point depends.
pub(super) fn touched(point: Point<'_>) -> impl Iterator<Item = usize> {
    let rows = point.columns.iter().zip(point.coefficients);
    let seen = rows.filter(move |(_, [n, t])| *n != 0.0 || point.mu > 0.0 && *t != 0.0);
    seen.map(|(&j, _)| j)
}
