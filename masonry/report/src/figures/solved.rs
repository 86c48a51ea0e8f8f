//! Figures of a scene that was solved.

use nalgebra::Point2;

use super::tables::counts;
use super::{Figure, Value, members};
use crate::format::{InUnits, block_name, significant, stress_text};
use crate::joints;
use crate::summary::{
    ExtremeStress, extreme_film_stresses, extreme_stresses, largest_displacement,
};
use masonry::analysis::outcome::Outcome;
use masonry::data::state::{FilmStress, State};
use masonry::model::Model;
use masonry::rounding::largest;

/// Returns the errors of the balances, and the numbers of contact points that are open, stick and slip.
pub(crate) fn checks(outcome: &Outcome) -> Vec<Figure> {
    let Some(it) = &outcome.checks else { return Vec::new() };
    // Keys, names and values of the errors.
    let errors = [
        ("force", "force", it.force_balance),
        ("moment", "moment", it.moment_balance),
        ("uncarried_load", "uncarried load", it.uncarried),
        ("nodal", "nodes", it.nodal_balance),
        ("cone_violation", "cone violation", it.cone_violation),
        ("penetration", "penetration", it.penetration),
        ("complementarity", "complementarity", it.complementarity),
        ("energy", "energy", it.energy),
    ];
    let mut balance = errors.map(|(key, _, value)| (key.to_owned(), Value::Number(value))).to_vec();
    balance.extend(members! { "deformation": it.deformation });
    let points = format!("{} open, {} stick, {} slip", it.open, it.stick, it.slip);
    vec![
        Figure::new("balance", balance)
            .text("balance", listed(&errors.map(|(_, name, value)| (name, value)))),
        Figure::new("contacts", counts([it.open, it.stick, it.slip]))
            .both("contact points", points),
    ]
}

/// Writes names and numbers in one line.
pub(crate) fn listed(values: &[(&str, f64)]) -> String {
    let texts: Vec<String> =
        values.iter().map(|(name, value)| format!("{name} {}", significant(*value, 3))).collect();
    texts.join(", ")
}

/// Returns the extremes of displacements, cracks, stresses and friction.
pub(crate) fn state(outcome: &Outcome) -> Vec<Figure> {
    let Some(state) = &outcome.state else { return Vec::new() };
    let model = &outcome.model;
    let units = InUnits(model.units);
    let energy = units.energy(state.strain_energy);
    let mut list: Vec<Figure> = displacement(model, state).into_iter().collect();
    list.push(
        Figure::new("strain_energy", energy)
            .text("strain energy", format!("{} {}", significant(energy, 6), units.0.energy_name())),
    );
    list.extend(cracks(model, state));
    list.extend(stresses(model, state));
    let forces = joints::forces(model, &state.contacts);
    let most = largest(forces.iter().filter_map(|it| it.utilisation));
    if most > 0.0 {
        let text = format!("{} %", significant(100.0 * most, 3));
        list.push(Figure::new("", most).page("friction used at most", text));
    }
    list.extend(films(model, state));
    list
}

/// Writes the coordinates of a place.
fn place(units: InUnits, at: Point2<f64>) -> String {
    let [x, y] = [at.x, at.y].map(|metres| significant(units.length(metres), 4));
    format!("({x}, {y}) {}", units.0.length_name())
}

fn displacement(model: &Model, state: &State) -> Option<Figure> {
    let it = largest_displacement(model, state)?;
    let (units, block) = (InUnits(model.units), block_name(model, it.block));
    let value = units.length(it.value);
    let figure = Figure::new(
        "max_displacement",
        members! {
            "value": value,
            "component": it.component.to_string(),
            "block": block,
            "x": units.length(it.position.x),
            "y": units.length(it.position.y),
        },
    );
    let (text, length) = (significant(value, 6), units.0.length_name());
    let at = place(units, it.position);
    let text = format!("u_{} = {text} {length} in block {block} at {at}", it.component);
    let figure = figure.text("largest displacement", text);
    if it.value == 0.0 {
        return Some(figure);
    }
    let millimetres = significant(1e3 * it.value, 4);
    let text = format!("u_{} = {millimetres}\u{a0}mm, {block}", it.component);
    Some(figure.page("largest displacement", text))
}

fn cracks(model: &Model, state: &State) -> impl Iterator<Item = Figure> {
    let openings = joints::openings(model, &state.contacts);
    let widest = largest(openings.iter().map(|it| it.widest));
    let slip = largest(openings.iter().map(|it| it.slip));
    let found = [("widest crack", widest), ("largest slip", slip)].into_iter();
    found.filter(|(_, metres)| *metres > 0.0).map(|(name, metres)| {
        let text = format!("{}\u{a0}mm", significant(1e3 * metres, 3));
        Figure::new("", metres).page(name, text)
    })
}

fn stresses(model: &Model, state: &State) -> Vec<Figure> {
    let units = InUnits(model.units);
    let (compression, tension) = extreme_stresses(state);
    let figure = |key, name, it: Option<ExtremeStress>| {
        let Some(it) = it else {
            return Figure::new(key, Value::Nothing).text(name, "none".to_owned());
        };
        let block = block_name(model, it.block);
        let object = members! {
            "value": units.stress(it.value),
            "block": block,
            "x": units.length(it.position.x),
            "y": units.length(it.position.y),
        };
        let (value, at) = (significant(units.stress(it.value.abs()), 6), place(units, it.position));
        let text = format!("{value} {} in block {block} at {at}", units.0.stress_name());
        let short = format!("{}, {block}", stress_text(it.value.abs()));
        Figure::new(key, object).text(name, text).page(name, short)
    };
    if state.stresses.is_empty() {
        return Vec::new();
    }
    vec![
        figure("max_compression", "largest compression", compression),
        figure("max_tension", "largest tension", tension),
    ]
}

/// Returns the stresses in mortar films; in JSON, all of them are members of one object.
fn films(model: &Model, state: &State) -> Vec<Figure> {
    let Some(films) = extreme_film_stresses(state) else { return Vec::new() };
    let units = InUnits(model.units);
    let text = |film: FilmStress, pascals: f64| {
        let at = place(units, model.contacts[film.contact.index()].position);
        let value = significant(units.stress(pascals), 6);
        format!("{value} {} at {at}", units.0.stress_name())
    };
    let (pressure, shear) = (films.compression.sigma_y, films.shear.tau.abs());
    let mut object =
        members! { "sigma_y_min": units.stress(pressure), "tau_max": units.stress(shear) };
    let mut list =
        vec![Figure::new("", Value::Nothing).text("film shear", text(films.shear, shear))];
    if let Some(along) = films.along.sigma_x {
        object.extend(members! { "sigma_x": units.stress(along) });
        let name = if along > 0.0 { "tension along films" } else { "pressure along films" };
        let text = text(films.along, along.abs());
        list.push(Figure::new("", Value::Nothing).text(name, text));
    }
    let pressure = text(films.compression, 0.0 - pressure);
    list.insert(0, Figure::new("films", object).text("film compression", pressure));
    list
}
