//! Sparse LU factorisation, column by column (Gilbert and Peierls 1988).

use crate::order::{Turn, elimination_order};
use crate::{Columns, NONE, index};

/// The pivot is the entry in the emptiest row, among those of at least this part of the largest one.
const THRESHOLD: f64 = 0.1;

/// A factorisation that takes one column after the other and refuses those that depend on columns before
/// them.
#[derive(Debug)]
pub struct GrowingLu {
    /// Below the unit diagonal, by steps; rows as in the matrix until the end.
    lower: Columns,
    /// Above the diagonal, by steps.
    upper: Columns,
    diagonal: Vec<f64>,
    row_of_step: Vec<u32>,
    slot_of_step: Vec<u32>,
    step_of_row: Vec<u32>,
    /// Entries of every row of the matrix: the fewer, the less a pivot there fills in.
    row_counts: Vec<u32>,
    x: Vec<f64>,
    seen: Vec<bool>,
    /// Rows that a column reaches, in the order of elimination backwards.
    reached: Vec<u32>,
    path: Vec<(u32, usize)>,
}

impl GrowingLu {
    /// Begins with a matrix that has these numbers of entries in its rows.
    pub fn new(row_counts: Vec<u32>) -> Self {
        let n = row_counts.len();
        Self {
            lower: Columns::default(),
            upper: Columns::default(),
            diagonal: Vec::with_capacity(n),
            row_of_step: Vec::with_capacity(n),
            slot_of_step: Vec::with_capacity(n),
            step_of_row: vec![NONE; n],
            row_counts,
            x: vec![0.0; n],
            seen: vec![false; n],
            reached: Vec::new(),
            path: Vec::new(),
        }
    }

    fn order(&self) -> usize {
        self.step_of_row.len()
    }

    /// Takes a column of a matrix for the place `slot`; `false`, with nothing changed, if no entry
    /// outside the span of the columns before is larger than `tolerance` times its largest entry.
    pub fn offer(&mut self, slot: usize, columns: &Columns, turn: Turn, tolerance: f64) -> bool {
        let j = turn.column;
        self.reach(columns.rows(j));
        columns.add_to(j, 1.0, &mut self.x);
        let (mut largest, mut pivot) = (0.0_f64, 0.0_f64);
        for &row in self.reached.iter().rev() {
            let value = self.x[row as usize];
            let size = if value.is_nan() { f64::INFINITY } else { value.abs() };
            largest = largest.max(size);
            match self.step_of_row[row as usize] {
                NONE => pivot = pivot.max(size),
                step if value != 0.0 => self.lower.add_to(step as usize, -value, &mut self.x),
                _ => {}
            }
        }
        let is_taken = pivot.is_finite() && largest.is_finite() && pivot > tolerance * largest;
        if is_taken && let Some(row) = self.pivot_row(turn.row, THRESHOLD * pivot) {
            self.take(slot, row);
        }
        for row in self.reached.drain(..) {
            self.x[row as usize] = 0.0;
            self.seen[row as usize] = false;
        }
        is_taken
    }

    /// The rows that the elimination of a column reaches: depth first along the columns of `lower`.
    fn reach(&mut self, rows: &[u32]) {
        for &row in rows {
            if self.seen[row as usize] {
                continue;
            }
            self.seen[row as usize] = true;
            self.path.push((row, 0));
            while let Some((row, at)) = self.path.last_mut() {
                let below: &[u32] = match self.step_of_row[*row as usize] {
                    NONE => &[],
                    step => self.lower.rows(step as usize),
                };
                let fresh = below[*at..].iter().position(|&it| !self.seen[it as usize]);
                if let Some(skip) = fresh {
                    let next = below[*at + skip];
                    *at += skip + 1;
                    self.seen[next as usize] = true;
                    self.path.push((next, 0));
                } else {
                    self.reached.push(*row);
                    self.path.pop();
                }
            }
        }
    }

    /// The preferred row if its entry is large enough, else the one with fewest entries among the rows
    /// whose entry is.
    fn pivot_row(&self, preferred: Option<usize>, least: f64) -> Option<u32> {
        let size = |row: u32| self.x[row as usize].abs();
        let is_fit = |&row: &usize| self.step_of_row[row] == NONE && self.x[row].abs() >= least;
        if let Some(row) = preferred.filter(is_fit) {
            return Some(index(row));
        }
        let free =
            self.reached.iter().copied().filter(|&row| self.step_of_row[row as usize] == NONE);
        free.filter(|&row| size(row) >= least).min_by(|&a, &b| {
            let counts = self.row_counts[a as usize].cmp(&self.row_counts[b as usize]);
            counts.then(size(b).total_cmp(&size(a))).then(a.cmp(&b))
        })
    }

    fn take(&mut self, slot: usize, pivot_row: u32) {
        let pivot = self.x[pivot_row as usize];
        for &row in self.reached.iter().rev() {
            let value = self.x[row as usize];
            if value == 0.0 || row == pivot_row {
                continue;
            }
            match self.step_of_row[row as usize] {
                NONE => self.lower.push(row as usize, value / pivot),
                step => self.upper.push(step as usize, value),
            }
        }
        self.lower.close();
        self.upper.close();
        self.step_of_row[pivot_row as usize] = index(self.diagonal.len());
        self.diagonal.push(pivot);
        self.row_of_step.push(pivot_row);
        self.slot_of_step.push(index(slot));
    }

    /// The factorisation. Slots without a column get a unit column in one of the rows left and are
    /// returned as `(slot, row)`.
    pub fn finish(mut self) -> (SparseLu, Vec<(usize, usize)>) {
        let n = self.order();
        let mut is_filled = vec![false; n];
        self.slot_of_step.iter().for_each(|&slot| is_filled[slot as usize] = true);
        let empty = (0..n).filter(|&slot| !is_filled[slot]);
        let open = (0..n).filter(|&row| self.step_of_row[row] == NONE);
        let replaced: Vec<(usize, usize)> = empty.zip(open).collect();
        for &(slot, row) in &replaced {
            self.lower.close();
            self.upper.close();
            self.step_of_row[row] = index(self.diagonal.len());
            self.diagonal.push(1.0);
            self.row_of_step.push(index(row));
            self.slot_of_step.push(index(slot));
        }
        self.lower.rows.iter_mut().for_each(|row| *row = self.step_of_row[*row as usize]);
        let upper_rows = self.upper.transposed(n);
        let Self { lower, upper, diagonal, row_of_step, slot_of_step, .. } = self;
        let first_below = (0..n).find(|&k| !lower.rows(k).is_empty()).unwrap_or(n);
        let lu =
            SparseLu { lower, upper, upper_rows, diagonal, row_of_step, slot_of_step, first_below };
        (lu, replaced)
    }
}

/// A sparse LU factorisation.
#[derive(Debug, Clone)]
pub struct SparseLu {
    lower: Columns,
    upper: Columns,
    upper_rows: Columns,
    diagonal: Vec<f64>,
    row_of_step: Vec<u32>,
    slot_of_step: Vec<u32>,
    /// The first step that has entries below the diagonal: earlier steps eliminate nothing.
    first_below: usize,
}

impl SparseLu {
    /// Factorises a square matrix. Columns that depend on others are replaced by unit columns, which are
    /// returned as `(column, row)`. A column depends if its pivot vanishes against the largest entry of
    /// its column of `U`.
    pub fn new(columns: &Columns) -> (Self, Vec<(usize, usize)>) {
        let n = columns.len();
        let tolerance = 4.0 * n as f64 * f64::EPSILON;
        let mut growing = GrowingLu::new(row_counts(n, columns));
        for turn in elimination_order(n, columns) {
            growing.offer(turn.column, columns, turn, tolerance);
        }
        growing.finish()
    }

    /// Order of the matrix.
    pub fn order(&self) -> usize {
        self.diagonal.len()
    }

    /// Number of entries of the factors.
    pub fn stored(&self) -> usize {
        self.lower.stored() + self.upper.stored() + self.diagonal.len()
    }

    /// Overwrites a right-hand side, by rows, with the solution, by columns. Zeros are skipped.
    pub fn solve(&self, x: &mut [f64], work: &mut Vec<f64>) {
        work.clear();
        work.extend(self.row_of_step.iter().map(|&row| x[row as usize]));
        for k in self.first_below..work.len() {
            if work[k] != 0.0 {
                self.lower.add_to(k, -work[k], work);
            }
        }
        for k in (0..work.len()).rev() {
            if work[k] != 0.0 {
                work[k] /= self.diagonal[k];
                self.upper.add_to(k, -work[k], work);
            }
        }
        work.iter().zip(&self.slot_of_step).for_each(|(&v, &slot)| x[slot as usize] = v);
    }

    /// Overwrites a right-hand side, by columns, with the solution of the transposed system, by rows.
    pub fn solve_transpose(&self, x: &mut [f64], work: &mut Vec<f64>) {
        work.clear();
        work.extend(self.slot_of_step.iter().map(|&slot| x[slot as usize]));
        for k in 0..work.len() {
            if work[k] != 0.0 {
                work[k] /= self.diagonal[k];
                self.upper_rows.add_to(k, -work[k], work);
            }
        }
        for k in (self.first_below..work.len()).rev() {
            work[k] -= self.lower.dot(k, work);
        }
        work.iter().zip(&self.row_of_step).for_each(|(&v, &row)| x[row as usize] = v);
    }
}

/// Entries of every row.
pub fn row_counts(rows: usize, columns: &Columns) -> Vec<u32> {
    let mut counts = vec![0; rows];
    columns.rows.iter().for_each(|&row| counts[row as usize] += 1);
    counts
}

#[cfg(test)]
mod tests {
    use crate::*;

    fn columns(n: usize, entry: impl Fn(usize, usize) -> f64) -> Columns {
        let mut columns = Columns::default();
        for j in 0..n {
            (0..n).filter(|&i| entry(i, j) != 0.0).for_each(|i| columns.push(i, entry(i, j)));
            columns.close();
        }
        columns
    }

    fn product(m: &Columns, x: &[f64], is_transposed: bool) -> Vec<f64> {
        if is_transposed {
            return (0..m.len()).map(|j| m.dot(j, x)).collect();
        }
        let mut out = vec![0.0; m.len()];
        (0..m.len()).for_each(|j| m.add_to(j, x[j], &mut out));
        out
    }

    /// Zeros on the diagonal, a singleton column, and a dense row and column.
    fn sample(i: usize, j: usize) -> f64 {
        match (i, j) {
            (4, 4) => 3.0,
            (_, 4) => 0.0,
            (7, _) | (_, 7) => 1.0 + (i + 2 * j) as f64 / 8.0,
            _ if (i + 1) % 11 == j => 2.0,
            _ if (2 * i + 5) % 11 == j => -1.0 - i as f64 / 4.0,
            _ => 0.0,
        }
    }

    #[test]
    fn systems_are_solved() {
        let m = columns(11, sample);
        let (lu, replaced) = SparseLu::new(&m);
        assert!(replaced.is_empty());
        let x: Vec<f64> = (0..11_u8).map(|k| f64::from(k % 4) - 1.5).collect();
        for is_transposed in [false, true] {
            let mut found = product(&m, &x, is_transposed);
            let mut work = Vec::new();
            if is_transposed {
                lu.solve_transpose(&mut found, &mut work);
            } else {
                lu.solve(&mut found, &mut work);
            }
            assert!(found.iter().zip(&x).all(|(a, b)| (a - b).abs() < 1e-13), "{found:?}");
        }
    }

    /// A column that is the sum of two others, and an empty one, are replaced by unit columns.
    #[test]
    fn dependent_columns_are_replaced() {
        let m = columns(11, |i, j| match j {
            2 => sample(i, 0) + sample(i, 1),
            9 => 0.0,
            _ => sample(i, j),
        });
        let (lu, replaced) = SparseLu::new(&m);
        let slots: Vec<usize> = replaced.iter().map(|it| it.0).collect();
        assert!(slots.len() == 2 && slots.contains(&9), "{replaced:?}");
        assert!(slots.iter().any(|slot| [0, 1, 2].contains(slot)));
        for (slot, row) in replaced {
            let mut x = vec![0.0; 11];
            x[row] = 1.0;
            lu.solve(&mut x, &mut Vec::new());
            assert!((0..11).all(|k| (x[k] - f64::from(u8::from(k == slot))).abs() < 1e-14));
        }
    }
}
