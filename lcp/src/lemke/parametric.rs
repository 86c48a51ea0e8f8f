//! The parametric problem, traced from breakpoint to breakpoint.
//!
//! The path is that of Lemke's method with the parameter in place of the artificial variable: the basis at the start
//! solves the problem, the parameter enters, and then the complement of each leaving variable. All variables, and the
//! parameter, are linear in the entering one between two pivots.

mod outcome;

pub use outcome::{Breakpoint, ParametricEnd, ParametricPath, ParametricRay};

use web_time::Instant;

use super::constants::TIE_WINDOW;
use super::crash::{Crash, find_basis};
use super::kernel::Var;
use super::path::Path;
use super::start::{Equilibrated, Start};
use crate::certify::{GeneralJudge, Precision};
use crate::solve::{deadline_of, is_over};
use crate::vector::{SMALL, check_length, check_vector, max_abs};
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

    /// Traces from `lambda = from` to `to`, which may be smaller, or infinite. `problem` has `A`, `B` and `c0`.
    ///
    /// # Errors
    /// An error for settings out of range, a `c1` that has a wrong length or is not finite, a `from` that is not finite
    /// or a `to` that is not a number.
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
        let mut out = ParametricPath {
            end: ParametricEnd::NoStart(solution.status),
            breakpoints: Vec::new(),
            bases: Vec::new(),
            ray: None,
            residual: solution.residuals.worst(),
        };
        if !solution.is_solved() {
            return Ok(out);
        }
        out.breakpoints.push(Breakpoint { lambda: from, t: solution.t, y: solution.y });
        let equilibrated = Equilibrated::new(&at_start);
        let found = solution.basis.map(Crash::Complete);
        let basis = match found.unwrap_or_else(|| find_basis(&equilibrated, None, deadline)) {
            Crash::Complete(basis) => basis,
            Crash::Partial { .. } => {
                out.end = ParametricEnd::NoStart(Status::NoComplementaryBasis);
                return Ok(out);
            }
            Crash::Late => {
                out.end = ParametricEnd::NoStart(Status::TimeLimit);
                return Ok(out);
            }
        };
        let rates = problem.with_right_hand_side(c1.to_vec())?;
        let starts = (equilibrated.start(&basis), Equilibrated::new(&rates).start(&basis));
        let (Some(start), Some(rates)) = starts else {
            out.end = ParametricEnd::NumericalTrouble;
            return Ok(out);
        };
        // Rates of the basic variables in a unit of the parameter that points to its last value.
        let direction = if to < from { -1.0 } else { 1.0 };
        let rate: Vec<f64> = rates.q.iter().map(|rate| direction * rate).collect();
        let start = start.bounded();
        let path = Path::parametric(&start, &rate);
        let unit = direction * start.size / rates.size;
        let (settings, equilibrated, start) = (&self.settings, &equilibrated, &start);
        let tracer =
            Tracer { settings, deadline, problem, c1, equilibrated, start, from, to, unit };
        out.end = tracer.follow(path, &mut out);
        Ok(out)
    }
}

struct Tracer<'a> {
    settings: &'a ParametricSettings,
    deadline: Option<Instant>,
    problem: &'a HorizontalLcp,
    c1: &'a [f64],
    equilibrated: &'a Equilibrated<'a>,
    start: &'a Start,
    from: f64,
    to: f64,
    /// One unit of the parameter of the path, which starts at zero.
    unit: f64,
}

impl Tracer<'_> {
    fn follow(&self, mut path: Path<'_>, out: &mut ParametricPath) -> ParametricEnd {
        let n = self.problem.order();
        let limit = self.settings.max_breakpoints.unwrap_or(100 * n + 1000);
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
            let row = path.leaving_row(&column);
            let step = row.map_or(f64::INFINITY, |row| path.values[row].max(0.0) / column[row]);
            let speed = match path.artificial_row() {
                Some(row) if column[row].abs() <= SMALL * max_abs(&column) => 0.0,
                Some(row) => -column[row],
                None => 1.0,
            };
            let is_back = speed < 0.0;
            let goal = if is_back { self.from } else { self.to };
            let reach = ((goal - self.from) / self.unit - path.value(parameter)) / speed;
            // A path whose step ends on the first value may go on from there.
            let is_last = if is_back { reach < step } else { reach <= step && reach.is_finite() };
            if !is_last && row.is_none() {
                out.bases.push(self.basis(&path, entering));
                out.ray = Some(self.ray(&path, entering, &column, speed));
                return ParametricEnd::Ray;
            }
            let step = if is_last { reach } else { step };
            // Rows within this window count as tied, so that a step within the window separates a tie.
            if step * max_abs(&column) > TIE_WINDOW * path.scale || is_last && out.bases.is_empty()
            {
                let along = path.moved(&path.values, entering, step, &column);
                if !self.note(&along, is_last.then_some(goal), out) {
                    if path.is_rebuilt() || !path.rebuild() {
                        return ParametricEnd::NumericalTrouble;
                    }
                    continue;
                }
                out.bases.push(self.basis(&path, entering));
            } else if is_last && let Some(last) = out.breakpoints.last_mut() {
                last.lambda = goal;
            }
            match row.filter(|_| !is_last) {
                None if is_back => return ParametricEnd::TurnedBack,
                None => return ParametricEnd::Reached,
                Some(_) if !path.is_new() => return ParametricEnd::Cycle,
                Some(row) => entering = path.exchange(row, entering, &column),
            }
        }
    }

    /// Adds the point with these values of all variables of the path, if it is verified by the original data. `lambda`
    /// replaces the value of the path if it is known.
    fn note(&self, along: &[f64], lambda: Option<f64>, out: &mut ParametricPath) -> bool {
        let point = self.point(along, lambda);
        let residual = self.residual(&point);
        let is_right = residual <= self.settings.lemke.tolerance;
        if is_right {
            out.breakpoints.push(point);
            out.residual = out.residual.max(residual);
        }
        is_right
    }

    /// A point. A vanishing solution must not be measured by its own rounding errors: values that are small against
    /// those of the path are zero.
    fn point(&self, along: &[f64], lambda: Option<f64>) -> Breakpoint {
        let parameter = along[along.len() - 1];
        let zero = SMALL * (1.0 + parameter.abs());
        let kept = |value: f64| if value.abs() > zero { value } else { 0.0 };
        let kept_values: Vec<f64> = along.iter().copied().map(kept).collect();
        let (t, y) = self.start.in_problem_units(self.equilibrated, &kept_values);
        let lambda = lambda.unwrap_or_else(|| {
            let travelled = self.unit * kept(parameter);
            let lambda = self.from + travelled;
            let size = self.from.abs() + travelled.abs();
            if lambda.abs() > SMALL * size { lambda } else { 0.0 }
        });
        Breakpoint { lambda, t, y }
    }

    fn residual(&self, point: &Breakpoint) -> f64 {
        let terms = self.problem.c().iter().zip(self.c1).map(|(c0, c1)| (c0, point.lambda * c1));
        let (c, sizes) = terms.map(|(a, b)| (a + b, a.abs() + b.abs())).unzip();
        let judge = GeneralJudge::with_right_hand_side(self.problem, c, sizes);
        judge.residuals(&[&point.t, &point.y], Precision::Exact).worst()
    }

    fn ray(&self, path: &Path<'_>, entering: Var, column: &[f64], speed: f64) -> ParametricRay {
        let along = path.direction(entering, column);
        let (dt, dy) = self.start.in_problem_units(self.equilibrated, &along);
        ParametricRay { dlambda: self.unit * speed, dt, dy }
    }

    /// The basic or entering variable of every pair.
    fn basis(&self, path: &Path<'_>, entering: Var) -> Basis {
        let n = self.problem.order();
        let mut z_is_basic = path.z_is_basic();
        if (n..2 * n).contains(&entering) {
            z_is_basic[entering - n] = true;
        }
        self.start.basis_with(&z_is_basic)
    }
}

/// `c0 + lambda c1`, with zero for terms that cancel up to rounding.
fn right_hand_side(problem: &HorizontalLcp, c1: &[f64], lambda: f64) -> Vec<f64> {
    let terms = problem.c().iter().zip(c1).map(|(c0, c1)| (c0, lambda * c1));
    let sum = |(a, b): (&f64, f64)| {
        let rounding = 4.0 * f64::EPSILON * (a.abs() + b.abs());
        if (a + b).abs() > rounding { a + b } else { 0.0 }
    };
    terms.map(sum).collect()
}
