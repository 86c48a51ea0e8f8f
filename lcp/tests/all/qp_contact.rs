//! The convex quadratic program on contact problems: closed forms, friction, springs, agreement with
//! Lemke's method.

#![cfg(feature = "clarabel")]
use crate::common;
use crate::common::quadratic;

use std::ops::ControlFlow;
use std::time::Duration;

use common::cases;
use faer::{Mat, mat};
use lcp::qp::SoftConstraints;
use lcp::{
    Contact2d, ContactState, Lemke, LemkeSettings, QuadraticProgram, QuadraticProgramSettings,
    Solution, Solver, Status,
};
use lcp_problems::families;
use proptest::collection::vec;
use proptest::prelude::*;
use quadratic::{TOLERANCES, assert_proof, gram, near, settings};

fn solve_contact(
    contact: &Contact2d,
    settings: QuadraticProgramSettings,
) -> (ContactState, Solution<Contact2d>) {
    let tolerance = settings.tolerance;
    let solution = QuadraticProgram::new(settings).solve(contact).unwrap();
    let state = contact.recover(&solution.t, &solution.y);
    let residuals = contact.residuals(&state);
    if solution.is_solved() {
        assert!(residuals.worst() <= tolerance, "{residuals:?}");
    }
    (state, solution)
}

/// Solved at every tolerance; the state at the last.
fn solved_contact(contact: &Contact2d) -> ContactState {
    let mut last = None;
    for tolerance in TOLERANCES {
        let settings = QuadraticProgramSettings { tolerance, ..Default::default() };
        let (state, solution) = solve_contact(contact, settings);
        assert_eq!(solution.status, Status::Solved, "{tolerance}: {solution:?}");
        last = Some(state);
    }
    last.unwrap()
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
        let state = solved_contact(&block(push, 0.0, 3.0));
        assert!(near(state.t_n[0], 2.0) && near(state.t_t[0], t_t), "{push}: {state:?}");
        assert!(near(state.slip[0], slip), "{push}: {state:?}");
        let state = solved_contact(&block(push, 5.0, 3.0));
        assert!(near(state.t_n[0], 2.0) && near(state.slip[0], slip), "{push}: {state:?}");
    }
}

/// Without a spring behind it the block is held by friction alone, or not at all.
#[test]
fn a_block_that_nothing_holds_is_infeasible() {
    let state = solved_contact(&block(0.9, 0.0, 0.0));
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
        let state = solved_contact(&wedge(angle, weight, 0.0));
        let normal = weight / (2.0 * angle.sin());
        assert!(state.t_n.iter().all(|t| near(t / normal, 1.0)), "{state:?} {normal}");
    }
    // Friction shares the load in many ways: any exact one will do.
    for mu in [0.1, 0.5, 1.0, 3.0] {
        solved_contact(&wedge(0.7, 3.0, mu));
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
        let state = solved_contact(&pile(9, mu));
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
        for tolerance in TOLERANCES {
            let settings = QuadraticProgramSettings { tolerance, ..settings() };
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

#[test]
fn the_bias_of_springs_is_of_their_order_and_is_removed() {
    for mu in [0.0, 0.3] {
        let pile = pile(7, mu);
        let exact = solved_contact(&pile);
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
        let lemke = Lemke::new(LemkeSettings { max_attempts: Some(12), ..LemkeSettings::default() });
        let lemke = Solver::<Contact2d>::solve(&lemke, &problem).unwrap().status;
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
    assert!(solution.certificate.is_none());
    assert!(solution.t.iter().chain(&solution.y).all(|v| v.is_finite()));

    let few = QuadraticProgramSettings { max_outer: 3, ..settings() };
    let (_, solution) = solve_contact(&problem, few);
    assert_eq!(solution.status, Status::IterationLimit, "{solution:?}");
    assert_eq!(solution.info.iterations, 3);
}

/// A point that touches with a force without effect, which only bounds friction: programs may leave it as large as
/// numbers are, and then the two `t` of friction do not tell its force any more.
#[test]
fn normal_forces_without_effect_do_not_hide_friction() {
    for load in [1.0, 2.0, 4.0] {
        let stiffness = mat![[5.0, -5.0], [-5.0, 5.0]];
        let (normal, tangent) = (mat![[0.0, 0.0], [0.0, 0.0]], mat![[0.0, 2.0], [2.0, -1.0]]);
        let zeros = || vec![0.0; 2];
        let contact = Contact2d::new(
            stiffness,
            vec![0.0, load],
            normal,
            tangent,
            zeros(),
            zeros(),
            vec![0.0, 1.0],
        );
        let contact = contact.unwrap();
        let solution = QuadraticProgram::default().solve(&contact).unwrap();
        assert!(solution.is_solved(), "{load}: {}", solution.status);
        let loads = contact.to_general().residuals(&solution.t, &solution.y).loads;
        assert!(loads <= 1e-10, "{loads:e} of {load}: {:?}", solution.t);
    }
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
    let solution = solver.solve_observed(&pile(5, 0.3), stop).unwrap();
    assert_eq!(solution.status, Status::Cancelled);
    let short = QuadraticProgramSettings { max_iterations: 1, ..settings() };
    let solution = QuadraticProgram::new(short).solve(&families::obstacle(6).problem).unwrap();
    assert!(solution.is_solved() || solution.status == Status::IterationLimit);
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

/// Bodies without contacts.
#[test]
fn linear_problems_are_solved() {
    let none = Mat::zeros(0, 2);
    let k = mat![[2.0, 1.0], [1.0, 2.0]];
    let body = contact((k, vec![3.0, 3.0]), (none.clone(), none), (vec![], vec![]), vec![]);
    let (state, solution) = solve_contact(&body, settings());
    assert!(solution.is_solved(), "{solution:?}");
    assert!(near(state.u[0], 1.0) && near(state.u[1], 1.0));
}
