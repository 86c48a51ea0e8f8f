//! Problems without a solution, and those that are nearly so.

use lcp::Lcp;
use lcp::faer::{Mat, mat};
use lcp_problems::families;

use super::case::Case;
use super::data::{block, body, standard};
use super::problem::Problem;

pub const TITLE: &str = "No solution";

pub fn cases() -> Vec<Case> {
    let proved = "There is no solution; this has to be proved.";
    let near = "Of two problems with nearly equal data, one has a solution and the other has none.";
    let open =
        "The linear conditions can be met, but not with complementarity: no Farkas vector exists.";
    let [hair, fine, finer] = [-18, -28, -30].map(|power| 2_f64.powi(power));
    let push = |force: f64| body([0.0, 0.0], [force, -8.0], &[[0.0, 1.0]], 0.5);
    let words = "rigid, on one plane, weight 8, mu = 0.5, pushed by";
    vec![
        Case::of("Kostreva without a solution", proved, families::kostreva_2(), STANDARD)
            .parameters("`families::kostreva_2()`: `w_3 = -z_1 - 2 z_2 - 1`, n = 3")
            .enumerated(),
        Case::of(
            "semidefinite without a solution",
            proved,
            families::infeasible_semidefinite(20, 1),
            STANDARD,
        )
        .parameters("`families::infeasible_semidefinite(20, 1)`"),
        Case::of(
            "horizontal without a solution",
            proved,
            families::infeasible(20, 1),
            (Problem::General, 1.0),
        )
        .parameters("`families::infeasible(20, 1)`"),
        Case::new("rigid block that nothing holds", proved, lifted())
            .parameters("on supports at -1 and 1, pulled up by 1, mu = 0.5")
            .enumerated(),
        Case::new("feasible by 4e-6", near, two(hair))
            .parameters("`M = [1 -1; -1 1]`, `q = (-1, 1 + 2^-18)`")
            .enumerated(),
        Case::new("infeasible by 4e-6", near, two(-hair))
            .parameters("the same, `q = (-1, 1 - 2^-18)`")
            .enumerated(),
        Case::new("feasible by 9e-10", near, two(finer))
            .parameters("the same, `q = (-1, 1 + 2^-30)`")
            .enumerated(),
        Case::new("infeasible by 9e-10", near, two(-finer))
            .parameters("the same, `q = (-1, 1 - 2^-30)`")
            .enumerated(),
        Case::new("rigid block at the limit of friction", near, push(4.0))
            .parameters(&format!("{words} 4"))
            .enumerated(),
        Case::new("rigid block below it", near, push(4.0 - hair))
            .parameters(&format!("{words} 4 - 2^-18"))
            .enumerated(),
        Case::new("rigid block above it", near, push(4.0 + hair))
            .parameters(&format!("{words} 4 + 2^-18"))
            .enumerated(),
        Case::new("rigid block barely below it", near, push(4.0 - fine))
            .parameters(&format!("{words} 4 - 2^-28"))
            .enumerated(),
        Case::new("rigid block barely above it", near, push(4.0 + fine))
            .parameters(&format!("{words} 4 + 2^-28"))
            .enumerated(),
        Case::new("not Q0", open, standard(mat![[-1.0, 0.5], [0.0, 1.0]], vec![-1.0, -1.0]))
            .parameters("`M = [-1 1/2; 0 1]`, `q = -1`")
            .enumerated(),
        Case::new("not Q0, of order 6", open, blocks())
            .parameters("three blocks `[-1 1/2; 0 1]` on the diagonal of `M`, `q = -1`")
            .enumerated(),
    ]
}

/// The two rows ask for opposite things, and leave room for the excess.
pub(super) fn two(excess: f64) -> Problem {
    standard(mat![[1.0, -1.0], [-1.0, 1.0]], vec![-1.0, 1.0 + excess])
}

const STANDARD: (fn(Lcp) -> Problem, f64) = (Problem::Standard, 1.0);

fn lifted() -> Problem {
    Problem::Contact(block(&[-1.0, 1.0], [0.0, 1.0, 0.0], 0.5))
}

fn blocks() -> Problem {
    let block = [[-1.0, 0.5], [0.0, 1.0]];
    let m = Mat::from_fn(6, 6, |i, j| if i / 2 == j / 2 { block[i % 2][j % 2] } else { 0.0 });
    standard(m, vec![-1.0; 6])
}
