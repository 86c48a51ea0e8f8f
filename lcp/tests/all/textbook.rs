//! Problems of the literature with known answers.

use faer::{Mat, mat};
use lcp::lemke::AttemptEnd;
use lcp::{
    Auto, Basis, Contact2d, Covering, HorizontalLcp, Lcp, Lemke, LemkeSettings, Side, Solver,
    Status, WarmStart,
};
use lcp_problems::families;

fn lcp(m: Mat<f64>, q: &[f64]) -> HorizontalLcp {
    Lcp::new(m, q.to_vec()).unwrap().into()
}

fn once() -> Lemke {
    Lemke::new(LemkeSettings { max_attempts: Some(1), ..LemkeSettings::default() })
}

fn assert_close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!((f - e).abs() <= 1e-13 * e.abs().max(1.0), "entry {i}: {f} is not {e}");
    }
}

/// Solves with the first attempt alone, and again with q scaled far up and down.
fn assert_solves_at_once(m: &Mat<f64>, q: &[f64], z: &[f64]) {
    for factor in [1.0, 1e-12, 1e12] {
        let scaled: Vec<f64> = q.iter().map(|q| q * factor).collect();
        let solution = once().solve(&lcp(m.clone(), &scaled)).unwrap();
        assert_eq!(solution.status, Status::Solved, "q times {factor}");
        let unscaled: Vec<f64> = solution.t.iter().map(|t| t / factor).collect();
        assert_close(&unscaled, z);
    }
}

#[test]
fn cottle_pang_stone_examples() {
    let m = mat![[2.0, 1.0], [1.0, 2.0]];
    assert_solves_at_once(&m, &[-5.0, -6.0], &[4.0 / 3.0, 7.0 / 3.0]);
    let skew = mat![[0.0, -1.0], [1.0, 0.0]];
    assert_solves_at_once(&skew, &[1.0, -1.0], &[1.0, 1.0]);
}

/// Cycles under the plain ratio test (Kostreva 1979): the lexicographic rule does not.
#[test]
fn kostreva_does_not_cycle() {
    let kostreva = families::kostreva_1().problem;
    assert_solves_at_once(&kostreva.m().to_dense(), kostreva.q(), &[1.0 / 3.0; 3]);
}

/// Its third row alone, `w3 = -z1 - 2 z2 - 1`, has no solution.
#[test]
fn kostreva_without_a_solution_is_proved_infeasible() {
    let problem = families::kostreva_2().problem;
    let solution = Lemke::default().solve(&problem).unwrap();
    assert_eq!(solution.status, Status::Infeasible);
    assert_eq!(solution.farkas(), Some(&[0.0, 0.0, -1.0][..]));
}

/// `w1 = -z1 + z2 / 2 - 1`, `w2 = z2 - 1`: feasible, but without a complementary solution.
#[test]
fn rays_where_there_is_no_proof() {
    let problem = lcp(mat![[-1.0, 0.5], [0.0, 1.0]], &[-1.0; 2]);
    let solution = Lemke::default().solve(&problem).unwrap();
    assert_eq!(solution.status, Status::RayTermination);
    assert_eq!(solution.farkas(), None);
    assert!(solution.info.attempts.iter().any(|attempt| attempt.end == AttemptEnd::Ray));
    let ray = solution.ray().unwrap();
    assert!(ray.dt.iter().chain(&ray.dy).all(|&v| v >= 0.0));
    assert!(ray.dt.iter().zip(&ray.dy).all(|(t, y)| t * y == 0.0));
}

#[test]
fn the_ray_is_a_direction_of_the_augmented_problem() {
    let m = mat![[-1.0, 0.5], [0.0, 1.0]];
    let problem = lcp(m, &[-1.0, -1.0]);
    let covering = Covering::Given(vec![1.0, 3.0]);
    let settings = LemkeSettings { max_attempts: Some(1), covering, ..LemkeSettings::default() };
    let ray = Lemke::new(settings).solve(&problem).unwrap().ray().unwrap().clone();
    assert_eq!(ray.covering, [1.0, 3.0]);
    for i in 0..2 {
        let image: f64 =
            (0..2).map(|j| problem.a()[(i, j)] * ray.dt[j] + problem.b()[(i, j)] * ray.dy[j]).sum();
        assert!((image - ray.covering[i] * ray.dz0).abs() < 1e-14, "row {i}: {image}");
    }
}

/// A pair that demands a negative value is not forgiven because another is large.
#[test]
fn infeasible_whatever_the_size_of_the_others() {
    for s in [1.0, 1e6, 1e9, 1e12, 1e14] {
        let b = mat![[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, -1.0]];
        let problem = HorizontalLcp::new(Mat::identity(3, 3), b, vec![-s, -1.0, s]).unwrap();
        let solution = Lemke::default().solve(&problem).unwrap();
        assert_ne!(solution.status, Status::Solved, "s = {s}: {:?}", solution.t);
    }
}

/// The second factorisation sees only rounding errors of the first.
#[test]
fn a_start_basis_is_found_where_rounding_looks_like_rank() {
    let a = mat![[0.0, 2.0], [-1.0, 2.0]];
    let b = mat![[-1.0, 2.0], [-1.0, 2.0]];
    let problem = HorizontalLcp::new(a, b, vec![2.0, 1.0]).unwrap();
    assert_eq!(once().solve(&problem).unwrap().status, Status::Solved);
}

#[test]
fn zero_solves_a_homogeneous_problem() {
    let zero = Mat::<f64>::zeros(2, 2);
    let problem = HorizontalLcp::new(zero.clone(), zero, vec![0.0; 2]).unwrap();
    assert_eq!(once().solve(&problem).unwrap().status, Status::Solved);
}

/// Murty's and Fathi's problems take exactly 2^n lexicographic pivots with a covering vector of ones in
/// the data as given, nearly all of them at ties, and stop at the limit on pivots when it is lower.
/// Murty's last pair is alone in its row up to the others' terms, `w = z + ...`, so that `z - w` is a free
/// variable, and the path is that of order `n - 1`.
#[test]
fn exponential_families_take_their_pivots_or_stop_at_the_limit() {
    for n in [3_usize, 6, 9] {
        let ones = LemkeSettings {
            start: WarmStart::Basis(Basis::all(Side::Y, n)),
            covering: Covering::Given(vec![1.0; n]),
            max_attempts: Some(1),
            ..LemkeSettings::default()
        };
        let limited = LemkeSettings { max_pivots: Some(3), ..ones.clone() };
        let mut first = vec![0.0; n];
        first[0] = 1.0;
        for (instance, order) in [(families::murty(n), n - 1), (families::fathi(n), n)] {
            let problem = instance.problem;
            let solution = Lemke::new(ones.clone()).solve(&problem).unwrap();
            assert_eq!(solution.status, Status::Solved);
            assert_close(&solution.t, &first);
            assert_eq!(solution.info.pivots, 1 << order);
            let stopped = Lemke::new(limited.clone()).solve(&problem).unwrap();
            assert_eq!((stopped.status, stopped.info.pivots), (Status::PivotLimit, 3));
        }
    }
}

/// A continuum of solutions, `z1 + z2 = 1`: any of them is right.
#[test]
fn a_continuum_is_met() {
    let solution = once().solve(&lcp(Mat::full(2, 2, 1.0), &[-1.0, -1.0])).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_close(&[solution.t[0] + solution.t[1]], &[1.0]);
}

#[test]
fn order_one() {
    let solve = |m: f64, q: f64| Lemke::default().solve(&lcp(mat![[m]], &[q])).unwrap();
    assert_eq!(solve(-1.0, -1.0).status, Status::Infeasible);
    assert_eq!(solve(0.0, -1.0).status, Status::Infeasible);
    assert_eq!(solve(-1.0, 1.0).status, Status::Solved);
    assert_close(&solve(2.0, -1.0).t, &[0.5]);
    assert_close(&solve(2.0, 1.0).y, &[1.0]);
}

#[test]
fn an_empty_problem_is_solved() {
    let problem = HorizontalLcp::new(Mat::new(), Mat::new(), Vec::new()).unwrap();
    assert_eq!(Lemke::default().solve(&problem).unwrap().status, Status::Solved);
}

/// Both matrices singular: pair 1 can only start from `t`, pair 2 only from `y`.
#[test]
fn both_matrices_singular() {
    let a = mat![[1.0, 0.0], [2.0, 0.0]];
    let b = mat![[0.0, 0.0], [0.0, 1.0]];
    let problem = HorizontalLcp::new(a, b, vec![1.0, 5.0]).unwrap();
    let solution = once().solve(&problem).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_close(&solution.t, &[1.0, 0.0]);
    assert_close(&solution.y, &[0.0, 3.0]);
}

/// A start basis that solves the problem is not left for the rounding errors of its values.
#[test]
fn a_start_basis_that_solves_the_problem_is_enough() {
    let (a, b) = (mat![[2.0, -1.0], [-3.0, 2.0]], mat![[3.0, 3.0], [-5.0, 2.0]]);
    let problem = HorizontalLcp::new(a, b, vec![3.0, -5.0]).unwrap();
    let solution = once().solve(&problem).unwrap();
    assert_eq!((solution.status, solution.info.pivots), (Status::Solved, 0));
    assert_close(&solution.y, &[1.0, 0.0]);
}

/// `M = [0, 1; 1, 0]`: from all `y` every covering vector ends on a ray, so that the start has to change.
#[test]
fn bimatrix_games_are_solved() {
    let swap = mat![[0.0, 1.0], [1.0, 0.0]];
    let solution = Lemke::default().solve(&lcp(swap, &[-1.0, -1.0])).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_close(&solution.t, &[1.0, 1.0]);
}

/// With a condition number of 4e9 the second value, 2e-6, lies below the error that rounding of the
/// data makes, and is a value all the same.
#[test]
fn small_values_of_ill_conditioned_problems_are_kept() {
    let problem =
        lcp(mat![[1.0, 1.0], [1.0, 1.0 + 1e-9]], &[-1.0 - 2e-6, -1.0 - 2e-6 * (1.0 + 1e-9)]);
    let start = WarmStart::Basis(Basis::all(Side::T, 2));
    let settings = LemkeSettings { start, max_attempts: Some(1), ..LemkeSettings::default() };
    let solution = Lemke::new(settings).solve(&problem).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert!(solution.residuals.worst() <= 1e-14, "{:?}", solution.residuals);
}

/// Only an exchange finds the start basis: column choices that look best block each other.
#[test]
fn the_start_basis_needs_an_exchange() {
    // Pair 1: (e1, e2), pair 2: (e1, 0), so pair 1 must give way and start from e2.
    let a = mat![[1e-3, 1.0], [0.0, 0.0]];
    let b = mat![[0.0, 0.0], [1e3, 0.0]];
    let swapped = HorizontalLcp::new(b.clone(), a.clone(), vec![1.0, 2.0]).unwrap();
    let problem = HorizontalLcp::new(a, b, vec![1.0, 2.0]).unwrap();
    for problem in [problem, swapped] {
        let solution = once().solve(&problem).unwrap();
        assert_eq!(solution.status, Status::Solved);
    }
}

/// Columns that are all the same, so that two of them never make a basis.
#[test]
fn artificial_columns_complete_a_basis() {
    let ones = Mat::full(2, 2, 1.0);
    let problem = HorizontalLcp::new(ones.clone(), ones.clone(), vec![1.0, 1.0]).unwrap();
    let solution = Lemke::default().solve(&problem).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_close(&[solution.t.iter().chain(&solution.y).sum::<f64>()], &[1.0]);

    let outside = HorizontalLcp::new(ones.clone(), ones.clone(), vec![1.0, 2.0]).unwrap();
    let solution = Lemke::default().solve(&outside).unwrap();
    assert_eq!(solution.status, Status::Infeasible);
    let pi = solution.farkas().unwrap();
    assert_close(&[pi[0] + pi[1]], &[0.0]);
    assert!(pi[0] + 2.0 * pi[1] > 0.0);

    // The part of `c` outside the span is nothing but rounding errors, which prove nothing.
    let a = mat![[0.0, 0.0, -1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let b = mat![[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
    let inside = HorizontalLcp::new(a, b, vec![0.0, 1.0, 0.0]).unwrap();
    let solution = Lemke::default().solve(&inside).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_close(&solution.t, &[0.0, 0.0, 1.0]);

    let negative = HorizontalLcp::new(ones.clone(), ones, vec![-1.0, -1.0]).unwrap();
    let solution = Lemke::default().solve(&negative).unwrap();
    assert_eq!(solution.status, Status::Infeasible);
    assert!(solution.farkas().is_some_and(|pi| pi[0] + pi[1] < 0.0));
}

#[test]
fn misuse_is_an_error() {
    let bad = Lcp::new(mat![[1.0, f64::NAN], [0.0, 1.0]], vec![0.0, 0.0]).unwrap_err();
    assert_eq!(bad.to_string(), "M[0, 1] is NaN: every entry must be finite");
    let bad = Lcp::new(mat![[1.0]], vec![0.0, 0.0]).unwrap_err();
    assert_eq!(bad.to_string(), "M is 1 x 1, but must be 2 x 2");
    let problem = lcp(mat![[1.0]], &[-1.0]);
    let settings = LemkeSettings { tolerance: 0.0, ..LemkeSettings::default() };
    assert!(Lemke::new(settings).solve(&problem).is_err());
    let covering = Covering::Given(vec![-1.0]);
    let settings = LemkeSettings { covering, ..LemkeSettings::default() };
    assert!(Lemke::new(settings).solve(&problem).is_err());
}

/// `1e200 * 1e200` is beyond the range of numbers: the sum of such terms must not look small.
#[test]
fn terms_that_overflow_make_the_residuals_infinite() {
    let problem = HorizontalLcp::new(mat![[1e200]], mat![[-1.0]], vec![1.0])
        .unwrap()
        .residuals(&[1e200], &[0.0]);
    assert!(problem.worst().is_infinite() && problem.natural < 1.0);
    let contact = Contact2d::new(
        mat![[1e200]],
        vec![1.0],
        mat![[1.0]],
        mat![[0.0]],
        vec![0.0],
        vec![0.0],
        vec![0.0],
    )
    .unwrap();
    let state = contact.state(vec![1e150], vec![0.0], vec![0.0]);
    assert!(contact.residuals(&state).worst().is_infinite());
}

/// `w_1 = 1.5e308` at the solution `z = (0, 1/2)`: the sizes of its terms add up to more than the largest number.
#[test]
fn solutions_near_the_largest_number_are_solved() {
    for huge in [1e308, 8e307, 5e300] {
        let problem = lcp(mat![[2.0, huge], [-huge, 2.0]], &[huge, -1.0]);
        let (z, w) = ([0.0, 0.5], [1.5 * huge, 0.0]);
        assert!(problem.residuals(&z, &w).worst() <= 0.0, "{huge:e}");
        assert!(problem.residuals(&[0.0, 0.6], &w).worst() > 0.01, "{huge:e}");
        let solution = Auto::default().solve(&problem).unwrap();
        assert!(solution.is_solved(), "{huge:e}: {}", solution.status);
        assert_eq!((solution.t, solution.y), (z.to_vec(), w.to_vec()));
    }
}
