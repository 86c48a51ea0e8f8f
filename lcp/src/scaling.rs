//! Equilibration by powers of two: exact, so that it costs no accuracy.

use crate::matrix::Column;

/// Entries below this, once the largest of their row and column is near one, are rounding errors
/// of a computed tableau and have no say in its scaling.
const NOISE: f64 = 1e-13;

/// Row and column factors, all powers of two, that bring the entries of a matrix, given by its
/// columns, near one.
///
/// The largest entries of rows and columns alone (Ruiz 2001) leave a freedom: in `[A, -R^T; R, 0]`
/// the size of `A`, and with it the units of the problem, would stay whatever they are. So the
/// logarithms of all entries are balanced in between (Curtis and Reid 1972). A row or column of
/// zeros keeps the factor one.
pub(crate) fn equilibrate(rows: usize, columns: &[Column<'_>]) -> (Vec<f64>, Vec<f64>) {
    let mut factors = Factors { row: vec![1.0; rows], col: vec![1.0; columns.len()] };
    factors.damp_largest(columns);
    factors.balance_logarithms(columns);
    factors.damp_largest(columns);
    let Factors { mut row, mut col } = factors;
    row.iter_mut().chain(&mut col).for_each(|f| *f = power_of_two(*f));
    (row, col)
}

struct Factors {
    row: Vec<f64>,
    col: Vec<f64>,
}

impl Factors {
    /// Divides every row and column by the root of its largest entry (Ruiz), a few times or until
    /// all of these are within a factor of two of one.
    fn damp_largest(&mut self, columns: &[Column<'_>]) {
        const SWEEPS: usize = 3;
        for _ in 0..SWEEPS {
            let mut row_max = vec![0.0_f64; self.row.len()];
            let mut col_max = vec![0.0_f64; self.col.len()];
            for ((column, col_max), &col) in columns.iter().zip(&mut col_max).zip(&self.col) {
                let row = &self.row;
                let mut largest = 0.0_f64;
                match *column {
                    Column::Dense(values) => {
                        for ((v, row), row_max) in values.iter().zip(row).zip(&mut row_max) {
                            let v = (v * row * col).abs();
                            largest = if v > largest { v } else { largest };
                            *row_max = if v > *row_max { v } else { *row_max };
                        }
                    }
                    Column::Sparse { .. } => column.for_each(|i, v| {
                        let v = (v * row[i] * col).abs();
                        largest = largest.max(v);
                        row_max[i] = row_max[i].max(v);
                    }),
                }
                *col_max = largest;
            }
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
        let kept = |v: f64, row: f64, col: f64| {
            let v = (v * row * col).abs();
            (v > NOISE).then(|| logarithm(v))
        };
        let mut row = vec![0.0; self.row.len()];
        let mut col = vec![0.0; self.col.len()];
        for sweep in 0..SWEEPS {
            let mut sums = vec![(0.0, 0.0); row.len()];
            for ((column, log_col), factor) in columns.iter().zip(&col).zip(&self.col) {
                column.for_each(|i, v| {
                    if let Some(log) = kept(v, self.row[i], *factor) {
                        sums[i].0 += log + log_col;
                        sums[i].1 += 1.0;
                    }
                });
            }
            let before = std::mem::replace(&mut row, sums.into_iter().map(negative_mean).collect());
            if sweep > 0 && row.iter().zip(&before).all(|(a, b)| (a - b).abs() <= SETTLED) {
                break;
            }
            for ((column, log_col), factor) in columns.iter().zip(&mut col).zip(&self.col) {
                let mut sum = (0.0, 0.0);
                column.for_each(|i, v| {
                    if let Some(log) = kept(v, self.row[i], *factor) {
                        sum.0 += log + row[i];
                        sum.1 += 1.0;
                    }
                });
                *log_col = negative_mean(sum);
            }
        }
        self.row.iter_mut().zip(row).for_each(|(factor, log)| *factor *= log.exp2());
        self.col.iter_mut().zip(col).for_each(|(factor, log)| *factor *= log.exp2());
    }
}

/// Minus the mean of so many values with that sum; zero for none.
fn negative_mean((sum, count): (f64, f64)) -> f64 {
    if count > 0.0 { -sum / count } else { 0.0 }
}

/// The logarithm to base 2 of a positive number, to within 0.09: exponent and mantissa as they stand
/// in memory. The factors are rounded to powers of two in the end.
fn logarithm(v: f64) -> f64 {
    const ONE: u64 = 1 << 52;
    const BIAS: f64 = 1023.0;
    v.to_bits() as f64 / ONE as f64 - BIAS
}

/// The power of two nearest to a positive number, on a logarithmic scale.
fn power_of_two(x: f64) -> f64 {
    x.log2().round().clamp(-1000.0, 1000.0).exp2()
}

#[cfg(test)]
mod tests {
    use faer::Mat;

    use super::*;
    use crate::Matrix;

    /// The block that maxima alone would leave at its units comes near one, dense or sparse.
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
