//! Random contact problems between elastic bodies, and the same in other units.

use faer::Mat;
use faer::sparse::SparseColMat;
use lcp::Contact2d;
use proptest::collection::vec;
use proptest::prelude::*;

/// Rows of blocks on each other, each of which may slide and lift; small integers.
pub(crate) fn problems() -> impl Strategy<Value = Contact2d> {
    let entries = |n: usize, most: i8| vec((-most..=most).prop_map(f64::from), n);
    (1..=6usize, 1..=5usize).prop_flat_map(move |(n, m)| {
        let matrices = (entries(n * n, 2), entries(m * n, 2), entries(m * n, 2));
        let mu = vec(prop::sample::select(std::vec![0.0, 0.125, 0.25, 0.5]), m);
        let gaps = vec((0..=2i8).prop_map(f64::from), m);
        (matrices, entries(n, 6), gaps, mu).prop_map(move |((r, c_n, c_t), f, x_0, mu)| {
            let r = Mat::from_fn(n, n, |i, j| r[i * n + j]);
            let k = &r * r.transpose() + Mat::<f64>::identity(n, n);
            let c_n = Mat::from_fn(m, n, |i, j| c_n[i * n + j]);
            let c_t = Mat::from_fn(m, n, |i, j| c_t[i * n + j]);
            Contact2d::new(k, f, c_n, c_t, x_0, vec![0.0; m], mu).unwrap()
        })
    })
}

/// The same with these units of force and length and of every displacement.
pub(crate) fn in_units(problem: &Contact2d, force: f64, length: f64, unit: &[f64]) -> Contact2d {
    let (n, m) = (problem.displacements(), problem.points());
    let [k, c_n, c_t] =
        [problem.stiffness(), problem.normal(), problem.tangent()].map(SparseColMat::to_dense);
    let scaled = |v: &[f64], by: f64| -> Vec<f64> { v.iter().map(|v| v * by).collect() };
    Contact2d::new(
        Mat::from_fn(n, n, |i, j| force / length * k[(i, j)] * unit[i] * unit[j]),
        problem.loads().iter().zip(unit).map(|(f, unit)| force * f * unit).collect::<Vec<f64>>(),
        Mat::from_fn(m, n, |i, j| c_n[(i, j)] * unit[j]),
        Mat::from_fn(m, n, |i, j| c_t[(i, j)] * unit[j]),
        scaled(problem.initial_gaps(), length),
        scaled(problem.initial_slips(), length),
        problem.mu().to_vec(),
    )
    .unwrap()
}
