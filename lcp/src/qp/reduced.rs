//! The linear system that is left of a form when it is known which multipliers are at their bounds.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::sparse::linalg::solvers::Lu;
use faer::{Mat, MatMut};

use super::form::{Bounds, Form, Point};
use crate::Matrix;
use crate::problem::{column_of, max_abs};

/// Where the multiplier of a row is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// Between its bounds, with a slack of zero.
    Inside,
    /// At the lower one.
    Lower,
    /// At the upper one.
    Upper,
}

/// The law that bounds the multipliers of cones.
#[derive(Debug, Clone, Copy)]
pub(super) enum Law<'a> {
    /// `mu` times another multiplier.
    Coulomb,
    /// A given bound for every row.
    Tresca(&'a [f64]),
}

impl Law<'_> {
    /// The bound on the size of a multiplier of a cone.
    pub(super) fn limit(&self, i: usize, normal: usize, mu: f64, lambda: &[f64]) -> f64 {
        match self {
            Self::Coulomb => mu * lambda[normal].max(0.0),
            Self::Tresca(limits) => limits[i],
        }
    }
}

/// Weight of the proximal terms, in scaled units: they make the matrix nonsingular, and every step with it
/// divides what is wrong by the ratio of a singular value to it.
const PROXIMAL: f64 = 1e-9;
/// Steps with one factorisation.
const STEPS: usize = 60;
/// Residual, where loads are near one, of which nothing is left.
const VANISHING: f64 = 1e-30;
/// A share of nonzero entries above which the matrix is factorised as a dense one.
const DENSE: f64 = 0.3;

/// Moves a point so that the multipliers at their bounds are there, all other slacks vanish and
/// stationarity holds, as well as that can be. Of several such points it finds one that is near.
///
/// Proximal steps (Rockafellar 1976): the matrix may be singular, as that of bodies that float or of
/// contacts that share a load, if only the system is consistent. None where the factorisation fails.
pub(super) fn solve_reduced(
    form: &Form,
    law: Law<'_>,
    places: &[Place],
    start: &Point,
) -> Option<Point> {
    let system = System::new(form, law, places)?;
    let mut point = start.clone();
    put_at_bounds(form, law, places, &mut point.lambda);
    let mut best = (point.clone(), f64::INFINITY);
    let mut idle = 0;
    for _ in 0..STEPS {
        let mut residual = system.residual(form, &point);
        let size = max_abs(&residual);
        if size < best.1 {
            idle = if size < 0.9 * best.1 { 0 } else { idle + 1 };
            best = (point.clone(), size);
        } else {
            idle += 1;
        }
        if size <= VANISHING || idle >= 3 {
            break;
        }
        system.factor.solve(&mut residual);
        for (x, step) in point.x.iter_mut().zip(&residual) {
            *x -= step;
        }
        for (&i, step) in system.active.iter().zip(&residual[form.unknowns()..]) {
            point.lambda[i] -= step;
        }
        put_at_bounds(form, law, places, &mut point.lambda);
        if !point.is_finite() {
            break;
        }
    }
    best.0.is_finite().then_some(best.0)
}

/// Gives the multipliers that are not inside the value of their bound.
fn put_at_bounds(form: &Form, law: Law<'_>, places: &[Place], lambda: &mut [f64]) {
    for (i, bounds) in form.bounds.iter().enumerate() {
        if *bounds == Bounds::Nonnegative && places[i] != Place::Inside {
            lambda[i] = 0.0;
        }
    }
    for (i, bounds) in form.bounds.iter().enumerate() {
        if let Bounds::Cone { normal, mu } = *bounds
            && let Some(sign) = side(places[i])
        {
            // Linear in the multiplier of the normal, also where that is negative on the way.
            lambda[i] = match law {
                Law::Coulomb => sign * mu * lambda[normal],
                Law::Tresca(limits) => sign * limits[i],
            };
        }
    }
}

/// The sign of a multiplier at a bound of its cone.
fn side(place: Place) -> Option<f64> {
    match place {
        Place::Inside => None,
        Place::Lower => Some(-1.0),
        Place::Upper => Some(1.0),
    }
}

/// The regularised system, factorised.
struct System {
    /// The rows inside.
    active: Vec<usize>,
    factor: Factor,
}

impl System {
    fn new(form: &Form, law: Law<'_>, places: &[Place]) -> Option<Self> {
        let n = form.unknowns();
        let active: Vec<usize> = (0..form.rows()).filter(|&i| places[i] == Place::Inside).collect();
        let unknown = |i: usize| Some(n + active.binary_search(&i).ok()?);
        // A multiplier as a multiple of an unknown.
        let expressed = |i: usize| match (form.bounds[i], law, side(places[i])) {
            (_, _, None) => Some((unknown(i)?, 1.0)),
            (Bounds::Cone { normal, mu }, Law::Coulomb, Some(sign)) => {
                Some((unknown(normal)?, sign * mu))
            }
            _ => None,
        };
        let order = n + active.len();
        let mut entries: Vec<_> = (0..order).map(|i| (i, i, PROXIMAL)).collect();
        for j in 0..n {
            entries.extend(column_of(&form.p, j).map(|(i, v)| (i, j, v)));
            for (i, v) in column_of(&form.d, j) {
                if let Some(row) = unknown(i) {
                    entries.push((row, j, v));
                }
                if let Some((column, factor)) = expressed(i) {
                    entries.push((j, column, -factor * v));
                }
            }
        }
        for j in 0..form.rows() {
            if let Some((column, factor)) = expressed(j) {
                for (i, v) in column_of(&form.s, j) {
                    entries.extend(unknown(i).map(|row| (row, column, factor * v)));
                }
            }
        }
        Some(Self { factor: Factor::new(order, entries)?, active })
    }

    /// Stationarity, then the slacks that should vanish.
    fn residual(&self, form: &Form, point: &Point) -> Vec<f64> {
        let mut residual = form.stationarity(point);
        let slacks = form.slacks(point);
        residual.extend(self.active.iter().map(|&i| slacks[i]));
        residual
    }
}

enum Factor {
    Empty,
    Dense(PartialPivLu<f64>),
    Sparse(Lu<usize, f64>),
}

impl Factor {
    fn new(order: usize, entries: Vec<(usize, usize, f64)>) -> Option<Self> {
        if order == 0 {
            return Some(Self::Empty);
        }
        if entries.len() as f64 > DENSE * (order * order) as f64 {
            let mut dense = Mat::<f64>::zeros(order, order);
            entries.into_iter().for_each(|(i, j, v)| dense[(i, j)] += v);
            return Some(Self::Dense(dense.partial_piv_lu()));
        }
        let matrix = Matrix::from_entries(order, order, entries.into_iter()).into_sparse();
        matrix.sp_lu().ok().map(Self::Sparse)
    }

    fn solve(&self, rhs: &mut [f64]) {
        let n = rhs.len();
        let rhs = MatMut::from_column_major_slice_mut(rhs, n, 1);
        match self {
            Self::Empty => {}
            Self::Dense(lu) => lu.solve_in_place(rhs),
            Self::Sparse(lu) => lu.solve_in_place(rhs),
        }
    }
}
