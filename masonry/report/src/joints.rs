//! The resultant force in every joint, the used part of its friction, and its opening.

use nalgebra::{Point2, Vector2};

use masonry::data::state::PointState;
use masonry::ids::{JointId, SupportId};
use masonry::model::{Body, Model, PlacedJoint};
use masonry::recover;
use masonry::rounding::largest;

/// Forces below this part of the largest force count as rounding errors.
const NO_FORCE: f64 = 1e-9;
/// Openings and slips below this part of the size of the structure are rounding errors.
const NO_WIDTH: f64 = 1e-9;

/// A reaction counts as acting on its support up to this distance beyond the ends, in lengths of the support.
const BESIDE: f64 = 1e-6;

/// The resultant of the contact forces of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointForce {
    /// The joint in which the force acts.
    pub joint: JointId,
    /// The place at which the line of the resultant crosses the joint \[m\].
    pub at: Point2<f64>,
    /// The resultant force on the body in front of the joint \[N\].
    pub force: Vector2<f64>,
    /// The component of the force perpendicular to the joint \[N\], compression positive.
    pub normal: f64,
    /// The component of the force along the joint \[N\].
    pub tangential: f64,
    /// Distance of `at` from the middle of the joint, divided by the length of the joint: `-0.5` and `0.5` at the ends,
    /// above 1/6 in size outside the middle third.
    pub eccentricity: f64,
    /// The used part of the friction, `|T| / (mu N + c A)`: one if all contact points slide; `None` if the joint has no
    /// resistance to sliding.
    pub utilisation: Option<f64>,
}

/// Returns the resultants of all joints with a normal force, in the order of the joints.
pub fn forces(model: &Model, contacts: &[PointState]) -> Vec<JointForce> {
    /// Force; then normal component, tangential component, moment about the start of the joint, and resistance to
    /// sliding.
    type Sum = (Vector2<f64>, [f64; 4]);
    let mut sums: Vec<Sum> = vec![(Vector2::zeros(), [0.0; 4]); model.joints.len()];
    for (contact, state) in model.contacts.iter().zip(contacts) {
        let joint = &model.joints[contact.joint.index()];
        let along = (contact.position - joint.from).dot(&joint.tangent());
        let (force, parts) = &mut sums[contact.joint.index()];
        *force += recover::contact_force(model, contact, state);
        let bound = contact.law.bound(state.t_n);
        for (sum, part) in parts.iter_mut().zip([state.t_n, state.t_t, state.t_n * along, bound]) {
            *sum += part;
        }
    }
    let largest = largest(sums.iter().map(|(force, _)| force.norm()));
    let placed = |(index, (joint, (force, parts))): (usize, (&PlacedJoint, Sum))| {
        let [normal, tangential, moment, bound] = parts;
        if normal == 0.0 || normal.abs() <= NO_FORCE * largest {
            return None;
        }
        let (start, end) = (0.0, (joint.to - joint.from).dot(&joint.tangent()));
        let along = moment / normal;
        let least = f64::EPSILON * largest;
        Some(JointForce {
            joint: JointId::new(index),
            at: joint.from + joint.tangent() * along,
            force,
            normal,
            tangential,
            eccentricity: (along - 0.5 * (start + end)) / joint.length(),
            utilisation: (bound > least).then(|| tangential.abs() / bound),
        })
    };
    model.joints.iter().zip(sums).enumerate().filter_map(placed).collect()
}

/// A line from a joint to the middle of the joint forces on a block: a piece of the line of thrust.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForcePath {
    /// The point in the joint, and the middle of the joint forces on the block \[m\].
    pub ends: [Point2<f64>; 2],
    /// The size of the force in the joint \[N\].
    pub force: f64,
}

/// Finds the lines from joints to the middle of the joint forces on a block, for every block on which two joints or
/// more press. In an arch these lines form the line of thrust.
pub fn paths<'a>(
    model: &Model,
    forces: impl IntoIterator<Item = &'a JointForce>,
) -> Vec<ForcePath> {
    let mut of_blocks: Vec<Vec<&JointForce>> = vec![Vec::new(); model.blocks.len()];
    for it in forces.into_iter().filter(|it| it.normal > 0.0) {
        let joint = &model.joints[it.joint.index()];
        of_blocks[joint.b.index()].push(it);
        if let Body::Block(a) = joint.a {
            of_blocks[a.index()].push(it);
        }
    }
    of_blocks.retain(|own| own.len() > 1);
    let of_block = |own: Vec<&'a JointForce>| {
        let sum: f64 = own.iter().map(|it| it.force.norm()).sum();
        let share = |it: &&JointForce| it.at.coords * (it.force.norm() / sum);
        let middle = Point2::from(own.iter().map(share).sum::<Vector2<f64>>());
        let path =
            move |it: &JointForce| ForcePath { ends: [it.at, middle], force: it.force.norm() };
        own.into_iter().map(path).collect::<Vec<_>>()
    };
    of_blocks.into_iter().flat_map(of_block).collect()
}

/// The reaction of a support: its line of action and its force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SupportForce {
    /// The support that has the reaction.
    pub support: SupportId,
    /// A point of the line of action of the reaction \[m\].
    pub at: Point2<f64>,
    /// The force of the support on the structure \[N\].
    pub force: Vector2<f64>,
}

/// Returns the reactions of all supports with a normal force, except reactions whose line of action misses the support.
pub fn reactions(model: &Model, forces: &[JointForce]) -> Vec<SupportForce> {
    let of = |index: usize| {
        let support = SupportId::new(index);
        let own = |it: &&JointForce| model.joints[it.joint.index()].a == Body::Support(support);
        let own: Vec<&JointForce> = forces.iter().filter(own).collect();
        let normal: f64 = own.iter().map(|it| it.normal).sum();
        let moment: Vector2<f64> = own.iter().map(|it| it.at.coords * it.normal).sum();
        let force: Vector2<f64> = own.iter().map(|it| it.force).sum();
        let at = (normal != 0.0).then(|| Point2::from(moment / normal))?;
        let [from, to] = [model.supports[index].from, model.supports[index].to];
        let is_on = (at - from).dot(&(to - from)) >= -BESIDE * (to - from).norm_squared()
            && (at - to).dot(&(from - to)) >= -BESIDE * (to - from).norm_squared();
        is_on.then_some(SupportForce { support, at, force })
    };
    (0..model.supports.len()).filter_map(of).collect()
}

/// The opening and the slip of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct JointOpening {
    /// The joint that is open or has slid.
    pub joint: JointId,
    /// Distance along the joint from its start, and opening at that distance \[m\], for every contact point.
    pub widths: Vec<[f64; 2]>,
    /// The largest opening of the joint \[m\].
    pub widest: f64,
    /// The largest slip of closed contact points, as an absolute value \[m\].
    pub slip: f64,
}

/// Returns the openings of all joints that are open or have slid at some contact point.
pub fn openings(model: &Model, contacts: &[PointState]) -> Vec<JointOpening> {
    let none = NO_WIDTH * size(model);
    let mut openings: Vec<JointOpening> = (0..model.joints.len())
        .map(|index| JointOpening {
            joint: JointId::new(index),
            widths: Vec::new(),
            widest: 0.0,
            slip: 0.0,
        })
        .collect();
    for (contact, state) in model.contacts.iter().zip(contacts) {
        let joint = &model.joints[contact.joint.index()];
        let opening = &mut openings[contact.joint.index()];
        let along = (contact.position - joint.from).dot(&(joint.to - joint.from).normalize());
        // Rounding errors are set to zero.
        let [width, slip] = [state.y_n, state.y_t.abs()].map(|it| if it > none { it } else { 0.0 });
        opening.widths.push([along, width]);
        opening.widest = opening.widest.max(width);
        // Points whose sides are apart have no slip.
        opening.slip = opening.slip.max(if width > 0.0 { 0.0 } else { slip });
    }
    openings.retain(|it| it.widest > 0.0 || it.slip > 0.0);
    for opening in &mut openings {
        opening.widths.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    openings
}

/// Returns the diagonal of the box around all blocks \[m\].
fn size(model: &Model) -> f64 {
    let corners = || model.blocks.iter().flat_map(|block| &block.corners);
    let extent = |k: usize| {
        let of = || corners().map(move |corner| corner[k]);
        of().fold(f64::NEG_INFINITY, f64::max) - of().fold(f64::INFINITY, f64::min)
    };
    extent(0).hypot(extent(1)).max(0.0)
}
