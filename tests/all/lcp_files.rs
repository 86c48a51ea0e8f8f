//! Published problems, where their files are at hand: the right verdict and the known answer, as the
//! problems stand and in equivalent forms.

#![allow(clippy::unreadable_literal, reason = "answers as they are published")]

#[path = "lcp_files/forms.rs"]
#[allow(unreachable_pub, reason = "a module of this test")]
mod forms;
#[path = "lcp_files/transform.rs"]
#[allow(unreachable_pub, reason = "a module of this test")]
mod transform;

use std::path::PathBuf;

use forms::{CLASSES, Random};
use lcp::{Auto, HorizontalLcp, Matrix, Solver, Status};
use lcp_problems::io::{Problem, read_file};
use transform::Equivalent;

/// What is known of the solutions `(z, w)`.
enum Answer {
    /// `z` is this point, which is known to six decimals.
    Rounded(Vec<f64>),
    /// `z` is one of these points.
    OneOf(Vec<Vec<f64>>),
    /// These combinations of `z` have these values, and there is nothing else to know.
    Equations(Vec<(Vec<f64>, f64)>),
    /// The sum of these entries of `z`, and how many of them are positive.
    Sum { of: fn(usize) -> bool, sum: f64, positive: usize },
    /// Nothing but the residuals.
    Residuals,
}

fn all(_: usize) -> bool {
    true
}

fn normal_force(index: usize) -> bool {
    index.is_multiple_of(3)
}

fn published() -> Vec<(&'static str, Answer)> {
    use Answer::{Equations, OneOf, Residuals, Rounded, Sum};
    let trivial = (1..=9).map(|k| 1.0 / f64::from(k)).collect();
    let pd_sym = vec![-2.049212, -1.518139, -0.751748, 0.760924, 0.412631, 0.625117, 0.325553];
    vec![
        ("lcp_CPS_1", Equations(vec![(vec![1.0, 1.0], 1.0)])),
        ("lcp_CPS_2", OneOf(vec![vec![0.0, 1.0, 3.0]])),
        (
            "lcp_CPS_3",
            OneOf(vec![
                vec![1.0 / 10.0, 0.0, 1.0 / 10.0, 0.0],
                vec![0.0, 1.0 / 15.0, 0.0, 1.0 / 15.0],
                vec![1.0 / 90.0, 2.0 / 45.0, 1.0 / 90.0, 2.0 / 45.0],
            ]),
        ),
        ("lcp_CPS_5", Equations(vec![(vec![-1.0, 1.0], 1.0)])),
        ("lcp_deudeu", OneOf(vec![vec![4.0 / 3.0, 7.0 / 3.0]])),
        ("lcp_trivial", OneOf(vec![trivial])),
        ("lcp_ortiz", OneOf(vec![vec![2.0 / 3.0, 0.0, 1.0 / 3.0, 0.0]])),
        (
            "lcp_inf_sol_perturbed",
            Equations(vec![(vec![1.0, 0.0, 0.0], 1.0), (vec![0.0, -1.0, 1.0], 1e-4)]),
        ),
        ("lcp_exp_murty2", OneOf(vec![vec![0.0, 0.0, 0.0, 0.0, 0.0, 64.0]])),
        ("lcp_mmc", Sum { of: all, sum: 1.53002195098466e-3, positive: 22 }),
        ("m3n2_mlcp", OneOf(vec![vec![1.0, -1.0, 0.0, 4.0, 0.0]])),
        ("PDSym_mlcp", Rounded(pd_sym)),
        ("relay2_mlcp", OneOf(vec![vec![10.0, -1.4, 0.0, -0.014, 9.999, 3.0]])),
        ("RCD_mlcp", Residuals),
        ("diodeBridge_mlcp", Residuals),
        (
            "FrictionContactProblem00031",
            Sum { of: normal_force, sum: 6.34608856152e-4, positive: 1 },
        ),
        ("FrictionContactProblem00374", Sum { of: normal_force, sum: 1624.54273209, positive: 10 }),
        (
            "FC2D_SliderCrankLagrangian00000",
            Sum { of: normal_force, sum: 0.11100381623, positive: 2 },
        ),
    ]
}

/// Digits to which the published numbers and the answers agree.
const PRECISION: f64 = 1e-8;

/// The published problems, where their files are at hand.
fn problems() -> Vec<(&'static str, Problem, Answer)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/lcp-problems");
    if !folder.is_dir() {
        eprintln!("the published problems are not at hand: nothing is tested");
        return Vec::new();
    }
    let read = |name| read_file(&folder.join(name).with_extension("dat"), None).unwrap().problem;
    published().into_iter().map(|(name, answer)| (name, read(name), answer)).collect()
}

/// Whether `(z, w)` is as the answer says.
fn agrees(answer: &Answer, z: &[f64]) -> Result<(), String> {
    let size = z.iter().fold(0.0_f64, |max, z| max.max(z.abs()));
    let near = |x: f64, y: f64, unit: f64| (x - y).abs() <= PRECISION * unit;
    match answer {
        Answer::OneOf(points) => {
            let is = |point: &Vec<f64>| point.iter().zip(z).all(|(x, y)| near(*x, *y, size));
            if points.iter().any(is) { Ok(()) } else { Err(format!("z = {z:?}")) }
        }
        Answer::Equations(equations) => {
            for (row, value) in equations {
                let sum: f64 = row.iter().zip(z).map(|(a, z)| a * z).sum();
                if !near(sum, *value, size) {
                    return Err(format!("{row:?} z = {sum}, but not {value}"));
                }
            }
            Ok(())
        }
        Answer::Sum { of, sum, positive } => {
            let z: Vec<f64> = (0..z.len()).filter(|&i| of(i)).map(|i| z[i]).collect();
            let found: f64 = z.iter().sum();
            // Others may be as large as they like, as the sliding of a contact without a force.
            let count = z.iter().filter(|z| **z > PRECISION * found).count();
            if near(found, *sum, *sum) && count == *positive {
                return Ok(());
            }
            Err(format!("{count} positive entries with the sum {found}"))
        }
        Answer::Rounded(point) => {
            let is = point.iter().zip(z).all(|(x, y)| (x - y).abs() <= 0.51e-6);
            if is { Ok(()) } else { Err(format!("z = {z:?}")) }
        }
        Answer::Residuals => Ok(()),
    }
}

/// What a point misses: rows as a part of their terms, negative variables and the smaller ones of two positive ones as
/// what they are of the rows. Terms are at least as large as the right-hand side, which the units of the files allow:
/// where rows were mixed, a row of which all terms vanish at the solution has nothing but errors.
fn missed(problem: &HorizontalLcp, (t, y): (&[f64], &[f64])) -> f64 {
    let n = problem.order();
    let (a, b, c) = (problem.a(), problem.b(), problem.c());
    let least = c.iter().fold(0.0_f64, |max, c| max.max(c.abs()));
    let terms = |i: usize| (0..n).flat_map(move |j| [a[(i, j)] * t[j], b[(i, j)] * y[j]]);
    let sizes: Vec<f64> = (0..n).map(|i| terms(i).map(f64::abs).sum::<f64>().max(least)).collect();
    let rows = (0..n).map(|i| (terms(i).sum::<f64>() - c[i]).abs() / sizes[i]);
    let part = |matrix: &Matrix, j: usize, x: f64| {
        (0..n).map(|i| (matrix[(i, j)] * x).abs() / sizes[i]).fold(0.0, f64::max)
    };
    let pairs = (0..n).map(|j| {
        let (of_t, of_y) = (part(a, j, t[j]), part(b, j, y[j]));
        let negative = |v: f64, part: f64| if v < 0.0 { part } else { 0.0 };
        of_t.min(of_y).max(negative(t[j], of_t)).max(negative(y[j], of_y))
    });
    rows.chain(pairs).fold(0.0, f64::max)
}

/// How a form of a problem ended.
enum End {
    Right,
    Open(String),
    Wrong(String),
}

/// Solves an equivalent problem and judges its solution as one of the original problem. Every one has a solution.
fn end(original: &Problem, equivalent: &Equivalent, answer: &Answer) -> End {
    let solution = Auto::default().solve(&equivalent.problem).unwrap();
    match solution.status {
        Status::Solved => {}
        Status::Infeasible => return End::Wrong("called infeasible".to_owned()),
        status => return End::Open(status.to_string()),
    }
    let (t, y) = (equivalent.back)(&(solution.t, solution.y));
    // Small rows lose their digits where they are mixed with large ones.
    let missed = if equivalent.are_rows_mixed {
        missed(&original.to_general(), (&t, &y))
    } else {
        original.to_general().residuals(&t, &y).worst()
    };
    if missed > PRECISION {
        return End::Wrong(format!("the original problem is not solved: {missed:e}"));
    }
    let (z, _) = original.recover(&t, &y);
    agrees(answer, &z).map_or_else(End::Wrong, |()| End::Right)
}

/// Every published problem in forms of every class: no answer is wrong, and of fifty forms one may be left open.
#[test]
fn published_problems_in_all_forms() {
    let (mut count, mut wrong, mut open) = (0, Vec::new(), Vec::new());
    for (class, forms) in CLASSES {
        for (number, (name, problem, answer)) in problems().into_iter().enumerate() {
            let mut random = Random::new(number as u64);
            for form in forms(&mut random, &Equivalent::original(problem.to_general())) {
                count += 1;
                match end(&problem, &form, &answer) {
                    End::Right => {}
                    End::Open(status) => open.push(format!("{name}, {class}: {status}")),
                    End::Wrong(why) => wrong.push(format!("{name}, {class}, {}: {why}", form.name)),
                }
            }
        }
    }
    eprintln!("{count} forms, {} left open\n{}", open.len(), open.join("\n"));
    assert!(wrong.is_empty(), "{} of {count} wrong\n{}", wrong.len(), wrong.join("\n"));
    assert!(50 * open.len() <= count, "{} of {count} left open\n{}", open.len(), open.join("\n"));
}
