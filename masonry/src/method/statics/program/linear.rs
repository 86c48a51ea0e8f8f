//! Linear programs of admissible forces: the largest value of a linear function of these forces, or the largest load
//! factor.

use faer::sparse::{SparseColMat, Triplet};
use lcp::MixedLcp;

use super::Program;
use crate::columns::{ColumnMatrix, column};

impl Program<'_> {
    /// Converts a linear function of the forces of all rows, given by its coefficients, to one of the forces of the
    /// columns of `E`.
    pub(in crate::method::statics) fn gain(&self, of_rows: &[f64]) -> Vec<(usize, f64)> {
        let (normals, tangents) = of_rows.split_at(self.system.points());
        let mut of_points: Vec<[f64; 2]> = normals.iter().map(|normal| [*normal, 0.0]).collect();
        for (friction, tangent) in self.system.friction.iter().zip(tangents) {
            of_points[friction.contact.index()][1] = *tangent;
        }
        let edges = self.cones.iter().zip(of_points).flat_map(|(cone, [normal, tangent])| {
            cone.edges().map(move |edge| edge.normal * normal + edge.tangential * tangent)
        });
        let mut gain: Vec<(usize, f64)> = edges.enumerate().collect();
        let constant = self.constant.iter().enumerate();
        gain.extend(constant.map(|(place, (k, _))| (self.edges() + 2 * place, tangents[*k])));
        gain
    }

    /// Sets up `max gain . p` subject to `E p + r = 0`, `p >= 0`. The multipliers are a motion `x` with
    /// `E^T x >= gain`.
    pub(in crate::method::statics) fn greatest(
        &self,
        gain: &[(usize, f64)],
    ) -> Result<MixedLcp, lcp::Error> {
        let n = self.unknowns();
        let order = n + self.e.ncols();
        let mut q: Vec<f64> = self.loads.iter().map(|r| -r).collect();
        q.resize(order, 0.0);
        for (k, gain) in gain {
            q[n + k] -= gain;
        }
        let entries = self.e.triplet_iter().filter(|entry| *entry.val != 0.0);
        let skew = entries.flat_map(|entry| {
            let (i, k) = (entry.row, n + entry.col);
            [Triplet::new(i, k, -entry.val), Triplet::new(k, i, *entry.val)]
        });
        let m = SparseColMat::try_new_from_triplets(order, order, &skew.collect::<Vec<_>>())
            .unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}"));
        MixedLcp::new(m, q, (0..order).map(|j| j < n).collect())
    }

    /// Computes the bound \[N\] of `gain . p` over all admissible forces that a motion `x` with `E^T x >= gain` proves.
    pub(in crate::method::statics) fn bound(&self, motion: &[f64], gain: &[(usize, f64)]) -> f64 {
        let motion = &motion[..self.balances()];
        let work: f64 = self.loads.iter().zip(motion).map(|(r, x)| r * x).sum();
        // The loads contain `-C_0` along each force of constant friction.
        let pairs =
            self.constant.iter().zip(&gain[self.edges()..]).map(|((_, base), (k, gain))| {
                let on_blocks = column(self.e.as_ref(), *k).filter(|(i, _)| *i < motion.len());
                let pushed: f64 = on_blocks.map(|(i, v)| v * motion[i]).sum();
                base * ((pushed - gain).abs() - pushed)
            });
        self.unit * (pairs.sum::<f64>() - work)
    }

    /// Sets up the program of forces along edges that balance one another and have a gain of one: any multiple of such
    /// forces can be added to admissible forces.
    pub(in crate::method::statics) fn circulating(mut self, gain: &[(usize, f64)]) -> Self {
        let row = self.balances();
        let mut columns = ColumnMatrix::default();
        for &(k, gain) in &gain[..self.edges()] {
            let gained = (gain != 0.0).then_some((row, gain));
            columns.push(column(self.e.as_ref(), k).chain(gained));
        }
        self.constant.clear();
        self.e = columns.assembled(row + 1);
        self.loads = vec![0.0; row];
        self.loads.push(-1.0);
        self
    }
}
