//! The least thickness at which an arch stands.

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

/// Relative difference, between a thickness at which the arch falls and one at which it stands, at which the search
/// ends.
const NEAR: f64 = 1e-6;
/// The number of times that the thickness is doubled or halved to find one at which the arch falls and one at which it
/// stands.
const DOUBLED: u32 = 10;

/// The least thickness at which an arch stands, between a thickness at which it falls and one at which it stands. The
/// span and the rise of its intrados and all other parts of the scene do not change.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Thickness {
    /// Title of the scene.
    pub title: String,
    /// Name of the arch.
    pub arch: String,
    /// The thickness \[m\] in the scene.
    pub given: f64,
    /// The largest thickness \[m\] at which it is proved that the structure falls; `None` if no such thickness was
    /// found.
    pub falls: Option<f64>,
    /// The smallest thickness \[m\] at which forces were found that balance the loads; `None` if no such thickness was
    /// found.
    pub stands: Option<f64>,
    /// Whether `falls` and `stands` are so near to each other that they count as one number.
    pub proved: bool,
    /// Whether the observer ended the search early.
    pub is_interrupted: bool,
    /// The structure with the thickness `stands`, or with the thickness in the scene if there is none.
    pub model: Model,
    /// The forces at all contact points for the thickness `stands`; gaps and slips are zero.
    pub forces: Option<Vec<PointState>>,
    /// The mechanism for the thickness `falls`: displacement rates of the corners of every block.
    pub mechanism: Option<Vec<Vec<Vector2<f64>>>>,
    /// The answer in sentences for engineers.
    pub sentence: String,
}

/// Computes the least thickness of an arch under the loads of the scene in full.
///
/// # Errors
/// [`LimitError`] if the scene is wrong or has no such arch. If a thickness that the search tries later makes the scene
/// wrong, the search stops at this thickness without an error.
pub fn least_thickness(scene: &Scene, arch: &str) -> Result<Thickness, LimitError> {
    least_thickness_observed(scene, arch, &mut |_| ControlFlow::Continue(()))
}

/// Computes the least thickness of an arch, with an observer that may end the search by `Break`.
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

/// The search by bisection between two thicknesses, in units of the scene.
struct Bisection<'a> {
    scene: Scene,
    place: usize,
    watch: Watch<'a>,
    falls: Option<(f64, Vec<Vec<Vector2<f64>>>)>,
    stands: Option<(f64, Model, Vec<PointState>)>,
    /// The thickness that does not fit into the rest of the scene, if there is one, and the error of the scene.
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

    /// Tries a thickness, and returns whether it was decided that the arch stands or falls.
    fn tried(&mut self, thickness: f64) -> Result<bool, LimitError> {
        if self.watch.ask().is_break() {
            return Ok(false);
        }
        self.scene.arches[self.place].thickness = Some(thickness);
        // If the arch no longer fits into the rest of the scene, because it ends below a load for example, the search
        // ends.
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
