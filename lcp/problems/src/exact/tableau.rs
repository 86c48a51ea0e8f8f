//! Fraction-free Gauss-Jordan elimination.

use dashu_int::IBig;

/// Rows of integers over one positive denominator, the determinant of the pivots so far:
/// `entry / determinant` is the entry of elimination with fractions (Bareiss, Mathematics of
/// Computation 22, 1968). A pivot column becomes `determinant` times a unit vector.
#[derive(Debug, Clone)]
pub(super) struct Tableau {
    pub(super) rows: Vec<Vec<IBig>>,
    pub(super) determinant: IBig,
}

impl Tableau {
    pub(super) fn new(rows: Vec<Vec<IBig>>) -> Self {
        Self { rows, determinant: IBig::ONE }
    }

    /// Makes the column a unit vector with its one in this row, whose entry must not be zero.
    pub(super) fn pivot(&mut self, row: usize, column: usize) {
        let pivot_row = std::mem::take(&mut self.rows[row]);
        let pivot = &pivot_row[column];
        for other in self.rows.iter_mut().filter(|row| !row.is_empty()) {
            let factor = other[column].clone();
            for (v, p) in other.iter_mut().zip(&pivot_row) {
                // The quotient is a minor of the data, so that the division leaves no remainder.
                *v = (&*v * pivot - &factor * p) / &self.determinant;
            }
        }
        self.determinant.clone_from(pivot);
        self.rows[row] = pivot_row;
        if self.determinant < IBig::ZERO {
            self.determinant = -std::mem::take(&mut self.determinant);
            self.rows.iter_mut().flatten().for_each(|v| *v = -std::mem::take(v));
        }
    }

    pub(super) fn without_column(&self, column: usize) -> Self {
        let kept = |row: &Vec<IBig>| {
            let entries = row.iter().enumerate().filter(|(j, _)| *j != column);
            entries.map(|(_, v)| v.clone()).collect()
        };
        Self { rows: self.rows.iter().map(kept).collect(), determinant: self.determinant.clone() }
    }

    pub(super) fn drop_column(&mut self, column: usize) {
        self.rows.iter_mut().for_each(|row| {
            row.remove(column);
        });
    }
}

/// Eliminates one column after the other and returns the pivot row of each, `None` for a column that
/// depends on those before it.
pub(super) fn eliminate(tableau: &mut Tableau, columns: usize) -> Vec<Option<usize>> {
    let mut is_used = vec![false; tableau.rows.len()];
    let mut pivot_row = |column: usize| {
        let row =
            (0..is_used.len()).find(|&i| !is_used[i] && !tableau.rows[i][column].is_zero())?;
        tableau.pivot(row, column);
        is_used[row] = true;
        Some(row)
    };
    (0..columns).map(&mut pivot_row).collect()
}
