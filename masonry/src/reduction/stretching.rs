//! What the bars of mortar strips change in the flexibility: blocks that they couple.
//!
//! With the elongations `e = L u` and their stiffnesses `D` equilibrium is
//! `(K + L^T D L) u = f + C^T t`. No rigid motion stretches a strip, so the rows of `L` balance on every block, and
//! with forces `q = -D L u` on the blocks `u = K^+ (f + C^T t + L^T q) + N alpha` as before, where
//!
//! ```text
//!  S q' = -D^1/2 (F_LC t + L K^+ f),    q = D^1/2 q',    S = 1 + D^1/2 F_LL D^1/2,
//!  F_LC = L K^+ C^T,    F_LL = L K^+ L^T,
//!
//!  y = (F - F_CL D^1/2 S^-1 D^1/2 F_LC) t + ...
//! ```
//!
//! (Woodbury's identity). `S` has no eigenvalue below one, whatever the mortar.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, MatRef};

use crate::system::System;

/// The stretches of a system and how contact forces act on them.
#[derive(Debug, Clone)]
pub(super) struct Stretching {
    /// The diagonal of `D^1/2`.
    roots: Vec<f64>,
    /// `S`, factorised.
    factor: PartialPivLu<f64>,
    /// `D^1/2 F_LC`, stretches by rows.
    on_rows: Mat<f64>,
    /// `D^1/2 L K^+ f`.
    free: Mat<f64>,
}

impl Stretching {
    /// `None` where nothing stretches.
    pub(super) fn of(system: &System) -> Option<Self> {
        let count = system.stretches.len();
        if count == 0 {
            return None;
        }
        let roots: Vec<f64> = system.stretches.iter().map(|row| row.stiffness.sqrt()).collect();
        let mut s = Mat::<f64>::identity(count, count);
        let mut on_rows = Mat::zeros(count, system.rows.len());
        let mut free = Mat::zeros(count, 1);
        for body in &system.bodies {
            let Some(stiffness) = body.stiffness.map(|k| &system.stiffnesses[k]) else { continue };
            let mut rhs = Mat::zeros(body.load.len(), body.stretches.len());
            for (k, stretch) in body.stretches.iter().enumerate() {
                stretch.entries.iter().for_each(|(dof, c)| rhs[(*dof, k)] += c);
            }
            let solved = stiffness.solve(&rhs);
            for (k, stretch) in body.stretches.iter().enumerate() {
                let (column, root) = (solved.col_as_slice(k), roots[stretch.row]);
                let times = |entries: &[(usize, f64)]| -> f64 {
                    entries.iter().map(|(dof, c)| c * column[*dof]).sum::<f64>() * root
                };
                for other in &body.stretches {
                    s[(stretch.row, other.row)] += times(&other.entries) * roots[other.row];
                }
                for row in &body.rows {
                    on_rows[(stretch.row, row.row)] += times(&row.entries);
                }
                let loaded = column.iter().zip(&body.load).map(|(u, f)| u * f);
                free[(stretch.row, 0)] += loaded.sum::<f64>() * root;
            }
        }
        Some(Self { roots, factor: s.partial_piv_lu(), on_rows, free })
    }

    /// `D^1/2 F_LC`, stretches by rows.
    pub(super) fn on_rows(&self) -> &Mat<f64> {
        &self.on_rows
    }

    /// `D^1/2 F_LC W`, stretches by rows `E`, for `t_I = R t_E`.
    pub(super) fn on_others(
        &self,
        isostatic: &[usize],
        others: &[usize],
        r: MatRef<'_, f64>,
    ) -> Mat<f64> {
        let count = self.roots.len();
        let of =
            |rows: &[usize]| Mat::from_fn(count, rows.len(), |i, j| self.on_rows[(i, rows[j])]);
        of(others) + of(isostatic) * r
    }

    /// Subtracts `X^T S^-1 X` from a flexibility, symmetric to the last digit, where `X` is `D^1/2 F_LC` in the
    /// columns of the flexibility.
    pub(super) fn stiffen(&self, flexibility: &mut Mat<f64>, x: &Mat<f64>) {
        let taken = x.transpose() * self.factor.solve(x);
        for j in 0..taken.ncols() {
            for i in 0..taken.nrows() {
                flexibility[(i, j)] -= 0.5 * (taken[(i, j)] + taken[(j, i)]);
            }
        }
    }

    /// The forces `q` \[N\] of the stretches on their blocks for forces `t` \[N\] of all rows.
    pub(super) fn forces(&self, t: &[f64]) -> Vec<f64> {
        let q = self.scaled_forces(t);
        self.roots.iter().enumerate().map(|(k, root)| root * q[(k, 0)]).collect()
    }

    /// The relative displacements \[m\] of all rows that the forces of the stretches add to those by `t` and
    /// the loads.
    pub(super) fn displacements(&self, t: &[f64]) -> Vec<f64> {
        let y = self.on_rows.transpose() * self.scaled_forces(t);
        y.col_as_slice(0).to_vec()
    }

    /// `q'` for forces `t` of all rows.
    fn scaled_forces(&self, t: &[f64]) -> Mat<f64> {
        let t = Mat::from_fn(t.len(), 1, |i, _| t[i]);
        let load = &self.on_rows * t + &self.free;
        self.factor.solve(faer::Scale(-1.0) * load)
    }
}
