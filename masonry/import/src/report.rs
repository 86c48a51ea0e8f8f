//! The report of an import: a table of changes.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::Imported;
use masonry_drawing::Change;

/// The largest number of places that a row of the table names; further places are counted. Chosen: as many as fit in a
/// line.
const NAMED: usize = 3;

impl Imported {
    /// Returns the report: the contents of the scene, the assumptions, and a table of all changes with their places.
    pub fn report(&self) -> String {
        let scene = &self.scene;
        let mut text = format!(
            "{}, {}; unit of the drawing: {}; tolerance: {} m\n",
            counted(scene.blocks.len(), "block"),
            counted(scene.supports.len(), "support"),
            self.unit,
            metres(self.tolerance),
        );
        for assumption in &self.assumed {
            let _ = writeln!(text, "assumed: {assumption}");
        }
        for (what, row) in self.rows() {
            let _ = writeln!(text, "{row} {what}{}", row.places());
        }
        text
    }

    /// Returns the lines of the table of changes, without padding.
    pub(crate) fn told(&self) -> Vec<String> {
        let line = |(what, row): (&str, Row)| format!("{} x {what}{}", row.count, row.places());
        self.rows().into_iter().map(line).collect()
    }

    /// Returns the changes as rows by kind, in the order of the first change of each kind.
    fn rows(&self) -> Vec<(&str, Row<'_>)> {
        let mut rows: Vec<(&str, Row)> = Vec::new();
        let mut found: BTreeMap<&str, usize> = BTreeMap::new();
        for change in &self.changes {
            let at = *found.entry(&change.what).or_insert(rows.len());
            if at == rows.len() {
                rows.push((&change.what, Row::default()));
            }
            rows[at].1.add(change);
        }
        rows
    }
}

/// All changes of one kind.
#[derive(Default)]
struct Row<'a> {
    count: usize,
    first: Vec<&'a Change>,
    has_more: bool,
    largest: Option<f64>,
}

impl<'a> Row<'a> {
    fn add(&mut self, change: &'a Change) {
        self.count += 1;
        self.largest = change.by.map(|by| by.max(self.largest.unwrap_or(0.0))).or(self.largest);
        // One entity may be changed several times.
        let is_new = self.first.iter().all(|it| it.place != change.place);
        if is_new && self.first.len() < NAMED {
            self.first.push(change);
        } else {
            self.has_more |= is_new;
        }
    }

    fn places(&self) -> String {
        let by = self.largest.map_or(String::new(), |by| format!(", by up to {} m", metres(by)));
        let mut places: Vec<String> = self.first.iter().map(|it| it.place.to_string()).collect();
        if self.has_more {
            places.push("...".to_owned());
        }
        format!("{by}: {}", places.join(", "))
    }
}

impl std::fmt::Display for Row<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:>6} x", self.count)
    }
}

/// Writes a length with three digits, as messages show small lengths.
pub(crate) fn metres(length: f64) -> String {
    if length == 0.0 {
        return "0".to_owned();
    }
    let digits = -length.abs().max(f64::MIN_POSITIVE).log10().floor() + 2.0;
    if !(0.0..=9.0).contains(&digits) {
        return format!("{length:.2e}");
    }
    // The number of decimals is between 0 and 9.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
    let text = format!("{length:.*}", digits as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}
