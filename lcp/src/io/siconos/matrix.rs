//! Matrices of Siconos: dense, in sparse blocks, and sparse.

use faer::Mat;

use crate::Matrix;
use crate::io::ReadError;
use crate::io::tokens::{Token, Tokens};

const SIZE: &str = "the size, as 3-by-3";
const SIZES: &str = "sizes must agree with each other";

/// A matrix of that size, in any storage.
pub(super) fn read(tokens: &mut Tokens<'_>, rows: usize, cols: usize) -> Result<Matrix, ReadError> {
    let storage = storage(tokens)?;
    tokens.fixed("the number of rows", rows)?;
    tokens.fixed("the number of columns", cols)?;
    match storage {
        Storage::Dense => read_dense(tokens, rows, cols),
        Storage::Blocks => read_blocks(tokens, rows, cols),
        Storage::Sparse => read_sparse(tokens, rows, cols),
    }
}

pub(super) enum Storage {
    Dense,
    Blocks,
    Sparse,
}

/// The word with which a matrix begins.
pub(super) fn storage(tokens: &mut Tokens<'_>) -> Result<Storage, ReadError> {
    const STORAGE: &str = "the storage type: 0 (dense), 1 (blocks) or 2 (sparse)";
    let token = tokens.expect(|| STORAGE.to_owned())?;
    match token.text {
        "0" => Ok(Storage::Dense),
        "1" => Ok(Storage::Blocks),
        "2" => Ok(Storage::Sparse),
        _ => Err(token.unexpected(STORAGE.to_owned(), "no other storage exists")),
    }
}

fn read_dense(tokens: &mut Tokens<'_>, rows: usize, cols: usize) -> Result<Matrix, ReadError> {
    tokens.fixed("the number of rows", rows)?;
    tokens.fixed("the number of columns", cols)?;
    tokens.room_for(rows.checked_mul(cols), "the matrix")?;
    let by_columns = tokens.numbers(rows * cols, "the matrix")?;
    Ok(Mat::from_fn(rows, cols, |i, j| by_columns[j * rows + i]).into())
}

fn read_blocks(tokens: &mut Tokens<'_>, rows: usize, cols: usize) -> Result<Matrix, ReadError> {
    let blocks = tokens.count("the number of blocks")?;
    let block_rows = tokens.count("the number of block rows")?;
    let block_cols = tokens.count("the number of block columns")?;
    let row_ends = read_ends(tokens, block_rows, rows)?;
    let col_ends = read_ends(tokens, block_cols, cols)?;
    let pointer_count = tokens.expect(|| "the number of block row pointers".to_owned())?;
    let pointers = pointer_count.count("the number of block row pointers")?;
    if pointers == 0 || pointers > block_rows + 1 {
        let expected = format!("1 to {} block row pointers", block_rows + 1);
        return Err(pointer_count.unexpected(expected, SIZES));
    }
    tokens.fixed("the number of block columns that follow", blocks)?;
    let block_row = read_block_rows(tokens, pointers, blocks)?;
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
    Ok(Matrix::from_entries(rows, cols, triplets.into_iter()))
}

/// Where every block ends: increasing up to the number of rows or columns.
fn read_ends(tokens: &mut Tokens<'_>, count: usize, size: usize) -> Result<Vec<usize>, ReadError> {
    tokens.room_for(Some(count), "the ends of the blocks")?;
    let mut ends = Vec::with_capacity(count);
    let mut last = 0;
    if count == 0 && size > 0 {
        return Err(ReadError::Unexpected {
            at: tokens.position(),
            expected: format!("blocks that cover {size} rows or columns"),
            found: "no block".to_owned(),
            remedy: SIZES,
        });
    }
    for index in 0..count {
        let token = tokens.expect(|| "the end of a block".to_owned())?;
        let end = token.count("the end of a block")?;
        let is_last = index + 1 == count;
        if end <= last || end > size || (is_last && end != size) {
            let expected = format!("an end of a block above {last}, the last one {size}");
            return Err(token.unexpected(expected, SIZES));
        }
        ends.push(end);
        last = end;
    }
    Ok(ends)
}

/// The block row of every block, from the pointers to the first block of every block row.
fn read_block_rows(
    tokens: &mut Tokens<'_>,
    pointers: usize,
    blocks: usize,
) -> Result<Vec<usize>, ReadError> {
    tokens.room_for(Some(pointers), "the block row pointers")?;
    tokens.room_for(Some(blocks), "the block columns")?;
    let mut rows = Vec::with_capacity(blocks);
    for index in 0..pointers {
        let token = tokens.expect(|| "a block row pointer".to_owned())?;
        let pointer = token.count("a block row pointer")?;
        let begun = rows.len();
        let is_last = index + 1 == pointers;
        if pointer < begun || pointer > blocks || (is_last && pointer != blocks) {
            let expected = format!("a block row pointer of {begun} or more, the last one {blocks}");
            return Err(token.unexpected(expected, SIZES));
        }
        match index.checked_sub(1) {
            Some(row) => rows.resize(pointer, row),
            None if pointer != 0 => {
                return Err(token.unexpected("0, the first block row pointer".to_owned(), SIZES));
            }
            None => {}
        }
    }
    Ok(rows)
}

fn range(ends: &[usize], index: usize) -> std::ops::Range<usize> {
    let begin = index.checked_sub(1).map_or(0, |before| ends[before]);
    begin..ends[index]
}

fn read_sparse(tokens: &mut Tokens<'_>, rows: usize, cols: usize) -> Result<Matrix, ReadError> {
    let what = "the origin: 1 (triplets), 2 (by columns) or 3 (by rows)";
    let origin = tokens.expect(|| what.to_owned())?;
    let (size, is_triplets) = skip_banner(tokens)?;
    // Rows are written as the columns of the transpose.
    let (written_rows, written_cols) = if origin.text == "3" { (cols, rows) } else { (rows, cols) };
    let expected = format!("{written_rows}-by-{written_cols}");
    if size.text.trim_end_matches(',') != expected {
        return Err(size.unexpected(expected, SIZES));
    }
    tokens.word("nzmax:")?;
    tokens.count("nzmax")?;
    tokens.word("nnz:")?;
    let token = tokens.expect(|| "the number of entries".to_owned())?;
    let nnz = Token { text: token.text.trim_end_matches(','), ..token };
    let nnz = nnz.count("the number of entries")?;
    let mut triplets = match (origin.text, is_triplets) {
        ("1", true) => read_triplets(tokens, rows, cols, nnz)?,
        ("2" | "3", false) => read_columns(tokens, written_rows, written_cols, nnz)?,
        _ => return Err(origin.unexpected(what.to_owned(), "it must suit the entries that follow")),
    };
    if origin.text == "3" {
        for (i, j, _) in &mut triplets {
            std::mem::swap(i, j);
        }
    }
    Ok(Matrix::from_entries(rows, cols, triplets.into_iter()))
}

/// The word with the size, and whether triplets follow.
fn skip_banner<'a>(tokens: &mut Tokens<'a>) -> Result<(Token<'a>, bool), ReadError> {
    let first = tokens.expect(|| SIZE.to_owned())?;
    let (mut token, mut is_triplets) = (first, false);
    while !token.text.contains("-by-") {
        is_triplets = token.text == "triplet:";
        // Without a size the file went wrong where the banner should begin, and not at its end.
        let missing = || first.unexpected(SIZE.to_owned(), "it follows a line about the library");
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
    let mut triplets = Vec::with_capacity(nnz);
    for _ in 0..nnz {
        let row = tokens.index(rows, "a row")?;
        let col = tokens.index(cols, "a column")?;
        tokens.word(":")?;
        triplets.push((row, col, tokens.number("the value of an entry")?));
    }
    Ok(triplets)
}

fn read_columns(
    tokens: &mut Tokens<'_>,
    rows: usize,
    cols: usize,
    nnz: usize,
) -> Result<Triplets, ReadError> {
    tokens.word("1-norm:")?;
    tokens.expect(|| "the norm".to_owned())?;
    tokens.room_for(nnz.checked_mul(3), "the list of entries")?;
    let mut triplets = Vec::with_capacity(nnz);
    for col in 0..cols {
        tokens.word("col")?;
        tokens.fixed("the column", col)?;
        tokens.word(":")?;
        tokens.word("locations")?;
        tokens.fixed("the first location", triplets.len())?;
        tokens.word("to")?;
        let last = tokens.expect(|| "the last location".to_owned())?;
        let end = last
            .text
            .parse::<i64>()
            .ok()
            .and_then(|last| usize::try_from(last.checked_add(1)?).ok());
        let Some(end) = end.filter(|end| (triplets.len()..=nnz).contains(end)) else {
            return Err(last.unexpected("the last location of the column".to_owned(), SIZES));
        };
        while triplets.len() < end {
            let row = tokens.index(rows, "a row")?;
            tokens.word(":")?;
            triplets.push((row, col, tokens.number("the value of an entry")?));
        }
    }
    Ok(triplets)
}
