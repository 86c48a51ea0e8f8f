//! Whether any contact forces balance the loads, wherever the bodies are.

use super::constants::{BALANCE_TOLERANCE, LOADS, ROW_ROUNDING};
use super::factors::Factors;
use super::homogeneous::{Accuracy, solved};
use super::program::{self, Program};
use crate::states::Scaled;
use crate::vector::max_abs;
use crate::{Certificate, Contact2d, Status};

/// What is known of forces that balance the loads.
pub(super) enum Balance {
    /// There are none: a Farkas vector.
    Impossible(Certificate),
    /// These do, inside their cones.
    Possible(Vec<(f64, f64)>),
    /// Neither came out, for this reason.
    Open(Status),
}

/// Decides whether there are forces `t` inside their cones and displacements `u`, whatever their gaps, with
/// `K u = f + C^T t`.
///
/// The forces are those of a convex program: of contacts whose springs open along the edges of their cones, as with
/// associated friction. If it has no solution there is a motion `v` with `K v = 0`, `C_n v >= mu |C_t v|` and
/// `f.v > 0`, which proves it (Farkas 1902). `stop` is asked before every step, with the residual.
pub(super) fn balance(
    contact: &Contact2d,
    problem: &Scaled,
    stop: impl FnMut(f64) -> Option<Status>,
) -> Balance {
    let edges = program::edges(problem);
    let count = edges.ncols();
    let program = Program {
        k: problem.k.clone(),
        f: problem.f.clone(),
        a: edges,
        x_0: vec![0.0; count],
        compliance: vec![1.0; count],
    };
    let (program, units) = program.scaled();
    let Ok(mut factors) = Factors::of(&program) else { return Balance::Open(Status::Stalled) };
    let general = contact.to_general();
    let mut proof = None;
    let mut is_proof = |u: &[f64]| {
        let motion = without_noise(u.iter().zip(&units.column).map(|(u, d)| u * d).collect());
        let pi = contact.farkas_of_motion(&problem.displacements(&motion));
        proof = Some(Certificate::Farkas { pi }).filter(|it| it.holds(&general));
        proof.is_some()
    };
    let accuracy = Accuracy::of_products(BALANCE_TOLERANCE).of_loads(LOADS);
    let (mut at, status) = solved(&program, &mut factors, accuracy, stop, |at| is_proof(&at.u));
    match (status, proof) {
        (_, Some(proof)) => Balance::Impossible(proof),
        (Status::Solved, None) => {
            factors.balance(&program, &mut at.t);
            Balance::Possible(problem.of_edges(at.t.iter().map(|t| t * units.force)))
        }
        (status, None) => Balance::Open(status),
    }
}

/// What does not move except for rounding errors is at rest: errors of their own size would contradict a proof.
fn without_noise(v: Vec<f64>) -> Vec<f64> {
    let noise = ROW_ROUNDING * max_abs(&v);
    v.into_iter().map(|v| if v.abs() <= noise { 0.0 } else { v }).collect()
}
