//! The order in which columns are eliminated.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::colamd;

use super::Columns;

/// Rows and columns with more than this multiple of the root of their number of entries come last.
const DENSE: f64 = 10.0;

/// An order of the columns in which an LU factorisation with free choice of the pivot row fills in
/// little: first those that have one entry in the rows not yet taken, one after the other, which
/// leave no trace on the others; then the rest by approximate minimum degree (COLAMD; Davis,
/// Gilbert, Larimore and Ng 2004).
pub(crate) fn elimination_order(rows: usize, columns: &Columns) -> Vec<usize> {
    let by_rows = columns.transposed(rows);
    let mut left: Vec<usize> = (0..columns.len()).map(|j| columns.rows(j).len()).collect();
    let mut is_taken = vec![false; rows];
    let mut is_ordered = vec![false; columns.len()];
    let mut order: Vec<usize> = Vec::with_capacity(columns.len());
    let mut ready: Vec<usize> = (0..columns.len()).rev().filter(|&j| left[j] == 1).collect();
    while let Some(j) = ready.pop() {
        let Some(row) = columns.rows(j).iter().map(|&i| i as usize).find(|&i| !is_taken[i]) else {
            continue;
        };
        is_taken[row] = true;
        is_ordered[j] = true;
        order.push(j);
        for (other, _) in by_rows.entries(row) {
            left[other] -= 1;
            if left[other] == 1 && !is_ordered[other] {
                ready.push(other);
            }
        }
    }
    let rest: Vec<usize> = (0..columns.len()).filter(|&j| !is_ordered[j]).collect();
    order.extend(minimum_degree(&is_taken, columns, &rest).into_iter().map(|k| rest[k]));
    order
}

/// COLAMD of some columns in the rows not taken.
fn minimum_degree(is_taken: &[bool], columns: &Columns, picked: &[usize]) -> Vec<usize> {
    let mut number = vec![0; is_taken.len()];
    let mut rows = 0;
    for i in (0..is_taken.len()).filter(|&i| !is_taken[i]) {
        number[i] = rows;
        rows += 1;
    }
    let n = picked.len();
    let natural = || (0..n).collect();
    let mut starts = vec![0];
    let mut entries = Vec::new();
    let mut left: Vec<usize> = Vec::new();
    for &j in picked {
        left.clear();
        let rows = columns.rows(j).iter().map(|&i| i as usize);
        left.extend(rows.filter(|&i| !is_taken[i]).map(|i| number[i]));
        // The implementation takes sorted rows only.
        left.sort_unstable();
        left.dedup();
        entries.extend_from_slice(&left);
        starts.push(entries.len());
    }
    if n < 2 || entries.is_empty() {
        return natural();
    }
    let pattern = SymbolicSparseColMatRef::new_checked(rows, n, &starts, None, &entries);
    let dense = DENSE / (n as f64).sqrt();
    let control = colamd::Control { dense_row: dense, dense_col: dense, aggressive: true };
    let (mut order, mut inverse) = (vec![0_usize; n], vec![0_usize; n]);
    let Ok(mut memory) = MemBuffer::try_new(colamd::order_scratch::<usize>(rows, n, entries.len()))
    else {
        return natural();
    };
    let stack = MemStack::new(&mut memory);
    // A bad order costs time; no order at all would cost the answer.
    match colamd::order(&mut order, &mut inverse, pattern, control, stack) {
        Ok(()) => order,
        Err(_) => natural(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A permutation, whatever the order of the entries in their columns.
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
        let mut order = elimination_order(n, &columns);
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
        assert_eq!(elimination_order(n, &columns), (0..n).collect::<Vec<_>>());
    }
}
