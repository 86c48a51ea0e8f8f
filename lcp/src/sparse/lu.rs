//! Sparse LU factorisation, column by column (Gilbert and Peierls 1988).

use super::{Columns, index};

/// Of the entries at least this large against the largest one, that in the emptiest row is the pivot.
const THRESHOLD: f64 = 0.1;
const NONE: u32 = u32::MAX;

/// A factorisation that takes one column after the other and refuses those that depend on the ones
/// before.
#[derive(Debug)]
pub(crate) struct Growing {
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

impl Growing {
    /// For a matrix with so many entries in its rows.
    pub(crate) fn new(row_counts: Vec<u32>) -> Self {
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

    /// Takes column `j` of a matrix for the place `slot`; `false`, and nothing changed, where no entry
    /// outside the span of the columns before is larger than `tolerance` times its largest entry.
    pub(crate) fn offer(
        &mut self,
        slot: usize,
        columns: &Columns,
        j: usize,
        tolerance: f64,
    ) -> bool {
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
        if is_taken && let Some(row) = self.pivot_row(THRESHOLD * pivot) {
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

    fn pivot_row(&self, least: f64) -> Option<u32> {
        let size = |row: u32| self.x[row as usize].abs();
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

    /// The factorisation. Slots without a column get a unit column in one of the rows left: these are
    /// returned as `(slot, row)`.
    pub(crate) fn finish(mut self) -> (SparseLu, Vec<(usize, usize)>) {
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
        (SparseLu { lower, upper, upper_rows, diagonal, row_of_step, slot_of_step }, replaced)
    }
}

/// A sparse LU factorisation.
#[derive(Debug, Clone)]
pub(crate) struct SparseLu {
    lower: Columns,
    upper: Columns,
    upper_rows: Columns,
    diagonal: Vec<f64>,
    row_of_step: Vec<u32>,
    slot_of_step: Vec<u32>,
}

impl SparseLu {
    /// Factorises a square matrix. Columns that depend on others are replaced by unit columns, which are
    /// returned as `(column, row)`. A column depends if its pivot vanishes against the largest entry
    /// of its column of `U`.
    pub(crate) fn new(columns: &Columns) -> (Self, Vec<(usize, usize)>) {
        let n = columns.len();
        let tolerance = 4.0 * n as f64 * f64::EPSILON;
        let mut growing = Growing::new(row_counts(n, columns));
        for j in super::elimination_order(n, columns) {
            growing.offer(j, columns, j, tolerance);
        }
        growing.finish()
    }

    /// Order of the matrix.
    pub(crate) fn order(&self) -> usize {
        self.diagonal.len()
    }

    /// Number of entries of the factors.
    pub(crate) fn stored(&self) -> usize {
        self.lower.stored() + self.upper.stored() + self.diagonal.len()
    }

    /// Overwrites a right-hand side, by rows, with the solution, by columns. Zeros are skipped.
    pub(crate) fn solve(&self, x: &mut [f64], work: &mut Vec<f64>) {
        work.clear();
        work.extend(self.row_of_step.iter().map(|&row| x[row as usize]));
        for k in 0..work.len() {
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
    pub(crate) fn solve_transpose(&self, x: &mut [f64], work: &mut Vec<f64>) {
        work.clear();
        work.extend(self.slot_of_step.iter().map(|&slot| x[slot as usize]));
        for k in 0..work.len() {
            if work[k] != 0.0 {
                work[k] /= self.diagonal[k];
                self.upper_rows.add_to(k, -work[k], work);
            }
        }
        for k in (0..work.len()).rev() {
            work[k] -= self.lower.dot(k, work);
        }
        work.iter().zip(&self.row_of_step).for_each(|(&v, &row)| x[row as usize] = v);
    }
}

/// Entries of every row.
pub(crate) fn row_counts(rows: usize, columns: &Columns) -> Vec<u32> {
    let mut counts = vec![0; rows];
    columns.rows.iter().for_each(|&row| counts[row as usize] += 1);
    counts
}
