//! The proof that a structure falls, checked in its geometry.
//!
//! The proof is a motion of rigid blocks on which the loads do work, and no contact force can do negative work: every
//! contact opens by at least `mu` times its slip. Forces that balance the loads would do the opposite of the loads'
//! work, so that no such forces exist. If there are cohesion and tensile strength, the loads must do more work than
//! these take. The proof holds for any material, since no block is deformed, and for any gaps.

use nalgebra::{Point2, Vector2};

use crate::data::statics::Proof;
use crate::geometry;
use crate::ids::BlockId;
use crate::model::{Anchor, JointPoint, Model, PlacedBlock, PlacedForce};
use crate::recover;
use crate::system::rigid::Modes;

/// Least rounding error of velocities that is assumed, relative to the largest velocity.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Safety factor of the proof. The work on the motion must exceed the rounding error of the motion, times the sum of
/// all loads and strengths, by this factor. Contact forces could then balance the loads only if they were this many
/// times as large as that sum.
const CLEAR: f64 = 1e6;

impl Proof {
    /// Checks whether a motion, three amplitudes for every block ([`Modes`]), proves that no forces balance the loads;
    /// `None` if it does not.
    pub fn of(model: &Model, amplitudes: &[f64]) -> Option<Self> {
        let is_number = amplitudes.iter().all(|it| it.is_finite());
        if !is_number || amplitudes.len() != 3 * model.blocks.len() {
            return None;
        }
        let fastest = recover::largest(&recover::of_corners(model, amplitudes));
        if fastest <= 0.0 {
            return None;
        }
        let amplitudes: Vec<f64> = amplitudes.iter().map(|it| it / fastest).collect();
        let motion = RigidMotion::new(model, &amplitudes);
        let (mut work, mut total) = motion.work(model);
        let mut error = ROUNDING;
        for contact in &model.contacts {
            let [opens, slides] = motion.apart(model, contact);
            error = error.max(contact.law.cone().against(opens, slides));
            work -= contact.law.strength(opens, slides);
            total += contact.law.cohesion + contact.law.tension;
        }
        (total > 0.0 && work > CLEAR * error * total).then(|| {
            let rates = recover::of_corners(model, &amplitudes);
            Self { rates, work: work / total, error }
        })
    }
}

/// A motion of rigid blocks: the rigid modes of each block, and their amplitudes.
struct RigidMotion<'a> {
    blocks: Vec<(Modes, &'a [f64])>,
}

impl<'a> RigidMotion<'a> {
    fn new(model: &Model, amplitudes: &'a [f64]) -> Self {
        let modes = model.blocks.iter().map(|block| Modes::of(&block.corners));
        Self { blocks: modes.zip(amplitudes.chunks(3)).collect() }
    }

    fn at(&self, block: BlockId, place: Point2<f64>) -> Vector2<f64> {
        let (modes, amplitudes) = &self.blocks[block.index()];
        modes.displacement(place, amplitudes)
    }

    /// Returns the work of all loads on the motion, and the sum of the sizes of the loads.
    fn work(&self, model: &Model) -> (f64, f64) {
        let of_block = |(block, (modes, amplitudes)): (&PlacedBlock, &(Modes, &[f64]))| {
            let of_load = |load: &PlacedForce| {
                modes.work_of(load).iter().zip(*amplitudes).map(|(f, x)| f * x).sum::<f64>()
            };
            let loads = model.forces_on(block);
            loads.iter().map(|load| [of_load(load), load.size(modes.length)]).collect::<Vec<_>>()
        };
        let loads = model.blocks.iter().zip(&self.blocks).flat_map(of_block);
        loads.fold((0.0, 0.0), |(work, total), [of, size]| (work + of, total + size))
    }

    /// Returns the lengths by which a contact opens and slides in the motion.
    fn apart(&self, model: &Model, contact: &JointPoint) -> [f64; 2] {
        let joint = &model.joints[contact.joint.index()];
        let side = |Anchor { block, edge, at }: Anchor| {
            // The force of a film acts on both faces at the middle between them.
            let face = || geometry::on_edge(&model.blocks[block.index()].corners, edge, at);
            let place = contact.film.map_or_else(face, |_| contact.position);
            self.at(block, place)
        };
        let apart = side(contact.b) - contact.a.map_or_else(Vector2::zeros, side);
        [apart.dot(&joint.normal), apart.dot(&joint.tangent())]
    }
}
