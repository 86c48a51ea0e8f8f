//! Figures and tables that a user sees of a result, as one kind of value in the units of the scene, with their names,
//! quantities and digits.
//!
//! Text, pages, JSON and CSV only choose and write them, so that a figure is added here and nowhere else.

pub(super) mod history;
pub(super) mod limit;
pub(super) mod solved;
mod table;
pub(super) mod tables;
mod value;

pub(super) use table::{Column, Columns, Digits, Table};
pub(super) use value::{Value, members};

/// A name and the words beside it.
pub(super) type Said = (&'static str, String);

/// A number or a few, as files and readers see them.
#[derive(Debug, Clone)]
pub(super) struct Figure {
    /// In JSON; empty if it is not there.
    pub(super) key: &'static str,
    pub(super) value: Value,
    /// In the report as text, if it is there.
    text: Option<Said>,
    /// On a page, if it is there.
    page: Option<Said>,
}

impl Figure {
    pub(super) fn new(key: &'static str, value: impl Into<Value>) -> Self {
        Self { key, value: value.into(), text: None, page: None }
    }

    pub(super) fn text(self, name: &'static str, text: String) -> Self {
        Self { text: Some((name, text)), ..self }
    }

    /// The same in text and on a page.
    pub(super) fn both(self, name: &'static str, text: String) -> Self {
        self.text(name, text.clone()).page(name, text)
    }

    pub(super) fn page(self, name: &'static str, text: String) -> Self {
        Self { page: Some((name, text)), ..self }
    }
}

/// Names and words of the report as text.
pub(super) fn on_text(figures: &[Figure]) -> Vec<Said> {
    figures.iter().filter_map(|it| it.text.clone()).collect()
}

/// Names and words of a page.
pub(super) fn on_page(figures: &[Figure]) -> Vec<Said> {
    figures.iter().filter_map(|it| it.page.clone()).collect()
}

/// Figures as members of an object of JSON, null if they are not known.
pub(super) fn in_json(figures: &[Figure], keys: &str) -> Vec<(String, Value)> {
    let value = |key: &str| figures.iter().find(|it| it.key == key).map(|it| it.value.clone());
    keys.split(' ').map(|key| (key.to_owned(), value(key).into())).collect()
}

pub(super) fn yes_or_no(it: bool) -> String {
    if it { "yes" } else { "no" }.to_owned()
}
