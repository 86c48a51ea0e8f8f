//! Statically admissible forces: contact forces inside their friction cones that balance the loads of every block,
//! for any material and any position of the blocks.
//!
//! With one nonnegative force `p` along each edge of each cone, and the sparse matrix `E` of the resultants of
//! these on the blocks, they are the solutions of `E p + r = 0`, `p >= 0`, with the resultants `r` of the loads. Where a
//! joint has a constant part `C_0` of friction ([`law`](crate::law)), a force `q` along it with `|q| <= C_0` comes on
//! top. One convex program decides whether there are any: the forces of least size, `min |p|^2 / 2`, which are those of
//! joints as springs that are sheared and opened by the same law (associated flow). It has one solution if there are any
//! admissible forces. If there are none, the multipliers `v` of the balance prove it: `E^T v >= 0` and `r.v > 0`. This is
//! a motion of rigid blocks on which every contact force does nonnegative work, and the loads do more work than cohesion
//! and tensile strength take (Farkas 1902, Moreau 1962). The interior points find either, since they solve a homogeneous
//! problem that contains both (Andersen and Ye 1999). The [`proof`] is checked in the geometry.
//!
//! Rigid blocks without gaps stand if there are such forces: at rest every gap and every slip is zero. For all other
//! walls they are necessary but not sufficient.

use lcp::{InteriorPoint, InteriorPointSettings, LeastForces, Observer};

use crate::model::Model;
use crate::system::System;
use program::Program;

mod program;
pub mod proof;
mod sharpen;

pub use proof::Proof;

/// Residual of the program that decides.
const TOLERANCE: f64 = 1e-12;
/// Forces and proofs take ten to forty steps. Chosen: far more.
const MAX_STEPS: usize = 150;

/// What is known about forces that balance the loads.
#[derive(Debug, Clone, PartialEq)]
pub enum Statics {
    /// These do: of all rows of the [`System`] \[N\].
    Admissible(Vec<f64>),
    /// There are none.
    Impossible(Proof),
    /// Undecided.
    Open,
}

/// A decision and what it cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    /// What was found.
    pub statics: Statics,
    /// Steps of the interior points, each of which factorises one matrix of three unknowns a block.
    pub steps: usize,
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
    let program = Program::of(system);
    let mut steps = 0;
    if program.is_unloaded() {
        let statics = Statics::Admissible(vec![0.0; system.rows.len()]);
        return Ok(Decision { statics, steps });
    }
    let mut search = Search { model, program: &program, steps: &mut steps, observer };
    let statics = search.run()?;
    Ok(Decision { statics, steps })
}

/// The program of a decision.
struct Search<'a, 'b> {
    model: &'a Model,
    program: &'a Program<'a>,
    steps: &'a mut usize,
    observer: &'a mut Observer<'b>,
}

impl Search<'_, '_> {
    fn run(&mut self) -> Result<Statics, lcp::Error> {
        let LeastForces { t, u, .. } = self.least_forces()?;
        if let Some(forces) = self.program.admissible(t) {
            return Ok(Statics::Admissible(forces));
        }
        // Where there are none, the multipliers of the balance are a motion that proves it.
        Ok(self.proof(&u).map_or(Statics::Open, Statics::Impossible))
    }

    /// The proof that a motion leads to.
    fn proof(&self, motion: &[f64]) -> Option<Proof> {
        sharpen::candidates(motion, self.program.columns())
            .find_map(|motion| Proof::of(self.model, &motion[..3 * self.model.blocks.len()]))
    }

    fn least_forces(&mut self) -> Result<LeastForces, lcp::Error> {
        let settings = InteriorPointSettings {
            tolerance: TOLERANCE,
            max_iterations: MAX_STEPS,
            ..Default::default()
        };
        let (columns, loads) = (self.program.columns(), self.program.loads());
        let found = InteriorPoint::new(settings).least_forces(columns, loads, self.observer)?;
        *self.steps += found.info.factorisations;
        Ok(found)
    }
}
