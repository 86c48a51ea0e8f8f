//! The largest factor of a group of loads at which statically admissible forces exist.
//!
//! The resultants on the blocks for a load factor of one are `g`. The largest factor is found by a linear program:
//! `max l` subject to `E p + r + l g = 0`, `p >= 0`, `l >= 0`. Its multipliers are a motion `x` of rigid blocks with
//! `E^T x >= 0`, `g.x = 1` and `l = -r.x`: the mechanism of associated flow, in which joints that slide open by `mu`
//! times the slip. So the program gives both bounds of the theorems of limit analysis (Drucker, Prager and Greenberg
//! 1952; for blocks, Livesley 1978). Its forces give the lower bound, and its motion the upper bound, which the
//! [`Proof`] checks in the geometry.

use lcp::{Observer, Status};

use super::engine::Target;
use super::program::Program;
use super::sharpen;
use crate::data::statics::{Extreme, Proof};
use crate::model::Model;
use crate::rounding;
use crate::system::System;

/// Relative distances above the largest load factor for which forces were found. At each of these distances, a motion
/// is tried as a proof that no forces balance the loads.
const BEYOND: [f64; 6] = [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];
/// Difference of the bounds, relative to the load factor, at which the search ends.
pub const NEAR: f64 = 2e-5;
/// Number of motions that are tried even if the bounds are close enough, since they may tighten the bounds further.
const ALWAYS: usize = 2;

/// The bounds of the largest load factor.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bounds {
    /// A load factor, and forces of all rows of the [`System`] \[N\] that balance the loads at this factor; `None` if
    /// no forces were found.
    pub below: Option<(f64, Vec<f64>)>,
    /// A load factor, and the proof that no forces balance the loads at this factor; `None` if no proof was found.
    pub above: Option<(f64, Proof)>,
    /// The scale of the distance between the bounds: the load factor, or the factor at which the growing loads are as
    /// large as the loads that stay, if that is larger.
    pub size: f64,
}

impl Bounds {
    /// Returns the difference of the two bounds; `None` unless both are known.
    pub fn gap(&self) -> Option<f64> {
        Some(self.above.as_ref()?.0 - self.below.as_ref()?.0)
    }

    /// Whether the bounds are so near to each other that they count as one number.
    pub fn is_closed(&self) -> bool {
        self.gap().is_some_and(|gap| gap <= NEAR * self.size)
    }
}

/// A structure under loads that stay, and others that grow with the load factor.
pub struct Growing<'a> {
    /// A function that returns the model of the structure under a load factor.
    pub at: &'a dyn Fn(f64) -> Model,
    /// The system of the structure under the loads that stay.
    pub system: &'a System,
    /// The resultants of the growing loads for a load factor of one, `N^T f` of all blocks \[N\].
    pub growth: &'a [f64],
    /// Whether each block is held in place, so that its balance is left out of the program; empty if no block is held.
    pub held: &'a [bool],
}

/// Computes the largest value of the linear function `of_rows . t` over all admissible forces `t` of the rows of a
/// system.
///
/// # Errors
/// As [`Growing::largest`].
pub fn extreme(
    system: &System,
    of_rows: &[f64],
    observer: &mut Observer<'_>,
) -> Result<Extreme, lcp::Error> {
    let program = Program::new(system, None);
    let gain = program.gain(of_rows);
    let problem = program.greatest(&gain)?;
    let mut best: Option<[f64; 2]> = None;
    for target in Target::ALL {
        let solution = target.solve(&problem, observer)?;
        let (z, _) = problem.recover(&solution.t, &solution.y);
        let (motion, columns) = z.split_at(program.unknowns());
        let Some(forces) = program.admissible(columns) else { continue };
        let value: f64 = forces.iter().zip(of_rows).map(|(force, gain)| force * gain).sum();
        let bound = program.bound(motion, &gain);
        if best.is_none_or(|[other, above]| (bound - value).abs() < (above - other).abs()) {
            best = Some([value, bound]);
        }
        if (bound - value).abs() <= NEAR * program.unit() {
            return Ok(Extreme::Value { value, bound });
        }
    }
    let circulating = program.circulating(&gain);
    let found = circulating.least_forces(observer)?;
    Ok(match (circulating.admissible(&found.t), best) {
        (Some(_), _) => Extreme::Unlimited,
        (None, Some([value, bound])) => Extreme::Value { value, bound },
        (None, None) => Extreme::Open,
    })
}

impl Growing<'_> {
    /// Computes the largest nonnegative load factor, between bounds. If no factor or every factor is carried, there are
    /// no bounds.
    ///
    /// # Errors
    /// [`lcp::Error::NotFinite`] when the data of the scene overflow.
    pub fn largest(&self, observer: &mut Observer<'_>) -> Result<Bounds, lcp::Error> {
        // The growing loads are scaled, so that they are as large as the others for a factor of one in the program.
        let scale = self.size();
        let growth: Vec<f64> = self.growth.iter().map(|g| scale * g).collect();
        let program = Program::new(self.system, Some(&growth)).holding(self.held);
        let problem = program.greatest(&[(program.forces(), 1.0)])?;
        let mut bounds = Bounds { size: scale, ..Bounds::default() };
        for target in Target::ALL {
            let solution = target.solve(&problem, observer)?;
            if solution.status == Status::Cancelled {
                break;
            }
            let (z, _) = problem.recover(&solution.t, &solution.y);
            let (motion, columns) = z.split_at(program.unknowns());
            let factor = scale * columns[program.forces()].max(0.0);
            if let Some(forces) = program.admissible(columns)
                && bounds.below.as_ref().is_none_or(|(below, _)| factor > *below)
            {
                bounds.below = Some((factor, forces));
            }
            bounds.size = scale.max(factor);
            self.prove(&program, factor, motion, &columns[..program.edges()], &mut bounds);
            if bounds.is_closed() {
                break;
            }
        }
        Ok(bounds)
    }

    /// Returns the factor at which the growing loads are as large as the loads that stay; one if no load stays.
    fn size(&self) -> f64 {
        let size = rounding::largest(self.system.resultants()) / rounding::largest(self.growth);
        if size > 0.0 && size.is_finite() { size } else { 1.0 }
    }

    /// Looks for the smallest load factor that the motion, or a motion near it, proves to be too large, and keeps it as
    /// upper bound.
    fn prove(
        &self,
        program: &Program<'_>,
        factor: f64,
        motion: &[f64],
        along_edges: &[f64],
        bounds: &mut Bounds,
    ) {
        let beyond: Vec<(f64, Model)> = BEYOND
            .iter()
            .map(|part| factor + part * bounds.size)
            .map(|factor| (factor, (self.at)(factor)))
            .collect();
        let near = sharpen::candidates(motion, along_edges, program.columns());
        for (k, mut motion) in near.enumerate() {
            let held = self.held.iter().enumerate().filter(|(_, held)| **held);
            held.for_each(|(block, _)| motion[3 * block..][..3].fill(0.0));
            if k >= ALWAYS && bounds.is_closed() {
                return;
            }
            for (factor, model) in &beyond {
                if bounds.above.as_ref().is_some_and(|(above, _)| above <= factor) {
                    break;
                }
                if let Some(proof) = Proof::of(model, &motion[..3 * model.blocks.len()]) {
                    bounds.above = Some((*factor, proof));
                }
            }
        }
    }
}
