//! Mixed problems whose bounded variables act on free ones only: those of convex programs with many inequalities in few
//! variables, or with few in many.

use faer::sparse::SparseColMat;

use super::homogeneous::Accuracy;
use super::outcome::Outcome;
use super::program::{Program, against};
use super::{InteriorPoint, InteriorPointSettings};
use crate::active::unplanned;
use crate::certify::is_proof_of_mixed;
use crate::conversion::judged_point;
use crate::matrix::Storage;
use crate::problem::column_of;
use crate::solve::Monitor;
use crate::{Certificate, Error, Matrix, Method, MixedLcp, Observer, Solution, Status};

impl InteriorPoint {
    /// The solution of a convex program, or a proof that there is none; `None` if bounded variables act on each other,
    /// or if `M` lacks the symmetry of a convex program.
    pub(super) fn solve_convex(
        &self,
        problem: &MixedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Option<Solution>, Error> {
        let InteriorPointSettings { tolerance, max_iterations, time_limit, .. } = self.settings;
        self.settings.validate(problem.order())?;
        let Some((program, places)) = program_of(problem) else { return Ok(None) };
        let is_compliant = |j: usize| !problem.free()[j] && program.compliance[places[j]] > 0.0;
        let is_compliant: Vec<bool> = (0..places.len()).map(is_compliant).collect();
        let proof = |u: &[f64], t: &[f64]| {
            let value = |(j, &place): (usize, &usize)| match (problem.free()[j], is_compliant[j]) {
                (true, _) => u[place],
                (false, false) => t[place],
                (false, true) => 0.0,
            };
            against(places.iter().enumerate().map(value).collect())
        };
        let mut monitor = Monitor::new(Method::Interior, max_iterations, time_limit, observer);
        let found = program.solve(
            Accuracy::OfAll(tolerance),
            |residual| monitor.stop(residual),
            |u, t| is_proof_of_mixed(problem, &proof(u, t)),
        );
        let Outcome { status, u, t, y, factorisations, .. } =
            found.map_err(|error| unplanned(Method::Interior, error))?;
        let of = |(&place, free): (&usize, &bool)| {
            if *free { (u[place], 0.0) } else { (t[place], y[place]) }
        };
        let (z, w): (Vec<f64>, Vec<f64>) = places.iter().zip(problem.free()).map(of).unzip();
        let pairs = problem.to_pairs(&z, &w);
        let mut solution = judged_point(problem, pairs.0, pairs.1, tolerance, status);
        solution.certificate = (solution.status == Status::Infeasible)
            .then(|| Certificate::Farkas { pi: proof(&u, &t) });
        solution.info = monitor.info();
        solution.info.factorisations = factorisations;
        Ok(Some(solution))
    }
}

/// The program of a mixed problem, whose steps factorise a matrix with the order of the free variables; and the place
/// of every variable among the free or the bounded ones.
fn program_of(problem: &MixedLcp) -> Option<(Program, Vec<usize>)> {
    let (q, free) = (problem.q(), problem.free());
    let dense;
    let m = match problem.m().storage() {
        Storage::Sparse(m) => m,
        Storage::Dense(_) => {
            dense = problem.m().to_sparse();
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
    let bounded = || (0..free.len()).filter(|&j| !free[j]);
    let compliance = bounded().map(|j| own_compliance(m, free, j));
    let compliance = compliance.collect::<Option<Vec<f64>>>()?;
    if problem.asymmetry().is_some() {
        return None;
    }
    let on_free = |is_free: bool, sign: f64| {
        let columns = (0..free.len()).filter(|&j| free[j] == is_free);
        let entries = columns.flat_map(|j| {
            let nonzero = column_of(m, j).filter(|(i, v)| free[*i] && *v != 0.0);
            nonzero.map(move |(i, v)| (i, j, sign * v))
        });
        let entries = entries.map(|(i, j, v)| (places[i], places[j], v));
        Matrix::from_entries(counts[1], counts[usize::from(is_free)], entries).into_sparse()
    };
    let program = Program {
        k: on_free(true, 1.0),
        f: q.iter().zip(free).filter(|(_, free)| **free).map(|(q, _)| -q).collect(),
        a: on_free(false, -1.0),
        x_0: bounded().map(|j| q[j]).collect(),
        compliance,
    };
    Some((program, places))
}

/// The opening of the gap of a bounded variable by its own unit value; `None` if the variable acts on the gap of
/// another one.
fn own_compliance(m: &SparseColMat<usize, f64>, free: &[bool], j: usize) -> Option<f64> {
    let mut acting = column_of(m, j).filter(|(i, v)| !free[*i] && *v != 0.0);
    match (acting.next(), acting.next()) {
        (None, _) => Some(0.0),
        (Some((i, v)), None) if i == j && v > 0.0 => Some(v),
        _ => None,
    }
}
