//! Parametric problems: every point of the path solves its problem, and the path is the one that
//! separate solves find.

use crate::common;

use common::cases;
use faer::{Mat, mat};
use lcp::lemke::{Parametric, ParametricEnd, ParametricPath, ParametricSettings};
use lcp::{HorizontalLcp, Lcp, Lemke, Solver, Status};
use proptest::collection::vec;
use proptest::prelude::*;

fn lcp(m: Mat<f64>, q: &[f64]) -> HorizontalLcp {
    Lcp::new(m, q.to_vec()).unwrap().into()
}

fn trace(problem: &HorizontalLcp, c1: &[f64], from: f64, to: f64) -> ParametricPath {
    Parametric::default().trace(problem, c1, from, to).unwrap()
}

fn lambdas(path: &ParametricPath) -> Vec<f64> {
    path.breakpoints.iter().map(|it| it.lambda).collect()
}

/// Two coupled contacts with gaps 1 and 3, on which a load presses.
#[test]
fn gaps_close_one_after_the_other() {
    let problem = lcp(mat![[2.0, 1.0], [1.0, 2.0]], &[1.0, 3.0]);
    let path = trace(&problem, &[-1.0, -1.0], 0.0, 10.0);
    assert_eq!(path.end, ParametricEnd::Reached);
    // z1 = (lambda - 1) / 2 closes the first; the second gap is 3 - lambda + z1 = 0 at lambda = 5.
    assert_eq!(lambdas(&path), [0.0, 1.0, 5.0, 10.0]);
    assert_eq!(path.breakpoints[2].t, [2.0, 0.0]);
    assert_eq!(path.bases.len(), 3);
    // At 10: 2 z1 + z2 = 9 and z1 + 2 z2 = 7.
    let last = &path.breakpoints[3].t;
    assert!((last[0] - 11.0 / 3.0).abs() < 1e-14 && (last[1] - 5.0 / 3.0).abs() < 1e-14);
}

/// `w = -z + 1 - lambda`: from `z = 0`, `w = 1 - lambda` the path turns at 1 and comes back with
/// `z = 1 - lambda`.
#[test]
fn a_path_turns_where_the_problem_is_not_monotone() {
    let problem = lcp(mat![[-1.0]], &[1.0]);
    let path = trace(&problem, &[-1.0], 0.0, 2.0);
    assert_eq!(path.end, ParametricEnd::TurnedBack);
    assert_eq!(lambdas(&path), [0.0, 1.0, 0.0]);
    let found = path.solutions_at(0.5);
    assert_eq!(found.iter().map(|it| it.t[0]).collect::<Vec<_>>(), [0.0, 0.5]);
    assert!(path.solutions_at(1.5).is_empty());
}

/// `M = 0`: at `lambda = 1` the gap `1 - lambda` is closed, and no force opens it again.
#[test]
fn a_path_ends_on_a_ray() {
    let problem = lcp(mat![[0.0, 0.0], [0.0, 1.0]], &[1.0, 1.0]);
    let path = trace(&problem, &[-1.0, 0.0], 0.0, 2.0);
    assert_eq!(path.end, ParametricEnd::Ray);
    assert_eq!(lambdas(&path), [0.0, 1.0]);
    let ray = path.ray.unwrap();
    assert!(ray.dlambda == 0.0 && ray.dt[0] > 0.0 && ray.dt[1] == 0.0 && ray.dy == [0.0, 0.0]);
}

/// To infinity: after the last breakpoint the solution grows with the parameter.
#[test]
fn infinity_is_a_last_value() {
    let problem = lcp(mat![[2.0]], &[1.0]);
    let path = trace(&problem, &[-1.0], 0.0, f64::INFINITY);
    assert_eq!((path.end, lambdas(&path)), (ParametricEnd::Ray, vec![0.0, 1.0]));
    let ray = path.ray.unwrap();
    assert!((ray.dt[0] / ray.dlambda - 0.5).abs() < 1e-15);
}

#[test]
fn what_stops_a_trace_is_said() {
    let infeasible = lcp(mat![[0.0]], &[-1.0]);
    let path = trace(&infeasible, &[1.0], 0.0, 2.0);
    assert_eq!(path.end, ParametricEnd::NoStart(Status::Infeasible));
    let problem = lcp(mat![[2.0, 1.0], [1.0, 2.0]], &[1.0, 3.0]);
    let settings = ParametricSettings { max_breakpoints: Some(2), ..ParametricSettings::default() };
    let path = Parametric::new(settings).trace(&problem, &[-1.0, -1.0], 0.0, 10.0).unwrap();
    assert_eq!((path.end, path.breakpoints.len()), (ParametricEnd::BreakpointLimit, 3));
    assert!(Parametric::default().trace(&problem, &[1.0], 0.0, 1.0).is_err());
    assert!(Parametric::default().trace(&problem, &[1.0, 1.0], f64::NAN, 1.0).is_err());
}

/// `M = C C^T + 1` with small integers, so that several pairs change at the same value too.
fn positive_definite() -> impl Strategy<Value = (Mat<f64>, Vec<f64>, Vec<f64>)> {
    let integer = || (-3..=3_i8).prop_map(f64::from);
    (1..9_usize).prop_flat_map(move |n| {
        (vec(integer(), n * n), vec(integer(), n), vec(integer(), n)).prop_map(
            move |(c, q, rate)| {
                let c = Mat::from_fn(n, n, |i, j| c[i * n + j]);
                (&c * c.transpose() + Mat::<f64>::identity(n, n), q, rate)
            },
        )
    })
}

proptest! {
    #![proptest_config(cases(256))]

    /// The path of a positive definite problem is the graph of its unique solutions, whichever way
    /// and in whatever units it is traced.
    #[test]
    fn the_path_is_the_graph_of_the_solutions(
        (m, q, rate) in positive_definite(), backwards in any::<bool>(), exponent in -6..=6_i32,
    ) {
        let problem = lcp(m, &q);
        let unit = 10.0_f64.powi(exponent);
        let scaled: Vec<f64> = rate.iter().map(|rate| rate / unit).collect();
        let (from, to) = if backwards { (2.0, -1.0) } else { (-1.0, 2.0) };
        let path = trace(&problem, &scaled, from * unit, to * unit);
        prop_assert_eq!(path.end, ParametricEnd::Reached);
        prop_assert!(path.residual <= 1e-10);
        prop_assert_eq!(path.bases.len() + 1, path.breakpoints.len());
        let steps = path.breakpoints.windows(2).map(|pair| (pair[1].lambda - pair[0].lambda) * (to - from));
        prop_assert!(steps.into_iter().all(|step| step > 0.0), "{:?}", lambdas(&path));
        for lambda in [-1.0, -0.3, 0.0, 0.7, 1.0, 1.9] {
            let c = q.iter().zip(&rate).map(|(q, rate)| q + lambda * rate).collect();
            let direct = Lemke::default().solve(&problem.with_right_hand_side(c).unwrap()).unwrap();
            let found = path.solutions_at(lambda * unit);
            prop_assert!(!found.is_empty());
            let size = 1.0 + direct.t.iter().fold(0.0_f64, |max, t| max.max(t.abs()));
            for point in found {
                let error = point.t.iter().zip(&direct.t).map(|(a, b)| (a - b).abs());
                prop_assert!(error.fold(0.0, f64::max) <= 1e-9 * size);
            }
        }
    }

    /// Whatever the matrix: every breakpoint solves its problem.
    #[test]
    fn every_breakpoint_is_a_solution(
        (n, m, q, rate) in (1..6_usize).prop_flat_map(|n| {
            let integer = || (-2..=2_i8).prop_map(f64::from);
            (Just(n), vec(integer(), n * n), vec(integer(), n), vec(integer(), n))
        })
    ) {
        let problem = lcp(Mat::from_fn(n, n, |i, j| m[i * n + j]), &q);
        let path = trace(&problem, &rate, 0.0, 1.0);
        for point in &path.breakpoints {
            prop_assert!(point.t.iter().zip(&point.y).all(|(&t, &y)| t >= 0.0 && y >= 0.0 && t * y == 0.0));
            for i in 0..n {
                let row = (0..n).map(|j| m[i * n + j] * point.t[j]).chain([q[i], point.lambda * rate[i], -point.y[i]]);
                let (sum, size) = row.fold((0.0, 0.0), |(sum, size), v: f64| (sum + v, size + v.abs()));
                // The data are integers; a row that vanishes is measured by them.
                prop_assert!(f64::abs(sum) <= 1e-9 * size.max(1e-3), "row {}: {} of {}", i, sum, size);
            }
        }
        if path.end == ParametricEnd::Ray {
            prop_assert!(path.ray.is_some());
        }
    }
}
