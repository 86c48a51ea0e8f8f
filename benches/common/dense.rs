//! Dense problems of the benches.

use faer::Mat;
use lcp::Lcp;

/// `M = C C^T + 1` with entries of `C` between -1/2 and 1/2, `q` likewise.
pub(crate) fn positive_definite(n: usize) -> Lcp {
    let c = Mat::from_fn(n, n, |i, j| wave(i * n + j));
    let m = &c * c.transpose() + Mat::<f64>::identity(n, n);
    let q: Vec<f64> = (0..n).map(|i| wave(n * n + i)).collect();
    Lcp::new(m, q).expect("finite data")
}

/// A number between -1/2 and 1/2 that looks random.
pub(crate) fn wave(k: usize) -> f64 {
    let x = (k as f64 * 12.9898).sin() * 43_758.545_3;
    x - x.floor() - 0.5
}
