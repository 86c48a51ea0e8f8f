//! Matrices `K + delta 1 + A S A^T`, with a symmetric `K` and a diagonal `S`.

use faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMatRef};

use crate::cholesky::Cholesky;
use crate::{HALF_DIGITS, NONE, Pattern, index, power_of_two, solve_refined};

/// An entry of `K + delta 1 + A S A^T` that is not a number or overflows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("entry ({row}, {col}) of K + delta 1 + A S A^T is no finite number")]
pub struct Overflow {
    /// Its row.
    pub row: usize,
    /// Its column.
    pub col: usize,
}

/// Cholesky factors of `K + delta 1 + A S A^T` with a positive `delta`, a symmetric positive semidefinite `K`, a sparse
/// `A` and a diagonal `S >= 0`, again and again for other numbers.
///
/// Order and pattern are found once. Adjacent columns of `A` with the same rows are added together.
pub struct Gram {
    /// The lower triangle, every column from its diagonal on.
    pattern: Pattern,
    values: Vec<f64>,
    /// `NONE` for an entry whose mirrored one is stored.
    of_stiffness: Vec<u32>,
    /// Columns of `A` with the same rows: their ends, and the places of the lower triangle of their products, row by
    /// row.
    ends: Vec<usize>,
    places: Vec<u32>,
    /// Factors that make the diagonal of order one.
    units: Vec<f64>,
    factors: Cholesky,
}

impl Gram {
    /// Plans factors for the patterns of `K` (`None` is a zero matrix) and `A`.
    ///
    /// # Errors
    /// If memory does not suffice.
    ///
    /// # Panics
    /// If `K` is not square with as many rows as `A`.
    pub fn new(
        k: Option<SymbolicSparseColMatRef<'_, usize>>,
        a: SymbolicSparseColMatRef<'_, usize>,
    ) -> Result<Self, FaerError> {
        let n = a.nrows();
        let fits = k.is_none_or(|k| k.nrows() == n && k.ncols() == n);
        assert!(fits, "K is square, with as many rows as A");
        let ends = ends(a);
        let groups: Vec<&[usize]> = ends.iter().map(|end| a.row_idx_of_col_raw(end - 1)).collect();
        let pattern = Pattern::of(n, &groups, |j| column(k, j).iter(), |i, j| i >= j);
        let place = |i: usize, j: usize| index(pattern.place(i.max(j), i.min(j)));
        let of_stiffness = (0..n)
            .flat_map(|j| column(k, j).iter().map(move |&i| (i, j)))
            .map(|(i, j)| if i < j { NONE } else { place(i, j) })
            .collect();
        let mut places = Vec::new();
        for group in groups {
            for (at, &i) in group.iter().enumerate() {
                places.extend(group[..=at].iter().map(|&j| place(i, j)));
            }
        }
        let factors = Cholesky::new(pattern.symbolic(n))?;
        let values = vec![0.0; pattern.stored()];
        let units = vec![1.0; n];
        Ok(Self { pattern, values, of_stiffness, ends, places, units, factors })
    }

    /// Factorises for these values of `K` (only its lower triangle is read), `A`, `S` and `delta`.
    ///
    /// # Errors
    /// [`Overflow`] with the first entry of the sum that is not a number or overflows.
    ///
    /// # Panics
    /// If the patterns are not those given before.
    pub fn factorise(
        &mut self,
        k: Option<SparseColMatRef<'_, usize, f64>>,
        a: SparseColMatRef<'_, usize, f64>,
        s: &[f64],
        delta: f64,
    ) -> Result<(), Overflow> {
        self.values.fill(0.0);
        let stiffness = k.map_or(&[][..], |k| k.val());
        for (&place, v) in self.of_stiffness.iter().zip(stiffness).filter(|(it, _)| **it != NONE) {
            self.values[place as usize] += v;
        }
        let n = self.units.len();
        self.pattern.starts[..n].iter().for_each(|&start| self.values[start] += delta);
        let mut places = &self.places[..];
        let mut start = 0;
        let mut block = Vec::new();
        for &end in &self.ends {
            let width = a.val_of_col(start).len();
            block.clear();
            block.resize(width * (width + 1) / 2, 0.0);
            for j in start..end {
                let column = a.val_of_col(j);
                let mut sums = block.iter_mut();
                for (at, v) in column.iter().enumerate() {
                    let along = s[j] * v;
                    column[..=at].iter().zip(&mut sums).for_each(|(w, sum)| *sum += along * w);
                }
            }
            let (here, others) = places.split_at(block.len());
            here.iter().zip(&block).for_each(|(&place, v)| self.values[place as usize] += v);
            places = others;
            start = end;
        }
        self.check_finite()?;
        for (unit, &start) in self.units.iter_mut().zip(&self.pattern.starts) {
            *unit = power_of_two(1.0 / self.values[start].max(f64::MIN_POSITIVE).sqrt());
        }
        let mut scaled = Vec::with_capacity(self.values.len());
        for (j, unit) in self.units.iter().enumerate() {
            let entries = self.pattern.entries(j, &self.values);
            scaled.extend(entries.map(|(i, v)| v * (self.units[i] * unit)));
        }
        self.factors
            .factorise_semidefinite(SparseColMatRef::new(self.pattern.symbolic(n), &scaled));
        Ok(())
    }

    fn check_finite(&self) -> Result<(), Overflow> {
        let Some(at) = self.values.iter().position(|v| !v.is_finite()) else { return Ok(()) };
        let Pattern { starts, rows } = &self.pattern;
        let (row, col) = (rows[at], starts.partition_point(|&start| start <= at) - 1);
        Err(Overflow { row, col })
    }

    /// Overwrites right-hand sides, one after the other, with the solutions for the last factorisation.
    ///
    /// # Panics
    /// If the length is not a multiple of the order.
    pub fn solve(&self, x: &mut [f64]) {
        let n = self.units.len().max(1);
        assert!(x.len().is_multiple_of(n), "right-hand sides are as long as the matrix");
        let solve = |x: &mut [f64]| {
            let scale =
                |x: &mut [f64]| x.iter_mut().zip(&self.units).for_each(|(x, unit)| *x *= unit);
            scale(x);
            self.factors.solve(x);
            scale(x);
        };
        // Measured on walls of 10 000 bricks: 1e-11 takes a third more solves for the same steps, and 1e-7 saves nothing.
        for x in x.chunks_exact_mut(n) {
            solve_refined(x, HALF_DIGITS, solve, |x, rest| self.subtract_product(x, rest));
        }
    }

    /// Subtracts the product of the matrix with a vector.
    fn subtract_product(&self, x: &[f64], out: &mut [f64]) {
        for (j, x_j) in x.iter().enumerate() {
            let mut entries = self.pattern.entries(j, &self.values);
            let mut sum = entries.next().map_or(0.0, |(_, diagonal)| diagonal * x_j);
            for (i, v) in entries {
                out[i] -= v * x_j;
                sum += v * x[i];
            }
            out[j] -= sum;
        }
    }
}

/// The ends of the groups of columns with the same rows.
fn ends(a: SymbolicSparseColMatRef<'_, usize>) -> Vec<usize> {
    let rows = |j: usize| a.row_idx_of_col_raw(j);
    (1..=a.ncols()).filter(|&j| j == a.ncols() || rows(j) != rows(j - 1)).collect()
}

/// The rows of a column of a matrix that may be zero.
fn column(k: Option<SymbolicSparseColMatRef<'_, usize>>, j: usize) -> &[usize] {
    k.map_or(&[], |k| k.row_idx_of_col_raw(j))
}
