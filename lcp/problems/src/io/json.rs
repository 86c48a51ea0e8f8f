//! The JSON of this crate: one object with a `kind` and the fields of that kind.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::from_str;
use serde_json::value::RawValue;

use super::{Position, Problem, ReadError};
use lcp::Error;
use lcp::Stored;

/// The field that decides which other fields a document has.
#[derive(Deserialize)]
struct Tag {
    kind: Kind,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Lcp,
    Horizontal,
    Mixed,
    Boxed,
    Friction,
    Contact,
    Qp,
}

pub(super) fn read(text: &str) -> Result<Problem, ReadError> {
    let Tag { kind } = parsed(text)?;
    match kind {
        Kind::Lcp => made(text).map(Problem::Lcp),
        Kind::Horizontal => made(text).map(Problem::Horizontal),
        Kind::Mixed => made(text).map(Problem::Mixed),
        Kind::Boxed => made(text).map(Problem::Boxed),
        Kind::Friction => made(text).map(Problem::Friction),
        Kind::Contact => made(text).map(Problem::Contact),
        Kind::Qp => made(text).map(Problem::Qp),
    }
}

/// A problem as JSON text that [`read`](crate::io::read) gives back, to the last digit.
///
/// ```
/// use lcp_problems::io::{read, to_json};
/// let file = read(b"1  2  -1", None)?;
/// let json = to_json(&file.problem);
/// assert_eq!(json, r#"{"kind":"lcp","m":[[2.0]],"q":[-1.0]}"#);
/// assert_eq!(to_json(&read(json.as_bytes(), None)?.problem), json);
/// # Ok::<(), lcp_problems::io::ReadError>(())
/// ```
pub fn to_json(problem: &Problem) -> String {
    serde_json::to_string(problem).unwrap_or_else(|e| unreachable!("numbers and lists: {e}"))
}

fn made<P: Stored>(text: &str) -> Result<P, ReadError> {
    P::from_data(parsed(text)?)
        .map_err(|source| ReadError::Refused { at: place(text, &source), source })
}

fn parsed<'a, T: Deserialize<'a>>(text: &'a str) -> Result<T, ReadError> {
    from_str(text).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        // The message ends with the place if it has one.
        let message = error.to_string();
        let place = format!(" at line {line} column {column}");
        let message = message.strip_suffix(&place).unwrap_or(&message).to_owned();
        ReadError::Json { at: Position { line: line.max(1), column: column.max(1) }, message }
    })
}

/// The place at which the datum of an error begins: a field, a row or an entry of a matrix, or else the
/// document.
fn place(text: &str, error: &Error) -> Position {
    let fields: BTreeMap<String, &RawValue> = from_str(text).unwrap_or_default();
    let field = |name: &str| fields.get(&name.to_ascii_lowercase()).copied();
    let part = match error {
        Error::Shape { what, .. }
        | Error::NotFinite { what, .. }
        | Error::NotSymmetric { what, .. } => field(what),
        Error::Setting { name, .. } | Error::Length { name, .. } => field(name),
        Error::Bounds { what: "row", .. } => field("l"),
        Error::Bounds { .. } => field("lower"),
        Error::Indefinite { .. } => field("k"),
        Error::NotConvex { .. } => field("p"),
        // These errors do not name the matrix, but have its size.
        Error::RowLength { row, len, expected } => {
            let length = |row: &RawValue| items(row).map(|it| it.len());
            let matrices = fields.values().filter_map(|it| items(it));
            let rows = matrices.filter_map(|it| Some([*it.first()?, *it.get(*row)?]));
            let mut rows = rows.filter(|[first, _]| length(first) == Some(*expected));
            rows.find(|[_, it]| length(it) == Some(*len)).map(|[_, it]| it)
        }
        Error::Outside { row, col, rows, cols } => {
            let lists = fields.values().filter_map(|it| from_str::<Sparse<'_>>(it.get()).ok());
            let lists = lists.filter(|it| [it.rows, it.cols] == [*rows, *cols]);
            let mut entries = lists.filter_map(|it| items(it.triplets)).flatten();
            entries.find(|it| {
                let place = from_str(it.get()).map(|(i, j, _): (usize, usize, f64)| (i, j));
                place.is_ok_and(|place| place == (*row, *col))
            })
        }
        _ => None,
    };
    let part = part.map_or(text.trim_start(), RawValue::get);
    let before = &text[..part.as_ptr().addr() - text.as_ptr().addr()];
    let line_begin = before.rfind('\n').map_or(0, |end| end + 1);
    Position { line: before.matches('\n').count() + 1, column: before.len() - line_begin + 1 }
}

#[derive(Deserialize)]
struct Sparse<'a> {
    rows: usize,
    cols: usize,
    #[serde(borrow)]
    triplets: &'a RawValue,
}

fn items(list: &RawValue) -> Option<Vec<&RawValue>> {
    from_str(list.get()).ok()
}
