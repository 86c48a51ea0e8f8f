//! How well a point solves a problem, and whether a proof is one, in numbers of twice the digits.
//!
//! The measures are those of the library, written anew: a row by its own terms, a sign or a pair by what it takes to
//! set it right in the rows. Where all terms of a row vanish at the solution the loads measure it: a row counts by
//! no less than the largest one of its connected part.

use lcp::{Contact2d, Friction2d, HorizontalLcp, Lcp, Matrix, MixedLcp, Solution};

use super::double::{Double, shifted};
use super::problem::Problem;

/// How far a point is from a solution, dimensionless.
#[derive(Debug, Clone, Copy)]
pub struct Measure {
    /// The measure of the library: rows, signs and pairs.
    pub residual: f64,
    /// What is left of an equation relative to the largest terms of any, in equilibrated units; and signs and
    /// pairs as in the residual.
    pub backward: f64,
}

impl Measure {
    pub fn of(problem: &Problem, solution: &Solution) -> Self {
        let (t, y) = (&solution.t[..], &solution.y[..]);
        match problem {
            Problem::Standard(problem) => System::of_standard(problem, t, y),
            Problem::General(problem) => System::of_general(problem, t, y),
            Problem::Mixed(problem) => System::of_mixed(problem, problem.recover(t, y)),
            Problem::Boxed(problem) => System::of_general(&problem.to_general(), t, y),
            Problem::Contact(problem) => System::of_contact(problem, solution),
            Problem::Friction(problem) => System::of_friction(problem, t),
        }
        .measure()
    }
}

pub fn of_general(problem: &HorizontalLcp, (t, y): (&[f64], &[f64])) -> Measure {
    System::of_general(problem, t, y).measure()
}

/// Rows with their right-hand sides, the columns and values of all variables, and what is asked of them.
struct System {
    right: Vec<f64>,
    columns: Vec<Vec<(usize, f64)>>,
    values: Vec<f64>,
    /// Lists of variables with numbers that may not be negative, and of which one is zero.
    conditions: Vec<Vec<(usize, f64)>>,
    /// Rows before this one are forces, of contact, and lengths from it on.
    forces: usize,
}

impl System {
    fn of_general(problem: &HorizontalLcp, t: &[f64], y: &[f64]) -> Self {
        let n = problem.order();
        let columns = entries(problem.a(), 1.0).chain(entries(problem.b(), 1.0)).collect();
        let conditions = (0..n).map(|k| vec![(k, t[k]), (n + k, y[k])]).collect();
        let values = [t, y].concat();
        Self { right: problem.c().to_vec(), columns, values, conditions, forces: n }
    }

    fn of_standard(problem: &Lcp, z: &[f64], w: &[f64]) -> Self {
        let n = problem.order();
        let columns = entries(problem.m(), -1.0).chain(units(n, 0, 1.0)).collect();
        let conditions = (0..n).map(|k| vec![(k, z[k]), (n + k, w[k])]).collect();
        let values = [z, w].concat();
        Self { right: problem.q().to_vec(), columns, values, conditions, forces: n }
    }

    fn of_mixed(problem: &MixedLcp, (z, w): (Vec<f64>, Vec<f64>)) -> Self {
        let n = problem.order();
        let columns = entries(problem.m(), -1.0).chain(units(n, 0, 1.0)).collect();
        let pairs = (0..n).filter(|k| !problem.free()[*k]);
        let mut conditions: Vec<_> = pairs.map(|k| vec![(k, z[k]), (n + k, w[k])]).collect();
        let free = (0..n).filter(|k| problem.free()[*k]);
        conditions.extend(free.map(|k| vec![(n + k, -w[k].abs())]));
        let values = [z, w].concat();
        Self { right: problem.q().to_vec(), columns, values, conditions, forces: n }
    }

    /// Displacements, normal and tangential forces, gaps and slips.
    fn of_contact(problem: &Contact2d, solution: &Solution) -> Self {
        let (n, m) = (problem.displacements(), problem.points());
        let [k, c_n, c_t] = [problem.stiffness(), problem.normal(), problem.tangent()]
            .map(|matrix| Matrix::from(matrix.clone()));
        let displacements = (0..n).map(|j| {
            let gaps = c_n.column(j).map(|(i, v)| (n + i, v));
            k.column(j).chain(gaps).chain(c_t.column(j).map(|(i, v)| (n + m + i, v))).collect()
        });
        let mut columns: Vec<Vec<_>> = displacements.collect();
        let forces = |c: &Matrix, i: usize| (0..n).map(|j| (j, -c[(i, j)])).collect();
        columns.extend([&c_n, &c_t].into_iter().flat_map(|c| (0..m).map(move |i| forces(c, i))));
        columns.extend(units(2 * m, n, -1.0));
        let initial = problem.initial_gaps().iter().chain(problem.initial_slips()).map(|v| -v);
        let right = problem.loads().iter().copied().chain(initial).collect();
        let at = solution.contact.clone().unwrap();
        let laws = (0..m).flat_map(|i| {
            let (force, opening) = ((at.t_n[i], at.t_t[i]), (at.gap[i], at.slip[i]));
            law(
                problem.mu()[i],
                (force, opening),
                [n, n + m, n + 2 * m, n + 3 * m].map(|it| it + i),
            )
        });
        let conditions = laws.collect();
        let values = [at.u, at.t_n, at.t_t, at.gap, at.slip].concat();
        Self { right, columns, values, conditions, forces: n }
    }

    /// Forces and velocities, which follow from them.
    fn of_friction(problem: &Friction2d, t: &[f64]) -> Self {
        let (m, forces) = (problem.contacts(), problem.forces(t));
        let pairs = forces.normal.iter().zip(&forces.tangential);
        let forces: Vec<f64> = pairs.flat_map(|(n, t)| [*n, *t]).collect();
        let mut v: Vec<Double> = problem.q().iter().map(|q| Double::from(*q)).collect();
        for (j, force) in forces.iter().enumerate() {
            let products =
                problem.w().column(j).map(|(i, w)| (i, Double::from(w) * (*force).into()));
            products.for_each(|(i, product)| v[i] = v[i] + product);
        }
        let v: Vec<f64> = v.into_iter().map(Double::rounded).collect();
        let laws = (0..m).flat_map(|i| {
            let [n, t] = [2 * i, 2 * i + 1];
            let at = ((forces[n], forces[t]), (v[n], v[t]));
            law(problem.mu()[i], at, [n, t, 2 * m + n, 2 * m + t])
        });
        let conditions = laws.collect();
        let columns = entries(problem.w(), -1.0).chain(units(2 * m, 0, 1.0)).collect();
        let values = [forces, v].concat();
        Self { right: problem.q().to_vec(), columns, values, conditions, forces: 2 * m }
    }

    fn measure(&self) -> Measure {
        if self.values.iter().any(|v| !v.is_finite()) {
            return Measure { residual: f64::INFINITY, backward: f64::INFINITY };
        }
        let scaled = self.equilibrated();
        let mut rest: Vec<Double> = scaled.right.iter().map(|c| Double::from(-c)).collect();
        let mut terms: Vec<f64> = scaled.right.iter().map(|c| c.abs()).collect();
        for (column, x) in scaled.columns.iter().zip(&scaled.values) {
            for (i, v) in column {
                let product = Double::from(*v) * Double::from(*x);
                rest[*i] = rest[*i] + product;
                terms[*i] += product.rounded().abs();
            }
        }
        let rest: Vec<f64> = rest.into_iter().map(|it| it.rounded().abs()).collect();
        let all = largest(&terms);
        for (terms, load) in terms.iter_mut().zip(scaled.loads()) {
            *terms = terms.max(load);
        }
        let rows = rest.iter().zip(&terms).map(|(rest, terms)| share(*rest, *terms));
        let effect = |(variable, v): &(usize, f64)| {
            let entries = scaled.columns[*variable].iter().filter(|(_, a)| *a != 0.0);
            let shares = entries.map(|(i, a)| share((a * v).abs(), terms[*i]));
            shares.reduce(larger).unwrap_or(if *v == 0.0 { 0.0 } else { 1.0 })
        };
        let natural = scaled.conditions.iter().map(|list| {
            let negative = list.iter().filter(|(_, v)| *v < 0.0).map(effect).fold(0.0, larger);
            let positive = list.iter().map(|it| if it.1 > 0.0 { effect(it) } else { 0.0 });
            larger(negative, positive.fold(f64::INFINITY, f64::min))
        });
        let natural = natural.fold(0.0, larger);
        let backward = share(rest.iter().copied().fold(0.0, larger), all);
        Measure {
            residual: larger(rows.fold(0.0, larger), natural),
            backward: larger(backward, natural),
        }
    }

    /// The same in units in which the largest entries of rows and columns are near one: powers of two.
    fn equilibrated(&self) -> Self {
        let (mut row, mut column) =
            (vec![0.0_f64; self.right.len()], vec![0.0_f64; self.columns.len()]);
        for _ in 0..20 {
            let none = f64::NEG_INFINITY;
            let (mut of_row, mut of_column) = (vec![none; row.len()], vec![none; column.len()]);
            for (j, entries) in self.columns.iter().enumerate() {
                for (i, v) in entries.iter().filter(|(_, v)| *v != 0.0) {
                    let size = v.abs().log2() + row[*i] + column[j];
                    (of_row[*i], of_column[j]) = (of_row[*i].max(size), of_column[j].max(size));
                }
            }
            for (unit, size) in row.iter_mut().zip(of_row).chain(column.iter_mut().zip(of_column)) {
                *unit -= if size > none { 0.5 * size } else { 0.0 };
            }
        }
        #[allow(clippy::cast_possible_truncation, reason = "a few thousand at most")]
        let [row, column] = [row, column].map(|it| it.iter().map(|v| v.round() as i32).collect());
        let (row, column): (Vec<i32>, Vec<i32>) = (row, column);
        let of_variable = |(j, v): (usize, f64)| (j, shifted(v, -column[j]));
        let of_entry = |j: usize, (i, v): &(usize, f64)| (*i, shifted(*v, row[*i] + column[j]));
        let columns = self.columns.iter().enumerate();
        Self {
            right: self.right.iter().zip(&row).map(|(c, e)| shifted(*c, *e)).collect(),
            columns: columns.map(|(j, it)| it.iter().map(|it| of_entry(j, it)).collect()).collect(),
            values: self.values.iter().copied().enumerate().map(|it| of_variable(it).1).collect(),
            conditions: self
                .conditions
                .iter()
                .map(|list| list.iter().copied().map(of_variable).collect())
                .collect(),
            forces: self.forces,
        }
    }

    /// For every row the largest load on its connected part. What forces make of lengths is told by the stiffest
    /// diagonal entry, and what lengths make of forces by the softest.
    fn loads(&self) -> Vec<f64> {
        let mut part: Vec<usize> = (0..self.right.len()).collect();
        let mut is_same = false;
        while !is_same {
            is_same = true;
            for column in &self.columns {
                let rows = || column.iter().filter(|(_, v)| *v != 0.0).map(|(i, _)| *i);
                let Some(least) = rows().map(|i| part[i]).min() else { continue };
                is_same &= rows().all(|i| part[i] == least);
                rows().for_each(|i| part[i] = least);
            }
        }
        let mut loads = vec![[0.0_f64; 2]; part.len()];
        let mut stiffness = vec![[f64::INFINITY, 0.0]; part.len()];
        for (i, c) in self.right.iter().enumerate() {
            let load = &mut loads[part[i]][usize::from(i >= self.forces)];
            *load = load.max(c.abs());
        }
        let is_contact = self.forces < part.len();
        for j in 0..if is_contact { self.forces } else { 0 } {
            let diagonal = self.columns[j].iter().filter(|(i, v)| *i == j && *v > 0.0);
            let [softest, stiffest] = &mut stiffness[part[j]];
            diagonal.for_each(|(_, v)| (*softest, *stiffest) = (softest.min(*v), stiffest.max(*v)));
        }
        let felt = |i: usize| {
            let ([force, length], [softest, stiffest]) = (loads[part[i]], stiffness[part[i]]);
            match (stiffest > 0.0, i < self.forces) {
                (true, true) => force.max(softest * length),
                (true, false) => length.max(force / stiffest),
                (false, is_force) => {
                    if is_force {
                        force
                    } else {
                        length
                    }
                }
            }
        };
        (0..part.len()).map(felt).collect()
    }
}

/// Contact and friction, of which the two directions have a condition each: normal and tangential force, gap and slip.
fn law(
    mu: f64,
    ((t_n, t_t), (gap, slip)): ((f64, f64), (f64, f64)),
    at: [usize; 4],
) -> Vec<Vec<(usize, f64)>> {
    let mut conditions = vec![vec![(at[0], t_n), (at[2], gap)]];
    if mu == 0.0 {
        conditions.push(vec![(at[1], -t_t.abs())]);
        return conditions;
    }
    let bound = mu * t_n.max(0.0);
    let directions = [(bound + t_t, slip), (bound - t_t, -slip)];
    conditions.extend(directions.map(|(force, slip)| vec![(at[1], force), (at[3], slip.max(0.0))]));
    conditions
}

/// The columns of a matrix times a number.
fn entries(matrix: &Matrix, by: f64) -> impl Iterator<Item = Vec<(usize, f64)>> {
    (0..matrix.ncols()).map(move |j| matrix.column(j).map(|(i, v)| (i, by * v)).collect())
}

/// Columns of one entry.
fn units(count: usize, first: usize, v: f64) -> impl Iterator<Item = Vec<(usize, f64)>> {
    (0..count).map(move |i| vec![(first + i, v)])
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

/// The larger one; what is no number is larger than all.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

pub fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |max, v| max.max(v.abs()))
}
