//! The augmented Lagrangian route against closed forms and against interior points.

use std::ops::ControlFlow;
use std::path::Path;

use faer::mat;
use lcp::{Contact2d, InteriorPoint, Solver, Status};
use masonry::forms::Sparse;
use masonry::model::Model;
use masonry::paper::alm::{self, AlmAnswer, AlmError, AlmSettings};
use masonry::scene::Scene;
use masonry::system::System;

fn solve(problem: &Contact2d, tolerance: f64) -> AlmAnswer {
    let settings = AlmSettings { tolerance, ..AlmSettings::default() };
    alm::solve(problem, &settings, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn panel(name: &str) -> Contact2d {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    let scene = Scene::read(&path.with_extension("toml")).unwrap();
    let system = System::new(&Model::from_scene(&scene).unwrap()).unwrap();
    Sparse::new(&system).unwrap().problem
}

/// A body on springs of stiffness 4 above a plane, under a load.
fn body(load: [f64; 2], gap: f64, mu: f64) -> Contact2d {
    let k = mat![[4.0, 0.0], [0.0, 4.0]];
    let (normal, tangent) = (mat![[0.0, 1.0]], mat![[1.0, 0.0]]);
    Contact2d::new(k, load.to_vec(), normal, tangent, vec![gap], vec![0.0], vec![mu]).unwrap()
}

#[test]
fn a_body_sticks_slides_or_leaves() {
    for (load, gap, mu, expected) in [
        // Normal force, friction, displacements.
        ([0.4, -2.0], 0.0, 0.5, [2.0, -0.4, 0.0, 0.0]),
        ([1.4, -2.0], 0.0, 0.5, [2.0, -1.0, 0.1, 0.0]),
        ([-1.4, -2.0], 0.0, 0.5, [2.0, 1.0, -0.1, 0.0]),
        ([1.4, -2.0], 0.0, 0.0, [2.0, 0.0, 0.35, 0.0]),
        // The springs are stretched by the gap before the plane is met.
        ([0.0, -2.0], 0.25, 0.5, [1.0, 0.0, 0.0, -0.25]),
        ([1.0, 2.0], 0.0, 0.5, [0.0, 0.0, 0.25, 0.5]),
    ] {
        let AlmAnswer { status, state, .. } = solve(&body(load, gap, mu), 1e-10);
        assert_eq!(status, Status::Solved);
        let found = [state.t_n[0], state.t_t[0], state.u[0], state.u[1]];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-8, "{load:?}: {found} instead of {expected}");
        }
    }
}

/// Bricks that float, joints that open and slide. What is unique are the forces in the bricks, `K u`.
#[test]
fn panels_as_by_interior_points() {
    for name in ["panel_square", "panel_square_full_floor", "panel_rectangular"] {
        let problem = panel(name);
        let reference = InteriorPoint::default().solve(&problem).unwrap();
        let reference = problem.recover(&reference.t, &reference.y).u;
        let mut iterations = Vec::new();
        for tolerance in [1e-4, 1e-8] {
            let answer = solve(&problem, tolerance);
            assert_eq!(answer.status, Status::Solved, "{name}");
            assert!(answer.residuals.worst() <= tolerance, "{:?}", answer.residuals);
            let last = answer.convergence.last().unwrap();
            assert!(
                last.unbalance.max(last.distance) <= tolerance && last.attempt == 1,
                "{last:?}"
            );
            let (mut error, mut size) = (0.0_f64, 0.0_f64);
            let mut difference = vec![0.0; problem.displacements()];
            let mut forces = difference.clone();
            for entry in problem.stiffness().triplet_iter() {
                let (found, expected) = (answer.state.u[entry.col], reference[entry.col]);
                difference[entry.row] += entry.val * (found - expected);
                forces[entry.row] += entry.val * expected;
            }
            for (difference, force) in difference.iter().zip(&forces) {
                error = error.max(difference.abs());
                size = size.max(force.abs());
            }
            assert!(error < 3.0 * tolerance * size, "{name}: {error} of {size}");
            iterations.push(answer.convergence.len());
            // Far fewer factorisations than iterations: most states are found early.
            assert!(answer.factorisations < answer.convergence.len());
        }
        // Linear convergence: twice the digits cost less than four times the iterations.
        assert!(iterations[1] < 4 * iterations[0], "{name}: {iterations:?}");
    }
}

/// A bar that floats slides against a stop, by hundred times what it is compressed by then; beside it a body
/// rests on a plane. Gaps and slips are as accurate as deformations, not as the way of the bar.
#[test]
fn a_body_that_slides_far_hides_nothing() {
    let (far, tolerance) = (100.0, 1e-8);
    let k = mat![
        [1.0, -1.0, 0.0, 0.0],
        [-1.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 4.0, 0.0],
        [0.0, 0.0, 0.0, 4.0]
    ];
    let normal = mat![[0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let tangent = mat![[0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let loads = vec![1.0, 0.0, 1.4, -2.0];
    let (x_0, s_0, mu) = (vec![far, 0.0], vec![0.0; 2], vec![0.0, 0.5]);
    let problem = Contact2d::new(k, loads, normal, tangent, x_0, s_0, mu).unwrap();
    let AlmAnswer { status, state, .. } = solve(&problem, tolerance);
    assert_eq!(status, Status::Solved);
    let found =
        [state.t_n[0], state.t_n[1], state.t_t[1], state.gap[0], state.gap[1], state.slip[1]];
    for (found, expected) in found.iter().zip([1.0, 2.0, -1.0, 0.0, 0.0, 0.1]) {
        assert!((found - expected).abs() < 3.0 * tolerance, "{found} instead of {expected}");
    }
}

#[test]
fn a_panel_that_falls_is_not_solved() {
    let answer = solve(&panel("panel_no_floor"), 1e-4);
    assert!(matches!(answer.status, Status::Stalled | Status::IterationLimit));
    assert!(answer.state.u.iter().all(|u| u.is_finite()));
}

#[test]
fn units_do_not_matter() {
    let problem = body([1.4, -2.0], 0.0, 0.5);
    let scaled = Contact2d::new(
        mat![[4.0 * 1024.0, 0.0], [0.0, 4.0 * 1024.0]],
        vec![1.4 * 64.0, -2.0 * 64.0],
        mat![[0.0, 1.0]],
        mat![[1.0, 0.0]],
        vec![0.0],
        vec![0.0],
        vec![0.5],
    );
    let (one, other) = (solve(&problem, 1e-8), solve(&scaled.unwrap(), 1e-8));
    assert_eq!(one.convergence, other.convergence);
}

#[test]
fn limits_and_misuse_are_said() {
    let problem = body([1.4, -2.0], 0.0, 0.5);
    let run = |settings: AlmSettings| {
        alm::solve(&problem, &settings, &mut |_| ControlFlow::Continue(())).unwrap()
    };
    let few = run(AlmSettings { max_iterations: 2, ..AlmSettings::default() });
    assert_eq!((few.status, few.convergence.len()), (Status::IterationLimit, 2));
    let cancelled = alm::solve(&problem, &AlmSettings::default(), &mut |_| ControlFlow::Break(()));
    assert_eq!(cancelled.unwrap().status, Status::Cancelled);
    let none = AlmSettings { tolerance: 0.0, ..AlmSettings::default() };
    let error = alm::solve(&problem, &none, &mut |_| ControlFlow::Continue(())).unwrap_err();
    assert_eq!(error, AlmError::Tolerance { tolerance: 0.0 });
    let rigid = panel("stack");
    let error = alm::solve(&rigid, &AlmSettings::default(), &mut |_| ControlFlow::Continue(()));
    assert_eq!(error.unwrap_err(), AlmError::NoStiffness { displacement: 0 });
}
