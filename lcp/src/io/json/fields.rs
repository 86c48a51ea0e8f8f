//! Fields of a document that still stand in its text.

use faer::Mat;
use serde::Deserialize;
use serde_json::value::RawValue;

use super::kind::Kind;
use crate::Matrix;
use crate::io::{Position, ReadError};

/// The fields of a document that are not read yet.
pub(super) struct Fields<'a, const N: usize> {
    text: &'a str,
    kind: Kind,
    named: [(&'static str, Option<&'a RawValue>); N],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sparse<'a> {
    rows: usize,
    cols: usize,
    #[serde(borrow)]
    triplets: Vec<&'a RawValue>,
}

/// A failure in the document as a whole.
pub(super) fn whole(error: &serde_json::Error) -> ReadError {
    let at = Position { line: error.line().max(1), column: error.column().max(1) };
    ReadError::Json { at, message: without_place(error) }
}

/// The message of `serde_json`, which ends with the place where it has one.
fn without_place(error: &serde_json::Error) -> String {
    let message = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    message.strip_suffix(&place).map(str::to_owned).unwrap_or(message)
}

impl<'a, const N: usize> Fields<'a, N> {
    pub(super) fn new(
        text: &'a str,
        kind: Kind,
        named: [(&'static str, Option<&'a RawValue>); N],
    ) -> Self {
        Self { text, kind, named }
    }

    /// Where the document begins.
    pub(super) fn begin(&self) -> Position {
        self.position(self.text.trim_start())
    }

    /// Refuses fields that do not belong to the kind.
    pub(super) fn none_left(&self) -> Result<(), ReadError> {
        match self.named.iter().find_map(|(name, raw)| raw.map(|raw| (name, raw))) {
            Some((name, raw)) => {
                let message = format!("the kind {} has no field `{name}`", self.kind);
                Err(self.wrong(raw, message))
            }
            None => Ok(()),
        }
    }

    /// A vector of any length.
    pub(super) fn vector(&mut self, name: &'static str) -> Result<Vec<f64>, ReadError> {
        let raw = self.take(name)?;
        self.parse(raw)
    }

    /// Bounds, where `null` is none.
    pub(super) fn bounds(
        &mut self,
        name: &'static str,
        length: usize,
        none: f64,
    ) -> Result<Vec<f64>, ReadError> {
        let bounds: Vec<Option<f64>> = self.list(name, length)?;
        Ok(bounds.into_iter().map(|bound| bound.unwrap_or(none)).collect())
    }

    /// Coefficients of friction.
    pub(super) fn frictions(&mut self, name: &'static str) -> Result<Vec<f64>, ReadError> {
        let raw = self.take(name)?;
        let values: Vec<f64> = self.parse(raw)?;
        match values.iter().find(|value| **value < 0.0) {
            Some(value) => Err(self.wrong(raw, format!("`{name}` has {value}, which is negative"))),
            None => Ok(values),
        }
    }

    /// A square matrix of that order, as rows or as triplets.
    pub(super) fn matrix(&mut self, name: &'static str, order: usize) -> Result<Matrix, ReadError> {
        self.matrix_of(name, order, order)
    }

    /// A matrix of that size.
    pub(super) fn matrix_of(
        &mut self,
        name: &'static str,
        rows: usize,
        cols: usize,
    ) -> Result<Matrix, ReadError> {
        let raw = self.take(name)?;
        if raw.get().starts_with('{') {
            self.sparse(name, raw, rows, cols)
        } else {
            self.dense(name, raw, rows, cols)
        }
    }

    fn dense(
        &self,
        name: &str,
        raw: &'a RawValue,
        height: usize,
        width: usize,
    ) -> Result<Matrix, ReadError> {
        let rows: Vec<&RawValue> = self.parse(raw)?;
        self.check_length(raw, name, "rows", rows.len(), height)?;
        let mut matrix = Mat::zeros(height, width);
        for (i, raw) in rows.into_iter().enumerate() {
            let row: Vec<f64> = self.parse(raw)?;
            self.check_length(raw, name, &format!("entries in row {i}"), row.len(), width)?;
            row.into_iter().enumerate().for_each(|(j, v)| matrix[(i, j)] = v);
        }
        Ok(matrix.into())
    }

    fn sparse(
        &self,
        name: &str,
        raw: &'a RawValue,
        height: usize,
        width: usize,
    ) -> Result<Matrix, ReadError> {
        let Sparse { rows, cols, triplets } = self.parse(raw)?;
        self.check_length(raw, name, "rows", rows, height)?;
        self.check_length(raw, name, "columns", cols, width)?;
        let mut entries = Vec::with_capacity(triplets.len());
        for raw in triplets {
            let (row, col, value): (usize, usize, f64) = self.parse(raw)?;
            if row >= height || col >= width {
                let message =
                    format!("entry [{row}, {col}] of `{name}` is outside {height} x {width}");
                return Err(self.wrong(raw, message));
            }
            entries.push((row, col, value));
        }
        Ok(Matrix::from_entries(height, width, entries.into_iter()))
    }

    /// A list of that length.
    pub(super) fn list<T: Deserialize<'a>>(
        &mut self,
        name: &'static str,
        length: usize,
    ) -> Result<Vec<T>, ReadError> {
        let raw = self.take(name)?;
        let list: Vec<T> = self.parse(raw)?;
        self.check_length(raw, name, "entries", list.len(), length)?;
        Ok(list)
    }

    /// The same of a field that need not be there.
    pub(super) fn list_if_any<T: Deserialize<'a>>(
        &mut self,
        name: &'static str,
        length: usize,
    ) -> Result<Option<Vec<T>>, ReadError> {
        let is_there = self.named.iter().any(|(field, raw)| *field == name && raw.is_some());
        if is_there { self.list(name, length).map(Some) } else { Ok(None) }
    }

    fn take(&mut self, name: &'static str) -> Result<&'a RawValue, ReadError> {
        let field = self.named.iter_mut().find(|(field, _)| *field == name);
        field.and_then(|(_, raw)| raw.take()).ok_or_else(|| ReadError::Json {
            at: self.begin(),
            message: format!("the kind {} must have the field `{name}`", self.kind),
        })
    }

    fn check_length(
        &self,
        raw: &RawValue,
        name: &str,
        what: &str,
        length: usize,
        expected: usize,
    ) -> Result<(), ReadError> {
        if length == expected {
            return Ok(());
        }
        let message =
            format!("`{name}` has {length} {what}, but must have {expected}, to fit the vectors");
        Err(self.wrong(raw, message))
    }

    fn parse<T: Deserialize<'a>>(&self, raw: &'a RawValue) -> Result<T, ReadError> {
        serde_json::from_str(raw.get()).map_err(|error| {
            let begin = self.position(raw.get());
            let (line, column) = (error.line().max(1), error.column().max(1));
            let at = if line == 1 {
                Position { line: begin.line, column: begin.column + column - 1 }
            } else {
                Position { line: begin.line + line - 1, column }
            };
            ReadError::Json { at, message: without_place(&error) }
        })
    }

    fn wrong(&self, raw: &RawValue, message: String) -> ReadError {
        ReadError::Json { at: self.position(raw.get()), message }
    }

    /// Where a part of the text begins.
    fn position(&self, part: &str) -> Position {
        let offset = part.as_ptr().addr() - self.text.as_ptr().addr();
        let before = &self.text[..offset];
        let line_begin = before.rfind('\n').map_or(0, |end| end + 1);
        Position { line: before.matches('\n').count() + 1, column: offset - line_begin + 1 }
    }
}
