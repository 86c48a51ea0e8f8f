//! The pages of a limit load and of the least thickness of an arch.

use super::tables::{self, section};
use super::{Page, size, taken};
use crate::cases::Cases;
use crate::figures::{self, Said, on_page};
use crate::format::InUnits;
use crate::limit::{ByLaw, by_law, pictures, pictures_of_thickness, table, thickness_table};
use crate::svg::{self, pictures::Pictures};
use masonry::analysis::limit::{Answer, Associative, Limit, Path, Thickness};

/// Returns the page of a limit load, with a table of all cases if the limit load governs several.
pub fn limit(limit: &Limit, cases: Option<&Cases>) -> String {
    let mut pictures = pictures(limit, true);
    pictures.push(Pictures::one("scene.svg", svg::scene(&limit.title, &limit.model)));
    pictures.extend(
        cases.and_then(|it| it.curve()).map(|it| Pictures::one("train.svg", it.to_owned())),
    );
    Page {
        title: limit.title.clone(),
        verdict: verdict(limit),
        sentence: limit.sentence.clone(),
        warnings: limit.warnings.clone(),
        figures: figures(limit),
        pictures,
        steps: Vec::new(),
        tables: tables(limit, cases),
        text: table(limit),
    }
    .finish()
}

/// Returns the tables of the page of a limit load, as pieces of HTML one below the other.
pub fn tables(limit: &Limit, cases: Option<&Cases>) -> String {
    let cases = cases.map_or_else(String::new, tables::cases);
    // The headline is about the path, if there is one, so that the tables of the path come first.
    cases + &by_law(limit).rev().map(|it| tables_of(&it)).collect::<String>()
}

fn tables_of(ByLaw { of, model, forces, mechanism, reactions, path, .. }: &ByLaw<'_>) -> String {
    let joints = format!("Joints of the mechanism{of}");
    let mut list = mechanism.map_or_else(String::new, |it| tables::hinges(&joints, model, it));
    list += &tables::reactions(&format!("Reactions{of}"), model, reactions);
    if let Some(path) = path {
        let title = "Joints that open and slide along the path";
        list += &section(title, "Each between two load factors.", &figures::limit::events(path));
    }
    let joints = |it| tables::joints(&format!("Joints{of}"), model, it);
    list + &forces.map_or_else(String::new, joints)
}

/// Returns the page of the least thickness of an arch.
pub fn thickness(thickness: &Thickness) -> String {
    let (title, model) = (&thickness.title, &thickness.model);
    let mut pictures = pictures_of_thickness(thickness, true);
    pictures.push(Pictures::one("scene.svg", svg::scene(title, model)));
    Page {
        title: title.clone(),
        verdict: verdict_of(thickness),
        sentence: thickness.sentence.clone(),
        warnings: Vec::new(),
        figures: on_page(&figures::limit::thickness(thickness)),
        pictures,
        steps: Vec::new(),
        tables: thickness_tables(thickness),
        text: thickness_table(thickness),
    }
    .finish()
}

/// Returns the tables of the page of a least thickness, as pieces of HTML one below the other.
pub fn thickness_tables(thickness: &Thickness) -> String {
    let model = &thickness.model;
    let forces = thickness.forces.as_ref();
    let joints = forces.map_or_else(String::new, |it| tables::joints("Joints", model, it));
    let of = "Joints of the mechanism at the largest thickness that is proved too small";
    let rates = thickness.mechanism.as_ref();
    joints + &rates.map_or_else(String::new, |it| tables::hinges(of, model, it))
}

/// Returns `stands`, `falls` or `undecided` for the arch with the thickness of the scene.
fn verdict_of(thickness: &Thickness) -> &'static str {
    let Thickness { given, stands, falls, .. } = thickness;
    match (stands, falls) {
        (_, Some(falls)) if given <= falls => "falls",
        (Some(stands), _) if given >= stands => "stands",
        _ => "undecided",
    }
}

/// Returns `stands`, `falls` or `undecided` for the structure under the constant loads and some part of the growing
/// loads.
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
        // The load factor is shown first and the bound with its proof last. Only one mechanism is shown.
        let place = |key: &str| {
            ["load_factor", "bound", "mechanism", "rest"].iter().position(|it| *it == key)
        };
        found.retain(|it| it.key != "mechanism" || limit.path.is_none());
        found.sort_by_key(|it| place(it.key).unwrap_or(usize::MAX));
        list.extend(on_page(&found));
    }
    if let Some(check) = &limit.seismic {
        list.extend(on_page(&figures::seismic::seismic(check, InUnits(limit.model.units))));
    }
    list.extend([("size", size(&limit.model)), ("time", taken(&limit.times))]);
    list
}
