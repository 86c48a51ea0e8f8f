//! The stiffness of dry joints between rigid blocks. Without a stiffness the distribution of forces is not determined.

use super::{Body, JointPoint, Model};

/// Stiffness of dry joints \[Pa/m\], perpendicular to the joint and along it. Block models of dry stone use 1e9 to
/// 1e10 Pa/m perpendicular to the joint and about half of this along it; see the review of J. V. Lemos, Discrete
/// element modeling of masonry structures, International Journal of Architectural Heritage 1 (2007),
/// [doi:10.1080/15583050601176868](https://doi.org/10.1080/15583050601176868).
pub const DRY_JOINT: [f64; 2] = [2e9, 1e9];

impl Model {
    /// Gives the stiffness [`DRY_JOINT`] to joints between rigid bodies that have neither a stiffness nor mortar.
    pub(crate) fn give_stiffness_to_dry_joints(&mut self) {
        let hard: Vec<bool> = self.contacts.iter().map(|point| self.is_hard(point)).collect();
        for (point, _) in self.contacts.iter_mut().zip(hard).filter(|(_, is_hard)| *is_hard) {
            point.compliance = DRY_JOINT.map(|k| 1.0 / (k * point.weight));
        }
    }

    /// Counts the joints that got the stiffness of dry joints because their class has none.
    pub fn dry_joints(&self) -> usize {
        let has_default = |point: &&JointPoint| {
            let class = &self.joint_classes[self.joints[point.joint.index()].class];
            class.law.stiffness.is_none() && point.compliance[0] > 0.0
        };
        let mut joints: Vec<_> = self.contacts.iter().filter(has_default).collect();
        joints.dedup_by_key(|point| point.joint);
        joints.len()
    }

    /// Returns the warning about joints that got the stiffness of dry joints; `None` if there are no such joints.
    pub(crate) fn of_dry_joints(&self) -> Option<String> {
        let [across, along] = DRY_JOINT;
        (self.dry_joints() > 0).then(|| {
            format!(
                "Joints between rigid blocks have the stiffness of dry ones, {across:.0e} Pa/m across and {along:.0e} Pa/m \
                 along: cracks and thrust depend on it. Give `stiffness` to their class if it is known."
            )
        })
    }

    /// Returns the advice to give joints a stiffness; `None` if a joint has a compliance.
    pub(crate) fn of_hard_joints(&self) -> Option<String> {
        let [across, along] = DRY_JOINT;
        let is_hard = |point: &JointPoint| point.gives().iter().all(|c| *c <= 0.0);
        (!self.contacts.is_empty() && self.contacts.iter().all(is_hard)).then(|| {
            format!(
                "The joints do not give way at all, which makes steps hard to solve. Dry ones have about {across:.0e} Pa/m \
                 across and {along:.0e} Pa/m along: give `stiffness` to their class."
            )
        })
    }

    /// Returns whether neither the joint nor the bodies on its two sides can deform.
    fn is_hard(&self, point: &JointPoint) -> bool {
        let joint = &self.joints[point.joint.index()];
        let is_rigid = |body: Body| match body {
            Body::Block(id) => self.blocks[id.index()].elasticity.is_none(),
            Body::Support(_) => true,
        };
        point.gives().iter().all(|c| *c <= 0.0)
            && is_rigid(Body::Block(joint.b))
            && is_rigid(joint.a)
    }
}
