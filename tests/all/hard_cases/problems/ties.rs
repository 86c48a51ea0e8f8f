//! Ties, cycles, and pairs of which both variables vanish.

use lcp::Lcp;
use lcp::faer::Mat;
use lcp_problems::families;

use super::case::Case;
use super::data::{degenerate, gram, standard, with_solution};
use super::problem::Problem;

pub const TITLE: &str = "Ties and cycles";

pub fn cases() -> Vec<Case> {
    let ties = "Ratios tie at every pivot, and without a rule for ties the path can cycle.";
    let vanish = "Both variables of many pairs are zero (no gap and no force), and rounding decides their signs.";
    vec![
        Case::of("Kostreva", ties, families::kostreva_1(), (Problem::Standard, 10.0))
            .parameters("`families::kostreva_1()`: P-matrix, n = 3, `q = -1`, cycles under the plain ratio test")
            .enumerated(),
        program("Beale", ties, &BEALE).parameters(
            "linear program of 4 variables and 3 conditions on which the simplex method cycles (Beale 1955), n = 7",
        ),
        program("Chvatal", ties, &CHVATAL).parameters("another one of 4 variables and 3 conditions (Chvatal 1983, chapter 3), n = 7"),
        assignment(ties),
        Case::of("groups of ones", ties, families::ties(30, 1), (Problem::Standard, 1.0))
            .parameters("`families::ties(30, 1)`: `m_ij = 1` within ten groups"),
        planted("half of the pairs vanish", vanish, 30, 5),
        planted("nine tenths of the pairs vanish", vanish, 60, 9),
        Case::of(
            "half of the pairs vanish, semidefinite",
            vanish,
            families::positive_semidefinite(30, 1),
            (Problem::Standard, 1.0),
        )
        .parameters("`families::positive_semidefinite(30, 1)`, of rank 15, not symmetric"),
        touching(vanish),
    ]
}

/// `min c.x` for `R x <= b`, `x >= 0`: both right-hand sides and `c` after the rows of `R`.
struct Program {
    rows: [[f64; 4]; 3],
    bounds: [f64; 3],
    costs: [f64; 4],
}

/// E. M. L. Beale, Cycling in the dual simplex algorithm (1955).
const BEALE: Program = Program {
    rows: [[0.25, -8.0, -1.0, 9.0], [0.5, -12.0, -0.5, 3.0], [0.0, 0.0, 1.0, 0.0]],
    bounds: [0.0, 0.0, 1.0],
    costs: [-0.75, 20.0, -0.5, 6.0],
};

/// V. Chvatal, Linear Programming (1983), chapter 3.
const CHVATAL: Program = Program {
    rows: [[0.5, -5.5, -2.5, 9.0], [0.5, -1.5, -0.5, 1.0], [1.0, 0.0, 0.0, 0.0]],
    bounds: [0.0, 0.0, 1.0],
    costs: [-10.0, 57.0, 9.0, 24.0],
};

/// The conditions of a linear program: `M = [0 R^T; -R 0]`.
fn program(name: &str, why: &'static str, it: &Program) -> Case {
    let m = Mat::from_fn(7, 7, |i, j| match (i < 4, j < 4) {
        (true, false) => it.rows[j - 4][i],
        (false, true) => -it.rows[i - 4][j],
        _ => 0.0,
    });
    let q = it.costs.iter().chain(&it.bounds).copied().collect();
    Case::new(name, why, standard(m, q)).enumerated()
}

/// Workers and tasks, each at least once: `M = [0 -R^T; R 0]`.
fn assignment(why: &'static str) -> Case {
    const SIDE: usize = 6;
    let (pairs, n) = (SIDE * SIDE, SIDE * SIDE + 2 * SIDE);
    let covers = |row: usize, pair: usize| {
        let covered = if row < SIDE { pair / SIDE } else { SIDE + pair % SIDE };
        if covered == row { 1.0 } else { 0.0 }
    };
    let m = Mat::from_fn(n, n, |i, j| match (i < pairs, j < pairs) {
        (true, false) => -covers(j - pairs, i),
        (false, true) => covers(i - pairs, j),
        _ => 0.0,
    });
    let cost =
        |pair: usize| f64::from(u8::try_from(1 + (pair / SIDE) * (pair % SIDE) % 5).unwrap());
    let q = (0..n).map(|i| if i < pairs { cost(i) } else { -1.0 }).collect();
    Case::new("assignment", why, standard(m, q))
        .parameters("six workers and six tasks, costs `1 + (i j mod 5)`: a linear program, n = 48")
        .solvable("several solutions, the optima of a linear program")
}

fn planted(name: &str, why: &'static str, n: usize, tenths: usize) -> Case {
    let point = degenerate(n, tenths);
    let parameters = format!(
        "positive definite, `M = C C^T + 1` with `c_ij = s_ij`, n = {n}; of the planted pairs those with `3 i mod 10 < {tenths}` vanish"
    );
    Case::new(name, why, with_solution(gram(n), &point)).parameters(&parameters).unique(point, 1e4)
}

/// A membrane that touches its obstacle everywhere around a bubble, without pressing on it.
fn touching(why: &'static str) -> Case {
    let planted = families::obstacle(12);
    let families::KnownAnswer::Unique { t, .. } = planted.known else {
        unreachable!("one solution")
    };
    let m = planted.problem.m().clone();
    let q: Vec<f64> =
        (0..t.len()).map(|i| -m.column(i).map(|(j, v)| v * t[j]).sum::<f64>()).collect();
    let y = vec![0.0; t.len()];
    Case::new("membrane that touches", why, Problem::Standard(Lcp::new(m, q).unwrap()))
        .parameters("the matrix of `families::obstacle(12)` and its gap, a paraboloid over a disc, but no pressure anywhere")
        .unique((t, y), 1e3)
}
