//! The sides of problems whose answers are known.

use faer::{Mat, mat};

use super::*;
use crate::{Lcp, Matrix, MixedLcp};

const LIMITS: Limits = Limits { steps: 200, deadline: None };

/// Whether a point solves a problem to this accuracy, relative to the terms of the rows.
fn is_near(problem: &HorizontalLcp, found: &Suggestion, accuracy: f64) -> bool {
    let n = problem.order();
    let row = |i: usize| {
        let terms = (0..n)
            .flat_map(|j| [problem.a()[(i, j)] * found.t[j], problem.b()[(i, j)] * found.y[j]])
            .chain([-problem.c()[i]]);
        terms.fold((0.0, 0.0), |(sum, size), v: f64| (sum + v, size + v.abs()))
    };
    let pairs = found.t.iter().zip(&found.y).all(|(&t, &y)| t.min(y).total_cmp(&0.0).is_eq());
    pairs && (0..n).map(row).all(|(sum, size)| sum.abs() <= accuracy * size)
}

/// `w = M z + q` with a dominant diagonal has one solution, here (1, 0, 1, 0, ...), in any units.
#[test]
fn known_answers_are_found_dense_and_sparse() {
    let n = 30;
    let mut random = SplitMix::new(5);
    let mut m =
        Mat::from_fn(n, n, |i, j| if (i + j) % 3 == 0 { random.next_f64() - 0.5 } else { 0.0 });
    (0..n).for_each(|i| m[(i, i)] = 0.5 * n as f64);
    let z = |j: usize| f64::from(u8::from(j.is_multiple_of(2)));
    let q = (0..n).map(|i| (0..n).map(|j| -m[(i, j)] * z(j)).sum::<f64>() + 1.0 - z(i)).collect();
    for unit in [1e-8, 1.0, 1e8] {
        let scaled = Mat::from_fn(n, n, |i, j| unit * m[(i, j)]);
        let entries = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
        let entries = entries.map(|(i, j)| (i, j, scaled[(i, j)])).filter(|(_, _, v)| *v != 0.0);
        let sparse = Matrix::from_entries(n, n, entries);
        let q: Vec<f64> = Vec::clone(&q).into_iter().map(|q: f64| unit * q).collect();
        for m in [Matrix::from(scaled.clone()), sparse] {
            let problem = Lcp::new(m, q.clone()).expect("fits").into();
            let found = follow(&problem, 0, LIMITS).expect("it arrives");
            let expected = |j: usize| if j.is_multiple_of(2) { Side::T } else { Side::Y };
            assert_eq!(found.basis, Basis::new((0..n).map(expected).collect()));
            assert!(is_near(&problem, &found, 1e-8));
        }
    }
}

/// A free variable of either sign beside an indefinite matrix.
#[test]
fn free_variables_take_either_sign() {
    for sign in [-1.0, 1.0] {
        // w = z1 - 1, 0 = z0 - 2 z1 - sign 5: z = (2 + sign 5, 1).
        let m = mat![[1.0, -2.0], [0.0, 1.0]];
        let mixed = MixedLcp::new(m, vec![-5.0 * sign, -1.0], vec![true, false]).expect("fits");
        let problem = mixed.to_general();
        let found = follow(&problem, 0, LIMITS).expect("it arrives");
        let (z, _) = mixed.recover(&found.t, &found.y);
        assert!((z[0] - (2.0 + 5.0 * sign)).abs() < 1e-8 && (z[1] - 1.0).abs() < 1e-8, "{z:?}");
    }
}

/// Without a solution it does not arrive, and the limits hold.
#[test]
fn nothing_is_suggested_where_it_does_not_arrive() {
    let problem = Lcp::new(mat![[-1.0]], vec![-1.0]).expect("fits").into();
    assert!((0..4).all(|start| follow(&problem, start, LIMITS).is_none()));
    let limits = Limits { steps: 1, deadline: None };
    let problem = Lcp::new(mat![[2.0, 1.0], [1.0, 2.0]], vec![-5.0, -6.0]).expect("fits").into();
    assert!(follow(&problem, 0, LIMITS).is_some());
    assert!(follow(&problem, 0, limits).is_none());
}
