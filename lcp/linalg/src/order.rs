//! The order in which columns are eliminated.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::FaerError;
use faer::sparse::linalg::{amd, colamd};

use crate::{Columns, Pattern};

/// Rows and columns with more than this multiple of the root of their number of entries come last.
const DENSE: f64 = 10.0;
/// A pattern with at least this share of entries that have a mirrored one counts as symmetric.
const SYMMETRIC: f64 = 0.5;

/// A column in its turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Turn {
    /// The column.
    pub column: usize,
    /// The row that should be its pivot, if that is large enough.
    pub row: Option<usize>,
}

/// An order of the columns in which an LU factorisation fills in little: first those with one entry in
/// the rows not yet taken, one after the other, which leave the others unchanged; then the rest by
/// approximate minimum degree. The rest is ordered by AMD (Amestoy, Davis and Duff 1996) with pivots on
/// the diagonal if its pattern is symmetric and the largest entries of the columns are on the diagonal,
/// else by COLAMD (Davis, Gilbert, Larimore and Ng 2004) with any pivots.
pub fn elimination_order(rows: usize, columns: &Columns) -> Vec<Turn> {
    let by_rows = columns.transposed(rows);
    let mut left: Vec<usize> = (0..columns.len()).map(|j| columns.rows(j).len()).collect();
    let mut is_taken = vec![false; rows];
    let mut is_ordered = vec![false; columns.len()];
    let mut order: Vec<Turn> = Vec::with_capacity(columns.len());
    let mut ready: Vec<usize> = (0..columns.len()).rev().filter(|&j| left[j] == 1).collect();
    while let Some(j) = ready.pop() {
        let Some(row) = columns.rows(j).iter().map(|&i| i as usize).find(|&i| !is_taken[i]) else {
            continue;
        };
        is_taken[row] = true;
        is_ordered[j] = true;
        order.push(Turn { column: j, row: Some(row) });
        for (other, _) in by_rows.entries(row) {
            left[other] -= 1;
            if left[other] == 1 && !is_ordered[other] {
                ready.push(other);
            }
        }
    }
    let rest: Vec<usize> = (0..columns.len()).filter(|&j| !is_ordered[j]).collect();
    order.extend(Core::new(&is_taken, columns, rest).order());
    order
}

/// Some columns in the rows not taken.
struct Core {
    columns: Vec<usize>,
    rows: Vec<usize>,
    /// By the numbers of the rows among `rows`.
    pattern: Pattern,
    /// The number of the row of the largest entry of every column.
    largest: Vec<Option<usize>>,
}

impl Core {
    fn new(is_taken: &[bool], columns: &Columns, picked: Vec<usize>) -> Self {
        let rows: Vec<usize> = (0..is_taken.len()).filter(|&i| !is_taken[i]).collect();
        let mut number = vec![0; is_taken.len()];
        rows.iter().enumerate().for_each(|(k, &i)| number[i] = k);
        let mut pattern = Pattern { starts: vec![0], rows: Vec::new() };
        let mut largest = Vec::with_capacity(picked.len());
        for &j in &picked {
            let left = || columns.entries(j).filter(|&(i, _)| !is_taken[i]);
            let mut sorted: Vec<usize> = left().map(|(i, _)| number[i]).collect();
            sorted.sort_unstable();
            sorted.dedup();
            pattern.rows.extend_from_slice(&sorted);
            pattern.starts.push(pattern.rows.len());
            let best = left().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
            largest.push(best.map(|(i, _)| number[i]));
        }
        Self { columns: picked, rows, pattern, largest }
    }

    fn order(&self) -> Vec<Turn> {
        let n = self.columns.len();
        let turn = |k: usize, row: Option<usize>| {
            let row = row.map(|row| self.rows[row]);
            Turn { column: self.columns[k], row }
        };
        // A bad order costs time; none at all would cost the answer.
        let as_they_come = || (0..n).map(|k| turn(k, None)).collect();
        if n <= 1 || self.pattern.stored() == 0 {
            return as_they_come();
        }
        if let Some((diagonal, pattern)) = self.symmetric()
            && let Some(order) = minimum_degree(&pattern)
        {
            return order.into_iter().map(|k| turn(k, Some(diagonal[k]))).collect();
        }
        let order = self.column_minimum_degree();
        order.map_or_else(as_they_come, |it| it.into_iter().map(|k| turn(k, None)).collect())
    }

    /// The row of every column that makes the pattern symmetric, and the pattern with these rows on the
    /// diagonal, if such rows exist.
    fn symmetric(&self) -> Option<(Vec<usize>, Pattern)> {
        let n = self.columns.len();
        if self.rows.len() != n {
            return None;
        }
        let mut column_of_row = vec![None; n];
        for (k, row) in self.largest.iter().enumerate() {
            if let Some(row) = row {
                column_of_row[*row].get_or_insert(k);
            }
        }
        // Rows and columns left over are paired in their order.
        let is_paired =
            |k: &usize| self.largest[*k].is_some_and(|row| column_of_row[row] == Some(*k));
        let mut unpaired = (0..n).filter(|k| !is_paired(k)).collect::<Vec<_>>().into_iter();
        let column_of_row: Vec<usize> = column_of_row
            .into_iter()
            .map(|it| it.or_else(|| unpaired.next()))
            .collect::<Option<_>>()?;
        let mut diagonal = vec![0; n];
        column_of_row.iter().enumerate().for_each(|(row, &k)| diagonal[k] = row);
        let (mut starts, mut rows) = (vec![0], Vec::with_capacity(self.pattern.stored()));
        for k in 0..n {
            let begin = rows.len();
            rows.extend(self.pattern.column(k).iter().map(|&row| column_of_row[row]));
            rows[begin..].sort_unstable();
            starts.push(rows.len());
        }
        let pattern = Pattern { starts, rows };
        (symmetry(&pattern) >= SYMMETRIC).then_some((diagonal, pattern))
    }

    fn column_minimum_degree(&self) -> Option<Vec<usize>> {
        let (rows, n) = (self.rows.len(), self.columns.len());
        let pattern = self.pattern.symbolic(rows);
        let dense = DENSE / (n as f64).sqrt();
        let control = colamd::Control { dense_row: dense, dense_col: dense, aggressive: true };
        let scratch = colamd::order_scratch::<usize>(rows, n, self.pattern.stored());
        ordered(n, scratch, |order, inverse, stack| {
            colamd::order(order, inverse, pattern, control, stack)
        })
    }
}

/// Share of the entries off the diagonal that have a mirrored one.
fn symmetry(pattern: &Pattern) -> f64 {
    let (mut mirrored, mut all) = (0_usize, 0_usize);
    for k in 0..pattern.starts.len() - 1 {
        for &row in pattern.column(k).iter().filter(|&&row| row != k) {
            all += 1;
            mirrored += usize::from(pattern.column(row).binary_search(&k).is_ok());
        }
    }
    if all == 0 { 1.0 } else { mirrored as f64 / all as f64 }
}

fn minimum_degree(pattern: &Pattern) -> Option<Vec<usize>> {
    let n = pattern.starts.len() - 1;
    ordered(n, amd::order_scratch::<usize>(n, pattern.stored()), |order, inverse, stack| {
        amd::order(order, inverse, pattern.symbolic(n), amd::Control::default(), stack)
    })
}

/// An order of `n` columns from a function that writes the order and its inverse; `None` if memory does
/// not suffice.
fn ordered<T>(
    n: usize,
    scratch: StackReq,
    write: impl FnOnce(&mut [usize], &mut [usize], &mut MemStack) -> Result<T, FaerError>,
) -> Option<Vec<usize>> {
    let (mut order, mut inverse) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::try_new(scratch).ok()?;
    write(&mut order, &mut inverse, MemStack::new(&mut memory)).ok()?;
    Some(order)
}

#[cfg(test)]
mod tests {
    use crate::*;

    fn columns_of(order: &[Turn]) -> Vec<usize> {
        order.iter().map(|turn| turn.column).collect()
    }

    /// The order is a permutation, whatever the order of the entries in their columns.
    #[test]
    fn every_column_comes_once() {
        let n = 12;
        let mut columns = Columns::default();
        for j in 0..n {
            for i in [j, (5 * j + 3) % n, (7 * j + 1) % n, (j * j) % n] {
                columns.push(i, 1.0);
            }
            columns.close();
        }
        let mut order = columns_of(&elimination_order(n, &columns));
        order.sort_unstable();
        assert_eq!(order, (0..n).collect::<Vec<_>>());
    }

    /// Triangular matrices need no fill: every column has one entry when its turn comes.
    #[test]
    fn triangles_are_found() {
        let n = 9;
        let mut columns = Columns::default();
        for j in 0..n {
            (0..=j).for_each(|i| columns.push((4 * i) % n, 1.0));
            columns.close();
        }
        assert_eq!(columns_of(&elimination_order(n, &columns)), (0..n).collect::<Vec<_>>());
    }

    /// The diagonal of a ring is found although its rows are rotated by three.
    #[test]
    fn symmetric_patterns_are_found() {
        let n = 10;
        let mut columns = Columns::default();
        for j in 0..n {
            columns.push((j + 3) % n, 4.0);
            columns.push((j + 4) % n, -1.0);
            columns.push((j + 2) % n, -1.0);
            columns.close();
        }
        let order = elimination_order(n, &columns);
        assert!(order.iter().all(|turn| turn.row == Some((turn.column + 3) % n)), "{order:?}");
    }
}
