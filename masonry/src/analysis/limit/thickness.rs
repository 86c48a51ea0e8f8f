//! The least thickness of an arch.

use std::ops::ControlFlow;

use nalgebra::Vector2;

use super::watch::{LimitObserver, Watch};
use super::{LimitError, rigid};
use crate::data::state::PointState;
use crate::data::statics::Statics;
use crate::method::statics;
use crate::model::Model;
use crate::recover;
use crate::rounding::{BoundSide, outwards};
use crate::scene::{Known, Scene, SceneError};
use crate::system::System;

/// The search ends at this relative difference between the thicknesses on both sides of the least one.
const NEAR: f64 = 1e-6;
/// The number of times that a thickness is doubled or halved to find one that falls and one that stands.
const DOUBLED: u32 = 10;

/// The least thickness at which an arch stands, between one that falls and one that stands; the span and the rise of
/// its intrados and all other parts of the scene stay.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Thickness {
    /// Title of the scene.
    pub title: String,
    /// Name of the arch.
    pub arch: String,
    /// The thickness \[m\] in the scene.
    pub given: f64,
    /// The largest thickness \[m\] at which it is proved that the structure falls.
    pub falls: Option<f64>,
    /// The smallest thickness \[m\] at which forces were found that balance the loads.
    pub stands: Option<f64>,
    /// Whether `falls` and `stands` are so near to each other that they are one number.
    pub proved: bool,
    /// Whether the observer has ended the search.
    pub is_interrupted: bool,
    /// The structure that stands, or the structure of the scene if none stands.
    pub model: Model,
    /// The forces of the structure that stands, point by point; gaps and slips are zero.
    pub forces: Option<Vec<PointState>>,
    /// The mechanism at `falls`: rates of the corners of every block.
    pub mechanism: Option<Vec<Vec<Vector2<f64>>>>,
    /// The answer in the words of an engineer.
    pub sentence: String,
}

/// The least thickness of an arch under the loads of the scene in full.
///
/// # Errors
/// [`LimitError`] when the scene is wrong, or has no such arch. A thickness at which the scene is wrong ends the
/// search.
pub fn least_thickness(scene: &Scene, arch: &str) -> Result<Thickness, LimitError> {
    least_thickness_observed(scene, arch, &mut |_| ControlFlow::Continue(()))
}

/// The least thickness, with an observer that may end the search by `Break`.
///
/// # Errors
/// As [`least_thickness`].
pub fn least_thickness_observed<'a>(
    scene: &Scene,
    arch: &str,
    observer: &'a mut LimitObserver<'a>,
) -> Result<Thickness, LimitError> {
    scene.check()?;
    scene.check_single()?;
    let Some(place) = scene.arches.iter().position(|it| it.name == arch) else {
        let names = scene.arches.iter().map(|it| it.name.clone()).collect();
        let (name, known) = (arch.to_owned(), Known::near(arch, names));
        return Err(LimitError::NoArch { name, known });
    };
    let Some(given) = scene.arches[place].thickness else {
        return Err(LimitError::NoThickness { name: arch.to_owned() });
    };
    let watch = Watch::new(observer);
    let mut search =
        Bisection { scene: scene.clone(), place, watch, falls: None, stands: None, unfit: None };
    search.run(given)?;
    search.finish(arch, given)
}

/// A search between two thicknesses, in units of the scene.
struct Bisection<'a> {
    scene: Scene,
    place: usize,
    watch: Watch<'a>,
    falls: Option<(f64, Vec<Vec<Vector2<f64>>>)>,
    stands: Option<(f64, Model, Vec<PointState>)>,
    /// The thickness that does not fit into the rest of the scene, and the error.
    unfit: Option<(f64, SceneError)>,
}

impl Bisection<'_> {
    fn run(&mut self, given: f64) -> Result<(), LimitError> {
        self.tried(given)?;
        let factor = if self.stands.is_some() { 0.5 } else { 2.0 };
        let mut next = given;
        for _ in 0..DOUBLED {
            if self.falls.is_some() == self.stands.is_some() {
                break;
            }
            next *= factor;
            if !self.tried(next)? {
                return Ok(());
            }
        }
        while let (Some((falls, _)), Some((stands, ..))) = (&self.falls, &self.stands) {
            let (falls, stands) = (*falls, *stands);
            if stands - falls <= NEAR * stands || !self.tried(0.5 * (falls + stands))? {
                break;
            }
        }
        Ok(())
    }

    /// Tries a thickness; whether the arch was found to stand or to fall.
    fn tried(&mut self, thickness: f64) -> Result<bool, LimitError> {
        if self.watch.ask().is_break() {
            return Ok(false);
        }
        self.scene.arches[self.place].thickness = Some(thickness);
        // An arch that no longer fits into the rest of the scene, such as below a load, ends the search.
        let model = match Model::from_scene(&self.scene) {
            Err(error) if self.falls.is_some() || self.stands.is_some() => {
                self.unfit = Some((thickness, error));
                return Ok(false);
            }
            model => rigid(model?),
        };
        let system = System::without_factors(&model)?;
        let unit = self.scene.units.length_to_si();
        let decision = statics::decide(&model, &system, &mut self.watch.steps())?;
        match decision.statics {
            Statics::Admissible(rows) => {
                let forces = recover::forces_at_rest(&model, &rows);
                self.watch.known.stands = Some(thickness * unit);
                self.stands = Some((thickness, model, forces));
            }
            Statics::Impossible(proof) => {
                self.watch.known.falls = Some(thickness * unit);
                self.falls = Some((thickness, proof.rates));
            }
            Statics::Open => return Ok(false),
        }
        Ok(true)
    }

    fn finish(mut self, arch: &str, given: f64) -> Result<Thickness, LimitError> {
        let unit = self.scene.units.length_to_si();
        let name = self.scene.units.length_name();
        let falls = self.falls.as_ref().map(|(thickness, _)| *thickness);
        let stands = self.stands.as_ref().map(|(thickness, ..)| *thickness);
        let proved =
            falls.zip(stands).is_some_and(|(falls, stands)| stands - falls <= NEAR * stands);
        let is_interrupted = self.watch.is_ended;
        let length = |it: f64, side| outwards(it, side, |it| format!("{it:.6}"));
        let (thinner, thicker) = (
            falls.map(|it| length(it, BoundSide::Below)),
            stands.map(|it| length(it, BoundSide::Above)),
        );
        let sentence = match (thinner, thicker) {
            (Some(falls), Some(stands)) if proved => format!(
                "Arch \"{arch}\" needs a thickness of {stands} {name}: forces within friction balance the loads \
                 at this thickness, and no forces do at {falls} {name} (proved)."
            ),
            (Some(falls), Some(stands)) => format!(
                "Arch \"{arch}\" stands at a thickness of {stands} {name}, and falls at {falls} {name} \
                 (proved); thicknesses between {falls} and {stands} {name} are undecided."
            ),
            (Some(falls), None) => format!(
                "Arch \"{arch}\" stands at none of the thicknesses that were tried, up to {falls} {name}, under \
                 all loads of the scene (proved)."
            ),
            (None, Some(stands)) => format!(
                "Arch \"{arch}\" stands at all thicknesses that were tried, down to {stands} {name}."
            ),
            (None, None) => format!("Undecided: it is not known whether arch \"{arch}\" stands."),
        };
        let sentence = match &self.unfit {
            Some((thickness, error)) => {
                format!(
                    "{sentence} A thickness of {thickness:.6} {name} does not fit into the scene: {error}."
                )
            }
            None => sentence,
        };
        let sentence = if is_interrupted { format!("Interrupted. {sentence}") } else { sentence };
        let mechanism = self.falls.take().map(|(_, rates)| rates);
        let (model, forces) = if let Some((_, model, forces)) = self.stands.take() {
            (model, Some(forces))
        } else {
            self.scene.arches[self.place].thickness = Some(given);
            (rigid(Model::from_scene(&self.scene)?), None)
        };
        Ok(Thickness {
            title: self.scene.title,
            arch: arch.to_owned(),
            given: given * unit,
            falls: falls.map(|it| it * unit),
            stands: stands.map(|it| it * unit),
            proved,
            is_interrupted,
            model,
            forces,
            mechanism,
            sentence,
        })
    }
}
