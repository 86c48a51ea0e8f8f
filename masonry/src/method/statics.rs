//! Statically admissible forces: contact forces inside their friction cones that balance the loads of every block,
//! for any material and any position of the blocks.
//!
//! There is one nonnegative force `p` along each edge of each friction cone, and the sparse matrix `E` has the
//! resultants of these forces on the blocks. Admissible forces are the solutions of `E p + r = 0`, `p >= 0`, where `r`
//! are the resultants of the loads. A joint with a constant part `C_0` of friction ([`law`](crate::law)) also has a
//! force `q` along the joint with `|q| <= C_0`. One convex program decides whether there are any admissible forces: the
//! forces of least size, `min |p|^2 / 2`, are those of joints as springs that are sheared and opened by the same law
//! (associated flow). The program has one solution if there are admissible forces. If there are none, the multipliers
//! `v` of the balance prove it: `E^T v >= 0` and `r.v > 0`. The vector `v` is a motion of rigid blocks on which every
//! contact force does nonnegative work, and the loads do more work than cohesion and tensile strength take (Farkas
//! 1902, Moreau 1962). Newton's method on the multipliers finds the forces within a few steps (Mangasarian 2004). If
//! its steps become short, the interior-point method finds forces or a proof, since it solves a homogeneous problem
//! that contains both (Andersen and Ye 1999). The [`proof`] is checked in the geometry.
//!
//! If there are admissible forces, rigid blocks without gaps stand: every gap and every slip is zero at rest. For all
//! other walls, admissible forces are necessary but not sufficient.

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

/// The decision whether there are admissible forces, and its cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    /// Admissible forces, or the proof that there are none; or neither was found.
    pub statics: Statics,
    /// Number of steps, each of which factorises one matrix with three unknowns per block.
    pub steps: usize,
    /// Whether the observer ended the search early.
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
        // The multipliers of the balance may be a motion that proves that there are no admissible forces.
        None => sharpen::candidates(&u, &[], program.columns())
            .find_map(|motion| Proof::of(model, &motion[..3 * model.blocks.len()]))
            .map_or(Statics::Open, Statics::Impossible),
    };
    let is_cancelled = status == Status::Cancelled;
    Ok(Decision { statics, steps: info.factorisations, is_cancelled })
}
