//! Branch and bound against enumeration in rational arithmetic, and leaves checked for what they say.

use std::time::Duration;

use faer::{Mat, mat};
use lcp::{Certificate, Enumeration, HorizontalLcp, Lcp, Side, Solution, Solver, SplitMix, Status};
use lcp_problems::exact::{self, EnumerationSettings};

const BRANCH_AND_BOUND: Enumeration = Enumeration { tolerance: 1e-10, time_limit: None };

fn enumerated(problem: &HorizontalLcp) -> Solution {
    BRANCH_AND_BOUND.solve(problem).unwrap()
}

/// Entries -2 to 2, about half of them zero; some pairs free, some columns single.
fn random_problem(random: &mut SplitMix) -> HorizontalLcp {
    let draw = |random: &mut SplitMix, count: u64| random.next_u64() % count;
    let n = usize::try_from(draw(random, 6)).unwrap();
    let kind = draw(random, 4);
    let entry = |random: &mut SplitMix| {
        let value = draw(random, 5) as f64 - 2.0;
        if draw(random, 2) == 0 { 0.0 } else { value }
    };
    let a = Mat::from_fn(n, n, |_, _| entry(random));
    let mut b = Mat::from_fn(n, n, |_, _| entry(random));
    for j in 0..n {
        match kind {
            1 => (0..n).for_each(|i| b[(i, j)] = f64::from(u8::from(i == j))),
            2 if j % 2 == 0 => (0..n).for_each(|i| b[(i, j)] = -a[(i, j)]),
            _ => {}
        }
    }
    let c: Vec<f64> = (0..n).map(|_| entry(random)).collect();
    HorizontalLcp::new(a, b, c).unwrap()
}

/// Rows and variables in other units.
fn scaled(problem: &HorizontalLcp, unit: &mut dyn FnMut() -> f64) -> HorizontalLcp {
    let n = problem.order();
    let mut units = || -> Vec<f64> { (0..n).map(|_| unit()).collect() };
    let (rows, t, y) = (units(), units(), units());
    let a = Mat::from_fn(n, n, |i, j| problem.a()[(i, j)] * (rows[i] * t[j]));
    let b = Mat::from_fn(n, n, |i, j| problem.b()[(i, j)] * (rows[i] * y[j]));
    let c: Vec<f64> = problem.c().iter().zip(&rows).map(|(c, row)| c * row).collect();
    HorizontalLcp::new(a, b, c).unwrap()
}

/// Whether the outcome is the truth about a problem, and holds in the data.
fn is_true(outcome: &Solution, data: &HorizontalLcp, truth: &exact::ExactEnumeration) -> bool {
    let is_proved = || outcome.certificate.as_ref().is_some_and(|proof| proof.holds(data));
    match outcome.status {
        Status::Solved => {
            let Solution { t, y, .. } = outcome;
            let fits = |(side, (t, y)): (&Side, (&f64, &f64))| match side {
                Side::T => *y == 0.0,
                Side::Y => *t == 0.0,
            };
            truth.is_solvable()
                && data.residuals(t, y).worst() <= 1e-13
                && outcome.basis.as_ref().unwrap().sides().iter().zip(t.iter().zip(y)).all(fits)
        }
        Status::Infeasible => !truth.is_feasible() && is_proved(),
        Status::NoSolution => !truth.is_solvable() && is_proved(),
        _ => false,
    }
}

fn truth(problem: &HorizontalLcp) -> exact::ExactEnumeration {
    exact::enumerate(problem, &EnumerationSettings::default()).unwrap()
}

#[test]
fn small_integers_are_decided_as_in_rational_arithmetic() {
    let mut random = SplitMix::new(1);
    for _ in 0..4000 {
        let problem = random_problem(&mut random);
        let (outcome, truth) = (enumerated(&problem), truth(&problem));
        assert!(is_true(&outcome, &problem, &truth), "{outcome:?} of {problem:?}");
        assert_eq!(outcome.status == Status::Infeasible, !truth.is_feasible());
    }
}

/// In units that are powers of two the numbers are the same.
#[test]
fn units_do_not_matter() {
    let mut random = SplitMix::new(2);
    for _ in 0..4000 {
        let problem = random_problem(&mut random);
        let data = scaled(&problem, &mut || (40.0 * random.next_f64() - 20.0).round().exp2());
        let outcome = enumerated(&data);
        assert!(is_true(&outcome, &data, &truth(&problem)), "{outcome:?} of {data:?}");
    }
}

/// In other units the data are rounded, so that a singular matrix may be regular and an answer far out.
/// What is said is true of the data as they are or as they were meant.
#[test]
fn rounded_data_are_not_judged_wrongly() {
    let mut random = SplitMix::new(3);
    let mut open = 0;
    for _ in 0..4000 {
        let problem = random_problem(&mut random);
        let data = scaled(&problem, &mut || 10.0_f64.powf(12.0 * random.next_f64() - 6.0));
        let outcome = enumerated(&data);
        let said = [&data, &problem].map(|it| is_true(&outcome, &data, &truth(it)));
        match outcome.status {
            Status::Solved | Status::Infeasible | Status::NoSolution => {
                assert!(said.contains(&true), "{outcome:?} of {data:?}");
            }
            _ => open += 1,
        }
    }
    assert!(100 * open <= 4000, "{open} left open");
}

/// Two parallel rows that contradict each other by 1e-9, and a pair that has to choose.
#[test]
fn proofs_of_small_problems() {
    let near = Lcp::new(mat![[1.0, -1.0], [-1.0, 1.0]], vec![-1.0, 1.0 - 1e-9]).unwrap();
    let outcome = enumerated(&near.into());
    assert_eq!(outcome.certificate, Some(Certificate::Farkas { pi: vec![-1.0, -1.0] }));
    // t1 + y1 = 2 and t1 - y1 = 0 can be met by (1, 1) alone.
    let a = mat![[1.0, 0.0], [1.0, 0.0]];
    let b = mat![[1.0, 0.0], [-1.0, 0.0]];
    let both = HorizontalLcp::new(a, b, vec![2.0, 0.0]).unwrap();
    let outcome = enumerated(&both);
    let Some(Certificate::Choices { leaves }) = &outcome.certificate else { panic!("no proof") };
    assert!(leaves.len() == 2 && outcome.certificate.as_ref().unwrap().holds(&both));
}

#[test]
fn a_limit_leaves_it_open() {
    let both = HorizontalLcp::new(
        mat![[1.0, 0.0], [1.0, 0.0]],
        mat![[1.0, 0.0], [-1.0, 0.0]],
        vec![2.0, 0.0],
    );
    let at_once = Enumeration { time_limit: Some(Duration::ZERO), ..BRANCH_AND_BOUND };
    assert_eq!(at_once.solve(&both.unwrap()).unwrap().status, Status::TimeLimit);
}
