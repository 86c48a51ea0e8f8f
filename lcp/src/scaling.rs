//! Equilibration by powers of two: exact, so that it costs no accuracy.

use faer::{Mat, MatRef};

/// Row and column factors, all powers of two, that bring the largest entry of every row and column
/// of `m` near one (Ruiz, "A scaling algorithm to equilibrate both rows and columns norms in
/// matrices", 2001). A row or column of zeros keeps the factor one.
pub(crate) fn equilibrate(m: MatRef<'_, f64>) -> (Vec<f64>, Vec<f64>) {
    const SWEEPS: usize = 8;
    let (rows, cols) = (m.nrows(), m.ncols());
    let mut row_factor = vec![1.0_f64; rows];
    let mut col_factor = vec![1.0_f64; cols];
    for _ in 0..SWEEPS {
        let mut row_max = vec![0.0_f64; rows];
        let mut col_max = vec![0.0_f64; cols];
        for j in 0..cols {
            for i in 0..rows {
                let v = (m[(i, j)] * row_factor[i] * col_factor[j]).abs();
                row_max[i] = row_max[i].max(v);
                col_max[j] = col_max[j].max(v);
            }
        }
        damp(&mut row_factor, &row_max);
        damp(&mut col_factor, &col_max);
    }
    row_factor.iter_mut().chain(&mut col_factor).for_each(|f| *f = power_of_two(*f));
    (row_factor, col_factor)
}

fn damp(factor: &mut [f64], max: &[f64]) {
    for (factor, &max) in factor.iter_mut().zip(max) {
        if max > 0.0 {
            *factor /= max.sqrt();
        }
    }
}

/// The power of two nearest to a positive number, on a logarithmic scale.
pub(crate) fn power_of_two(x: f64) -> f64 {
    let exponent = x.log2().round().clamp(-1000.0, 1000.0);
    exponent.exp2()
}

/// `diag(rows) m diag(cols)`.
pub(crate) fn scaled(m: MatRef<'_, f64>, rows: &[f64], cols: &[f64]) -> Mat<f64> {
    Mat::from_fn(m.nrows(), m.ncols(), |i, j| rows[i] * m[(i, j)] * cols[j])
}
