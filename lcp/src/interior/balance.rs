//! Test whether any contact forces balance the loads, wherever the bodies are.

use super::homogeneous::Accuracy;
use super::program::{Program, without_noise};
use crate::matrix::DATA_ROUNDING;
use crate::states::Scaled;
use crate::{Certificate, Contact2d, Matrix, Status};

/// The end of a search for forces that found none: with a Farkas vector if it proved that none exist.
pub(super) type Ended = (Status, Option<Certificate>);

/// Forces `t` inside their cones with displacements `u`, whatever their gaps, for which `K u = f + C^T t`.
///
/// The forces are those of a convex program: of contacts whose springs open along the edges of their cones, as with
/// associated friction. If the program has no solution there is a motion `v` with `K v = 0`, `C_n v >= mu |C_t v|`
/// and `f.v > 0`, a proof by Farkas' lemma (1902). `stop` is called before every step, with the residual.
pub(super) fn balance(
    contact: &Contact2d,
    problem: &Scaled,
    stop: impl FnMut(f64) -> Option<Status>,
) -> Result<Vec<(f64, f64)>, Ended> {
    let edges = problem.edges().enumerate().flat_map(|(j, (point, mu))| {
        let terms = point.columns.iter().zip(point.coefficients);
        terms.map(move |(&i, [n, t])| (i, j, n + mu * t))
    });
    let edges = Matrix::from_entries(problem.order(), problem.edges().count(), edges);
    let program =
        Program::of_least_forces(problem.k.clone(), problem.f.clone(), edges.into_sparse());
    let general = contact.to_general();
    let mut proof = None;
    let is_proof = |u: &[f64], _: &[f64]| {
        let motion = problem.displacements(&without_noise(u.to_vec()));
        let farkas = Certificate::Farkas { pi: contact.farkas_of_motion(&motion) };
        proof = Some(farkas).filter(|it| it.holds(&general));
        proof.is_some()
    };
    let found = program.solve(Accuracy::OfForces(DATA_ROUNDING), stop, is_proof);
    match (found.map(|it| (it.status, it.t)), proof) {
        (_, Some(proof)) => Err((Status::Infeasible, Some(proof))),
        (Ok((Status::Solved, t)), None) => Ok(problem.of_edges(t.into_iter())),
        (Ok((status, _)), None) => Err((status, None)),
        // Memory does not suffice.
        (Err(_), None) => Err((Status::Stalled, None)),
    }
}
