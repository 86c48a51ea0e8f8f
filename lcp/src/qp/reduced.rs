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
/// Unknowns, where loads are near one, that are zero. Without gaps or stiffness nothing else gives displacements
/// a size, so that rounding errors would be all that they are.
const ZERO: f64 = 1e-24;
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
    let mut best = (point.clone(), Sizes([f64::INFINITY; 2]));
    let mut least = best.1;
    let mut idle = 0;
    for _ in 0..STEPS {
        let mut residual = system.residual(form, &point);
        let sizes = Sizes::of(&residual, form.unknowns());
        least = least.min(sizes);
        if sizes.is_better(best.1, least) {
            idle = 0;
            best = (point.clone(), sizes);
        } else {
            idle += 1;
        }
        if sizes.max() <= VANISHING || idle >= 3 {
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
    let mut point = best.0;
    let all = point.x.iter_mut().chain(&mut point.lambda);
    all.filter(|v| v.abs() <= ZERO).for_each(|v| *v = 0.0);
    point.is_finite().then_some(point)
}

/// Sizes of the residuals of stationarity and of slacks. Either may come to rest at its rounding errors
/// while the other one still goes down.
#[derive(Debug, Clone, Copy)]
struct Sizes([f64; 2]);

impl Sizes {
    fn of(residual: &[f64], unknowns: usize) -> Self {
        let (stationarity, slacks) = residual.split_at(unknowns);
        Self([max_abs(stationarity), max_abs(slacks)])
    }

    fn max(self) -> f64 {
        self.0[0].max(self.0[1])
    }

    fn min(self, other: Self) -> Self {
        Self([self.0[0].min(other.0[0]), self.0[1].min(other.0[1])])
    }

    /// Whether they are smaller, or one is while the other stays near the `least` that it has been.
    fn is_better(self, than: Self, least: Self) -> bool {
        let down = |i: usize| self.0[i] < 0.9 * than.0[i];
        let rests = |i: usize| self.0[i] <= 4.0 * least.0[i];
        self.max() < 0.9 * than.max() || (down(0) && rests(1)) || (down(1) && rests(0))
    }
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
            for (i, j, v) in entries {
                dense[(i, j)] += v;
            }
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
