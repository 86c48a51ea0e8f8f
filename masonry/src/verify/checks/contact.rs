//! Comparison of gap, slip and force of a contact point with the law of its joint.

use super::bodies::Bodies;
use super::{Lengths, larger};
use crate::data::state::{PointState, State};
use crate::law::PointLaw;
use crate::model::{JointPoint, Model};
use crate::recover;

/// Gap, slip and forces of a contact point, and the law with which they are compared.
pub(super) struct Pair {
    /// The gap \[m\], computed from the displacements.
    pub(super) gap: f64,
    /// The slip in the step \[m\], computed from the displacements.
    pub(super) slip: f64,
    pub(super) t_n: f64,
    pub(super) t_t: f64,
    /// Initial gap `x_0` and initial slip `s_0` \[m\].
    pub(super) initial: [f64; 2],
    law: PointLaw,
    /// The indices of the blocks that meet at the point.
    blocks: Vec<usize>,
}

impl Pair {
    pub(super) fn of(model: &Model, state: &State, contact: &JointPoint, it: &PointState) -> Self {
        // The compression of the joint is added: faces under pressure come nearer than at first, which is not a
        // negative gap.
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

    /// Returns the distance of the force outside of its cone \[-\]: tension beyond the tensile strength, or force
    /// along the joint beyond its bound.
    pub(super) fn outside_cone(&self, bodies: &Bodies) -> f64 {
        let pull = bodies.share(&self.blocks, -self.law.tension - self.t_n);
        let violation = self.law.violation(self.t_n, self.t_t);
        larger(pull, bodies.share(&self.blocks, violation / self.sensitivity()))
    }

    /// Returns the depth by which the sides penetrate one another, relative to the lengths of their blocks \[-\].
    pub(super) fn inside(&self, lengths: &Lengths) -> f64 {
        lengths.share(&self.blocks, -self.gap)
    }

    /// Returns the violation of complementarity \[-\]: a force across an open gap, or sliding under a force other than
    /// the bound against the slip.
    pub(super) fn against_law(&self, bodies: &Bodies, lengths: &Lengths) -> f64 {
        let length = |part: f64| lengths.share(&self.blocks, part);
        let force = |part: f64| bodies.share(&self.blocks, part);
        let across = smaller(length(self.gap), force(self.t_n + self.law.tension));
        let wanted = -self.law.bound(self.t_n) * self.slip.signum();
        let error = (self.t_t - wanted).abs() / self.sensitivity();
        larger(across, smaller(length(self.slip.abs()), force(error)))
    }

    /// Returns the factor by which the bound of friction magnifies errors of the normal force \[-\].
    fn sensitivity(&self) -> f64 {
        self.law.cone().sensitivity()
    }
}

/// Returns the smaller of two numbers; infinity if one of them is NaN.
fn smaller(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.min(b) }
}
