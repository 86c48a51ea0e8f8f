//! Contact points, and the load history, as tables of comma-separated values.

use std::borrow::Cow;

use super::figures::{self, Column, Table, Value, tables};
use super::format::shortest;
use masonry::data::state::State;
use masonry::history::History;
use masonry::model::Model;

/// Returns the text of `contacts.csv`: one row per contact point, in the order of the model.
///
/// Columns carry the units of the scene in their names: `index`, `joint`, `class`, the names of the sides `a` and `b`,
/// position `x_m`, `y_m`, `area_m2`, forces `t_n_kN` (compression positive) and `t_t_kN`, tractions `traction_n_kN/m2`
/// and `traction_t_kN/m2` (force divided by area), `gap_m`, `slip_m`, `mu`, and `status` (`open`, `stick`, `slip`).
/// Mortar films add `film_sigma_y_kN/m2` (tension positive) and `film_tau_kN/m2`. With `films = "strips"`,
/// `film_sigma_x_kN/m2` precedes these two columns. The columns of films are empty at points of dry joints. Numbers
/// read back exactly; fields are quoted as RFC 4180 requires, and lines end with CR LF.
pub fn contacts(model: &Model, state: &State) -> String {
    text(&tables::contacts(model, state))
}

/// Returns the text of `history.csv`: one row per step that was solved.
///
/// Columns carry the units of the scene in their names, here m and kN:
///
/// * `stage` and `step` (from 1 in each stage);
/// * the factor `gravity`, and a factor `load NAME` for each load;
/// * `SUPPORT x_m`, `SUPPORT y_m` and `SUPPORT turn_rad` for each support;
/// * `work_kJ`, `dissipation_kJ`, `friction_power` and `energy_created_kJ` of the step;
/// * `strain_energy_kJ` and `max_displacement_m` after the step;
/// * the numbers `open`, `stick` and `slip` of contact points;
/// * `SUPPORT fx_kN`, `SUPPORT fy_kN` and `SUPPORT m_kNm` (about the origin) for each support;
/// * the `residual`, the `way` in which the step was found (`law` or `motion`), and its `factorisations`.
pub fn history(model: &Model, history: &History) -> String {
    text(&figures::history::in_csv(model, history))
}

/// Returns a table as comma-separated values; the first row has the names of the columns with their units.
pub(super) fn text(table: &Table) -> String {
    let head = |it: &Column| match table.units.unit(it.quantity).as_str() {
        "" => quoted(&it.key).into_owned(),
        unit => quoted(&format!("{}_{unit}", it.key)).into_owned(),
    };
    let heads = table.columns.iter().map(head).collect();
    let rows = table.rows.iter().map(|row| row.iter().map(field).collect());
    let line = |fields: Vec<String>| fields.join(",") + "\r\n";
    std::iter::once(heads).chain(rows).map(line).collect()
}

fn field(value: &Value) -> String {
    match value {
        Value::Flag(it) => it.to_string(),
        Value::Count(it) => it.to_string(),
        Value::Number(it) => shortest(*it),
        Value::Words(it) => quoted(it).into_owned(),
        _ => String::new(),
    }
}

/// Quotes a name as RFC 4180 requires: in quotes if it contains a comma, a quote or a line break; after an apostrophe
/// if spreadsheets would take the name for a formula.
fn quoted(name: &str) -> Cow<'_, str> {
    let is_formula = name.starts_with(['=', '+', '-', '@']);
    let name = if is_formula { Cow::Owned(format!("'{name}")) } else { Cow::Borrowed(name) };
    if name.contains([',', '"', '\r', '\n']) {
        Cow::Owned(format!("\"{}\"", name.replace('"', "\"\"")))
    } else {
        name
    }
}
