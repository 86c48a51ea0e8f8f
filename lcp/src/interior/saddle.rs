//! Mixed problems whose bounded variables are forces on the free ones: those of convex programs in few variables with
//! many inequalities, or the other way round.

use faer::sparse::{SparseColMat, Triplet};

use super::constants::ROW_ROUNDING;
use super::homogeneous::solved;
use super::iterate::Iterate;
use crate::problem::column_of;
use crate::solve::Monitor;
use crate::states::{Condensed, Point, Scaled};
use crate::vector::max_abs;
use crate::{Certificate, MixedLcp, Status};

/// Such a problem: `K u = f + N^T t`, `y = N u + D t + x_0`, `0 <= t _|_ y >= 0`, with a diagonal `D >= 0`.
///
/// A step factorises a matrix with the order of `u`, where the mixed problem as it stands has that of `u` and `t`.
pub(super) struct Saddle {
    scaled: Scaled,
    /// Of every variable of the mixed problem its place among the free or the bounded ones.
    places: Vec<usize>,
    free: Vec<bool>,
}

impl Saddle {
    /// `None` where bounded variables act on each other, or are not acted on as they act.
    pub(super) fn of(problem: &MixedLcp) -> Option<Self> {
        if problem.asymmetry().is_some() {
            return None;
        }
        let (m, q, free) = (problem.m().clone().into_sparse(), problem.q(), problem.free());
        let mut counts = [0; 2];
        let place = |is_free: &bool| {
            let count = &mut counts[usize::from(*is_free)];
            *count += 1;
            *count - 1
        };
        let places: Vec<usize> = free.iter().map(place).collect();
        let [bounded, order] = counts;
        let mut points = Vec::with_capacity(bounded);
        for j in (0..free.len()).filter(|&j| !free[j]) {
            let (mut columns, mut normal, mut compliance) = (Vec::new(), Vec::new(), 0.0);
            for (i, v) in column_of(&m, j).filter(|(_, v)| *v != 0.0) {
                if free[i] {
                    columns.push(places[i]);
                    normal.push(-v);
                } else if i == j && v > 0.0 {
                    compliance = v;
                } else {
                    return None;
                }
            }
            let tangent = vec![0.0; columns.len()];
            points.push(Point {
                columns,
                normal,
                tangent,
                x_0: q[j],
                s_0: 0.0,
                mu: 0.0,
                compliance,
            });
        }
        let among_free = |j: usize| column_of(&m, j).filter(|(i, v)| free[*i] && *v != 0.0);
        let stiffness = (0..free.len()).filter(|&j| free[j]).flat_map(|j| {
            among_free(j).map(|(i, v)| Triplet::new(places[i], places[j], v)).collect::<Vec<_>>()
        });
        let stiffness: Vec<_> = stiffness.collect();
        let k = SparseColMat::try_new_from_triplets(order, order, &stiffness).ok()?;
        let loads = q.iter().zip(free).filter(|(_, free)| **free).map(|(q, _)| -q).collect();
        let scaled = Scaled::of_parts(k, loads, points);
        Some(Self { scaled, places, free: free.to_vec() })
    }

    /// `(z, w)` of a solution to the tolerance, or where a limit is reached; or along a motion that may prove that there is
    /// none. The last is the Farkas vector that `is_proof` has confirmed.
    pub(super) fn solved(
        &self,
        condensed: &mut Condensed,
        tolerance: f64,
        monitor: &mut Monitor<'_>,
        mut is_proof: impl FnMut(&[f64]) -> bool,
    ) -> (Vec<f64>, Vec<f64>, Status, Option<Certificate>) {
        let is_proof = |at: &Iterate| is_proof(&self.proof(at));
        let stop = |residual| monitor.stop(residual);
        let (at, status) = solved(&self.scaled, condensed, (0.0, tolerance), stop, is_proof);
        let (z, w) = self.variables(&at);
        (
            z,
            w,
            status,
            (status == Status::Infeasible).then(|| Certificate::Farkas { pi: self.proof(&at) }),
        )
    }

    /// A Farkas vector with a largest entry of one.
    fn proof(&self, at: &Iterate) -> Vec<f64> {
        let (z, _) = self.variables(at);
        let points = &self.scaled.points;
        let is_none = |j: usize| !self.free[j] && points[self.places[j]].compliance > 0.0;
        let kept = z.iter().enumerate().map(|(j, v)| if is_none(j) { 0.0 } else { -v });
        let kept: Vec<f64> = kept.collect();
        let largest = max_abs(&kept);
        // What hardly moves is at rest: rounding errors would contradict each other.
        let noise = |v: &f64| if v.abs() <= ROW_ROUNDING * largest { 0.0 } else { v / largest };
        kept.iter().map(noise).collect()
    }

    pub(super) fn planned(&self) -> Result<Condensed, faer::sparse::FaerError> {
        Condensed::new(&self.scaled)
    }

    fn variables(&self, at: &Iterate) -> (Vec<f64>, Vec<f64>) {
        let u = self.scaled.displacements(&at.u);
        let of = |(&place, free): (&usize, &bool)| {
            if *free {
                return (u[place], 0.0);
            }
            let pairs = &at.points[place];
            (pairs.t_n * self.scaled.force(), pairs.gap * self.scaled.length())
        };
        self.places.iter().zip(&self.free).map(of).unzip()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod tests {
    use faer::mat;

    use crate::{InteriorPoint, InteriorPointSettings, MixedLcp, Solution, Solver, Status};

    /// The forces of least size along `edges` that balance a load on two bodies of one freedom each.
    fn program(edges: [[f64; 2]; 3], load: [f64; 2]) -> MixedLcp {
        let [a, b, c] = edges;
        let m = mat![
            [0.0, 0.0, -a[0], -b[0], -c[0]],
            [0.0, 0.0, -a[1], -b[1], -c[1]],
            [a[0], a[1], 1.0, 0.0, 0.0],
            [b[0], b[1], 0.0, 1.0, 0.0],
            [c[0], c[1], 0.0, 0.0, 1.0],
        ];
        let q = vec![-load[0], -load[1], 0.0, 0.0, 0.0];
        MixedLcp::new(m, q, vec![true, true, false, false, false]).unwrap()
    }

    fn solved(problem: &MixedLcp) -> Solution {
        let settings = InteriorPointSettings { crossover: false, ..Default::default() };
        InteriorPoint::new(settings).solve(problem).unwrap()
    }

    /// Of two equal forces that balance a load each carries half, whatever the units are.
    #[test]
    fn forces_of_least_size_are_found() {
        for unit in [1e-9, 1.0, 1e9] {
            let edges = [[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
            let problem = program(edges, [-2.0 * unit, -unit]);
            let solution = solved(&problem);
            assert_eq!(solution.status, Status::Solved);
            let (z, _) = problem.recover(&solution.t, &solution.y);
            for force in &z[2..] {
                assert!((force / unit - 1.0).abs() < 1e-9, "{z:?}");
            }
        }
    }

    /// Nothing pulls, so nothing balances a load that does.
    #[test]
    fn that_there_are_none_is_proved() {
        for unit in [1e-9, 1.0, 1e9] {
            let problem = program([[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], [-unit, 0.5 * unit]);
            let solution = solved(&problem);
            assert_eq!(solution.status, Status::Infeasible);
            assert!(solution.certificate.unwrap().holds(&problem.to_general()));
        }
    }
}
