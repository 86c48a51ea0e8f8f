//! Checks of joints, of their mortar, and of the bricks that it leaves room for.

use super::{Check, missing, not_negative, positive, unknown, unwanted, value};
use crate::scene::bond::{self, JointThickness};
use crate::scene::rules::{One, exactly_one};
use crate::scene::{Courses, Fault, Films, Joint, KeyPath, PointRule, Scene, SceneErrorKind, Wall};

/// A tensile strength that was computed from the cohesion may exceed its limit by this part.
const ROUNDING: f64 = 1e-12;

impl Scene {
    /// Thickness and material of the mortar: none, or both, the material elastic.
    pub(super) fn check_mortar(&self, at: &KeyPath, joint: &Joint) -> Check {
        let Some(thickness) = joint.thickness else {
            return match joint.material {
                Some(_) => {
                    let because = "has no meaning without `thickness`";
                    Err(unwanted(at, "material", because, ", or add `thickness`"))
                }
                None => Ok(()),
            };
        };
        not_negative(at.key("thickness"), thickness)?;
        if thickness > 0.0 {
            positive(at.key("thickness"), thickness)?;
        }
        let Some(name) = &joint.material else {
            let because = "because the joint has a thickness";
            let remedy = "material = \"mortar\"";
            return if thickness > 0.0 {
                Err(missing(at, "material", because, remedy))
            } else {
                Ok(())
            };
        };
        let Some(material) = self.materials.get(name) else {
            let known = self.materials.keys().cloned().collect();
            return Err(unknown(at.key("material"), "material", name, known, "materials"));
        };
        if thickness > 0.0 && material.young.is_none() {
            let because = "because the material is the mortar of a joint";
            return Err(missing(&KeyPath::of("materials").key(name), "E", because, "E = 1e6"));
        }
        Ok(())
    }

    /// Strips need Gauss points, and joints that may have mortar.
    pub(super) fn check_films(&self, at: &KeyPath) -> Check {
        if self.contact.films != Films::Strips {
            return Ok(());
        }
        let filled = self.joints.values().filter(|joint| joint.mortar_thickness() > 0.0);
        let mut rules = filled.map(|joint| joint.points.unwrap_or(self.contact.points));
        if self.contact.points != PointRule::Gauss || rules.any(|rule| rule != PointRule::Gauss) {
            let because = "has strips, which are integrated at Gauss points only";
            return Err(unwanted(at, "films", because, ", or set points = \"gauss\""));
        }
        if self.joints.values().all(|joint| joint.thickness.is_none()) {
            let because = "needs mortar for its strips, but no joint class has a thickness";
            let otherwise = ", or give a joint class `thickness` and `material`";
            return Err(unwanted(at, "films", because, otherwise));
        }
        Ok(())
    }
}

/// Friction, stiffness and strength.
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
    let Some(tension) = joint.tension else { return Ok(()) };
    not_negative(at.key("tension"), tension)?;
    let largest = cohesion / joint.friction();
    if joint.friction() * tension > cohesion * (1.0 + ROUNDING) {
        let kind = SceneErrorKind::TooMuchTension { tension, largest };
        return Err(Fault::new(at.key("tension"), kind));
    }
    Ok(())
}

/// Refuses bricks of which the head joints leave nothing.
pub(super) fn check_room(at: &KeyPath, wall: &Wall, joints: JointThickness) -> Check {
    if joints.head <= 0.0 {
        return Ok(());
    }
    let Some(thin) = bond::first_without_length(wall, joints) else { return Ok(()) };
    match &wall.courses {
        Courses::RunningBond(_) => {
            let wanted = "a course would end in a head joint and no brick: with joints of thickness \
                          t_y give a width of n (length + t_y) - t_y, or one with a longer last \
                          brick";
            let width = wall.width.unwrap_or(wall.brick.length);
            value(at.key("width"), width, false, wanted)
        }
        Courses::List(courses) => {
            let wanted = "the head joint leaves nothing of a brick of this length f: it measures \
                          f (length + t_y) - t_y, t_y being the thickness of the head joints";
            let [course, place] = thin;
            let key = at.key("courses").item(course).item(place);
            let length = courses.get(course).and_then(|it| it.get(place)).copied();
            value(key, length.unwrap_or_default(), false, wanted)
        }
    }
}
