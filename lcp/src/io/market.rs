//! Matrices and vectors in the Matrix Market format (Boisvert, Pozo and Remington 1996): `array` and
//! `coordinate`; `real`, `integer` and `pattern`; `general`, `symmetric` and `skew-symmetric`. Entries of the
//! same place add up.
//!
//! A file holds one matrix, so that a problem is put together from several:
//!
//! ```
//! use lcp::Lcp;
//! use lcp::io::market;
//! let q = market::read_vector(b"%%MatrixMarket matrix array real general\n2 1\n-5\n-6\n")?;
//! let m = b"%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 1\n2 2 2\n";
//! let m = market::read_matrix(m, q.len(), q.len())?;
//! assert_eq!((m[(0, 1)], m.is_sparse()), (1.0, true));
//! let problem = Lcp::new(m, q)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use faer::Mat;

use super::tokens::{Token, Tokens};
use super::{Position, ReadError};
use crate::Matrix;

/// How a file of this format begins.
pub(super) const BANNER: &str = "%%MatrixMarket";

const LINE: &str =
    "the first line is, for instance, `%%MatrixMarket matrix coordinate real general`";
/// A vector with zeros may be longer than its file by this factor; beyond it is a mistake.
const ZEROS: usize = 1000;
const SIZES: &str = "the matrix must fit the other parts of the problem";

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Symmetry {
    General,
    Symmetric,
    Skew,
}

/// What the first line says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Header {
    is_array: bool,
    is_pattern: bool,
    symmetry: Symmetry,
}

/// Reads a matrix of that size: dense from an `array`, sparse from coordinates.
///
/// # Errors
/// [`ReadError`], with the place in the content.
pub fn read_matrix(content: &[u8], rows: usize, cols: usize) -> Result<Matrix, ReadError> {
    let text = String::from_utf8_lossy(content);
    let header = Header::of(&text)?;
    let mut tokens = Tokens::with_comments(&text, '%');
    for (what, expected) in [("the number of rows", rows), ("the number of columns", cols)] {
        let token = tokens.expect(|| what.to_owned())?;
        if token.count(what)? != expected {
            return Err(token.unexpected(format!("{what} {expected}"), SIZES));
        }
    }
    let matrix = if header.is_array {
        array(&mut tokens, header.symmetry, rows, cols)?
    } else {
        coordinates(&mut tokens, header, rows, cols)?
    };
    tokens.end("correct the sizes, or take it out")?;
    Ok(matrix)
}

/// Reads a vector: a matrix of one column.
///
/// # Errors
/// [`ReadError`], with the place in the content.
pub fn read_vector(content: &[u8]) -> Result<Vec<f64>, ReadError> {
    let text = String::from_utf8_lossy(content);
    Header::of(&text)?;
    let mut tokens = Tokens::with_comments(&text, '%');
    let rows = tokens.count("the number of rows")?;
    let words = text.split_whitespace().count();
    if rows / ZEROS > words {
        return Err(ReadError::TooShort {
            at: tokens.position(),
            what: "the vector",
            needed: rows,
            left: words,
        });
    }
    let matrix = read_matrix(content, rows, 1)?;
    Ok((0..rows).map(|i| matrix[(i, 0)]).collect())
}

impl Header {
    fn of(text: &str) -> Result<Self, ReadError> {
        let line = text.lines().next().unwrap_or_default();
        let mut words = Tokens::new(line);
        let mut word = |known: &[&'static str]| -> Result<&'static str, ReadError> {
            let expected = || format!("`{}`", known.join("` or `"));
            let token: Token<'_> = words.expect(expected)?;
            let found = known.iter().find(|word| word.eq_ignore_ascii_case(token.text));
            found.copied().ok_or_else(|| token.unexpected(expected(), LINE))
        };
        word(&[BANNER])?;
        word(&["matrix"])?;
        let is_array = word(&["coordinate", "array"])? == "array";
        let numbers: &[_] =
            if is_array { &["real", "integer"] } else { &["real", "integer", "pattern"] };
        let is_pattern = word(numbers)? == "pattern";
        let symmetry = match word(&["general", "symmetric", "skew-symmetric"])? {
            "general" => Symmetry::General,
            "symmetric" => Symmetry::Symmetric,
            _ => Symmetry::Skew,
        };
        words.end(LINE)?;
        Ok(Self { is_array, is_pattern, symmetry })
    }
}

impl Symmetry {
    /// The first row that is written of a column.
    fn first_row(self, col: usize) -> usize {
        match self {
            Self::General => 0,
            Self::Symmetric => col,
            Self::Skew => col + 1,
        }
    }

    /// The value of the mirrored entry, of a place off the diagonal.
    fn mirrored(self, value: f64) -> Option<f64> {
        match self {
            Self::General => None,
            Self::Symmetric => Some(value),
            Self::Skew => Some(-value),
        }
    }

    fn check(self, rows: usize, cols: usize, at: Position) -> Result<(), ReadError> {
        if self == Self::General || rows == cols {
            return Ok(());
        }
        Err(ReadError::Unexpected {
            at,
            expected: "as many rows as columns".to_owned(),
            found: format!("{rows} x {cols}"),
            remedy: "only square matrices are symmetric or skew-symmetric",
        })
    }
}

/// All entries by columns, of a symmetric matrix its lower triangle.
fn array(
    tokens: &mut Tokens<'_>,
    symmetry: Symmetry,
    rows: usize,
    cols: usize,
) -> Result<Matrix, ReadError> {
    let at = tokens.position();
    symmetry.check(rows, cols, at)?;
    let all = rows.checked_mul(cols);
    let needed = match symmetry {
        Symmetry::General => all,
        Symmetry::Symmetric => all.map(|all| all.midpoint(rows)),
        Symmetry::Skew => all.map(|all| (all - rows) / 2),
    };
    tokens.room_for(needed, "the matrix")?;
    let mut matrix = Mat::zeros(rows, cols);
    for col in 0..cols {
        for row in symmetry.first_row(col)..rows {
            let value = tokens.number("an entry of the matrix")?;
            matrix[(row, col)] = value;
            if let Some(mirrored) = symmetry.mirrored(value).filter(|_| row != col) {
                matrix[(col, row)] = mirrored;
            }
        }
    }
    Ok(matrix.into())
}

/// The number of entries, then row and column of each, from 1, with its value, which a pattern has not.
fn coordinates(
    tokens: &mut Tokens<'_>,
    header: Header,
    rows: usize,
    cols: usize,
) -> Result<Matrix, ReadError> {
    let Header { is_pattern, symmetry, .. } = header;
    symmetry.check(rows, cols, tokens.position())?;
    let count = tokens.count("the number of entries")?;
    tokens.room_for(count.checked_mul(if is_pattern { 2 } else { 3 }), "the list of entries")?;
    let mut entries = Vec::with_capacity(count);
    for _ in 0..count {
        let at = tokens.position();
        let row = place(tokens, rows, "a row")?;
        let col = place(tokens, cols, "a column")?;
        let value = if is_pattern { 1.0 } else { tokens.number("the value of an entry")? };
        if row < symmetry.first_row(col) {
            return Err(ReadError::Unexpected {
                at,
                expected: "an entry of the lower triangle".to_owned(),
                found: format!("the place ({}, {})", row + 1, col + 1),
                remedy: "a symmetric matrix is written without its upper triangle, a skew-symmetric one \
                         without its diagonal too",
            });
        }
        entries.push((row, col, value));
        if let Some(mirrored) = symmetry.mirrored(value).filter(|_| row != col) {
            entries.push((col, row, mirrored));
        }
    }
    Ok(Matrix::from_entries(rows, cols, entries.into_iter()))
}

/// A row or column, from 1 in the file and from 0 here.
fn place(tokens: &mut Tokens<'_>, size: usize, what: &'static str) -> Result<usize, ReadError> {
    let token = tokens.expect(|| what.to_owned())?;
    match token.count(what)?.checked_sub(1) {
        Some(index) if index < size => Ok(index),
        _ => Err(token.unexpected(format!("{what} from 1 to {size}"), "indices begin at 1")),
    }
}
