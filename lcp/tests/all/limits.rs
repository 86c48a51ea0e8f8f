//! Limits, observers, traces and warm starts.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use lcp::lemke::{AttemptStart, Parametric, Progress, Variable};
use lcp::{HorizontalLcp, Lemke, LemkeSettings, Solution, Solver, Status, WarmStart};
use lcp_problems::families;

fn problem(n: usize, seed: u64) -> HorizontalLcp {
    families::positive_definite(n, seed).problem.into()
}

fn with(settings: LemkeSettings, problem: &HorizontalLcp) -> Solution {
    Lemke::new(settings).solve(problem).unwrap()
}

/// Every number of pivots allowed gives just as many, until they are enough.
#[test]
fn the_limit_on_pivots_is_exact() {
    let problem = problem(40, 7);
    let needed = with(LemkeSettings::default(), &problem).info.pivots;
    assert!(needed > 10);
    for allowed in [0, 1, needed / 2, needed - 1] {
        let settings = LemkeSettings {
            max_pivots: Some(allowed),
            max_attempts: Some(1),
            ..LemkeSettings::default()
        };
        let solution = with(settings, &problem);
        assert_eq!((solution.status, solution.info.pivots), (Status::PivotLimit, allowed));
    }
    let settings = LemkeSettings { max_pivots: Some(needed), ..LemkeSettings::default() };
    assert!(with(settings, &problem).is_solved());
}

#[test]
fn no_time_is_no_pivot() {
    let settings = LemkeSettings { time_limit: Some(Duration::ZERO), ..LemkeSettings::default() };
    let solution = with(settings, &problem(40, 7));
    assert_eq!((solution.status, solution.info.pivots), (Status::TimeLimit, 0));
}

/// The observer is asked before every pivot, and another thread may answer.
#[test]
fn an_observer_stops_at_any_pivot() {
    let problem = problem(40, 7);
    let cancelled = AtomicBool::new(false);
    let mut seen = Vec::new();
    let mut observer = |progress: &Progress| {
        seen.push((progress.attempt, progress.pivots, progress.order));
        cancelled.store(progress.pivots == 5, Ordering::Relaxed);
        if cancelled.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let solution = Lemke::default().solve_with_progress(&problem, &mut observer).unwrap();
    assert_eq!((solution.status, solution.info.pivots), (Status::Cancelled, 5));
    assert_eq!(seen, (0..=5).map(|pivots| (1, pivots, 40)).collect::<Vec<_>>());
}

/// In the search for a proof too: the path ends on a ray after one pivot.
#[test]
fn an_observer_stops_a_proof() {
    let problem: HorizontalLcp = families::infeasible_semidefinite(12, 1).problem.into();
    let settings = LemkeSettings { max_attempts: Some(1), ..LemkeSettings::default() };
    let mut calls = 0;
    let mut on_path = 0;
    let solution = Lemke::new(settings.clone())
        .solve_with_progress(&problem, &mut |_| {
            calls += 1;
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(solution.status, Status::Infeasible);
    // The last call belongs to the proof.
    let mut observer = |_: &Progress| {
        on_path += 1;
        if on_path == calls { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let stopped = Lemke::new(settings).solve_with_progress(&problem, &mut observer).unwrap();
    assert_eq!(stopped.status, Status::Cancelled);
}

/// The trace begins with the artificial variable, follows complements, and ends with it.
#[test]
fn the_trace_is_a_complementary_path() {
    let problem = problem(40, 7);
    let settings = LemkeSettings { trace: true, ..LemkeSettings::default() };
    let solution = with(settings, &problem);
    let trace = &solution.trace;
    assert_eq!(trace.len(), solution.info.pivots);
    assert_eq!(trace[0].entering, Variable::Artificial);
    assert_eq!(trace[trace.len() - 1].leaving, Variable::Artificial);
    for pair in trace.windows(2) {
        let complement = match pair[0].leaving {
            Variable::T(pair) => Variable::Y(pair),
            Variable::Y(pair) => Variable::T(pair),
            Variable::Artificial => panic!("the artificial variable leaves last"),
        };
        assert_eq!(pair[1].entering, complement);
    }
    assert!(with(LemkeSettings::default(), &problem).trace.is_empty());
}

/// From its own basis, or its own point, a problem takes no pivot; a similar problem takes fewer.
#[test]
fn warm_starts_save_pivots() {
    let problem = problem(60, 3);
    let cold = with(LemkeSettings::default(), &problem);
    let (t, y) = (cold.t.clone(), cold.y.clone());
    let basis = cold.basis.clone().unwrap();
    for start in [WarmStart::Basis(basis), WarmStart::Point { t, y }] {
        let settings = LemkeSettings { start, ..LemkeSettings::default() };
        let again = with(settings.clone(), &problem);
        assert_eq!((again.status, again.info.pivots), (Status::Solved, 0));
        let nearby = problem.c().iter().enumerate().map(|(i, c)| c + 1e-3 * (i % 7) as f64);
        let nearby = problem.with_right_hand_side(nearby.collect()).unwrap();
        let (warm, cold) = (with(settings, &nearby), with(LemkeSettings::default(), &nearby));
        assert!(warm.is_solved() && warm.info.pivots < cold.info.pivots / 2);
        let starts = warm.info.attempts.iter().map(|attempt| attempt.start);
        assert!(starts.into_iter().all(|start| start == AttemptStart::Given));
    }
}

/// Where one of the vectors vanishes the other one decides.
#[test]
fn a_point_without_one_of_the_vectors_is_a_start() {
    let m = faer::mat![[2.0, 1.0], [1.0, 2.0]];
    for (q, t, y) in [
        (vec![-5.0, -6.0], vec![4.0 / 3.0, 7.0 / 3.0], vec![0.0; 2]),
        (vec![5.0, 6.0], vec![0.0; 2], vec![5.0, 6.0]),
    ] {
        let problem = lcp::Lcp::new(m.clone(), q).unwrap().into();
        let start = WarmStart::Point { t, y };
        let solution = with(LemkeSettings { start, ..LemkeSettings::default() }, &problem);
        assert_eq!((solution.status, solution.info.pivots), (Status::Solved, 0));
    }
}

#[test]
fn solvers_and_answers_cross_threads() {
    fn is_shared<T: Send + Sync>() {}
    is_shared::<HorizontalLcp>();
    is_shared::<Lemke>();
    is_shared::<Parametric>();
    is_shared::<Solution>();
    let problem = problem(30, 1);
    let solve = || Lemke::default().solve(&problem).unwrap().t;
    let alone = solve();
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..2).map(|_| scope.spawn(solve)).collect();
        assert!(threads.into_iter().all(|thread| thread.join().unwrap() == alone));
    });
}
