//! The sparse form of the contact problem, with all displacements as unknowns: larger than the reduced forms.

use faer::sparse::{SparseColMat, Triplet};
use lcp::refine::ContactStatus;
use lcp::{Contact2d, ContactState, Residuals, WarmStart};

use crate::data::state::{RowState, State};
use crate::ids::BlockId;
use crate::model::Model;
use crate::rounding::cleared;
use crate::system::{BodySystem, System, displaced_nodes};

/// A [`System`] as a sparse contact problem in SI units, with conversions in both directions.
#[derive(Debug, Clone)]
pub struct Sparse {
    /// The contact problem: equilibrium `K u = f + C^T t` (3.2) with the contact law. The displacements `u` are those
    /// of the nodes, block by block, or the amplitudes of the three motions of a rigid block. The stiffness of joints
    /// and films is in the compliance of their points. Strips of mortar couple their blocks by `L^T D L` in `K`.
    ///
    /// The next displacements are deformations of tangential rows in which both friction and cohesion act, because the
    /// two points of such a row have one deformation: displacements of the free face relative to the block, with the
    /// stiffness `1 / c`, on which only the contact force acts, `u = c t`. The points and displacements of cohesion
    /// come last.
    pub problem: Contact2d,
    /// The index of the first displacement of every block, and the number of displacements of all blocks.
    starts: Vec<usize>,
    /// The points that carry the force of each tangential row of the system.
    carriers: Vec<Carriers>,
    /// The rows of the system whose deformations are displacements of the problem.
    free_faces: Vec<usize>,
}

/// The points of the problem that share the force of a tangential row. The bound of this force, `|t_t| <= mu t_n + C_0`,
/// is the sum of a part that friction carries and a constant part that does not depend on the normal force.
///
/// The constant part is carried by an extra point with the same slip and a friction coefficient of one. A force `C_0`
/// presses this point. It is the load on an additional displacement, which this point alone holds at zero.
#[derive(Debug, Clone, Copy)]
struct Carriers {
    friction: Option<usize>,
    constant: Option<usize>,
}

impl Carriers {
    fn are_two(self) -> bool {
        self.friction.is_some() && self.constant.is_some()
    }

    fn points(self) -> impl Iterator<Item = usize> {
        self.friction.into_iter().chain(self.constant)
    }

    /// Returns the sum of the values in `of` at the points that carry the force.
    fn sum(self, of: &[f64]) -> f64 {
        self.points().map(|point| of[point]).sum()
    }
}

impl Sparse {
    /// Sets up the sparse problem of a system.
    ///
    /// # Errors
    /// [`lcp::Error::NotFinite`] when the data of the scene overflow.
    pub fn new(system: &System) -> Result<Self, lcp::Error> {
        Self::of(system, Carriers::are_two)
    }

    /// Sets up the sparse problem of a system for methods that do not admit compliances of contacts: the deformations
    /// of all compliant rows become displacements.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_free_faces(system: &System) -> Result<Self, lcp::Error> {
        Self::of(system, |_| true)
    }

    /// Sets up the problem; the deformations of a row become displacements if `is_free` is true for the carriers of
    /// this row.
    fn of(system: &System, is_free: impl Fn(Carriers) -> bool) -> Result<Self, lcp::Error> {
        let mut starts = vec![0];
        for body in &system.bodies {
            starts.push(starts[starts.len() - 1] + unknowns(body));
        }
        let m = system.points();
        let mut constant = Vec::new();
        let mut carriers = Vec::with_capacity(system.friction.len());
        for friction in &system.friction {
            let cap = friction.cone.cap();
            carriers.push(Carriers {
                friction: (friction.cone.mu > 0.0).then_some(friction.contact.index()),
                constant: cap.map(|_| m + constant.len()),
            });
            constant.extend(cap);
        }
        let points_of = |row: usize| match row.checked_sub(m) {
            None => Carriers { friction: Some(row), constant: None },
            Some(position) => carriers[position],
        };
        let free_faces: Vec<usize> = (0..system.rows.len())
            .filter(|row| system.rows[*row].compliance > 0.0 && is_free(points_of(*row)))
            .collect();
        let blocks_end = starts[starts.len() - 1];
        let faces_end = blocks_end + free_faces.len();
        let (n, all_points) = (faces_end + constant.len(), m + constant.len());
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
                for point in points_of(row.row).points() {
                    if body.stiffness.is_some() {
                        let entries = row.entries.iter();
                        rows.extend(entries.map(|&(j, v)| Triplet::new(point, start + j, v)));
                    } else {
                        let modes = row.modes.iter().enumerate();
                        rows.extend(modes.map(|(j, &v)| Triplet::new(point, start + j, v)));
                    }
                }
            }
        }
        for (row, entries) in system.stretches.iter().zip(&stretches) {
            for &(i, v) in entries {
                k.extend(entries.iter().map(|&(j, w)| Triplet::new(i, j, row.stiffness * (v * w))));
            }
        }
        let mut compliance = vec![[0.0; 2]; all_points];
        for (row, of) in system.rows.iter().enumerate() {
            let at = points_of(row);
            if !is_free(at) {
                let direction = usize::from(row >= m);
                at.points().for_each(|point| compliance[point][direction] = of.compliance);
            }
        }
        for (position, &row) in free_faces.iter().enumerate() {
            let gives = blocks_end + position;
            k.push(Triplet::new(gives, gives, 1.0 / system.rows[row].compliance));
            f.push(0.0);
            let rows = if row < m { &mut c_n } else { &mut c_t };
            rows.extend(points_of(row).points().map(|point| Triplet::new(point, gives, 1.0)));
        }
        k.extend(pressing(&k, &c_t, m, faces_end));
        c_n.extend((0..constant.len()).map(|i| Triplet::new(m + i, faces_end + i, 1.0)));
        f.extend(constant.iter().map(|base| -base));
        let (mut s_0, mut mu) = (vec![0.0; all_points], vec![0.0; all_points]);
        for ((friction, row), carriers) in
            system.friction.iter().zip(&system.rows[m..]).zip(&carriers)
        {
            carriers.points().for_each(|point| s_0[point] = row.offset);
            mu[friction.contact.index()] = friction.cone.mu;
        }
        mu[m..].fill(1.0);
        let mut x_0: Vec<f64> = system.rows[..m].iter().map(|row| row.offset).collect();
        x_0.resize(all_points, 0.0);
        let [k, c_n, c_t] =
            [(n, k), (all_points, c_n), (all_points, c_t)].map(|(rows, entries)| {
                let built = SparseColMat::try_new_from_triplets(rows, n, &entries);
                built.unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}"))
            });
        let problem = Contact2d::new(k, f, c_n, c_t, x_0, s_0, mu)?.with_compliance(compliance)?;
        Ok(Self { problem, starts, carriers, free_faces })
    }

    /// Returns forces and relative displacements of all rows of the system. A relative displacement is set to zero if
    /// it is only a rounding error of the displacements of both sides, as at contacts that are closed or stick.
    pub fn rows(&self, state: &ContactState) -> RowState {
        let cleared_by = |matrix: &SparseColMat<usize, f64>, direction: usize, values: &[f64]| {
            let forces = [&state.t_n, &state.t_t][direction];
            let give = self.problem.compliance().iter().zip(forces);
            let mut sizes: Vec<f64> =
                give.map(|(compliance, t)| (compliance[direction] * t).abs()).collect();
            for entry in matrix.triplet_iter() {
                let term = (entry.val * state.u[entry.col]).abs();
                sizes[entry.row] = sizes[entry.row].max(term);
            }
            let values = values.iter().zip(sizes);
            values.map(|(value, size)| cleared(*value, size)).collect::<Vec<_>>()
        };
        let gap = cleared_by(self.problem.normal(), 0, &state.gap);
        let slip = cleared_by(self.problem.tangent(), 1, &state.slip);
        let points = self.points();
        let friction = self.carriers.iter();
        let tangential = friction.clone().map(|carriers| carriers.sum(&state.t_t));
        let t = state.t_n[..points].iter().copied().chain(tangential).collect();
        let y = gap[..points].iter().copied().chain(self.by_rows(&slip)).collect();
        RowState { t, y }
    }

    /// Returns the slips of the tangential rows of the system from those of the points of the problem; all points of a
    /// row have the same slip.
    pub(crate) fn by_rows(&self, slips: &[f64]) -> Vec<f64> {
        let first = |carriers: &Carriers| carriers.points().next().map(|i| slips[i]);
        self.carriers.iter().filter_map(first).collect()
    }

    /// Converts displacements and forces of the structure to those of the problem: the inverse of
    /// [`recover::from_displacements`](crate::recover::from_displacements).
    ///
    /// # Panics
    /// If the state is that of another model.
    pub fn state(&self, model: &Model, system: &System, state: &State) -> ContactState {
        let mut u = Vec::with_capacity(self.problem.displacements());
        for (b, (body, moved)) in system.bodies.iter().zip(&state.displacements).enumerate() {
            if body.stiffness.is_some() {
                u.extend(moved.iter().flat_map(|u| [u.x, u.y]));
            } else {
                u.extend(body.modes.amplitudes(displaced_nodes(model, BlockId::new(b)), moved));
            }
        }
        let (normal, tangential) = system.rows.split_at(system.points());
        let contacts = &state.contacts;
        let normal: Vec<f64> =
            normal.iter().map(|row| contacts[row.contact.index()].t_n + row.tension).collect();
        let tangential: Vec<f64> =
            tangential.iter().map(|row| contacts[row.contact.index()].t_t).collect();
        self.with_forces(system, u, &normal, &tangential)
    }

    /// Returns the state with the displacements `u`, of the blocks alone or of the whole problem, and with the forces
    /// of the normal and tangential rows of the system.
    pub(crate) fn with_forces(
        &self,
        system: &System,
        mut u: Vec<f64>,
        normal: &[f64],
        tangential: &[f64],
    ) -> ContactState {
        let (n, m) = (self.problem.displacements(), self.problem.points());
        if u.len() < n {
            let forces = normal.iter().chain(tangential).zip(&system.rows);
            let given: Vec<f64> = forces.map(|(t, row)| row.compliance * t).collect();
            u.extend(self.free_faces.iter().map(|&row| given[row]));
            u.resize(n, 0.0);
        }
        let (mut t_n, mut t_t) = (normal.to_vec(), vec![0.0; m]);
        t_n.resize(m, 0.0);
        for ((friction, force), carriers) in
            system.friction.iter().zip(tangential).zip(&self.carriers)
        {
            let point = friction.contact.index();
            let [by_friction, constant] = friction.cone.shares(normal[point], *force);
            match carriers.constant {
                Some(other) => (t_n[other], t_t[other]) = (friction.cone.base, constant),
                None => t_t[point] = *force,
            }
            if carriers.are_two() {
                t_t[point] = by_friction;
            }
        }
        self.problem.state(u, t_n, t_t)
    }

    /// Returns a warm start with the contact states that belong to given forces of the rows: points without a normal
    /// force are open, and points with forces on the edge of the friction cone slide.
    pub(crate) fn start_of(&self, system: &System, forces: &[f64]) -> WarmStart {
        let (normal, tangential) = forces.split_at(system.points());
        let rest = vec![0.0; self.problem.displacements()];
        let state = self.with_forces(system, rest, normal, tangential);
        let points = state.t_n.iter().zip(&state.t_t).zip(self.problem.mu());
        let statuses = points.map(|((t_n, t_t), mu)| match cleared(mu * t_n - t_t.abs(), *t_n) {
            _ if *t_n <= 0.0 => ContactStatus::Open,
            below if below > 0.0 => ContactStatus::Stick,
            _ if *t_t < 0.0 => ContactStatus::Forwards,
            _ => ContactStatus::Backwards,
        });
        self.problem.start_of(&statuses.collect::<Vec<_>>())
    }

    /// Returns the number of contact points of the structure, which come before those of cohesion in the problem.
    pub(crate) fn points(&self) -> usize {
        let of_cohesion = self.carriers.iter().filter(|it| it.constant.is_some()).count();
        self.problem.points() - of_cohesion
    }

    /// Solves the equations of the contact states of `state` again, with twice as many digits; `None` if the result is
    /// not a solution to this tolerance.
    pub fn refined(
        &self,
        state: &ContactState,
        tolerance: f64,
    ) -> Option<(ContactState, Residuals)> {
        // A state whose numbers overflow is not refined.
        let refined = self.problem.verify(state).ok()?.refined.rounded(&self.problem);
        let residuals = self.problem.residuals(&refined);
        (residuals.worst() <= tolerance).then_some((refined, residuals))
    }

    /// Returns the index of the first displacement of every block, and the number of displacements of all blocks.
    pub(crate) fn starts(&self) -> &[usize] {
        &self.starts
    }

    /// Returns the displacements of one block: those of its nodes, or the amplitudes of its rigid motions.
    ///
    /// # Panics
    /// If there is no such block, or `u` does not have all displacements of the problem.
    pub fn of_block<'a>(&self, block: usize, u: &'a [f64]) -> &'a [f64] {
        &u[self.starts[block]..self.starts[block + 1]]
    }
}

/// Returns the stiffnesses on the displacements of cohesion; `point` and `displacement` are the first ones of cohesion.
/// The points hold these displacements at zero without any stiffness, but methods that begin with open contacts need
/// one: it is as large as the stiffness of the parts that slide at the point.
fn pressing(
    k: &[Triplet<usize, usize, f64>],
    c_t: &[Triplet<usize, usize, f64>],
    point: usize,
    displacement: usize,
) -> Vec<Triplet<usize, usize, f64>> {
    let mut diagonal = vec![0.0; displacement];
    for entry in k.iter().filter(|entry| entry.row == entry.col) {
        diagonal[entry.row] += entry.val;
    }
    let mut stiffness: std::collections::BTreeMap<usize, f64> = std::collections::BTreeMap::new();
    for entry in c_t.iter().filter(|entry| entry.row >= point) {
        let largest = stiffness.entry(entry.row - point).or_default();
        *largest = largest.max(diagonal[entry.col]);
    }
    let stiff = stiffness.into_iter().filter(|(_, k)| *k > 0.0);
    stiff.map(|(i, k)| Triplet::new(displacement + i, displacement + i, k)).collect()
}

fn unknowns(body: &BodySystem) -> usize {
    if body.stiffness.is_some() { body.load.len() } else { body.resultant.len() }
}
