//! The method on contact problems with friction: closed forms, other methods, units, starts, limits.

use std::ops::ControlFlow;
use std::time::Duration;

use faer::{Mat, mat};
use lcp::{
    Contact2d, ContactState, Error, InteriorPoint, SemismoothNewton, SemismoothNewtonSettings,
    Solution, Solver, Status, WarmStart,
};
use proptest::prelude::*;

use super::bodies::{in_units, problems};
use super::common;

fn settings() -> SemismoothNewtonSettings {
    SemismoothNewtonSettings::default()
}

fn by(problem: &Contact2d, settings: SemismoothNewtonSettings) -> Solution<Contact2d> {
    SemismoothNewton::new(settings).solve(problem).unwrap()
}

/// The state of an exact solution, whose basis and whose point lead to it again without a step.
fn state(problem: &Contact2d) -> ContactState {
    let solution = by(problem, settings());
    assert!(solution.is_solved(), "{:?}: {:?}", solution.status, solution.residuals);
    assert!(solution.residuals.worst() < 1e-13, "{:?}", solution.residuals);
    assert_eq!(solution.info.history.len(), solution.info.iterations + 1);
    let basis = WarmStart::Basis(solution.basis.clone().unwrap());
    let point = WarmStart::Point { t: solution.t.clone(), y: solution.y.clone() };
    for start in [basis, point] {
        let again = by(problem, SemismoothNewtonSettings { start, ..settings() });
        assert!(again.is_solved() && again.info.iterations == 0, "{:?}", again.status);
    }
    problem.recover(&solution.t, &solution.y)
}

fn assert_close(found: &[f64], expected: &[f64]) {
    let size = expected.iter().fold(1.0_f64, |max, v| max.max(v.abs()));
    let is_close = found.len() == expected.len()
        && found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-12 * size);
    assert!(is_close, "{found:?} instead of {expected:?}");
}

/// A body of two displacements under a load, with springs of this stiffness, on planes through the origin.
fn body(stiffness: f64, load: [f64; 2], normals: &[[f64; 2]], mu: f64) -> Contact2d {
    let m = normals.len();
    let c_n = Mat::from_fn(m, 2, |i, j| normals[i][j]);
    let c_t = Mat::from_fn(m, 2, |i, j| [-normals[i][1], normals[i][0]][j]);
    let k = mat![[stiffness, 0.0], [0.0, stiffness]];
    let zero = vec![0.0; m];
    Contact2d::new(k, load.to_vec(), c_n, c_t, zero.clone(), zero, vec![mu; m]).unwrap()
}

#[test]
fn a_block_on_a_plane_sticks_slides_or_leaves() {
    let on_plane = |push: f64, lift: f64| body(2.0, [push, lift], &[[0.0, 1.0]], 0.5);
    for (push, force, way) in
        [(0.0, 0.0, 0.0), (3.0, 3.0, 0.0), (9.0, 5.0, 2.0), (-9.0, -5.0, -2.0)]
    {
        let ContactState { u, t_n, t_t, gap, slip, .. } = state(&on_plane(push, -10.0));
        // The tangent points to the left.
        assert_close(&[t_n[0], t_t[0], u[0], slip[0], gap[0]], &[10.0, force, way, -way, 0.0]);
    }
    let ContactState { u, t_n, gap, .. } = state(&on_plane(1.0, 4.0));
    assert_close(&[u[0], u[1], t_n[0], gap[0]], &[0.5, 2.0, 0.0, 2.0]);
}

/// Nothing but contacts holds it: it stands up to the limit of friction, and beyond no answer is made up.
#[test]
fn a_rigid_block_stands_up_to_the_friction_and_not_beyond() {
    let rigid = |push: f64| body(0.0, [push, -10.0], &[[0.0, 1.0]], 0.5);
    for push in [0.0, 4.9, -4.9, 5.0 * (1.0 - 1e-6)] {
        let ContactState { t_n, t_t, u, .. } = state(&rigid(push));
        assert_close(&[t_n[0], t_t[0], u[0], u[1]], &[10.0, push, 0.0, 0.0]);
    }
    for push in [5.0 * (1.0 + 1e-6), 6.0, -50.0] {
        let solution = by(&rigid(push), settings());
        assert_eq!(solution.status, Status::Stalled);
        assert!(solution.t.iter().chain(&solution.y).all(|v| v.is_finite()));
    }
    assert_eq!(by(&body(0.0, [0.0, 3.0], &[[0.0, 1.0]], 0.5), settings()).status, Status::Stalled);
}

#[test]
fn a_wedge_is_held_by_two_planes() {
    let (first, second) = (0.3_f64, 0.8_f64);
    let normals = [[first.sin(), first.cos()], [-second.sin(), second.cos()]];
    let part = 10.0 / (first + second).sin();
    for stiffness in [2.0, 0.0] {
        let ContactState { t_n, u, .. } = state(&body(stiffness, [0.0, -10.0], &normals, 0.0));
        assert_close(&t_n, &[part * second.sin(), part * first.sin()]);
        assert_close(&u, &[0.0, 0.0]);
    }
}

/// A rigid beam on more supports than it needs: the forces are not unique, their resultants are.
#[test]
fn a_beam_on_many_supports_is_carried() {
    let m = 40;
    let at = |i: usize| i as f64 - 19.5;
    let c_n = Mat::from_fn(m, 3, |i, j| [0.0, 1.0, at(i)][j]);
    let c_t = Mat::from_fn(m, 3, |_, j| [-1.0, 0.0, 0.0][j]);
    let (zero, mu) = (vec![0.0; m], vec![0.5; m]);
    let load = vec![3.0, -70.0, 35.0];
    let problem = Contact2d::new(Mat::zeros(3, 3), load, c_n, c_t, zero.clone(), zero, mu).unwrap();
    let ContactState { t_n, t_t, .. } = state(&problem);
    let moment: f64 = t_n.iter().enumerate().map(|(i, t)| t * at(i)).sum();
    assert_close(&[t_n.iter().sum(), t_t.iter().sum(), moment], &[70.0, 3.0, -35.0]);
}

/// Two bodies far from the floor, one below the other: both fall, with nothing but springs to stop them, and the
/// upper one lands on the lower.
#[test]
fn bodies_land_on_each_other_across_gaps() {
    let k = mat![[1e-3, 0.0], [0.0, 0.0]];
    let c_n = mat![[1.0, 0.0], [-1.0, 1.0]];
    let c_t = mat![[0.0, 0.0], [0.0, 0.0]];
    let (gaps, none) = (vec![1e4, 1e2], vec![0.0; 2]);
    let problem = Contact2d::new(k, vec![-5.0, -7.0], c_n, c_t, gaps, none.clone(), none).unwrap();
    let ContactState { u, t_n, .. } = state(&problem);
    assert_close(&u, &[-1e4, -1.01e4]);
    assert_close(&t_n, &[2.0, 7.0]);
}

#[test]
fn limits_are_kept() {
    let problem = body(2.0, [9.0, -10.0], &[[0.0, 1.0]], 0.5);
    let none = SemismoothNewtonSettings { max_iterations: 0, ..settings() };
    assert_eq!(by(&problem, none).status, Status::IterationLimit);
    let late = SemismoothNewtonSettings { time_limit: Some(Duration::ZERO), ..settings() };
    assert_eq!(by(&problem, late).status, Status::TimeLimit);
    let solver = SemismoothNewton::default();
    let solution = solver.solve_observed(&problem, &mut |_| ControlFlow::Break(())).unwrap();
    assert_eq!(solution.status, Status::Cancelled);
    let wrong = SemismoothNewtonSettings { tolerance: 0.0, ..settings() };
    let error = Solver::<Contact2d>::solve(&SemismoothNewton::new(wrong), &problem).unwrap_err();
    assert!(matches!(error, Error::Setting { name: "tolerance", .. }), "{error}");
}

/// Rows and points in the opposite order.
fn reversed(problem: &Contact2d) -> Contact2d {
    let (n, m) = (problem.displacements(), problem.points());
    let [k, c_n, c_t] = [problem.stiffness(), problem.normal(), problem.tangent()]
        .map(faer::sparse::SparseColMat::to_dense);
    let back = |v: &[f64]| v.iter().rev().copied().collect::<Vec<f64>>();
    Contact2d::new(
        Mat::from_fn(n, n, |i, j| k[(n - 1 - i, n - 1 - j)]),
        back(problem.loads()),
        Mat::from_fn(m, n, |i, j| c_n[(m - 1 - i, n - 1 - j)]),
        Mat::from_fn(m, n, |i, j| c_t[(m - 1 - i, n - 1 - j)]),
        back(problem.initial_gaps()),
        back(problem.initial_slips()),
        back(problem.mu()),
    )
    .unwrap()
}

proptest! {
    #![proptest_config(common::cases(256))]

    /// Gaps that are not negative and a regular stiffness: there is a solution, without friction only one,
    /// with it maybe several.
    #[test]
    fn elastic_bodies_are_solved(problem in problems()) {
        let solution = by(&problem, settings());
        prop_assert!(solution.is_solved(), "{:?}", solution.status);
        let found = problem.recover(&solution.t, &solution.y);
        prop_assert!(problem.residuals(&found).worst() <= 1e-10);
        if problem.frictional().is_empty() {
            let interior = InteriorPoint::default().solve(&problem).unwrap();
            prop_assert!(interior.is_solved());
            assert_close(&found.u, &problem.recover(&interior.t, &interior.y).u);
        }
    }

    #[test]
    fn neither_units_nor_order_matter(
        problem in problems(),
        (force, length) in (-30..30i32, -30..30i32),
    ) {
        let (force, length) = (f64::from(force).exp2(), f64::from(length).exp2());
        let unit = vec![1.0; problem.displacements()];
        let first = by(&problem, settings());
        let second = by(&in_units(&problem, force, length, &unit), settings());
        prop_assert_eq!(first.status, second.status);
        prop_assert_eq!(first.info.factorisations, second.info.factorisations);
        let back: Vec<f64> = second.t.iter().map(|t| t / length).collect();
        let n = problem.displacements();
        assert_close(&back[..n], &first.t[..n]);
        let third = by(&reversed(&problem), settings());
        prop_assert_eq!(first.status, third.status);
        if problem.frictional().is_empty() {
            let mut u = reversed(&problem).recover(&third.t, &third.y).u;
            u.reverse();
            assert_close(&u, &problem.recover(&first.t, &first.y).u);
        }
    }
}
