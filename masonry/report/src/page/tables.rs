//! Tables that a click on a column sorts.

use masonry::data::state::{PointState, Reaction};
use nalgebra::Vector2;

use crate::cases::Cases;
use crate::figures::{Column, Digits, Table, Value, tables};
use crate::format::{InUnits, significant};
use crate::svg::escaped;
use masonry::model::Model;

/// Returns a table with a heading and a note as HTML; an empty text if the table has no rows.
pub(super) fn section(title: &str, note: &str, table: &Table) -> String {
    if table.rows.is_empty() {
        return String::new();
    }
    let note = match note {
        "" => String::new(),
        note => format!("<p>{}</p>\n", escaped(note)),
    };
    let head = |it: &Column| format!("<th scope=\"col\">{}</th>", escaped(&it.head(table.units)));
    let heads: String = table.columns.iter().map(head).collect();
    let row = |values: &Vec<Value>| {
        let cells: String =
            values.iter().zip(&table.columns).map(|(value, it)| cell(value, it)).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = table.rows.iter().map(row).collect();
    format!(
        "<section class=\"table\">\n<h2>{}</h2>\n{note}<div class=\"scroll\"><table>\n\
         <thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n</section>\n",
        escaped(title)
    )
}

/// Returns a cell as HTML, with the value by which the column is sorted. Words sort alphabetically; empty cells sort
/// last.
fn cell(value: &Value, column: &Column) -> String {
    let number = |value: f64, text: &str| {
        format!("<td class=\"number\" data-value=\"{value:e}\">{}</td>", escaped(text))
    };
    match value {
        Value::Words(text) => format!("<td>{}</td>", escaped(text)),
        Value::Number(it) => number(
            *it,
            &match column.digits {
                Digits::Aligned(digits) | Digits::Significant(digits) => significant(*it, digits),
                Digits::Power => format!("{it:.1e}"),
            },
        ),
        Value::Count(it) => number(*it as f64, &it.to_string()),
        _ => "<td></td>".to_owned(),
    }
}

/// Returns the table of all cases.
pub(super) fn cases(cases: &Cases) -> String {
    section(cases.title(), &cases.note(), &cases.shown())
}

/// Returns the table of the reactions of supports.
pub(super) fn reactions(title: &str, model: &Model, list: &[Reaction]) -> String {
    let note = "Forces on the structure; moments about the origin.";
    section(title, note, &tables::reactions(InUnits(model.units), list).with_digits(5))
}

/// Returns the table of the forces and openings of all joints.
pub(super) fn joints(title: &str, model: &Model, contacts: &[PointState]) -> String {
    let note = "N is positive in compression; e / l is the eccentricity of the resultant in lengths of the joint, \
                above 0.167 outside the middle third.";
    section(title, note, &tables::joints(model, contacts))
}

/// Returns the table of the joints that yield in a mechanism.
pub(super) fn hinges(title: &str, model: &Model, rates: &[Vec<Vector2<f64>>]) -> String {
    let note = "Rates are relative to the fastest joint; numbers are those of the picture.";
    section(title, note, &tables::hinges(model, rates))
}
