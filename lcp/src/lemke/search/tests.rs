use faer::Mat;

use super::*;
use crate::Lcp;
use crate::random::SplitMix;

/// A chain of springs above an obstacle: the last basis of a path may have one contact too few and one too many.
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
    let search = Attempts::new(&settings, &problem, None);
    let sides = [Side::Y, Side::T, Side::Y, Side::Y, Side::T, Side::T];
    let beside = solve_basis(&search.problem, &Basis::new(sides.to_vec())).expect("definite");
    assert_eq!(beside.negative, [0, 1]);
    let point = search.exchanged(beside);
    assert!(point.residuals.worst() <= f64::EPSILON);
    assert_eq!(point.t, [0.5, 0.0, 0.0, 0.0, 1.0, 1.0]);
}

/// A step of the descent takes the columns of all pairs, so that all steps take minutes in large problems.
#[test]
fn flips_end_when_the_time_is_over() {
    let mut random = SplitMix::new(1);
    let m = Mat::from_fn(12, 12, |_, _| 2.0 * random.next_f64() - 1.0);
    let lcp = Lcp::new(m, vec![-1.0; 12]).expect("finite data");
    let problem = HorizontalLcp::from(lcp);
    let settings = LemkeSettings::default();
    let search = Attempts::new(&settings, &problem, None);
    let all_y = Basis::all(Side::Y, 12);
    let start = search.problem.start(&all_y).expect("the unit matrix");
    assert_ne!(start.flipped(3, None), all_y);
    assert_eq!(start.flipped(3, Some(Instant::now())), all_y);
}
