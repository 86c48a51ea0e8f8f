//! Factors for one pattern and many values: of `K + delta 1 + A S A^T`, and of unsymmetric matrices.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use faer::sparse::{SparseColMat, Triplet};
use lcp::SplitMix;
use lcp_linalg::{Gram, Overflow, SupernodalLu};

/// A chain of bodies with two variables each, three columns of `A` between neighbours, and `K` on every third variable.
fn chain(bodies: usize) -> (SparseColMat<usize, f64>, SparseColMat<usize, f64>) {
    let mut random = SplitMix::new(7);
    let n = 2 * bodies;
    let mut a = Vec::new();
    for column in 0..3 * (bodies - 1) {
        let first = 2 * (column / 3);
        let entries = (first..first + 4).map(|i| Triplet::new(i, column, random.next_f64() - 0.5));
        a.extend(entries);
    }
    let k = (0..n).step_by(3).map(|i| Triplet::new(i, i, 2.0)).collect::<Vec<_>>();
    let inside = "entries lie inside";
    let a = SparseColMat::try_new_from_triplets(n, 3 * (bodies - 1), &a).expect(inside);
    (SparseColMat::try_new_from_triplets(n, n, &k).expect(inside), a)
}

#[test]
fn solves_for_several_right_hand_sides_again_and_again() {
    let (k, a) = chain(40);
    let n = a.nrows();
    let mut gram = Gram::new(Some(k.symbolic()), a.symbolic()).expect("memory");
    for scale in [1.0, 1e3] {
        let s: Vec<f64> = (0..a.ncols()).map(|j| scale * (1.0 + (j % 5) as f64)).collect();
        let delta = 1e-3;
        gram.factorise(Some(k.as_ref()), a.as_ref(), &s, delta).expect("finite numbers");
        let exact: Vec<f64> = (0..2 * n).map(|i| (i % 7) as f64 - 3.0).collect();
        let mut x = Vec::new();
        for exact in exact.chunks_exact(n) {
            let mut right: Vec<f64> = exact.iter().map(|x| delta * x).collect();
            k.triplet_iter().for_each(|it| right[it.row] += it.val * exact[it.col]);
            let mut along = vec![0.0; a.ncols()];
            a.triplet_iter().for_each(|it| along[it.col] += it.val * exact[it.row]);
            a.triplet_iter().for_each(|it| right[it.row] += it.val * s[it.col] * along[it.col]);
            x.extend(right);
        }
        gram.solve(&mut x);
        let error = x.iter().zip(&exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
        assert!(error < 1e-6, "{scale}: {error}");
    }
}

#[test]
fn numbers_that_overflow_are_named() {
    let (k, a) = chain(3);
    let mut gram = Gram::new(Some(k.symbolic()), a.symbolic()).expect("memory");
    let mut s = vec![1.0; a.ncols()];
    s[0] = f64::INFINITY;
    let error = gram.factorise(Some(k.as_ref()), a.as_ref(), &s, 1e-3).unwrap_err();
    assert_eq!(error, Overflow { row: 0, col: 0 });
    s[0] = 1.0;
    gram.factorise(Some(k.as_ref()), a.as_ref(), &s, 1e-3).expect("finite numbers");
    let mut x = vec![1.0; a.nrows()];
    gram.solve(&mut x);
    assert!(x.iter().all(|x| x.is_finite()));
}

/// A zero on the diagonal is no obstacle where a pivot can be found in the block, and where none is
/// the factorisation says so.
#[test]
fn vanishing_pivots_are_exchanged_or_counted() {
    let entries = |corner: f64| {
        [(0, 0, 0.0), (0, 1, 2.0), (1, 0, 3.0), (1, 1, corner)]
            .map(|(i, j, v)| Triplet::new(i, j, v))
    };
    let matrix =
        |corner| SparseColMat::<usize, f64>::try_new_from_triplets(2, 2, &entries(corner)).unwrap();
    let mut solver = SupernodalLu::new(matrix(0.0).symbolic()).unwrap();
    assert_eq!(solver.factorise(matrix(0.0).val()), 0);
    assert!(solver.is_negative());
    let mut x = [2.0, 3.0];
    solver.solve(&mut x);
    assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15), "{x:?}");
    assert_eq!(solver.factorise(&[0.0, 0.0, 0.0, 1.0]), 1);
}
