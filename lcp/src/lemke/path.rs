//! One complementary path: from a start basis and a covering vector to a complementary basis, a
//! ray or a limit.
//!
//! The start basis turns the general problem into `w + T z = q` with the basic variable `w_i` and
//! the nonbasic `z_i` of every pair; the artificial variable adds the column `-d`:
//! `w + T z - d z0 = q`.

use std::collections::HashSet;

use super::constants::VANISHING;
use super::kernel::{Kernel, Var, complement};
use super::start::{Equilibrated, Start};
use crate::pivoting::{AttemptEnd, PivotRecord, Variable};
use crate::random::SplitMix;
use crate::vector::max_abs;
use crate::{Ray, Side};

/// Called before every pivot with the number of pivots so far and the artificial variable ([`Path::artificial_left`]);
/// may end the path.
pub(super) type Limits<'a> = &'a mut dyn FnMut(usize, f64) -> Option<AttemptEnd>;

pub(super) struct Path<'a> {
    pub(super) kernel: Box<dyn Kernel + 'a>,
    start: &'a Start,
    covering: &'a [f64],
    /// Values of the basic variables, row by row.
    pub(super) values: Vec<f64>,
    basic: Vec<Var>,
    /// Row of every basic variable.
    pub(super) row_of: Vec<Option<usize>>,
    /// Whether the artificial variable is a parameter, which may have any value.
    pub(super) is_parametric: bool,
    /// First value of the artificial variable.
    pub(super) artificial_start: f64,
    /// Size of the basic values, by which ties are judged.
    pub(super) scale: f64,
    pub(super) pivots: usize,
    pub(super) factorisations: usize,
    /// Every exchange, if the settings record them.
    pub(super) trace: Option<Vec<PivotRecord>>,
    visited: HashSet<u64>,
    signature: u64,
    column: Vec<f64>,
    /// The variable that nothing blocked, if the path ended on a ray.
    unblocked: Var,
    /// Pivots at the last rebuilding of the tableau.
    rebuilt_at: Option<usize>,
}

impl<'a> Path<'a> {
    /// A path with this covering vector, which is zero in rows of free variables.
    pub(super) fn new(start: &'a Start, covering: &'a [f64]) -> Self {
        let n = start.q.len();
        Self {
            kernel: start.kernel(covering),
            start,
            covering,
            scale: max_abs(&start.q),
            values: start.q.clone(),
            basic: (0..n).collect(),
            row_of: (0..=2 * n).map(|var| (var < n).then_some(var)).collect(),
            is_parametric: false,
            artificial_start: 0.0,
            pivots: 0,
            factorisations: 0,
            trace: None,
            visited: HashSet::new(),
            signature: (0..n).map(key).fold(0, |a, b| a ^ b),
            column: vec![0.0; n],
            unblocked: 2 * n,
            rebuilt_at: None,
        }
    }

    /// A path with the artificial variable as a parameter, which may have any value and does not leave at zero.
    pub(super) fn parametric(start: &'a Start, rate: &'a [f64]) -> Self {
        let mut path = Self::new(start, rate);
        path.values.iter_mut().for_each(|value| *value = value.max(0.0));
        Self { is_parametric: true, artificial_start: 1.0, scale: max_abs(&path.values), ..path }
    }

    fn order(&self) -> usize {
        self.values.len()
    }

    pub(super) fn artificial(&self) -> Var {
        2 * self.order()
    }

    pub(super) fn basic(&self) -> impl Iterator<Item = Var> + '_ {
        self.basic.iter().copied()
    }

    pub(super) fn is_nonbasic(&self, var: Var) -> bool {
        self.row_of[var].is_none()
    }

    pub(super) fn artificial_row(&self) -> Option<usize> {
        self.row_of[self.artificial()]
    }

    /// The artificial variable relative to its first value: one before it is basic, and on paths without it.
    pub(super) fn artificial_left(&self) -> f64 {
        self.artificial_row().map_or(1.0, |row| self.values[row] / self.artificial_start)
    }

    /// Whether the basic variable of a row must not be negative. A free variable, once basic, remains basic.
    pub(super) fn is_bounded(&self, row: usize) -> bool {
        let n = self.order();
        let var = self.basic[row];
        if var == 2 * n { !self.is_parametric } else { !self.start.is_free(var % n) }
    }

    /// Follows the path to its end. A path without an artificial variable begins with a variable of a pair instead, the
    /// driver, and ends when the driver, or its complement, leaves (Lemke and Howson 1964).
    pub(super) fn run(&mut self, driver: Option<usize>, limits: Limits<'_>) -> AttemptEnd {
        if let Some(end) = limits(self.pivots, self.artificial_left()) {
            return end;
        }
        let mut column = std::mem::take(&mut self.column);
        let entering = match driver {
            Some(pair) => self.lift(self.order() + pair, &mut column, limits),
            None => self.enter_artificial(&mut column).ok_or(AttemptEnd::Complementary),
        };
        let end =
            entering.map_or_else(|end| end, |entering| self.follow(entering, &mut column, limits));
        self.column = column;
        end
    }

    /// Exchanges until no value is negative; returns the variable that follows. The driver, and the variables that
    /// follow it, must lift every negative value without lowering others below zero, else there is no such path.
    fn lift(
        &mut self,
        driver: Var,
        column: &mut [f64],
        limits: Limits<'_>,
    ) -> Result<Var, AttemptEnd> {
        let mut entering = driver;
        loop {
            let negative = |path: &Self, i: &usize| path.values[*i] < 0.0 && path.is_bounded(*i);
            if !(0..column.len()).any(|i| negative(self, &i)) {
                return Ok(entering);
            }
            if let Some(end) = limits(self.pivots, self.artificial_left()) {
                return Err(end);
            }
            if !self.is_nonbasic(entering) || self.kernel.is_due() {
                return Err(AttemptEnd::Ray);
            }
            self.kernel.column(entering, column);
            let least = -VANISHING * max_abs(column);
            let step = |i: usize| self.values[i] / column[i];
            let lifted = (0..column.len()).filter(|i| negative(self, i) && column[*i] < least);
            let row = lifted.max_by(|&i, &j| step(i).total_cmp(&step(j)));
            let row = row.ok_or(AttemptEnd::Ray)?;
            let after = |i: usize| self.values[i] - step(row) * column[i];
            let is_kept = |i: usize| negative(self, &i) || !self.is_bounded(i) || after(i) >= 0.0;
            if !(0..column.len()).all(is_kept) {
                return Err(AttemptEnd::Ray);
            }
            entering = self.exchange(row, entering, column);
        }
    }

    fn follow(&mut self, mut entering: Var, column: &mut [f64], limits: Limits<'_>) -> AttemptEnd {
        loop {
            // The artificial variable has left, or a variable of the pair that was basic with both.
            if entering == self.artificial() || !self.is_nonbasic(entering) {
                return AttemptEnd::Complementary;
            }
            if let Some(end) = limits(self.pivots, self.artificial_left()) {
                return end;
            }
            if self.kernel.is_due() && !self.tidy() {
                return AttemptEnd::Singular;
            }
            self.kernel.column(entering, column);
            match self.leaving_row(column) {
                Some(row) => {
                    // The rule is deterministic: a basis that recurs once recurs for ever.
                    if !self.is_new() {
                        return AttemptEnd::Cycle;
                    }
                    entering = self.exchange(row, entering, column);
                }
                // A ray may be drift: only a column that is confirmed by the data counts.
                None if !self.has_drifted(entering) => return self.at_ray(entering, column),
                None if self.is_rebuilt() => return AttemptEnd::Singular,
                None if !self.rebuild() => return AttemptEnd::Singular,
                None => {}
            }
        }
    }

    /// Makes the first pivot: the artificial variable enters. Returns the variable that follows, or `None` if the start
    /// basis is already the solution.
    pub(super) fn enter_artificial(&mut self, column: &mut [f64]) -> Option<Var> {
        let first = self.first_row()?;
        self.kernel.column(self.artificial(), column);
        self.artificial_start = self.values[first] / column[first];
        Some(self.exchange(first, self.artificial(), column))
    }

    /// The row that the artificial variable takes: the most negative value relative to its covering, the last of equal
    /// ones, which keeps the rows lexicographically positive.
    fn first_row(&self) -> Option<usize> {
        let mut worst = None;
        let mut ratio = 0.0;
        for (i, (&q, &d)) in self.values.iter().zip(self.covering).enumerate() {
            if d > 0.0 && q < 0.0 && q / d <= ratio {
                (worst, ratio) = (Some(i), q / d);
            }
        }
        worst
    }

    /// Exchanges the basic variable of `row` with the entering one, given its column. Returns the
    /// variable that has to enter next: the complement of the one that left.
    pub(super) fn exchange(&mut self, row: usize, entering: Var, column: &[f64]) -> Var {
        let step = self.values[row] / column[row];
        for (value, a) in self.values.iter_mut().zip(column) {
            *value -= step * a;
        }
        self.values[row] = step;
        let leaving = self.basic[row];
        self.kernel.exchange(row, entering, leaving, column);
        self.basic[row] = entering;
        self.row_of[entering] = Some(row);
        self.row_of[leaving] = None;
        self.signature ^= key(entering) ^ key(leaving);
        self.pivots += 1;
        self.scale = max_abs(&self.values);
        let artificial = self.value(self.artificial()) / self.artificial_start;
        if let Some(trace) = &mut self.trace {
            let [entering, leaving] =
                [entering, leaving].map(|var| match self.start.variable(var) {
                    None => Variable::Artificial,
                    Some((pair, Side::T)) => Variable::T(pair),
                    Some((pair, Side::Y)) => Variable::Y(pair),
                });
            trace.push(PivotRecord { attempt: 0, entering, leaving, step, artificial });
        }
        if leaving == self.artificial() { leaving } else { complement(leaving, self.order()) }
    }

    /// The ending at a column that nothing blocks: a ray only if the artificial variable is not already zero. If it is
    /// zero, the basis solves the problem, and the artificial variable leaves on its own row.
    fn at_ray(&mut self, entering: Var, column: &[f64]) -> AttemptEnd {
        if let Some(row) = self.artificial_row()
            && self.values[row] <= VANISHING * self.artificial_start
            && column[row].abs() > 0.0
        {
            self.exchange(row, entering, column);
            return AttemptEnd::Complementary;
        }
        self.unblocked = entering;
        AttemptEnd::Ray
    }

    pub(super) fn z_is_basic(&self) -> Vec<bool> {
        let n = self.order();
        (0..n).map(|k| self.row_of[n + k].is_some()).collect()
    }

    /// Value of a variable, in equilibrated units.
    pub(super) fn value(&self, var: Var) -> f64 {
        self.row_of[var].map_or(0.0, |row| self.values[row])
    }

    /// The ray on which the path has ended, in units of the problem.
    pub(super) fn ray(&self, problem: &Equilibrated<'_>) -> Ray {
        let (n, start) = (self.order(), self.start);
        let along = self.direction(self.unblocked, &self.column);
        let (dt, dy) = start.in_problem_units(problem, &along);
        let dz0 = start.size * along[2 * n];
        let mut covering = vec![0.0; n];
        for (pair, (d, row)) in self.covering.iter().zip(&start.row_factor).enumerate() {
            let column = problem.problem.column(pair, start.basis.sides()[pair]);
            column.add_to(d / row, &mut covering);
        }
        Ray { dt, dy, dz0, covering }
    }

    /// Rates of all variables, `(w, z, z0)` one after the other, for one unit of the entering one, given its column.
    pub(super) fn direction(&self, entering: Var, column: &[f64]) -> Vec<f64> {
        self.moved(&vec![0.0; self.order()], entering, 1.0, column)
    }

    /// Values of all variables after a step of the entering one, given its column, from these values of the basic ones.
    pub(super) fn moved(
        &self,
        values: &[f64],
        entering: Var,
        step: f64,
        column: &[f64],
    ) -> Vec<f64> {
        let mut moved = vec![0.0; 2 * self.order() + 1];
        for (row, ((&var, value), a)) in self.basic.iter().zip(values).zip(column).enumerate() {
            let value = value - step * a;
            moved[var] = if self.is_bounded(row) { value.max(0.0) } else { value };
        }
        moved[entering] = step;
        moved
    }

    /// Records the present basis; `false` if it occurred before.
    pub(super) fn is_new(&mut self) -> bool {
        self.visited.insert(self.signature)
    }

    /// Applies the exchanges held back, and rebuilds if the result has drifted.
    pub(super) fn tidy(&mut self) -> bool {
        let nonbasic = (0..=2 * self.order()).filter(|&var| self.is_nonbasic(var));
        let probe = nonbasic.cycle().nth(self.pivots % (self.order() + 1));
        let is_sound = self.kernel.apply() && probe.is_some_and(|probe| !self.has_drifted(probe));
        is_sound || self.rebuild()
    }

    pub(super) fn is_rebuilt(&self) -> bool {
        self.rebuilt_at == Some(self.pivots)
    }

    pub(super) fn rebuild(&mut self) -> bool {
        self.factorisations += 1;
        self.rebuilt_at = Some(self.pivots);
        let rebuilt = self.kernel.rebuild(&self.basic, &mut self.values);
        self.scale = max_abs(&self.values);
        rebuilt
    }

    /// Compares the basic values, together with one column of the tableau, with the start data.
    fn has_drifted(&mut self, probe: Var) -> bool {
        let mut sum = vec![0.0; self.order()];
        self.kernel.column(probe, &mut sum);
        let size = self.scale.max(1.0);
        let weight = size / max_abs(&sum).max(1.0);
        sum.iter_mut().zip(&self.values).for_each(|(sum, value)| *sum = weight * *sum + value);
        let mut residual: Vec<f64> = self.kernel.right_hand_side().iter().map(|q| -q).collect();
        self.kernel.add_start_column(probe, -weight, &mut residual);
        for (&var, &factor) in self.basic.iter().zip(&sum).filter(|(_, factor)| **factor != 0.0) {
            self.kernel.add_start_column(var, factor, &mut residual);
        }
        // The negation makes a NaN count as drift.
        !residual.iter().all(|r| r.abs() <= VANISHING * size)
    }
}

/// A fixed pseudo-random key for every variable: the exclusive or over a basis is its signature.
fn key(var: Var) -> u64 {
    SplitMix::new(var as u64).next_u64()
}
