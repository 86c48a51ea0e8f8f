//! The smallest problems, and zeros.

use lcp::HorizontalLcp;
use lcp::faer::{Mat, mat};

use super::case::Case;
use super::data::{dominant, standard};
use super::problem::Problem;

pub const TITLE: &str = "Empty problems, order one, and zeros";

pub fn cases() -> Vec<Case> {
    let small = "Some step of every method assumes that the problem is not empty.";
    let zero = "All entries that a method could divide by are zero.";
    let zeros = |n: usize| Mat::<f64>::zeros(n, n);
    let mut list = vec![
        Case::new("order 0", small, standard(Mat::new(), Vec::new()))
            .parameters("no pairs")
            .unique((Vec::new(), Vec::new()), 1.0),
    ];
    for (m, q) in [(1.0, -1.0), (1.0, 0.0), (-1.0, 1.0), (-1.0, -1.0), (0.0, 0.0), (0.0, -1.0)] {
        let name = format!("order 1, `M = {m}`, `q = {q}`");
        list.push(Case::new(&name, small, standard(mat![[m]], vec![q])).enumerated());
    }
    let general = |c: f64| HorizontalLcp::new(zeros(3), zeros(3), vec![c; 3]).unwrap();
    list.extend([
        Case::new("`M = 0`, `q >= 0`", zero, standard(zeros(3), vec![2.0, 0.0, 1.0])).enumerated(),
        Case::new("`M = 0`, one negative `q`", zero, standard(zeros(3), vec![2.0, 0.0, -1.0]))
            .enumerated(),
        Case::new("`q = 0`, P-matrix", zero, standard(dominant(6), vec![0.0; 6])).enumerated(),
        Case::new(
            "`q = 0`, indefinite",
            zero,
            standard(mat![[0.0, 1.0], [-1.0, -1.0]], vec![0.0; 2]),
        )
        .enumerated(),
        Case::new("`A = B = 0`, `c = 0`", zero, Problem::General(general(0.0))).enumerated(),
        Case::new("`A = B = 0`, `c = 1`", zero, Problem::General(general(1.0))).enumerated(),
    ]);
    list
}
