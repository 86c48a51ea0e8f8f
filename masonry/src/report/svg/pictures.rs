//! All pictures of states, alike in scale where there are several: one a step of a load history.

use super::cracks::{self, widest};
use super::deformed::{self, Magnified};
use super::forces::{self, Shared};
pub(in crate::report) use super::sheet::Shown;
use super::stresses::{self, ReferenceLines, large};
use crate::data::state::{ContactState, State};
use crate::model::Model;
use crate::report::joints;

/// One kind of picture of all states.
#[derive(Debug, Clone)]
pub(in crate::report) struct Pictures {
    /// The name of a file with it.
    pub(in crate::report) file: &'static str,
    /// A picture of every state.
    pub(in crate::report) pictures: Vec<String>,
}

/// The pictures of states, which have the same scales. Kinds of which no state has anything to show are left out. On a
/// page displacements can be magnified otherwise.
pub(in crate::report) fn pictures(
    shown: &[Shown<'_>],
    reference: Option<&ReferenceLines>,
    for_page: bool,
) -> Vec<Pictures> {
    let states: Vec<(&Model, &State)> = shown.iter().map(|it| (it.model, it.state)).collect();
    let contacts: Vec<(&Model, &[ContactState])> =
        states.iter().map(|(model, state)| (*model, state.contacts.as_slice())).collect();
    let each = |draw: &dyn Fn(&Shown<'_>) -> String| shown.iter().map(draw).collect();
    let mut list = Vec::new();

    let large = states.iter().map(|(_, state)| large(&state.stresses));
    let large = large.fold([0.0; 2], |[a, b]: [f64; 2], [c, d]| [a.max(c), b.max(d)]);
    if states.iter().any(|(_, state)| !state.stresses.is_empty()) {
        let draw = |it: &Shown<'_>| stresses::compared(it, reference, large);
        list.push(Pictures { file: "principal_stresses.svg", pictures: each(&draw) });
    }
    let by = Magnified::of(&states, for_page);
    let draw = |it: &Shown<'_>| deformed::magnified(it.title, it.model, it.state, &by);
    list.push(Pictures { file: "deformed.svg", pictures: each(&draw) });
    let by = Shared::of(&contacts);
    let draw = |it: &Shown<'_>| forces::shared(it.title, it.model, &it.state.contacts, &by);
    list.push(Pictures { file: "forces.svg", pictures: each(&draw) });
    let widest = contacts.iter().map(|(model, it)| widest(model, it)).fold(0.0, f64::max);
    if contacts.iter().any(|(model, it)| !joints::openings(model, it).is_empty()) {
        let draw =
            |it: &Shown<'_>| cracks::coloured(it.title, it.model, &it.state.contacts, widest);
        list.push(Pictures { file: "cracks.svg", pictures: each(&draw) });
    }
    list
}
