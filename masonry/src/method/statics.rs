//! Statically admissible forces: contact forces inside their friction cones that balance the loads of every block,
//! for any material and any position of the blocks.
//!
//! With one nonnegative force `p` along each edge of each cone, and the sparse matrix `E` of the resultants of
//! these on the blocks, they are the solutions of `E p + r = 0`, `p >= 0`, with the resultants `r` of the loads. Where a
//! joint has a constant part `C_0` of friction ([`law`](crate::law)), a force `q` along it with `|q| <= C_0` comes on
//! top. Two convex programs decide whether there are any:
//!
//! * the forces of least size, `min |p|^2 / 2`: joints as springs that are sheared and opened by the same law
//!   (associated flow). It has one solution if there are any admissible forces;
//! * the smallest unbalanced force, `min |v|^2 / 2` with `v = r + E p`. If there are no admissible forces, `v` is not
//!   zero and proves it: `E^T v >= 0` and `r.v = |v|^2 > 0`. This is a motion of rigid blocks on which every contact
//!   force does nonnegative work, and the loads do more work than cohesion and tensile strength take (Farkas 1902,
//!   Moreau 1962). The [`proof`] checks it in the geometry.
//!
//! Rigid blocks without gaps stand if there are such forces: at rest every gap and every slip is zero. For all other
//! walls they are necessary but not sufficient.

use lcp::{MixedLcp, Observer, Solution};

use crate::model::Model;
use crate::system::System;
use engine::Engine;
use program::Program;

mod engine;
pub mod limit;
mod program;
pub mod proof;
mod sharpen;

pub use proof::Proof;

/// Steps of each: forces take ten to forty where there are any, proofs near the limit more.
const MAX_STEPS: [usize; 2] = [60, 150];

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

/// The programs of a decision, one after the other until one of them decides.
struct Search<'a, 'b> {
    model: &'a Model,
    program: &'a Program<'a>,
    steps: &'a mut usize,
    observer: &'a mut Observer<'b>,
}

impl Search<'_, '_> {
    fn run(&mut self) -> Result<Statics, lcp::Error> {
        let least = self.program.least_forces()?;
        let nearest = self.program.least_rest()?;
        // The first of them takes a quarter of the time, and most walls stand. What interior points leave open the
        // convex programs of another library decide.
        for engine in [Engine::Interior, Engine::Clarabel] {
            let solution = self.solved(&least, MAX_STEPS[0], engine)?;
            let (z, _) = least.recover(&solution.t, &solution.y);
            if let Some(forces) = self.program.admissible(&z) {
                return Ok(Statics::Admissible(forces));
            }
            // Where there are none, its multipliers grow along a proof.
            if let Some(proof) = self.proof(&z) {
                return Ok(Statics::Impossible(proof));
            }
            let solution = self.solved(&nearest, MAX_STEPS[1], engine)?;
            let (z, _) = nearest.recover(&solution.t, &solution.y);
            if let Some(proof) = self.proof(&z) {
                return Ok(Statics::Impossible(proof));
            }
            if let Some(forces) = self.program.admissible(&z) {
                return Ok(Statics::Admissible(forces));
            }
        }
        Ok(Statics::Open)
    }

    /// The proof that the motion at the beginning of `z` leads to.
    fn proof(&self, z: &[f64]) -> Option<Proof> {
        let entries = self.program.entries();
        let motion = &z[..self.program.unknowns()];
        sharpen::candidates(motion, entries, self.program.columns())
            .find_map(|motion| Proof::of(self.model, &motion))
    }

    fn solved(
        &mut self,
        program: &MixedLcp,
        max_iterations: usize,
        engine: Engine,
    ) -> Result<Solution, lcp::Error> {
        let solution = engine.solve(program, max_iterations, self.observer)?;
        *self.steps += solution.info.factorisations;
        Ok(solution)
    }
}
