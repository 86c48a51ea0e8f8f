//! The parametric problem, traced from breakpoint to breakpoint.
//!
//! This is the path of Lemke's method with the parameter in place of the artificial variable: the basis at the start
//! solves the problem, the parameter enters, and then the complement of each leaving variable. Between two pivots all
//! variables, and the parameter, are linear in the entering one.

mod outcome;

pub use outcome::{Breakpoint, ParametricEnd, ParametricPath, ParametricRay};

use std::time::Instant;

use super::basis_matrix::BasisMatrix;
use super::constants::{ROUNDING, TIE_WINDOW};
use super::crash::{Crash, find_basis};
use super::kernel::{Kernel, Var};
use super::path::Path;
use super::start::{Equilibrated, Start};
use crate::certify::{GeneralJudge, Precision};
use crate::solve::{deadline_of, is_over};
use crate::vector::{check_length, check_vector, max_abs};
use crate::{Basis, Error, HorizontalLcp, Lemke, LemkeSettings, Solver, Status};

/// Settings of [`Parametric`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParametricSettings {
    /// Settings of the solve at the start, and the tolerance of all points.
    pub lemke: LemkeSettings,
    /// Largest number of breakpoints; `None` is `100 n + 1000`.
    pub max_breakpoints: Option<usize>,
}

/// Traces the solutions of `A t + B y = c0 + lambda c1` from one value of `lambda` to another
/// (Cottle, Pang and Stone, section 4.5).
///
/// ```
/// use faer::mat;
/// use lcp::lemke::{Parametric, ParametricEnd};
/// use lcp::Lcp;
/// // A spring between walls: w = z + 1 - lambda, so that z grows from lambda = 1 on.
/// let problem = Lcp::new(mat![[1.0]], vec![1.0])?.into();
/// let path = Parametric::default().trace(&problem, &[-1.0], 0.0, 3.0)?;
/// assert_eq!(path.end, ParametricEnd::Reached);
/// let lambdas: Vec<f64> = path.breakpoints.iter().map(|it| it.lambda).collect();
/// assert_eq!(lambdas, [0.0, 1.0, 3.0]);
/// assert_eq!(path.solutions_at(2.0)[0].t, [1.0]);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Parametric {
    settings: ParametricSettings,
}

impl Parametric {
    /// A tracer with these settings.
    pub fn new(settings: ParametricSettings) -> Self {
        Self { settings }
    }

    /// The settings.
    pub fn settings(&self) -> &ParametricSettings {
        &self.settings
    }

    /// Traces from `lambda = from` to `to`, which may be smaller, or infinite. `problem` holds `A`,
    /// `B` and `c0`.
    ///
    /// # Errors
    /// For settings out of range, a `c1` that does not fit or is not finite, a `from` that is not
    /// finite or a `to` that is not a number.
    pub fn trace(
        &self,
        problem: &HorizontalLcp,
        c1: &[f64],
        from: f64,
        to: f64,
    ) -> Result<ParametricPath, Error> {
        check_length("c1", c1.len(), problem.order())?;
        check_vector("c1", c1)?;
        if !from.is_finite() {
            return Err(Error::Setting { name: "from", value: from, range: "finite" });
        }
        if to.is_nan() {
            return Err(Error::Setting { name: "to", value: to, range: "a number or infinite" });
        }
        let deadline = deadline_of(Instant::now(), self.settings.lemke.time_limit);
        let at_start = problem.with_right_hand_side(right_hand_side(problem, c1, from))?;
        let solution = Lemke::new(self.settings.lemke.clone()).solve(&at_start)?;
        let mut path = ParametricPath {
            end: ParametricEnd::NoStart(solution.status),
            breakpoints: Vec::new(),
            bases: Vec::new(),
            ray: None,
            residual: solution.residuals.worst(),
        };
        if !solution.is_solved() {
            return Ok(path);
        }
        path.breakpoints.push(Breakpoint { lambda: from, t: solution.t, y: solution.y });
        let equilibrated = Equilibrated::new(&at_start);
        let found = solution.basis.map(Crash::Complete);
        let found = found.unwrap_or_else(|| find_basis(&equilibrated, None, deadline));
        let basis = match found {
            Crash::Complete(basis) => basis,
            Crash::Partial { .. } => {
                path.end = ParametricEnd::NoStart(Status::NoComplementaryBasis);
                return Ok(path);
            }
            Crash::Late => {
                path.end = ParametricEnd::NoStart(Status::TimeLimit);
                return Ok(path);
            }
        };
        let Some(start) = equilibrated.start(&basis).map(Start::bounded) else {
            path.end = ParametricEnd::NumericalTrouble;
            return Ok(path);
        };
        Tracer { settings: &self.settings, deadline, problem, c1, from, to }.follow(
            &equilibrated,
            &start,
            &mut path,
        );
        Ok(path)
    }
}

struct Tracer<'a> {
    settings: &'a ParametricSettings,
    deadline: Option<Instant>,
    problem: &'a HorizontalLcp,
    c1: &'a [f64],
    from: f64,
    to: f64,
}

impl Tracer<'_> {
    fn follow(&self, equilibrated: &Equilibrated<'_>, start: &Start, out: &mut ParametricPath) {
        let Some(rate) = self.start_rate(equilibrated, start) else {
            out.end = ParametricEnd::NumericalTrouble;
            return;
        };
        let size = max_abs(&rate);
        let unit = if size > 0.0 { 1.0 / size } else { 1.0 };
        let rate: Vec<f64> = rate.iter().map(|rate| rate * unit).collect();
        let kernel = start.kernel(&rate, self.settings.lemke.refactor_interval);
        let values = start.q.iter().map(|q| q.max(0.0)).collect();
        let interval = self.settings.lemke.refactor_interval;
        let path = Path::parametric(kernel, start, &rate, values, interval);
        out.end = self.run(path, equilibrated, start, unit, out);
    }

    /// The rates of the basic variables of the start, in their units, for one unit of the parameter
    /// towards its last value.
    fn start_rate(&self, equilibrated: &Equilibrated<'_>, start: &Start) -> Option<Vec<f64>> {
        let matrix = BasisMatrix::new(equilibrated, &start.basis)?;
        let direction = if self.to < self.from { -1.0 } else { 1.0 };
        let rows = self.c1.iter().zip(&equilibrated.row);
        let mut rate: Vec<f64> = rows.map(|(c1, row)| direction * c1 * row).collect();
        matrix.solve(&mut rate);
        for (pair, rate) in rate.iter_mut().enumerate() {
            let side = start.basis.sides()[pair];
            *rate *= equilibrated.factor(pair, side) * start.row_factor[pair] / start.size;
        }
        rate.iter().all(|rate| rate.is_finite()).then_some(rate)
    }

    /// `unit` is the size of the parameter's unit along the path, which starts at zero.
    fn run<K: Kernel>(
        &self,
        mut path: Path<'_, K>,
        equilibrated: &Equilibrated<'_>,
        start: &Start,
        unit: f64,
        out: &mut ParametricPath,
    ) -> ParametricEnd {
        let n = self.problem.order();
        let limit = self.settings.max_breakpoints.unwrap_or(100 * n + 1000);
        let last = (self.to - self.from).abs() / unit;
        let parameter = path.artificial();
        let mut entering = parameter;
        let mut column = vec![0.0; n];
        loop {
            if out.breakpoints.len() > limit {
                return ParametricEnd::BreakpointLimit;
            }
            if is_over(self.deadline) {
                return ParametricEnd::TimeLimit;
            }
            if path.kernel.is_due() && !path.tidy() {
                return ParametricEnd::NumericalTrouble;
            }
            path.kernel.column(entering, &mut column);
            out.bases.push(present_basis(&path, start, entering));
            let row = path.leaving_row(&column);
            let step = row.map_or(f64::INFINITY, |row| path.values[row].max(0.0) / column[row]);
            let value = path.value(parameter);
            let speed = match path.artificial_row() {
                Some(row) if column[row].abs() <= ROUNDING * max_abs(&column) => 0.0,
                Some(row) => -column[row],
                None => 1.0,
            };
            let place = Place { equilibrated, start, unit };
            let reach = if speed > 0.0 { (last - value) / speed } else { f64::INFINITY };
            let back = if speed < 0.0 { value / -speed } else { f64::INFINITY };
            if reach <= step && reach.is_finite() {
                if reach * max_abs(&column) <= TIE_WINDOW * path.value_scale()
                    && out.bases.len() > 1
                {
                    out.bases.pop();
                    if let Some(last) = out.breakpoints.last_mut() {
                        last.lambda = self.to;
                    }
                    return ParametricEnd::Reached;
                }
                path.advance(reach, &column);
                return self
                    .note(&path, place, Some((entering, reach)), Some(self.to), out)
                    .unwrap_or(ParametricEnd::Reached);
            }
            if back < step {
                path.advance(back, &column);
                return self
                    .note(&path, place, Some((entering, back)), Some(self.from), out)
                    .unwrap_or(ParametricEnd::TurnedBack);
            }
            let Some(row) = row else {
                out.ray = Some(self.ray(place, &path, entering, &column, speed));
                return ParametricEnd::Ray;
            };
            if !path.is_new() {
                return ParametricEnd::Cycle;
            }
            entering = path.exchange(row, entering, &column);
            // Rows within this window count as tied, so that a step within it parts a tie.
            if step * max_abs(&column) <= TIE_WINDOW * path.value_scale() {
                out.bases.pop();
                continue;
            }
            let is_good = self.note(&path, place, None, None, out).is_none();
            if !is_good {
                if !path.rebuild() {
                    return ParametricEnd::NumericalTrouble;
                }
                if let Some(end) = self.note(&path, place, None, None, out) {
                    return end;
                }
            }
        }
    }

    /// Adds the present point, and says so where the original data do not vouch for it. `moving` is a
    /// nonbasic variable with a value; `lambda` replaces the path's own value where it is known.
    fn note<K: Kernel>(
        &self,
        path: &Path<'_, K>,
        place: Place<'_>,
        moving: Option<(Var, f64)>,
        lambda: Option<f64>,
        out: &mut ParametricPath,
    ) -> Option<ParametricEnd> {
        // A solution that vanishes must not be measured by its own rounding errors. These grow with the
        // condition of the basis, up to what counts as a tie.
        let mut points = [ROUNDING, TIE_WINDOW].into_iter().map(|least| {
            let point = self.point(path, place, moving, lambda, least);
            (self.residual(&point), point)
        });
        let found = points.find(|(residual, _)| *residual <= self.settings.lemke.tolerance);
        let Some((residual, point)) = found else {
            return Some(ParametricEnd::NumericalTrouble);
        };
        out.breakpoints.push(point);
        out.residual = out.residual.max(residual);
        None
    }

    /// The present point. Values below `least`, relative to the path's, are zero.
    fn point<K: Kernel>(
        &self,
        path: &Path<'_, K>,
        place: Place<'_>,
        moving: Option<(Var, f64)>,
        lambda: Option<f64>,
        least: f64,
    ) -> Breakpoint {
        let value = |var: Var| match moving {
            Some((it, value)) if it == var => value,
            _ => path.value(var),
        };
        let zero = least * (1.0 + value(path.artificial()).abs());
        let kept = |var: Var| if value(var).abs() > zero { value(var) } else { 0.0 };
        let along: Vec<f64> = (0..2 * self.problem.order()).map(kept).collect();
        let (t, y) = place.in_problem_units(&along, place.start.size);
        let direction = if self.to < self.from { -1.0 } else { 1.0 };
        let travelled = direction * place.unit * kept(path.artificial());
        let lambda = lambda.unwrap_or_else(|| {
            let lambda = self.from + travelled;
            let size = self.from.abs() + travelled.abs();
            if lambda.abs() > least * size { lambda } else { 0.0 }
        });
        Breakpoint { lambda, t, y }
    }

    fn residual(&self, point: &Breakpoint) -> f64 {
        let terms = self.problem.c().iter().zip(self.c1).map(|(c0, c1)| (c0, point.lambda * c1));
        let (c, sizes) = terms.map(|(a, b)| (a + b, a.abs() + b.abs())).unzip();
        let judge = GeneralJudge::with_right_hand_side(self.problem, c, sizes);
        judge.residuals(&[&point.t, &point.y], Precision::Exact).worst()
    }

    fn ray<K: Kernel>(
        &self,
        place: Place<'_>,
        path: &Path<'_, K>,
        entering: Var,
        column: &[f64],
        speed: f64,
    ) -> ParametricRay {
        let n = self.problem.order();
        let mut along = path.direction(entering, column);
        along.truncate(2 * n);
        let (dt, dy) = place.in_problem_units(&along, place.start.size);
        let direction = if self.to < self.from { -1.0 } else { 1.0 };
        ParametricRay { dlambda: direction * place.unit * speed, dt, dy }
    }
}

/// What leads from the path back to the problem.
#[derive(Clone, Copy)]
struct Place<'a> {
    equilibrated: &'a Equilibrated<'a>,
    start: &'a Start,
    unit: f64,
}

impl Place<'_> {
    /// `(t, y)` from values of all `w` and `z`.
    fn in_problem_units(self, along: &[f64], size: f64) -> (Vec<f64>, Vec<f64>) {
        let n = self.start.q.len();
        let (mut t, mut y) = (vec![0.0; n], vec![0.0; n]);
        for pair in 0..n {
            let w = size * along[pair] / self.start.row_factor[pair];
            let z = size * along[n + pair] * self.start.col_factor[pair];
            (t[pair], y[pair]) =
                self.equilibrated.sides(pair, self.start.nonbasic_side(pair), w, z);
        }
        (t, y)
    }
}

/// Of every pair the variable that is basic or entering.
fn present_basis<K: Kernel>(path: &Path<'_, K>, start: &Start, entering: Var) -> Basis {
    let n = start.q.len();
    let mut z_is_basic = path.z_is_basic();
    if (n..2 * n).contains(&entering) {
        z_is_basic[entering - n] = true;
    }
    start.basis_with(&z_is_basic)
}

/// `c0 + lambda c1`, where what cancels up to rounding is zero.
fn right_hand_side(problem: &HorizontalLcp, c1: &[f64], lambda: f64) -> Vec<f64> {
    let terms = problem.c().iter().zip(c1).map(|(c0, c1)| (c0, lambda * c1));
    let sum = |(a, b): (&f64, f64)| {
        let rounding = 4.0 * f64::EPSILON * (a.abs() + b.abs());
        if (a + b).abs() > rounding { a + b } else { 0.0 }
    };
    terms.map(sum).collect()
}
