//! Several solutions, and matrices of no class that promises any.

use lcp::faer::{Mat, mat};
use lcp_problems::families;

use super::case::Case;
use super::data::standard;
use super::problem::Problem;

pub const TITLE: &str = "Several solutions";

pub fn cases() -> Vec<Case> {
    let several = "Each of the solutions is right, but no point between them.";
    let copositive =
        "Copositive, but not semidefinite: only Lemke's method is guaranteed to succeed.";
    let minus = Mat::from_fn(6, 6, |i, j| if i == j { -1.0 } else { 0.0 });
    let indefinite = mat![[1.0, 3.0, 0.0], [3.0, 1.0, 2.0], [0.0, 2.0, -1.0]];
    let of =
        |instance: families::Instance<lcp::Lcp>| (instance, (Problem::Standard as fn(_) -> _, 1.0));
    let case = |name: &str, why, (instance, how)| Case::of(name, why, instance, how);
    vec![
        Case::new("every choice is a solution", several, standard(minus, vec![1.0; 6]))
            .parameters("`M = -1`, `q = 1`, n = 6")
            .enumerated(),
        Case::new("indefinite", several, standard(indefinite, vec![-1.0, -1.0, 1.0]))
            .parameters("`M = [1 3 0; 3 1 2; 0 2 -1]`, `q = (-1, -1, 1)`")
            .enumerated(),
        Case::new("two by two, all ones", several, standard(Mat::full(2, 2, 1.0), vec![-1.0; 2]))
            .parameters("`q = -1`: every `z` with `z_1 + z_2 = 1`")
            .enumerated(),
        case("game of four by four", several, of(families::bimatrix(4, 4, 1)))
            .parameters("`families::bimatrix(4, 4, 1)`")
            .enumerated(),
        case("game of twelve by twelve", several, of(families::bimatrix(12, 12, 1)))
            .parameters("`families::bimatrix(12, 12, 1)`")
            .solvable("solvable (Lemke and Howson 1964)"),
        case("strictly copositive", copositive, of(families::strictly_copositive(12, 1)))
            .parameters("`families::strictly_copositive(12, 1)`")
            .enumerated(),
        case("copositive-plus", copositive, of(families::copositive_plus(30, 1)))
            .parameters("`families::copositive_plus(30, 1)`"),
    ]
}
