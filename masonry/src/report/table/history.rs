//! The load history as a table.

use comfy_table::ColumnConstraint;

use super::{pairs, paragraph, table};
use crate::history::{History, SecondLoading, Spread, Step, StepRecord};
use crate::report::format::{InUnits, aligned};

/// Longer histories are shown at the ends of their stages only.
const MOST_ROWS: usize = 24;

/// Columns of numbers, which do not wrap.
const NUMBERS: [usize; 8] = [2, 3, 4, 5, 6, 7, 8, 9];

/// One row for every step that was solved, or for every stage of a long history.
pub(super) fn history(history: &History, units: InUnits) -> String {
    let records = &history.records;
    let shown: Vec<&StepRecord> = if records.len() > MOST_ROWS {
        let ends = records.iter().enumerate();
        let is_end = |(k, record): &(usize, &StepRecord)| {
            record.step.number == record.step.of || *k + 1 == records.len()
        };
        ends.filter(is_end).map(|(_, record)| record).collect()
    } else {
        records.iter().collect()
    };
    let (energy, length) = (units.0.energy_name(), units.0.length_name());
    let heads =
        ["stage", "step", "W", "D", "U", "W-U-D", "moved", "open", "stick", "slip", "found by"];
    let mut table = table(&heads, &NUMBERS);
    for column in table.column_iter_mut() {
        column.set_padding((1, 0));
    }
    for index in NUMBERS {
        if let Some(column) = table.column_mut(index) {
            column.set_constraint(ColumnConstraint::ContentWidth);
        }
    }
    let total = |of: fn(&StepRecord) -> f64| {
        shown.iter().map(move |last| {
            let until = records.iter().take_while(|record| record.step != last.step);
            units.energy(until.map(of).sum::<f64>() + of(last))
        })
    };
    let work: Vec<f64> = total(|record| record.work).collect();
    let dissipated: Vec<f64> = total(|record| record.dissipation).collect();
    let stored: Vec<f64> = shown.iter().map(|record| units.energy(record.strain_energy)).collect();
    let left = (0..shown.len()).map(|k| work[k] - stored[k] - dissipated[k]);
    let left: Vec<f64> = left.collect();
    let energies = [work, dissipated, stored, left].concat();
    let energies = aligned(&energies, 3);
    let moved: Vec<f64> =
        shown.iter().map(|record| units.length(record.largest_displacement)).collect();
    let moved = aligned(&moved, 3);
    for (k, record) in shown.iter().enumerate() {
        let [work, dissipated, stored, left] =
            [0, 1, 2, 3].map(|column| &energies[column * shown.len() + k]);
        let counts = record.contacts.map(|count| count.to_string());
        let [open, stick, slip] = &counts;
        let step = place(&record.step);
        let stage = &record.step.stage;
        table.add_row(vec![
            stage,
            &step,
            work,
            dissipated,
            stored,
            left,
            &moved[k],
            open,
            stick,
            slip,
            record.way.name(),
        ]);
    }
    let meanings = format!(
        "W: work, D: dissipated energy, both from the beginning [{energy}]; U: strain energy [{energy}]. W-U-D is the \
         error of the balance from steps that are too long; it does not tell whether friction kept its law. \
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
    let Spread { steps, displacements, openings, reactions, dissipation } = match second {
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

fn place(step: &Step) -> String {
    format!("{}/{}", step.number, step.of)
}
