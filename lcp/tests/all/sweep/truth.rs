//! What is true of a problem, and what a verdict is worth in this light.

use lcp::{Certificate, HorizontalLcp, Leaf, Side, Solution, Status};
use lcp_problems::exact::{EnumerationSettings, ExactEnumeration, Face, RBig, enumerate};

use super::methods::TOLERANCE;
use super::problems::Case;

/// What a point may miss: of a row, in units of its terms or of the largest entry of the right-hand
/// side. The problems are small integers, so that answers have all but the last digits.
const ROUNDING: f64 = 1e-9;
/// The same of a point far out, where terms are large compared with the right-hand side.
const FAR: f64 = 1e-6;
/// Above this part of a row a variable is not zero.
const POSITIVE: f64 = 1e-7;
/// Of the products of a proof, relative to their terms.
const PROOF: f64 = 1e-12;

/// What a verdict is worth.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Worth {
    /// Right: a solution, a proof, or that there is no solution.
    Right,
    /// The right verdict, but of an infeasible problem, which has a proof, none is given.
    Unproved,
    /// No verdict.
    Open(String),
    Wrong(String),
}

pub(crate) fn truth(problem: &HorizontalLcp) -> ExactEnumeration {
    let limits = EnumerationSettings { max_order: 8, max_generators: 1_000_000, time_limit: None };
    enumerate(problem, &limits).unwrap()
}

pub(crate) fn worth(case: &Case, truth: &ExactEnumeration, solution: &Solution) -> Worth {
    let is_solvable = truth.is_solvable();
    match solution.status {
        Status::Solved if !is_solvable => {
            Worth::Wrong(format!("solved without a solution by {:?}", solution.t))
        }
        Status::Solved => {
            let scaled = |v: &[f64], units: &[f64]| -> Vec<f64> {
                v.iter().zip(units).map(|(v, unit)| v * unit).collect()
            };
            let (t, y) = (scaled(&solution.t, &case.units.0), scaled(&solution.y, &case.units.1));
            let judged = case.problem.residual_of(solution);
            if judged > TOLERANCE {
                return Worth::Wrong(format!("solved, but the judge says {judged:e}: {t:?} {y:?}"));
            }
            defect(case, truth, &t, &y).map_or(Worth::Right, Worth::Wrong)
        }
        Status::Infeasible if truth.is_feasible() => {
            Worth::Wrong(format!("infeasible, but feasible: {:?}", solution.certificate))
        }
        Status::NoSolution if is_solvable => {
            Worth::Wrong(format!("no solution, but there is one: {:?}", solution.certificate))
        }
        Status::Infeasible | Status::NoSolution => match &solution.certificate {
            Some(certificate) => of_proof(&case.general, truth, certificate),
            None => Worth::Unproved,
        },
        status => Worth::Open(status.to_string()),
    }
}

fn exact(value: f64) -> RBig {
    RBig::try_from(value).unwrap_or(RBig::ZERO)
}

fn rounded(value: &RBig) -> f64 {
    value.to_f64().value()
}

/// What is wrong with a point. The rows are summed up without rounding, and there must be exact
/// solutions in which the same variables are positive.
fn defect(case: &Case, truth: &ExactEnumeration, t: &[f64], y: &[f64]) -> Option<String> {
    let (problem, largest) = (&case.integers, case.largest);
    if t.iter().chain(y).any(|v| !v.is_finite()) {
        return Some(format!("not a number: {t:?} {y:?}"));
    }
    let n = problem.order();
    let point = || format!("t = {t:?}, y = {y:?}");
    let columns = || {
        let a = (0..n).map(|j| (problem.a(), j, t[j]));
        a.chain((0..n).map(|j| (problem.b(), j, y[j])))
    };
    // A row is met to a part of a variable that is in no other row: that variable is what the row makes it.
    let mut slack = vec![0.0_f64; n];
    for (matrix, j, x) in columns() {
        let mut entries = matrix.column(j).filter(|(_, v)| *v != 0.0);
        if let (Some((i, v)), None) = (entries.next(), entries.next()) {
            slack[i] = slack[i].max((v * x).abs());
        }
    }
    let mut sizes = vec![0.0; n];
    for i in 0..n {
        let c = problem.c()[i];
        let mut sum = exact(-c);
        let mut size = c.abs();
        for (matrix, j, x) in columns() {
            sum += exact(matrix[(i, j)]) * exact(x);
            size += (matrix[(i, j)] * x).abs();
        }
        sizes[i] = size.max(largest);
        let missed = rounded(&sum).abs();
        let is_far = largest > 0.0 && missed > (FAR * largest).max(ROUNDING * slack[i]);
        if missed > ROUNDING * sizes[i] || is_far {
            return Some(format!("row {i} misses by {missed:e}: {}", point()));
        }
    }
    // How much of a row a variable is; all of it where it is in no row.
    let part = |matrix: &lcp::Matrix, j: usize, x: f64| {
        let parts = (0..n).filter(|&i| matrix[(i, j)] != 0.0 && x != 0.0);
        let part = parts.map(|i| (matrix[(i, j)] * x).abs() / sizes[i]).reduce(f64::max);
        part.unwrap_or(if x == 0.0 { 0.0 } else { 1.0 })
    };
    let parts: Vec<f64> = columns().map(|(matrix, j, x)| part(matrix, j, x)).collect();
    for (j, (&t, &y)) in t.iter().zip(y).enumerate() {
        let (of_t, of_y) = (parts[j], parts[n + j]);
        if (t < 0.0 && of_t > ROUNDING) || (y < 0.0 && of_y > ROUNDING) {
            return Some(format!("pair {j} is negative: {}", point()));
        }
        if t > 0.0 && y > 0.0 && of_t.min(of_y) > ROUNDING {
            return Some(format!("pair {j} is not complementary: {}", point()));
        }
    }
    let is_positive: Vec<bool> = parts.iter().map(|part| *part > POSITIVE).collect();
    let covers = |face: &Face| {
        let points = || face.vertices.iter().chain(&face.rays);
        let has = |k: usize| {
            points().any(|p| if k < n { p.t[k] > RBig::ZERO } else { p.y[k - n] > RBig::ZERO })
        };
        (0..2 * n).all(|k| !is_positive[k] || has(k))
    };
    let is_found = truth.faces.iter().any(covers);
    (!is_found).then(|| format!("no solution has these positive variables: {}", point()))
}

/// An infeasible problem has a Farkas vector; others without a solution need one for every choice.
fn of_proof(problem: &HorizontalLcp, truth: &ExactEnumeration, certificate: &Certificate) -> Worth {
    let wrong = match certificate {
        Certificate::Farkas { pi } => no_proof(problem, &vec![None; problem.order()], pi),
        Certificate::Choices { .. } if !truth.is_feasible() => return Worth::Unproved,
        Certificate::Choices { leaves } => no_choices(problem, leaves),
        other => Some(format!("no proof: {other:?}")),
    };
    let holds = certificate.holds(problem);
    let refused = (!holds).then(|| format!("the library does not accept {certificate:?}"));
    wrong.or(refused).map_or(Worth::Right, Worth::Wrong)
}

/// What keeps vectors from being a proof for every choice of one side of every pair.
fn no_choices(problem: &HorizontalLcp, leaves: &[Leaf]) -> Option<String> {
    let n = problem.order();
    let is_in = |choice: u32, leaf: &Leaf| {
        let sides = leaf.sides.iter().enumerate();
        sides
            .into_iter()
            .all(|(j, side)| side.is_none_or(|side| (side == Side::T) == (choice >> j & 1 == 1)))
    };
    let is_covered = |choice: u32| leaves.iter().any(|leaf| is_in(choice, leaf));
    match (0..1 << n).find(|&choice| !is_covered(choice)) {
        Some(choice) => Some(format!("the choice {choice:b} is not excluded")),
        None => leaves.iter().find_map(|leaf| no_proof(problem, &leaf.sides, &leaf.pi)),
    }
}

/// What keeps a vector from being a proof that columns of these sides cannot reach the right-hand side, by sums without
/// rounding.
fn no_proof(problem: &HorizontalLcp, sides: &[Option<Side>], pi: &[f64]) -> Option<String> {
    let n = problem.order();
    if pi.len() != n || pi.iter().any(|v| !v.is_finite()) {
        return Some(format!("no Farkas vector of {n} rows: {pi:?}"));
    }
    let product = |entry: &dyn Fn(usize) -> f64| {
        let terms = || (0..n).map(|i| exact(entry(i)) * exact(pi[i]));
        let size = (0..n).map(|i| (entry(i) * pi[i]).abs()).sum::<f64>();
        (rounded(&terms().fold(RBig::ZERO, |sum, v| sum + v)), size)
    };
    for (name, matrix, side) in [("A", problem.a(), Side::T), ("B", problem.b(), Side::Y)] {
        for j in (0..n).filter(|&j| sides[j].is_none_or(|chosen| chosen == side)) {
            let (sum, size) = product(&|i| matrix[(i, j)]);
            if sum > PROOF * size {
                return Some(format!("{pi:?} times column {j} of {name} is {sum:e}"));
            }
        }
    }
    let (sum, size) = product(&|i| problem.c()[i]);
    (sum <= PROOF * size).then(|| format!("{pi:?} times c is {sum:e}"))
}
