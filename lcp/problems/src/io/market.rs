//! Matrices and vectors in the Matrix Market format (Boisvert, Pozo and Remington 1996): `array` and
//! `coordinate`; `real`, `integer` and `pattern`; `general`, `symmetric` and `skew-symmetric`. Entries of the
//! same place add up.
//!
//! A file holds one matrix, so that a problem is put together from several:
//!
//! ```
//! use lcp::Lcp;
//! use lcp_problems::io::market;
//! let q = market::read_vector(b"%%MatrixMarket matrix array real general\n2 1\n-5\n-6\n")?;
//! let m = b"%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 1\n2 2 2\n";
//! let m = market::read_matrix(m, q.len(), q.len())?;
//! assert_eq!((m[(0, 1)], m.is_sparse()), (1.0, true));
//! let problem = Lcp::new(m, q)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use faer::Mat;

use super::ReadError;
use super::tokens::Tokens;
use crate::sparse;
use lcp::Matrix;

/// The beginning of every file of this format.
pub(super) const BANNER: &str = "%%MatrixMarket";

const LINE: &str =
    "the first line is, for instance, `%%MatrixMarket matrix coordinate real general`";
/// A vector with zeros may be longer than its file by this factor; a longer one is an error.
const ZEROS: usize = 1000;

/// The contents of the first line.
#[derive(Debug, Clone, Copy)]
struct Header {
    is_array: bool,
    is_pattern: bool,
    /// The sign of the mirror image of an entry, if only one of the two is written.
    mirrored: Option<f64>,
}

/// Reads a matrix of this size: dense from an `array`, sparse from coordinates.
///
/// # Errors
/// [`ReadError`], with the place in the content.
pub fn read_matrix(content: &[u8], rows: usize, cols: usize) -> Result<Matrix, ReadError> {
    let text = String::from_utf8_lossy(content);
    let header = Header::of(&text)?;
    let mut tokens = Tokens::with_comments(&text, '%');
    for (what, expected) in [("the number of rows", rows), ("the number of columns", cols)] {
        let remedy = "the matrix must fit the other parts of the problem";
        tokens.count_if(format_args!("{what} {expected}"), remedy, |size| size == expected)?;
    }
    if header.mirrored.is_some() && rows != cols {
        let remedy = "only square matrices are symmetric or skew-symmetric";
        let (at, found) = (tokens.position(), format_args!("{rows} x {cols}"));
        return Err(ReadError::unexpected(at, "as many rows as columns", found, remedy));
    }
    let entries = if header.is_array {
        array(&mut tokens, header, rows, cols)?
    } else {
        coordinates(&mut tokens, header, rows, cols)?
    };
    tokens.end("correct the sizes, or remove the rest")?;
    let all = entries.into_iter().flat_map(|(i, j, v)| {
        let mirrored = header.mirrored.filter(|_| i != j).map(|sign| (j, i, sign * v));
        [(i, j, v)].into_iter().chain(mirrored)
    });
    if !header.is_array {
        return Ok(sparse(rows, cols, all));
    }
    let mut matrix = Mat::zeros(rows, cols);
    all.for_each(|(i, j, v)| matrix[(i, j)] = v);
    Ok(matrix.into())
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
            let expected = format!("`{}`", known.join("` or `"));
            let token = words.expect(&expected)?;
            let found = known.iter().find(|word| word.eq_ignore_ascii_case(token.text));
            found.copied().ok_or_else(|| token.unexpected(expected, LINE))
        };
        word(&[BANNER])?;
        word(&["matrix"])?;
        let is_array = word(&["coordinate", "array"])? == "array";
        let numbers: &[_] =
            if is_array { &["real", "integer"] } else { &["real", "integer", "pattern"] };
        let is_pattern = word(numbers)? == "pattern";
        let mirrored = match word(&["general", "symmetric", "skew-symmetric"])? {
            "general" => None,
            "symmetric" => Some(1.0),
            _ => Some(-1.0),
        };
        words.end(LINE)?;
        Ok(Self { is_array, is_pattern, mirrored })
    }

    /// The first row that is written in a column.
    fn first_row(self, col: usize) -> usize {
        match self.mirrored {
            None => 0,
            Some(sign) if sign > 0.0 => col,
            Some(_) => col + 1,
        }
    }
}

/// All entries by columns; only the lower triangle for a symmetric matrix.
fn array(
    tokens: &mut Tokens<'_>,
    header: Header,
    rows: usize,
    cols: usize,
) -> Result<Vec<(usize, usize, f64)>, ReadError> {
    let all = rows.checked_mul(cols);
    let needed = match header.mirrored {
        None => all,
        Some(sign) if sign > 0.0 => all.map(|all| all.midpoint(rows)),
        Some(_) => all.map(|all| (all - rows) / 2),
    };
    tokens.room_for(needed, "the matrix")?;
    let places = (0..cols).flat_map(|j| (header.first_row(j)..rows).map(move |i| (i, j)));
    places.map(|(i, j)| Ok((i, j, tokens.number("an entry of the matrix")?))).collect()
}

/// The number of entries, then row and column of each, from 1, with its value, which is absent in a pattern.
fn coordinates(
    tokens: &mut Tokens<'_>,
    header: Header,
    rows: usize,
    cols: usize,
) -> Result<Vec<(usize, usize, f64)>, ReadError> {
    let is_pattern = header.is_pattern;
    let count = tokens.count("the number of entries")?;
    tokens.room_for(count.checked_mul(if is_pattern { 2 } else { 3 }), "the list of entries")?;
    let entry = |_| {
        let at = tokens.position();
        let (row, col) = (place(tokens, rows, "a row")?, place(tokens, cols, "a column")?);
        let value = if is_pattern { 1.0 } else { tokens.number("the value of an entry")? };
        if row >= header.first_row(col) {
            return Ok((row, col, value));
        }
        let found = format_args!("the place ({}, {})", row + 1, col + 1);
        let remedy = "a symmetric matrix is written without its upper triangle, a skew-symmetric one \
                      without its diagonal too";
        Err(ReadError::unexpected(at, "an entry of the lower triangle", found, remedy))
    };
    (0..count).map(entry).collect()
}

/// A row or column, from 1 in the file and from 0 here.
fn place(tokens: &mut Tokens<'_>, size: usize, what: &'static str) -> Result<usize, ReadError> {
    let expected = format_args!("{what} from 1 to {size}");
    let place = tokens.count_if(expected, "indices begin at 1", |it| (1..=size).contains(&it))?;
    Ok(place - 1)
}
