//! Figures and tables of a result. A figure is a value in the units of the scene with its name, quantity and digits.
//!
//! Text, pages, JSON and CSV write these values as they are; some formats have only an order of their own. A figure is
//! added here and nowhere else, except for its unit and its fixed place in `json.rs`.

pub(super) mod history;
pub(super) mod limit;
pub(super) mod seismic;
pub(super) mod solved;
mod table;
pub(super) mod tables;
mod value;

pub(super) use table::{Column, Columns, Digits, Table};
pub(super) use value::{Members, Value, members};

/// The name of a figure, and its value in words.
pub(super) type Said = (&'static str, String);

/// One number or a few, with the names for files and the words for readers.
#[derive(Debug, Clone)]
pub(super) struct Figure {
    /// The key in JSON; empty if the figure is not in JSON.
    pub(super) key: &'static str,
    pub(super) value: Value,
    /// Name and words in the report as text; `None` if that report does not have the figure.
    text: Option<Said>,
    /// Name and words on a page; `None` if pages do not have the figure.
    page: Option<Said>,
}

impl Figure {
    pub(super) fn new(key: &'static str, value: impl Into<Value>) -> Self {
        Self { key, value: value.into(), text: None, page: None }
    }

    pub(super) fn text(self, name: &'static str, text: String) -> Self {
        Self { text: Some((name, text)), ..self }
    }

    /// Gives the figure the same name and words in the report as text and on a page.
    pub(super) fn both(self, name: &'static str, text: String) -> Self {
        self.text(name, text.clone()).page(name, text)
    }

    pub(super) fn page(self, name: &'static str, text: String) -> Self {
        Self { page: Some((name, text)), ..self }
    }
}

/// Returns the names and words of the figures in the report as text.
pub(super) fn on_text(figures: &[Figure]) -> Vec<Said> {
    figures.iter().filter_map(|it| it.text.clone()).collect()
}

/// Returns the names and words of the figures on a page.
pub(super) fn on_page(figures: &[Figure]) -> Vec<Said> {
    figures.iter().filter_map(|it| it.page.clone()).collect()
}

/// Takes the figures with the given keys (separated by spaces) out of the list, and returns them as members of a JSON
/// object; the member of a key without a figure is null.
pub(super) fn taken(figures: &mut Vec<Figure>, keys: &str) -> Members {
    let mut member = |key: &str| {
        let found = figures.extract_if(.., |it| it.key == key).last();
        (key.to_owned(), found.map(|it| it.value).into())
    };
    keys.split(' ').map(&mut member).collect()
}

/// Returns all figures with a key as members of a JSON object.
pub(super) fn in_json(figures: Vec<Figure>) -> Members {
    let with_key = figures.into_iter().filter(|it| !it.key.is_empty());
    with_key.map(|it| (it.key.to_owned(), it.value)).collect()
}

pub(super) fn yes_or_no(it: bool) -> String {
    if it { "yes" } else { "no" }.to_owned()
}
