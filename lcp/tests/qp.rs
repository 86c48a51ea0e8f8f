//! The convex quadratic program on standard, horizontal and mixed problems: agreement with Lemke's method,
//! proofs, refusals, units.

#![cfg(feature = "clarabel")]
#![allow(clippy::unwrap_used)] // a test may panic

mod common;
#[path = "common/quadratic.rs"]
mod quadratic;

use common::cases;
use faer::{Mat, mat};
use lcp::families::{self, Known};
use lcp::qp::SoftConstraints;
use lcp::{
    Auto, Basis, BoxedLcp, Contact2d, Error, HorizontalLcp, InteriorPoint, InteriorPointSettings,
    Lcp, Lemke, Matrix, Method, MixedLcp, QuadraticProgram, QuadraticProgramSettings, Side,
    Solution, Solver, Status, WarmStart,
};
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
        let Known::Solution { t, .. } = &mixed.known else { panic!("planted") };
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

/// A problem with bounds at one for some variables as a mixed one: distances from lower bounds, and a row for every upper one.
fn with_rows(boxed: &BoxedLcp) -> MixedLcp {
    let n = boxed.order();
    let bounded: Vec<usize> = (0..n).filter(|&j| boxed.lower()[j].is_finite()).collect();
    let mut entries: Vec<(usize, usize, f64)> =
        (0..n).flat_map(|j| boxed.m().column(j).map(move |(i, v)| (i, j, v))).collect();
    let mut q = boxed.q().to_vec();
    for &j in &bounded {
        boxed.m().column(j).for_each(|(i, v)| q[i] += v * boxed.lower()[j]);
    }
    for (k, &j) in bounded.iter().enumerate() {
        entries.extend([(j, n + k, 1.0), (n + k, j, -1.0)]);
        q.push(boxed.upper()[j] - boxed.lower()[j]);
    }
    let free = (0..q.len()).map(|j| j < n && !bounded.contains(&j)).collect();
    MixedLcp::new(Matrix::from_triplets(q.len(), q.len(), &entries).unwrap(), q, free).unwrap()
}

/// The same problem with two variables for every free one.
fn in_standard_form(mixed: &MixedLcp) -> Lcp {
    let columns = (0..mixed.order()).flat_map(|j| {
        let negative = mixed.free()[j].then_some((j, -1.0));
        [(j, 1.0)].into_iter().chain(negative)
    });
    let columns: Vec<(usize, f64)> = columns.collect();
    let n = columns.len();
    let m = Mat::from_fn(n, n, |i, j| {
        columns[i].1 * mixed.m()[(columns[i].0, columns[j].0)] * columns[j].1
    });
    Lcp::new(m, columns.iter().map(|(j, sign)| sign * mixed.q()[*j]).collect::<Vec<f64>>()).unwrap()
}

/// Free states and multipliers, equations and bounds, in every form that they can be written in.
#[test]
fn programs_of_control_are_solved_in_every_form() {
    for (steps, seed) in [3, 10, 30].into_iter().flat_map(|n| (0..8).map(move |seed| (n, seed))) {
        let boxed = families::control(steps, seed).problem;
        let mixed = with_rows(&boxed);
        let standard = in_standard_form(&mixed);
        for method in [&QuadraticProgram::default() as &dyn Solver<BoxedLcp>, &Auto::default()] {
            let solution = method.solve(&boxed).unwrap();
            assert!(solution.is_solved(), "{steps} {seed} {}: {solution:?}", method.method());
            let (z, w) = boxed.variables(&solution);
            assert!(boxed.residuals(&z, &w).worst() <= 1e-10);
        }
        for method in [&QuadraticProgram::default() as &dyn Solver<MixedLcp>, &Auto::default()] {
            let solution = method.solve(&mixed).unwrap();
            assert!(solution.is_solved(), "{steps} {seed} {}: {solution:?}", method.method());
        }
        let solution = Auto::default().solve(&standard).unwrap();
        assert!(solution.is_solved(), "{steps} {seed}: {:?} {:?}", solution.status, solution.info);
    }
}

/// Variables with any bounds in one problem: free, from below, from above, between, and fixed.
#[test]
fn bounds_of_every_kind_are_kept() {
    let m = mat![
        [2.0, 1.0, 0.0, 0.0, 0.5],
        [1.0, 3.0, 1.0, 0.0, 0.0],
        [0.0, 1.0, 2.0, 0.5, 0.0],
        [0.0, 0.0, 0.5, 1.0, 0.0],
        [0.5, 0.0, 0.0, 0.0, 1.0],
    ];
    let infinite = f64::INFINITY;
    for shift in [0.0, 7.0, -7.0] {
        let lower = vec![-infinite, 1.0, -infinite, -1.0, 2.0].into_iter().map(|v| v + shift);
        let upper = vec![infinite, infinite, -1.0, 3.0, 2.0].into_iter().map(|v| v + shift);
        let (lower, upper): (Vec<f64>, Vec<f64>) = (lower.collect(), upper.collect());
        for q in [vec![-3.0, 1.0, -2.0, -9.0, 4.0], vec![30.0, -10.0, 50.0, 9.0, -4.0]] {
            let problem = BoxedLcp::new(m.clone(), q, lower.clone(), upper.clone()).unwrap();
            let lemke = Lemke::default().solve(&problem).unwrap();
            let (expected, _) = problem.variables(&lemke);
            let qp = QuadraticProgram::default();
            let interior = InteriorPoint::default();
            for method in [&qp as &dyn Solver<BoxedLcp>, &interior] {
                let solution = method.solve(&problem).unwrap();
                assert!(solution.is_solved(), "{}: {solution:?}", method.method());
                let (z, w) = problem.variables(&solution);
                assert!(problem.residuals(&z, &w).worst() <= 1e-12);
                for (z, expected) in z.iter().zip(&expected) {
                    assert!(
                        (z - expected).abs() <= 1e-11 * expected.abs().max(1.0),
                        "{z} {expected}"
                    );
                }
            }
            // From the basis of the solution, and from its point, nothing is left to do.
            let start = WarmStart::Point { t: lemke.t.clone(), y: lemke.y.clone() };
            let warm = InteriorPoint::new(InteriorPointSettings { start, ..Default::default() });
            let warm = warm.solve(&problem).unwrap();
            assert!(warm.is_solved() && warm.info.iterations == 0);
            let start = WarmStart::Basis(warm.basis.clone().unwrap());
            let again = InteriorPoint::new(InteriorPointSettings { start, ..Default::default() });
            let again = again.solve(&problem).unwrap();
            assert!(again.is_solved() && again.info.iterations == 0);
        }
    }
}

/// Bounds that contradict an equation are proved to do so, in the rows of the problem with bounds.
#[test]
fn bounds_that_contradict_equations_are_proved_to() {
    // x + u = 5 with x free below one, and u between two bounds.
    let m = mat![[1.0, 0.0, -1.0], [0.0, 1.0, -1.0], [1.0, 1.0, 0.0]];
    let infinite = f64::INFINITY;
    let (lower, upper) = (vec![-infinite, 2.0, -infinite], vec![1.0, 3.0, infinite]);
    let problem = BoxedLcp::new(m, vec![0.0, 0.0, -5.0], lower, upper).unwrap();
    let solution = QuadraticProgram::default().solve(&problem).unwrap();
    assert_eq!(solution.status, Status::Infeasible);
    assert!(solution.certificate.unwrap().holds(&problem.to_general()));
}
