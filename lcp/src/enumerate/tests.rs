//! Against enumeration in rational arithmetic, and leaves checked for what they say.

use faer::{Mat, mat};

use super::*;
use crate::exact::{Enumeration, EnumerationSettings, enumerate as enumerate_exactly};
use crate::random::SplitMix;
use crate::{Certificate, Lcp};

fn enumerated(problem: &HorizontalLcp) -> Enumerated {
    enumerate(problem, 1 << 16, None).0
}

/// Entries -2 to 2, about half of them zero; some pairs free, some columns single.
fn random_problem(random: &mut SplitMix) -> HorizontalLcp {
    let draw = |random: &mut SplitMix, count: u64| random.next_u64() % count;
    let n = usize::try_from(draw(random, 6)).expect("small");
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
    HorizontalLcp::new(a, b, c).expect("shapes fit")
}

/// Rows and variables in other units.
fn scaled(problem: &HorizontalLcp, unit: &mut dyn FnMut() -> f64) -> HorizontalLcp {
    let n = problem.order();
    let mut units = || -> Vec<f64> { (0..n).map(|_| unit()).collect() };
    let (rows, t, y) = (units(), units(), units());
    let a = Mat::from_fn(n, n, |i, j| problem.a()[(i, j)] * (rows[i] * t[j]));
    let b = Mat::from_fn(n, n, |i, j| problem.b()[(i, j)] * (rows[i] * y[j]));
    let c: Vec<f64> = problem.c().iter().zip(&rows).map(|(c, row)| c * row).collect();
    HorizontalLcp::new(a, b, c).expect("shapes fit")
}

/// Whether the outcome is the truth about a problem, and holds in the data.
fn is_true(outcome: &Enumerated, data: &HorizontalLcp, truth: &Enumeration) -> bool {
    match outcome {
        Enumerated::Found { t, y, basis } => {
            let fits = |(side, (t, y)): (&Side, (&f64, &f64))| match side {
                Side::T => *y == 0.0,
                Side::Y => *t == 0.0,
            };
            truth.is_solvable()
                && data.residuals(t, y).worst() <= 1e-13
                && basis.sides().iter().zip(t.iter().zip(y)).all(fits)
        }
        Enumerated::Infeasible(pi) => {
            !truth.is_feasible() && Certificate::Farkas { pi: pi.clone() }.holds(data)
        }
        Enumerated::NoSolution(leaves) => {
            !truth.is_solvable() && Certificate::Choices { leaves: leaves.clone() }.holds(data)
        }
        Enumerated::Limit | Enumerated::Open => false,
    }
}

fn truth(problem: &HorizontalLcp) -> Enumeration {
    enumerate_exactly(problem, &EnumerationSettings::default()).expect("small")
}

#[test]
fn small_integers_are_decided_as_in_rational_arithmetic() {
    let mut random = SplitMix::new(1);
    for _ in 0..4000 {
        let problem = random_problem(&mut random);
        let (outcome, truth) = (enumerated(&problem), truth(&problem));
        assert!(is_true(&outcome, &problem, &truth), "{outcome:?} of {problem:?}");
        assert_eq!(matches!(outcome, Enumerated::Infeasible(_)), !truth.is_feasible());
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
        match outcome {
            Enumerated::Limit | Enumerated::Open => open += 1,
            _ => assert!(said.contains(&true), "{outcome:?} of {data:?}"),
        }
    }
    assert!(100 * open <= 4000, "{open} left open");
}

/// Two parallel rows that contradict each other by 1e-9, and a pair that has to choose.
#[test]
fn proofs_of_small_problems() {
    let near = Lcp::new(mat![[1.0, -1.0], [-1.0, 1.0]], vec![-1.0, 1.0 - 1e-9]).expect("fits");
    let outcome = enumerated(&near.into());
    assert_eq!(outcome, Enumerated::Infeasible(vec![-1.0, -1.0]));
    // t1 + y1 = 2 and t1 - y1 = 0 can be met by (1, 1) alone.
    let a = mat![[1.0, 0.0], [1.0, 0.0]];
    let b = mat![[1.0, 0.0], [-1.0, 0.0]];
    let both = HorizontalLcp::new(a, b, vec![2.0, 0.0]).expect("fits");
    let Enumerated::NoSolution(leaves) = enumerated(&both) else { panic!("no proof") };
    assert!(leaves.len() == 2 && Certificate::Choices { leaves }.holds(&both));
}

#[test]
fn a_limit_leaves_it_open() {
    let both = HorizontalLcp::new(
        mat![[1.0, 0.0], [1.0, 0.0]],
        mat![[1.0, 0.0], [-1.0, 0.0]],
        vec![2.0, 0.0],
    );
    assert_eq!(enumerate(&both.expect("fits"), 1, None).0, Enumerated::Limit);
}
