//! Scenes of the repository and joints found by their place.

use std::path::Path;

use masonry::model::Joint;
use masonry::outcome::{ContactState, Outcome};
use masonry::scene::Scene;

pub fn scene(name: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    Scene::read(&folder.join(name).with_extension("toml")).unwrap()
}

pub fn solved(name: &str) -> Outcome {
    super::solved(&scene(name))
}

/// Ends of the step of the staircase on top of a course: half a brick further in every course,
/// from the inner end of a foot of one brick.
pub fn stair(length: f64, course: u8) -> [f64; 2] {
    let from = length + 0.5 * length * (f64::from(course) - 1.0);
    [from, from + 0.5 * length]
}

/// States of the points of the bed joint between `from` and `to` on top of a course.
pub fn bed_joint(outcome: &Outcome, from: f64, to: f64, course: u8) -> Vec<ContactState> {
    let level = 0.1 * f64::from(course);
    let found = joint(outcome, |joint| {
        let (left, right) = (joint.from.x.min(joint.to.x), joint.from.x.max(joint.to.x));
        let height = (joint.from.y - level).abs() + (joint.to.y - level).abs();
        height + (left - from).abs() + (right - to).abs() < 1e-9
    });
    found.into_iter().map(|(_, state)| state).collect()
}

/// Heights and states of the points of the head joint at `x` in a course.
pub fn head_joint(outcome: &Outcome, x: f64, course: u8) -> Vec<(f64, ContactState)> {
    let middle = 0.1 * f64::from(course) - 0.05;
    joint(outcome, |joint| {
        let height = 0.5 * (joint.from.y + joint.to.y) - middle;
        (joint.from.x - x).abs() + (joint.to.x - x).abs() + height.abs() < 1e-9
    })
}

fn joint(outcome: &Outcome, is_it: impl Fn(&Joint) -> bool) -> Vec<(f64, ContactState)> {
    let wanted = outcome.model.joints.iter().position(is_it).unwrap();
    let points = outcome.model.contacts.iter().zip(&outcome.state.as_ref().unwrap().contacts);
    points
        .filter(|(contact, _)| contact.joint.index() == wanted)
        .map(|(contact, state)| (contact.position.y, *state))
        .collect()
}

/// Mean of the compressive principal stress \[Pa\] of the elements between two abscissas in a course.
pub fn mean_compression(outcome: &Outcome, [from, to]: [f64; 2], course: u8) -> f64 {
    let middle = 0.1 * f64::from(course) - 0.05;
    let stresses = outcome.state.as_ref().unwrap().stresses.iter();
    let found: Vec<f64> = stresses
        .filter(|s| s.centre.x > from && s.centre.x < to && (s.centre.y - middle).abs() < 0.05)
        .map(|s| -s.principal.sigma_2)
        .collect();
    assert!(!found.is_empty());
    found.iter().sum::<f64>() / found.len() as f64
}
