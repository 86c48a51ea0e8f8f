//! The fields of a document, with their places.

use std::collections::BTreeMap;

use serde::de::{Deserialize, DeserializeOwned, Deserializer, Error as _, MapAccess, Visitor};
use serde_json::from_str;
use serde_json::value::RawValue;

use crate::io::{Position, ReadError};
use crate::{Error, Matrix};

/// A document whose fields are those of its kind.
pub(super) struct Document<'a> {
    text: &'a str,
    fields: BTreeMap<&'static str, &'a RawValue>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Sparse<'a> {
    rows: usize,
    cols: usize,
    #[serde(borrow)]
    triplets: &'a RawValue,
}

impl<'a> Document<'a> {
    /// The document with some of these fields, and no others.
    pub(super) fn of(text: &'a str, names: &'static [&'static str]) -> Result<Self, ReadError> {
        let fields = serde_json::Deserializer::from_str(text).deserialize_map(Names(names));
        Ok(Self { text, fields: fields.map_err(|error| syntax(text, text, &error))? })
    }

    pub(super) fn value<T: DeserializeOwned>(&self, name: &str) -> Result<T, ReadError> {
        self.parsed(self.field(name)?)
    }

    /// The value of a field that may be missing.
    pub(super) fn optional<T: DeserializeOwned>(&self, name: &str) -> Result<Option<T>, ReadError> {
        self.fields.get(name).map(|part| self.parsed(part.get())).transpose()
    }

    pub(super) fn square(&self, name: &str, order: usize) -> Result<Matrix, ReadError> {
        self.matrix(name, order, order)
    }

    /// A matrix of that size, by rows or triplets; nothing is allocated for another one.
    pub(super) fn matrix(
        &self,
        name: &str,
        height: usize,
        width: usize,
    ) -> Result<Matrix, ReadError> {
        let part = self.field(name)?;
        let fits = |part: &str, what: &str, length: usize, expected: usize| {
            let message = format!(
                "`{name}` has {length} {what}, but must have {expected}, to fit the vectors"
            );
            if length == expected { Ok(()) } else { Err(self.wrong(part, message)) }
        };
        if !part.starts_with('{') {
            let rows: Vec<Vec<f64>> = self.parsed(part)?;
            fits(part, "rows", rows.len(), height)?;
            if let Some(i) = rows.iter().position(|row| row.len() != width) {
                fits(item(part, i), &format!("entries in row {i}"), rows[i].len(), width)?;
            }
            return Ok(faer::Mat::from_fn(height, width, |i, j| rows[i][j]).into());
        }
        let Sparse { rows, cols, triplets } = self.parsed(part)?;
        fits(part, "rows", rows, height)?;
        fits(part, "columns", cols, width)?;
        let entries: Vec<(usize, usize, f64)> = self.parsed(triplets.get())?;
        match entries.iter().position(|(i, j, _)| *i >= height || *j >= width) {
            Some(k) => {
                let (row, col, _) = entries[k];
                let message =
                    format!("entry [{row}, {col}] of `{name}` is outside {height} x {width}");
                Err(self.wrong(item(triplets.get(), k), message))
            }
            None => Ok(Matrix::from_entries(height, width, entries.into_iter())),
        }
    }

    /// The error of data that make no problem, at the field that it is about.
    pub(super) fn refused(&self, source: Error) -> ReadError {
        let datum = match &source {
            Error::NotFinite { what, .. } | Error::NotSymmetric { what, .. } => what,
            Error::Setting { name, .. } | Error::Length { name, .. } => name,
            Error::Bounds { what: "row", .. } => "l",
            Error::Bounds { .. } => "lower",
            Error::Indefinite { .. } => "k",
            Error::NotConvex { .. } => "p",
            _ => "",
        };
        let part = self.fields.get(datum.to_ascii_lowercase().as_str());
        let at = position(self.text, part.map_or(self.text.trim_start(), |part| part.get()));
        ReadError::Refused { at, source }
    }

    fn field(&self, name: &str) -> Result<&'a str, ReadError> {
        let part = self.fields.get(name).map(|part| part.get());
        part.ok_or_else(|| {
            let end = self.text.trim_end();
            self.wrong(&end[end.len() - 1..], format!("missing field `{name}`"))
        })
    }

    fn parsed<T: Deserialize<'a>>(&self, part: &'a str) -> Result<T, ReadError> {
        parsed(self.text, part)
    }

    fn wrong(&self, part: &str, message: String) -> ReadError {
        ReadError::Json { at: position(self.text, part), message }
    }
}

/// The names of the fields.
struct Names(&'static [&'static str]);

impl<'de> Visitor<'de> for Names {
    type Value = BTreeMap<&'static str, &'de RawValue>;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<Self::Value, A::Error> {
        let mut fields = BTreeMap::new();
        while let Some(name) = object.next_key::<String>()? {
            let known = self.0.iter().find(|known| **known == name);
            let known = known.ok_or_else(|| A::Error::unknown_field(&name, self.0))?;
            if fields.contains_key(known) {
                return Err(A::Error::duplicate_field(known));
            }
            fields.insert(*known, object.next_value()?);
        }
        Ok(fields)
    }
}

fn item(list: &str, k: usize) -> &str {
    let items: Vec<&RawValue> = from_str(list).unwrap_or_default();
    items.get(k).map_or(list, |item| item.get())
}

/// The value of a part of a document.
pub(super) fn parsed<'a, T: Deserialize<'a>>(text: &'a str, part: &'a str) -> Result<T, ReadError> {
    from_str(part).map_err(|error| syntax(text, part, &error))
}

fn syntax(text: &str, part: &str, error: &serde_json::Error) -> ReadError {
    let (line, column) = (error.line(), error.column());
    // Its message ends with the place where it has one.
    let message = error.to_string();
    let place = format!(" at line {line} column {column}");
    let message = message.strip_suffix(&place).unwrap_or(&message).to_owned();
    let begin = position(text, part);
    let before = if line > 1 { 0 } else { begin.column - 1 };
    let at = Position { line: begin.line + line.max(1) - 1, column: before + column.max(1) };
    ReadError::Json { at, message }
}

/// Where a part of a document begins.
fn position(text: &str, part: &str) -> Position {
    let before = &text[..part.as_ptr().addr() - text.as_ptr().addr()];
    let line_begin = before.rfind('\n').map_or(0, |end| end + 1);
    Position { line: before.matches('\n').count() + 1, column: before.len() - line_begin + 1 }
}
