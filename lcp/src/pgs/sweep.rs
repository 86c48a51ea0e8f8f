//! The sweeps, and when they end.

use super::block::Block;
use super::constants::{FLOOR, LEAST_WINDOW};
use super::order::order;
use super::{Constraint, ProjectedGaussSeidelSettings, Rows, SweepOrder};
use crate::solve::Monitor;
use crate::vector::{check_length, check_vector, max_abs};
use crate::{Error, Method, Residuals, Status};

/// Rows with their constraints, and a point that meets them.
pub(super) struct Sweeps<'a, R: ?Sized> {
    settings: &'a ProjectedGaussSeidelSettings,
    rows: &'a mut R,
    q: &'a [f64],
    blocks: Vec<Block>,
    order: Vec<usize>,
    diagonals: Vec<f64>,
    z: Vec<f64>,
    /// The size of every row at the last evaluation.
    sizes: Vec<f64>,
}

/// A point with what the residual is made of.
pub(super) struct Point<'a> {
    pub(super) z: &'a [f64],
    /// `M z + q`.
    pub(super) w: &'a [f64],
    /// The part of `w` that the constraints allow at `z`.
    pub(super) allowed: &'a [f64],
    /// The size of the terms of every row.
    pub(super) sizes: &'a [f64],
}

/// The best point of a run.
#[derive(Debug, Clone)]
pub(super) struct Best {
    pub(super) z: Vec<f64>,
    pub(super) w: Vec<f64>,
    pub(super) allowed: Vec<f64>,
    pub(super) residuals: Residuals,
}

impl<'a, R: Rows + ?Sized> Sweeps<'a, R> {
    /// From `start`, or from zero, both moved to where the constraints allow them to be.
    pub(super) fn new(
        settings: &'a ProjectedGaussSeidelSettings,
        rows: &'a mut R,
        q: &'a [f64],
        constraints: &[Constraint],
        start: Option<Vec<f64>>,
    ) -> Result<Self, Error> {
        let n = rows.order();
        check_length("q", q.len(), n)?;
        check_vector("q", q)?;
        let blocks = Block::all(rows, constraints, Method::GaussSeidel)?;
        let order = order(rows, &blocks, settings.order);
        let diagonals = blocks.iter().flat_map(Block::diagonals).collect();
        let mut z = start.unwrap_or_else(|| vec![0.0; n]);
        for block in &blocks {
            block.project(&mut z);
        }
        Ok(Self { settings, rows, q, blocks, order, diagonals, z, sizes: vec![0.0; n] })
    }

    /// Sweeps until `judge` finds residuals below the tolerance, or something else ends them.
    pub(super) fn run(
        mut self,
        monitor: &mut Monitor<'_>,
        judge: &mut dyn FnMut(&Point<'_>) -> Residuals,
    ) -> (Best, Status) {
        let ProjectedGaussSeidelSettings { tolerance, residual_interval, .. } = *self.settings;
        let mut best = self.first();
        let mut stall = Stall::new(self.settings, self.z.len());
        let (mut sweep, mut change) = (0, f64::INFINITY);
        let mut residual = f64::INFINITY;
        // Below which changes the residual may be small.
        let mut small = tolerance;
        let (status, is_judged) = loop {
            let is_due = sweep % residual_interval == 0 || change < small;
            if is_due {
                small = small.min(0.5 * change);
                let residuals = self.judged(judge, &mut best);
                residual = residuals.map_or(residual, |residuals| residuals.worst());
                if residuals.is_none() {
                    // Nothing gets finite again: the best point stays.
                    let _ = monitor.stop(residual);
                    break (Status::Stalled, true);
                }
            }
            let limit = monitor.stop(residual);
            if is_due && residual <= tolerance {
                break (Status::Solved, true);
            }
            if let Some(status) = limit {
                break (status, is_due);
            }
            if is_due && stall.is_stalled(sweep, best.residuals.merit()) {
                break (Status::Stalled, true);
            }
            change = self.sweep(sweep % 2 == 1);
            sweep += 1;
        };
        if !is_judged
            && let Some(residuals) = self.judged(judge, &mut best)
            && let Some(last) = monitor.history.last_mut()
        {
            *last = residuals.worst();
        }
        (best, status)
    }

    /// Relaxes every block once. The largest change, each times its diagonal entry in units of its row.
    fn sweep(&mut self, is_odd: bool) -> f64 {
        let Self { settings, rows, q, blocks, order, diagonals, z, sizes } = self;
        let is_backward = is_odd && settings.order == SweepOrder::Symmetric;
        let last = order.len().saturating_sub(1);
        let mut largest = 0.0_f64;
        for k in 0..order.len() {
            let block = &blocks[order[if is_backward { last - k } else { k }]];
            let values = block.relaxed(&**rows, q, z, settings.relaxation);
            for (row, value) in block.rows().zip(values) {
                let change = value - z[row];
                if change != 0.0 {
                    z[row] = value;
                    rows.moved(row, change);
                    largest = largest.max(change.abs() * diagonals[row] / sizes[row]);
                }
            }
        }
        largest
    }

    /// Residuals of the present point, all computed anew; `None` if it or they are not finite. Keeps the
    /// point if it is the best one.
    fn judged(
        &mut self,
        judge: &mut dyn FnMut(&Point<'_>) -> Residuals,
        best: &mut Best,
    ) -> Option<Residuals> {
        let w = self.measure();
        let is_finite = [&self.z, &w, &self.sizes].iter().all(|v| v.iter().all(|x| x.is_finite()));
        if !is_finite {
            return None;
        }
        let mut allowed = w.clone();
        self.blocks.iter().for_each(|block| block.allowed(&self.z, &mut allowed));
        let point = Point { z: &self.z, w: &w, allowed: &allowed, sizes: &self.sizes };
        let residuals = judge(&point);
        if residuals.is_better_than(&best.residuals, self.settings.tolerance) {
            *best = Best { z: self.z.clone(), w, allowed, residuals };
        }
        Some(residuals)
    }

    /// `M z + q` and the sizes of the rows, free of the rounding errors of a state.
    fn measure(&mut self) -> Vec<f64> {
        let Self { rows, q, diagonals, z, sizes, .. } = self;
        rows.clear();
        z.iter().enumerate().filter(|(_, z)| **z != 0.0).for_each(|(i, z)| rows.moved(i, *z));
        let largest = max_abs(z);
        let row = |(i, q): (usize, &f64)| {
            let product = rows.product(i, z);
            let own = diagonals[i] * z[i].abs();
            let size = q.abs() + rows.size(i, z).max(product.abs()).max(own);
            sizes[i] = size.max(FLOOR * diagonals[i] * largest);
            product + q
        };
        q.iter().enumerate().map(row).collect()
    }

    /// The first point, before it is judged.
    fn first(&self) -> Best {
        let zero = vec![0.0; self.z.len()];
        let residuals = Residuals::infinite();
        Best { z: self.z.clone(), w: zero.clone(), allowed: zero, residuals }
    }
}

/// Whether the best point still gets better.
struct Stall {
    window: usize,
    factor: f64,
    since: usize,
    merit: f64,
}

impl Stall {
    fn new(settings: &ProjectedGaussSeidelSettings, rows: usize) -> Self {
        let window = settings.stall_window.unwrap_or(LEAST_WINDOW.max(rows));
        Self { window, factor: settings.stall_factor, since: 0, merit: f64::INFINITY }
    }

    fn is_stalled(&mut self, sweep: usize, best: f64) -> bool {
        if best < self.factor * self.merit {
            (self.since, self.merit) = (sweep, best);
        }
        sweep - self.since >= self.window
    }
}
