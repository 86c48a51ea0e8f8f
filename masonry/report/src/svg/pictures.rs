//! All pictures of an outcome. Pictures of one kind for several states, such as the steps of a load history, have the
//! same scale.

use super::bond_lines::ReferenceLines;
use super::cracks;
use super::deformed::{self, Magnified};
use super::forces::{self, Loaded, Shared};
use super::history::curves;
use super::mechanism::{Collapse, collapse};
use super::scene::scene;
pub use super::sheet::Shown;
use super::stresses::{self, StressScale};
use crate::joints;
use masonry::analysis::outcome::Outcome;

/// Pictures of one kind: a single picture, or one for every shown step of a load history.
#[derive(Debug, Clone)]
pub(crate) struct Pictures {
    /// The name of the file of such a picture.
    pub(crate) file: &'static str,
    pub(crate) pictures: Vec<String>,
}

impl Pictures {
    pub(crate) fn one(file: &'static str, picture: String) -> Self {
        Self { file, pictures: vec![picture] }
    }
}

/// Draws the pictures of an outcome, including those of the `shown` states, in the order of the files. With `for_page`,
/// a page can change displacements and amplitudes, and mark its step in curves.
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

/// A kind of picture of a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatePicture {
    /// The picture of the principal stresses, drawn by [`principal_stresses`](super::principal_stresses()).
    Stresses,
    /// The picture of the deformed structure, drawn by [`deformed`](super::deformed()).
    Deformed,
    /// The picture of the contact forces, drawn by [`forces`](super::forces()).
    Forces,
    /// The picture of open joints and slips, drawn by [`cracks`](super::cracks()).
    Cracks,
}

impl StatePicture {
    const ALL: [Self; 4] = [Self::Stresses, Self::Deformed, Self::Forces, Self::Cracks];

    fn file(self) -> &'static str {
        match self {
            Self::Stresses => "principal_stresses.svg",
            Self::Deformed => "deformed.svg",
            Self::Forces => "forces.svg",
            Self::Cracks => "cracks.svg",
        }
    }
}

/// Draws pictures of one kind for several states, with one scale of forces, stresses, displacements or widths; empty if
/// no state has anything to show.
pub fn compared(
    kind: StatePicture,
    shown: &[Shown<'_>],
    reference: Option<&ReferenceLines>,
) -> Option<Vec<String>> {
    drawn(kind, shown, reference, false)
}

fn drawn(
    kind: StatePicture,
    shown: &[Shown<'_>],
    reference: Option<&ReferenceLines>,
    for_page: bool,
) -> Option<Vec<String>> {
    let all = |draw: &dyn Fn(&Shown<'_>) -> String| shown.iter().map(draw).collect();
    let loaded: Vec<Loaded<'_>> = shown.iter().map(Loaded::from).collect();
    match kind {
        StatePicture::Stresses => {
            let scale = StressScale::of(shown);
            let has_some = shown.iter().any(|it| !it.state.stresses.is_empty());
            has_some.then(|| all(&|it| stresses::compared(it, reference, scale)))
        }
        StatePicture::Deformed => {
            let by = Magnified::of(shown, for_page);
            (!shown.is_empty()).then(|| all(&|it| deformed::compared(it, &by)))
        }
        StatePicture::Forces => {
            let by = Shared::of(&loaded);
            (!shown.is_empty()).then(|| all(&|it| forces::compared(&it.into(), &by)))
        }
        StatePicture::Cracks => {
            let openings = loaded.iter().map(|it| joints::openings(it.model, it.contacts));
            let openings: Vec<_> = openings.flatten().collect();
            let by = cracks::widest(&openings);
            (!openings.is_empty()).then(|| all(&|it| cracks::compared(&it.into(), by)))
        }
    }
}

/// Draws the pictures of states with shared scales. Kinds of pictures for which no state has anything to show are left
/// out.
fn of_states(
    shown: &[Shown<'_>],
    reference: Option<&ReferenceLines>,
    for_page: bool,
) -> Vec<Pictures> {
    let of_kind = |kind: StatePicture| {
        let pictures = drawn(kind, shown, reference, for_page)?;
        Some(Pictures { file: kind.file(), pictures })
    };
    StatePicture::ALL.into_iter().filter_map(of_kind).collect()
}
