//! Checks of joints, of their mortar, and of the length that mortar leaves for bricks.

use super::{Check, needed, not_negative, positive, unwanted, value};
use crate::scene::bond::{self, JointThickness};
use crate::scene::rules::{One, exactly_one};
use crate::scene::{Courses, Fault, Films, Joint, KeyPath, PointRule, Scene, SceneErrorKind, Wall};

/// Tolerance of the tensile strength \[-\]: a strength that was computed from the cohesion may exceed its limit by
/// this part.
const ROUNDING: f64 = 1e-12;

impl Scene {
    /// Checks thickness and material of the mortar: both or neither must be given, and the material must be elastic.
    pub(super) fn check_mortar(&self, at: &KeyPath, joint: &Joint) -> Check {
        let otherwise = ", or add `thickness`";
        let is_bare = joint.thickness.is_none() && joint.material.is_some();
        unwanted(is_bare, at, "material", "has no meaning without `thickness`", otherwise)?;
        let thickness = joint.mortar_thickness();
        not_negative(at.key("thickness"), thickness)?;
        let is_filled = thickness > 0.0;
        if is_filled {
            positive(at.key("thickness"), thickness)?;
            let because = "because the joint has a thickness";
            needed(joint.material.as_ref(), at, "material", because, "material = \"mortar\"")?;
        }
        let Some(name) = &joint.material else { return Ok(()) };
        let material = self.material_of(at, name)?;
        if is_filled {
            let because = "because the material is the mortar of a joint";
            needed(material.young, &KeyPath::of("materials").key(name), "E", because, "E = 1e6")?;
        }
        Ok(())
    }

    /// Checks that films as strips have Gauss points, and that joints may have mortar.
    pub(super) fn check_films(&self, at: &KeyPath) -> Check {
        if self.contact.films != Films::Strips {
            return Ok(());
        }
        let filled = self.joints.values().filter(|joint| joint.mortar_thickness() > 0.0);
        let mut rules = filled.map(|joint| joint.points.unwrap_or(self.contact.points));
        let is_other = |rule| rule != PointRule::Gauss;
        let has_other = is_other(self.contact.points) || rules.any(is_other);
        let because = "has strips, which are integrated at Gauss points only";
        unwanted(has_other, at, "films", because, ", or set points = \"gauss\"")?;
        let is_dry = self.joints.values().all(|joint| joint.thickness.is_none());
        let because = "needs mortar for its strips, but no joint class has a thickness";
        let otherwise = ", or give a joint class `thickness` and `material`";
        unwanted(is_dry, at, "films", because, otherwise)
    }
}

/// Checks friction, stiffness and strength.
pub(super) fn check_law(at: &KeyPath, joint: &Joint) -> Check {
    match exactly_one(at, "mu", joint.mu, "phi_deg", joint.phi_deg)? {
        One::First(mu) => not_negative(at.key("mu"), mu)?,
        One::Second(phi) => {
            let wanted = "the angle of friction is at least 0 and less than 90 degrees";
            value(at.key("phi_deg"), phi, (0.0..90.0).contains(&phi), wanted)?;
        }
    }
    for (k, stiffness) in joint.stiffness.into_iter().flatten().enumerate() {
        positive(at.key("stiffness").item(k), stiffness)?;
    }
    let cohesion = joint.cohesion.unwrap_or(0.0);
    not_negative(at.key("cohesion"), cohesion)?;
    let tension = joint.tension.unwrap_or(0.0);
    not_negative(at.key("tension"), tension)?;
    let largest = cohesion / joint.friction();
    if joint.friction() * tension > cohesion * (1.0 + ROUNDING) {
        let kind = SceneErrorKind::TooMuchTension { tension, largest };
        return Err(Fault::new(at.key("tension"), kind));
    }
    Ok(())
}

/// Refuses walls in which a brick has no length left between its head joints.
pub(super) fn check_room(at: &KeyPath, wall: &Wall, joints: JointThickness) -> Check {
    if joints.head <= 0.0 {
        return Ok(());
    }
    let Some([course, place]) = bond::first_without_length(wall, joints) else { return Ok(()) };
    let (at, length, wanted) = match &wall.courses {
        Courses::RunningBond(_) => (
            at.key("width"),
            wall.width_given().unwrap_or(wall.brick.length),
            "a course would end in a head joint and no brick: with head joints of thickness t_y give a width of n (length + \
             t_y) - t_y, or one with a longer last brick",
        ),
        Courses::List(courses) => (
            at.key("courses").item(course).item(place),
            courses[course][place],
            "the head joint leaves nothing of a brick of this length f: it measures f (length + t_y) - t_y, and \
             t_y is the thickness of the head joints",
        ),
    };
    value(at, length, false, wanted)
}
