//! The contact problem with all displacements as unknowns: larger than the reduced forms, but sparse.

use faer::sparse::{SparseColMat, Triplet};
use lcp::{Contact2d, ContactState, Residuals};

use super::RowState;
use crate::ids::BlockId;
use crate::model::Model;
use crate::rounding::cleared;
use crate::state::State;
use crate::system::{BodySystem, System, displaced_nodes};

/// A [`System`] as a sparse contact problem in SI units, and back.
#[derive(Debug, Clone)]
pub struct Sparse {
    /// `K u = f + C^T t` (3.2) with the contact law. The displacements are those of the nodes, block by
    /// block; of a rigid block the amplitudes of its three motions. Then, row by row, how far each
    /// film gives way at its points: displacements of its free face against the block, held by the
    /// film's own stiffness `1 / c`, which see the contact force alone, `u = c t`. Strips of mortar
    /// couple their blocks by `L^T D L` in `K`.
    pub problem: Contact2d,
    /// The first displacement of every block, and one past the last.
    starts: Vec<usize>,
}

impl Sparse {
    /// Sets up the problem.
    ///
    /// # Errors
    /// [`lcp::Error::NotFinite`] when the data of the scene overflow.
    pub fn new(system: &System) -> Result<Self, lcp::Error> {
        let mut starts = vec![0];
        for body in &system.bodies {
            starts.push(starts[starts.len() - 1] + unknowns(body));
        }
        let films: Vec<usize> =
            (0..system.rows.len()).filter(|row| system.rows[*row].compliance > 0.0).collect();
        let blocks_end = starts[starts.len() - 1];
        let (n, m) = (blocks_end + films.len(), system.points());
        let point_of = |row: usize| match row.checked_sub(m) {
            None => row,
            Some(position) => system.friction[position].0.index(),
        };
        let (mut k, mut f) = (Vec::new(), Vec::with_capacity(n));
        let (mut c_n, mut c_t) = (Vec::new(), Vec::new());
        let mut stretches = vec![Vec::new(); system.stretches.len()];
        for (body, &start) in system.bodies.iter().zip(&starts) {
            if let Some(stiffness) = body.stiffness.map(|k| &system.stiffnesses[k].matrix) {
                let place = |i: usize| start + i;
                k.extend(
                    stiffness
                        .triplet_iter()
                        .filter(|entry| *entry.val != 0.0)
                        .map(|entry| Triplet::new(place(entry.row), place(entry.col), *entry.val)),
                );
                f.extend(&body.load);
            } else {
                f.extend(body.resultant);
            }
            for stretch in &body.stretches {
                stretches[stretch.row].extend(stretch.entries.iter().map(|&(j, v)| (start + j, v)));
            }
            for row in &body.rows {
                let rows = if row.row < m { &mut c_n } else { &mut c_t };
                let point = point_of(row.row);
                if body.stiffness.is_some() {
                    rows.extend(
                        row.entries.iter().map(|&(j, v)| Triplet::new(point, start + j, v)),
                    );
                } else {
                    let modes = row.modes.iter().enumerate();
                    rows.extend(modes.map(|(j, &v)| Triplet::new(point, start + j, v)));
                }
            }
        }
        for (row, entries) in system.stretches.iter().zip(&stretches) {
            for &(i, v) in entries {
                k.extend(entries.iter().map(|&(j, w)| Triplet::new(i, j, row.stiffness * (v * w))));
            }
        }
        for (position, row) in films.into_iter().enumerate() {
            let gives = blocks_end + position;
            k.push(Triplet::new(gives, gives, 1.0 / system.rows[row].compliance));
            f.push(0.0);
            let rows = if row < m { &mut c_n } else { &mut c_t };
            rows.push(Triplet::new(point_of(row), gives, 1.0));
        }
        let (mut s_0, mut mu) = (vec![0.0; m], vec![0.0; m]);
        for ((point, value), row) in system.friction.iter().zip(&system.rows[m..]) {
            mu[point.index()] = *value;
            s_0[point.index()] = row.offset;
        }
        let x_0 = system.rows[..m].iter().map(|row| row.offset).collect();
        let [k, c_n, c_t] = [(n, k), (m, c_n), (m, c_t)].map(|(rows, entries)| {
            let built = SparseColMat::try_new_from_triplets(rows, n, &entries);
            built.unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}"))
        });
        let problem = Contact2d::new(k, f, c_n, c_t, x_0, s_0, mu)?;
        Ok(Self { problem, starts })
    }

    /// Forces and relative displacements of all rows of the system; relative displacements that are rounding errors of
    /// those of the two sides are zero, as those of contacts that are closed or stick.
    pub fn rows(&self, state: &ContactState) -> RowState {
        let friction = self.problem.frictional();
        let cleared_by = |matrix: &SparseColMat<usize, f64>, values: &[f64]| -> Vec<f64> {
            let mut sizes = vec![0.0_f64; values.len()];
            for entry in matrix.triplet_iter() {
                let term = (entry.val * state.u[entry.col]).abs();
                sizes[entry.row] = sizes[entry.row].max(term);
            }
            values.iter().zip(sizes).map(|(value, size)| cleared(*value, size)).collect()
        };
        let gap = cleared_by(self.problem.normal(), &state.gap);
        let slip = cleared_by(self.problem.tangent(), &state.slip);
        let rows = |normal: &[f64], tangential: &[f64]| {
            normal.iter().copied().chain(friction.iter().map(|&i| tangential[i])).collect()
        };
        RowState { t: rows(&state.t_n, &state.t_t), y: rows(&gap, &slip) }
    }

    /// Displacements and forces of the problem from those of the structure, the way back of
    /// [`recover::from_displacements`](crate::recover::from_displacements).
    ///
    /// # Panics
    /// If the state is that of another model.
    pub fn state(&self, (model, system): (&Model, &System), state: &State) -> ContactState {
        let mut u = Vec::with_capacity(self.problem.displacements());
        for (b, (body, moved)) in system.bodies.iter().zip(&state.displacements).enumerate() {
            if body.stiffness.is_some() {
                u.extend(moved.iter().flat_map(|u| [u.x, u.y]));
            } else {
                u.extend(body.modes.amplitudes(displaced_nodes(model, BlockId::new(b)), moved));
            }
        }
        let t_n: Vec<f64> = state.contacts.iter().map(|contact| contact.t_n).collect();
        let t_t: Vec<f64> = state.contacts.iter().map(|contact| contact.t_t).collect();
        let tangential = system.friction.iter().map(|(id, _)| t_t[id.index()]);
        let forces = t_n.iter().copied().chain(tangential);
        let films = system.rows.iter().zip(forces).filter(|(row, _)| row.compliance > 0.0);
        u.extend(films.map(|(row, t)| row.compliance * t));
        self.problem.state(u, t_n, t_t)
    }

    /// The state on the statuses of the contacts of another one, solved anew with twice the digits; `None` where
    /// that is no solution to this tolerance either.
    pub fn refined(
        &self,
        state: &ContactState,
        tolerance: f64,
    ) -> Option<(ContactState, Residuals)> {
        // States that overflow are not refined.
        let refined = self.problem.verify(state).ok()?.refined.rounded(&self.problem);
        let residuals = self.problem.residuals(&refined);
        (residuals.worst() <= tolerance).then_some((refined, residuals))
    }

    /// The first displacement of every block, and one past the last.
    pub(crate) fn starts(&self) -> &[usize] {
        &self.starts
    }

    /// The displacements of one block: of its nodes, or the amplitudes of its rigid motions.
    ///
    /// # Panics
    /// If there is no such block, or `u` is not one of the displacements of the problem.
    pub fn of_block<'a>(&self, block: usize, u: &'a [f64]) -> &'a [f64] {
        &u[self.starts[block]..self.starts[block + 1]]
    }
}

fn unknowns(body: &BodySystem) -> usize {
    if body.stiffness.is_some() { body.load.len() } else { body.resultant.len() }
}
