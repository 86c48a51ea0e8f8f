//! Attributes by which a script on a page identifies an element of a picture, and finds the element in another picture
//! of the same structure: names and numbers as users know them.

use super::canvas::escape;
use crate::format::body_name;
use masonry::ids::{JointId, LoadId};
use masonry::model::{Body, Model, PlacedBlock, PlacedSupport};

/// Returns `data-block`: the name of a block.
pub(super) fn block(block: &PlacedBlock) -> String {
    format!("data-block=\"{}\"", escape(&block.name))
}

/// Returns `data-support`: the name of a support.
pub(super) fn support(support: &PlacedSupport) -> String {
    format!("data-support=\"{}\"", escape(&support.name))
}

/// Returns `data-joint`: the number of a joint, from one, as in tables.
pub(super) fn number(id: JointId) -> String {
    format!("data-joint=\"{}\"", id.index() + 1)
}

/// Returns the number of a joint, with `data-class`, the name of its class, and `data-a` and `data-b`, the names of the
/// bodies behind and in front of the joint.
pub(super) fn joint(model: &Model, id: JointId) -> String {
    let joint = &model.joints[id.index()];
    let class = escape(model.joint_classes.get(joint.class).map_or("", |class| &class.name));
    let [a, b] = [joint.a, Body::Block(joint.b)].map(|body| escape(body_name(model, body)));
    format!("{} data-class=\"{class}\" data-a=\"{a}\" data-b=\"{b}\"", number(id))
}

/// Returns `data-load`: the number of a load in the scene, from one; and `data-name`: the name of the load.
pub(super) fn load(model: &Model, id: LoadId) -> String {
    let name = model.loads.get(id.index()).map_or("", |load| &load.name);
    format!("data-load=\"{}\" data-name=\"{}\"", id.index() + 1, escape(name))
}
