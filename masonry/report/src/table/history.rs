//! The load history as a table.

use comfy_table::ColumnConstraint;

use crate::figures::history::{in_text, place};
use crate::text::{drawn, pairs, paragraph};
use masonry::history::{History, SecondLoading, Spread};
use masonry::model::Model;

/// The largest number of steps of a history that are all shown; of a longer history, only the ends of stages are shown.
const MOST_ROWS: usize = 24;

/// Returns the table of a load history as text: a row for every step that was solved, or for every stage of a long
/// history.
pub(super) fn history(model: &Model, history: &History) -> String {
    let mut rows = in_text(model, history);
    let records = &history.records;
    if records.len() > MOST_ROWS {
        let last = records.len() - 1;
        let is_end = |k: usize| records[k].step.number == records[k].step.of || k == last;
        rows.retain(is_end);
    }
    let mut table = drawn(&rows);
    table.set_header(rows.columns.iter().map(|it| &it.name));
    for (column, it) in table.column_iter_mut().zip(&rows.columns) {
        column.set_padding((1, 0));
        if it.is_right {
            // Numbers are not wrapped.
            column.set_constraint(ColumnConstraint::ContentWidth);
        }
    }
    let (energy, length) = (model.units.energy_name(), model.units.length_name());
    let meanings = format!(
        "W: work, D: dissipated energy, both from the beginning [{energy}]; U: strain energy [{energy}]. W-U-D is the \
         error of the balance from steps that are too long; it does not show whether friction kept its law. \
         moved: the largest displacement [{length}]."
    );
    let mut text = table.trim_fmt() + "\n" + &paragraph(&meanings);
    if let Some(second) = &history.second_loading {
        text += &paragraph(&second_loading(second));
    }
    if let Some(failed) = &history.failed {
        let step = format!("{} of stage \"{}\"", place(failed), failed.stage);
        text += &pairs(&[("not solved", step)]);
    }
    text
}

fn second_loading(second: &SecondLoading) -> String {
    let Spread { steps, displacements, openings, reactions, dissipation, .. } = match second {
        SecondLoading::Ended(spread) => *spread,
        SecondLoading::Stopped { solved, steps } => {
            return format!(
                "Another loading, with {steps} steps and ten times as fast, stopped after {solved} of them."
            );
        }
    };
    let [displacements, openings, reactions, dissipation] =
        [displacements, openings, reactions, dissipation].map(|it| format!("{:.1} %", 100.0 * it));
    format!(
        "Another loading, with {steps} steps and ten times as fast, differs at the end by {displacements} in \
         displacements, {openings} in gaps, {reactions} in reactions (root mean squares) and {dissipation} in D."
    )
}
