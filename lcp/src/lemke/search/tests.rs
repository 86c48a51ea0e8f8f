use faer::Mat;

use super::*;
use crate::Lcp;

/// A chain of springs above an obstacle: the basis that a path may end beside has one contact too few and one too many.
#[test]
fn pairs_with_negative_values_are_exchanged_all_at_once() {
    let n = 6;
    let m = Mat::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    });
    let q = vec![-1.0, 1.0, 1.0, 1.0, -1.0, -1.0];
    let problem = HorizontalLcp::from(Lcp::new(m, q).expect("finite data"));
    let settings = LemkeSettings::default();
    let search = Search::new(&settings, &problem, None);
    let sides = [Side::Y, Side::T, Side::Y, Side::Y, Side::T, Side::T];
    let beside = solve_basis(&search.problem, &Basis::new(sides.to_vec())).expect("definite");
    assert_eq!(beside.negative, [0, 1]);
    let point = search.exchanged(beside);
    assert!(point.residuals.worst() <= f64::EPSILON);
    assert_eq!(point.t, [0.5, 0.0, 0.0, 0.0, 1.0, 1.0]);
}
