//! Elimination of the displacements: from the equilibrium system to contact forces alone.
//!
//! Equilibrium of all blocks, with isostatic rows `I` and the others `E`, is
//! `t_I = R t_E + t_0` (3.18), and the relative displacements follow from
//! `y_E = A t_E - R^T y_I + c` (3.23), where `A = W^T F W`, `W` is the identity on `E` and `R` on `I`,
//! and `F = C K^+ C^T`, with the compliance of joints and of mortar films on the diagonal. Any generalised inverse `K^+`
//! gives the same `A` and `c`, because the columns of `W` and the loads with `t_0` balance on every block. Strips of mortar
//! couple blocks; what that changes is in [`Bars`].

use faer::linalg::solvers::Solve;
use faer::{Mat, MatRef};

use crate::system::System;
use crate::system::rigid::{self, Modes, RigidError, select_rows};

mod bars;

pub use bars::Bars;

/// The reduced problem: equilibrium and compatibility in the contact forces.
#[derive(Debug, Clone)]
pub struct Reduction {
    /// The isostatic rows `I` of the system, three per block, increasing.
    pub isostatic: Vec<usize>,
    /// The other rows `E`, increasing.
    pub others: Vec<usize>,
    /// `R` of (3.18), rows `I` by columns `E` \[-\].
    pub r: Mat<f64>,
    /// `t_0` of (3.18): forces of the isostatic rows that balance the loads \[N\].
    pub t0: Vec<f64>,
    /// `A = W^T F W` \[m/N\], symmetric and positive semidefinite; empty if nothing deforms: rigid blocks in joints
    /// that do not give way only have `R`.
    pub a: Mat<f64>,
    /// `c` of (3.23) \[m\].
    pub c: Vec<f64>,
    /// The compliance of every block, in the order of the model.
    pub compliances: Vec<Compliance>,
    /// The bars of mortar strips; `None` where there are none.
    pub bars: Option<Bars>,
    /// `G_I`, rows `I` by three columns per block.
    g_isostatic: Mat<f64>,
}

/// The compliance of one block at its contact rows.
#[derive(Debug, Clone)]
pub struct Compliance {
    /// The block's contact rows, increasing.
    pub rows: Vec<usize>,
    /// Its part of `F = C K^+ C^T` \[m/N\] on these rows; empty for a rigid block.
    pub f: Mat<f64>,
    /// Its part of `C K^+ f` \[m\]; empty for a rigid block.
    pub v: Vec<f64>,
}

impl Reduction {
    /// Reduces a system.
    ///
    /// `weights`, one positive number per row, give preference to rows for the isostatic part; they change `R`, `A`
    /// and `c` but not the recovered state.
    ///
    /// # Errors
    /// [`RigidError::Free`] if some block can move without any resistance at its contacts.
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

        let compliances = compliances(system);
        let mut a = if system.gives_way() {
            Flexibility::assemble(system, &compliances, &isostatic, &others).reduce(r.as_ref())
        } else {
            Mat::new()
        };
        let bars = Bars::of(system);
        if let Some(bars) = &bars {
            bars.stiffen(&mut a, &isostatic, &others, r.as_ref());
        }

        let mut t = vec![0.0; system.rows.len()];
        isostatic.iter().zip(&t0).for_each(|(row, force)| t[*row] = *force);
        let y = relative_displacements(system, &compliances, bars.as_ref(), &t);
        let y_isostatic = Mat::from_fn(isostatic.len(), 1, |i, _| y[isostatic[i]]);
        let carried = r.transpose() * y_isostatic;
        let c = others.iter().enumerate().map(|(k, row)| y[*row] + carried[(k, 0)]).collect();
        Ok(Self { isostatic, others, r, t0, a, c, compliances, bars, g_isostatic })
    }

    /// Relative displacements `F t + C K^+ f + x` \[m\] of all rows for forces `t` \[N\], without the
    /// rigid motions.
    pub fn elastic_gaps(&self, system: &System, t: &[f64]) -> Vec<f64> {
        relative_displacements(system, &self.compliances, self.bars.as_ref(), t)
    }

    /// The [`elastic_gaps`](Self::elastic_gaps) without the [`bars`](Self::bars) of mortar strips, whose
    /// forces are unknowns of the mixed form.
    pub fn block_gaps(&self, system: &System, t: &[f64]) -> Vec<f64> {
        relative_displacements(system, &self.compliances, None, t)
    }

    /// The forces `q` \[N\] of the bars of strips on their blocks for forces `t` \[N\] of all rows.
    pub fn bar_forces(&self, t: &[f64]) -> Vec<f64> {
        self.bars.as_ref().map_or_else(Vec::new, |bars| bars.forces(t))
    }

    /// The rigid amplitudes \[m\], three per block, for the forces `t` \[N\] and the relative
    /// displacements `y` \[m\] of all rows: those of the isostatic rows decide.
    pub fn amplitudes(&self, system: &System, t: &[f64], y: &[f64]) -> Vec<f64> {
        let elastic = self.elastic_gaps(system, t);
        let rigid: Vec<f64> = y.iter().zip(&elastic).map(|(y, e)| y - e).collect();
        self.rigid_amplitudes(&rigid)
    }

    /// The amplitudes \[m\] of the rigid motion with the relative displacements `y` \[m\] of all rows.
    pub fn rigid_amplitudes(&self, y: &[f64]) -> Vec<f64> {
        let rhs = Mat::from_fn(self.isostatic.len(), 1, |i, _| y[self.isostatic[i]]);
        self.g_isostatic.partial_piv_lu().solve(rhs).col_as_slice(0).to_vec()
    }

    /// `F = C K^+ C^T` \[m/N\] of all rows, with the compliance of joints and films and without bars, dense; empty
    /// where nothing gives way.
    pub fn flexibility(&self, system: &System) -> Mat<f64> {
        if !system.gives_way() {
            return Mat::new();
        }
        let mut f = Mat::zeros(system.rows.len(), system.rows.len());
        system.rows.iter().enumerate().for_each(|(k, row)| f[(k, k)] = row.compliance);
        for block in &self.compliances {
            scatter(&mut f, block, Some, Some);
        }
        f
    }
}

/// The compliance of every block on its contact rows.
fn compliances(system: &System) -> Vec<Compliance> {
    let of_body = |body: &crate::system::BodySystem| {
        let rows = body.rows.iter().map(|row| row.row).collect();
        let Some(stiffness) = body.stiffness.map(|k| &system.stiffnesses[k]) else {
            return Compliance { rows, f: Mat::new(), v: Vec::new() };
        };
        // The last column carries the loads.
        let count = body.rows.len();
        let mut rhs = Mat::zeros(body.load.len(), count + 1);
        for (k, row) in body.rows.iter().enumerate() {
            row.entries.iter().for_each(|(dof, c)| rhs[(*dof, k)] += c);
        }
        body.load.iter().enumerate().for_each(|(dof, f)| rhs[(dof, count)] = *f);
        let solved = stiffness.solve(&rhs);
        let on_row = |k: usize, column: usize| -> f64 {
            body.rows[k].entries.iter().map(|(dof, c)| c * solved[(*dof, column)]).sum()
        };
        let f = Mat::from_fn(count, count, |i, j| 0.5 * (on_row(i, j) + on_row(j, i)));
        let v = (0..count).map(|i| on_row(i, count)).collect();
        Compliance { rows, f, v }
    };
    system.bodies.iter().map(of_body).collect()
}

fn relative_displacements(
    system: &System,
    blocks: &[Compliance],
    bars: Option<&Bars>,
    t: &[f64],
) -> Vec<f64> {
    let own = system.rows.iter().zip(t).map(|(row, t)| row.offset + row.compliance * t);
    let mut y: Vec<f64> = own.collect();
    for block in blocks {
        for (i, (row, v)) in block.rows.iter().zip(&block.v).enumerate() {
            let f_t: f64 =
                block.rows.iter().enumerate().map(|(j, r)| block.f[(i, j)] * t[*r]).sum();
            y[*row] += f_t + v;
        }
    }
    if let Some(bars) = bars {
        y.iter_mut().zip(bars.displacements(t)).for_each(|(y, more)| *y += more);
    }
    y
}

/// `F`, split into isostatic rows and others.
struct Flexibility {
    ee: Mat<f64>,
    ie: Mat<f64>,
    ii: Mat<f64>,
}

impl Flexibility {
    fn assemble(
        system: &System,
        blocks: &[Compliance],
        isostatic: &[usize],
        others: &[usize],
    ) -> Self {
        let (i, e) = (isostatic.len(), others.len());
        let place = |list: &[usize]| {
            let mut place = vec![None; i + e];
            list.iter().enumerate().for_each(|(k, row)| place[*row] = Some(k));
            place
        };
        let (in_i, in_e) = (place(isostatic), place(others));
        let mut parts = Self { ee: Mat::zeros(e, e), ie: Mat::zeros(i, e), ii: Mat::zeros(i, i) };
        for (k, row) in isostatic.iter().enumerate() {
            parts.ii[(k, k)] = system.rows[*row].compliance;
        }
        for (k, row) in others.iter().enumerate() {
            parts.ee[(k, k)] = system.rows[*row].compliance;
        }
        for block in blocks {
            scatter(&mut parts.ee, block, |row| in_e[row], |row| in_e[row]);
            scatter(&mut parts.ie, block, |row| in_i[row], |row| in_e[row]);
            scatter(&mut parts.ii, block, |row| in_i[row], |row| in_i[row]);
        }
        parts
    }

    /// `W^T F W = F_EE + S + S^T` with `S = R^T (F_IE + F_II R / 2)`: one large product, and
    /// symmetric to the last digit.
    fn reduce(&self, r: MatRef<'_, f64>) -> Mat<f64> {
        let half = &self.ie + faer::Scale(0.5) * (&self.ii * r);
        let s = r.transpose() * half;
        Mat::from_fn(s.nrows(), s.ncols(), |i, j| self.ee[(i, j)] + (s[(i, j)] + s[(j, i)]))
    }
}

/// Adds the compliance of one block at the places that its rows have in a matrix.
fn scatter(
    matrix: &mut Mat<f64>,
    block: &Compliance,
    to_row: impl Fn(usize) -> Option<usize>,
    to_column: impl Fn(usize) -> Option<usize>,
) {
    for (i, row) in block.rows.iter().enumerate().take(block.f.nrows()) {
        let Some(p) = to_row(*row) else { continue };
        for (j, column) in block.rows.iter().enumerate() {
            if let Some(q) = to_column(*column) {
                matrix[(p, q)] += block.f[(i, j)];
            }
        }
    }
}
