//! Problems without a nonsingular complementary basis: artificial columns, only where they are needed.
//!
//! For a pair none of whose columns reaches outside the span of those chosen for the others, one of
//! its variables is set to zero, and its column is replaced by an artificial one that completes the
//! basis. A solution in which all artificial variables are zero solves the problem as given, which
//! the residuals of the original data decide.

use faer::Mat;

use super::feasibility::is_proof;
use super::finish::Point;
use super::start::Equilibrated;
use crate::{Basis, HorizontalLcp, Matrix, Side, Solution};

/// The problem in which the missing pairs have an artificial column instead of that of `side`.
pub(super) fn completed(
    problem: &Equilibrated<'_>,
    chosen: &[Option<Side>],
    complement: &Mat<f64>,
    side: Side,
) -> HorizontalLcp {
    let mut dense = match side {
        Side::T => problem.problem.a().to_dense(),
        Side::Y => problem.problem.b().to_dense(),
    };
    for (pair, column) in missing(chosen).zip(0..complement.ncols()) {
        let artificial = complement.col_as_slice(column).iter().zip(&problem.row);
        let out = dense.col_as_slice_mut(pair);
        out.iter_mut().zip(artificial).for_each(|(out, (e, row))| *out = e / row);
    }
    let (a, b) = (problem.problem.a().clone(), problem.problem.b().clone());
    let c = problem.problem.c().to_vec();
    match side {
        Side::T => HorizontalLcp::from_parts(Matrix::Dense(dense), b, c),
        Side::Y => HorizontalLcp::from_parts(a, Matrix::Dense(dense), c),
    }
}

/// The point of a solution of the completed problem, without its artificial variables.
pub(super) fn without_artificial(
    problem: &HorizontalLcp,
    chosen: &[Option<Side>],
    side: Side,
    solution: &Solution,
) -> Option<Point> {
    let basis: Basis = solution.basis.clone()?;
    let (mut t, mut y) = (solution.t.clone(), solution.y.clone());
    for pair in missing(chosen) {
        match side {
            Side::T => t[pair] = 0.0,
            Side::Y => y[pair] = 0.0,
        }
    }
    let residuals = problem.residuals(&t, &y);
    Some(Point { t, y, basis, residuals, condition: solution.condition? })
}

/// Where no column at all reaches outside the span of those chosen, but `c` does: the part of `c`
/// outside is a Farkas vector.
pub(super) fn part_outside(problem: &Equilibrated<'_>, complement: &Mat<f64>) -> Option<Vec<f64>> {
    let right = problem.right_hand_side();
    let mut outside = vec![0.0; right.len()];
    for k in 0..complement.ncols() {
        let column = complement.col_as_slice(k);
        let share: f64 = column.iter().zip(&right).map(|(e, c)| e * c).sum();
        outside.iter_mut().zip(column).for_each(|(out, e)| *out += share * e);
    }
    let pi: Vec<f64> = outside.iter().zip(&problem.row).map(|(pi, row)| pi * row).collect();
    is_proof(problem, &pi).then_some(pi)
}

fn missing(chosen: &[Option<Side>]) -> impl Iterator<Item = usize> + '_ {
    chosen.iter().enumerate().filter(|(_, side)| side.is_none()).map(|(pair, _)| pair)
}
