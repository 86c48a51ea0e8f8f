//! The interior-point method of Clarabel on a form whose cones are frozen: the only module that uses that crate.

use std::time::Duration;

use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT::{NonnegativeConeT, ZeroConeT};
use clarabel::solver::{
    DefaultInfo, DefaultSettings, DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus,
};

use super::constants::{INTERIOR, WORSE};
use super::form::{Bounds, Form, ProgramPoint};
use crate::Matrix;
use crate::problem::column_of;
use crate::vector::{HALF_DIGITS, max_abs};

/// The ending of a run of the interior-point method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// A point was found, more or less exact.
    ProgramPoint,
    /// The program is infeasible or unbounded, or seems so.
    NoPoint,
    /// The limit on iterations was reached; the point is the last one.
    IterationLimit,
    /// The limit on time was reached; the point is the last one.
    TimeLimit,
    /// No point: the linear algebra broke down.
    Failed,
}

/// The result of the interior-point method.
pub(super) struct Found {
    pub(super) end: End,
    pub(super) point: ProgramPoint,
    pub(super) iterations: usize,
}

/// A form in terms of Clarabel, to be solved for several bounds of its cones: minimise
/// `x P x / 2 + v S v / 2 + linear x + sum g_i |w_i|` subject to `w_i >= 0` in the rows of nonnegative multipliers,
/// with `w = D x + S v + offset` and a sum over the cones. `g |w|` is written as `g w + 2 g e` with the least `e >= 0`
/// for which `w + e >= 0`, and the multiplier of the cone is the multiplier of this condition less `g`.
///
/// Clarabel's variables are `x`, then those of the rows with a diagonal entry of `S`, then one for every cone.
pub(super) struct Interior {
    pub(super) form: Form,
    solver: DefaultSolver<f64>,
    settings: DefaultSettings<f64>,
    /// The constraint of every row.
    row: Vec<usize>,
    /// The linear part of the objective without cones.
    linear: Vec<f64>,
    /// The rows with a diagonal entry of `S`.
    curved: Vec<usize>,
    /// The rows with cones.
    cones: Vec<usize>,
}

/// A matrix of Clarabel.
fn csc(rows: usize, cols: usize, entries: Vec<(usize, usize, f64)>) -> CscMatrix<f64> {
    let matrix = Matrix::from_entries(rows, cols, entries.into_iter()).into_sparse();
    let (starts, rows_of) = (matrix.col_ptr().to_vec(), matrix.row_idx().to_vec());
    CscMatrix::new(rows, cols, starts, rows_of, matrix.val().to_vec())
}

impl Interior {
    /// The form in terms of Clarabel; `None` if Clarabel refuses it.
    pub(super) fn new(form: Form, max_iterations: usize) -> Option<Self> {
        let settings = settings(max_iterations)?;
        let (n, m) = (form.unknowns(), form.rows());
        let curved: Vec<usize> =
            (0..m).filter(|&i| form.s.get(i, i).is_some_and(|v| *v > 0.0)).collect();
        let of = |kind: fn(&Bounds) -> bool| -> Vec<usize> {
            (0..m).filter(|&i| kind(&form.bounds[i])).collect()
        };
        let free = of(|bounds| *bounds == Bounds::Free);
        let bounded = of(|bounds| *bounds != Bounds::Free);
        let cones = of(|bounds| matches!(bounds, Bounds::Cone { .. }));
        let mut row = vec![0; m];
        free.iter().chain(&bounded).enumerate().for_each(|(k, &i)| row[i] = k);
        let columns = n + curved.len() + cones.len();

        let (mut p, mut a) = (Vec::new(), Vec::new());
        let mut linear = form.linear.clone();
        for j in 0..n {
            column_of(&form.p, j).filter(|(i, _)| *i <= j).for_each(|(i, v)| p.push((i, j, v)));
            column_of(&form.d, j).for_each(|(i, v)| a.push((row[i], j, -v)));
        }
        for (k, &j) in curved.iter().enumerate() {
            for (i, v) in column_of(&form.s, j) {
                if let Ok(l) = curved.binary_search(&i)
                    && l <= k
                {
                    p.push((n + l, n + k, v));
                }
                a.push((row[i], n + k, -v));
            }
        }
        let first = n + curved.len();
        for (k, &i) in cones.iter().enumerate() {
            a.push((row[i], first + k, -1.0));
            a.push((m + k, first + k, -1.0));
        }
        linear.resize(columns, 0.0);
        let mut b = vec![0.0; m + cones.len()];
        form.offset.iter().zip(&row).for_each(|(v, &row)| b[row] = *v);

        let (p, a) = (csc(columns, columns, p), csc(b.len(), columns, a));
        let cone = [ZeroConeT(free.len()), NonnegativeConeT(bounded.len() + cones.len())];
        let mut solver = DefaultSolver::new(&p, &linear, &a, &b, &cone, settings.clone()).ok()?;
        solver.set_termination_callback(is_past_best());
        Some(Self { form, solver, settings, row, linear, curved, cones })
    }

    /// Solves for these bounds of the multipliers of cones, one for every row of the form, within a time limit.
    pub(super) fn solve(&mut self, limits: &[f64], time: Option<Duration>) -> Found {
        // A bound of zero leaves the program without an interior. The exchange of states corrects the change.
        let largest = max_abs(limits);
        let floor = if largest > 0.0 { HALF_DIGITS * largest } else { HALF_DIGITS };
        let limits: Vec<f64> = limits.iter().map(|limit| limit.max(floor)).collect();
        if self.update(&limits, time).is_none() {
            return Found {
                end: End::Failed,
                point: ProgramPoint::zero(&self.form),
                iterations: 0,
            };
        }
        self.solver.solve();
        let solution = &self.solver.solution;
        let x = solution.x[..self.form.unknowns()].to_vec();
        let mut lambda: Vec<f64> = self.row.iter().map(|&row| solution.z[row]).collect();
        self.cones.iter().for_each(|&i| lambda[i] -= limits[i]);
        let point = ProgramPoint { x, lambda };
        let end = match solution.status {
            _ if !point.is_finite() => End::Failed,
            SolverStatus::PrimalInfeasible
            | SolverStatus::DualInfeasible
            | SolverStatus::AlmostPrimalInfeasible
            | SolverStatus::AlmostDualInfeasible => End::NoPoint,
            SolverStatus::MaxIterations => End::IterationLimit,
            SolverStatus::MaxTime => End::TimeLimit,
            _ => End::ProgramPoint,
        };
        let iterations = usize::try_from(solution.iterations).unwrap_or(usize::MAX);
        Found { end, point, iterations }
    }

    /// Sets the bounds of the cones and the time limit; `None` if Clarabel refuses them and would keep the former ones.
    fn update(&mut self, limits: &[f64], time: Option<Duration>) -> Option<()> {
        if let Some(time) = time {
            self.settings.time_limit = time.as_secs_f64();
            self.solver.update_settings(self.settings.clone()).ok()?;
        }
        if self.cones.is_empty() {
            return Some(());
        }
        let Form { d, s, bounds, .. } = &self.form;
        let mut linear = self.linear.clone();
        let first = linear.len() - self.cones.len();
        for (linear, &i) in linear[first..].iter_mut().zip(&self.cones) {
            *linear = 2.0 * limits[i];
        }
        let of_curved = self.curved.iter().map(|&j| (s, j));
        let columns = (0..d.ncols()).map(|j| (d, j)).chain(of_curved);
        for ((matrix, j), linear) in columns.zip(&mut linear) {
            column_of(matrix, j).for_each(|(i, v)| {
                if matches!(bounds[i], Bounds::Cone { .. }) {
                    *linear += limits[i] * v;
                }
            });
        }
        self.solver.update_q(&linear).ok()
    }
}

/// Whether a run was near a solution once and now diverges: an iteration whose tolerance is below the rounding errors
/// of the program goes on and ends anywhere.
fn is_past_best() -> impl FnMut(&DefaultInfo<f64>) -> bool {
    let mut best = f64::INFINITY;
    move |info| {
        let error = info.gap_abs.min(info.gap_rel).max(info.res_primal).max(info.res_dual);
        best = if info.iterations == 0 { error } else { best.min(error) };
        best <= HALF_DIGITS && error > WORSE * best
    }
}

fn settings(max_iterations: usize) -> Option<DefaultSettings<f64>> {
    DefaultSettingsBuilder::default()
        .verbose(false)
        .max_iter(u32::try_from(max_iterations).unwrap_or(u32::MAX))
        .tol_gap_abs(INTERIOR)
        .tol_gap_rel(INTERIOR)
        .tol_feas(INTERIOR)
        .presolve_enable(false)
        .max_threads(1)
        .direct_solve_method("qdldl".to_string())
        .build()
        .ok()
}
