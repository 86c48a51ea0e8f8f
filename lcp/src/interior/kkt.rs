//! Mixed problems whose bounded variables are forces on the free ones: those of convex programs in few variables with
//! many inequalities, or the other way round.

use faer::sparse::{FaerError, SparseColMat};

use super::constants::ROW_ROUNDING;
use super::factors::Factors;
use super::homogeneous::{Accuracy, solved};
use super::program::{Program, Units, assembled};
use super::variables::Variables;
use crate::problem::column_of;
use crate::solve::Monitor;
use crate::vector::max_abs;
use crate::{Certificate, Matrix, MixedLcp, Status};

/// Such a problem: `K u = f + A t`, `y = A^T u + D t + x_0`, `0 <= t _|_ y >= 0`, with a diagonal `D >= 0`.
///
/// A step factorises a matrix with the order of `u`, where the mixed problem as it stands has that of `u` and `t`.
pub(super) struct KktProgram<'a> {
    program: Program,
    units: Units,
    /// Of every variable of the mixed problem its place among the free or the bounded ones.
    places: Vec<usize>,
    free: &'a [bool],
}

impl<'a> KktProgram<'a> {
    /// `None` where bounded variables act on each other, or are not acted on as they act.
    pub(super) fn of(problem: &'a MixedLcp) -> Option<Self> {
        let (q, free) = (problem.q(), problem.free());
        let dense;
        let m = match problem.m() {
            Matrix::Sparse(m) => m,
            m @ Matrix::Dense(_) => {
                dense = m.clone().into_sparse();
                &dense
            }
        };
        let mut counts = [0; 2];
        let place = |is_free: &bool| {
            let count = &mut counts[usize::from(*is_free)];
            *count += 1;
            *count - 1
        };
        let places: Vec<usize> = free.iter().map(place).collect();
        let order = counts[1];
        let among_free = |j: usize| {
            let entries = column_of(m, j).filter(|(i, v)| free[*i] && *v != 0.0);
            entries.map(|(i, v)| (places[i], v))
        };
        let matrix_of = |is_free: bool, sign: f64| {
            let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
            for j in (0..free.len()).filter(|&j| free[j] == is_free) {
                for (i, v) in among_free(j) {
                    rows.push(i);
                    values.push(sign * v);
                }
                starts.push(rows.len());
            }
            assembled(order, starts, rows, values)
        };
        let bounded = || (0..free.len()).filter(|&j| !free[j]);
        let compliance = bounded().map(|j| own_compliance(m, free, j));
        let compliance = compliance.collect::<Option<Vec<f64>>>()?;
        if problem.asymmetry().is_some() {
            return None;
        }
        let program = Program {
            k: matrix_of(true, 1.0),
            f: q.iter().zip(free).filter(|(_, free)| **free).map(|(q, _)| -q).collect(),
            a: matrix_of(false, -1.0),
            x_0: bounded().map(|j| q[j]).collect(),
            compliance,
        };
        let (program, units) = program.scaled();
        Some(Self { program, units, places, free })
    }

    /// `(z, w)` of a solution to the tolerance, or where a limit is reached; or along a motion that may prove that there is
    /// none. The last is the Farkas vector that `is_proof` has confirmed.
    pub(super) fn solved(
        &self,
        factors: &mut Factors,
        tolerance: f64,
        monitor: &mut Monitor<'_>,
        mut is_proof: impl FnMut(&[f64]) -> bool,
    ) -> (Vec<f64>, Vec<f64>, Status, Option<Certificate>) {
        let is_proof = |at: &Variables| is_proof(&self.proof(at));
        let stop = |residual| monitor.stop(residual);
        let accuracy = Accuracy::of_all(tolerance);
        let (at, status) = solved(&self.program, factors, accuracy, stop, is_proof);
        let (z, w) = self.variables(&at);
        (
            z,
            w,
            status,
            (status == Status::Infeasible).then(|| Certificate::Farkas { pi: self.proof(&at) }),
        )
    }

    /// A Farkas vector with a largest entry of one.
    fn proof(&self, at: &Variables) -> Vec<f64> {
        let (z, _) = self.variables(at);
        let compliance = &self.program.compliance;
        let is_none = |j: usize| !self.free[j] && compliance[self.places[j]] > 0.0;
        let kept = z.iter().enumerate().map(|(j, v)| if is_none(j) { 0.0 } else { -v });
        let kept: Vec<f64> = kept.collect();
        let largest = max_abs(&kept);
        // What hardly moves is at rest: rounding errors would contradict each other.
        let noise = |v: &f64| if v.abs() <= ROW_ROUNDING * largest { 0.0 } else { v / largest };
        kept.iter().map(noise).collect()
    }

    pub(super) fn planned(&self) -> Result<Factors, FaerError> {
        Factors::of(&self.program)
    }

    fn variables(&self, at: &Variables) -> (Vec<f64>, Vec<f64>) {
        let Units { column, force, length } = &self.units;
        let of = |(&place, free): (&usize, &bool)| {
            if *free {
                (at.u[place] * column[place] * length, 0.0)
            } else {
                (at.t[place] * force, at.y[place] * length)
            }
        };
        self.places.iter().zip(self.free).map(of).unzip()
    }
}

/// How far a bounded variable of one opens its own gap; `None` if it acts on that of another one.
fn own_compliance(m: &SparseColMat<usize, f64>, free: &[bool], j: usize) -> Option<f64> {
    let mut acting = column_of(m, j).filter(|(i, v)| !free[*i] && *v != 0.0);
    match (acting.next(), acting.next()) {
        (None, _) => Some(0.0),
        (Some((i, v)), None) if i == j && v > 0.0 => Some(v),
        _ => None,
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
