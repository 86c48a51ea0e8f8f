//! Elimination of the displacements: from the equilibrium system to contact forces alone.
//!
//! The rows of the system are divided into isostatic rows `I` and other rows `E`. Equilibrium of all blocks is
//! `t_I = R t_E + t_0` (3.18), and the relative displacements are `y_E = A t_E - R^T y_I + c` (3.23) with
//! `A = W^T F W`. The matrix `W` is the identity in rows `E` and `R` in rows `I`, and `F = C K^+ C^T` has the
//! compliance of joints and of mortar films added to its diagonal. Any generalised inverse `K^+` gives the same `A` and
//! `c`, because the columns of `W`, and the loads together with `t_0`, are balanced on every block.
//!
//! Strips of mortar couple blocks. Equilibrium with the elongations `e = L u` of their bars and the stiffnesses `D` is
//! `(K + L^T D L) u = f + C^T t`. No rigid motion stretches a strip, so that the rows of `L` are balanced on every
//! block. With the forces `q = -D L u` of the bars on the blocks, `u = K^+ (f + C^T t + L^T q) + N alpha` as before,
//! and
//!
//! ```text
//!  H q + F_LC t + L K^+ f = 0,      H = D^-1 + F_LL,    F_LC = L K^+ C^T,    F_LL = L K^+ L^T,
//!
//!  y = (F - F_CL H^-1 F_LC) t + C K^+ f - F_CL H^-1 L K^+ f + x + G alpha
//! ```
//!
//! (Woodbury's identity). `H` is positive definite: it is the part of the flexibility of rows and bars that belongs to
//! the bars.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, MatRef};

use crate::system::rigid::{self, Modes, RigidError, select_rows};
use crate::system::{BodySystem, System};

/// The reduced contact problem: equilibrium and compatibility with only the contact forces as unknowns.
#[derive(Debug, Clone)]
pub struct Reduction {
    /// The isostatic rows `I` of the system, three per block, in increasing order.
    pub isostatic: Vec<usize>,
    /// The other rows `E` of the system, in increasing order.
    pub others: Vec<usize>,
    /// The matrix `R` of (3.18) \[-\], whose rows belong to `I` and columns to `E`.
    pub r: Mat<f64>,
    /// The vector `t_0` of (3.18): forces of the isostatic rows that balance the loads \[N\].
    pub t0: Vec<f64>,
    /// The matrix `A = W^T F W` \[m/N\], symmetric and positive semidefinite; empty if nothing deforms, as in a
    /// structure of rigid blocks and joints without compliance.
    pub a: Mat<f64>,
    /// The vector `c` of (3.23) \[m\].
    pub c: Vec<f64>,
    /// The flexibility of rows and bars, from which relative displacements are computed.
    pub(super) flexibility: Flexibility,
    /// The factors of the matrix `H`; `None` if there are no bars.
    bars: Option<PartialPivLu<f64>>,
    /// The matrix `G_I`, with the rows `I` and three columns per block.
    g_isostatic: Mat<f64>,
}

impl Reduction {
    /// Reduces a system to a problem in which only the contact forces are unknowns.
    ///
    /// The positive numbers `weights`, one for each row, decide between equally good rows: those with large weights are
    /// taken for the isostatic part. The weights change `R`, `A` and `c` but not the recovered state.
    ///
    /// # Errors
    /// [`RigidError::Free`] if a block can move without any resistance at its contacts.
    ///
    /// # Panics
    /// If there are fewer weights than rows.
    pub fn new(system: &System, weights: Option<&[f64]>) -> Result<Self, RigidError> {
        let g = system.rigid_rows();
        let modes: Vec<Modes> = system.bodies.iter().map(|body| body.modes).collect();
        let chosen = rigid::choose(&g, system.points(), &modes, weights)?;
        let (isostatic, others) = (chosen.rows, chosen.others);

        let g_isostatic = select_rows(&g, &isostatic);
        let balance = g_isostatic.transpose().partial_piv_lu();
        let r = -balance.solve(select_rows(&g, &others).transpose());
        let resultants = system.resultants();
        let t0 = balance.solve(Mat::from_fn(resultants.len(), 1, |i, _| -resultants[i]));
        let t0 = t0.col_as_slice(0).to_vec();

        let flexibility = Flexibility::of(system);
        let (a, c, bars) = (Mat::new(), Vec::new(), None);
        let mut reduction = Self { isostatic, others, r, t0, a, c, flexibility, bars, g_isostatic };
        if system.gives_way() {
            let mut f = reduction.flexibility.matrix();
            reduction.bars = eliminate_bars(&mut f, system.rows.len());
            reduction.a = reduction.of_others(f.as_ref());
        }
        let Self { isostatic, others, r, t0, .. } = &reduction;
        let mut t = vec![0.0; system.rows.len()];
        isostatic.iter().zip(t0).for_each(|(row, force)| t[*row] = *force);
        let y = reduction.elastic_gaps(&t);
        let y_isostatic = Mat::from_fn(isostatic.len(), 1, |i, _| y[isostatic[i]]);
        let carried = r.transpose() * y_isostatic;
        let c = others.iter().enumerate().map(|(k, row)| y[*row] + carried[(k, 0)]).collect();
        Ok(Self { c, ..reduction })
    }

    /// Computes `A = W^T F W = F_EE + S + S^T` with `S = R^T (F_IE + F_II R / 2)`, which needs one large product and is
    /// symmetric to the last digit.
    fn of_others(&self, f: MatRef<'_, f64>) -> Mat<f64> {
        let Self { isostatic, others, r, .. } = self;
        let of_isostatic = |columns: &[usize]| {
            Mat::from_fn(isostatic.len(), columns.len(), |i, j| f[(isostatic[i], columns[j])])
        };
        let half = of_isostatic(others) + faer::Scale(0.5) * (of_isostatic(isostatic) * r);
        let s = r.transpose() * half;
        Mat::from_fn(s.nrows(), s.ncols(), |i, j| {
            f[(others[i], others[j])] + (s[(i, j)] + s[(j, i)])
        })
    }

    /// Computes the relative displacements `F t + C K^+ f + x` \[m\] of all rows for forces `t` \[N\], without those of
    /// rigid motions.
    pub fn elastic_gaps(&self, t: &[f64]) -> Vec<f64> {
        let mut y = self.flexibility.gaps(&[t, &self.bar_forces(t)].concat());
        y.truncate(t.len());
        y
    }

    /// Computes the forces `q` \[N\] of the bars of strips on their blocks for forces `t` \[N\] of all rows.
    pub fn bar_forces(&self, t: &[f64]) -> Vec<f64> {
        let Some(h) = &self.bars else { return Vec::new() };
        let rest = vec![0.0; self.flexibility.own.len() - t.len()];
        let elongations = &self.flexibility.gaps(&[t, &rest].concat())[t.len()..];
        let rhs = Mat::from_fn(rest.len(), 1, |k, _| -elongations[k]);
        h.solve(rhs).col_as_slice(0).to_vec()
    }

    /// Computes the rigid amplitudes \[m\], three per block, for the forces `t` \[N\] and the relative displacements
    /// `y` \[m\] of all rows. Only the isostatic rows are used, since they determine the amplitudes.
    pub fn amplitudes(&self, t: &[f64], y: &[f64]) -> Vec<f64> {
        let elastic = self.elastic_gaps(t);
        let rigid = self.isostatic.iter().map(|row| y[*row] - elastic[*row]);
        let rigid: Vec<f64> = rigid.collect();
        let rhs = Mat::from_fn(rigid.len(), 1, |i, _| rigid[i]);
        self.g_isostatic.partial_piv_lu().solve(rhs).col_as_slice(0).to_vec()
    }
}

/// Replaces `f`, the flexibility of rows and bars, by that of the rows alone, `F - F_CL H^-1 F_LC`, symmetric to the
/// last digit. Returns the factors of `H`; `None` if there are no bars.
fn eliminate_bars(f: &mut Mat<f64>, rows: usize) -> Option<PartialPivLu<f64>> {
    let bars = f.nrows() - rows;
    if bars == 0 {
        return None;
    }
    let h = f.submatrix(rows, rows, bars, bars).partial_piv_lu();
    let on_rows = f.submatrix(rows, 0, bars, rows);
    let taken = on_rows.transpose() * h.solve(on_rows);
    *f = Mat::from_fn(rows, rows, |i, j| f[(i, j)] - 0.5 * (taken[(i, j)] + taken[(j, i)]));
    Some(h)
}

/// The flexibility `F`: the relative displacements of the rows of a system, and of the bars of mortar strips after
/// them, under forces on these rows and bars.
#[derive(Debug, Clone)]
pub(super) struct Flexibility {
    blocks: Vec<Compliance>,
    /// The compliance \[m/N\] of every row by its joint or film, and `D^-1` of every bar after them.
    own: Vec<f64>,
    /// The offsets `x` \[m\] of the rows; zero for bars.
    offsets: Vec<f64>,
}

/// The flexibility of one elastic block.
#[derive(Debug, Clone)]
struct Compliance {
    /// The indices of the rows and bars that act on the block.
    places: Vec<usize>,
    /// The part of `F` \[m/N\] that is due to the block, for the rows and bars in `places`.
    f: Mat<f64>,
    /// The part of `C K^+ f` and `L K^+ f` \[m\] that is due to the block, for the rows and bars in `places`.
    v: Vec<f64>,
}

impl Flexibility {
    fn of(system: &System) -> Self {
        let rows = system.rows.iter();
        let bars = system.stretches.iter();
        let own = rows.clone().map(|row| row.compliance);
        Self {
            blocks: system.bodies.iter().filter_map(|body| Compliance::of(system, body)).collect(),
            own: own.chain(bars.clone().map(|bar| 1.0 / bar.stiffness)).collect(),
            offsets: rows.map(|row| row.offset).chain(bars.map(|_| 0.0)).collect(),
        }
    }

    /// Returns the flexibility `F` of all rows and bars as a dense matrix \[m/N\].
    pub(super) fn matrix(&self) -> Mat<f64> {
        let mut f = Mat::zeros(self.own.len(), self.own.len());
        self.own.iter().enumerate().for_each(|(k, own)| f[(k, k)] = *own);
        for block in &self.blocks {
            for (j, column) in block.places.iter().enumerate() {
                for (i, row) in block.places.iter().enumerate() {
                    f[(*row, *column)] += block.f[(i, j)];
                }
            }
        }
        f
    }

    /// Computes the relative displacements `F t + C K^+ f + x` \[m\] for forces `t` \[N\], without those of rigid
    /// motions.
    pub(super) fn gaps(&self, t: &[f64]) -> Vec<f64> {
        let own = self.offsets.iter().zip(&self.own).zip(t);
        let mut y: Vec<f64> = own.map(|((offset, own), t)| offset + own * t).collect();
        for Compliance { places, f, v } in &self.blocks {
            for (i, (place, v)) in places.iter().zip(v).enumerate() {
                let f_t: f64 = places.iter().enumerate().map(|(j, k)| f[(i, j)] * t[*k]).sum();
                y[*place] += f_t + v;
            }
        }
        y
    }
}

impl Compliance {
    /// Returns the flexibility of a block; `None` if the block is rigid.
    fn of(system: &System, body: &BodySystem) -> Option<Self> {
        let stiffness = &system.stiffnesses[body.stiffness?];
        let rows = body.rows.iter().map(|row| (row.row, &row.entries));
        let bars = body.stretches.iter().map(|bar| (system.rows.len() + bar.row, &bar.entries));
        let (places, entries): (Vec<_>, Vec<_>) = rows.chain(bars).unzip();
        // The last column is for the loads.
        let count = places.len();
        let mut rhs = Mat::zeros(body.load.len(), count + 1);
        for (k, entries) in entries.iter().enumerate() {
            entries.iter().for_each(|(dof, c)| rhs[(*dof, k)] += c);
        }
        body.load.iter().enumerate().for_each(|(dof, f)| rhs[(dof, count)] = *f);
        let solved = stiffness.solve(&rhs);
        let at = |k: usize, column: usize| -> f64 {
            entries[k].iter().map(|(dof, c)| c * solved[(*dof, column)]).sum()
        };
        let f = Mat::from_fn(count, count, |i, j| 0.5 * (at(i, j) + at(j, i)));
        let v = (0..count).map(|i| at(i, count)).collect();
        Some(Self { places, f, v })
    }
}
