//! The linear system of a step, condensed to the displacements.

use faer::sparse::FaerError;
use lcp_linalg::{Pattern, SupernodalLu, index, solve_refined};

use super::scaled::Scaled;
use crate::problem::column_of;

/// Springs on every displacement that keep bodies without contact in place during a step, relative to the stiffness.
/// Measured on walls: floating bricks stay nonsingular.
pub(crate) const PROXIMAL: f64 = 1e-12;
/// The residual, relative to the right-hand side, below which no refinement is needed. Measured on walls: 1e-7 would
/// save a sixth of the time far from the solution, with the same steps.
const ENOUGH: f64 = 1e-11;

/// The stiffness `s` of the response of a contact point to changes of its gap and slip: `dt_n = -nn dg`,
/// `dt_t = -tn dg - tt ds`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Springs {
    pub(crate) nn: f64,
    pub(crate) tn: f64,
    pub(crate) tt: f64,
}

impl Springs {
    /// `(nn gap, tn gap + tt slip)`.
    pub(crate) fn forces(&self, gap: f64, slip: f64) -> (f64, f64) {
        (self.nn * gap, self.tn * gap + self.tt * slip)
    }
}

/// `K + delta 1 + C^T S C` for any springs `S`: its pattern, the places of its terms, and its factors.
pub(crate) struct Condensed {
    pattern: Pattern,
    values: Vec<f64>,
    /// The contribution of `K` to the values.
    stiffness: Vec<f64>,
    /// Places of the diagonal.
    of_diagonal: Vec<usize>,
    /// Places of the terms of the points, one point after the other, and column by column for each.
    of_points: Vec<u32>,
    factors: SupernodalLu,
    pub(crate) factorisations: usize,
}

impl Condensed {
    pub(crate) fn new(problem: &Scaled) -> Result<Self, FaerError> {
        let n = problem.order();
        let pattern = pattern(problem)?;
        let of_diagonal = (0..n).map(|j| pattern.place(j, j)).collect();
        let of_points = problem
            .points
            .iter()
            .flat_map(|point| {
                let columns = point.columns;
                columns.iter().flat_map(move |&j| columns.iter().map(move |&i| (i, j)))
            })
            .map(|(i, j)| index(pattern.place(i, j)))
            .collect();
        let factors = SupernodalLu::new(pattern.symbolic(n))?;
        let (values, stiffness) = (vec![0.0; pattern.stored()], vec![0.0; pattern.stored()]);
        let planned =
            Self { pattern, values, stiffness, of_diagonal, of_points, factors, factorisations: 0 };
        Ok(planned.reloaded(problem))
    }

    /// The plan for a problem of the same pattern, whose stiffness may have other values.
    pub(crate) fn reloaded(mut self, problem: &Scaled) -> Self {
        self.stiffness.fill(0.0);
        for j in 0..problem.order() {
            for (i, v) in column_of(&problem.k, j) {
                self.stiffness[self.pattern.place(i, j)] += v;
            }
        }
        self.factorisations = 0;
        self
    }

    /// Factorises for these springs of the points, and a spring `delta` on every displacement.
    pub(crate) fn factorise(&mut self, problem: &Scaled, springs: &[Springs], delta: f64) {
        self.values.copy_from_slice(&self.stiffness);
        self.of_diagonal.iter().for_each(|&e| self.values[e] += delta);
        let mut places = self.of_points.iter();
        for (point, springs) in problem.points.iter().zip(springs) {
            for [n_j, t_j] in point.coefficients {
                let along = (springs.nn * n_j, springs.tn * n_j + springs.tt * t_j);
                for ([n_i, t_i], &place) in point.coefficients.iter().zip(&mut places) {
                    self.values[place as usize] += n_i * along.0 + t_i * along.1;
                }
            }
        }
        self.factors.factorise(&self.values);
        self.factorisations += 1;
    }

    /// Whether the determinant of the last matrix is negative, and with it the determinant of Newton's equations:
    /// the eliminated part is positive.
    pub(crate) fn is_negative(&self) -> bool {
        self.factors.is_negative()
    }

    /// The changes of displacements and forces by which the factorised springs remove the unbalanced forces, and the
    /// gaps and slips that should be zero.
    pub(crate) fn step(
        &self,
        problem: &Scaled,
        springs: &[Springs],
        unbalanced: Vec<f64>,
        opened: impl Iterator<Item = (f64, f64)>,
    ) -> (Vec<f64>, Vec<(f64, f64)>) {
        let mut u = unbalanced;
        let mut forces = Vec::with_capacity(springs.len());
        for ((point, springs), (gap, slip)) in problem.points.iter().zip(springs).zip(opened) {
            let (t_n, t_t) = springs.forces(-gap, -slip);
            point.add_forces(t_n, t_t, &mut u);
            forces.push((t_n, t_t));
        }
        self.solve(&mut u);
        for ((point, springs), force) in problem.points.iter().zip(springs).zip(&mut forces) {
            let (gap, slip) = point.moved(&u);
            let (t_n, t_t) = springs.forces(gap, slip);
            *force = (force.0 - t_n, force.1 - t_t);
        }
        (u, forces)
    }

    /// Overwrites a right-hand side with the solution.
    pub(crate) fn solve(&self, x: &mut [f64]) {
        let subtract_product = |x: &[f64], rest: &mut [f64]| {
            for (j, x) in x.iter().enumerate().filter(|(_, x)| **x != 0.0) {
                self.pattern.entries(j, &self.values).for_each(|(i, v)| rest[i] -= v * x);
            }
        };
        solve_refined(x, ENOUGH, |x| self.factors.solve(x), subtract_product);
    }
}

/// The pattern of `1 + K + K^T + C^T C`.
fn pattern(problem: &Scaled) -> Result<Pattern, FaerError> {
    let k = problem.k.symbolic();
    let transposed = k.transpose().to_col_major()?;
    // The edges of a cone, one after the other, move the same bodies.
    let mut groups: Vec<&[usize]> = problem.points.iter().map(|point| point.columns).collect();
    groups.dedup();
    let of_stiffness =
        |j: usize| k.row_idx_of_col_raw(j).iter().chain(transposed.row_idx_of_col_raw(j));
    Ok(Pattern::of(problem.order(), &groups, of_stiffness, |_, _| true))
}
