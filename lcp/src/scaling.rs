//! Equilibration by powers of two: exact, so that it costs no accuracy.

#![allow(
    clippy::inline_always,
    reason = "a loop is compiled for wide vectors only where it is inlined"
)]

use faer::sparse::SparseColMat;

pub(crate) use lcp_linalg::power_of_two;

use crate::matrix::Column;

/// Row and column factors, all powers of two, that bring the entries of a matrix, given by its columns, near one.
///
/// The largest entries of rows and columns alone (Ruiz 2001) do not determine the factors: the size of `A` in
/// `[A, -R^T; R, 0]`, and with it the units of the problem, would remain. So the logarithms of all entries are balanced
/// in between (Curtis and Reid 1972). A row or column of zeros keeps the factor one.
pub(crate) fn equilibrate(rows: usize, columns: &[Column<'_>]) -> (Vec<f64>, Vec<f64>) {
    let mut factors = Equilibration::ones(rows, columns.len());
    factors.damp_largest(columns);
    factors.balance_logarithms(columns);
    factors.damp_largest(columns);
    factors.rounded()
}

/// Factors for a computed matrix, by its largest entries alone.
///
/// Entries of the inverse of a band decrease exponentially with their distance from the diagonal. These entries are not
/// rounding errors, but rows would get factors of up to `1e12` if the balance of logarithms counted them like all
/// others.
pub(crate) fn equilibrate_computed(rows: usize, columns: &[Column<'_>]) -> (Vec<f64>, Vec<f64>) {
    let mut factors = Equilibration::ones(rows, columns.len());
    factors.damp_largest(columns);
    factors.rounded()
}

struct Equilibration {
    row: Vec<f64>,
    col: Vec<f64>,
}

impl Equilibration {
    fn ones(rows: usize, columns: usize) -> Self {
        Self { row: vec![1.0; rows], col: vec![1.0; columns] }
    }

    /// Divides every row and column by the root of its largest entry (Ruiz), a few times or until all largest entries
    /// are within a factor of two of one.
    fn damp_largest(&mut self, columns: &[Column<'_>]) {
        const SWEEPS: usize = 3;
        for _ in 0..SWEEPS {
            let mut row_max = vec![0.0_f64; self.row.len()];
            let mut col_max = vec![0.0_f64; self.col.len()];
            for ((column, col_max), &col) in columns.iter().zip(&mut col_max).zip(&self.col) {
                *col_max = col * largest(*column, &self.row, col, &mut row_max);
            }
            row_max.iter_mut().zip(&self.row).for_each(|(max, row)| *max *= row);
            let pairs = self.row.iter_mut().zip(row_max).chain(self.col.iter_mut().zip(col_max));
            let mut is_even = true;
            for (factor, max) in pairs.filter(|(_, max)| *max > 0.0) {
                *factor /= max.sqrt();
                is_even &= (0.5..=2.0).contains(&max);
            }
            if is_even {
                break;
            }
        }
    }

    /// Least squares of `log |m_ij| + log row_i + log col_j` over the nonzero entries, by
    /// alternating means, until no logarithm moves by more than a quarter.
    fn balance_logarithms(&mut self, columns: &[Column<'_>]) {
        const SWEEPS: usize = 6;
        const SETTLED: f64 = 0.25;
        let mut col = vec![0.0; self.col.len()];
        let mut sums = Sums::new(self.row.len());
        for ((column, mean), factor) in columns.iter().zip(&mut col).zip(&self.col) {
            *mean = negative_mean(sums.add(*column, &self.row, *factor, 0.0));
        }
        let is_full = sums.counts.iter().all(|count| *count >= columns.len() as f64);
        let mut row = sums.negative_means();
        let mean_of_all = row.iter().sum::<f64>() / row.len().max(1) as f64;
        for col in &mut col {
            *col -= mean_of_all;
        }
        // The first means are the answer for a matrix without zeros.
        for _ in 0..if is_full { 0 } else { SWEEPS } {
            let mut sums = Sums::new(row.len());
            // Each column is read once: its own mean, then its share of the sums along rows.
            for ((column, log_col), factor) in columns.iter().zip(&mut col).zip(&self.col) {
                *log_col = negative_column_mean(*column, &self.row, &row, *factor);
                sums.add(*column, &self.row, *factor, *log_col);
            }
            let before = std::mem::replace(&mut row, sums.negative_means());
            if row.iter().zip(&before).all(|(a, b)| (a - b).abs() <= SETTLED) {
                break;
            }
        }
        self.row.iter_mut().zip(row).for_each(|(factor, log)| *factor *= log.exp2());
        self.col.iter_mut().zip(col).for_each(|(factor, log)| *factor *= log.exp2());
    }

    /// The factors rounded to powers of two.
    fn rounded(self) -> (Vec<f64>, Vec<f64>) {
        let Self { mut row, mut col } = self;
        row.iter_mut().chain(&mut col).for_each(|f| *f = power_of_two(*f));
        (row, col)
    }
}

/// Lanes of the loops over dense columns, which the compiler turns into vector instructions.
const LANES: usize = 8;

/// The largest `|v| row` of a column; raises `row_max` to `|v| col`.
fn largest(column: Column<'_>, row: &[f64], col: f64, row_max: &mut [f64]) -> f64 {
    let max = |a: f64, b: f64| if a > b { a } else { b };
    let mut lanes = [0.0_f64; LANES];
    match column {
        Column::Dense(values) => {
            let (values, row, row_max) = (lanes_of(values), lanes_of(row), lanes_of_mut(row_max));
            for ((v, row), row_max) in values.0.iter().zip(row.0).zip(row_max.0) {
                for k in 0..LANES {
                    lanes[k] = max(v[k].abs() * row[k], lanes[k]);
                    row_max[k] = max(v[k].abs() * col, row_max[k]);
                }
            }
            for ((v, row), row_max) in values.1.iter().zip(row.1).zip(row_max.1) {
                lanes[0] = max(v.abs() * row, lanes[0]);
                *row_max = max(v.abs() * col, *row_max);
            }
        }
        Column::Sparse { .. } => column.for_each(|i, v| {
            lanes[0] = max(v.abs() * row[i], lanes[0]);
            row_max[i] = max(v.abs() * col, row_max[i]);
        }),
    }
    lanes.into_iter().fold(0.0, max)
}

/// Sums of logarithms along rows, and their numbers of terms.
struct Sums {
    sums: Vec<f64>,
    counts: Vec<f64>,
}

impl Sums {
    fn new(rows: usize) -> Self {
        Self { sums: vec![0.0; rows], counts: vec![0.0; rows] }
    }

    /// Adds the logarithms of the scaled entries of a column, each with its present correction; returns their sum and
    /// their number.
    fn add(&mut self, column: Column<'_>, row: &[f64], col: f64, correction: f64) -> [f64; 2] {
        let (mut sums, mut counts) = ([0.0; LANES], [0.0; LANES]);
        let mut add = |lane: usize, v: f64, sum: &mut f64, count: &mut f64| {
            let (log, kept) = logarithm(v * col);
            let term = kept * (log + correction);
            *sum += term;
            *count += kept;
            sums[lane] += term;
            counts[lane] += kept;
        };
        match column {
            Column::Dense(values) => {
                let (values, row) = (lanes_of(values), lanes_of(row));
                let of_rows = (lanes_of_mut(&mut self.sums), lanes_of_mut(&mut self.counts));
                let chunks = of_rows.0.0.iter_mut().zip(of_rows.1.0);
                for ((v, row), (sum, count)) in values.0.iter().zip(row.0).zip(chunks) {
                    for k in 0..LANES {
                        add(k, v[k] * row[k], &mut sum[k], &mut count[k]);
                    }
                }
                let rest = of_rows.0.1.iter_mut().zip(of_rows.1.1);
                for ((v, row), (sum, count)) in values.1.iter().zip(row.1).zip(rest) {
                    add(0, v * row, sum, count);
                }
            }
            Column::Sparse { .. } => column.for_each(|i, v| {
                add(0, v * row[i], &mut self.sums[i], &mut self.counts[i]);
            }),
        }
        [sums.iter().sum(), counts.iter().sum()]
    }

    fn negative_means(self) -> Vec<f64> {
        self.sums
            .into_iter()
            .zip(self.counts)
            .map(|(sum, count)| negative_mean([sum, count]))
            .collect()
    }
}

/// Minus the mean of the logarithms of the scaled entries, each with the correction of its row.
fn negative_column_mean(column: Column<'_>, row: &[f64], correction: &[f64], col: f64) -> f64 {
    let (mut sums, mut counts) = ([0.0; LANES], [0.0; LANES]);
    let mut add = |lane: usize, v: f64, row: f64, correction: f64| {
        let (log, kept) = logarithm(v * row * col);
        sums[lane] += kept * (log + correction);
        counts[lane] += kept;
    };
    match column {
        Column::Dense(values) => {
            let (values, row, correction) = (lanes_of(values), lanes_of(row), lanes_of(correction));
            for ((v, row), correction) in values.0.iter().zip(row.0).zip(correction.0) {
                for k in 0..LANES {
                    add(k, v[k], row[k], correction[k]);
                }
            }
            for ((v, row), correction) in values.1.iter().zip(row.1).zip(correction.1) {
                add(0, *v, *row, *correction);
            }
        }
        Column::Sparse { .. } => column.for_each(|i, v| add(0, v, row[i], correction[i])),
    }
    negative_mean([sums.iter().sum(), counts.iter().sum()])
}

fn lanes_of(values: &[f64]) -> (&[[f64; LANES]], &[f64]) {
    values.as_chunks()
}

fn lanes_of_mut(values: &mut [f64]) -> (&mut [[f64; LANES]], &mut [f64]) {
    values.as_chunks_mut()
}

/// Minus the mean of values with this sum and number; zero if there are no values.
fn negative_mean([sum, count]: [f64; 2]) -> f64 {
    if count > 0.0 { -sum / count } else { 0.0 }
}

/// The logarithm to base 2 of the size of a number, to within 0.09, and its weight: one, or zero for noise (once the
/// largest entries of row and column are near one, entries below eps are rounding errors of the others). Exponent and
/// mantissa as stored in memory, read as an integer, are nearly the logarithm in units of 2^-52. All of these bits
/// except the last twelve become a number below the exponent of 2^52. The factors are rounded to powers of two in the
/// end.
fn logarithm(v: f64) -> (f64, f64) {
    let (v, shift) = (v.abs(), (1_u64 << 52) as f64);
    let digits = f64::from_bits(shift.to_bits() | v.to_bits() >> 12) - shift;
    let kept = if v > f64::EPSILON { 1.0 } else { 0.0 };
    (digits / (1_u64 << 40) as f64 - 1023.0, kept)
}

/// Multiplies every entry by its own factor.
pub(crate) fn multiply(
    matrix: &mut SparseColMat<usize, f64>,
    factor: impl Fn(usize, usize) -> f64,
) {
    let (pattern, values) = matrix.parts_mut();
    for j in 0..pattern.ncols() {
        let rows = pattern.row_idx_of_col_raw(j);
        values[pattern.col_range(j)].iter_mut().zip(rows).for_each(|(v, &i)| *v *= factor(i, j));
    }
}

#[cfg(test)]
mod tests {
    use faer::Mat;

    use super::*;
    use crate::Matrix;

    /// The inverse of a triangular band, whose entries decrease from one to `1e-14`, is not changed.
    #[test]
    fn small_entries_of_an_inverse_do_not_count() {
        let entry = |i: usize, j: usize| if i < j { 0.0 } else { 0.01_f64.powf((i - j) as f64) };
        let inverse = Mat::from_fn(8, 8, entry);
        let columns: Vec<_> = (0..8).map(|j| Column::Dense(inverse.col_as_slice(j))).collect();
        let (rows, cols) = equilibrate_computed(8, &columns);
        assert_eq!((rows, cols), (vec![1.0; 8], vec![1.0; 8]));
    }

    #[test]
    fn the_nearest_power_of_two() {
        let is_power = |x: f64, exponent: i32| {
            let power = f64::from(exponent).exp2();
            assert!(power_of_two(x).total_cmp(&power).is_eq(), "{x:e}: {:e}", power_of_two(x));
        };
        for (x, exponent) in [(1e-310, -1000), (0.0, -1000), (f64::INFINITY, 1000)] {
            is_power(x, exponent);
        }
        for exponent in [-999, -3, 0, 1, 52, 999] {
            let power = f64::from(exponent).exp2();
            for part in [0.7072, 1.0, 1.414] {
                is_power(part * power, exponent);
            }
        }
    }

    /// A block that maxima alone would leave in its units is brought near one, dense or sparse.
    #[test]
    fn units_of_a_block_are_removed() {
        let block = |scale: f64| {
            Mat::from_fn(4, 4, |i, j| match (i < 2, j < 2) {
                (true, true) => scale * (2.0 + (i + j) as f64),
                (false, false) => 0.0,
                _ => 1.0 + (i + 2 * j) as f64 / 8.0,
            })
        };
        for scale in [1e-9, 1.0, 1e9] {
            let m = block(scale);
            let nonzero = (0..4).flat_map(|i| (0..4).map(move |j| (i, j)));
            let nonzero = nonzero.map(|(i, j)| (i, j, m[(i, j)])).filter(|(_, _, v)| *v != 0.0);
            let sparse = Matrix::from_entries(4, 4, nonzero.collect::<Vec<_>>().into_iter());
            for m in [Matrix::from(m), sparse] {
                let columns: Vec<_> = (0..4).map(|j| m.slice(j)).collect();
                let (rows, cols) = equilibrate(4, &columns);
                for (i, j) in [(0, 0), (1, 1), (0, 2), (3, 1)] {
                    let v = rows[i] * m[(i, j)] * cols[j];
                    assert!(v > 0.05 && v < 4.0, "{scale}: {v}");
                }
            }
        }
    }
}
