//! The flexibility of blocks that the bars of mortar strips couple.
//!
//! Equilibrium with the elongations `e = L u` and their stiffnesses `D` is
//! `(K + L^T D L) u = f + C^T t`. No rigid motion stretches a strip, so the rows of `L` balance on every block, and
//! with the forces `q = -D L u` of the bars on the blocks `u = K^+ (f + C^T t + L^T q) + N alpha` as before, and
//!
//! ```text
//!  H q + F_LC t + L K^+ f = 0,      H = D^-1 + F_LL,    F_LC = L K^+ C^T,    F_LL = L K^+ L^T,
//!
//!  y = (F - F_CL H^-1 F_LC) t + C K^+ f - F_CL H^-1 L K^+ f + x + G alpha
//! ```
//!
//! (Woodbury's identity). `H` is positive definite.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, MatRef};

use crate::system::System;

/// The bars of a system and how contact forces act on them.
#[derive(Debug, Clone)]
pub struct Bars {
    /// `H = D^-1 + F_LL` \[m/N\].
    pub own: Mat<f64>,
    /// `F_LC` \[m/N\], bars by rows of the system.
    pub on_rows: Mat<f64>,
    /// `L K^+ f` \[m\].
    pub free: Vec<f64>,
    factor: PartialPivLu<f64>,
}

impl Bars {
    /// `None` where nothing stretches.
    pub(super) fn of(system: &System) -> Option<Self> {
        let count = system.stretches.len();
        if count == 0 {
            return None;
        }
        let mut own: Mat<f64> = Mat::zeros(count, count);
        system.stretches.iter().enumerate().for_each(|(k, bar)| own[(k, k)] = 1.0 / bar.stiffness);
        let mut on_rows = Mat::zeros(count, system.rows.len());
        let mut free = vec![0.0; count];
        for body in &system.bodies {
            let Some(stiffness) = body.stiffness.map(|k| &system.stiffnesses[k]) else { continue };
            let mut rhs = Mat::zeros(body.load.len(), body.stretches.len());
            for (k, stretch) in body.stretches.iter().enumerate() {
                stretch.entries.iter().for_each(|(dof, c)| rhs[(*dof, k)] += c);
            }
            let solved = stiffness.solve(&rhs);
            for (k, stretch) in body.stretches.iter().enumerate() {
                let column = solved.col_as_slice(k);
                let times = |entries: &[(usize, f64)]| -> f64 {
                    entries.iter().map(|(dof, c)| c * column[*dof]).sum()
                };
                for other in &body.stretches {
                    own[(stretch.row, other.row)] += times(&other.entries);
                }
                for row in &body.rows {
                    on_rows[(stretch.row, row.row)] += times(&row.entries);
                }
                let loaded = column.iter().zip(&body.load).map(|(u, f)| u * f);
                free[stretch.row] += loaded.sum::<f64>();
            }
        }
        let own = Mat::from_fn(count, count, |i, j| 0.5 * (own[(i, j)] + own[(j, i)]));
        let factor = own.partial_piv_lu();
        Some(Self { own, on_rows, free, factor })
    }

    /// Subtracts `W^T F_CL H^-1 F_LC W` from `A`, symmetric to the last digit, for `t_I = R t_E`.
    pub(super) fn stiffen(
        &self,
        a: &mut Mat<f64>,
        isostatic: &[usize],
        others: &[usize],
        r: MatRef<'_, f64>,
    ) {
        let of = |rows: &[usize]| {
            Mat::from_fn(self.free.len(), rows.len(), |i, j| self.on_rows[(i, rows[j])])
        };
        let on_others = of(others) + of(isostatic) * r;
        let taken = on_others.transpose() * self.factor.solve(&on_others);
        for j in 0..taken.ncols() {
            for i in 0..taken.nrows() {
                a[(i, j)] -= 0.5 * (taken[(i, j)] + taken[(j, i)]);
            }
        }
    }

    /// The forces `q` \[N\] of the bars on their blocks for forces `t` \[N\] of all rows.
    pub(super) fn forces(&self, t: &[f64]) -> Vec<f64> {
        let t = Mat::from_fn(t.len(), 1, |i, _| t[i]);
        let mut e = &self.on_rows * t;
        self.free.iter().enumerate().for_each(|(k, free)| e[(k, 0)] += free);
        self.factor.solve(faer::Scale(-1.0) * e).col_as_slice(0).to_vec()
    }

    /// The relative displacements \[m\] of all rows that the bars add to those by `t` and the loads.
    pub(super) fn displacements(&self, t: &[f64]) -> Vec<f64> {
        let q = self.forces(t);
        let q = Mat::from_fn(q.len(), 1, |i, _| q[i]);
        (self.on_rows.transpose() * q).col_as_slice(0).to_vec()
    }
}
