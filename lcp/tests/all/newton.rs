//! The primal-dual active set method: answers that are known, invariances, cycles, honest failures.

use crate::common;

use std::ops::ControlFlow;
use std::time::Duration;

use common::cases;
use faer::{Mat, mat};
use lcp::{
    Basis, Error, HorizontalLcp, Lcp, Lemke, LemkeSettings, Matrix, Method, SemismoothNewton,
    SemismoothNewtonSettings, Side, Solution, Solver, Status, WarmStart,
};
use lcp_problems::families::{self, Instance, KnownAnswer};
use proptest::collection::vec;
use proptest::prelude::*;

const LARGEST: usize = 12;

fn with_start(start: WarmStart) -> SemismoothNewton {
    SemismoothNewton::new(SemismoothNewtonSettings { start, ..Default::default() })
}

fn solve(lcp: &Lcp) -> Solution<Lcp> {
    SemismoothNewton::default().solve(lcp).unwrap()
}

fn basis(is_free: &[bool]) -> Basis {
    Basis::new(is_free.iter().map(|&it| if it { Side::T } else { Side::Y }).collect())
}

/// Largest difference, in units of the largest entry expected.
fn difference(found: &[f64], expected: &[f64]) -> f64 {
    let size = expected.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
    let worst = found.iter().zip(expected).fold(0.0_f64, |max, (a, b)| max.max((a - b).abs()));
    if size > 0.0 { worst / size } else { worst }
}

/// What every answer owes: finite, and solved only with small residuals and no sign wrong.
fn assert_honest<P>(lcp: &Lcp, solution: &Solution<P>, tolerance: f64) {
    let (z, w) = (&solution.t, &solution.y);
    assert!(z.iter().chain(w).all(|v| v.is_finite()));
    let residuals = lcp.residuals(z, w);
    assert_eq!(residuals, solution.residuals);
    assert_eq!(residuals.worst() <= tolerance, solution.is_solved());
    assert_eq!(solution.info.history.len(), solution.info.iterations + 1);
}

fn unique() -> impl Strategy<Value = (Lcp, Vec<f64>)> {
    let kind = 0..6_usize;
    (kind, 1..=LARGEST, any::<u64>()).prop_map(|(kind, n, seed)| {
        let Instance { problem, known } = match kind {
            0 => families::positive_definite(n, seed),
            1 => families::harker_pang(n, seed),
            2 => families::p_matrix(n, seed),
            3 => families::murty(n.min(8)),
            4 => families::fathi(n.min(6)),
            _ => families::obstacle(n.min(7)),
        };
        let t = match known {
            KnownAnswer::Unique { t, .. } => t,
            _ => Lemke::default().solve(&problem).unwrap().t,
        };
        (problem, t)
    })
}

fn sparse(lcp: &Lcp) -> Lcp {
    let n = lcp.order();
    let pairs = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let entries = pairs.map(|(i, j)| faer::sparse::Triplet::new(i, j, lcp.m()[(i, j)]));
    let entries: Vec<_> = entries.filter(|it| it.val != 0.0).collect();
    let m = faer::sparse::SparseColMat::try_new_from_triplets(n, n, &entries).unwrap();
    Lcp::new(m, lcp.q().to_vec()).unwrap()
}

proptest! {
    #![proptest_config(cases(200))]

    /// P-matrices are solved from every start, dense and sparse, to every tolerance.
    #[test]
    fn p_matrices_from_every_start(
        (lcp, expected) in unique(),
        is_free in vec(any::<bool>(), LARGEST * LARGEST),
    ) {
        let start = WarmStart::Basis(basis(&is_free[..lcp.order()]));
        for start in [WarmStart::None, start] {
            for tolerance in [1e-4, 1e-8, 1e-12] {
                let settings = SemismoothNewtonSettings {
                    tolerance,
                    start: start.clone(),
                    ..Default::default()
                };
                let routes: [Box<dyn Solver<Lcp>>; 2] = [
                    Box::new(SemismoothNewton::new(settings)),
                    Box::new(Lemke::new(LemkeSettings { tolerance, ..Default::default() })),
                ];
                let [found, by_lemke] = routes.map(|route| {
                    let solution = route.solve(&lcp).unwrap();
                    assert_eq!(solution.status, Status::Solved, "{}", route.method());
                    solution
                });
                assert_honest(&lcp, &found, tolerance);
                assert!(difference(&found.t, &expected) < 1e-9);
                assert!(difference(&found.t, &by_lemke.t) < 1e-9);
            }
            let found = with_start(start).solve(&sparse(&lcp)).unwrap();
            assert_eq!(found.status, Status::Solved);
            assert!(difference(&found.t, &expected) < 1e-9);
        }
    }

    /// Units of `z` and of `w` do not matter: the answer is the same, in other units.
    #[test]
    fn units((lcp, expected) in unique(), exponents in vec(-20..=20_i32, 2 * LARGEST * LARGEST)) {
        let n = lcp.order();
        let (rows, cols): (Vec<f64>, Vec<f64>) =
            (0..n).map(|i| (f64::from(exponents[2 * i]).exp2(), f64::from(exponents[2 * i + 1]).exp2())).unzip();
        let m = Mat::from_fn(n, n, |i, j| rows[i] * lcp.m()[(i, j)] * cols[j]);
        let q: Vec<f64> = lcp.q().iter().zip(&rows).map(|(q, row)| q * row).collect();
        let scaled = solve(&Lcp::new(m, q).unwrap());
        prop_assert_eq!(scaled.status, Status::Solved);
        let back: Vec<f64> = scaled.t.iter().zip(&cols).map(|(z, col)| z * col).collect();
        prop_assert!(difference(&back, &expected) < 1e-9);
        // One factor for all is exact and changes no step.
        for factor in [2.0_f64.powi(100), 2.0_f64.powi(-100)] {
            let m = Mat::from_fn(n, n, |i, j| factor * lcp.m()[(i, j)]);
            let other = solve(&Lcp::new(m, lcp.q().iter().map(|q| q * factor).collect::<Vec<f64>>()).unwrap());
            let same = solve(&Lcp::new(lcp.m().to_dense(), lcp.q().to_vec()).unwrap());
            prop_assert_eq!(other.info.history, same.info.history);
            prop_assert_eq!(other.t, same.t);
        }
    }

    /// Pairs in another order, with their variables exchanged, rows in another order and multiplied: the
    /// general problem is recognised, and its start and its basis are those of its own pairs.
    #[test]
    fn disguises(
        (lcp, expected) in unique(),
        keys in vec(any::<u32>(), 2 * LARGEST * LARGEST),
        swaps in vec(any::<bool>(), LARGEST * LARGEST),
    ) {
        let n = lcp.order();
        let order = |keys: &[u32]| {
            let mut order: Vec<usize> = (0..n).collect();
            order.sort_by_key(|&i| keys[i]);
            order
        };
        let (pairs, rows) = (order(&keys), order(&keys[n..]));
        let factor = |i: usize| if swaps[i] { -4.0 } else { 0.5 };
        let entry = |i: usize, j: usize, is_z: bool| {
            let (row, pair) = (rows[i], pairs[j]);
            let w = if row == pair { 1.0 } else { 0.0 };
            factor(i) * if is_z { -lcp.m()[(row, pair)] } else { w }
        };
        let a = Mat::from_fn(n, n, |i, j| entry(i, j, !swaps[j]));
        let b = Mat::from_fn(n, n, |i, j| entry(i, j, swaps[j]));
        let c: Vec<f64> = (0..n).map(|i| factor(i) * lcp.q()[rows[i]]).collect();
        let problem = HorizontalLcp::new(a, b, c).unwrap();
        let found = SemismoothNewton::default().solve(&problem).unwrap();
        prop_assert_eq!(found.status, Status::Solved);
        prop_assert_eq!(found.residuals, problem.residuals(&found.t, &found.y));
        let mut z = vec![0.0; n];
        (0..n).for_each(|j| z[pairs[j]] = if swaps[j] { found.y[j] } else { found.t[j] });
        prop_assert!(difference(&z, &expected) < 1e-9);
        let again = with_start(WarmStart::Basis(found.basis.clone().unwrap()));
        let again = again.solve(&problem).unwrap();
        prop_assert_eq!(again.status, Status::Solved);
        prop_assert_eq!(again.info.iterations, 0);
        prop_assert_eq!(again.basis, found.basis);
    }

    /// Whatever the class: finite points, and solved only where it is.
    #[test]
    fn never_wrong(kind in 0..7_usize, n in 1..=LARGEST, seed: u64, is_sparse: bool) {
        let lcp = match kind {
            0 => families::positive_semidefinite(n, seed).problem,
            1 => families::strictly_copositive(n, seed).problem,
            2 => families::copositive_plus(n, seed).problem,
            3 => families::infeasible_semidefinite(n, seed).problem,
            4 => families::ties(n, seed).problem,
            5 => families::bimatrix(n, n, seed).problem,
            _ => families::kostreva_2().problem,
        };
        let lcp = if is_sparse { sparse(&lcp) } else { lcp };
        match SemismoothNewton::default().solve(&lcp) {
            Ok(solution) => {
                assert_honest(&lcp, &solution, 1e-10);
                prop_assert!(kind != 3 || !solution.is_solved());
                prop_assert!(kind != 5);
            }
            Err(Error::NotTreated { method, reason }) => {
                prop_assert_eq!(method, Method::Newton);
                prop_assert!(reason.contains("positive") && reason.contains("Lemke"));
                prop_assert!((0..lcp.order()).any(|i| lcp.m()[(i, i)] <= 0.0));
            }
            Err(error) => panic!("{error}"),
        }
    }

    /// Definite problems in half of whose pairs both variables are zero: rounding errors decide on the
    /// sets, and nothing comes of it.
    #[test]
    fn without_strict_complementarity(
        n in 1..=LARGEST,
        entries in vec(-1.0..1.0_f64, LARGEST * LARGEST),
        states in vec(0..4_u8, LARGEST),
        exponent in -20..=20_i32,
    ) {
        let c = Mat::from_fn(n, n, |i, j| entries[i * LARGEST + j]);
        let m = &c * c.transpose() + 0.01 * Mat::<f64>::identity(n, n);
        let unit = f64::from(exponent).exp2();
        let z: Vec<f64> = (0..n).map(|i| if states[i] == 0 { unit / 3.0 } else { 0.0 }).collect();
        let w: Vec<f64> = (0..n).map(|i| if states[i] == 1 { unit / 7.0 } else { 0.0 }).collect();
        let row = |i: usize| w[i] - (0..n).map(|j| m[(i, j)] * z[j]).sum::<f64>();
        let lcp = Lcp::new(m.clone(), (0..n).map(row).collect::<Vec<f64>>()).unwrap();
        for lcp in [sparse(&lcp), lcp] {
            let found = solve(&lcp);
            prop_assert_eq!(found.status, Status::Solved);
            assert_honest(&lcp, &found, 1e-10);
            prop_assert!(difference(&found.t, &z) < 1e-9 || difference(&found.t, &z) < 1e-9 * unit);
            prop_assert!(found.t.iter().chain(&found.y).all(|v| *v >= 0.0));
        }
    }

    /// No entry positive off the diagonal, singular as a whole, not symmetric: what is feasible is solved
    /// (a chain of springs that is not held, with a part of each row from the middle to the left).
    #[test]
    fn chains_that_are_not_held(
        n in 2..=LARGEST,
        parts in vec(0.0..1.0_f64, LARGEST),
        forces in vec(-1.0..1.0_f64, LARGEST),
    ) {
        let entry = |i: usize, j: usize| {
            let (left, right) = (if i > 0 { parts[i] } else { 0.0 }, if i + 1 < n { 1.0 } else { 0.0 });
            match (i, j) {
                _ if i == j => left + right,
                _ if i == j + 1 => -left,
                _ if i + 1 == j => -right,
                _ => 0.0,
            }
        };
        let m = Mat::from_fn(n, n, entry);
        // The chain balances forces that are multiplied by one over the part from one row to the next.
        let leverage: f64 = parts[n / 2 + 1..n].iter().map(|part| 1.0 / part).product();
        prop_assume!(m[(n - 1, n - 1)] > 0.01 && leverage < 100.0_f64.powi(2));
        // One of them is pushed onto the ground by more than all others are pulled.
        let mut q = forces[..n].to_vec();
        q[n / 2] = 1e3 * n as f64 * (1.0 + 100.0_f64.powi(2));
        let lcp = Lcp::new(m, q).unwrap();
        for lcp in [sparse(&lcp), lcp] {
            let found = solve(&lcp);
            let by_lemke = Lemke::default().solve(&lcp).unwrap();
            prop_assert_eq!(found.status, by_lemke.status);
            assert_honest(&lcp, &found, 1e-10);
        }
    }
}

/// From the first unit vector the method without a safeguard goes round through three free sets.
#[test]
fn cycles_are_left() {
    let Instance { problem, known } = families::kostreva_1();
    let KnownAnswer::Unique { t, .. } = known else { panic!("a P-matrix") };
    for lcp in [sparse(&problem), problem] {
        let found = with_start(WarmStart::Basis(basis(&[true, false, false]))).solve(&lcp).unwrap();
        assert_eq!(found.status, Status::Solved);
        assert!(found.info.iterations > 3, "{:?}", found.info);
        assert!(difference(&found.t, &t) < 1e-15);
    }
}

/// Not a P-matrix, and no solution: single exchanges come back.
#[test]
fn cycles_are_told() {
    let lcp = Lcp::new(mat![[1.0, -3.0], [-3.0, 1.0]], vec![-1.0, -1.0]).unwrap();
    let found = solve(&lcp);
    assert!(matches!(found.status, Status::Cycling | Status::Stalled), "{:?}", found.status);
    assert_honest(&lcp, &found, 1e-10);
}

#[test]
fn limits_and_observers() {
    let lcp = families::Obstacle::new(20, 20, families::Ground::Hills { count: 2 }).problem();
    let limited = |settings| SemismoothNewton::new(settings).solve(&lcp).unwrap();
    let few = limited(SemismoothNewtonSettings { max_iterations: 1, ..Default::default() });
    assert_eq!((few.status, few.info.iterations), (Status::IterationLimit, 1));
    assert_honest(&lcp, &few, 1e-10);
    let time_limit = Some(Duration::ZERO);
    let late = limited(SemismoothNewtonSettings { time_limit, ..Default::default() });
    assert_eq!((late.status, late.info.iterations), (Status::TimeLimit, 0));
    let mut seen = Vec::new();
    let stopped = SemismoothNewton::default().solve_observed(&lcp, &mut |it| {
        seen.push(it.residual);
        if it.iteration < 1 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let stopped = stopped.unwrap();
    assert_eq!(stopped.status, Status::Cancelled);
    assert_eq!(stopped.info.history, seen);
    assert_eq!(stopped.info.iterations, 1);
}

#[test]
fn misuse_is_named() {
    let lcp = families::positive_definite(3, 1).problem;
    let error = |settings| SemismoothNewton::new(settings).solve(&lcp).unwrap_err();
    let tolerance = SemismoothNewtonSettings { tolerance: 0.0, ..Default::default() };
    assert!(matches!(error(tolerance), Error::Setting { name: "tolerance", .. }));
    let start = |start| SemismoothNewtonSettings { start, ..Default::default() };
    let short = start(WarmStart::Basis(Basis::all(Side::T, 2)));
    assert_eq!(error(short), Error::Length { name: "start", len: 2, expected: 3 });
    let nan = WarmStart::Point { t: vec![0.0, f64::NAN, 0.0], y: vec![0.0; 3] };
    assert!(matches!(error(start(nan)), Error::NotFinite { what: "start.t", row: 1, .. }));
    let general = families::horizontal_singular(6, 1).problem;
    let refused = SemismoothNewton::default().solve(&general).unwrap_err();
    assert!(refused.to_string().contains("take Lemke"), "{refused}");
}

#[test]
fn trivial_orders() {
    let empty = Lcp::new(Mat::<f64>::zeros(0, 0), vec![]).unwrap();
    assert_eq!(solve(&empty).status, Status::Solved);
    let empty = Lcp::new(Matrix::identity(0), vec![]).unwrap();
    assert_eq!(solve(&empty).status, Status::Solved);
    let one = Lcp::new(Matrix::identity(1), vec![-2.0]).unwrap();
    assert_eq!(solve(&one).t, [2.0]);
    let apart = Lcp::new(Matrix::identity(2), vec![1.0, 0.0]).unwrap();
    let found = solve(&apart);
    assert_eq!((found.status, found.t, found.y), (Status::Solved, vec![0.0; 2], vec![1.0, 0.0]));
}

/// Upwind differences: an M-matrix that is not symmetric, dense and sparse.
#[test]
fn convection() {
    let (side, speed) = (30, 3.0);
    let n = side * side;
    let entry = |i: usize, j: usize| {
        let (row, col) = (i / side, i % side);
        match j {
            _ if i == j => 4.0 + speed,
            _ if col > 0 && j == i - 1 => -1.0 - speed,
            _ if col + 1 < side && j == i + 1 || row > 0 && j == i - side => -1.0,
            _ if row + 1 < side && j == i + side => -1.0,
            _ => 0.0,
        }
    };
    let m = Mat::from_fn(n, n, entry);
    let q: Vec<f64> = (0..n).map(|i| (i as f64 * 0.37).sin() + 0.3).collect();
    let dense = Lcp::new(m, q).unwrap();
    let sparse = sparse(&dense);
    let (first, second) = (solve(&dense), solve(&sparse));
    assert_eq!((first.status, second.status), (Status::Solved, Status::Solved));
    assert_eq!(first.basis, second.basis);
    assert!(difference(&first.t, &second.t) < 1e-12);
    let free = first.t.iter().filter(|z| **z > 0.0).count();
    assert!(free > n / 10 && free < 9 * n / 10, "{free}");
}
