//! Ranges of the reactions over all sets of admissible forces.

use std::cell::Cell;
use std::ops::ControlFlow;

use lcp::{Iteration, Observer};
use nalgebra::Vector2;

use super::{LimitError, rigid};
use crate::data::statics::Extreme;
use crate::data::statics::Statics;
use crate::method::statics;
use crate::method::statics::limit::extreme;
use crate::model::{Body, Model};
use crate::scene::Scene;
use crate::system::System;

/// The least and the largest reactions of every support over all forces within friction that balance the loads, each
/// support for itself. Examples are the least and the largest thrust of an arch, as its supports spread or close.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Range {
    /// Title of the scene.
    pub title: String,
    /// The structure with rigid blocks under all loads in full.
    pub model: Model,
    /// The extreme reactions of every support, in the order of the scene; `None` if it is proved that no forces balance
    /// the loads.
    pub supports: Option<Vec<Extremes>>,
    /// Whether the observer ended the search early.
    pub is_interrupted: bool,
    /// The answer in sentences for engineers.
    pub sentence: String,
}

/// The least and the largest reaction of a support.
#[derive(Debug, Clone, PartialEq)]
pub struct Extremes {
    /// Name of the support.
    pub support: String,
    /// The least and the largest horizontal force on the structure \[N\].
    pub fx: [Extreme; 2],
    /// The least and the largest vertical force on the structure \[N\].
    pub fy: [Extreme; 2],
}

/// Computes the ranges of all reactions of a scene under its loads in full.
///
/// # Errors
/// [`LimitError`] when the scene is wrong.
pub fn ranges(scene: &Scene) -> Result<Range, LimitError> {
    ranges_observed(scene, &mut |_| ControlFlow::Continue(()))
}

/// Computes the ranges of all reactions, with an observer of all iterations that may end the search by `Break`.
/// Extremes that were not found by then are [`Extreme::Open`], or values with a bound further away.
///
/// ```
/// use std::ops::ControlFlow;
/// use masonry::Scene;
/// let scene = Scene::from_toml(include_str!("../../../../scenes/arch_semicircular.toml"))?;
/// let range = masonry::ranges_observed(&scene, &mut |_| ControlFlow::Break(()))?;
/// assert!(range.is_interrupted && range.sentence.starts_with("Interrupted. "));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As [`ranges`].
pub fn ranges_observed(scene: &Scene, observer: &mut Observer<'_>) -> Result<Range, LimitError> {
    let is_interrupted = Cell::new(false);
    let on = &mut |at: &Iteration| {
        is_interrupted.set(is_interrupted.get() || observer(at).is_break());
        if is_interrupted.get() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    scene.check_single()?;
    let model = rigid(Model::from_scene(scene)?);
    let system = System::without_factors(&model)?;
    let title = scene.title.clone();
    if let Statics::Impossible(_) = statics::decide(&model, &system, on)?.statics {
        let sentence = "The structure falls: no forces within friction balance all loads of the scene in full (proved).";
        let sentence = sentence.to_owned();
        let is_interrupted = is_interrupted.get();
        return Ok(Range { title, model, supports: None, is_interrupted, sentence });
    }
    let mut supports = Vec::with_capacity(model.supports.len());
    for (k, support) in model.supports.iter().enumerate() {
        let mut extremes = |along: Vector2<f64>| -> Result<[Extreme; 2], LimitError> {
            if is_interrupted.get() {
                return Ok([Extreme::Open; 2]);
            }
            // The unknowns of the system are forces plus the tensile strengths of the contacts.
            let (rows, beyond) = component(&model, &system, k, along);
            let opposite: Vec<f64> = rows.iter().map(|row| -row).collect();
            let least = negated(extreme(&system, &opposite, on)?);
            Ok([least, extreme(&system, &rows, on)?].map(|it| shifted(it, -beyond)))
        };
        let [fx, fy] = [extremes(Vector2::x())?, extremes(Vector2::y())?];
        supports.push(Extremes { support: support.name.clone(), fx, fy });
    }
    let sentence = "Reactions lie between the least and the largest that forces within friction allow. Each end of a range \
                    is reached by some forces within friction; all ends are not reached at once.";
    let is_interrupted = is_interrupted.get();
    let sentence =
        if is_interrupted { "Interrupted. Ends that were not found are open." } else { sentence };
    let sentence = sentence.to_owned();
    Ok(Range { title, model, supports: Some(supports), is_interrupted, sentence })
}

/// Returns a component of the reaction of a support as a linear function of the forces of all rows: the coefficients,
/// and the value of the function for the tensile strengths.
fn component(
    model: &Model,
    system: &System,
    support: usize,
    along: Vector2<f64>,
) -> (Vec<f64>, f64) {
    let mut beyond = 0.0;
    let rows = system.rows.iter().map(|row| {
        let joint = &model.joints[model.contacts[row.contact.index()].joint.index()];
        if !matches!(joint.a, Body::Support(id) if id.index() == support) {
            return 0.0;
        }
        let gain = row.direction.of(joint).dot(&along);
        beyond += row.tension * gain;
        gain
    });
    (rows.collect(), beyond)
}

fn negated(extreme: Extreme) -> Extreme {
    match extreme {
        Extreme::Value { value, bound } => Extreme::Value { value: -value, bound: -bound },
        other => other,
    }
}

fn shifted(extreme: Extreme, by: f64) -> Extreme {
    match extreme {
        Extreme::Value { value, bound } => Extreme::Value { value: value + by, bound: bound + by },
        other => other,
    }
}
