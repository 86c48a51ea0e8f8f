//! Equilibration by powers of two: exact, so that it costs no accuracy.

use faer::{Mat, MatRef};

/// Entries below this, once the largest of their row and column is near one, are rounding errors
/// of a computed tableau and have no say in its scaling.
const NOISE: f64 = 1e-13;

/// Row and column factors, all powers of two, that bring the entries of `m` near one.
///
/// The largest entries of rows and columns alone (Ruiz 2001) leave a freedom: in `[A, -R^T; R, 0]`
/// the size of `A`, and with it the units of the problem, would stay whatever they are. So the
/// logarithms of all entries are balanced in between (Curtis and Reid 1972). A row or column of
/// zeros keeps the factor one.
pub(crate) fn equilibrate(m: MatRef<'_, f64>) -> (Vec<f64>, Vec<f64>) {
    const SWEEPS: usize = 4;
    let mut factors = Factors { row: vec![1.0; m.nrows()], col: vec![1.0; m.ncols()] };
    (0..SWEEPS).for_each(|_| factors.damp_largest(m));
    factors.balance_logarithms(m);
    (0..SWEEPS).for_each(|_| factors.damp_largest(m));
    let Factors { mut row, mut col } = factors;
    row.iter_mut().chain(&mut col).for_each(|f| *f = power_of_two(*f));
    (row, col)
}

struct Factors {
    row: Vec<f64>,
    col: Vec<f64>,
}

impl Factors {
    fn entry(&self, m: MatRef<'_, f64>, i: usize, j: usize) -> f64 {
        (m[(i, j)] * self.row[i] * self.col[j]).abs()
    }

    /// Divides every row and column by the root of its largest entry (Ruiz).
    fn damp_largest(&mut self, m: MatRef<'_, f64>) {
        let mut row_max = vec![0.0_f64; self.row.len()];
        let mut col_max = vec![0.0_f64; self.col.len()];
        for j in 0..m.ncols() {
            for i in 0..m.nrows() {
                let v = self.entry(m, i, j);
                row_max[i] = row_max[i].max(v);
                col_max[j] = col_max[j].max(v);
            }
        }
        let pairs = self.row.iter_mut().zip(row_max).chain(self.col.iter_mut().zip(col_max));
        pairs.filter(|(_, max)| *max > 0.0).for_each(|(factor, max)| *factor /= max.sqrt());
    }

    /// Least squares of `log |m_ij| + log row_i + log col_j` over the nonzero entries, by
    /// alternating means.
    fn balance_logarithms(&mut self, m: MatRef<'_, f64>) {
        const SWEEPS: usize = 12;
        let mut kept = Vec::new();
        for j in 0..m.ncols() {
            for i in 0..m.nrows() {
                let v = self.entry(m, i, j);
                if v > NOISE {
                    kept.push((i, j, v.log2()));
                }
            }
        }
        let mut row = vec![0.0; self.row.len()];
        let mut col = vec![0.0; self.col.len()];
        for _ in 0..SWEEPS {
            row = negative_means(row.len(), kept.iter().map(|&(i, j, log)| (i, log + col[j])));
            col = negative_means(col.len(), kept.iter().map(|&(i, j, log)| (j, log + row[i])));
        }
        self.row.iter_mut().zip(row).for_each(|(factor, log)| *factor *= log.exp2());
        self.col.iter_mut().zip(col).for_each(|(factor, log)| *factor *= log.exp2());
    }
}

/// Minus the mean of the values of every key; zero for a key without any.
fn negative_means(keys: usize, values: impl Iterator<Item = (usize, f64)>) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); keys];
    for (key, value) in values {
        sums[key].0 += value;
        sums[key].1 += 1.0;
    }
    sums.into_iter().map(|(sum, count)| if count > 0.0 { -sum / count } else { 0.0 }).collect()
}

/// The power of two nearest to a positive number, on a logarithmic scale.
fn power_of_two(x: f64) -> f64 {
    x.log2().round().clamp(-1000.0, 1000.0).exp2()
}

/// `diag(rows) m diag(cols)`.
pub(crate) fn scaled(m: MatRef<'_, f64>, rows: &[f64], cols: &[f64]) -> Mat<f64> {
    Mat::from_fn(m.nrows(), m.ncols(), |i, j| rows[i] * m[(i, j)] * cols[j])
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
            let (rows, cols) = equilibrate(m.as_ref());
            let m = scaled(m.as_ref(), &rows, &cols);
            for (i, j) in [(0, 0), (1, 1), (0, 2), (3, 1)] {
                assert!(m[(i, j)] > 0.05 && m[(i, j)] < 4.0, "{scale}: {}", m[(i, j)]);
            }
        }
    }
}
