//! The factorisations for one pattern and many values.

use faer::sparse::{SparseColMat, Triplet};
use lcp::SplitMix;

use crate::{Cholesky, SupernodalLu};

/// A grid of `side x side` nodes with random unsymmetric values and a weak diagonal.
fn grid(side: usize, seed: u64) -> SparseColMat<usize, f64> {
    let mut random = SplitMix::new(seed);
    let mut uniform = || 2.0 * random.next_f64() - 1.0;
    let mut entries = Vec::new();
    for i in 0..side * side {
        entries.push(Triplet::new(i, i, 4.0 + uniform()));
        let right = (i % side + 1 < side).then_some(i + 1);
        let above = (i / side + 1 < side).then_some(i + side);
        for j in [right, above].into_iter().flatten() {
            entries.push(Triplet::new(i, j, 2.0 * uniform()));
            entries.push(Triplet::new(j, i, 2.0 * uniform()));
        }
    }
    square(side * side, &entries)
}

fn square(n: usize, entries: &[Triplet<usize, usize, f64>]) -> SparseColMat<usize, f64> {
    SparseColMat::try_new_from_triplets(n, n, entries).expect("inside")
}

/// The product of a matrix with a vector of whole numbers, and that vector.
fn product(matrix: &SparseColMat<usize, f64>) -> (Vec<f64>, Vec<f64>) {
    let exact: Vec<f64> = (0..matrix.ncols()).map(|i| (i % 7) as f64 - 3.0).collect();
    let mut image = vec![0.0; exact.len()];
    matrix.triplet_iter().for_each(|it| image[it.row] += it.val * exact[it.col]);
    (image, exact)
}

fn error(x: &[f64], exact: &[f64]) -> f64 {
    x.iter().zip(exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max)
}

#[test]
fn unsymmetric_systems_are_solved_again_and_again() {
    for side in [1, 2, 3, 7, 40, 200] {
        let mut solver = SupernodalLu::new(grid(side, 1).symbolic()).expect("memory");
        for seed in 1..4 {
            let matrix = grid(side, seed);
            assert_eq!(solver.factorise(matrix.val()), 0);
            let (mut x, exact) = product(&matrix);
            solver.solve(&mut x);
            assert!(error(&x, &exact) < 1e-11, "side {side}");
        }
    }
}

#[test]
fn symmetric_systems_are_solved_for_several_right_hand_sides() {
    for side in [1, 2, 3, 7, 40, 200] {
        let grid = grid(side, 4);
        let lower: Vec<_> = grid
            .triplet_iter()
            .filter(|it| it.row >= it.col)
            .map(|it| Triplet::new(it.row, it.col, if it.row == it.col { 9.0 } else { *it.val }))
            .collect();
        let mirrored = lower.iter().filter(|it| it.row > it.col);
        let upper = mirrored.map(|it| Triplet::new(it.col, it.row, it.val));
        let whole = square(side * side, &upper.chain(lower.iter().copied()).collect::<Vec<_>>());
        let lower = square(side * side, &lower);
        let mut solver = Cholesky::new(lower.symbolic()).expect("memory");
        let (image, exact) = product(&whole);
        for _ in 0..2 {
            solver.factorise_semidefinite(lower.as_ref());
            let mut x = [image.clone(), image.iter().map(|v| 2.0 * v).collect()].concat();
            solver.solve(&mut x);
            let (one, two) = x.split_at(exact.len());
            assert!(error(one, &exact) < 1e-12, "side {side}");
            assert!(two.iter().zip(one).all(|(double, x)| (double - 2.0 * x).abs() < 1e-12));
        }
    }
}

/// Every variable occurs twice, so half of the pivots vanish: the others solve the equations.
#[test]
fn variables_with_vanishing_pivots_are_zero() {
    for half in [20, 150] {
        let entry = |i: usize, j: usize| match i.abs_diff(j) {
            0 => 1.0,
            _ => 0.5 / (1.0 + (i + j) as f64),
        };
        let twice = |i: usize, j: usize| entry(i % half, j % half);
        let n = 2 * half;
        let lower: Vec<_> =
            (0..n).flat_map(|j| (j..n).map(move |i| Triplet::new(i, j, twice(i, j)))).collect();
        let lower = square(n, &lower);
        let mut factors = Cholesky::new(lower.symbolic()).expect("memory");
        factors.factorise_semidefinite(lower.as_ref());
        let exact = |j: usize| (j % 7) as f64 - 3.0;
        let right = |i: usize| (0..half).map(|j| twice(i, j) * exact(j)).sum::<f64>();
        let mut x: Vec<f64> = (0..n).map(right).collect();
        factors.solve(&mut x);
        let error = |j: usize| (x[j] + x[j + half] - exact(j)).abs();
        assert!((0..half).all(|j| error(j) < 1e-9), "{x:?}");
        let least = |j: usize| x[j].abs().min(x[j + half].abs());
        assert!((0..half).all(|j| least(j) < 1e-9), "{x:?}");
    }
}
