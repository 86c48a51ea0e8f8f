//! Statically admissible forces: contact forces inside their friction cones that balance the loads of every block,
//! for any material and any position of the blocks.
//!
//! There is one nonnegative force `p` along each edge of each cone, and the sparse matrix `E` has the resultants of
//! these on the blocks: admissible forces are the solutions of `E p + r = 0`, `p >= 0`, with the resultants `r` of the
//! loads. A joint with a constant part `C_0` of friction ([`law`](crate::law)) also has a force `q` along it with
//! `|q| <= C_0`. One convex program decides whether there are any such forces: the forces of least size,
//! `min |p|^2 / 2`, are those of joints as springs that are sheared and opened by the same law (associated flow). The
//! program has one solution if there are admissible forces. If there are none, the multipliers `v` of the balance prove
//! it: `E^T v >= 0` and `r.v > 0`. The vector `v` is a motion of rigid blocks on which every contact force does
//! nonnegative work, and the loads do more work than cohesion and tensile strength take (Farkas 1902, Moreau 1962).
//! Newton's method on the multipliers finds the forces within a few steps (Mangasarian 2004). If its steps become
//! short, interior points find forces or a proof, since they solve a homogeneous problem that contains both (Andersen
//! and Ye 1999). The [`proof`] is checked in the geometry.
//!
//! Rigid blocks without gaps stand if there are such forces: at rest every gap and every slip is zero. Such forces are
//! necessary but not sufficient for all other walls.

use lcp::{LeastForces, Observer, Status};

use crate::data::statics::{Proof, Statics};
use crate::model::Model;
use crate::system::System;
use program::Program;

mod engine;
pub mod limit;
mod program;
pub mod proof;
mod sharpen;

/// A decision and its cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    /// The decision.
    pub statics: Statics,
    /// Steps, each of which factorises one matrix with three unknowns per block.
    pub steps: usize,
    /// Whether the observer has ended the search.
    pub is_cancelled: bool,
}

/// Decides whether there are statically admissible forces.
///
/// # Errors
/// [`lcp::Error::NotFinite`] when the data of the scene overflow.
pub fn decide(
    model: &Model,
    system: &System,
    observer: &mut Observer<'_>,
) -> Result<Decision, lcp::Error> {
    let program = Program::new(system, None);
    if program.is_unloaded() {
        let statics = Statics::Admissible(vec![0.0; system.rows.len()]);
        return Ok(Decision { statics, steps: 0, is_cancelled: false });
    }
    let LeastForces { status, t, u, info, .. } = program.least_forces(observer)?;
    let statics = match program.admissible(&t) {
        Some(forces) => Statics::Admissible(forces),
        // The multipliers of the balance are a motion that proves that there are no such forces.
        None => sharpen::candidates(&u, &[], program.columns())
            .find_map(|motion| Proof::of(model, &motion[..3 * model.blocks.len()]))
            .map_or(Statics::Open, Statics::Impossible),
    };
    let is_cancelled = status == Status::Cancelled;
    Ok(Decision { statics, steps: info.factorisations, is_cancelled })
}
