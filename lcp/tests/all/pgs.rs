//! Projected Gauss-Seidel: closed forms, agreement with Lemke's method, friction, rows without a matrix,
//! and honest ends where the sweeps do not converge.

mod agreement;
use crate::common;
mod contact;
mod rows;

use std::ops::ControlFlow;
use std::time::Duration;

use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, mat};
use lcp::{
    Basis, BoxedLcp, Contact2d, Error, Friction2d, HorizontalLcp, Lcp, Lemke, Matrix, Method,
    ProjectedGaussSeidel, ProjectedGaussSeidelSettings, Side, Solution, Solver, Status, WarmStart,
};
use lcp_problems::families::{self, KnownAnswer};

const INF: f64 = f64::INFINITY;

fn settings() -> ProjectedGaussSeidelSettings {
    ProjectedGaussSeidelSettings::default()
}

fn to(tolerance: f64) -> ProjectedGaussSeidel {
    ProjectedGaussSeidel::new(ProjectedGaussSeidelSettings { tolerance, ..settings() })
}

fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |max, v| max.max(v.abs()))
}

/// The largest difference, relative to the largest entry.
fn distance(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let difference: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
    let size = largest(expected);
    if size > 0.0 { largest(&difference) / size } else { largest(&difference) }
}

fn sparse(m: &Mat<f64>) -> Matrix {
    let places = (0..m.ncols()).flat_map(|j| (0..m.nrows()).map(move |i| (i, j)));
    let triplets: Vec<_> = places
        .filter(|&place| m[place] != 0.0)
        .map(|(i, j)| Triplet::new(i, j, m[(i, j)]))
        .collect();
    SparseColMat::try_new_from_triplets(m.nrows(), m.ncols(), &triplets).unwrap().into()
}

/// A point that is called solved must be one, and none may hold anything but numbers.
fn check_honest<P>(solution: &Solution<P>, problem: &HorizontalLcp, tolerance: f64) {
    let residuals = problem.residuals(&solution.t, &solution.y);
    assert!(solution.t.iter().chain(&solution.y).all(|v| v.is_finite()));
    let worst = solution.residuals.worst();
    assert_eq!(solution.is_solved(), worst <= tolerance, "{:?}", solution.status);
    // The rows are the same; the loads are those of another form.
    assert!(!solution.is_solved() || residuals.worst() <= 4.0 * tolerance, "{residuals:?}");
    assert_eq!(solution.info.history.len(), solution.info.iterations + 1);
}

// Closed forms

#[test]
fn two_by_two() {
    let lcp = Lcp::new(mat![[2.0, 1.0], [1.0, 2.0]], vec![-5.0, -6.0]).unwrap();
    let solution = to(1e-14).solve(&lcp).unwrap();
    assert!(solution.is_solved());
    assert!(distance(&solution.t, &[4.0 / 3.0, 7.0 / 3.0]) <= 1e-13);
}

/// A triangular matrix is solved by one sweep in its order.
#[test]
fn triangular_problems_take_two_sweeps() {
    for n in [1, 5, 20] {
        let families::Instance { problem, known } = families::murty(n);
        let solution = to(1e-8).solve(&problem).unwrap();
        let KnownAnswer::Unique { t, y } = known else { panic!("one solution") };
        // A second one finds nothing to change.
        assert_eq!((solution.status, solution.info.iterations), (Status::Solved, 2));
        assert_eq!((solution.t, solution.y), (t, y));
    }
}

#[test]
fn nothing_to_do() {
    for n in [0, 3] {
        let lcp = Lcp::new(Mat::<f64>::identity(n, n), vec![1.0; n]).unwrap();
        let solution = to(1e-12).solve(&lcp).unwrap();
        assert_eq!((solution.status, solution.info.iterations), (Status::Solved, 0));
        assert_eq!((solution.t, solution.y), (vec![0.0; n], vec![1.0; n]));
    }
}

/// The membrane over an obstacle: over-relaxation pays.
#[test]
fn relaxations_have_one_fixed_point() {
    let families::Instance { problem, known } = families::obstacle(12);
    let KnownAnswer::Unique { t, .. } = known else { panic!("one solution") };
    let sweeps = [0.7, 1.0, 1.6].map(|relaxation| {
        let settings = ProjectedGaussSeidelSettings { relaxation, tolerance: 1e-11, ..settings() };
        let solution = ProjectedGaussSeidel::new(settings).solve(&problem).unwrap();
        assert!(solution.is_solved(), "{relaxation}");
        assert!(distance(&solution.t, &t) <= 1e-9, "{relaxation}");
        solution.info.iterations
    });
    assert!(sweeps[2] < sweeps[1] && sweeps[1] < sweeps[0], "{sweeps:?}");
}

/// Free variables make it the method for equations; a fixed one needs no diagonal.
#[test]
fn bounds_of_every_kind() {
    let m = mat![
        [4.0, 1.0, 0.0, 1.0, 1.0],
        [1.0, 4.0, 1.0, 0.0, 1.0],
        [0.0, 1.0, 4.0, 1.0, 1.0],
        [1.0, 0.0, 1.0, 4.0, 1.0],
        [1.0, 1.0, 1.0, 1.0, 0.0],
    ];
    let lower = vec![-INF, -1.0, -INF, 0.0, 2.0];
    let upper = vec![INF, INF, -1.0, 1.0, 2.0];
    let q = vec![-3.0, 8.0, -4.0, -9.0, 1.0];
    let boxed = BoxedLcp::new(m, q, lower, upper).unwrap();
    let solution = to(1e-13).solve(&boxed).unwrap();
    check_honest(&solution, &boxed.to_general(), 1e-13);
    assert!(solution.is_solved());
    let (z, w) = boxed.recover(&solution.t, &solution.y);
    assert_eq!(z[1..], [-1.0, -1.0, 1.0, 2.0]);
    // 4 z_0 - 1 + 1 + 2 - 3 = 0
    assert!((z[0] - 0.25).abs() <= 1e-12 && w[0].abs() <= 0.0, "{z:?}");
    assert!(distance(&w[1..], &[5.25, -6.0, -3.75, 0.25]) <= 1e-12, "{w:?}");
}

// Degenerate problems

/// Both variables of many pairs are zero, and the solution is not unique: any will do.
#[test]
fn degenerate_problems() {
    let mut solved = 0;
    for seed in 0..20 {
        for problem in [
            families::ties(12, seed).problem,
            families::positive_semidefinite(12, seed).problem,
            families::copositive_plus(12, seed).problem,
        ] {
            match to(1e-9).solve(&problem) {
                Ok(solution) => {
                    check_honest(&solution, &problem.into(), 1e-9);
                    solved += usize::from(solution.is_solved());
                }
                Err(error) => assert!(matches!(error, Error::NotTreated { .. }), "{error}"),
            }
        }
    }
    assert!(solved >= 20, "{solved}");
}

/// A degenerate answer to a definite problem: `q = -M z` on some pairs, and zero on both sides of others.
#[test]
fn without_strict_complementarity() {
    let m = mat![[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 2.0]];
    // z = (1, 0, 0), w = (0, 0, 1)
    let lcp = Lcp::new(m, vec![-2.0, 1.0, 1.0]).unwrap();
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let solution = to(tolerance).solve(&lcp).unwrap();
        assert!(solution.is_solved());
        assert!(distance(&solution.t, &[1.0, 0.0, 0.0]) <= 10.0 * tolerance);
    }
}

// Ends

/// Inconsistent, though semidefinite; skew but for a small diagonal; and growing without bound.
#[test]
fn where_it_cannot_converge_it_stalls() {
    let inconsistent = Lcp::new(mat![[1.0, -1.0], [-1.0, 1.0]], vec![-1.0, -1.0]).unwrap();
    let skew = Lcp::new(mat![[0.1, 4.0], [-4.0, 0.1]], vec![-1.0, 1.0]).unwrap();
    let growing = Lcp::new(mat![[1.0, -3.0], [-3.0, 1.0]], vec![-1.0, -1.0]).unwrap();
    for problem in [inconsistent, skew, growing] {
        let solution = to(1e-8).solve(&problem).unwrap();
        check_honest(&solution, &problem.into(), 1e-8);
        assert_eq!(solution.status, Status::Stalled);
        assert!(solution.info.iterations < 10_000);
        let best = solution.info.history.iter().copied().fold(INF, f64::min);
        assert_eq!(best.to_bits(), solution.residuals.worst().to_bits());
    }
}

/// Even where nothing else stops it, growth ends before there is anything but numbers, and nothing is
/// called solved on the way.
#[test]
fn growth_ends_in_numbers() {
    for size in [1.0, 1e-300, 1e290] {
        let growing = Lcp::new(mat![[1.0, -3.0], [-3.0, 1.0]], vec![-size; 2]).unwrap();
        let solution = to(0.4).solve(&growing).unwrap();
        check_honest(&solution, &growing.into(), 0.4);
        assert_eq!(solution.status, Status::Stalled);
        assert!(solution.info.iterations < 1000 && solution.residuals.worst() <= 1.0);
    }
}

#[test]
fn rows_that_cannot_be_relaxed_are_named() {
    fn reason<P>(result: Result<Solution<P>, Error>) -> String {
        match result {
            Err(Error::NotTreated { method: Method::GaussSeidel, reason }) => reason,
            other => panic!("{other:?}"),
        }
    }
    let zero = Lcp::new(mat![[1.0, 1.0], [-1.0, 0.0]], vec![-1.0, 1.0]).unwrap();
    assert!(reason(to(1e-8).solve(&zero)).starts_with("row 1 has the diagonal entry 0"));
    let negative = Lcp::new(mat![[-2.0]], vec![1.0]).unwrap();
    assert!(reason(to(1e-8).solve(&negative)).starts_with("row 0 has the diagonal entry -2"));
    let general = families::horizontal_singular(6, 1).problem;
    assert!(reason(to(1e-8).solve(&general)).contains("standard form"));
    let start = WarmStart::Basis(Basis::new(vec![Side::T; 1]));
    let solver = ProjectedGaussSeidel::new(ProjectedGaussSeidelSettings { start, ..settings() });
    assert!(reason(solver.solve(&negative)).contains("basis"));
}

#[test]
fn limits_hold() {
    let problem = families::obstacle(20).problem;
    let general: HorizontalLcp = problem.clone().into();
    let needed = to(1e-8).solve(&problem).unwrap().info.iterations;
    for max_iterations in [0, 1, 37, needed - 1] {
        let settings = ProjectedGaussSeidelSettings { max_iterations, ..settings() };
        let solution = ProjectedGaussSeidel::new(settings).solve(&problem).unwrap();
        check_honest(&solution, &general, 1e-8);
        assert_eq!(
            (solution.status, solution.info.iterations),
            (Status::IterationLimit, max_iterations)
        );
    }
    let none = ProjectedGaussSeidelSettings { time_limit: Some(Duration::ZERO), ..settings() };
    let solution = ProjectedGaussSeidel::new(none).solve(&problem).unwrap();
    assert_eq!((solution.status, solution.info.iterations), (Status::TimeLimit, 0));
    let solution = to(1e-8)
        .solve_observed(&problem, &mut |at| {
            if at.iteration == 25 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .unwrap();
    check_honest(&solution, &general, 1e-8);
    assert_eq!((solution.status, solution.info.iterations), (Status::Cancelled, 25));
}

#[test]
fn settings_out_of_range_are_named() {
    let problem = Lcp::new(mat![[1.0]], vec![-1.0]).unwrap();
    let wrong = [
        ("tolerance", ProjectedGaussSeidelSettings { tolerance: 0.0, ..settings() }),
        ("relaxation", ProjectedGaussSeidelSettings { relaxation: 2.0, ..settings() }),
        ("relaxation", ProjectedGaussSeidelSettings { relaxation: f64::NAN, ..settings() }),
    ];
    for (expected, settings) in wrong {
        let error = ProjectedGaussSeidel::new(settings).solve(&problem).unwrap_err();
        assert!(matches!(error, Error::Setting { name, .. } if name == expected), "{error}");
    }
    let start = WarmStart::Point { t: vec![1.0; 2], y: vec![0.0; 2] };
    let long = ProjectedGaussSeidelSettings { start, ..settings() };
    let error = ProjectedGaussSeidel::new(long).solve(&problem).unwrap_err();
    assert!(matches!(error, Error::Length { name: "start.t", len: 2, expected: 1 }));
}

/// All problems through one trait.
#[test]
fn it_is_a_solver_of_everything() {
    let routes: [Box<dyn Solver<Lcp>>; 2] = [Box::new(Lemke::default()), Box::new(to(1e-9))];
    let lcp = families::obstacle(6).problem;
    let [lemke, pgs] = routes.map(|route| route.solve(&lcp).unwrap());
    assert!(pgs.is_solved() && distance(&pgs.t, &lemke.t) <= 1e-7);
    let _: [Box<dyn Solver<HorizontalLcp>>; 1] = [Box::new(to(1e-9))];
    let _: [Box<dyn Solver<BoxedLcp>>; 1] = [Box::new(to(1e-9))];
    let _: [Box<dyn Solver<Friction2d>>; 1] = [Box::new(to(1e-9))];
    let _: [Box<dyn Solver<Contact2d>>; 1] = [Box::new(to(1e-9))];
    assert_eq!(
        (pgs.info.method, lcp::Named::method(&to(1e-9))),
        (Method::GaussSeidel, Method::GaussSeidel)
    );
}
