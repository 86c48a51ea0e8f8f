//! What the last digits cost: one factorisation, and solves with it.

use lcp::refine::Refinement;
use serde::Serialize;

use super::verified::Exact;

/// The equations of the states of all contacts, solved from nothing else.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Refining {
    /// How far.
    pub refinement: Refinement,
    /// Wall-clock time of the factorisation and all solves, the median of several \[s\].
    pub seconds: f64,
    /// Solves with the factors.
    pub passes: usize,
    /// The largest lack of an equation, relative to the terms of its row \[-\].
    pub residual: f64,
    /// The error of the forces on the nodes against the reference, relative to the largest \[-\].
    pub error: Option<f64>,
}

pub(super) fn measured(exact: &Exact, repeats: usize) -> Vec<Refining> {
    let all = [Refinement::Plain, Refinement::Single, Refinement::Extended];
    all.into_iter().filter_map(|refinement| one(exact, refinement, repeats)).collect()
}

fn one(exact: &Exact, refinement: Refinement, repeats: usize) -> Option<Refining> {
    let found = exact.solved_anew(refinement)?;
    let again = (1..repeats).filter_map(|_| Some(exact.solved_anew(refinement)?.seconds));
    let mut seconds: Vec<f64> = std::iter::once(found.seconds).chain(again).collect();
    seconds.sort_by(f64::total_cmp);
    Some(Refining {
        refinement,
        seconds: seconds[seconds.len() / 2],
        passes: found.passes,
        residual: found.residual,
        error: exact.error(&found),
    })
}
