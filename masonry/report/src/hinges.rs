//! Joints of a mechanism that turn about a hinge, slide, or come apart.

use nalgebra::{Point2, Vector2};

use masonry::ids::JointId;
use masonry::model::{Anchor, Model};
use masonry::rounding::largest;

/// Joints whose rate is below this part of the largest rate of a joint count as closed. Chosen: hardly seen in a
/// picture, and above the motion that springs in joints add.
const STILL: f64 = 1e-2;
/// Relative difference between the opening of a joint and the opening by associated flow up to which the two count as
/// equal. Chosen: far above rounding errors.
const AS_LIFTED: f64 = 1e-6;

/// Behaviour of a joint in a mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Yield {
    /// The joint opens about a point that stays closed.
    Hinge,
    /// The sides touch and slide on each other.
    Slides,
    /// The sides come apart at all contact points.
    Opens,
}

impl Yield {
    /// Returns the word for the behaviour: `hinge`, `slides`, `opens`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hinge => "hinge",
            Self::Slides => "slides",
            Self::Opens => "opens",
        }
    }
}

/// A joint of a mechanism that yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldingJoint {
    /// The joint that yields.
    pub joint: JointId,
    /// The behaviour of the joint.
    pub does: Yield,
    /// The middle of the contact points at which the sides touch, or of all contact points if the sides come apart
    /// \[m\].
    pub at: Point2<f64>,
    /// The displacement rate at `at`: the mean of both sides.
    pub rate: Vector2<f64>,
    /// The largest rate of opening, relative to the fastest joint.
    pub opens: f64,
    /// The largest rate of sliding, relative to the fastest joint.
    pub slides: f64,
    /// Whether the joint dilates by associated flow: it slides, and opens by `mu` times the slip rate, so that no force
    /// inside the friction cone does positive work.
    pub dilates: bool,
    /// The number of the joint in pictures and tables, from one; `None` if the sides come apart, since pictures do not
    /// mark such joints.
    pub number: Option<usize>,
}

/// Rates of opening and sliding at a contact point.
struct PointRate {
    at: Point2<f64>,
    mean: Vector2<f64>,
    opens: f64,
    slides: f64,
    /// The rate of opening by associated flow, `mu` times the slip rate; the sides count as touching up to this rate.
    lifts: f64,
}

/// Returns the joints that yield in a mechanism, in the order of the joints; `rates` are the displacement rates of the
/// corners of all blocks.
pub fn yielding(model: &Model, rates: &[Vec<Vector2<f64>>]) -> Vec<YieldingJoint> {
    let mut of_joints: Vec<Vec<PointRate>> = model.joints.iter().map(|_| Vec::new()).collect();
    for contact in &model.contacts {
        let joint = &model.joints[contact.joint.index()];
        let front = rate_at(rates, contact.b);
        let behind = contact.a.map_or_else(Vector2::zeros, |anchor| rate_at(rates, anchor));
        let apart = front - behind;
        let slides = apart.dot(&joint.tangent()).abs();
        of_joints[contact.joint.index()].push(PointRate {
            at: contact.position,
            mean: 0.5 * (front + behind),
            opens: apart.dot(&joint.normal).max(0.0),
            slides,
            lifts: contact.law.cone().lift(slides),
        });
    }
    let fastest = largest(of_joints.iter().flatten().map(|it| it.opens.max(it.slides)));
    let joints = of_joints.iter().enumerate();
    let of_joint =
        |(index, points): (usize, &Vec<_>)| of_joint(JointId::new(index), points, fastest);
    let mut list: Vec<YieldingJoint> = joints.filter_map(of_joint).collect();
    let marked = list.iter_mut().filter(|it| it.does != Yield::Opens);
    (1..).zip(marked).for_each(|(number, it)| it.number = Some(number));
    list
}

/// Returns the behaviour of the joint with the contact points `points`; `None` if all rates are negligible beside
/// `fastest`, the largest rate of all joints.
fn of_joint(joint: JointId, points: &[PointRate], fastest: f64) -> Option<YieldingJoint> {
    let still = STILL * fastest;
    let opens = largest(points.iter().map(|it| it.opens));
    let slides = largest(points.iter().map(|it| it.slides));
    if opens.max(slides) <= still || fastest <= 0.0 {
        return None;
    }
    let touching: Vec<&PointRate> =
        points.iter().filter(|it| it.opens <= it.lifts + still).collect();
    let does = if touching.is_empty() {
        Yield::Opens
    } else if touching.iter().any(|it| it.slides > still) {
        Yield::Slides
    } else {
        Yield::Hinge
    };
    let places = if touching.is_empty() { points.iter().collect() } else { touching };
    let share = 1.0 / places.len() as f64;
    let at: Vector2<f64> = places.iter().map(|it| it.at.coords * share).sum();
    let rate: Vector2<f64> = places.iter().map(|it| it.mean * share).sum();
    let (opens, slides) = (opens / fastest, slides / fastest);
    let follows = |it: &PointRate| (it.opens - it.lifts).abs() <= AS_LIFTED * it.lifts;
    let dilates = points.iter().any(|it| it.lifts > still && follows(it));
    let at = Point2::from(at);
    Some(YieldingJoint { joint, does, at, rate, opens, slides, dilates, number: None })
}

fn rate_at(rates: &[Vec<Vector2<f64>>], anchor: Anchor) -> Vector2<f64> {
    let corners = &rates[anchor.block.index()];
    let next = (anchor.edge + 1) % corners.len();
    corners[anchor.edge] * (1.0 - anchor.at) + corners[next] * anchor.at
}
