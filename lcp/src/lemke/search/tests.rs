use faer::Mat;

use super::*;
use crate::{Lcp, Lemke, Solver, families};

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

/// A game has a ray for every covering vector: the column of a pair comes second, and no proof is searched.
#[test]
fn a_game_takes_two_attempts() {
    for seed in 0..5 {
        let game = families::bimatrix(4, 5, seed).problem;
        let solution = Lemke::default().solve(&game).expect("default settings");
        assert!(solution.is_solved(), "{}", solution.status);
        let ends: Vec<_> = solution.info.attempts.iter().map(|it| (it.covering, it.end)).collect();
        let pair = AttemptCovering::Column { pair: 0 };
        let of_first = (AttemptCovering::Ones, AttemptEnd::Ray);
        assert_eq!(ends, [of_first, (pair, AttemptEnd::Complementary)]);
    }
}

/// A step of the descent takes the columns of all pairs, which in large problems is minutes for all steps.
#[test]
fn flips_end_when_the_time_is_over() {
    let problem = HorizontalLcp::from(families::indefinite(12, 1).problem);
    let settings = LemkeSettings::default();
    let search = Search::new(&settings, &problem, None);
    let all_y = Basis::all(Side::Y, 12);
    let start = search.problem.start(&all_y).expect("the unit matrix");
    assert_ne!(start.flipped(3, None), all_y);
    assert_eq!(start.flipped(3, Some(Instant::now())), all_y);
}
