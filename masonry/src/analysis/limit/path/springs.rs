//! Springs in joints between rigid bodies, which alone would not say how forces are shared.

use nalgebra::Vector2;

use crate::model::{Body, ContactPoint, Joint, Model};

/// Stiffness of blocks without elastic constants, relative to those that have some, or to the stress that all loads make on
/// a square of their thickness. Chosen: displacements are small beside blocks, and digits remain.
const STIFF: f64 = 1e6;
/// Compliance in shear by that in compression. Theory: `E / G` for a Poisson's ratio of zero.
const SHEAR: f64 = 2.0;

/// Puts springs into all joints between rigid bodies that do not give way by themselves: what half of both blocks would
/// give, if they were elastic. Gives the number of these joints.
pub(super) fn put_into(model: &mut Model, load: f64) -> usize {
    let young = young(model, load);
    let of_point = |contact: &ContactPoint| compliance(model, contact, young);
    let compliances: Vec<Option<f64>> = model.contacts.iter().map(of_point).collect();
    let mut joints = Vec::new();
    for (contact, compliance) in model.contacts.iter_mut().zip(compliances) {
        let Some(compliance) = compliance else { continue };
        joints.push(contact.joint);
        contact.compliance = [compliance, SHEAR * compliance];
    }
    joints.dedup();
    joints.len()
}

/// Young's modulus \[Pa\] of blocks that have none.
fn young(model: &Model, load: f64) -> f64 {
    let given = model.blocks.iter().filter_map(|block| block.elasticity);
    let given = given.map(|elasticity| elasticity.young).fold(0.0, f64::max);
    let area = model.thickness * model.thickness;
    let by_load = if load > 0.0 { load / area } else { 1.0 };
    STIFF * if given > 0.0 { given } else { by_load }
}

/// Compression \[m/N\] of half of both blocks at a point; `None` where something gives already.
fn compliance(model: &Model, contact: &ContactPoint, young: f64) -> Option<f64> {
    let joint = &model.joints[contact.joint.index()];
    let is_elastic = |block: usize| model.blocks[block].elasticity.is_some();
    let behind = match joint.a {
        Body::Block(id) => Some(id.index()),
        Body::Support(_) => None,
    };
    let gives = contact.gives().into_iter().any(|c| c > 0.0);
    if gives || is_elastic(joint.b.index()) || behind.is_some_and(is_elastic) {
        return None;
    }
    let depth =
        depth(model, joint.b.index(), joint) + behind.map_or(0.0, |it| depth(model, it, joint));
    Some(0.5 * depth / (young * contact.weight))
}

/// How deep a block is along the normal of a joint \[m\].
fn depth(model: &Model, block: usize, joint: &Joint) -> f64 {
    let along = |normal: Vector2<f64>| {
        let places = model.blocks[block].corners.iter().map(move |p| p.coords.dot(&normal));
        places.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], at| {
            [least.min(at), most.max(at)]
        })
    };
    let [least, most] = along(joint.normal);
    most - least
}
