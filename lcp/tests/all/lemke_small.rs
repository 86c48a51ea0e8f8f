//! Lemke's method on small problems of integers, against enumeration in rational arithmetic.

use std::time::Duration;

use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, mat};
use lcp::lemke::{AttemptCovering, AttemptEnd};
use lcp::{Basis, HorizontalLcp, Lcp, Lemke, LemkeSettings, Side, Solver, Status};
use lcp_problems::exact::{EnumerationSettings, enumerate};
use lcp_problems::families;

/// Xorshift (Marsaglia 2003).
struct Random(u64);

impl Random {
    fn below(&mut self, count: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) % count
    }

    /// From -2 to 2, more than half of them zero.
    fn entry(&mut self) -> f64 {
        let value = self.below(5) as f64 - 2.0;
        if self.below(2) == 0 { 0.0 } else { value }
    }
}

/// Of the general form, of the standard form, or with free variables.
fn random_problem(random: &mut Random) -> HorizontalLcp {
    let n = 1 + usize::try_from(random.below(6)).unwrap();
    let kind = random.below(3);
    let a = Mat::from_fn(n, n, |_, _| random.entry());
    let b = Mat::from_fn(n, n, |i, j| match kind {
        1 => f64::from(u8::from(i == j)),
        2 if j % 2 == 0 => -a[(i, j)],
        _ => random.entry(),
    });
    let c: Vec<f64> = (0..n).map(|_| random.entry()).collect();
    HorizontalLcp::new(a, b, c).unwrap()
}

/// Whether `pi . a <= 0` for all columns and `pi . c > 0`, up to rounding, in plain arithmetic.
fn is_proof(problem: &HorizontalLcp, pi: &[f64]) -> bool {
    let product = |v: &dyn Fn(usize) -> f64| {
        let terms = (0..pi.len()).map(|i| v(i) * pi[i]);
        terms.fold((0.0, 0.0), |(sum, size), term: f64| (sum + term, size + term.abs()))
    };
    let is_separated = |(sum, size): (f64, f64)| sum <= 1e-14 * size;
    let (gap, size) = product(&|i| problem.c()[i]);
    gap > 1e-6 * size
        && (0..pi.len()).all(|j| {
            is_separated(product(&|i| problem.a()[(i, j)]))
                && is_separated(product(&|i| problem.b()[(i, j)]))
        })
}

/// Every problem that is infeasible in the linear conditions is proved so, and no other; what is said to be
/// solved has a solution.
#[test]
fn infeasible_problems_are_proved() {
    let mut random = Random(1);
    let mut proved = 0;
    for _ in 0..3000 {
        let problem = random_problem(&mut random);
        let truth = enumerate(&problem, &EnumerationSettings::default()).unwrap();
        let solution = Lemke::default().solve(&problem).unwrap();
        let is_infeasible = solution.status == Status::Infeasible;
        assert_eq!(is_infeasible, !truth.is_feasible(), "{problem:?}");
        if let Some(pi) = solution.farkas() {
            assert!(is_infeasible && is_proof(&problem, pi), "{pi:?} of {problem:?}");
            proved += 1;
        }
        assert!(truth.is_solvable() || !solution.is_solved(), "{problem:?}");
    }
    assert!(3 * proved > 3000, "{proved} proofs");
}

/// Two parallel rows that contradict each other by 1e-9 of the right-hand side.
#[test]
fn a_small_contradiction_is_proved() {
    let m = mat![[1.0, -1.0], [-1.0, 1.0]];
    let problem = Lcp::new(m, vec![-1.0, 1.0 - 1e-9]).unwrap();
    let solution = Lemke::default().solve(&problem).unwrap();
    assert_eq!(solution.status, Status::Infeasible);
    assert!(solution.farkas().is_some_and(|pi| pi[0].total_cmp(&pi[1]).is_eq()));
}

/// Of every pair one column has a single entry, on either side and in any row: that is where it starts.
#[test]
fn columns_with_a_single_entry_are_the_start() {
    let a = mat![[0.0, 1.0, 3.0], [0.0, 1.0, -1.0], [2.0, -1.0, 1.0]];
    let b = mat![[1.0, 0.0, 4.0], [1.0, 3.0, 0.0], [1.0, 0.0, 0.0]];
    let problem = HorizontalLcp::new(a, b, vec![8.0, 3.0, 4.0]).unwrap();
    let solution = Lemke::default().solve(&problem).unwrap();
    let sides = vec![Side::T, Side::Y, Side::Y];
    assert_eq!((solution.status, solution.info.pivots), (Status::Solved, 0));
    assert_eq!(solution.basis, Some(Basis::new(sides)));
    assert_eq!((solution.t, solution.y), (vec![2.0, 0.0, 0.0], vec![0.0, 1.0, 2.0]));
}

/// The search for a start basis looks at the time too: without any left it is not begun.
#[test]
fn the_search_for_a_start_basis_keeps_the_time_limit() {
    let a = mat![[2.0, 1.0], [1.0, 2.0]];
    let b = mat![[-1.0, 1.0], [3.0, -1.0]];
    let problems = [
        HorizontalLcp::new(a.clone(), b.clone(), vec![1.0, -1.0]),
        HorizontalLcp::new(sparse(&a), sparse(&b), vec![1.0, -1.0]),
    ];
    for problem in problems {
        let settings =
            LemkeSettings { time_limit: Some(Duration::ZERO), ..LemkeSettings::default() };
        let solution = Lemke::new(settings).solve(&problem.unwrap()).unwrap();
        assert_eq!(solution.status, Status::TimeLimit);
        assert!(solution.info.attempts.is_empty());
    }
}

fn sparse(m: &Mat<f64>) -> SparseColMat<usize, f64> {
    let places = (0..m.ncols()).flat_map(|j| (0..m.nrows()).map(move |i| (i, j)));
    let entries: Vec<_> = places.map(|(i, j)| Triplet::new(i, j, m[(i, j)])).collect();
    SparseColMat::try_new_from_triplets(m.nrows(), m.ncols(), &entries).unwrap()
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
