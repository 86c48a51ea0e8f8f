//! Linear algebra for the crate `lcp`, in addition to that of [`faer`]: sparse columns and their order, LU that grows
//! by columns, LU and Cholesky factors for one pattern and many values, and dense LU with estimates of the condition
//! number.
//!
//! [`SupernodalLu`] and [`SparseLu`] replace pivots that vanish and return their number or places; [`Lu`] and
//! [`Cholesky`] return `None` for matrices that they cannot factorise.

mod cholesky;
mod dense;
mod gram;
mod lu;
mod order;
mod supernodal;
#[cfg(test)]
mod tests;

pub use cholesky::Cholesky;
pub use dense::{
    Lu, add_product, factorise_block, has_pivots, inverse_norm, solve_unit_lower, solve_upper,
};
pub use gram::{Gram, Overflow};
pub use lu::{GrowingLu, SparseLu, row_counts};
pub use order::{Turn, elimination_order};
pub use supernodal::SupernodalLu;

use std::f64::consts::SQRT_2;

use faer::sparse::SymbolicSparseColMatRef;

/// Pivots below this multiple of their measure (the largest entry of their column, or a diagonal of order one) are
/// rounding errors. Rounding: some eps.
const VANISHING: f64 = 1e-15;

/// Half of all digits, about the root of eps. Theory: the square of an error of this size is a rounding error, and a
/// term of this size, added for regularity, loses no more than one step of refinement restores. Chosen as the shortest
/// step, the size of perturbations that break ties, and the bound of a slack in doubt.
pub const HALF_DIGITS: f64 = 1e-8;

/// Largest number of steps of iterative refinement of linear equations. Chosen: each step gains the digits that the
/// condition number leaves.
pub const REFINEMENTS: usize = 3;

/// No place.
const NONE: u32 = u32::MAX;

/// Columns of nonzero entries, one after the other.
#[derive(Debug, Clone)]
pub struct Columns {
    starts: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl Default for Columns {
    fn default() -> Self {
        Self { starts: vec![0], rows: Vec::new(), values: Vec::new() }
    }
}

impl Columns {
    /// Number of columns.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether there is no column.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of entries.
    pub fn stored(&self) -> usize {
        self.rows.len()
    }

    /// Adds an entry to the column that [`close`](Self::close) will end.
    pub fn push(&mut self, row: usize, value: f64) {
        self.rows.push(index(row));
        self.values.push(value);
    }

    /// Ends a column.
    pub fn close(&mut self) {
        self.starts.push(self.rows.len());
    }

    /// Rows of the entries of a column.
    pub fn rows(&self, j: usize) -> &[u32] {
        &self.rows[self.starts[j]..self.starts[j + 1]]
    }

    /// The entries `(row, value)` of a column.
    #[inline]
    pub fn entries(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
        let range = self.starts[j]..self.starts[j + 1];
        let values = self.values[range.clone()].iter();
        self.rows[range].iter().map(|&row| row as usize).zip(values.copied())
    }

    /// `out += factor * column`.
    #[inline]
    pub fn add_to(&self, j: usize, factor: f64, out: &mut [f64]) {
        self.entries(j).for_each(|(i, v)| out[i] += factor * v);
    }

    /// The scalar product of a column with a vector.
    #[inline]
    pub fn dot(&self, j: usize, x: &[f64]) -> f64 {
        self.entries(j).map(|(i, v)| v * x[i]).sum()
    }

    /// The rows of a matrix, `count` in number, as columns, from its entries `(row, column, value)`; entries of a row
    /// keep their order.
    pub fn by_rows(count: usize, all: impl Iterator<Item = (usize, usize, f64)> + Clone) -> Self {
        let mut starts = vec![0; count + 1];
        all.clone().for_each(|(i, ..)| starts[i + 1] += 1);
        for i in 0..count {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let (mut rows, mut values) = (vec![0; starts[count]], vec![0.0; starts[count]]);
        for (i, j, v) in all {
            (rows[next[i]], values[next[i]]) = (index(j), v);
            next[i] += 1;
        }
        Self { starts, rows, values }
    }

    /// The same entries by rows: column `i` of the result is row `i`, of `count` rows.
    #[must_use]
    pub fn transposed(&self, count: usize) -> Self {
        let all = (0..self.len()).flat_map(|j| self.entries(j).map(move |(i, v)| (i, j, v)));
        Self::by_rows(count, all)
    }
}

/// The pattern of a matrix: the starts of its columns, and their rows, ascending.
pub struct Pattern {
    starts: Vec<usize>,
    rows: Vec<usize>,
}

impl Pattern {
    /// The pattern of a square matrix with a diagonal, entries between the rows of a group, and further ones, as far as
    /// they are wanted.
    pub fn of<'a, I: Iterator<Item = &'a usize>>(
        n: usize,
        groups: &[&'a [usize]],
        further: impl Fn(usize) -> I,
        is_wanted: impl Fn(usize, usize) -> bool,
    ) -> Self {
        let members = groups.iter().enumerate();
        let members =
            members.flat_map(|(number, group)| group.iter().map(move |&i| (i, number, 1.0)));
        let of_rows = Columns::by_rows(n, members);
        let (mut starts, mut rows) = (vec![0], Vec::new());
        let mut last = vec![usize::MAX; n];
        for j in 0..n {
            let begin = rows.len();
            let of_groups = of_rows.rows(j).iter().flat_map(|&number| groups[number as usize]);
            for i in std::iter::once(j).chain(of_groups.chain(further(j)).copied()) {
                if is_wanted(i, j) && std::mem::replace(&mut last[i], j) != j {
                    rows.push(i);
                }
            }
            rows[begin..].sort_unstable();
            starts.push(rows.len());
        }
        Self { starts, rows }
    }

    /// Number of entries.
    pub fn stored(&self) -> usize {
        self.rows.len()
    }

    /// The pattern in the form of faer, with this number of rows.
    pub fn symbolic(&self, rows: usize) -> SymbolicSparseColMatRef<'_, usize> {
        let columns = self.starts.len() - 1;
        SymbolicSparseColMatRef::new_checked(rows, columns, &self.starts, None, &self.rows)
    }

    /// The place of an entry.
    pub fn place(&self, i: usize, j: usize) -> usize {
        let found = self.column(j).binary_search(&i);
        self.starts[j] + found.unwrap_or_else(|_| unreachable!("the pattern has all entries"))
    }

    /// The rows of a column.
    fn column(&self, j: usize) -> &[usize] {
        &self.rows[self.starts[j]..self.starts[j + 1]]
    }

    /// The entries `(row, value)` of a column, from the values of all.
    pub fn entries<'a>(
        &'a self,
        j: usize,
        values: &'a [f64],
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        let values = &values[self.starts[j]..self.starts[j + 1]];
        self.column(j).iter().copied().zip(values.iter().copied())
    }
}

/// Overwrites a right-hand side with the solution by factors, refined as long as the residual halves and is more than a
/// part `enough` of the right-hand side. `subtract_product` subtracts the product of the matrix with a vector.
pub fn solve_refined(
    x: &mut [f64],
    enough: f64,
    solve: impl Fn(&mut [f64]),
    subtract_product: impl Fn(&[f64], &mut [f64]),
) {
    let right = x.to_vec();
    let largest = max_abs(&right);
    solve(x);
    let mut last = f64::INFINITY;
    for _ in 0..REFINEMENTS {
        let mut rest = right.clone();
        subtract_product(x, &mut rest);
        let size = max_abs(&rest);
        if size.is_nan() || size >= 0.5 * last || size <= enough * largest {
            break;
        }
        last = size;
        solve(&mut rest);
        x.iter_mut().zip(&rest).for_each(|(x, step)| *x += step);
    }
}

/// A row or column number in half the space.
pub fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or_else(|_| unreachable!("more than 2^32 rows do not fit in memory"))
}

/// The largest size of an entry, zero if there is none.
#[inline]
pub fn max_abs(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |max, x| max.max(x.abs()))
}

/// The power of two nearest to a positive number, on a logarithmic scale, between `2^-1000` and `2^1000`: such a factor
/// costs no accuracy.
#[inline]
pub fn power_of_two(x: f64) -> f64 {
    let power = |exponent: u64| f64::from_bits((1023 + exponent) << 52);
    // The exponent of a number, without its mantissa, is that of the largest power that is not above it.
    let below = f64::from_bits((x * SQRT_2).to_bits() & f64::INFINITY.to_bits());
    below.clamp(1.0 / power(1000), power(1000))
}
