//! Problems without a nonsingular complementary basis: artificial columns, only for the pairs that
//! need them.
//!
//! A pair may have no column that reaches outside the span of the columns chosen for the other pairs.
//! One of its variables is then set to zero, and the column of that variable is replaced by an
//! artificial one that completes the basis. A solution with all artificial variables zero solves the
//! problem as given, as the residuals of the original data decide.

use super::feasibility::in_problem_rows;
use super::finish::BasicPoint;
use super::start::Equilibrated;
use crate::certify::is_proof;
use crate::vector::{SMALL, max_abs};
use crate::{Basis, HorizontalLcp, Matrix, Side, Solution};

/// The problem in which the column `side` of each missing pair is replaced by an artificial one.
pub(super) fn completed(
    problem: &Equilibrated<'_>,
    chosen: &[Option<Side>],
    complement: &Matrix,
    side: Side,
) -> HorizontalLcp {
    let (a, b) = (problem.problem.a(), problem.problem.b());
    let matrix = side.of(a, b);
    let kept = (0..chosen.len()).filter(|&pair| chosen[pair].is_some());
    let kept = kept.flat_map(|pair| matrix.column(pair).map(move |(i, v)| (i, pair, v)));
    let artificial = missing(chosen).zip(0..complement.ncols()).flat_map(|(pair, k)| {
        complement.column(k).map(move |(i, e)| (i, pair, e / problem.row[i]))
    });
    let entries = kept.chain(artificial);
    let completed = Matrix::assembled(chosen.len(), problem.problem.is_sparse(), entries);
    let c = problem.problem.c().to_vec();
    match side {
        Side::T => HorizontalLcp::from_parts(completed, b.clone(), c),
        Side::Y => HorizontalLcp::from_parts(a.clone(), completed, c),
    }
}

/// The point of a solution of the completed problem, without its artificial variables.
pub(super) fn without_artificial(
    problem: &HorizontalLcp,
    chosen: &[Option<Side>],
    side: Side,
    solution: &Solution,
) -> Option<BasicPoint> {
    let basis: Basis = solution.basis.clone()?;
    let (mut t, mut y) = (solution.t.clone(), solution.y.clone());
    for pair in missing(chosen) {
        side.of(&mut t, &mut y)[pair] = 0.0;
    }
    let residuals = problem.residuals(&t, &y);
    Some(BasicPoint {
        t,
        y,
        basis,
        residuals,
        condition: solution.condition?,
        negative: Vec::new(),
    })
}

/// A checked Farkas vector if no column at all reaches outside the span of those chosen, but `c` does:
/// the part of `c` outside.
pub(super) fn part_outside(problem: &Equilibrated<'_>, complement: &Matrix) -> Option<Vec<f64>> {
    let right = problem.right_hand_side();
    let mut outside = vec![0.0; right.len()];
    for k in 0..complement.ncols() {
        let column = complement.slice(k);
        column.add_to(column.dot(&right), &mut outside);
    }
    let least = SMALL * max_abs(&outside);
    outside.iter_mut().filter(|part| part.abs() < least).for_each(|part| *part = 0.0);
    let pi = in_problem_rows(problem, &outside);
    is_proof(problem.problem, &pi).then_some(pi)
}

fn missing(chosen: &[Option<Side>]) -> impl Iterator<Item = usize> + '_ {
    chosen.iter().enumerate().filter(|(_, side)| side.is_none()).map(|(pair, _)| pair)
}
