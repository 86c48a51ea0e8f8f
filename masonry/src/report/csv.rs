//! Contact points, and the load history, as tables of comma-separated values.

mod history;

use std::borrow::Cow;

pub use self::history::history;
use super::format::{InUnits, block_name, body_name, shortest};
use crate::data::state::{ContactStatus, FilmStress, State};
use crate::model::{Body, Model};

/// The text of `contacts.csv`: one row per contact point, in the order of the model.
///
/// Columns carry the units of the scene in their names: `index`, `joint`, `class`, the names of
/// the sides `a` and `b`, position `x_m`, `y_m`, `area_m2`, forces `t_n_kN` (compression positive)
/// and `t_t_kN`, tractions `traction_n_kN/m2` and `traction_t_kN/m2` (force over area), `gap_m`,
/// `slip_m`, `mu`, and `status` (`open`, `stick`, `slip`). Where there are mortar films, also
/// `film_sigma_y_kN/m2` (tension positive) and `film_tau_kN/m2`, empty for points of dry joints, and before them
/// `film_sigma_x_kN/m2` where films are whole strips. Numbers read back exactly; fields are
/// quoted where RFC 4180 asks for it, and lines end with CR LF.
pub fn contacts(model: &Model, state: &State) -> String {
    let units = InUnits(model.units);
    let columns = film_columns(state);
    let mut text = header(units, columns);
    let mut films = state.films.iter().peekable();
    for (index, (contact, force)) in model.contacts.iter().zip(&state.contacts).enumerate() {
        let joint = &model.joints[contact.joint.index()];
        let traction = |force: f64| {
            if contact.weight > 0.0 { units.stress(force / contact.weight) } else { 0.0 }
        };
        let mut fields = vec![
            index.to_string().into(),
            contact.joint.index().to_string().into(),
            quoted(model.joint_classes.get(joint.class).map_or("", |class| &class.name)),
            quoted(match contact.a {
                Some(anchor) => block_name(model, anchor.block),
                None => body_name(model, joint.a),
            }),
            quoted(body_name(model, Body::Block(joint.b))),
            shortest(units.length(contact.position.x)).into(),
            shortest(units.length(contact.position.y)).into(),
            shortest(units.area(contact.weight)).into(),
            shortest(units.force(force.t_n)).into(),
            shortest(units.force(force.t_t)).into(),
            shortest(traction(force.t_n)).into(),
            shortest(traction(force.t_t)).into(),
            shortest(units.length(force.y_n)).into(),
            shortest(units.length(force.y_t)).into(),
            shortest(contact.law.mu).into(),
            Cow::Borrowed(status_name(force.status)),
        ];
        let film = films.next_if(|film| film.contact.index() == index);
        fields.extend(columns.iter().map(|(_, stress)| {
            let stress = film.and_then(*stress);
            stress.map_or(Cow::Borrowed(""), |stress| shortest(units.stress(stress)).into())
        }));
        text += &fields.join(",");
        text += "\r\n";
    }
    text
}

/// The name of a column and the stress in it.
type FilmColumn = (&'static str, fn(&FilmStress) -> Option<f64>);

const FILM_COLUMNS: [FilmColumn; 3] = [
    ("film_sigma_x", |film| film.sigma_x),
    ("film_sigma_y", |film| Some(film.sigma_y)),
    ("film_tau", |film| Some(film.tau)),
];

/// The columns for which there are values.
fn film_columns(state: &State) -> &'static [FilmColumn] {
    match state.films.first() {
        None => &[],
        Some(film) if film.sigma_x.is_none() => &FILM_COLUMNS[1..],
        Some(_) => &FILM_COLUMNS,
    }
}

fn header(units: InUnits, films: &[FilmColumn]) -> String {
    let (length, force) = (units.0.length_name(), units.0.force_name());
    let stress = units.0.stress_name();
    let films: Vec<String> = films.iter().map(|(name, _)| format!(",{name}_{stress}")).collect();
    let films = films.concat();
    format!(
        "index,joint,class,a,b,x_{length},y_{length},area_{length}2,t_n_{force},t_t_{force},\
         traction_n_{stress},traction_t_{stress},gap_{length},slip_{length},mu,status{films}\r\n"
    )
}

fn status_name(status: ContactStatus) -> &'static str {
    match status {
        ContactStatus::Open => "open",
        ContactStatus::Stick => "stick",
        ContactStatus::Slip => "slip",
    }
}

/// A name as RFC 4180 wants it: in quotes when it contains a comma, a quote or a line break. After an apostrophe when spreadsheets
/// would take it for a formula.
pub(super) fn quoted(name: &str) -> Cow<'_, str> {
    let is_formula = name.starts_with(['=', '+', '-', '@']);
    let name = if is_formula { Cow::Owned(format!("'{name}")) } else { Cow::Borrowed(name) };
    if name.contains([',', '"', '\r', '\n']) {
        Cow::Owned(format!("\"{}\"", name.replace('"', "\"\"")))
    } else {
        name
    }
}
