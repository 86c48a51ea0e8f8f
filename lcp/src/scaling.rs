//! Equilibration by powers of two: exact, so that it costs no accuracy.

use faer::Mat;

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
pub(crate) fn equilibrate(rows: usize, columns: &[&[f64]]) -> (Vec<f64>, Vec<f64>) {
    const SWEEPS: usize = 3;
    let mut factors = Factors { row: vec![1.0; rows], col: vec![1.0; columns.len()] };
    (0..SWEEPS).for_each(|_| factors.damp_largest(columns));
    factors.balance_logarithms(columns);
    (0..SWEEPS).for_each(|_| factors.damp_largest(columns));
    let Factors { mut row, mut col } = factors;
    row.iter_mut().chain(&mut col).for_each(|f| *f = power_of_two(*f));
    (row, col)
}

/// The columns of an owned matrix.
pub(crate) fn columns(m: &Mat<f64>) -> Vec<&[f64]> {
    (0..m.ncols()).map(|j| m.col_as_slice(j)).collect()
}

struct Factors {
    row: Vec<f64>,
    col: Vec<f64>,
}

impl Factors {
    /// Divides every row and column by the root of its largest entry (Ruiz).
    fn damp_largest(&mut self, columns: &[&[f64]]) {
        let mut row_max = vec![0.0_f64; self.row.len()];
        let mut col_max = vec![0.0_f64; self.col.len()];
        for ((column, col_max), col) in columns.iter().zip(&mut col_max).zip(&self.col) {
            let mut largest = 0.0_f64;
            for ((v, row), row_max) in column.iter().zip(&self.row).zip(&mut row_max) {
                let v = (v * row * col).abs();
                largest = if v > largest { v } else { largest };
                *row_max = if v > *row_max { v } else { *row_max };
            }
            *col_max = largest;
        }
        let pairs = self.row.iter_mut().zip(row_max).chain(self.col.iter_mut().zip(col_max));
        pairs.filter(|(_, max)| *max > 0.0).for_each(|(factor, max)| *factor /= max.sqrt());
    }

    /// Least squares of `log |m_ij| + log row_i + log col_j` over the nonzero entries, by
    /// alternating means.
    fn balance_logarithms(&mut self, columns: &[&[f64]]) {
        const SWEEPS: usize = 6;
        let logarithms: Vec<Vec<(usize, f64)>> = columns
            .iter()
            .zip(&self.col)
            .map(|(column, col)| {
                let sizes = column.iter().zip(&self.row).map(|(v, row)| (v * row * col).abs());
                let kept = sizes.enumerate().filter(|(_, v)| *v > NOISE);
                kept.map(|(i, v)| (i, v.log2())).collect()
            })
            .collect();
        let mut row = vec![0.0; self.row.len()];
        let mut col = vec![0.0; self.col.len()];
        for _ in 0..SWEEPS {
            let mut sums = vec![(0.0, 0.0); row.len()];
            for (column, col) in logarithms.iter().zip(&col) {
                for (i, log) in column {
                    sums[*i].0 += log + col;
                    sums[*i].1 += 1.0;
                }
            }
            row = sums.into_iter().map(negative_mean).collect();
            let sum = |column: &Vec<(usize, f64)>| {
                let total = column.iter().map(|(i, log)| log + row[*i]).sum();
                negative_mean((total, column.len() as f64))
            };
            col = logarithms.iter().map(sum).collect();
        }
        self.row.iter_mut().zip(row).for_each(|(factor, log)| *factor *= log.exp2());
        self.col.iter_mut().zip(col).for_each(|(factor, log)| *factor *= log.exp2());
    }
}

/// Minus the mean of so many values with that sum; zero for none.
fn negative_mean((sum, count): (f64, f64)) -> f64 {
    if count > 0.0 { -sum / count } else { 0.0 }
}

/// The power of two nearest to a positive number, on a logarithmic scale.
fn power_of_two(x: f64) -> f64 {
    x.log2().round().clamp(-1000.0, 1000.0).exp2()
}

/// `diag(rows) m diag(cols)`.
pub(crate) fn scaled(m: &Mat<f64>, rows: &[f64], cols: &[f64]) -> Mat<f64> {
    let mut out = m.clone();
    for (j, col) in cols.iter().enumerate() {
        let column = out.col_as_slice_mut(j);
        column.iter_mut().zip(rows).for_each(|(v, row)| *v *= row * col);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The block that maxima alone would leave at its units comes near one.
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
            let (rows, cols) = equilibrate(4, &columns(&m));
            let m = scaled(&m, &rows, &cols);
            for (i, j) in [(0, 0), (1, 1), (0, 2), (3, 1)] {
                assert!(m[(i, j)] > 0.05 && m[(i, j)] < 4.0, "{scale}: {}", m[(i, j)]);
            }
        }
    }
}
