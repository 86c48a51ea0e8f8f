//! The sweeps, and the conditions for their end.

use super::block::Block;
use super::{Constraint, ProjectedGaussSeidelSettings, Rows};
use crate::solve::Monitor;
use crate::vector::{WEAK, check_length, check_vector, max_abs};
use crate::{Error, Residuals, Status};

/// Sweeps between two evaluations of the residual, each of which costs as much as several sweeps. Chosen.
const INTERVAL: usize = 20;
/// Least number of sweeps in which the residual has to fall by a tenth. Chosen: information spreads along a chain of
/// `n` bodies for `n` sweeps before the largest residual decreases.
const PATIENCE: usize = 2000;

/// Rows with their constraints, and a point that meets them.
pub(super) struct Sweeps<'a, R: ?Sized> {
    settings: &'a ProjectedGaussSeidelSettings,
    rows: &'a mut R,
    q: &'a [f64],
    blocks: Vec<Block>,
    diagonals: Vec<f64>,
    z: Vec<f64>,
    /// The size of the terms of every row at the last evaluation.
    sizes: Vec<f64>,
}

/// A point with the parts of its residual.
pub(super) struct Swept {
    pub(super) z: Vec<f64>,
    /// `M z + q`.
    pub(super) w: Vec<f64>,
    /// The part of `w` that the constraints allow at `z`.
    pub(super) allowed: Vec<f64>,
    /// The size of the terms of every row.
    pub(super) sizes: Vec<f64>,
    pub(super) residuals: Residuals,
}

impl<'a, R: Rows + ?Sized> Sweeps<'a, R> {
    /// Sweeps that begin at `start`, or at zero, projected onto the constraints.
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
        let blocks = Block::all(rows, constraints)?;
        let diagonals = blocks.iter().flat_map(Block::diagonals).collect();
        let mut z = start.unwrap_or_else(|| vec![0.0; n]);
        for block in &blocks {
            block.project(&mut z);
        }
        Ok(Self { settings, rows, q, blocks, diagonals, z, sizes: vec![0.0; n] })
    }

    /// Sweeps until `judge` finds residuals below the tolerance, or another condition ends the iteration.
    pub(super) fn run(
        mut self,
        monitor: &mut Monitor<'_>,
        judge: &mut dyn FnMut(&Swept, &R) -> Residuals,
    ) -> (Swept, Status) {
        let tolerance = self.settings.tolerance;
        let mut best = self.point(vec![0.0; self.z.len()]);
        let (mut last_fall, mut merit) = (0, f64::INFINITY);
        let (mut sweep, mut change, mut residual) = (0, f64::INFINITY, f64::INFINITY);
        // The size of changes below which the residual may be small.
        let mut small = tolerance;
        let status = loop {
            let is_due = sweep % INTERVAL == 0 || change < small;
            let mut is_lost = false;
            if is_due {
                small = small.min(0.5 * change);
                let worst = self.judged(judge, &mut best).worst();
                // Numbers that are not finite remain so: the best point is kept.
                is_lost = !worst.is_finite();
                residual = if is_lost { residual } else { worst };
            }
            let limit = monitor.stop(residual);
            if is_due && !is_lost && residual <= tolerance {
                break Status::Solved;
            }
            if let Some(status) = limit {
                break status;
            }
            if best.residuals.merit() < 0.9 * merit {
                (last_fall, merit) = (sweep, best.residuals.merit());
            }
            if is_lost || sweep - last_fall >= PATIENCE.max(self.z.len()) {
                break Status::Stalled;
            }
            change = self.sweep();
            sweep += 1;
        };
        (best, status)
    }

    /// Relaxes every block once; returns the largest change, each multiplied by its diagonal entry, in units of its
    /// row.
    fn sweep(&mut self) -> f64 {
        let Self { settings, rows, q, blocks, diagonals, z, sizes } = self;
        let mut largest = 0.0_f64;
        for block in blocks {
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

    /// Residuals of the present point, all computed anew. Keeps the point if it is the best one.
    fn judged(
        &mut self,
        judge: &mut dyn FnMut(&Swept, &R) -> Residuals,
        best: &mut Swept,
    ) -> Residuals {
        let w = self.measure();
        if [&self.z, &w, &self.sizes].into_iter().flatten().any(|v| !v.is_finite()) {
            return Residuals::infinite();
        }
        let mut point = self.point(w);
        self.blocks.iter().for_each(|block| block.allowed(&point.z, &mut point.allowed));
        point.residuals = judge(&point, self.rows);
        let residuals = point.residuals;
        if residuals.is_better_than(&best.residuals, self.settings.tolerance) {
            *best = point;
        }
        residuals
    }

    /// The present point before it is judged.
    fn point(&self, w: Vec<f64>) -> Swept {
        let (z, allowed, sizes) = (self.z.clone(), w.clone(), self.sizes.clone());
        Swept { z, w, allowed, sizes, residuals: Residuals::infinite() }
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
            sizes[i] = size.max(WEAK * diagonals[i] * largest);
            product + q
        };
        q.iter().enumerate().map(row).collect()
    }
}
