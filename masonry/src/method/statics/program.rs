//! The convex programs of admissible forces as complementarity problems.

use faer::sparse::{SparseColMat, Triplet};
use lcp::MixedLcp;

use crate::law::Friction;
use crate::rounding;
use crate::system::{BodySystem, System};

/// What is left of the balance of a block, relative to the largest load, in forces that are called admissible.
const BALANCED: f64 = 1e-9;

/// The forces that contacts may have, and the balance of the blocks.
pub(super) struct Program<'a> {
    system: &'a System,
    /// Of every contact point the first of its edges, and one past the last.
    first: Vec<usize>,
    /// The frictional points with a constant part of friction, and `C_0` of each in units of the largest load.
    constant: Vec<(usize, f64)>,
    /// `E` as rows, columns and values: edges, then for every force `q` of constant friction `q' = C_0 + q` and
    /// `q'' = C_0 - q`, with `q' + q'' = 2 C_0` below the balance of the blocks.
    entries: Vec<(usize, usize, f64)>,
    /// `r`, in units of the largest load; where there is constant friction, with `-C_0` along it.
    loads: Vec<f64>,
    /// The largest load \[N\].
    unit: f64,
    /// Whether the last column of `E` is no force but what a factor adds to the loads.
    grows: bool,
}

impl<'a> Program<'a> {
    /// `growth` is what a factor of one adds to the loads, `N^T f` of all blocks \[N\].
    pub(super) fn growing(system: &'a System, growth: &[f64]) -> Self {
        let mut program = Self::with_unit(system, growth);
        let column = program.columns();
        let unit = program.unit;
        let nonzero = growth.iter().enumerate().filter(|(_, g)| **g != 0.0);
        program.entries.extend(nonzero.map(|(i, g)| (i, column, g / unit)));
        program.grows = true;
        program
    }

    pub(super) fn of(system: &'a System) -> Self {
        Self::with_unit(system, &[])
    }

    /// In units of the largest load, these among them.
    fn with_unit(system: &'a System, more: &[f64]) -> Self {
        let mut edges = vec![1; system.points()];
        for friction in system.friction.iter().filter(|friction| friction.mu > 0.0) {
            edges[friction.contact.index()] = 2;
        }
        let mut first = vec![0];
        first.extend(edges.iter().scan(0, |sum, edges| {
            *sum += edges;
            Some(*sum)
        }));
        let resultants = system.resultants();
        let largest = rounding::largest(resultants.iter().chain(more));
        let unit = if largest > 0.0 { largest } else { 1.0 };
        let loads = resultants.iter().map(|f| f / unit).collect();
        let with_base = system.friction.iter().enumerate().filter(|(_, it)| it.base > 0.0);
        let constant = with_base.map(|(k, it)| (k, it.base / unit)).collect();
        let entries = Vec::new();
        let mut program = Self { system, first, constant, entries, loads, unit, grows: false };
        for (b, body) in system.bodies.iter().enumerate() {
            program.add(b, body);
        }
        for (place, (_, base)) in program.constant.iter().enumerate() {
            let (row, column) = (program.loads.len(), program.edges() + 2 * place);
            program.entries.extend([(row, column, 1.0), (row, column + 1, 1.0)]);
            program.loads.push(-2.0 * base);
        }
        program
    }

    fn add(&mut self, b: usize, body: &BodySystem) {
        let points = self.system.points();
        for row in &body.rows {
            let modes = || row.modes.iter().enumerate().filter(|(_, value)| **value != 0.0);
            // The normal force of one along both edges, the friction along each in its own direction.
            let (point, factors) = match row.row.checked_sub(points) {
                None => (row.row, [self.parts(row.row)[0]; 2]),
                Some(k) => {
                    if let Ok(place) = self.constant.binary_search_by_key(&k, |it| it.0) {
                        let (column, base) = (self.edges() + 2 * place, self.constant[place].1);
                        for (j, value) in modes() {
                            self.entries.push((3 * b + j, column, *value));
                            self.loads[3 * b + j] -= base * value;
                        }
                    }
                    let Friction { contact, mu, .. } = self.system.friction[k];
                    if mu <= 0.0 {
                        continue;
                    }
                    let [_, friction] = self.parts(contact.index());
                    (contact.index(), [friction, -friction])
                }
            };
            for (edge, factor) in (self.first[point]..self.first[point + 1]).zip(factors) {
                self.entries.extend(modes().map(|(j, value)| (3 * b + j, edge, factor * value)));
            }
        }
    }

    /// The normal and the tangential part of a force of one along an edge of the cone of a point.
    fn parts(&self, point: usize) -> [f64; 2] {
        let found = self.system.friction.binary_search_by_key(&point, |it| it.contact.index());
        let mu = found.map_or(0.0, |k| self.system.friction[k].mu);
        let length = mu.hypot(1.0);
        [1.0 / length, mu / length]
    }

    /// What each force along a column adds to a linear function of the forces of all rows.
    pub(super) fn gain(&self, of_rows: &[f64]) -> Vec<(usize, f64)> {
        let (normals, tangents) = of_rows.split_at(self.system.points());
        let mut gain = Vec::new();
        for (point, normal) in normals.iter().enumerate() {
            let [along, _] = self.parts(point);
            gain.extend((self.first[point]..self.first[point + 1]).map(|k| (k, along * normal)));
        }
        for (friction, tangent) in self.system.friction.iter().zip(tangents) {
            if friction.mu > 0.0 {
                let point = friction.contact.index();
                let (edge, [_, across]) = (self.first[point], self.parts(point));
                gain[edge].1 += across * tangent;
                gain[edge + 1].1 -= across * tangent;
            }
        }
        let constant = self.constant.iter().enumerate();
        gain.extend(constant.map(|(place, (k, _))| (self.edges() + 2 * place, tangents[*k])));
        gain
    }

    /// What no forces can exceed of a gain, by a motion `x` with `E^T x >= gain` \[N\].
    pub(super) fn bound(&self, motion: &[f64], gain: &[(usize, f64)]) -> f64 {
        let (blocks, motion) = self.of_blocks(motion);
        let mut pushed = vec![0.0; self.forces()];
        for &(i, k, v) in self.entries.iter().filter(|(i, ..)| *i < blocks) {
            pushed[k] += v * motion[i];
        }
        let mut beyond = pushed.clone();
        for (k, gain) in gain {
            beyond[*k] -= gain;
        }
        let work: f64 = self.loads.iter().zip(motion).map(|(r, x)| r * x).sum();
        // The loads have `-C_0` along each force of constant friction.
        let pairs = self.constant.iter().enumerate();
        let pairs = pairs.map(|(place, (_, base))| (self.edges() + 2 * place, base));
        let constant: f64 = pairs.map(|(k, base)| base * (beyond[k].abs() - pushed[k])).sum();
        self.unit * (constant - work)
    }

    /// The number of balances of blocks, and of a motion the part that moves these.
    fn of_blocks<'b>(&self, motion: &'b [f64]) -> (usize, &'b [f64]) {
        let blocks = 3 * self.system.bodies.len();
        (blocks, &motion[..blocks])
    }

    /// The forces along edges that balance one another and gain one: any number of times them can be added to others.
    pub(super) fn circulating(mut self, gain: &[(usize, f64)]) -> Self {
        let (edges, row) = (self.edges(), 3 * self.system.bodies.len());
        self.constant.clear();
        self.entries.retain(|(_, k, _)| *k < edges);
        let of_edges = gain.iter().filter(|(k, gain)| *k < edges && *gain != 0.0);
        self.entries.extend(of_edges.map(|(k, gain)| (row, *k, *gain)));
        self.loads = vec![0.0; row];
        self.loads.push(-1.0);
        self
    }

    /// No load acts.
    pub(super) fn is_unloaded(&self) -> bool {
        self.loads[..3 * self.system.bodies.len()].iter().all(|load| load.abs() <= 0.0)
    }

    /// The largest load \[N\].
    pub(super) fn unit(&self) -> f64 {
        self.unit
    }

    /// Rigid amplitudes of all blocks, and a multiplier of every bound of constant friction.
    pub(super) fn unknowns(&self) -> usize {
        self.loads.len()
    }

    /// Columns that are forces along the edges of cones.
    pub(super) fn edges(&self) -> usize {
        self.first[self.first.len() - 1]
    }

    /// Columns of `E` that are forces: along edges, and the pairs of constant friction.
    pub(super) fn forces(&self) -> usize {
        self.edges() + 2 * self.constant.len()
    }

    /// Of `E`: the forces, and the factor of the loads that grow.
    pub(super) fn columns(&self) -> usize {
        self.forces() + usize::from(self.grows)
    }

    pub(super) fn entries(&self) -> &[(usize, usize, f64)] {
        &self.entries
    }

    /// The entries of the first columns.
    pub(super) fn entries_of(&self, columns: usize) -> Vec<(usize, usize, f64)> {
        self.entries.iter().filter(|(_, k, _)| *k < columns).copied().collect()
    }

    /// The factor under which what grows is as large as the loads that stay.
    pub(super) fn size_of_factor(&self) -> f64 {
        let growth = self.entries.iter().filter(|(_, k, _)| *k >= self.forces()).map(|(.., g)| g);
        rounding::largest(&self.system.resultants()) / self.unit / rounding::largest(growth)
    }

    /// `E p + r = 0` and `0 <= p _|_ p + E^T x >= 0`.
    pub(super) fn least_forces(&self) -> Result<MixedLcp, lcp::Error> {
        let n = self.unknowns();
        let ones: Vec<_> = (n..n + self.columns()).map(|i| Triplet::new(i, i, 1.0)).collect();
        self.mixed(&ones, &[])
    }

    /// `max gain . p` subject to `E p + r = 0`, `p >= 0`: a linear program, whose multipliers are a motion `x` with
    /// `E^T x >= gain`.
    pub(super) fn greatest(&self, gain: &[(usize, f64)]) -> Result<MixedLcp, lcp::Error> {
        self.mixed(&[], gain)
    }

    fn mixed(
        &self,
        symmetric: &[Triplet<usize, usize, f64>],
        gain: &[(usize, f64)],
    ) -> Result<MixedLcp, lcp::Error> {
        let n = self.unknowns();
        let order = n + self.columns();
        let mut q: Vec<f64> = self.loads.iter().map(|r| -r).collect();
        q.resize(order, 0.0);
        for (k, gain) in gain {
            q[n + k] -= gain;
        }
        let skew = self
            .entries
            .iter()
            .flat_map(|&(i, k, v)| [Triplet::new(i, n + k, -v), Triplet::new(n + k, i, v)]);
        let triplets: Vec<_> = skew.chain(symmetric.iter().copied()).collect();
        let m = SparseColMat::try_new_from_triplets(order, order, &triplets)
            .unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}"));
        MixedLcp::new(m, q, (0..order).map(|j| j < n).collect())
    }

    /// The forces of all rows \[N\], if those in `z` balance the loads.
    pub(super) fn admissible(&self, z: &[f64]) -> Option<Vec<f64>> {
        let p: Vec<f64> = z[self.unknowns()..].iter().map(|p| p.max(0.0)).collect();
        let mut rest = self.loads.clone();
        self.entries.iter().for_each(|&(i, k, v)| rest[i] += v * p[k]);
        let is_balanced = rest.iter().all(|rest| rest.abs() <= BALANCED);
        is_balanced.then(|| self.of_rows(&p))
    }

    /// The forces of all rows \[N\].
    fn of_rows(&self, p: &[f64]) -> Vec<f64> {
        let points = self.system.points();
        let mut forces = vec![0.0; self.system.rows.len()];
        for point in 0..points {
            let along: f64 = p[self.first[point]..self.first[point + 1]].iter().sum();
            forces[point] = self.unit * along * self.parts(point)[0];
        }
        for (k, friction) in self.system.friction.iter().enumerate() {
            let point = friction.contact.index();
            if friction.mu > 0.0 {
                let edge = self.first[point];
                forces[points + k] = self.unit * self.parts(point)[1] * (p[edge] - p[edge + 1]);
            }
        }
        for ((k, base), q) in
            self.constant.iter().zip(p[self.edges()..self.forces()].chunks_exact(2))
        {
            forces[points + k] += self.unit * (q[0] - base).clamp(-base, *base);
        }
        forces
    }
}
