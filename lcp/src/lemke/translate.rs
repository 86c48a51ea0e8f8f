//! From the variables of a path to those of the problem.

use super::kernel::Var;
use super::path::{Exchange, Path};
use super::start::{Equilibrated, Start};
use crate::pivoting::{AttemptStart, PivotRecord, Variable};
use crate::vector::max_abs;
use crate::{Basis, Ray, Side};

/// Of every pair the variable that is larger, in units of the largest of its vector.
pub(super) fn basis_of(t: &[f64], y: &[f64]) -> Basis {
    let (t_max, y_max) = (max_abs(t), max_abs(y));
    let share = |v: f64, max: f64| if max > 0.0 { v / max } else { 0.0 };
    let side = |(&t, &y): (&f64, &f64)| {
        if share(t, t_max) > share(y, y_max) { Side::T } else { Side::Y }
    };
    Basis::new(t.iter().zip(y).map(side).collect())
}

pub(super) fn kind_of(basis: &Basis) -> AttemptStart {
    let is_all = |side| basis.sides().iter().all(|&it| it == side);
    if is_all(Side::Y) {
        AttemptStart::AllY
    } else if is_all(Side::T) {
        AttemptStart::AllT
    } else {
        AttemptStart::Found
    }
}

pub(super) fn record(exchange: Exchange, attempt: usize, start: &Start) -> PivotRecord {
    let n = start.q.len();
    let variable = |var: Var| {
        if var == 2 * n {
            return Variable::Artificial;
        }
        let pair = var % n;
        let nonbasic = start.nonbasic_side(pair);
        match if var < n { nonbasic.complement() } else { nonbasic } {
            Side::T => Variable::T(pair),
            Side::Y => Variable::Y(pair),
        }
    };
    let Exchange { entering, leaving, step, artificial } = exchange;
    let (entering, leaving) = (variable(entering), variable(leaving));
    PivotRecord { attempt, entering, leaving, step, artificial }
}

pub(super) fn in_problem_units(
    path: &Path<'_>,
    start: &Start,
    covering: &[f64],
    problem: &Equilibrated<'_>,
) -> Ray {
    let n = start.q.len();
    let along = path.ray();
    let (dt, dy) = start.in_problem_units(problem, &along);
    let dz0 = start.size * along[2 * n];
    let mut in_rows = vec![0.0; n];
    for (pair, (d, row)) in covering.iter().zip(&start.row_factor).enumerate() {
        let column = problem.problem.column(pair, start.basis.sides()[pair]);
        column.add_to(d / row, &mut in_rows);
    }
    Ray { dt, dy, dz0, covering: in_rows }
}
