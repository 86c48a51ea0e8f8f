//! The interior-point method of Clarabel on a form whose cones are frozen: the only place that knows
//! that crate.

use std::time::Duration;

use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT::{NonnegativeConeT, ZeroConeT};
use clarabel::solver::{
    DefaultInfo, DefaultSettings, DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus,
};

use super::constants::{LEAST_LIMIT, NEAR, WORSE};
use super::form::{Bounds, Form, Point};
use crate::problem::column_of;
use crate::vector::max_abs;

/// How exact and how long.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effort {
    pub(super) tolerance: f64,
    pub(super) max_iterations: usize,
    /// What is left of the time.
    pub(super) time: Option<Duration>,
}

/// How a run of the interior-point method ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// With a point, more or less exact.
    Point,
    /// The program is infeasible or unbounded, or seems so.
    NoPoint,
    /// The limit on iterations was reached; the point is the last one.
    IterationLimit,
    /// The limit on time was reached; the point is the last one.
    TimeLimit,
    /// No point: the linear algebra broke down.
    Failed,
}

/// What the interior-point method found.
pub(super) struct Found {
    pub(super) end: End,
    pub(super) point: Point,
    pub(super) iterations: usize,
}

/// A form handed over to Clarabel, to be solved for several bounds of its cones.
///
/// With `x`: minimise `x P x / 2 + v S v / 2 + linear x + sum g_i |w_i|` subject to `w_i >= 0` in the
/// rows of nonnegative multipliers, where `w = D x + S v + offset` and the sum goes over the cones. There
/// `g |w|` is `g w + 2 g e` with the least `e >= 0` for which `w + e >= 0`, and the multiplier is that of this
/// condition less `g`. Without `x` there are no cones: minimise `lambda S lambda / 2 + offset lambda`.
pub(super) struct Interior {
    solver: DefaultSolver<f64>,
    settings: DefaultSettings<f64>,
    layout: Layout,
}

/// Where things are in Clarabel's problem.
enum Layout {
    /// The variables are the multipliers.
    Multipliers,
    /// The variables are `x`, then those of the rows with a diagonal entry of `S`, then one for every
    /// cone; `row[i]` is the constraint of row `i`, and `curved` are the rows with a diagonal entry.
    Unknowns { row: Vec<usize>, linear: Vec<f64>, curved: Vec<usize>, cones: Vec<(usize, usize)> },
}

/// A matrix in the making, by entries.
#[derive(Default)]
struct Entries {
    rows: Vec<usize>,
    cols: Vec<usize>,
    values: Vec<f64>,
}

impl Entries {
    fn push(&mut self, i: usize, j: usize, v: f64) {
        self.rows.push(i);
        self.cols.push(j);
        self.values.push(v);
    }

    fn finish(self, rows: usize, cols: usize) -> CscMatrix<f64> {
        CscMatrix::new_from_triplets(rows, cols, self.rows, self.cols, self.values)
    }
}

impl Interior {
    /// Takes over a scaled form. None where Clarabel refuses it.
    pub(super) fn new(form: &Form, effort: Effort) -> Option<Self> {
        let settings = settings(effort)?;
        let mut interior = if form.unknowns() == 0 {
            Self::of_multipliers(form, settings)?
        } else {
            Self::of_unknowns(form, settings)?
        };
        interior.solver.set_termination_callback(is_past_best());
        Some(interior)
    }

    fn of_multipliers(form: &Form, settings: DefaultSettings<f64>) -> Option<Self> {
        let m = form.rows();
        let (mut p, mut a) = (Entries::default(), Entries::default());
        for j in 0..m {
            column_of(&form.s, j).filter(|(i, _)| *i <= j).for_each(|(i, v)| p.push(i, j, v));
        }
        let bounded = (0..m).filter(|&i| form.bounds[i] != Bounds::Free);
        let count = bounded.clone().count();
        bounded.enumerate().for_each(|(row, i)| a.push(row, i, -1.0));
        let (p, a, b) = (p.finish(m, m), a.finish(count, m), vec![0.0; count]);
        let cone = [NonnegativeConeT(count)];
        let solver = DefaultSolver::new(&p, &form.offset, &a, &b, &cone, settings.clone()).ok()?;
        Some(Self { solver, settings, layout: Layout::Multipliers })
    }

    fn of_unknowns(form: &Form, settings: DefaultSettings<f64>) -> Option<Self> {
        let (n, m) = (form.unknowns(), form.rows());
        let curved: Vec<usize> =
            (0..m).filter(|&i| form.s.get(i, i).is_some_and(|v| *v > 0.0)).collect();
        let of = |kind: fn(&Bounds) -> bool| (0..m).filter(move |&i| kind(&form.bounds[i]));
        let free: Vec<usize> = of(|bounds| *bounds == Bounds::Free).collect();
        let bounded: Vec<usize> = of(|bounds| *bounds != Bounds::Free).collect();
        let cones: Vec<usize> = of(|bounds| matches!(bounds, Bounds::Cone { .. })).collect();
        let mut row = vec![0; m];
        free.iter().chain(&bounded).enumerate().for_each(|(k, &i)| row[i] = k);
        let columns = n + curved.len() + cones.len();

        let (mut p, mut a) = (Entries::default(), Entries::default());
        let mut linear = form.linear.clone();
        for j in 0..n {
            column_of(&form.p, j).filter(|(i, _)| *i <= j).for_each(|(i, v)| p.push(i, j, v));
            column_of(&form.d, j).for_each(|(i, v)| a.push(row[i], j, -v));
        }
        for (k, &j) in curved.iter().enumerate() {
            for (i, v) in column_of(&form.s, j) {
                if let Ok(l) = curved.binary_search(&i)
                    && l <= k
                {
                    p.push(n + l, n + k, v);
                }
                a.push(row[i], n + k, -v);
            }
        }
        let first = n + curved.len();
        for (k, &i) in cones.iter().enumerate() {
            a.push(row[i], first + k, -1.0);
            a.push(m + k, first + k, -1.0);
        }
        linear.resize(columns, 0.0);
        let mut b = vec![0.0; m + cones.len()];
        form.offset.iter().zip(&row).for_each(|(v, &row)| b[row] = *v);

        let (p, a) = (p.finish(columns, columns), a.finish(b.len(), columns));
        let cone = [ZeroConeT(free.len()), NonnegativeConeT(bounded.len() + cones.len())];
        let solver = DefaultSolver::new(&p, &linear, &a, &b, &cone, settings.clone()).ok()?;
        let cones = cones.iter().enumerate().map(|(k, &i)| (i, first + k)).collect();
        Some(Self { solver, settings, layout: Layout::Unknowns { row, linear, curved, cones } })
    }

    /// Solves for these bounds of the multipliers of cones, one for every row of the form. On failure of
    /// the update the former bounds would be meant, so that there is no point then.
    pub(super) fn solve(&mut self, form: &Form, limits: &[f64], time: Option<Duration>) -> Found {
        let failed = || Found { end: End::Failed, point: Point::zero(form), iterations: 0 };
        let floor = least_limit(limits);
        let limits: Vec<f64> = limits.iter().map(|limit| limit.max(floor)).collect();
        if self.update(form, &limits).is_none() || self.allow(time).is_none() {
            return failed();
        }
        self.solver.solve();
        let solution = &self.solver.solution;
        let end = match solution.status {
            SolverStatus::PrimalInfeasible
            | SolverStatus::DualInfeasible
            | SolverStatus::AlmostPrimalInfeasible
            | SolverStatus::AlmostDualInfeasible => End::NoPoint,
            SolverStatus::MaxIterations => End::IterationLimit,
            SolverStatus::MaxTime => End::TimeLimit,
            _ => End::Point,
        };
        let point = match &self.layout {
            Layout::Multipliers => Point { x: Vec::new(), lambda: solution.x.clone() },
            Layout::Unknowns { row, cones, .. } => {
                let x = solution.x[..form.unknowns()].to_vec();
                let mut lambda: Vec<f64> = row.iter().map(|&row| solution.z[row]).collect();
                for (i, _) in cones {
                    lambda[*i] -= limits[*i];
                }
                Point { x, lambda }
            }
        };
        if !point.is_finite() {
            return failed();
        }
        let iterations = usize::try_from(solution.iterations).unwrap_or(usize::MAX);
        Found { end, point, iterations }
    }

    /// Puts in the bounds of the cones.
    fn update(&mut self, form: &Form, limits: &[f64]) -> Option<()> {
        match &self.layout {
            Layout::Unknowns { linear, curved, cones, .. } if !cones.is_empty() => {
                let mut linear = linear.clone();
                for (i, column) in cones {
                    linear[*column] = 2.0 * limits[*i];
                }
                let of_curved = curved.iter().map(|&j| (&form.s, j));
                let columns = (0..form.unknowns()).map(|j| (&form.d, j)).chain(of_curved);
                for ((matrix, j), linear) in columns.zip(&mut linear) {
                    column_of(matrix, j).for_each(|(i, v)| {
                        if matches!(form.bounds[i], Bounds::Cone { .. }) {
                            *linear += limits[i] * v;
                        }
                    });
                }
                self.solver.update_q(&linear).ok()
            }
            _ => Some(()),
        }
    }

    fn allow(&mut self, time: Option<Duration>) -> Option<()> {
        if let Some(time) = time {
            self.settings.time_limit = time.as_secs_f64();
            self.solver.update_settings(self.settings.clone()).ok()?;
        }
        Some(())
    }
}

/// A bound of zero leaves the program without an interior. What this changes the exchange of states puts right.
fn least_limit(limits: &[f64]) -> f64 {
    let largest = max_abs(limits);
    if largest > 0.0 { LEAST_LIMIT * largest } else { LEAST_LIMIT }
}

/// Whether a run was near a solution once and is on its way away from it: where the tolerance is below what
/// rounding errors allow, which depends on the program, the iteration goes on and ends anywhere.
fn is_past_best() -> impl FnMut(&DefaultInfo<f64>) -> bool {
    let mut best = f64::INFINITY;
    move |info| {
        let error = info.gap_abs.min(info.gap_rel).max(info.res_primal).max(info.res_dual);
        best = if info.iterations == 0 { error } else { best.min(error) };
        best <= NEAR && error > WORSE * best
    }
}

fn settings(effort: Effort) -> Option<DefaultSettings<f64>> {
    DefaultSettingsBuilder::default()
        .verbose(false)
        .max_iter(u32::try_from(effort.max_iterations).unwrap_or(u32::MAX))
        .time_limit(effort.time.map_or(f64::INFINITY, |time| time.as_secs_f64()))
        .tol_gap_abs(effort.tolerance)
        .tol_gap_rel(effort.tolerance)
        .tol_feas(effort.tolerance)
        .presolve_enable(false)
        .max_threads(1)
        .direct_solve_method("qdldl".to_string())
        .build()
        .ok()
}
