//! Matrices of Siconos: dense, in sparse blocks, and sparse.

use faer::Mat;

use crate::io::ReadError;
use crate::io::tokens::{SIZES, Token, Tokens};
use crate::sparse;
use lcp::Matrix;

/// A matrix of this size, in any storage.
pub(super) fn read(tokens: &mut Tokens<'_>, rows: usize, cols: usize) -> Result<Matrix, ReadError> {
    let storage = storage(tokens)?;
    sizes(tokens, rows, cols)?;
    match storage {
        0 => read_dense(tokens, rows, cols),
        1 => read_blocks(tokens, rows, cols),
        _ => read_sparse(tokens, rows, cols),
    }
}

/// The number of rows of the matrix that comes next.
pub(super) fn rows_ahead(tokens: &Tokens<'_>) -> Result<usize, ReadError> {
    let mut ahead = tokens.clone();
    storage(&mut ahead)?;
    ahead.count("the number of rows")
}

/// The word with which a matrix begins.
fn storage(tokens: &mut Tokens<'_>) -> Result<usize, ReadError> {
    let what = "the storage type: 0 (dense), 1 (blocks) or 2 (sparse)";
    tokens.one_of(&["0", "1", "2"], what)
}

fn sizes(tokens: &mut Tokens<'_>, rows: usize, cols: usize) -> Result<(), ReadError> {
    tokens.fixed("the number of rows", rows)?;
    tokens.fixed("the number of columns", cols)
}

fn read_dense(tokens: &mut Tokens<'_>, rows: usize, cols: usize) -> Result<Matrix, ReadError> {
    sizes(tokens, rows, cols)?;
    tokens.room_for(rows.checked_mul(cols), "the matrix")?;
    let by_columns = tokens.numbers(rows * cols, "the matrix")?;
    Ok(Mat::from_fn(rows, cols, |i, j| by_columns[j * rows + i]).into())
}

fn read_blocks(tokens: &mut Tokens<'_>, rows: usize, cols: usize) -> Result<Matrix, ReadError> {
    let blocks = tokens.count("the number of blocks")?;
    let block_rows = tokens.count("the number of block rows")?;
    let block_cols = tokens.count("the number of block columns")?;
    let row_ends = ascending(tokens, block_rows, 1, rows, "an end of a block")?;
    let col_ends = ascending(tokens, block_cols, 1, cols, "an end of a block")?;
    let most = block_rows + 1;
    let pointers = tokens.count_if(
        format_args!("1 to {most}, the number of block row pointers"),
        SIZES,
        |count| (1..=most).contains(&count),
    )?;
    tokens.fixed("the number of block columns that follow", blocks)?;
    tokens.room_for(Some(blocks), "the block columns")?;
    tokens.fixed("the first block row pointer", 0)?;
    let mut block_row = Vec::with_capacity(blocks);
    let ends = ascending(tokens, pointers - 1, 0, blocks, "a block row pointer")?;
    ends.into_iter().enumerate().for_each(|(row, end)| block_row.resize(end, row));
    let block_col = (0..blocks).map(|_| tokens.index(block_cols, "a block column"));
    let block_col = block_col.collect::<Result<Vec<_>, _>>()?;
    let mut triplets = Vec::new();
    for (number, (&row, &col)) in block_row.iter().zip(&block_col).enumerate() {
        tokens.fixed("the number of the block", number)?;
        let (of_rows, of_cols) = (range(&row_ends, row), range(&col_ends, col));
        tokens.room_for(of_rows.len().checked_mul(of_cols.len()), "a block")?;
        let values = tokens.numbers(of_rows.len() * of_cols.len(), "a block")?;
        let places = of_cols.flat_map(|j| of_rows.clone().map(move |i| (i, j)));
        triplets.extend(places.zip(values).map(|((i, j), v)| (i, j, v)));
    }
    Ok(sparse(rows, cols, triplets))
}

/// Reads `count` numbers, each of which exceeds the one before by at least `step`, up to the last
/// one.
fn ascending(
    tokens: &mut Tokens<'_>,
    count: usize,
    step: usize,
    last: usize,
    what: &'static str,
) -> Result<Vec<usize>, ReadError> {
    tokens.room_for(Some(count), what)?;
    if count == 0 && last > 0 {
        let expected = format_args!("{what} at {last}");
        return Err(ReadError::unexpected(tokens.position(), expected, "none", SIZES));
    }
    let mut least = step;
    let number = |index| {
        let is_last = index + 1 == count;
        let expected = format_args!("{what} of {least} or more, the last one {last}");
        let number = tokens.count_if(expected, SIZES, |it| {
            it >= least && if is_last { it == last } else { it <= last }
        })?;
        least = number + step;
        Ok(number)
    };
    (0..count).map(number).collect()
}

fn range(ends: &[usize], index: usize) -> std::ops::Range<usize> {
    let begin = index.checked_sub(1).map_or(0, |before| ends[before]);
    begin..ends[index]
}

fn read_sparse(tokens: &mut Tokens<'_>, rows: usize, cols: usize) -> Result<Matrix, ReadError> {
    let what = "the origin: 1 (triplets), 2 (by columns) or 3 (by rows)";
    let origin = tokens.expect(what)?;
    let (size, is_triplets) = skip_banner(tokens)?;
    // Rows are written as the columns of the transpose.
    let (written_rows, written_cols) = if origin.text == "3" { (cols, rows) } else { (rows, cols) };
    let expected = format!("{written_rows}-by-{written_cols}");
    if size.text.trim_end_matches(',') != expected {
        return Err(size.unexpected(expected, SIZES));
    }
    tokens.words("nzmax:")?;
    tokens.count("nzmax")?;
    tokens.words("nnz:")?;
    let token = tokens.expect("the number of entries")?;
    let nnz = Token { text: token.text.trim_end_matches(','), ..token };
    let nnz = nnz.count_if("the number of entries", "", |_| true)?;
    let mut triplets = match (origin.text, is_triplets) {
        ("1", true) => read_triplets(tokens, rows, cols, nnz)?,
        ("2" | "3", false) => read_columns(tokens, written_rows, written_cols, nnz)?,
        _ => return Err(origin.unexpected(what, "it must suit the entries that follow")),
    };
    if origin.text == "3" {
        for (i, j, _) in &mut triplets {
            std::mem::swap(i, j);
        }
    }
    Ok(sparse(rows, cols, triplets))
}

/// The word with the size, and whether triplets follow.
fn skip_banner<'a>(tokens: &mut Tokens<'a>) -> Result<(Token<'a>, bool), ReadError> {
    let what = "the size, as 3-by-3";
    let first = tokens.expect(what)?;
    let (mut token, mut is_triplets) = (first, false);
    while !token.text.contains("-by-") {
        is_triplets = token.text == "triplet:";
        // A file without a size has its error at the place of the banner, not at its end.
        let missing = || first.unexpected(what, "it follows a line about the library");
        token = tokens.next().ok_or_else(missing)?;
    }
    Ok((token, is_triplets))
}

type Triplets = Vec<(usize, usize, f64)>;

fn read_triplets(
    tokens: &mut Tokens<'_>,
    rows: usize,
    cols: usize,
    nnz: usize,
) -> Result<Triplets, ReadError> {
    tokens.room_for(nnz.checked_mul(4), "the list of entries")?;
    let entry = |_| {
        let (row, col) = (tokens.index(rows, "a row")?, tokens.index(cols, "a column")?);
        tokens.words(":")?;
        Ok((row, col, tokens.number("the value of an entry")?))
    };
    (0..nnz).map(entry).collect()
}

fn read_columns(
    tokens: &mut Tokens<'_>,
    rows: usize,
    cols: usize,
    nnz: usize,
) -> Result<Triplets, ReadError> {
    tokens.words("1-norm:")?;
    tokens.expect("the norm")?;
    tokens.room_for(nnz.checked_mul(3), "the list of entries")?;
    let mut triplets = Vec::with_capacity(nnz);
    for col in 0..cols {
        tokens.words("col")?;
        tokens.fixed("the column", col)?;
        tokens.words(": locations")?;
        tokens.fixed("the first location", triplets.len())?;
        tokens.words("to")?;
        let last = tokens.expect("the last location")?;
        // The last location of an empty first column is -1.
        let end = last.text.parse::<i64>().ok().and_then(|last| last.checked_add(1));
        let end = end.and_then(|end| usize::try_from(end).ok());
        let Some(end) = end.filter(|end| (triplets.len()..=nnz).contains(end)) else {
            return Err(last.unexpected("the last location of the column", SIZES));
        };
        while triplets.len() < end {
            let row = tokens.index(rows, "a row")?;
            tokens.words(":")?;
            triplets.push((row, col, tokens.number("the value of an entry")?));
        }
    }
    Ok(triplets)
}
