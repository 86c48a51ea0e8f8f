//! What the tests of the quadratic program share.

use faer::Mat;
use lcp::{HorizontalLcp, QuadraticProgramSettings, Solution};

pub(crate) const TOLERANCES: [f64; 3] = [1e-4, 1e-8, 1e-12];

pub(crate) fn settings() -> QuadraticProgramSettings {
    QuadraticProgramSettings { tolerance: 1e-12, ..Default::default() }
}

pub(crate) fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-11 * (1.0 + b.abs())
}

/// `C C^T`.
pub(crate) fn gram(entries: &[f64], n: usize, rank: usize) -> Mat<f64> {
    let c = Mat::from_fn(n, rank, |i, j| entries[i * rank + j]);
    &c * c.transpose()
}

pub(crate) fn assert_proof<P>(problem: &HorizontalLcp, solution: &Solution<P>) {
    let pi = solution.farkas().unwrap();
    for matrix in [problem.a(), problem.b()] {
        for j in 0..problem.order() {
            let terms = matrix.column(j).map(|(i, v)| v * pi[i]);
            let (sum, size) =
                terms.fold((0.0, 0.0), |(sum, size), v: f64| (sum + v, size + v.abs()));
            assert!(sum <= 1e-12 * size, "column {j}: {sum} of {size}");
        }
    }
    let gap: f64 = problem.c().iter().zip(pi).map(|(c, pi)| c * pi).sum();
    assert!(gap > 0.0);
}
