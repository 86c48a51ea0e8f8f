//! The convex quadratic program on standard, horizontal and mixed problems: agreement with Lemke's method,
//! proofs, refusals, units.

#![cfg(feature = "clarabel")]
use crate::common;
mod forms;
use crate::common::quadratic;

use common::cases;
use faer::{Mat, mat};
use lcp::qp::SoftConstraints;
use lcp::{
    Basis, Contact2d, Error, HorizontalLcp, Lcp, Lemke, Method, MixedLcp, QuadraticProgram,
    QuadraticProgramSettings, Side, Solution, Solver, Status, WarmStart,
};
use lcp_problems::families::{self, KnownAnswer};
use proptest::collection::vec;
use proptest::prelude::*;
use quadratic::{TOLERANCES, assert_proof, gram, near, settings};

fn with_tolerance(tolerance: f64) -> QuadraticProgram {
    QuadraticProgram::new(QuadraticProgramSettings { tolerance, ..Default::default() })
}

fn solve_lcp(lcp: &Lcp, tolerance: f64) -> Solution<Lcp> {
    with_tolerance(tolerance).solve(lcp).unwrap()
}

/// Solved, by residuals computed anew.
fn assert_solved<P>(problem: &HorizontalLcp, solution: &Solution<P>, tolerance: f64) {
    assert_eq!(solution.status, Status::Solved, "{:?} {:?}", solution.residuals, solution.info);
    assert!(problem.residuals(&solution.t, &solution.y).worst() <= tolerance);
}

/// `M = C C^T` with integer entries, plus the identity or not.
fn symmetric_lcp(is_definite: bool) -> impl Strategy<Value = Lcp> {
    (1..=25_usize).prop_flat_map(move |n| {
        let rank = if is_definite { n } else { n.div_ceil(2) };
        (vec(-3..=3_i8, n * rank), vec(-3..=3_i8, n), vec(0..3_u8, n)).prop_map(
            move |(entries, values, states)| {
                let entries: Vec<f64> = entries.into_iter().map(f64::from).collect();
                let diagonal = if is_definite { 1.0 } else { 0.0 };
                let m =
                    gram(&entries, n, rank) + Mat::<f64>::identity(n, n) * faer::Scale(diagonal);
                // Planted, a third of the pairs without strict complementarity.
                let of = |state: u8, i: usize| {
                    if states[i] == state { f64::from(values[i]).abs() } else { 0.0 }
                };
                let z = Mat::from_fn(n, 1, |i, _| of(0, i));
                let mz = &m * &z;
                let q: Vec<f64> = (0..n).map(|i| of(1, i) - mz[(i, 0)]).collect();
                Lcp::new(m, q).unwrap()
            },
        )
    })
}

fn product(lcp: &Lcp, z: &[f64]) -> Vec<f64> {
    let mut mz = vec![0.0; z.len()];
    for (j, z) in z.iter().enumerate() {
        lcp.m().column(j).for_each(|(i, v)| mz[i] += v * z);
    }
    mz
}

/// `min x.H x / 2 + q.x` with some `x >= 0`, equations `E x = b` and inequalities `G x >= h`, as a mixed problem in `x` and
/// the multipliers. The sign of an equation does not matter, and changes from row to row.
fn program() -> impl Strategy<Value = (MixedLcp, usize)> {
    (1..=8_usize, 0..=3_usize, 0..=4_usize).prop_flat_map(|(n, equations, others)| {
        let rows = equations + others;
        (
            vec(-3..=3_i8, n * n),
            vec(-3..=3_i8, rows * n),
            vec(-3..=3_i8, n),
            vec(any::<bool>(), n),
            vec((any::<bool>(), 0..3_u8), rows),
        )
            .prop_map(move |(c, g, q, free, kinds)| {
                let h = gram(&c.into_iter().map(f64::from).collect::<Vec<_>>(), n, n);
                let at = |k: usize, j: usize| f64::from(g[k * n + j]);
                let sign = |k: usize| if k < equations && kinds[k].0 { -1.0 } else { 1.0 };
                let m = Mat::from_fn(n + rows, n + rows, |i, j| match (i < n, j < n) {
                    (true, true) => h[(i, j)] + if i == j { 1.0 } else { 0.0 },
                    (true, false) => -at(j - n, i),
                    (false, true) => sign(i - n) * at(i - n, j),
                    (false, false) => 0.0,
                });
                // A point that meets all conditions.
                let x = |j: usize| f64::from(1 + (q[j] + 3) % 3);
                let right = |k: usize| {
                    let value: f64 = (0..n).map(|j| at(k, j) * x(j)).sum();
                    let slack = if k < equations { 0.0 } else { f64::from(kinds[k].1) };
                    sign(k) * (slack - value)
                };
                let q: Vec<f64> =
                    q.iter().map(|q| f64::from(*q)).chain((0..rows).map(right)).collect();
                let is_free = (0..n + rows)
                    .map(|i| if i < n { free[i] } else { i - n < equations })
                    .collect();
                (MixedLcp::new(m, q, is_free).unwrap(), n)
            })
    })
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn programs_as_users_write_them_agree_with_lemke((problem, n) in program()) {
        let solution = QuadraticProgram::default().solve(&problem).unwrap();
        prop_assert!(solution.is_solved(), "{:?}", solution.residuals);
        let (x, w) = problem.variables(&solution);
        prop_assert!(problem.residuals(&x, &w).worst() <= 1e-10);
        let lemke = Lemke::default().solve(&problem).unwrap();
        prop_assert!(lemke.is_solved(), "{:?}", lemke.status);
        let (other, _) = problem.variables(&lemke);
        let size = other[..n].iter().fold(1.0_f64, |max, x| max.max(x.abs()));
        for (a, b) in x.iter().zip(&other).take(n) {
            prop_assert!((a - b).abs() <= 1e-7 * size, "{a} {b}");
        }
    }
}

proptest! {
    #![proptest_config(cases(48))]

    #[test]
    fn definite_problems_agree_with_lemke(lcp in symmetric_lcp(true)) {
        let problem: HorizontalLcp = lcp.clone().into();
        let lemke = Lemke::default().solve(&problem).unwrap();
        for tolerance in TOLERANCES {
            let solution = solve_lcp(&lcp, tolerance);
            assert_solved(&problem, &solution, tolerance);
        }
        let solution = solve_lcp(&lcp, 1e-12);
        let size = lemke.t.iter().fold(1.0_f64, |max, z| max.max(*z));
        for (a, b) in solution.t.iter().zip(&lemke.t) {
            prop_assert!((a - b).abs() <= 1e-9 * size, "{a} {b}");
        }
    }

    /// `z` is not unique, `M z` is.
    #[test]
    fn semidefinite_problems_agree_with_lemke(lcp in symmetric_lcp(false)) {
        let problem: HorizontalLcp = lcp.clone().into();
        let lemke = Lemke::default().solve(&problem).unwrap();
        prop_assert!(lemke.is_solved());
        for tolerance in TOLERANCES {
            let solution = solve_lcp(&lcp, tolerance);
            assert_solved(&problem, &solution, tolerance);
        }
        let solution = solve_lcp(&lcp, 1e-12);
        let [a, b] = [&solution.t, &lemke.t].map(|z| product(&lcp, z));
        let size = b.iter().fold(1.0_f64, |max, v| max.max(v.abs()));
        for (a, b) in a.iter().zip(&b) {
            prop_assert!((a - b).abs() <= 1e-9 * size, "{a} {b}");
        }
    }

    /// Any `q`: what Lemke solves is solved, what it proves infeasible is proved so.
    #[test]
    fn verdicts_agree_with_lemke(
        (entries, q) in (1..=8_usize)
            .prop_flat_map(|n| (vec(-2..=2_i8, n * n.div_ceil(2)), vec(-3..=3_i8, n)))
    ) {
        let n = q.len();
        let entries: Vec<f64> = entries.into_iter().map(f64::from).collect();
        let q: Vec<f64> = q.into_iter().map(f64::from).collect();
        let lcp = Lcp::new(gram(&entries, n, n.div_ceil(2)), q).unwrap();
        let problem: HorizontalLcp = lcp.clone().into();
        let lemke = Lemke::default().solve(&problem).unwrap();
        let solution = solve_lcp(&lcp, 1e-10);
        prop_assert_eq!(solution.status, lemke.status, "{:?}", solution);
        match solution.status {
            Status::Infeasible => assert_proof(&problem, &solution),
            _ => assert_solved(&problem, &solution, 1e-10),
        }
    }

    /// Powers of two in the units of forces, displacements and single pairs.
    #[test]
    fn units_do_not_matter(lcp in symmetric_lcp(true), [a, b] in [-40..40_i32, -40..40_i32]) {
        let (m, n) = (lcp.m().to_dense(), lcp.order());
        let (a, b) = (f64::from(a).exp2(), f64::from(b).exp2());
        let q: Vec<f64> = lcp.q().iter().map(|q| b * q).collect();
        let scaled = Lcp::new(Mat::from_fn(n, n, |i, j| a * m[(i, j)]), q).unwrap();
        let [first, second] = [&lcp, &scaled].map(|lcp| solve_lcp(lcp, 1e-12));
        prop_assert_eq!(first.status, second.status);
        prop_assert_eq!(first.info.factorisations, second.info.factorisations);
        for (first, second) in first.t.iter().zip(&second.t) {
            prop_assert_eq!((first * b / a).to_bits(), second.to_bits());
        }
        let unit = |i: usize| if i.is_multiple_of(2) { a.sqrt() } else { 1.0 };
        let paired = Lcp::new(
            Mat::from_fn(n, n, |i, j| unit(i) * m[(i, j)] * unit(j)),
            lcp.q().iter().enumerate().map(|(i, q)| unit(i) * q).collect::<Vec<f64>>(),
        )
        .unwrap();
        let third = solve_lcp(&paired, 1e-12);
        prop_assert_eq!(first.status, third.status);
        let size = first.t.iter().fold(1.0_f64, |max, z| max.max(*z));
        for (i, (first, third)) in first.t.iter().zip(&third.t).enumerate() {
            prop_assert!((first - unit(i) * third).abs() <= 1e-9 * size);
        }
    }
}

/// Both variables of the second pair vanish: an interior point alone is off by the root of its tolerance.
#[test]
fn a_degenerate_pair_is_exact() {
    let m = mat![[2.0, 1.0, 0.0], [1.0, 2.0, 1.0], [0.0, 1.0, 2.0]];
    let lcp = Lcp::new(m, vec![-1.0, -1.0, -1.0]).unwrap();
    for tolerance in TOLERANCES {
        let solution = solve_lcp(&lcp, tolerance);
        assert!(solution.is_solved());
        for (z, exact) in solution.t.iter().zip([0.5, 0.0, 0.5]) {
            assert!((z - exact).abs() <= 1e-15, "{:?}", solution.t);
        }
    }
}

#[test]
fn infeasible_problems_are_proved_so() {
    for (n, seed) in (2..14).flat_map(|n| (0..6).map(move |seed| (n, seed))) {
        let instance = families::infeasible_semidefinite(n, seed);
        let general: HorizontalLcp = instance.problem.clone().into();
        for tolerance in TOLERANCES {
            let solution = solve_lcp(&instance.problem, tolerance);
            assert_eq!(solution.status, Status::Infeasible, "{n} {seed} {:?}", solution.info);
            assert_proof(&general, &solution);
        }
    }
}

fn reason<P>(problem: &P) -> String
where
    QuadraticProgram: Solver<P>,
{
    match QuadraticProgram::default().solve(problem) {
        Err(Error::NotTreated { method, reason }) => {
            assert_eq!(method, Method::QuadraticProgram);
            reason
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_not_convex_is_refused() {
    let lcp = |m: Mat<f64>| Lcp::new(m, vec![-1.0; 2]).unwrap();
    let refused = reason(&lcp(mat![[1.0, 2.0], [0.5, 3.0]]));
    assert!(refused.contains("M[0, 1] is 2") || refused.contains("M[1, 0] is 0.5"), "{refused}");
    assert!(refused.contains("Lemke"));
    assert!(reason(&lcp(mat![[1.0, 2.0], [2.0, 1.0]])).contains("eigenvalue -1.000e0"));
    assert!(reason(&lcp(mat![[1.0, 0.0], [0.0, -1e-12]])).contains("M[1, 1] is -0.000000000001"));
    assert!(reason(&lcp(mat![[0.0, 1e-9], [1e-9, 1.0]])).contains("not positive semidefinite"));
    // One part in a million, in any units.
    for unit in [1e-20, 1.0, 1e20] {
        let m = mat![[1.0, -1.0 - 1e-6], [-1.0 - 1e-6, 1.0]];
        assert!(reason(&lcp(m * faer::Scale(unit))).contains("not positive semidefinite"));
    }
    let general = HorizontalLcp::new(
        mat![[1.0, 1.0], [1.0, 2.0]],
        mat![[1.0, 3.0], [2.0, 1.0]],
        vec![1.0, 1.0],
    );
    assert!(reason(&general.unwrap()).contains("standard"));
    let mixed = |m: Mat<f64>| MixedLcp::new(m, vec![-1.0; 2], vec![true, false]).unwrap();
    assert!(reason(&mixed(mat![[1.0, 1.0], [2.0, 1.0]])).contains("skew"));
    assert!(reason(&mixed(mat![[-1.0, 1.0], [-1.0, 1.0]])).contains("block of the variables"));
    assert!(reason(&mixed(mat![[1.0, 2.0], [2.0, 1.0]])).contains("not positive semidefinite"));
    let one = || mat![[1.0, 0.0]];
    let contact = Contact2d::new(
        mat![[1.0, 2.0], [2.0, 1.0]],
        vec![0.0; 2],
        one(),
        one(),
        vec![0.0],
        vec![0.0],
        vec![0.0],
    );
    let refused = contact.unwrap_err();
    assert!(matches!(refused, Error::Indefinite { .. }), "{refused}");
    assert!(refused.to_string().starts_with("K, scaled"), "{refused}");
}

/// A coupling of the size of rounding does not say which group a variable is in.
#[test]
fn couplings_of_rounding_do_not_matter() {
    let m = |dust: f64| mat![[1.0, -1.0, dust], [1.0, 1.0, 0.0], [0.0, 1e-17, 1.0]];
    let solve = |dust: f64| {
        let free = vec![true, false, false];
        let problem = MixedLcp::new(m(dust), vec![-1.0, 2.0, -3.0], free).unwrap();
        problem.variables(&QuadraticProgram::default().solve(&problem).unwrap()).0
    };
    let z = solve(1e-17);
    assert!((z[0] - 1.0).abs() < 1e-12 && z[1].abs() < 1e-12 && (z[2] - 3.0).abs() < 1e-12);
    assert_eq!(z, solve(0.0));
}

#[test]
fn settings_are_checked() {
    let lcp = Lcp::new(mat![[1.0]], vec![-1.0]).unwrap();
    let invalid = [
        QuadraticProgramSettings { tolerance: 0.0, ..Default::default() },
        QuadraticProgramSettings { max_iterations: 0, ..Default::default() },
        QuadraticProgramSettings { max_outer: 0, ..Default::default() },
        QuadraticProgramSettings {
            soft: Some(SoftConstraints { epsilon: 0.0, max_recentrings: 1 }),
            ..Default::default()
        },
    ];
    for settings in invalid {
        let solver = QuadraticProgram::new(settings);
        assert!(matches!(solver.solve(&lcp), Err(Error::Setting { .. })));
    }
    let start = WarmStart::Basis(Basis::all(Side::T, 2));
    let solver = QuadraticProgram::new(QuadraticProgramSettings { start, ..Default::default() });
    assert!(matches!(solver.solve(&lcp), Err(Error::Length { .. })));
}

/// From the right basis no interior-point method is needed.
#[test]
fn a_start_saves_the_interior_point() {
    let instance = families::obstacle(8).problem;
    let cold = solve_lcp(&instance, 1e-12);
    assert!(cold.is_solved() && cold.info.factorisations > 2);
    let start = WarmStart::Point { t: cold.t.clone(), y: cold.y.clone() };
    let warm = QuadraticProgram::new(QuadraticProgramSettings { start, ..settings() });
    let warm = warm.solve(&instance).unwrap();
    assert!(warm.is_solved() && warm.info.factorisations <= 2, "{:?}", warm.info);
}

/// In the horizontal form, with pairs the other way round.
#[test]
fn disguised_problems_are_solved() {
    for seed in 0..10 {
        let lcp = families::obstacle(5).problem;
        let n = lcp.order();
        let q: Vec<f64> =
            lcp.q().iter().enumerate().map(|(i, q)| q * (1.0 + (i + seed) as f64)).collect();
        let (a, b) = (Mat::from_fn(n, n, |i, j| -lcp.m()[(i, j)]), Mat::<f64>::identity(n, n));
        let swapped = |j: usize| (j + seed).is_multiple_of(3);
        let choose = |first: &Mat<f64>, second: &Mat<f64>| {
            Mat::from_fn(n, n, |i, j| if swapped(j) { second[(i, j)] } else { first[(i, j)] })
        };
        let problem = HorizontalLcp::new(choose(&a, &b), choose(&b, &a), q).unwrap();
        let solution = with_tolerance(1e-12).solve(&problem).unwrap();
        assert_solved(&problem, &solution, 1e-12);
        let start = WarmStart::Point { t: solution.t.clone(), y: solution.y.clone() };
        let warm = QuadraticProgram::new(QuadraticProgramSettings { start, ..settings() });
        let warm = Solver::<HorizontalLcp>::solve(&warm, &problem).unwrap();
        assert!(warm.is_solved() && warm.info.factorisations <= 2);
    }
}

#[test]
fn mixed_problems_are_solved() {
    for (n, seed) in (3..20).flat_map(|n| (0..4).map(move |seed| (n, seed))) {
        let mixed = families::mixed_monotone(n, seed);
        let KnownAnswer::Solution { t, .. } = &mixed.known else { panic!("planted") };
        let general = mixed.problem.to_general();
        for tolerance in TOLERANCES {
            let solution = with_tolerance(tolerance).solve(&mixed.problem).unwrap();
            assert_solved(&general, &solution, tolerance);
            if tolerance < 1e-10 {
                // The quadratic part, and with it w, is unique.
                let (z, _) = mixed.problem.recover(&solution.t, &solution.y);
                let image = |z: &[f64], i: usize| -> f64 {
                    let paired = (n / 3..n).map(|j| mixed.problem.m()[(i, j)] * z[j]);
                    paired.sum()
                };
                for i in n / 3..n {
                    assert!((image(&z, i) - image(t, i)).abs() < 1e-8);
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(cases(48))]

    #[test]
    fn order_does_not_matter(lcp in symmetric_lcp(true), seed in 0..1000_usize) {
        let (m, n) = (lcp.m().to_dense(), lcp.order());
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by_key(|i| (i * 7919 + seed) % 101);
        let permuted = Lcp::new(
            Mat::from_fn(n, n, |i, j| m[(order[i], order[j])]),
            order.iter().map(|&i| lcp.q()[i]).collect::<Vec<f64>>(),
        )
        .unwrap();
        let [first, second] = [&lcp, &permuted].map(|lcp| solve_lcp(lcp, 1e-12));
        prop_assert!(first.is_solved() && second.is_solved());
        let size = first.t.iter().fold(1.0_f64, |max, z| max.max(*z));
        for (i, &from) in order.iter().enumerate() {
            prop_assert!((second.t[i] - first.t[from]).abs() <= 1e-9 * size);
        }
    }
}

/// Nothing to solve, or no pairs at all.
#[test]
fn trivial_problems_are_solved() {
    let empty = Lcp::new(Mat::zeros(0, 0), Vec::new()).unwrap();
    assert!(solve_lcp(&empty, 1e-12).is_solved());
    let zero = Lcp::new(Mat::zeros(2, 2), vec![0.0, 3.0]).unwrap();
    let solution = solve_lcp(&zero, 1e-12);
    assert!(solution.is_solved() && near(solution.y[1], 3.0));
}
