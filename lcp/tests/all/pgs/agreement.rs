//! Agreement with Lemke's method, in any units and any order.

use faer::Mat;
use lcp::{
    BoxedLcp, HorizontalLcp, Lcp, Lemke, ProjectedGaussSeidel, ProjectedGaussSeidelSettings,
    Solution, Solver, Status, WarmStart,
};
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::cases;
use super::{INF, check_honest, distance, largest, settings, sparse, to};

const LARGEST: usize = 30;

#[derive(Debug, Clone, Copy)]
enum Family {
    Dominant,
    Definite,
    MMatrix,
}

/// Strictly diagonally dominant, symmetric positive definite, or an M-matrix, neither of the last two
/// ill-conditioned.
fn matrix(family: Family, n: usize, entries: &[f64]) -> Mat<f64> {
    let raw = Mat::from_fn(n, n, |i, j| entries[i * n + j]);
    match family {
        Family::Definite => {
            &raw * raw.transpose() / faer::Scale(n as f64)
                + Mat::<f64>::identity(n, n) * faer::Scale(0.5)
        }
        Family::Dominant | Family::MMatrix => Mat::from_fn(n, n, |i, j| {
            let others: f64 = (0..n).filter(|j| *j != i).map(|j| raw[(i, j)].abs()).sum();
            match (i == j, family) {
                (true, _) => 1.25 * others + 0.5,
                (false, Family::MMatrix) => -raw[(i, j)].abs(),
                (false, _) => raw[(i, j)],
            }
        }),
    }
}

fn easy() -> impl Strategy<Value = Lcp> {
    let family = prop_oneof![Just(Family::Dominant), Just(Family::Definite), Just(Family::MMatrix)];
    (1..=LARGEST, family, any::<bool>()).prop_flat_map(|(n, family, is_sparse)| {
        (vec(-2.0..2.0_f64, n * n), vec(-3.0..2.0_f64, n)).prop_map(move |(entries, q)| {
            let m = matrix(family, n, &entries);
            Lcp::new(if is_sparse { sparse(&m) } else { m.into() }, q).unwrap()
        })
    })
}

proptest! {
    #![proptest_config(cases(128))]

    /// To each tolerance the point of Lemke's method, up to the condition of the family.
    #[test]
    fn agreement_with_lemke(lcp in easy(), relaxation in 0.7..=1.0_f64) {
        let expected = Lemke::default().solve(&lcp).unwrap();
        prop_assert!(expected.is_solved());
        for tolerance in [1e-4, 1e-8, 1e-12] {
            let settings = ProjectedGaussSeidelSettings { relaxation, tolerance, ..settings() };
            let solution = ProjectedGaussSeidel::new(settings).solve(&lcp).unwrap();
            check_honest(&solution, &lcp.clone().into(), tolerance);
            prop_assert_eq!(solution.status, Status::Solved);
            let error = distance(&solution.t, &expected.t);
            prop_assert!(error <= 1e3 * tolerance, "{} at {}", error, tolerance);
        }
    }

    /// The general problem with rows in other units and pairs the other way round is the same one.
    #[test]
    fn standard_problems_in_disguise(lcp in easy(), swaps in vec(any::<bool>(), LARGEST), k in -9..9_i32) {
        let n = lcp.order();
        let factor = f64::from(k).exp2();
        let dense = lcp.m().to_dense();
        let unit = |i: usize, j: usize| if i == j { factor } else { 0.0 };
        let entry = |i: usize, j: usize, is_w: bool| {
            if is_w { unit(i, j) } else { -factor * dense[(i, j)] }
        };
        let a = Mat::from_fn(n, n, |i, j| entry(i, j, swaps[j]));
        let b = Mat::from_fn(n, n, |i, j| entry(i, j, !swaps[j]));
        let c: Vec<f64> = lcp.q().iter().map(|q| q * factor).collect();
        let general = HorizontalLcp::new(a, b, c).unwrap();
        let (found, expected) = (to(1e-10).solve(&general).unwrap(), to(1e-10).solve(&lcp).unwrap());
        check_honest(&found, &general, 1e-10);
        prop_assert!(found.is_solved() && expected.is_solved());
        for i in 0..n {
            let (z, w) = if swaps[i] { (found.y[i], found.t[i]) } else { (found.t[i], found.y[i]) };
            prop_assert!((z - expected.t[i]).abs() <= 1e-7 * largest(&expected.t));
            prop_assert!((w - expected.y[i]).abs() <= 1e-7 * (1.0 + largest(&expected.y)));
        }
    }

    /// Powers of two as units change nothing at all.
    #[test]
    fn units(lcp in easy(), force in -300..300_i32, stiffness in -300..300_i32) {
        let (force, stiffness) = (f64::from(force).exp2(), f64::from(stiffness).exp2());
        let m = lcp.m().to_dense() * faer::Scale(stiffness);
        let q: Vec<f64> = lcp.q().iter().map(|q| q * force * stiffness).collect();
        let scaled = Lcp::new(m, q).unwrap();
        let dense = Lcp::new(lcp.m().to_dense(), lcp.q().to_vec()).unwrap();
        let (found, expected) = (to(1e-9).solve(&scaled).unwrap(), to(1e-9).solve(&dense).unwrap());
        prop_assert_eq!(found.status, expected.status);
        // Loads are compared in units rounded to powers of two, so that one may stop a few sweeps before the other.
        let t: Vec<f64> = expected.t.iter().map(|t| t * force).collect();
        prop_assert!(distance(&found.t, &t) <= 1e-6, "{:?} {:?}", found.t, t);
    }

    /// The variables in another order, each in its own unit, and rows in units of their own.
    #[test]
    fn order_and_units_of_variables(
        lcp in easy(),
        order in Just((0..LARGEST).collect::<Vec<_>>()).prop_shuffle(),
        exponents in vec(-4..=4_i32, 2 * LARGEST),
    ) {
        let n = lcp.order();
        let order: Vec<usize> = order.into_iter().filter(|&k| k < n).collect();
        let unit = |k: usize| f64::from(exponents[k]).exp2();
        let dense = lcp.m().to_dense();
        let m = Mat::from_fn(n, n, |i, j| {
            unit(order[i]) * dense[(order[i], order[j])] * unit(LARGEST + order[j])
        });
        let q: Vec<f64> = order.iter().map(|&i| unit(i) * lcp.q()[i]).collect();
        let scaled = Lcp::new(m, q).unwrap();
        let (found, expected) = (to(1e-11).solve(&scaled).unwrap(), to(1e-11).solve(&lcp).unwrap());
        prop_assert!(found.is_solved() && expected.is_solved());
        for (k, &i) in order.iter().enumerate() {
            let z = found.t[k] * unit(LARGEST + i);
            prop_assert!((z - expected.t[i]).abs() <= 1e-7 * largest(&expected.t));
        }
    }

    /// A warm start at the solution needs no sweep.
    #[test]
    fn warm_starts(lcp in easy()) {
        let Solution { t, y, .. } = to(1e-9).solve(&lcp).unwrap();
        let start = WarmStart::Point { t, y };
        let again = ProjectedGaussSeidel::new(ProjectedGaussSeidelSettings { start, ..settings() });
        let solution = again.solve(&lcp).unwrap();
        prop_assert_eq!((solution.status, solution.info.iterations), (Status::Solved, 0));
    }

    /// Boxes against Lemke's method, with bounds of all kinds.
    #[test]
    fn boxes(
        lcp in easy(),
        bounds in vec((-3..=3_i8, 0..=3_u8, any::<bool>(), any::<bool>()), LARGEST),
    ) {
        let n = lcp.order();
        let bounds = bounds.into_iter().take(n).map(|(lower, width, below, above)| {
            let lower = f64::from(lower);
            let upper = lower + f64::from(width);
            (if below { lower } else { -INF }, if above { upper } else { INF })
        });
        let (lower, upper): (Vec<f64>, Vec<f64>) = bounds.unzip();
        let boxed = BoxedLcp::new(lcp.m().clone(), lcp.q().to_vec(), lower, upper).unwrap();
        let general = boxed.to_general();
        let expected = Lemke::default().solve(&general).unwrap();
        prop_assert!(expected.is_solved());
        let solution = to(1e-11).solve(&boxed).unwrap();
        check_honest(&solution, &general, 1e-11);
        prop_assert_eq!(solution.status, Status::Solved);
        let (z, _) = boxed.recover(&solution.t, &solution.y);
        let (other, _) = boxed.recover(&expected.t, &expected.y);
        prop_assert!(distance(&z, &other) <= 1e-8);
    }
}
