//! The convex quadratic program: agreement with Lemke's method and closed forms, proofs, refusals, springs.

#![cfg(feature = "clarabel")]
#![allow(clippy::unwrap_used)] // a test may panic

mod common;

use std::ops::ControlFlow;
use std::time::Duration;

use common::cases;
use faer::{Mat, mat};
use lcp::families::{self, Known};
use lcp::{
    Basis, Contact2d, ContactForm, ContactState, Error, HorizontalLcp, Lcp, Lemke, MixedLcp,
    QuadraticProgram, QuadraticProgramSettings, Side, SoftConstraints, Solution, Solver, Status,
    WarmStart,
};
use proptest::collection::vec;
use proptest::prelude::*;

const TOLERANCES: [f64; 3] = [1e-4, 1e-8, 1e-12];

fn with_tolerance(tolerance: f64) -> QuadraticProgram {
    QuadraticProgram::new(QuadraticProgramSettings { tolerance, ..Default::default() })
}

fn settings() -> QuadraticProgramSettings {
    QuadraticProgramSettings { tolerance: 1e-12, ..Default::default() }
}

fn solve_lcp(lcp: &Lcp, tolerance: f64) -> Solution {
    with_tolerance(tolerance).solve(lcp).unwrap()
}

/// Solved, by residuals computed anew.
fn assert_solved(problem: &HorizontalLcp, solution: &Solution, tolerance: f64) {
    assert_eq!(solution.status, Status::Solved, "{:?} {:?}", solution.residuals, solution.info);
    assert!(problem.residuals(&solution.t, &solution.y).worst() <= tolerance);
}

fn solve_contact(
    contact: &Contact2d,
    settings: QuadraticProgramSettings,
) -> (ContactState, Solution) {
    let tolerance = settings.tolerance;
    let solution = QuadraticProgram::new(settings).solve(contact).unwrap();
    let state = contact.recover(&solution.t, &solution.y);
    let residuals = contact.residuals(&state);
    if solution.is_solved() {
        assert!(residuals.worst() <= tolerance, "{residuals:?}");
    }
    (state, solution)
}

/// Solved at every tolerance in both forms, where there are two; the state at the last.
fn solved_contact(contact: &Contact2d, forms: &[ContactForm]) -> ContactState {
    let mut last = None;
    for &form in forms {
        for tolerance in TOLERANCES {
            let settings = QuadraticProgramSettings { tolerance, form, ..Default::default() };
            let (state, solution) = solve_contact(contact, settings);
            assert_eq!(solution.status, Status::Solved, "{form:?} {tolerance}: {solution:?}");
            last = Some(state);
        }
    }
    last.unwrap()
}

const BOTH: [ContactForm; 2] = [ContactForm::Primal, ContactForm::Dual];
const PRIMAL: [ContactForm; 1] = [ContactForm::Primal];

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-11 * (1.0 + b.abs())
}

fn gram(entries: &[f64], n: usize, rank: usize) -> Mat<f64> {
    let c = Mat::from_fn(n, rank, |i, j| entries[i * rank + j]);
    &c * c.transpose()
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
                let q = (0..n).map(|i| of(1, i) - mz[(i, 0)]).collect();
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
        let q = q.into_iter().map(f64::from).collect();
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
        let q = lcp.q().iter().map(|q| b * q).collect();
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
            lcp.q().iter().enumerate().map(|(i, q)| unit(i) * q).collect(),
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

fn assert_proof(problem: &HorizontalLcp, solution: &Solution) {
    let pi = solution.farkas.as_ref().unwrap();
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
        Err(Error::NotTreated { solver, reason }) => {
            assert_eq!(solver, QuadraticProgram::NAME);
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
    assert!(reason(&mixed(mat![[1.0, 1.0], [1.0, 1.0]])).contains("skew"));
    assert!(reason(&mixed(mat![[-1.0, 1.0], [-1.0, 1.0]])).contains("free variables"));
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
    assert!(reason(&contact.unwrap()).contains("K, scaled"));
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

fn contact(
    (k, f): (Mat<f64>, Vec<f64>),
    (c_n, c_t): (Mat<f64>, Mat<f64>),
    (x_0, s_0): (Vec<f64>, Vec<f64>),
    mu: Vec<f64>,
) -> Contact2d {
    Contact2d::new(k, f, c_n, c_t, x_0, s_0, mu).unwrap()
}

/// A body of weight 2 on a plane with `mu = 0.5`, pushed by `push`, with springs to the ground.
fn block(push: f64, vertical: f64, behind: f64) -> Contact2d {
    let k = mat![[vertical, 0.0], [0.0, behind]];
    let rows = (mat![[1.0, 0.0]], mat![[0.0, 1.0]]);
    contact((k, vec![-2.0, push]), rows, (vec![0.0], vec![0.0]), vec![0.5])
}

#[test]
fn a_block_on_a_plane_sticks_or_slips() {
    for (push, t_t, slip) in
        [(0.4, -0.4, 0.0), (-0.9, 0.9, 0.0), (1.6, -1.0, 0.2), (-2.5, 1.0, -0.5), (1.0, -1.0, 0.0)]
    {
        let state = solved_contact(&block(push, 0.0, 3.0), &PRIMAL);
        assert!(near(state.t_n[0], 2.0) && near(state.t_t[0], t_t), "{push}: {state:?}");
        assert!(near(state.slip[0], slip), "{push}: {state:?}");
        let state = solved_contact(&block(push, 5.0, 3.0), &BOTH);
        assert!(near(state.t_n[0], 2.0) && near(state.slip[0], slip), "{push}: {state:?}");
    }
}

/// Without a spring behind it the block is held by friction alone, or not at all.
#[test]
fn a_block_that_nothing_holds_is_infeasible() {
    let state = solved_contact(&block(0.9, 0.0, 0.0), &PRIMAL);
    assert!(near(state.t_t[0], -0.9));
    let contact = block(1.1, 0.0, 0.0);
    let (_, solution) = solve_contact(&contact, settings());
    assert_eq!(solution.status, Status::Infeasible, "{solution:?}");
    assert_proof(&contact.to_general(), &solution);
}

/// A wedge of the half angle `a` between two walls: two displacements, or rigid with a rotation.
fn wedge(angle: f64, weight: f64, mu: f64) -> Contact2d {
    let (sin, cos) = angle.sin_cos();
    // The normals of the walls push it up and to the middle.
    let c_n = mat![[cos, sin], [-cos, sin]];
    let c_t = mat![[sin, -cos], [-sin, -cos]];
    let f = vec![0.0, -weight];
    contact((Mat::zeros(2, 2), f), (c_n, c_t), (vec![0.0; 2], vec![0.0; 2]), vec![mu; 2])
}

#[test]
fn a_wedge_is_held_by_its_walls() {
    for (angle, weight) in [(0.3, 10.0), (0.8, 1.0), (1.3, 4e3)] {
        let state = solved_contact(&wedge(angle, weight, 0.0), &PRIMAL);
        let normal = weight / (2.0 * angle.sin());
        assert!(state.t_n.iter().all(|t| near(t / normal, 1.0)), "{state:?} {normal}");
    }
    // Friction shares the load in many ways: any exact one will do.
    for mu in [0.1, 0.5, 1.0, 3.0] {
        solved_contact(&wedge(0.7, 3.0, mu), &PRIMAL);
    }
}

/// A column of `n` bodies that float on one another, with weights 1: every joint carries what is above.
fn pile(n: usize, mu: f64) -> Contact2d {
    // Per body: vertical displacements of its lower and its upper face, joined by a spring, and a
    // horizontal one.
    let order = 3 * n;
    let mut k = Mat::zeros(order, order);
    let (mut c_n, mut c_t) = (Mat::zeros(n, order), Mat::zeros(n, order));
    for body in 0..n {
        let (low, high, side) = (3 * body, 3 * body + 1, 3 * body + 2);
        let stiffness = 100.0 + 10.0 * body as f64;
        (k[(low, low)], k[(high, high)]) = (stiffness, stiffness);
        (k[(low, high)], k[(high, low)]) = (-stiffness, -stiffness);
        (c_n[(body, low)], c_t[(body, side)]) = (1.0, 1.0);
        if body > 0 {
            (c_n[(body, low - 2)], c_t[(body, side - 3)]) = (-1.0, -1.0);
        }
    }
    let f = (0..order).map(|j| [-0.5, -0.5, if mu > 0.0 { 0.05 } else { 0.0 }][j % 3]).collect();
    contact((k, f), (c_n, c_t), (vec![0.0; n], vec![0.0; n]), vec![mu; n])
}

#[test]
fn a_pile_of_floating_bodies_carries_its_weight() {
    for mu in [0.0, 0.3] {
        let state = solved_contact(&pile(9, mu), &PRIMAL);
        for (joint, t_n) in state.t_n.iter().enumerate() {
            assert!(near(*t_n, (9 - joint) as f64), "{:?}", state.t_n);
        }
    }
}

#[test]
fn units_of_contact_do_not_matter() {
    let (n, base) = (6, pile(6, 0.3));
    let (reference, _) = solve_contact(&base, settings());
    for (length, force) in [(-10_i32, 20_i32), (10, 0), (0, -33), (-7, 5)] {
        let (length, force) = (f64::from(length).exp2(), f64::from(force).exp2());
        let k = base.stiffness().to_dense() * faer::Scale(force / length);
        let f = base.loads().iter().map(|f| force * f).collect();
        let rows = (base.normal().to_dense(), base.tangent().to_dense());
        let x_0 = (vec![0.0; n], vec![0.0; n]);
        let (state, solution) =
            solve_contact(&contact((k, f), rows, x_0, vec![0.3; n]), settings());
        assert!(solution.is_solved());
        for (a, b) in reference.t_n.iter().zip(&state.t_n) {
            assert_eq!((a * force).to_bits(), b.to_bits());
        }
        for (a, b) in reference.u.iter().zip(&state.u) {
            assert_eq!((a * length).to_bits(), b.to_bits());
        }
    }
}

/// Small random structures: exact, and, without friction, with the contact forces of Lemke's method.
fn random_contact() -> impl Strategy<Value = (Contact2d, bool)> {
    (2..=8_usize, 1..=6_usize, 0..=2_usize).prop_flat_map(|(n, m, mu)| {
        let sizes = (vec(-2..=2_i8, n * n), vec(-2..=2_i8, 2 * m * n), vec(-3..=3_i8, n + 2 * m));
        sizes.prop_map(move |(k, c, v)| {
            let real = |v: Vec<i8>| v.into_iter().map(f64::from).collect::<Vec<_>>();
            let (k, c, v) = (real(k), real(c), real(v));
            let k = gram(&k, n, n) + Mat::<f64>::identity(n, n);
            let rows = |first: usize| Mat::from_fn(m, n, |i, j| c[first + i * n + j]);
            let x_0 = v[n..n + m].iter().map(|x| x.abs()).collect();
            let mu = vec![0.3 * mu as f64; m];
            let is_smooth = mu[0] <= 0.0;
            let offsets = (x_0, v[n + m..].to_vec());
            (contact((k, v[..n].to_vec()), (rows(0), rows(m * n)), offsets, mu), is_smooth)
        })
    })
}

proptest! {
    #![proptest_config(cases(48))]

    #[test]
    fn contacts_agree_with_lemke((contact, is_smooth) in random_contact()) {
        let lemke = Solver::<Contact2d>::solve(&Lemke::default(), &contact).unwrap();
        let expected = contact.recover(&lemke.t, &lemke.y);
        for form in [ContactForm::Auto, ContactForm::Primal, ContactForm::Dual] {
            for tolerance in TOLERANCES {
                let settings = QuadraticProgramSettings { tolerance, form, ..settings() };
                let (state, solution) = solve_contact(&contact, settings);
                if is_smooth {
                    prop_assert_eq!(solution.status, Status::Solved);
                    if tolerance < 1e-10 && lemke.is_solved() {
                        let size = expected.u.iter().fold(1.0_f64, |max, u| max.max(u.abs()));
                        for (a, b) in state.u.iter().zip(&expected.u) {
                            prop_assert!((a - b).abs() <= 1e-9 * size, "{} {}", a, b);
                        }
                    }
                } else {
                    prop_assert!(solution.is_solved() || solution.status == Status::Stalled,
                        "{:?}", solution);
                }
            }
        }
    }
}

#[test]
fn the_bias_of_springs_is_of_their_order_and_is_removed() {
    for mu in [0.0, 0.3] {
        let pile = pile(7, mu);
        let exact = solved_contact(&pile, &PRIMAL);
        let solver = QuadraticProgram::new(settings());
        let error = |state: &ContactState| {
            let forces = state.t_n.iter().zip(&exact.t_n).map(|(a, b)| (a - b).abs());
            forces.fold(0.0, f64::max)
        };
        let mut last: Option<(f64, f64)> = None;
        for epsilon in [1e-3, 1e-4, 1e-5, 1e-6] {
            let soft = solver.solve_soft(&pile, epsilon).unwrap();
            assert_eq!(soft.status, Status::Solved);
            assert!(
                soft.with_springs.worst() <= 1e-12 && soft.without_springs.worst() > 1e-2 * epsilon
            );
            let (share, bias) = (soft.spring_share, error(&soft.state));
            if let Some((share_before, bias_before)) = last {
                assert!((7.0..13.0).contains(&(share_before / share)), "{share_before} {share}");
                assert!((7.0..13.0).contains(&(bias_before / bias)), "{bias_before} {bias}");
            }
            last = Some((share, bias));
            let distance = soft.state.u.iter().zip(&exact.u).map(|(a, b)| (a - b).abs());
            let (distance, size) = (
                distance.fold(0.0, f64::max),
                exact.u.iter().fold(0.0_f64, |max, u| max.max(u.abs())),
            );
            let estimate = soft.displacement_error * size;
            if mu <= 0.0 {
                assert!((0.3..3.0).contains(&(estimate / distance)), "{estimate} {distance}");
            }
        }
        let soft = Some(SoftConstraints { epsilon: 1e-2, max_recentrings: 60 });
        let (state, solution) =
            solve_contact(&pile, QuadraticProgramSettings { soft, ..settings() });
        assert!(solution.is_solved(), "{solution:?}");
        assert!(solution.info.iterations > 2, "{:?}", solution.info);
        assert!(error(&state) <= 1e-9, "{}", error(&state));
        if mu <= 0.0 {
            for (a, b) in state.u.iter().zip(&exact.u) {
                assert!((a - b).abs() <= 1e-9, "{a} {b}");
            }
        }
    }
}

/// A body on an incline without friction and without a stop slides away.
#[test]
fn springs_do_not_make_an_equilibrium() {
    let (sin, cos) = 0.3_f64.sin_cos();
    let rows = (mat![[-sin, cos]], mat![[cos, sin]]);
    let incline =
        contact((Mat::zeros(2, 2), vec![0.0, -1.0]), rows, (vec![0.0], vec![0.0]), vec![0.0]);
    let solver = QuadraticProgram::new(settings());
    for epsilon in [1e-2, 1e-4, 1e-6] {
        let soft = solver.solve_soft(&incline, epsilon).unwrap();
        assert_eq!(soft.status, Status::Solved);
        assert!((soft.spring_share - sin).abs() < 1e-3, "{}", soft.spring_share);
    }
    let soft = Some(SoftConstraints { epsilon: 1e-3, max_recentrings: 30 });
    let (_, solution) = solve_contact(&incline, QuadraticProgramSettings { soft, ..settings() });
    assert_eq!(solution.status, Status::Infeasible);
    assert_proof(&incline.to_general(), &solution);
    let history = &solution.info.history;
    assert!(history.last().unwrap() > &0.1 && history.len() > 5, "{history:?}");
}

proptest! {
    #![proptest_config(cases(48))]

    /// Structures that are not held: what is solved is not proved infeasible by the other method.
    #[test]
    fn floating_contacts_do_not_contradict_lemke(
        (n, c, k, v, mu) in (2..=7_usize).prop_flat_map(|n| {
            (Just(n), vec(-2..=2_i8, 6 * n), vec(-2..=2_i8, n), vec(-2..=2_i8, n + 6), 0..3_u8)
        })
    ) {
        let m = 3;
        let real = |v: Vec<i8>| v.into_iter().map(f64::from).collect::<Vec<_>>();
        let (c, k, v) = (real(c), gram(&real(k), n, 1), real(v));
        let rows = |first: usize| Mat::from_fn(m, n, |i, j| c[first + i * n + j]);
        let x_0 = v[n..n + m].iter().map(|x| x.abs()).collect();
        let offsets = (x_0, v[n + m..].to_vec());
        let problem = contact(
            (k, v[..n].to_vec()), (rows(0), rows(m * n)), offsets, vec![0.5 * f64::from(mu); m],
        );
        let lemke = Solver::<Contact2d>::solve(&Lemke::default(), &problem).unwrap().status;
        for tolerance in TOLERANCES {
            let (_, solution) =
                solve_contact(&problem, QuadraticProgramSettings { tolerance, ..settings() });
            match solution.status {
                Status::Solved => prop_assert!(lemke != Status::Infeasible, "{:?}", solution),
                Status::Infeasible => {
                    prop_assert!(lemke != Status::Solved);
                    assert_proof(&problem.to_general(), &solution);
                }
                _ => prop_assert!(mu > 0, "{:?}", solution),
            }
            if mu == 0 {
                prop_assert_eq!(solution.is_solved(), lemke == Status::Solved);
            }
        }
    }

    #[test]
    fn order_does_not_matter(lcp in symmetric_lcp(true), seed in 0..1000_usize) {
        let (m, n) = (lcp.m().to_dense(), lcp.order());
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by_key(|i| (i * 7919 + seed) % 101);
        let permuted = Lcp::new(
            Mat::from_fn(n, n, |i, j| m[(order[i], order[j])]),
            order.iter().map(|&i| lcp.q()[i]).collect(),
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

/// Friction would have to hold the body, but its spring keeps it away from the wall: there is no
/// solution, although equilibrium alone is possible.
#[test]
fn a_fixed_point_that_is_none_is_reported() {
    let k = mat![[4.0, 0.0], [0.0, 0.0]];
    let rows = (mat![[1.0, 0.0]], mat![[0.0, 1.0]]);
    let problem = contact((k, vec![0.0, 0.5]), rows, (vec![1.0], vec![0.0]), vec![0.5]);
    let (_, solution) = solve_contact(&problem, settings());
    assert_eq!(solution.status, Status::Stalled, "{solution:?}");
    let history = &solution.info.history;
    assert!(history.len() > 10 && history.iter().all(|r| *r > 1e-2), "{history:?}");
    assert!(solution.farkas.is_none());
    assert!(solution.t.iter().chain(&solution.y).all(|v| v.is_finite()));

    let few = QuadraticProgramSettings { max_outer: 3, ..settings() };
    let (_, solution) = solve_contact(&problem, few);
    assert_eq!(solution.status, Status::IterationLimit, "{solution:?}");
    assert_eq!(solution.info.iterations, 3);
}

#[test]
fn limits_and_observers_end_a_solve() {
    let late = QuadraticProgramSettings { time_limit: Some(Duration::ZERO), ..settings() };
    let (state, solution) = solve_contact(&pile(5, 0.3), late.clone());
    assert_eq!(solution.status, Status::TimeLimit);
    assert!(state.u.iter().all(|u| u.is_finite()));
    let lcp = families::obstacle(4).problem;
    let solution = QuadraticProgram::new(late).solve(&lcp).unwrap();
    assert_eq!(solution.status, Status::TimeLimit);
    let stop = &mut |_: &lcp::Iteration| ControlFlow::Break(());
    let solver = QuadraticProgram::new(settings());
    assert_eq!(solver.solve_observed(&lcp, stop).unwrap().status, Status::Cancelled);
    let solution = solver.solve_contact_observed(&pile(5, 0.3), stop).unwrap();
    assert_eq!(solution.status, Status::Cancelled);
    let short = QuadraticProgramSettings { max_iterations: 1, ..settings() };
    let solution = QuadraticProgram::new(short).solve(&families::obstacle(6).problem).unwrap();
    assert!(solution.is_solved() || solution.status == Status::IterationLimit);
}

#[test]
fn the_dual_form_needs_a_stiffness() {
    let dual = QuadraticProgramSettings { form: ContactForm::Dual, ..settings() };
    match QuadraticProgram::new(dual).solve(&pile(3, 0.0)) {
        Err(Error::NotTreated { reason, .. }) => assert!(reason.contains("primal"), "{reason}"),
        other => panic!("{other:?}"),
    }
}

/// An elastic bar that slides down an incline: far down, what holds it is small against the forces that
/// its displacements would cause if they were not rigid.
#[test]
fn a_body_far_away_is_not_taken_for_one_at_rest() {
    let mut k = Mat::zeros(4, 4);
    (k[(1, 1)], k[(1, 3)], k[(3, 1)], k[(3, 3)]) = (100.0, -100.0, -100.0, 100.0);
    let rows = |first: usize| Mat::from_fn(2, 4, |i, j| f64::from(u8::from(j == 2 * i + first)));
    let f = vec![-1.0, 0.3, -1.0, 0.3];
    let bar = contact((k, f), (rows(0), rows(1)), (vec![0.0; 2], vec![0.0; 2]), vec![0.0; 2]);
    let soft = SoftConstraints { epsilon: 1e-6, max_recentrings: 40 };
    for soft in [None, Some(soft)] {
        for tolerance in [1e-2, 1e-4, 1e-8] {
            let settings = QuadraticProgramSettings { tolerance, soft, ..settings() };
            let (_, solution) = solve_contact(&bar, settings);
            assert_eq!(solution.status, Status::Infeasible, "{solution:?}");
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
    assert!(solution.is_solved() && solution.y[1] == 3.0);
    let none = Mat::zeros(0, 2);
    let k = mat![[2.0, 1.0], [1.0, 2.0]];
    let body = contact((k, vec![3.0, 3.0]), (none.clone(), none), (vec![], vec![]), vec![]);
    let (state, solution) = solve_contact(&body, settings());
    assert!(solution.is_solved(), "{solution:?}");
    assert!(near(state.u[0], 1.0) && near(state.u[1], 1.0));
}
