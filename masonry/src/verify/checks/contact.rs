//! Gap, slip and force of a contact point, against the law of its joint.

use super::bodies::Bodies;
use super::{Lengths, larger};
use crate::data::state::{PointState, State};
use crate::law::PointLaw;
use crate::model::{JointPoint, Model};
use crate::recover;

/// Gap, slip and forces of a contact point, with the data for their comparison.
pub(super) struct Pair {
    /// The gap from the displacements \[m\].
    pub(super) gap: f64,
    /// The slip in the step, from the displacements \[m\].
    pub(super) slip: f64,
    pub(super) t_n: f64,
    pub(super) t_t: f64,
    /// `x_0` and `s_0` \[m\].
    pub(super) initial: [f64; 2],
    law: PointLaw,
    /// The blocks that meet.
    blocks: Vec<usize>,
}

impl Pair {
    pub(super) fn of(model: &Model, state: &State, contact: &JointPoint, it: &PointState) -> Self {
        // Faces that are pressed come nearer than at first, which is not a gap below zero.
        let [c_n, c_t] = contact.gives();
        let joint = &model.joints[contact.joint.index()];
        let apart = recover::relative_displacement(model, &state.displacements, contact);
        let gap = contact.gap + c_n * it.t_n + apart.dot(&joint.normal);
        let slip = contact.slip + c_t * it.t_t + apart.dot(&joint.tangent());
        let blocks = [Some(contact.b), contact.a].into_iter().flatten();
        Self {
            gap,
            slip,
            t_n: it.t_n,
            t_t: it.t_t,
            initial: [contact.gap, contact.slip],
            law: contact.law,
            blocks: blocks.map(|anchor| anchor.block.index()).collect(),
        }
    }

    /// Tension beyond the tensile strength, and force along the joint beyond its bound.
    pub(super) fn outside_cone(&self, bodies: &Bodies) -> f64 {
        let pull = bodies.share(&self.blocks, -self.law.tension - self.t_n);
        let violation = self.law.violation(self.t_n, self.t_t);
        larger(pull, bodies.share(&self.blocks, violation / self.sensitivity()))
    }

    /// The depth by which the sides penetrate one another.
    pub(super) fn inside(&self, lengths: &Lengths) -> f64 {
        lengths.share(&self.blocks, -self.gap)
    }

    /// Force across a gap, and sliding under a force other than the bound against it.
    pub(super) fn against_law(&self, bodies: &Bodies, lengths: &Lengths) -> f64 {
        let length = |part: f64| lengths.share(&self.blocks, part);
        let force = |part: f64| bodies.share(&self.blocks, part);
        let across = smaller(length(self.gap), force(self.t_n + self.law.tension));
        let wanted = -self.law.bound(self.t_n) * self.slip.signum();
        let error = (self.t_t - wanted).abs() / self.sensitivity();
        larger(across, smaller(length(self.slip.abs()), force(error)))
    }

    /// The factor by which the bound of friction magnifies errors of the normal force.
    fn sensitivity(&self) -> f64 {
        self.law.cone().sensitivity()
    }
}

/// The smaller number; NaN counts as an error.
fn smaller(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.min(b) }
}
