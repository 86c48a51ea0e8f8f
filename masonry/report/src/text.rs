//! Figures and tables as text, at most 100 columns wide.

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, TableStyle, presets};

use super::figures::{Column, Digits, Table, Value};
use super::format::{aligned, significant};

const WIDTH: u16 = 100;

pub(super) fn section(title: &str) -> String {
    format!("\n{}", underlined(title, "-"))
}

pub(super) fn underlined(title: &str, rule: &str) -> String {
    format!("{title}\n{}\n", rule.repeat(title.chars().count()))
}

pub(super) fn paragraph(text: &str) -> String {
    let mut table = plain();
    table.add_row(vec![text]);
    table.trim_fmt() + "\n"
}

/// Returns a paragraph of the head of the report, broken into lines.
pub(super) fn head(text: &str) -> String {
    paragraph(text).lines().map(|line| line.trim_start().to_owned() + "\n").collect()
}

/// Returns the head of a report: a sentence, and warnings.
pub(super) fn heads(sentence: &str, warnings: &[String]) -> String {
    let warnings = warnings.iter().map(|warning| head(&format!("Warning: {warning}")));
    head(sentence) + &warnings.collect::<String>()
}

/// Lays out names and values in two columns.
pub(super) fn pairs(rows: &[(&str, String)]) -> String {
    let mut table = plain();
    for (name, value) in rows {
        table.add_row(vec![*name, value]);
    }
    table.trim_fmt() + "\n"
}

fn plain() -> comfy_table::Table {
    let mut table = comfy_table::Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(WIDTH);
    table
}

/// Returns a table as text; rows without values become empty lines.
pub(super) fn table(table: &Table) -> String {
    drawn(table).trim_fmt() + "\n"
}

/// Returns the table as a `comfy_table::Table`, whose column widths can be changed.
pub(super) fn drawn(table: &Table) -> comfy_table::Table {
    let mut drawn = comfy_table::Table::new();
    let rule = LineStyle::none().fill('-').junction('-');
    drawn.load_style(TableStyle::new().header_separator(rule));
    drawn.set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH);
    drawn.set_header(table.columns.iter().map(|it| it.head(table.units)));
    for (column, it) in drawn.column_iter_mut().zip(&table.columns) {
        if it.is_right {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    let writers = writers(table);
    for row in &table.rows {
        if row.is_empty() {
            drawn.add_row(vec![""]);
            continue;
        }
        drawn.add_row(row.iter().zip(&writers).map(|(value, writer)| cell(value, writer)));
    }
    drawn
}

/// A function that writes the numbers of a column.
type Writer = Box<dyn Fn(f64) -> String>;

fn writers(table: &Table) -> Vec<Writer> {
    let mut writers: Vec<Writer> = Vec::with_capacity(table.columns.len());
    let is_alike = |a: &Column, b: &Column| {
        a.is_right == b.is_right && a.digits == b.digits && a.quantity == b.quantity
    };
    for alike in table.columns.chunk_by(is_alike) {
        let columns = writers.len()..writers.len() + alike.len();
        let values = table.rows.iter().flat_map(|row| row.get(columns.clone()).unwrap_or_default());
        let number = |it: &Value| if let Value::Number(it) = it { Some(*it) } else { None };
        let numbers: Vec<f64> = values.filter_map(number).collect();
        writers.extend(alike.iter().map(|column| -> Writer {
            match column.digits {
                Digits::Aligned(digits) => Box::new(aligned(&numbers, digits)),
                Digits::Significant(digits) => Box::new(move |it| significant(it, digits)),
                Digits::Power => Box::new(|it| format!("{it:.1e}")),
            }
        }));
    }
    writers
}

fn cell(value: &Value, writer: &Writer) -> String {
    match value {
        Value::Number(it) => writer(*it),
        Value::Count(it) => it.to_string(),
        Value::Words(it) => it.clone(),
        _ => "-".to_owned(),
    }
}
