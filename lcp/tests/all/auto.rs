//! The choice of the method: plans, chains, answers.

use crate::common;

use std::time::Duration;

use faer::{Mat, mat};
use lcp::{
    Auto, AutoSettings, BoxedLcp, Contact2d, Error, Friction2d, HorizontalLcp, Lcp, Lemke, Matrix,
    Method, RunEnd, Solution, Solver, Status, WarmStart,
};
use lcp_problems::families::{self, Ground, Instance, KnownAnswer, Obstacle};
use proptest::prelude::*;

const LEMKE: Method = Method::Lemke;
const NEWTON: Method = Method::Newton;
const INTERIOR: Method = Method::Interior;
const CHOICES: Method = Method::Enumeration;

fn auto() -> Auto {
    Auto::default()
}

fn with(settings: AutoSettings) -> Auto {
    Auto::new(settings)
}

/// The names of a plan. All reasons have a number.
macro_rules! plan {
    ($problem:expr) => {{
        let plan = auto().plan($problem);
        for choice in &plan {
            assert!(choice.reason.chars().any(|c| c.is_ascii_digit()), "{}", choice.reason);
        }
        plan.iter().map(|choice| choice.method).collect::<Vec<_>>()
    }};
}

// Below the macro, which it needs.
mod plans;

/// That the runs are those of the plan, as far as they go, and say what the solution says.
fn assert_routes<P>(solution: &Solution<P>, plan: &[Method]) {
    let runs = &solution.info.runs;
    let names: Vec<_> = runs.iter().map(|run| run.method).collect();
    assert_eq!(names, plan[..names.len()]);
    assert!(runs.iter().map(|run| run.seconds).sum::<f64>() <= solution.info.seconds);
    // The whole is measured by itself where its parts were solved one by one.
    let is_divided = runs.iter().any(|run| run.reason.contains("independent parts"));
    let is_from = |end: &RunEnd| {
        matches!(end, RunEnd::Ended { status, residual } if *status == solution.status
            && (is_divided || residual.total_cmp(&solution.residuals.worst()).is_eq()))
    };
    let source = runs.iter().rfind(|run| run.method == solution.info.method).unwrap();
    assert!(is_from(&source.end), "{source:?} but {}", solution.status);
}

fn sparse(n: usize, entry: impl Fn(usize, usize) -> f64, offsets: &[usize]) -> Matrix {
    use faer::sparse::{SparseColMat, Triplet};
    let mut entries: Vec<Triplet<usize, usize, f64>> = Vec::new();
    for i in 0..n {
        entries.push(Triplet::new(i, i, entry(i, i)));
        for j in offsets.iter().map(|offset| i + offset).filter(|j| *j < n) {
            entries.push(Triplet::new(i, j, entry(i, j)));
            entries.push(Triplet::new(j, i, entry(j, i)));
        }
    }
    SparseColMat::try_new_from_triplets(n, n, &entries).unwrap().into()
}

fn alternating(n: usize) -> Vec<f64> {
    (0..n).map(|i| if i % 3 == 0 { -2.0 } else { 1.0 }).collect()
}

/// Masses on a plane, one beside the other, pushed to the side, every second by more than friction holds. Springs
/// between them, which resist no motion along the plane, make them one problem.
fn masses(count: usize, mu: f64, spring: f64) -> Contact2d {
    let n = 2 * count;
    let k = |i: usize, j: usize| match i % 2 {
        _ if i == j => spring,
        0 => -0.25 * spring,
        _ => 0.0,
    };
    let k = sparse(n, k, &[2]);
    let select = |part: usize| {
        Matrix::from(Mat::from_fn(count, n, |i, j| f64::from(u8::from(j == 2 * i + part))))
    };
    let f: Vec<f64> = (0..n).map(|j| [-2.0, 0.4, -2.0, 1.4][j % 4]).collect();
    let zeros = vec![0.0; count];
    Contact2d::new(k, f, select(0), select(1), zeros.clone(), zeros, vec![mu; count]).unwrap()
}

fn assert_known<P>(instance: &KnownAnswer, solution: &Solution<P>) {
    match instance {
        KnownAnswer::Unique { t, y } => {
            let pairs = t.iter().zip(&solution.t).chain(y.iter().zip(&solution.y));
            for (expected, found) in pairs {
                assert!((expected - found).abs() <= 1e-8 * (1.0 + expected.abs()));
            }
        }
        KnownAnswer::Infeasible { .. } => {
            assert_eq!(solution.status, Status::Infeasible);
            assert!(solution.farkas().is_some());
        }
        _ => {}
    }
    let is_infeasible = matches!(instance, KnownAnswer::Infeasible { .. });
    assert!(is_infeasible || solution.is_solved(), "{}", solution.status);
}

#[test]
fn families_are_solved_by_the_first_of_the_plan() {
    let standard: Vec<Instance<Lcp>> = vec![
        families::positive_definite(40, 3),
        families::positive_semidefinite(40, 3),
        families::p_matrix(30, 3),
        families::copositive_plus(30, 3),
        families::strictly_copositive(30, 3),
        families::harker_pang(30, 3),
        families::murty(8),
        families::fathi(8),
        families::ties(20, 3),
        families::kostreva_1(),
        families::kostreva_2(),
        families::obstacle(30),
        families::infeasible_semidefinite(20, 3),
    ];
    for Instance { problem, known } in standard {
        let plan = plan!(&problem);
        let solution = auto().solve(&problem).unwrap();
        assert_known(&known, &solution);
        assert_routes(&solution, &plan);
        let general = HorizontalLcp::from(problem);
        assert!(
            general.residuals(&solution.t, &solution.y).worst() <= 1e-10 || !solution.is_solved()
        );
        let solution = auto().solve(&general).unwrap();
        assert_known(&known, &solution);
        assert_routes(&solution, &plan);
    }
    for Instance { problem, known } in
        [families::horizontal_monotone(30, 3), families::infeasible(20, 3)]
    {
        let solution = auto().solve(&problem).unwrap();
        assert_known(&known, &solution);
        assert_routes(&solution, &plan!(&problem));
    }
    for Instance { problem, known } in
        [families::mixed_monotone(30, 3), families::mixed_singular(20, 3)]
    {
        let solution = auto().solve(&problem).unwrap();
        assert_known(&known, &solution);
        assert_routes(&solution, &plan!(&problem));
        let (z, w) = problem.recover(&solution.t, &solution.y);
        assert!(problem.residuals(&z, &w).worst() <= 1e-10);
    }
}

/// In a problem of one pair and free variables sparse and large, `z_i = max(0, ...)`.
#[test]
fn large_sparse_problems_have_their_closed_forms() {
    // Pairs (i, i + 1) that couple by a rotation: w = (2 z1 + z2, 2 z2 - z1) + q.
    let n = 1200;
    let entry = |i: usize, j: usize| match (i.cmp(&j), i % 2, i.abs_diff(j)) {
        (std::cmp::Ordering::Equal, ..) => 2.0,
        (std::cmp::Ordering::Less, 0, 1) => 1.0,
        (std::cmp::Ordering::Greater, 1, 1) => -1.0,
        _ => 0.0,
    };
    let q: Vec<f64> = (0..n).map(|i| [-3.0, 4.0, -5.0, -5.0][i % 4]).collect();
    let expected = |i: usize| [1.5, 0.0, 1.0, 3.0][i % 4];
    let problem = Lcp::new(sparse(n, entry, &[1]), q.clone()).unwrap();
    let solution = auto().solve(&problem).unwrap();
    assert_eq!((solution.status, solution.info.method), (Status::Solved, NEWTON));
    assert!((0..n).all(|i| (solution.t[i] - expected(i)).abs() < 1e-9));
    // The same with bounds, of which the first is in the way: z1 <= 1, so w1 < 0.
    let upper: Vec<f64> = (0..n).map(|i| if i % 4 == 0 { 1.0 } else { 8.0 }).collect();
    let boxed = BoxedLcp::new(problem.m().clone(), q, vec![0.0; n], upper).unwrap();
    let solution = auto().solve(&boxed).unwrap();
    assert!(solution.is_solved());
    assert_routes(&solution, &plan!(&boxed));
    let (z, w) = boxed.recover(&solution.t, &solution.y);
    assert!((0..n).all(|i| (z[i] - [1.0, 0.0, 1.0, 3.0][i % 4]).abs() < 1e-8));
    assert!((w[0] + 1.0).abs() < 1e-8);
    // A membrane, against its known gap.
    let membrane = Obstacle::new(30, 30, Ground::Disc { radius: 0.5 });
    let solution = auto().solve(&membrane.problem()).unwrap();
    assert!(solution.is_solved() && solution.info.method == NEWTON);
    assert!(solution.info.pivots == 0 && solution.info.factorisations > 0);
}

#[test]
fn contact_is_solved_at_every_size() {
    for (count, mu, solver) in
        [(4, 0.5, INTERIOR), (60, 0.5, INTERIOR), (60, 0.0, INTERIOR), (600, 0.5, INTERIOR)]
    {
        let problem = masses(count, mu, 4.0);
        let solution = auto().solve(&problem).unwrap();
        assert_eq!((solution.status, solution.info.method), (Status::Solved, solver));
        assert_routes(&solution, &plan!(&problem));
        let state = problem.recover(&solution.t, &solution.y);
        for (i, slip) in state.slip.iter().enumerate() {
            let push = [0.4, 1.4][i % 2];
            let expected = if mu > 0.0 { (push - 1.0_f64).max(0.0) } else { push } / 4.0;
            assert!((slip - expected).abs() < 1e-12, "{slip}");
            assert!((state.t_n[i] - 2.0).abs() < 1e-12);
        }
    }
    let friction = Friction2d::new(mat![[2.0, 0.0], [0.0, 1.0]], vec![-2.0, -0.25], vec![0.5]);
    let friction = friction.unwrap();
    let solution = auto().solve(&friction).unwrap();
    assert!(solution.is_solved());
    let forces = friction.forces(&solution.t);
    assert!((forces.normal[0] - 1.0).abs() < 1e-12 && (forces.tangential[0] - 0.25).abs() < 1e-12);
}

/// `z1` and `-z1 - z2` have to be above one: no solution. A matrix with no positive entry off the diagonal
/// is for the active set method first, which finds none and proves nothing; pivots do.
#[test]
fn an_infeasible_problem_falls_through_to_a_proof() {
    let m = mat![[1.0, -1.0], [-1.0, 1.0]];
    let problem = Lcp::new(m, vec![-1.0, -1.0]).unwrap();
    let solution = auto().solve(&problem).unwrap();
    let names: Vec<_> = solution.info.runs.iter().map(|run| run.method).collect();
    assert_eq!(names, [NEWTON, LEMKE]);
    assert_eq!((solution.status, solution.info.method), (Status::Infeasible, LEMKE));
    let RunEnd::Ended { status, .. } = solution.info.runs[0].end else { panic!("refused") };
    assert!(!matches!(status, Status::Solved | Status::Infeasible), "{status}");
    let pi = solution.farkas().unwrap();
    assert!(pi[0] < 0.0 && (pi[0] - pi[1]).abs() < 1e-12 * -pi[0]);
}

/// Copositive, not monotone and sparse: the active set method and the interior point are for others.
#[test]
fn problems_of_no_class_end_with_pivots() {
    let n = 510;
    let block = families::strictly_copositive(30, 1).problem;
    let entry = |i: usize, j: usize| {
        if i / 30 == j / 30 { block.m()[(i % 30, j % 30)] } else { 0.0 }
    };
    let offsets: Vec<usize> = (1..30).collect();
    let q: Vec<f64> = (0..n).map(|i| block.q()[i % 30]).collect();
    let problem = Lcp::new(sparse(n, entry, &offsets), q).unwrap();
    let solution = auto().solve(&problem).unwrap();
    assert!(solution.is_solved(), "{}", solution.status);
    assert_routes(&solution, &plan!(&problem));
}

/// A body that slides away under a push above friction, which nothing holds: no equilibrium.
fn sliding(count: usize) -> Contact2d {
    let held = masses(count, 0.5, 4.0);
    let k = sparse(2 * count, |i, _| f64::from(u8::from(i < 2)), &[]);
    let (c_n, c_t) = (held.normal().clone(), held.tangent().clone());
    let zeros = vec![0.0; count];
    Contact2d::new(k, held.loads().to_vec(), c_n, c_t, zeros.clone(), zeros, vec![0.5; count])
        .unwrap()
}

#[test]
fn without_equilibrium_the_chain_looks_for_a_proof() {
    for count in [2, 60, 600] {
        let problem = sliding(count);
        let solution = auto().solve(&problem).unwrap();
        let runs = &solution.info.runs;
        assert_eq!(solution.status, Status::Infeasible, "{count}: {runs:?}");
        let pi = solution.farkas().unwrap();
        let general = problem.to_general();
        let gain: f64 = general.c().iter().zip(pi).map(|(c, pi)| c * pi).sum();
        assert!(gain > 0.0);
        assert!(count <= 500 || runs.iter().all(|run| run.method != LEMKE));
    }
}

/// Blocks of a symmetric matrix that is copositive and not semidefinite, one weakly coupled with the next: the active
/// set method cycles, the interior point jams, pivots end with a basis.
#[test]
fn methods_that_fail_are_followed_by_pivots() {
    let block = families::strictly_copositive(30, 1).problem;
    let entry = |i: usize, j: usize| {
        let (k, l) = (i % 30, j % 30);
        if i / 30 == j / 30 {
            0.5 * (block.m()[(k, l)] + block.m()[(l, k)])
        } else if i.abs_diff(j) == 1 {
            1e-3
        } else {
            0.0
        }
    };
    let offsets: Vec<usize> = (1..30).collect();
    let q: Vec<f64> = (0..600).map(|i| block.q()[i % 30]).collect();
    let problem = Lcp::new(sparse(600, entry, &offsets), q).unwrap();
    let solution = auto().solve(&problem).unwrap();
    assert_eq!((solution.status, solution.info.method), (Status::Solved, LEMKE));
    assert_routes(&solution, &[NEWTON, INTERIOR, LEMKE]);
    let runs = &solution.info.runs;
    let failed =
        |end: &RunEnd| matches!(end, RunEnd::Ended { status, .. } if *status != Status::Solved);
    assert!(failed(&runs[0].end) && failed(&runs[1].end));
}

#[test]
fn a_tiny_time_limit_is_kept_and_said() {
    let time_limit = Some(Duration::ZERO);
    let limited = with(AutoSettings { time_limit, ..AutoSettings::default() });
    let problem = families::positive_definite(200, 1).problem;
    let solution = limited.solve(&problem).unwrap();
    assert_eq!((solution.status, solution.info.runs.len()), (Status::TimeLimit, 1));
    assert!(solution.t.iter().chain(&solution.y).all(|v| v.is_finite()));
    let contact = limited.solve(&masses(300, 0.5, 4.0)).unwrap();
    assert_eq!(contact.status, Status::TimeLimit);
    // What is left after a method that ends early goes to the next one, and is not more than nothing.
    let z = Lcp::new(mat![[1.0, -1.0], [-1.0, 1.0]], vec![-1.0, -1.0]).unwrap();
    assert_eq!(limited.solve(&z).unwrap().status, Status::TimeLimit);
    let hour = with(AutoSettings {
        time_limit: Some(Duration::from_secs(3600)),
        ..AutoSettings::default()
    });
    assert!(hour.solve(&problem).unwrap().is_solved());
}

#[test]
fn settings_are_checked_and_reach_the_methods() {
    let problem = families::positive_definite(10, 1).problem;
    for tolerance in [0.0, 1.0, f64::NAN] {
        let settings = AutoSettings { tolerance, ..AutoSettings::default() };
        let error = with(settings).solve(&problem).unwrap_err();
        assert!(matches!(error, Error::Setting { name: "tolerance", .. }), "{error}");
    }
    let start = WarmStart::Point { t: vec![0.0; 3], y: vec![0.0; 10] };
    let error =
        with(AutoSettings { start, ..AutoSettings::default() }).solve(&problem).unwrap_err();
    assert!(matches!(error, Error::Length { name: "start.t", len: 3, expected: 10 }), "{error}");
    // A start that is the solution is one for every kind of problem.
    let first = auto().solve(&problem).unwrap();
    let start = WarmStart::Point { t: first.t, y: first.y };
    let again = with(AutoSettings { start, ..AutoSettings::default() }).solve(&problem).unwrap();
    assert!(again.is_solved() && again.info.pivots <= 1, "{}", again.info.pivots);
    let contact = masses(60, 0.5, 4.0);
    let first = auto().solve(&contact).unwrap();
    let start = WarmStart::Basis(first.basis.unwrap());
    let again = with(AutoSettings { start, ..AutoSettings::default() }).solve(&contact).unwrap();
    assert!(again.is_solved() && again.info.iterations == 0);
    let boxed = BoxedLcp::new(mat![[2.0]], vec![-9.0], vec![0.0], vec![1.0]).unwrap();
    let start = WarmStart::Point { t: vec![1.0, 0.0], y: vec![0.0, 7.0] };
    let solution = with(AutoSettings { start, ..AutoSettings::default() }).solve(&boxed).unwrap();
    assert!(solution.is_solved());
}

#[test]
fn it_is_a_solver_among_others() {
    let solvers: [Box<dyn Solver<Lcp>>; 2] = [Box::new(auto()), Box::new(Lemke::default())];
    let problem = families::positive_definite(10, 1).problem;
    let answers = solvers.map(|solver| (solver.method(), solver.solve(&problem).unwrap()));
    assert_eq!((answers[0].0, answers[1].0), (Method::Auto, LEMKE));
    let pairs = answers[0].1.t.iter().zip(&answers[1].1.t);
    assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() <= 1e-12 * (1.0 + b.abs())));
}

proptest! {
    #![proptest_config(common::cases(48))]

    /// No answer is called solved without the residuals of the data, whatever the matrix.
    #[test]
    fn whatever_the_matrix_the_answer_is_honest(
        entries in proptest::collection::vec(-3..=3_i32, 16),
        q in proptest::collection::vec(-3..=3_i32, 4),
    ) {
        let m = Mat::from_fn(4, 4, |i, j| f64::from(entries[4 * i + j]));
        let problem = Lcp::new(m, q.into_iter().map(f64::from).collect::<Vec<f64>>()).unwrap();
        let solution = auto().solve(&problem).unwrap();
        let worst = problem.residuals(&solution.t, &solution.y).worst();
        prop_assert!(!solution.is_solved() || worst <= 1e-10, "{worst:e}");
        prop_assert_eq!(solution.status == Status::Infeasible, solution.farkas().is_some());
        let is_decided =
            matches!(solution.status, Status::Solved | Status::Infeasible | Status::NoSolution);
        prop_assert!(is_decided, "{}", solution.status);
        let pivots = Solver::<Lcp>::solve(&Lemke::default(), &problem).unwrap();
        prop_assert!(solution.is_solved() || !pivots.is_solved());
    }
}
