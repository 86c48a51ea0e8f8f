//! The contact problem in units of its own.

use faer::sparse::SparseColMat;
use lcp_linalg::Columns;

use super::points::{Point, Points};
use crate::matrix::add_image;
use crate::parts::Parts;
use crate::problem::{column_factors, column_of, diagonal, median};
use crate::scaling::{multiply, power_of_two};
use crate::vector::max_abs;
use crate::{Contact2d, ContactState, MixedLcp};

/// A contact problem whose stiffness, forces and gaps are of order one whatever the units: with the
/// displacements `u = length * column * u'`, forces `t = force * t'`, gaps and slips `y = length * y'`, compliances
/// `a = length / force * a'`.
pub(crate) struct Scaled {
    /// Stiffness, columns of `(row, value)` one after the other.
    pub(crate) k: SparseColMat<usize, f64>,
    pub(crate) f: Vec<f64>,
    pub(crate) points: Points,
    column: Vec<f64>,
    force: f64,
    length: f64,
    /// Displacements that are zero and points without force, see [`idle`].
    idle: Option<(Vec<bool>, Vec<bool>)>,
}

impl Scaled {
    pub(crate) fn of_contact(problem: &Contact2d) -> Self {
        let n = problem.displacements();
        let column = column_factors(problem);
        let diagonal = diagonal(problem.stiffness());
        let stiff = (0..n).map(|j| diagonal[j] * column[j] * column[j]).filter(|k| *k > 0.0);
        let mut stiff: Vec<f64> = stiff.chain(problem.springs()).collect();
        let load = (0..n).fold(0.0_f64, |max, j| max.max((problem.loads()[j] * column[j]).abs()));
        let gap = max_abs(problem.initial_gaps()).max(max_abs(problem.initial_slips()));
        let stiffness = median(&mut stiff);
        // Only gaps move anything without loads; only gaps have a length without stiffness.
        let (force, length) = match stiffness {
            Some(k) if load > 0.0 => (load, load / k),
            Some(k) if gap > 0.0 => (gap * k, gap),
            Some(k) => (k, 1.0),
            None => (if load > 0.0 { load } else { 1.0 }, if gap > 0.0 { gap } else { 1.0 }),
        };
        let (force, length) = (power_of_two(force), power_of_two(length));
        let mut k = problem.stiffness().clone();
        multiply(&mut k, |i, j| column[i] * column[j] * (length / force));
        let f: Vec<f64> = problem.loads().iter().zip(&column).map(|(f, d)| f * d / force).collect();
        let lengths = |v: &[f64]| v.iter().map(|v| v / length).collect();
        let (x_0, s_0) = (lengths(problem.initial_gaps()), lengths(problem.initial_slips()));
        let mut points = Points::new(x_0, s_0, problem.mu().to_vec());
        let all = points.compliance.iter_mut().zip(problem.compliance()).zip(problem.mu());
        for ((scaled, [normal, tangential]), mu) in all {
            let carried = [*normal, if *mu > 0.0 { *tangential } else { 0.0 }];
            *scaled = carried.map(|a| a * (force / length));
        }
        let [normal, tangent] = [problem.normal(), problem.tangent()].map(|c| {
            let columns = (0..n).flat_map(|j| column_of(c, j).map(move |(i, v)| (i, j, v)));
            Columns::by_rows(points.len(), columns)
        });
        for i in 0..points.len() {
            let mu = points.mu[i];
            let frictional = tangent.entries(i).filter(|_| mu > 0.0);
            let frictional = frictional.map(|(j, v)| (j, [0.0, v]));
            let both = normal.entries(i).map(|(j, v)| (j, [v, 0.0])).chain(frictional);
            let mut both: Vec<(usize, [f64; 2])> = both.collect();
            both.sort_by_key(|(j, _)| *j);
            for entries in both.chunk_by(|a, b| a.0 == b.0) {
                let j = entries[0].0;
                let sum = |k: usize| entries.iter().fold(0.0, |sum, (_, v)| sum + v[k]);
                points.push(j, [0, 1].map(|k| sum(k) * column[j]));
            }
            points.close();
        }
        let idle = idle(&k, &f, &points, &vec![false; n]);
        Self { k, f, points, column, force, length, idle }
    }

    /// A mixed problem as a contact problem without friction: stiffness `M`, loads `-q`, and a contact for every
    /// bounded variable, which is the gap.
    pub(crate) fn of_mixed(problem: &MixedLcp) -> Self {
        let mut m = problem.m().clone().into_sparse();
        let n = problem.order();
        let diagonal = diagonal(&m);
        let mut largest: Vec<f64> = diagonal.iter().map(|v| v.abs()).collect();
        // The other entries serve for a column without a diagonal entry.
        for j in 0..n {
            for (i, v) in column_of(&m, j) {
                for k in [i, j].into_iter().filter(|&k| diagonal[k] == 0.0) {
                    largest[k] = largest[k].max(v.abs());
                }
            }
        }
        // One stiffness is used for all, so that the unit of `M` does not change the scaled problem.
        let stiffness = power_of_two(max_abs(&largest).max(f64::MIN_POSITIVE));
        let factor = |v: &f64| if *v > 0.0 { power_of_two((stiffness / v).sqrt()) } else { 1.0 };
        let column: Vec<f64> = largest.iter().map(factor).collect();
        let load =
            problem.q().iter().zip(&column).fold(0.0_f64, |max, (q, d)| max.max((q * d).abs()));
        let force = if load > 0.0 { power_of_two(load) } else { 1.0 };
        multiply(&mut m, |i, j| column[i] * column[j] / stiffness);
        let f: Vec<f64> = problem.q().iter().zip(&column).map(|(q, d)| -q * d / force).collect();
        let bounded: Vec<usize> = (0..n).filter(|&j| !problem.free()[j]).collect();
        let zero = || vec![0.0; bounded.len()];
        let mut points = Points::new(zero(), zero(), zero());
        for &j in &bounded {
            points.push(j, [1.0, 0.0]);
            points.close();
        }
        let moves_nothing = |j: usize| column_of(&m, j).all(|(_, v)| v == 0.0);
        let moves_nothing: Vec<bool> = (0..n).map(moves_nothing).collect();
        let idle = idle(&m, &f, &points, &moves_nothing);
        Self { k: m, f, points, column, force, length: force / stiffness, idle }
    }

    /// The unit of contact forces.
    pub(crate) fn force(&self) -> f64 {
        self.force
    }

    /// The unit of the force on a displacement.
    pub(crate) fn force_of(&self, j: usize) -> f64 {
        self.force / self.column[j]
    }

    /// Displacements in the units of the original problem.
    pub(crate) fn displacements(&self, u: &[f64]) -> Vec<f64> {
        u.iter().zip(&self.column).map(|(u, d)| u * d * self.length).collect()
    }

    /// Displacements in the units of this problem.
    pub(crate) fn of_displacements(&self, u: &[f64]) -> Vec<f64> {
        u.iter().zip(&self.column).map(|(u, d)| u / d / self.length).collect()
    }

    /// Normal and tangential forces of the points from their forces along the edges of their cones.
    pub(crate) fn of_edges(&self, mut parts: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
        let mut part = || parts.next().unwrap_or(0.0);
        let force = |mu: &f64| {
            let (plus, minus) = (part(), if *mu > 0.0 { part() } else { 0.0 });
            (plus + minus, mu * (plus - minus))
        };
        self.points.mu.iter().map(force).collect()
    }

    /// The edges of the friction cones: their points, and the tangential force for a normal force of one.
    pub(crate) fn edges(&self) -> impl Iterator<Item = (Point<'_>, f64)> {
        self.points.iter().flat_map(Point::edges)
    }

    /// Displacements and forces in the units of this problem.
    pub(crate) fn of_state(&self, state: &ContactState) -> (Vec<f64>, Vec<(f64, f64)>) {
        let forces =
            state.t_n.iter().zip(&state.t_t).map(|(n, t)| (n / self.force, t / self.force));
        (self.of_displacements(&state.u), forces.collect())
    }

    /// Sets the [`idle`] displacements and forces to zero.
    pub(crate) fn settle(&self, u: &mut [f64], forces: &mut [(f64, f64)]) {
        if let Some((at_rest, without_force)) = &self.idle {
            u.iter_mut().zip(at_rest).filter(|(_, is)| **is).for_each(|(u, _)| *u = 0.0);
            let idle = forces.iter_mut().zip(without_force).filter(|(_, is)| **is);
            idle.for_each(|(forces, _)| *forces = (0.0, 0.0));
        }
    }

    /// Number of displacements.
    pub(crate) fn order(&self) -> usize {
        self.f.len()
    }

    /// The unbalanced forces: `f + C^T t - K u`.
    pub(crate) fn unbalanced(
        &self,
        u: &[f64],
        forces: impl Iterator<Item = (f64, f64)>,
    ) -> Vec<f64> {
        let mut rest = self.f.clone();
        add_image(&self.k, -1.0, u, &mut rest);
        for (point, (t_n, t_t)) in self.points.iter().zip(forces) {
            point.add_forces(t_n, t_t, &mut rest);
        }
        rest
    }

    /// Sums of the sizes of the terms of equilibrium.
    pub(crate) fn terms(&self, u: &[f64], forces: &[(f64, f64)]) -> Vec<f64> {
        let mut terms: Vec<f64> = self.f.iter().map(|f| f.abs()).collect();
        for (j, u) in u.iter().enumerate() {
            column_of(&self.k, j).for_each(|(i, v)| terms[i] += (v * u).abs());
        }
        for (point, (t_n, t_t)) in self.points.iter().zip(forces) {
            for (&j, [n, t]) in point.columns.iter().zip(point.coefficients) {
                terms[j] += (n * t_n).abs() + (t * t_t).abs();
            }
        }
        terms
    }
}

/// The displacements that are zero and the points without force: all those of connected parts without loads, initial
/// gaps and slips; the displacements of parts without stiffness, gaps and slips, since they have no size there; and
/// those without effect. `None` if there are none.
fn idle(
    k: &SparseColMat<usize, f64>,
    f: &[f64],
    points: &Points,
    moves_nothing: &[bool],
) -> Option<(Vec<bool>, Vec<bool>)> {
    let (n, m) = (f.len(), points.len());
    let mut parts = Parts::new(n + m);
    (0..n).for_each(|j| parts.join_all([j].into_iter().chain(column_of(k, j).map(|(i, _)| i))));
    for (i, point) in points.iter().enumerate() {
        parts.join_all([n + i].into_iter().chain(point.columns.iter().copied()));
    }
    let mut is_loaded = vec![false; n + m];
    let mut is_stiff = vec![false; n + m];
    let mut is_open = vec![false; n + m];
    for j in 0..n {
        let part = parts.of(j);
        is_loaded[part] |= f[j] != 0.0;
        is_stiff[part] |= column_of(k, j).any(|(_, v)| v != 0.0);
    }
    for (i, point) in points.iter().enumerate() {
        let part = parts.of(n + i);
        is_open[part] |= point.x_0 != 0.0 || point.mu > 0.0 && point.s_0 != 0.0;
        is_stiff[part] |= point.compliance.iter().any(|a| *a > 0.0);
    }
    let mut of = |i: usize| {
        let part = parts.of(i);
        (is_loaded[part], is_stiff[part], is_open[part])
    };
    let at_rest = |(loaded, stiff, open): (bool, bool, bool)| !(open || loaded && stiff);
    let displacements: Vec<bool> = (0..n).map(|j| at_rest(of(j)) || moves_nothing[j]).collect();
    let without_force = |(loaded, _, open): (bool, bool, bool)| !loaded && !open;
    let acts =
        |point: Point<'_>| point.coefficients.iter().any(|c| c[0] != 0.0) || point.x_0 <= 0.0;
    let points = points.iter().enumerate();
    let points: Vec<bool> =
        points.map(|(i, point)| without_force(of(n + i)) || !acts(point)).collect();
    (displacements.contains(&true) || points.contains(&true)).then_some((displacements, points))
}
