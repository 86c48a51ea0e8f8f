//! Pairs of codes and values, and the records that they form.

use nalgebra::Point2;

use crate::error::shown;
use crate::shapes::MOST_SHAPES;
use crate::{DrawingError, DrawingErrorKind, Place};

/// A code and its value.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair<'a> {
    pub(super) code: i32,
    pub(super) value: &'a str,
    /// The line of the value in the file.
    pub(super) line: usize,
}

/// The pairs of one entity or vertex, or of the beginning of a section or block.
#[derive(Debug, Clone)]
pub(super) struct Record<'a> {
    pub(super) kind: &'a str,
    pub(super) line: usize,
    pub(super) pairs: Vec<Pair<'a>>,
}

/// The largest number of entities, vertices and entries of tables. Chosen: ten times the allowed shapes, which take 100
/// MB of memory.
const MOST_RECORDS: usize = 10 * MOST_SHAPES;

/// Reads all records of a file.
pub(super) fn records(text: &str) -> Result<Vec<Record<'_>>, DrawingError> {
    let mut records: Vec<Record> = Vec::new();
    let mut lines = (1..).zip(text.lines());
    while let Some((line, code)) = lines.next() {
        let Ok(code) = code.trim().parse() else {
            // Some programs leave an empty line at the end.
            if code.trim().is_empty() && records.last().is_some_and(|it| it.kind == "EOF") {
                break;
            }
            return Err(no_code(line, code, records.last()));
        };
        let Some((line, value)) = lines.next() else {
            return Err(DrawingErrorKind::Truncated.at(&Place::new("DXF", Some(line))));
        };
        if records.len() > MOST_RECORDS {
            let kind = DrawingErrorKind::TooMany { what: "records", limit: MOST_RECORDS };
            return Err(kind.at(&Place::new("DXF", Some(line))));
        }
        let value = value.trim();
        match records.last_mut() {
            _ if code == 0 => records.push(Record { kind: value, line, pairs: Vec::new() }),
            Some(record) => record.pairs.push(Pair { code, value, line }),
            // Comments may come before the first section.
            None => {}
        }
    }
    Ok(records)
}

fn no_code(line: usize, text: &str, inside: Option<&Record>) -> DrawingError {
    let place = inside.map_or(Place::new("DXF", None), Record::place);
    let text = shown(text);
    let message =
        format!("line {line} has \"{text}\" in place of a group code: save it again as DXF");
    DrawingErrorKind::Syntax { message }.at(&place)
}

impl<'a> Record<'a> {
    /// Returns the entity with its handle, and its line.
    pub(super) fn place(&self) -> Place {
        let handle = self.text(5).map_or(String::new(), |handle| format!(" {}", shown(handle)));
        Place::new(format!("{}{handle}", shown(self.kind)), Some(self.line))
    }

    pub(super) fn text(&self, code: i32) -> Option<&'a str> {
        self.pairs.iter().find(|pair| pair.code == code).map(|pair| pair.value)
    }

    pub(super) fn layer(&self) -> &'a str {
        self.text(8).unwrap_or("0")
    }

    pub(super) fn number(&self, code: i32, default: f64) -> Result<f64, DrawingError> {
        let pair = self.pairs.iter().find(|pair| pair.code == code);
        pair.map_or(Ok(default), |pair| self.parsed(pair))
    }

    /// Returns the bits of the flags with this code; zero if there are none.
    pub(super) fn flags(&self, code: i32) -> i64 {
        self.text(code).and_then(|text| text.parse().ok()).unwrap_or(0)
    }

    /// Returns the point whose coordinates have the codes `code` and `code + 10`.
    pub(super) fn point(&self, code: i32) -> Result<Point2<f64>, DrawingError> {
        Ok(Point2::new(self.number(code, 0.0)?, self.number(code + 10, 0.0)?))
    }

    /// Whether the coordinates of the entity are mirrored, since it is seen from behind.
    pub(super) fn is_mirrored(&self) -> Result<bool, DrawingError> {
        /// The flag of polylines in space.
        const IN_SPACE: i64 = 8;
        // Lines, and polylines in space, have world coordinates whatever their normal.
        let is_in_space = self.kind == "POLYLINE" && self.flags(70) & IN_SPACE != 0;
        let is_of_world = self.kind == "LINE" || is_in_space;
        Ok(!is_of_world && self.number(230, 1.0)? < 0.0)
    }

    pub(super) fn parsed(&self, pair: &Pair) -> Result<f64, DrawingError> {
        pair.value.parse().map_err(|_| {
            let place = Place::new(self.place().entity, Some(pair.line));
            DrawingErrorKind::Number { text: shown(pair.value) }.at(&place)
        })
    }
}
