//! Motions that no contact stops, computed from the results of routes for scenes without equilibrium.

use nalgebra::Vector2;

use super::STILL;
use crate::data::motion::Motion;
use crate::forms::Sparse;
use crate::ids::BlockId;
use crate::model::{JointPoint, Model, PlacedBlock};
use crate::system::rigid::Modes;
use crate::system::{System, displaced_nodes};

/// Largest deformation of the blocks in a mechanism, as a fraction of the largest displacement \[-\]: blocks that are
/// deformed more do not form a mechanism.
const LARGEST_DEFORMATION: f64 = 1e-2;

/// Returns the mechanism that belongs to a motion: rates of the corners of every block, scaled so that the largest
/// component is one. Only the rigid part of the displacements of every block counts. `sparse` is the problem to which
/// the displacements belong.
///
/// `None` if a closed contact closes further, or if the loads do no work on the motion.
pub fn mechanism(
    model: &Model,
    system: &System,
    sparse: Option<&Sparse>,
    motion: &Motion,
) -> Option<Vec<Vec<Vector2<f64>>>> {
    match (motion, sparse) {
        (Motion::Rigid(amplitudes), _) => of_amplitudes(model, system, amplitudes, 0.0),
        (Motion::Displacements(u), Some(sparse)) => {
            let (amplitudes, deformation) = rigid_part(model, system, sparse, u);
            of_amplitudes(model, system, &amplitudes, deformation)
        }
        (Motion::Velocities(v), Some(sparse)) => flow(model, system, sparse, v),
        (Motion::Displacements(_) | Motion::Velocities(_), None) => None,
    }
}

/// Returns the rates of the corners of every block in a flow, scaled so that the largest component is one. The rates
/// are the rigid part of velocities of the sparse problem; `None` if nothing moves. The flow is not tested like a
/// [`mechanism`], since velocities are as accurate as the motion that they belong to.
pub(crate) fn flow(
    model: &Model,
    system: &System,
    sparse: &Sparse,
    velocities: &[f64],
) -> Option<Vec<Vec<Vector2<f64>>>> {
    let (amplitudes, _) = rigid_part(model, system, sparse, velocities);
    let mut rates = of_corners(model, &amplitudes);
    let largest = largest(&rates);
    rates.iter_mut().flatten().for_each(|rate| *rate /= largest);
    (largest > 0.0 && largest.is_finite()).then_some(rates)
}

/// Returns the rates of the corners of every block for amplitudes of the rigid motions, three per block.
pub(crate) fn of_corners(model: &Model, amplitudes: &[f64]) -> Vec<Vec<Vector2<f64>>> {
    let of_block = |(block, alpha): (&PlacedBlock, &[f64])| {
        let modes = Modes::of(&block.corners);
        block.corners.iter().map(|p| modes.displacement(*p, alpha)).collect()
    };
    model.blocks.iter().zip(amplitudes.chunks(3)).map(of_block).collect()
}

/// Returns the largest component of the rates.
pub(crate) fn largest(rates: &[Vec<Vector2<f64>>]) -> f64 {
    rates.iter().flatten().map(nalgebra::Matrix::amax).fold(0.0, f64::max)
}

/// Returns the mechanism for rigid amplitudes; `deformation` \[m\] is the largest part of the displacements that is
/// not rigid.
fn of_amplitudes(
    model: &Model,
    system: &System,
    amplitudes: &[f64],
    deformation: f64,
) -> Option<Vec<Vec<Vector2<f64>>>> {
    let power: f64 = system.resultants().iter().zip(amplitudes).map(|(f, rate)| f * rate).sum();
    if power <= 0.0 || !power.is_finite() {
        return None;
    }
    let mut rates = of_corners(model, amplitudes);
    let largest = largest(&rates);
    if deformation > LARGEST_DEFORMATION * largest {
        return None;
    }
    // Two blocks meet at a contact, and both may be deformed.
    let zero = STILL * largest + 3.0 * deformation;
    let closes = |(gap, contact): (f64, &JointPoint)| contact.gap <= 0.0 && gap < -zero;
    if system.gap_rates(amplitudes).into_iter().zip(&model.contacts).any(closes) {
        return None;
    }
    rates.iter_mut().flatten().for_each(|rate| *rate /= largest);
    Some(rates)
}

/// Returns the rigid motions nearest to the displacements, three amplitudes per block, and the largest remainder of
/// the displacements \[m\].
fn rigid_part(model: &Model, system: &System, sparse: &Sparse, u: &[f64]) -> (Vec<f64>, f64) {
    let mut amplitudes = Vec::with_capacity(3 * model.blocks.len());
    let mut rest = 0.0_f64;
    for (b, body) in system.bodies.iter().enumerate() {
        let u = sparse.of_block(b, u);
        if body.stiffness.is_none() {
            amplitudes.extend(u);
            continue;
        }
        let places = displaced_nodes(model, BlockId::new(b));
        let moved: Vec<Vector2<f64>> =
            u.chunks_exact(2).map(|u| Vector2::new(u[0], u[1])).collect();
        let (alpha, deformation) = body.modes.nearest(places, &moved);
        rest = rest.max(deformation);
        amplitudes.extend(alpha);
    }
    (amplitudes, rest)
}
