//! The pages of a limit load and of the least thickness of an arch.

use nalgebra::Vector2;

use super::tables::{self, section};
use super::{Choice, Page, size};
use crate::analysis::limit::{Answer, Associative, Limit, Path, Thickness};
use crate::data::state::{ContactState, Reaction};
use crate::model::Model;
use crate::report::figures::{self, Said, on_page};
use crate::report::format::significant;
use crate::report::limit::{table, thickness_table};
use crate::report::svg;

/// Rates of the corners of one block.
type Rates = Vec<Vector2<f64>>;

/// The page of a limit load.
pub fn limit(limit: &Limit) -> String {
    let title = &limit.title;
    let mut page = Page {
        title: title.clone(),
        verdict: verdict(limit),
        sentence: limit.sentence.clone(),
        warnings: limit.warnings.clone(),
        figures: figures(limit),
        text: table(limit),
        ..Page::default()
    };
    if let Some(found) = &limit.associative {
        let law = ByLaw {
            of: ", associative flow",
            names: [("forces", "Forces"), ("mechanism", "Mechanism")],
            model: &limit.model,
            forces: found.forces.as_deref(),
            mechanism: found.mechanism.as_deref(),
            reactions: &found.reactions,
            events: String::new(),
        };
        law.show(&mut page);
    }
    if let Some(path) = &limit.path {
        let (title, note) =
            ("Joints that open and slide along the path", "Each between two load factors.");
        let law = ByLaw {
            of: ", path",
            names: [("path-forces", "Forces, path"), ("path-mechanism", "Mechanism, path")],
            model: &path.model,
            forces: path.contacts.as_deref(),
            mechanism: path.mechanism.as_deref(),
            reactions: &path.reactions,
            events: section(title, note, &figures::limit::events(path)),
        };
        law.show(&mut page);
        page.curves = svg::path(&limit.title, &limit.group, path);
    }
    page.pictures.push(Choice::one("scene", "Scene", svg::scene(title, &limit.model)));
    page.finish()
}

/// What a page shows of one law of friction.
struct ByLaw<'a> {
    /// The law, in titles.
    of: &'static str,
    /// Keys and switches of the pictures of forces and of the mechanism.
    names: [(&'static str, &'static str); 2],
    model: &'a Model,
    forces: Option<&'a [ContactState]>,
    mechanism: Option<&'a [Rates]>,
    reactions: &'a [Reaction],
    events: String,
}

impl ByLaw<'_> {
    fn show(self, page: &mut Page) {
        let Self { of, names: [forces, mechanism], model, .. } = self;
        let title = format!("{}{of}", page.title);
        if let Some(found) = self.forces {
            let picture = svg::forces(&title, model, found);
            page.pictures.push(Choice::one(forces.0, forces.1, picture));
        }
        if let Some(rates) = self.mechanism {
            let picture = svg::mechanism_on_page(&title, model, rates);
            page.pictures.push(Choice::one(mechanism.0, mechanism.1, picture));
            page.tables += &tables::hinges(&format!("Joints of the mechanism{of}"), model, rates);
        }
        page.tables += &tables::reactions(&format!("Reactions{of}"), model, self.reactions);
        page.tables += &self.events;
        if let Some(found) = self.forces {
            page.tables += &tables::joints(&format!("Joints{of}"), model, found);
        }
    }
}

/// The page of the least thickness of an arch.
pub fn thickness(thickness: &Thickness) -> String {
    let (title, model) = (&thickness.title, &thickness.model);
    let mut page = Page {
        title: title.clone(),
        verdict: verdict_of(thickness),
        sentence: thickness.sentence.clone(),
        figures: on_page(&figures::limit::thickness(thickness)),
        text: thickness_table(thickness),
        ..Page::default()
    };
    if let Some(forces) = &thickness.forces {
        let picture = svg::forces(title, model, forces);
        page.pictures.push(Choice::one("forces", "Forces", picture));
        page.tables += &tables::joints("Joints", model, forces);
    }
    if let Some(rates) = &thickness.mechanism {
        let of = ", of the thicker that falls";
        let picture = svg::mechanism_on_page(&format!("{title}{of}"), model, rates);
        page.pictures.push(Choice::one("mechanism", "Mechanism", picture));
        page.tables += &tables::hinges(&format!("Joints of the mechanism{of}"), model, rates);
    }
    page.pictures.push(Choice::one("scene", "Scene", svg::scene(title, model)));
    page.finish()
}

/// Whether the arch stands at the thickness of the scene.
fn verdict_of(thickness: &Thickness) -> &'static str {
    let Thickness { given, stands, falls, .. } = thickness;
    match (stands, falls) {
        (_, Some(falls)) if given <= falls => "falls",
        (Some(stands), _) if given >= stands => "stands",
        _ => "undecided",
    }
}

/// Says whether the structure stands under the loads that stay, and some part of those that grow.
fn verdict(limit: &Limit) -> &'static str {
    if limit.falls_by_weight || limit.associative.as_ref().is_some_and(Associative::carries_nothing)
    {
        return "falls";
    }
    let answer = limit.associative.as_ref().map(|it| it.answer);
    let falls = |path: &Path| path.decided && path.load_factor.is_none();
    let is_open = limit.path.as_ref().is_some_and(|it| !it.decided);
    if answer == Some(Answer::Falls) || limit.path.as_ref().is_some_and(falls) {
        "falls"
    } else if answer == Some(Answer::Undecided) || is_open || limit.is_interrupted {
        "undecided"
    } else {
        "stands"
    }
}

fn figures(limit: &Limit) -> Vec<Said> {
    let mut list = vec![("load that grows", limit.group.clone())];
    if let Some(path) = &limit.path {
        list.extend(on_page(&figures::limit::path(path)));
    }
    if let Some(found) = &limit.associative {
        let mut found = figures::limit::associative(found, &limit.model);
        // Readers see the answer first and the proof last, and one motion.
        let place = |key: &str| {
            ["load_factor", "bound", "mechanism", "rest"].iter().position(|it| *it == key)
        };
        found.retain(|it| it.key != "mechanism" || limit.path.is_none());
        found.sort_by_key(|it| place(it.key).unwrap_or(usize::MAX));
        list.extend(on_page(&found));
    }
    list.push(("size", size(&limit.model)));
    let seconds: f64 = limit.times.iter().map(|it| it.seconds).sum();
    list.push(("time", format!("{} s", significant(seconds, 2))));
    list
}
