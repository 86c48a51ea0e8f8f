//! QPS, the format of convex quadratic programs: MPS with a section for the quadratic terms.
//!
//! Words are separated by white space (free format). If that does not fit they stand in columns (fixed format), so
//! that names may have spaces.

mod line;
mod program;

use super::problem::posed;
use super::tokens::Token;
use super::{Position, Problem, ReadError};
use line::Layout;
use program::{Program, Section};

/// Reads a program in the format that fits, or fails with the error of the format that comes further.
pub(super) fn read(text: &str) -> Result<Problem, ReadError> {
    parse(text, Layout::Free).or_else(|free| {
        parse(text, Layout::Fixed)
            .map_err(|fixed| if fixed.reach() > free.reach() { fixed } else { free })
    })
}

fn parse(text: &str, layout: Layout) -> Result<Problem, ReadError> {
    let mut program = Program::default();
    let mut section = None;
    let mut at = Position { line: 1, column: 1 };
    for (number, line) in text.lines().enumerate() {
        at = Position { line: number + 1, column: 1 };
        if line.trim().is_empty() || line.starts_with('*') {
            continue;
        }
        if line.starts_with(char::is_whitespace) {
            let words = layout.words(line, at.line);
            let Some(section) = section.filter(|_| !words.is_empty()) else {
                return Err(unexpected_end(at, "a header, as NAME or ROWS, where a line begins"));
            };
            program.line(section, &words)?;
            continue;
        }
        let words = Layout::Free.words(line, at.line);
        let [header, rest @ ..] = words.as_slice() else { continue };
        section = match header.text {
            "NAME" => None,
            "ENDATA" => return posed(program.finish(), Problem::Qp, at),
            _ => Some(section_of(header)?),
        };
        match (section, rest) {
            (Some(Section::Sense), [_]) => program.line(Section::Sense, rest)?,
            (Some(Section::Triangle | Section::Quadratic), [row]) => {
                program.check_objective(*row)?;
            }
            (Some(_), [word, ..]) => {
                return Err(word.unexpected("a header alone", "lines of data begin with a space"));
            }
            _ => {}
        }
    }
    Err(unexpected_end(at, "the line ENDATA"))
}

fn unexpected_end(at: Position, expected: &str) -> ReadError {
    ReadError::unexpected(at, expected, "a line without it", "complete the file")
}

fn section_of(header: &Token<'_>) -> Result<Section, ReadError> {
    Ok(match header.text {
        "OBJSENSE" => Section::Sense,
        "ROWS" => Section::Rows,
        "COLUMNS" => Section::Columns,
        "RHS" => Section::Right,
        "RANGES" => Section::Ranges,
        "BOUNDS" => Section::Bounds,
        "QUADOBJ" | "QSECTION" => Section::Triangle,
        "QMATRIX" => Section::Quadratic,
        _ => {
            let expected = "one of NAME, OBJSENSE, ROWS, COLUMNS, RHS, RANGES, BOUNDS, QUADOBJ, QSECTION, \
                            QMATRIX, ENDATA";
            let remedy = "other sections, such as those of integers and cones, have no solver here";
            return Err(header.unexpected(expected, remedy));
        }
    })
}
