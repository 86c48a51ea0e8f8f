//! How well a point solves a problem, and whether a proof is one, in numbers of twice the digits.
//!
//! The measures are those of `HorizontalLcp::residuals` and `Contact2d::residuals`, written anew from their
//! definitions.

use lcp::{Contact2d, HorizontalLcp, Matrix, Solution};

use super::double::{Double, shifted};
use super::problem::Problem;

/// A denominator is at least this part of the largest term that a row could have.
const FLOOR: f64 = 1.0 / 1024.0;

/// How far a point is from a solution, dimensionless.
#[derive(Debug, Clone, Copy)]
pub struct Measure {
    /// The measure of the library: equations row by row, signs and products of the pairs.
    pub residual: f64,
    /// The largest lack of an equation relative to the largest terms of any, and the pairs likewise; of contact
    /// problems the pairs are measured as in the residual.
    pub backward: f64,
}

impl Measure {
    pub fn of(problem: &Problem, solution: &Solution) -> Self {
        let general = problem.general();
        let point = (&solution.t[..], &solution.y[..]);
        match problem {
            Problem::Contact(contact) => {
                let residual = of_contact(contact, solution);
                Self { residual, backward: of_equations(&general, point) }
            }
            _ => of_general(&general, point),
        }
    }
}

/// What a row lacks of its right-hand side.
#[derive(Clone)]
struct Row {
    /// All that follows is in units of two to this power.
    exponent: Option<i32>,
    sum: Double,
    size: f64,
    largest: f64,
}

impl Row {
    fn add(&mut self, v: Double) {
        self.sum = self.sum + v;
        self.size += v.rounded().abs();
    }

    fn relative(&self) -> f64 {
        share(self.sum.rounded().abs(), self.size.max(FLOOR * self.largest))
    }
}

pub fn of_general(problem: &HorizontalLcp, (t, y): (&[f64], &[f64])) -> Measure {
    if t.iter().chain(y).any(|v| !v.is_finite()) {
        return Measure { residual: f64::INFINITY, backward: f64::INFINITY };
    }
    let rows = rows(problem, (t, y));
    let equation = rows.iter().map(Row::relative).fold(0.0, larger);
    let (t_max, y_max) = (largest(t), largest(y));
    let pairs = t.iter().zip(y).map(|(t, y)| relative(*t, t_max).min(relative(*y, y_max)).abs());
    let natural = pairs.fold(0.0, larger);
    Measure { residual: equation.max(natural), backward: backward(&rows).max(natural) }
}

/// The largest lack of an equation relative to the largest terms of any.
fn of_equations(problem: &HorizontalLcp, point: (&[f64], &[f64])) -> f64 {
    let is_finite = point.0.iter().chain(point.1).all(|v| v.is_finite());
    if is_finite { backward(&rows(problem, point)) } else { f64::INFINITY }
}

fn backward(rows: &[Row]) -> f64 {
    let common = rows.iter().filter_map(|row| row.exponent).max().unwrap_or(0);
    let in_common = |v: f64, row: &Row| shifted(v, row.exponent.map_or(0, |it| it - common));
    let lack = rows.iter().map(|row| in_common(row.sum.rounded().abs(), row)).fold(0.0, larger);
    let terms = rows.iter().map(|row| in_common(row.size, row)).fold(0.0, larger);
    share(lack, terms)
}

/// Of every row what it lacks and its terms, without overflow whatever the units.
fn rows(problem: &HorizontalLcp, (t, y): (&[f64], &[f64])) -> Vec<Row> {
    let zero = Row { exponent: None, sum: Double::from(0.0), size: 0.0, largest: 0.0 };
    let mut rows = vec![zero; problem.order()];
    let sides: [(&Matrix, &[f64]); 2] = [(problem.a(), t), (problem.b(), y)];
    let units = sides.map(|(_, x)| exponent(largest(x)));
    for ((matrix, x), unit) in sides.into_iter().zip(units) {
        let Some(unit) = unit else { continue };
        for j in 0..x.len() {
            for (i, v) in matrix.column(j) {
                rows[i].exponent = rows[i].exponent.max(exponent(v).map(|it| it + unit));
            }
        }
    }
    for (row, &c) in rows.iter_mut().zip(problem.c()) {
        row.exponent = row.exponent.max(exponent(c));
        row.add(Double::from(shifted(-c, -row.exponent.unwrap_or(0))));
    }
    for ((matrix, x), unit) in sides.into_iter().zip(units) {
        let Some(unit) = unit else { continue };
        let x_max = shifted(largest(x), -unit);
        for (j, &x) in x.iter().enumerate() {
            for (i, v) in matrix.column(j).filter(|(_, v)| *v != 0.0) {
                let v = shifted(v, unit - rows[i].exponent.unwrap_or(0));
                rows[i].add(Double::from(v) * Double::from(shifted(x, -unit)));
                rows[i].largest = rows[i].largest.max(v.abs() * x_max);
            }
        }
    }
    rows
}

/// The measure of a contact problem: displacements in units of their stiffness, gaps in units of the largest.
fn of_contact(problem: &Contact2d, solution: &Solution) -> f64 {
    let Some(state) = &solution.contact else { return f64::INFINITY };
    let (u, t_n, t_t) = (&state.u, &state.t_n, &state.t_t);
    let [k, c_n, c_t] = [problem.stiffness(), problem.normal(), problem.tangent()]
        .map(|matrix| Matrix::from(matrix.clone()));
    let root = |j: usize| k[(j, j)].abs().sqrt();
    let has_friction = |i: usize| problem.mu()[i] > 0.0;
    let tangential = |j: usize| c_t.column(j).filter(|(i, _)| has_friction(*i));
    let (mut gap, mut slip): (Vec<Double>, Vec<Double>) = problem
        .initial_gaps()
        .iter()
        .zip(problem.initial_slips())
        .map(|(x, s)| (Double::from(*x), Double::from(*s)))
        .unzip();
    let friction = problem.initial_slips().iter().enumerate().filter(|(i, _)| has_friction(*i));
    let first = friction.fold(largest(problem.initial_gaps()), |max, (_, s)| max.max(s.abs()));
    let mut length = first;
    for (j, &u) in u.iter().enumerate() {
        for (i, v) in c_n.column(j) {
            gap[i] = gap[i] + Double::from(v) * Double::from(u);
            length = length.max((v * u).abs());
        }
        for (i, v) in tangential(j) {
            slip[i] = slip[i] + Double::from(v) * Double::from(u);
            length = length.max((v * u).abs());
        }
    }
    let t_max = largest(t_n).max(largest(t_t));
    let energy = u.iter().enumerate().map(|(j, u)| root(j) * u.abs()).fold(0.0, f64::max);
    let (mut worst, mut load, mut contact, mut direct) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    for (j, &f) in problem.loads().iter().enumerate() {
        let mut row =
            Row { exponent: None, sum: Double::from(0.0), size: 0.0, largest: root(j) * energy };
        row.add(Double::from(-f));
        k.column(j).for_each(|(i, v)| row.add(Double::from(v) * Double::from(u[i])));
        let mut coefficient = 0.0_f64;
        let contacts = c_n.column(j).map(|(i, v)| (v, t_n[i]));
        for (v, t) in contacts.chain(tangential(j).map(|(i, v)| (v, t_t[i]))) {
            row.add(Double::from(-v) * Double::from(t));
            row.largest = row.largest.max(v.abs() * t_max);
            coefficient = coefficient.max(v.abs());
        }
        worst = larger(worst, row.relative());
        if root(j) > 0.0 {
            load = load.max(f.abs() / root(j));
            contact = contact.max(coefficient / root(j));
        } else if coefficient > 0.0 {
            direct = direct.max(f.abs() / coefficient);
        }
    }
    let balancing = if contact > 0.0 { load / contact } else { 0.0 };
    let force = t_max.max(direct).max(balancing);
    let length = length.max(load * contact);
    let mut pair = |t: Double, y: Double| {
        let least = relative(t.rounded(), force).min(relative(y.rounded(), length));
        worst = larger(worst, least.abs());
    };
    for i in 0..problem.points() {
        pair(Double::from(t_n[i]), gap[i]);
        if has_friction(i) {
            let bound = Double::from(problem.mu()[i]) * Double::from(t_n[i]);
            let positive = |v: Double| if v.rounded() > 0.0 { v } else { Double::from(0.0) };
            pair(bound + Double::from(t_t[i]), positive(slip[i]));
            pair(bound - Double::from(t_t[i]), positive(-slip[i]));
        }
    }
    worst
}

/// Rounding errors of a product with a proof, relative to its terms, and the least that it must exceed them by.
const ROUNDING: f64 = 1e-12;

/// Whether a Farkas vector proves that there is no solution.
pub fn is_proof(problem: &HorizontalLcp, pi: &[f64]) -> bool {
    let product = |entries: &mut dyn Iterator<Item = (usize, f64)>| {
        entries.fold((Double::from(0.0), 0.0), |(sum, terms), (i, v)| {
            let term = Double::from(v) * Double::from(pi[i]);
            (sum + term, terms + term.rounded().abs())
        })
    };
    let columns = (0..problem.order()).flat_map(|j| [(problem.a(), j), (problem.b(), j)]);
    let is_below = columns.into_iter().all(|(matrix, j)| {
        let (sum, terms) = product(&mut matrix.column(j));
        sum.rounded() <= ROUNDING * terms
    });
    let (gain, terms) = product(&mut problem.c().iter().copied().enumerate());
    is_below && gain.rounded() > ROUNDING * terms
}

/// Zero where nothing is wrong, also where there is nothing to compare with.
fn share(part: f64, whole: f64) -> f64 {
    if part <= 0.0 { 0.0 } else { part / whole }
}

fn relative(v: f64, unit: f64) -> f64 {
    if unit > 0.0 { v / unit } else { 0.0 }
}

/// The larger one; what is no number is larger than all.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

pub fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |max, v| max.max(v.abs()))
}

/// The power of two next to a number, from below; `None` of zero.
fn exponent(v: f64) -> Option<i32> {
    #[allow(clippy::cast_possible_truncation, reason = "between -1074 and 1023")]
    (v != 0.0).then(|| v.abs().log2().floor() as i32)
}
