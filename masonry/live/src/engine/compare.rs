//! Pictures of a scene, and of other scenes beside it at the same scale.

use std::sync::Arc;

use masonry_report::svg::pictures::{Shown as State, StatePicture, compared};
use serde::Serialize;

use super::fault::Fault;
use super::solved::{Seen, Show, Shown, Solved};

/// The largest number of scenes beside the scene of the text. Chosen: more pictures are too small on a screen.
pub(super) const MOST_BESIDE: usize = 3;

/// The answer for the scene of the text, and for the scenes beside it.
#[derive(Debug, Serialize)]
pub(super) struct Compared {
    #[serde(flatten)]
    shown: Shown,
    picture: Option<String>,
    beside: Vec<Beside>,
    /// A sentence on the scale that the pictures share; `None` without scenes beside it.
    scale: Option<&'static str>,
}

/// The answer for one scene beside the scene of the text.
#[derive(Debug, Serialize)]
struct Beside {
    /// The verdict in words, or the reason for which the scene can no longer be solved.
    sentence: String,
    picture: Option<String>,
}

pub(super) fn shown(
    solved: &Solved,
    kept: Vec<Result<Arc<Solved>, Fault>>,
    seen: Seen,
) -> Compared {
    let all: Vec<&Solved> =
        std::iter::once(solved).chain(kept.iter().flatten().map(|it| &**it)).collect();
    let (pictures, scale) =
        if kept.is_empty() { (vec![solved.picture(seen)], None) } else { pictures(&all, seen) };
    let mut pictures = pictures.into_iter();
    let picture = pictures.next().flatten();
    let beside = |it: Result<Arc<Solved>, Fault>| match it {
        Ok(kept) => Beside { sentence: kept.sentence(), picture: pictures.next().flatten() },
        Err(fault) => Beside { sentence: fault.message, picture: None },
    };
    let beside = kept.into_iter().map(beside).collect();
    Compared { shown: solved.shown(seen.show), picture, beside, scale }
}

/// Draws the pictures of several scenes, at one scale if all pictures are of the same kind; returns them with a
/// sentence on the scale.
fn pictures(all: &[&Solved], seen: Seen) -> (Vec<Option<String>>, Option<&'static str>) {
    let kind = all[0].seen(seen.show);
    let each = || all.iter().map(|it| it.picture(seen)).collect();
    if all.iter().any(|it| it.seen(seen.show) != kind) {
        return (each(), Some("These pictures show different things, each in its own scale."));
    }
    let (picture, scale) = match kind {
        Show::Forces => (StatePicture::Forces, "Forces have the same scale in all pictures."),
        Show::Stresses => (StatePicture::Stresses, "Stresses have the same scale in all pictures."),
        Show::Cracks => {
            (StatePicture::Cracks, "Widths of cracks have the same colours in all pictures.")
        }
        Show::Deformed => {
            (StatePicture::Deformed, "Displacements are magnified alike in all pictures.")
        }
        Show::Mechanism => {
            let scale =
                "Mechanisms have no scale of displacements: their sizes cannot be compared.";
            return (each(), Some(scale));
        }
        _ => return (each(), None),
    };
    let states: Vec<State<'_>> = all
        .iter()
        .filter_map(|it| {
            let (model, state) = it.state(seen.step)?;
            Some(State { title: it.title(), model, state })
        })
        .collect();
    let reference = all[0].reference.as_ref();
    let drawn = compared(picture, &states, reference).filter(|it| it.len() == all.len());
    match drawn {
        Some(list) => (list.into_iter().map(Some).collect(), Some(scale)),
        None => (each(), None),
    }
}
