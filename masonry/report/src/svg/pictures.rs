//! All pictures of an outcome; those of several states, one a step of a load history, are alike in scale.

use super::bond_lines::ReferenceLines;
use super::cracks;
use super::deformed::{self, Magnified};
use super::forces::{self, Loaded, Shared};
use super::history::curves;
use super::mechanism::{Collapse, collapse};
use super::scene::scene;
pub(crate) use super::sheet::Shown;
use super::stresses::{self, StressScale};
use crate::joints;
use masonry::analysis::outcome::Outcome;

/// Pictures of one kind: one, or one of every step of a load history that is shown.
#[derive(Debug, Clone)]
pub(crate) struct Pictures {
    /// The name of a file with it.
    pub(crate) file: &'static str,
    pub(crate) pictures: Vec<String>,
}

impl Pictures {
    pub(crate) fn one(file: &'static str, picture: String) -> Self {
        Self { file, pictures: vec![picture] }
    }
}

/// The pictures of an outcome, with those of the states that are `shown`, in the order of the files. A page can change
/// displacements and amplitudes, and marks its step in curves.
pub(crate) fn of_outcome(
    outcome: &Outcome,
    title: &str,
    shown: &[Shown<'_>],
    reference: Option<&ReferenceLines>,
    for_page: bool,
) -> Vec<Pictures> {
    let model = &outcome.model;
    let history = outcome.history.as_ref().and_then(|it| curves(title, model, it, for_page));
    let mechanism = outcome
        .mechanism
        .as_ref()
        .map(|rates| collapse(&Collapse { title, model, rates, growth: None }, for_page));
    let mut list = vec![Pictures::one("scene.svg", scene(title, model))];
    list.extend(of_states(shown, reference, for_page));
    list.extend(history.map(|it| Pictures::one("history.svg", it)));
    list.extend(mechanism.map(|it| Pictures::one("mechanism.svg", it)));
    list
}

/// The pictures of states, which have the same scales. Kinds of which no state has anything to show are left out.
fn of_states(
    shown: &[Shown<'_>],
    reference: Option<&ReferenceLines>,
    for_page: bool,
) -> Vec<Pictures> {
    let mut list = Vec::new();
    if shown.is_empty() {
        return list;
    }
    let mut add = |file, draw: &dyn Fn(&Shown<'_>) -> String| {
        list.push(Pictures { file, pictures: shown.iter().map(draw).collect() });
    };
    if shown.iter().any(|it| !it.state.stresses.is_empty()) {
        let scales = shown.iter().map(|it| StressScale::of(&it.state.stresses));
        let scale = scales.fold(StressScale::default(), StressScale::and);
        add("principal_stresses.svg", &|it| stresses::compared(it, reference, scale));
    }
    let by = Magnified::of(shown, for_page);
    add("deformed.svg", &|it| deformed::compared(it, &by));
    let loaded: Vec<Loaded<'_>> = shown.iter().map(Loaded::from).collect();
    let by = Shared::of(&loaded);
    add("forces.svg", &|it| forces::compared(&it.into(), &by));
    let openings = loaded.iter().map(|it| joints::openings(it.model, it.contacts));
    let openings: Vec<_> = openings.flatten().collect();
    if !openings.is_empty() {
        let by = cracks::widest(&openings);
        add("cracks.svg", &|it| cracks::compared(&it.into(), by));
    }
    list
}
