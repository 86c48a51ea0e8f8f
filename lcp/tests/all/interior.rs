//! The interior-point method: closed forms, families with known answers, limits, and what has no solution.

mod beams;
use crate::common;
use crate::common::bodies;
mod falls;
mod least_size;
mod properties;

use std::ops::ControlFlow;
use std::time::Duration;

use faer::{Mat, mat};
use lcp::{
    Auto, AutoSettings, Basis, Contact2d, ContactState, Error, HorizontalLcp, InteriorPoint,
    InteriorPointSettings, Lcp, Lemke, Method, MixedLcp, Side, Solution, Solver, SplitMix, Status,
    WarmStart,
};
use lcp_problems::families::{self, Ground, KnownAnswer, Obstacle};

fn default() -> InteriorPointSettings {
    InteriorPointSettings::default()
}

fn solve(problem: &Contact2d) -> Solution<Contact2d> {
    InteriorPoint::default().solve(problem).unwrap()
}

/// The state of an exact solution, whose basis leads to it again without a step.
fn state(problem: &Contact2d) -> ContactState {
    let solution = solve(problem);
    assert!(solution.is_solved(), "{:?}: {:?}", solution.status, solution.residuals);
    assert!(solution.residuals.worst() < 1e-13, "{:?}", solution.residuals);
    let start = WarmStart::Basis(solution.basis.clone().expect("a basis"));
    let again = InteriorPoint::new(InteriorPointSettings { start, ..default() });
    let again = again.solve(problem).unwrap();
    assert!(again.is_solved() && again.info.iterations == 0, "{:?}", again.status);
    problem.recover(&solution.t, &solution.y)
}

fn assert_close(found: &[f64], expected: &[f64]) {
    let size = expected.iter().fold(1.0_f64, |max, v| max.max(v.abs()));
    let is_close = found.len() == expected.len()
        && found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-12 * size);
    assert!(is_close, "{found:?} instead of {expected:?}");
}

/// A body of two displacements under a load, with springs of this stiffness, on planes through the origin.
fn body(stiffness: [f64; 2], load: [f64; 2], normals: &[[f64; 2]], mu: f64) -> Contact2d {
    let m = normals.len();
    let c_n = Mat::from_fn(m, 2, |i, j| normals[i][j]);
    let c_t = Mat::from_fn(m, 2, |i, j| [-normals[i][1], normals[i][0]][j]);
    let k = mat![[stiffness[0], 0.0], [0.0, stiffness[1]]];
    let zero = vec![0.0; m];
    Contact2d::new(k, load.to_vec(), c_n, c_t, zero.clone(), zero, vec![mu; m]).unwrap()
}

#[test]
fn a_block_on_a_plane_sticks_slides_or_leaves() {
    let on_plane = |push: f64, lift: f64| body([2.0, 2.0], [push, lift], &[[0.0, 1.0]], 0.5);
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

/// Just below and just above the force at which a rigid block without springs begins to slide.
#[test]
fn a_rigid_block_stands_up_to_the_friction_and_not_beyond() {
    let rigid = |push: f64| body([0.0, 0.0], [push, -10.0], &[[0.0, 1.0]], 0.5);
    for push in [0.0, 4.9, -4.9, 5.0 * (1.0 - 1e-6)] {
        let ContactState { t_n, t_t, .. } = state(&rigid(push));
        assert_close(&[t_n[0], t_t[0]], &[10.0, push]);
    }
    for push in [5.0 * (1.0 + 1e-2), 6.0, -50.0] {
        let solution = solve(&rigid(push));
        assert_eq!(solution.status, Status::Infeasible);
        // The proof is a motion on which the load does work that friction does not take.
        let motion = solution.farkas().expect("the proof");
        assert!(motion[0] * push > 0.0, "{motion:?}");
        assert!(solution.certificate.as_ref().unwrap().holds(&rigid(push).to_general()));
    }
}

/// On two feet, of which the start says that the left one is in the air: as it closes it goes on sliding with
/// the other one, and is not taken back to where it began.
#[test]
fn a_foot_that_closes_goes_on_sliding() {
    let k = mat![[1e-4, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let c_n = mat![[0.0, 1.0, -1.0], [0.0, 1.0, 1.0]];
    let c_t = mat![[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let none = vec![0.0; 2];
    let load = vec![7.0, -10.0, 0.0];
    let problem = Contact2d::new(k, load, c_n, c_t, none.clone(), none, vec![0.5; 2]).unwrap();
    // Pairs of displacements, gaps, slips forwards and backwards.
    let (t, y) = (Side::T, Side::Y);
    let start = WarmStart::Basis(Basis::new(vec![y, t, t, y, t, y, y, t, t]));
    let settings = InteriorPointSettings { start, ..default() };
    let solution = InteriorPoint::new(settings).solve(&problem).unwrap();
    assert!(solution.is_solved() && solution.info.iterations == 0, "{:?}", solution.status);
    assert_eq!(solution.info.factorisations, 2);
    let ContactState { u, t_n, t_t, .. } = problem.recover(&solution.t, &solution.y);
    assert_close(&u, &[2e4, 0.0, 0.0]);
    assert_close(&[t_n[0], t_n[1], t_t[0], t_t[1]], &[5.0, 5.0, -2.5, -2.5]);
}

#[test]
fn a_body_that_nothing_holds_falls() {
    let solution = solve(&body([0.0, 0.0], [0.0, 3.0], &[[0.0, 1.0]], 0.5));
    assert_eq!(solution.status, Status::Infeasible);
    assert!(solution.farkas().is_some_and(|motion| motion[1] > 0.0));
    let without = InteriorPointSettings { prove_infeasible: false, ..default() };
    let falling = body([0.0, 0.0], [6.0, -10.0], &[[0.0, 1.0]], 0.5);
    let solution = InteriorPoint::new(without).solve(&falling).unwrap();
    assert_eq!(solution.status, Status::Stalled);
    assert!(solution.certificate.is_none());
}

#[test]
fn a_wedge_is_held_by_two_planes() {
    let (first, second) = (0.3_f64, 0.8_f64);
    let normals = [[first.sin(), first.cos()], [-second.sin(), second.cos()]];
    let part = 10.0 / (first + second).sin();
    for stiffness in [[2.0, 2.0], [0.0, 0.0]] {
        let ContactState { t_n, u, .. } = state(&body(stiffness, [0.0, -10.0], &normals, 0.0));
        assert_close(&t_n, &[part * second.sin(), part * first.sin()]);
        assert_close(&u, &[0.0, 0.0]);
        let ContactState { u, .. } = state(&body(stiffness, [0.0, -10.0], &normals, 0.5));
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
    let moment: f64 = t_n.iter().enumerate().map(|(i, t)| at(i) * t).sum();
    let (sum, friction): (f64, f64) = (t_n.iter().sum(), t_t.iter().sum());
    assert_close(&[sum, moment, friction], &[70.0, -35.0, 3.0]);
}

/// A surface that moves on drags the body into a wall, and its friction pushes it back no further: there is
/// no solution, which must not be called one.
#[test]
fn a_driven_body_may_jam() {
    let one = |v: f64| mat![[v]];
    let problem =
        Contact2d::new(one(1.0), vec![1.0], one(-1.0), one(-2.0), vec![0.0], vec![1.0], vec![0.5]);
    let solution = solve(&problem.unwrap());
    assert!(!solution.is_solved(), "{:?}", solution.residuals);
}

/// Two displacements, one of them soft: it goes far, and does not fall.
#[test]
fn a_soft_body_is_no_body_that_falls() {
    for soft in [0.01, 1e-4, 1e-6] {
        let (k, zero) = (mat![[soft, 0.0], [0.0, 1e6]], vec![0.0; 2]);
        let c_n = mat![[0.0, -1.0], [1.0, -1.0]];
        let c_t = Mat::zeros(2, 2);
        let problem =
            Contact2d::new(k, vec![1.0, 1.0], c_n, c_t, zero.clone(), zero.clone(), zero).unwrap();
        assert_ne!(solve(&problem).status, Status::Infeasible, "{soft}");
    }
}

/// The pivot of a soft displacement is small against those of closed contacts, and does not vanish.
#[test]
fn soft_bodies_next_to_stiff_ones_are_solved() {
    for (soft, stiff) in [(1.0, 1e4), (0.01, 1e6), (1.0, 1e8), (1e-3, 1e6)] {
        let (k, zero) = (mat![[soft, 0.0], [0.0, stiff]], vec![0.0; 2]);
        let c_n = mat![[0.0, -1.0], [1.0, -1.0]];
        let c_t = Mat::zeros(2, 2);
        let problem =
            Contact2d::new(k, vec![1.0, 1.0], c_n, c_t, zero.clone(), zero.clone(), zero).unwrap();
        let ContactState { u, t_n, .. } = state(&problem);
        assert_close(&[u[0] * soft, u[1], t_n[0], t_n[1]], &[1.0, 0.0, 1.0, 0.0]);
    }
}

/// An edge of every cone of friction is orthogonal to one direction, and nothing else holds the body in it.
/// Forces 1e9 times the load would, a rounding error outside of their cones.
#[test]
#[allow(clippy::unreadable_literal, reason = "every digit of these counts, and none is read")]
fn forces_outside_of_their_cones_are_no_solution() {
    let c_n = mat![
        [-0.5981217131583421, -0.7052361320477764],
        [-1.002669793916862, -0.2733128401256528],
        [-0.3835857611240087, 0.0984561396193773],
        [-0.4934509112684303, 1.0872696766222114]
    ];
    let c_t = mat![
        [-0.45876848704111706, -0.15389354002151978],
        [0.716547539717026, -0.8587125148828603],
        [-0.32948464737856487, 0.3125039167323995],
        [0.5422968084938142, -0.8940138451179098]
    ];
    let load = vec![0.08024922294046322, 0.31754162063483177];
    let zero = vec![0.0; 4];
    let problem =
        Contact2d::new(Mat::zeros(2, 2), load, c_n, c_t, zero.clone(), zero, vec![1.0; 4]).unwrap();
    let lemke = Solver::<Contact2d>::solve(&Lemke::default(), &problem).unwrap();
    assert_eq!(lemke.status, Status::Infeasible);
    let solution = solve(&problem);
    assert!(!solution.is_solved(), "{:?}", problem.recover(&solution.t, &solution.y));
}

#[test]
fn standard_problems_with_known_answers_are_solved() {
    for seed in 0..20 {
        for n in [1, 5, 30] {
            let instances = [
                families::positive_definite(n, seed),
                families::positive_semidefinite(n, seed),
                families::harker_pang(n, seed),
                families::ties(n, seed),
            ];
            for instance in instances {
                let solution = InteriorPoint::default().solve(&instance.problem).unwrap();
                assert!(solution.is_solved(), "{n}, {seed}: {:?}", solution.status);
                if let KnownAnswer::Unique { t, y } = instance.known {
                    let size = t.iter().chain(&y).fold(1.0_f64, |max, v| max.max(v.abs()));
                    let pairs = solution.t.iter().zip(&t).chain(solution.y.iter().zip(&y));
                    let error = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    assert!(error < 1e-8 * size, "{n}, {seed}: {error}");
                }
            }
        }
    }
}

#[test]
fn mixed_problems_with_known_answers_are_solved() {
    for seed in 0..20 {
        for n in [2, 5, 30] {
            let problem = families::mixed_monotone(n, seed).problem;
            let solution = InteriorPoint::default().solve(&problem).unwrap();
            assert!(solution.is_solved(), "{n}, {seed}: {:?}", solution.status);
            let (z, w) = problem.recover(&solution.t, &solution.y);
            assert!(problem.residuals(&z, &w).worst() < 1e-10);
        }
    }
}

/// Least costs of quantities `x` with `x_0 + x_1 + x_2 = 1` and `x_2 + 2 x_3 - x_4 = rest`, as data leave it where it should
/// be zero: the second row has nothing in it that the first would feel, and holds exactly only at a vertex.
#[test]
fn rows_of_rounding_errors_hold_at_a_vertex() {
    let rows = [[1.0, 1.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 2.0, -1.0]];
    let mut random = SplitMix::new(5);
    for rest in [3e-17, 1e-16, 7e-20, -4e-17] {
        let mut m = Mat::zeros(7, 7);
        for (i, row) in rows.iter().enumerate() {
            for (j, v) in row.iter().enumerate() {
                (m[(j, 5 + i)], m[(5 + i, j)]) = (-v, *v);
            }
        }
        let mut q: Vec<f64> = (0..5).map(|_| 1.0 + random.next_f64()).collect();
        q.extend([-1.0, -rest]);
        let problem = MixedLcp::new(m, q, (0..7).map(|j| j >= 5).collect::<Vec<_>>()).unwrap();
        let solution = InteriorPoint::default().solve(&problem).unwrap();
        assert!(solution.is_solved(), "{rest}: {:?}", solution.residuals);
        let (x, _) = problem.recover(&solution.t, &solution.y);
        assert!((x[2] + 2.0 * x[3] - x[4] - rest).abs() <= 1e-10 * rest.abs(), "{rest}: {x:?}");
    }
}

/// Residuals are relative to the terms: a point far enough out has small ones.
#[test]
fn infeasible_problems_are_never_called_solved() {
    for seed in 0..40 {
        for n in [4, 12] {
            let problem = families::infeasible_semidefinite(n, seed).problem;
            let solution = InteriorPoint::default().solve(&problem).unwrap();
            assert!(!solution.is_solved(), "{n}, {seed}: {:?}", solution.residuals);
            assert!(solution.t.iter().chain(&solution.y).all(|v| v.is_finite()));
        }
    }
}

/// The obstacle problem in three forms.
#[test]
fn a_membrane_over_an_obstacle() {
    let problem = Obstacle::new(30, 30, Ground::Disc { radius: 0.6 }).problem();
    let route = InteriorPoint::default();
    let solution = route.solve(&problem).unwrap();
    assert!(solution.is_solved() && solution.residuals.worst() < 1e-14);
    let general = HorizontalLcp::from(problem.clone());
    let free = vec![false; problem.order()];
    let mixed = MixedLcp::new(problem.m().clone(), problem.q().to_vec(), free).unwrap();
    for other in [route.solve(&general).unwrap(), route.solve(&mixed).unwrap().of_pairs()] {
        assert!(other.is_solved());
        assert_close(&other.t, &solution.t);
    }
}

#[test]
fn what_is_no_standard_problem_is_refused_with_a_remedy() {
    let a = mat![[1.0, 2.0], [2.0, 1.0]];
    let problem = HorizontalLcp::new(a.clone(), a, vec![1.0, 1.0]).unwrap();
    let error = InteriorPoint::default().solve(&problem).unwrap_err();
    assert!(matches!(error, Error::NotTreated { method: Method::Interior, .. }));
    assert!(error.to_string().contains("take Lemke's method"), "{error}");
}

#[test]
fn limits_are_kept_and_leave_the_best_point() {
    let problem = Obstacle::new(20, 20, Ground::Hills { count: 2 }).problem();
    for openings in [vec![], vec![0.0, -1.0], vec![f64::NAN]] {
        let wrong = InteriorPointSettings { openings, ..default() };
        let error = InteriorPoint::new(wrong).solve(&problem).unwrap_err();
        assert!(matches!(error, Error::Setting { name: "openings", .. }), "{error}");
    }
    let run = |settings| InteriorPoint::new(settings).solve(&problem).unwrap();
    let few = run(InteriorPointSettings { max_iterations: 2, ..default() });
    assert_eq!((few.status, few.info.iterations), (Status::IterationLimit, 2));
    assert!(few.residuals.worst().is_finite() && few.info.history.len() == 3);
    let late = run(InteriorPointSettings { time_limit: Some(Duration::ZERO), ..default() });
    assert_eq!((late.status, late.info.iterations), (Status::TimeLimit, 0));
    let block = body([2.0, 2.0], [9.0, -10.0], &[[0.0, 1.0]], 0.5);
    let cancelled =
        InteriorPoint::default().solve_observed(&block, &mut |_| ControlFlow::Break(()));
    assert_eq!(cancelled.unwrap().status, Status::Cancelled);
}

/// Whatever numbers the start has, they are only tried.
#[test]
fn a_start_beyond_all_bounds_is_as_good_as_none() {
    let problems = [
        body([2.0, 2.0], [9.0, -10.0], &[[0.0, 1.0]], 0.5),
        body([2.0, 2.0], [1e-20, -1e-20], &[[0.0, 1.0], [0.6, 0.8]], 0.0),
        body([0.0, 0.0], [0.0, -1e-20], &[[0.0, 1.0], [0.6, 0.8]], 0.0),
    ];
    for problem in problems {
        for size in [1.0, -1.0, 1e150, 1e300, -1e300, f64::MAX] {
            let order = problem.order();
            let start = WarmStart::Point { t: vec![size; order], y: vec![0.3 * size; order] };
            let settings = InteriorPointSettings { start: start.clone(), ..default() };
            let solution = InteriorPoint::new(settings).solve(&problem).unwrap();
            assert!(solution.is_solved(), "{size}: {:?}", solution.status);
            let auto = Auto::new(AutoSettings { start, ..AutoSettings::default() });
            assert!(auto.solve(&problem).unwrap().is_solved(), "{size}");
        }
    }
    // Forces that overflow where there is no friction.
    let floating = body([0.0, 0.0], [0.0, -0.1], &[[0.0, 0.0], [0.0, 0.0]], 0.0);
    let start = WarmStart::Point { t: vec![f64::MAX; 4], y: vec![0.0; 4] };
    let settings = InteriorPointSettings { start, ..default() };
    let solution = InteriorPoint::new(settings).solve(&floating).unwrap();
    assert!(!solution.is_solved() && solution.t.iter().all(|t| t.is_finite()));
}

#[test]
fn settings_out_of_range_are_errors() {
    let block = body([2.0, 2.0], [9.0, -10.0], &[[0.0, 1.0]], 0.5);
    for tolerance in [0.0, 1.0, f64::NAN] {
        let settings = InteriorPointSettings { tolerance, ..default() };
        let error = InteriorPoint::new(settings).solve(&block).unwrap_err();
        assert!(matches!(error, Error::Setting { name: "tolerance", .. }), "{error}");
    }
    let start = WarmStart::Point { t: vec![0.0; 3], y: vec![0.0; 5] };
    let settings = InteriorPointSettings { start, ..default() };
    let error = InteriorPoint::new(settings).solve(&block).unwrap_err();
    assert!(matches!(error, Error::Length { name: "start.t", len: 3, expected: 5 }), "{error}");
}

/// A standard problem as small as it can be, and one without pairs.
#[test]
fn the_smallest_problems() {
    let route = InteriorPoint::default();
    let one = Lcp::new(mat![[2.0]], vec![-4.0]).unwrap();
    let solution = route.solve(&one).unwrap();
    assert!(solution.is_solved());
    assert_close(&[solution.t[0], solution.y[0]], &[2.0, 0.0]);
    let free = MixedLcp::new(mat![[2.0, 1.0], [1.0, 3.0]], vec![-4.0, 3.0], vec![true; 2]).unwrap();
    let solution = route.solve(&free).unwrap();
    assert!(solution.is_solved(), "{:?}", solution.status);
    assert_close(&free.recover(&solution.t, &solution.y).0, &[3.0, -2.0]);
    let none = Lcp::new(Mat::zeros(0, 0), Vec::new()).unwrap();
    assert!(route.solve(&none).unwrap().is_solved());
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
