//! What the theory promises for a class of matrices, and what every answer owes whatever the class.

use crate::common;

use common::cases;
use faer::Mat;
use lcp::{HorizontalLcp, Lcp, Lemke, LemkeSettings, Solution, Solver, Status};
use lcp_problems::exact::{
    EnumerationSettings, ExactEnumeration, ExactVerdict, enumerate, verify_basis,
};
use lcp_problems::families::{self, Instance, KnownAnswer};
use proptest::collection::vec;
use proptest::prelude::*;

/// The promises are for the first path: no second attempt is needed.
fn first_attempt(problem: &HorizontalLcp) -> Solution {
    let once = LemkeSettings { max_attempts: Some(1), ..LemkeSettings::default() };
    Lemke::new(once).solve(problem).unwrap()
}

fn default(problem: &HorizontalLcp) -> Solution {
    Lemke::default().solve(problem).unwrap()
}

fn general(instance: Instance<Lcp>) -> Instance {
    Instance { problem: instance.problem.into(), known: instance.known }
}

/// Solved, and rightly: residuals computed anew, and a small basis in exact arithmetic.
fn assert_solved(problem: &HorizontalLcp, solution: &Solution) {
    assert_eq!(solution.status, Status::Solved, "{:?}", solution.info);
    assert_right(problem, solution);
}

fn assert_right(problem: &HorizontalLcp, solution: &Solution) {
    let (t, y) = (&solution.t, &solution.y);
    assert!(problem.residuals(t, y).worst() <= 1e-10);
    assert!(t.iter().chain(y).all(|&v| v >= 0.0));
    if let (true, Some(basis)) = (problem.order() <= 8, &solution.basis) {
        match verify_basis(problem, basis) {
            ExactVerdict::Solution { .. } => {}
            ExactVerdict::Infeasible { pair, side, relative } => {
                panic!("{side:?} of pair {pair} is {relative}")
            }
            // Only where there is no other.
            ExactVerdict::Singular { .. } => {
                let all = all_solutions(problem);
                assert!(!all.has_basis && all.is_solvable());
            }
        }
    }
}

fn all_solutions(problem: &HorizontalLcp) -> ExactEnumeration {
    let limits = EnumerationSettings { max_order: 16, max_generators: 1_000_000, time_limit: None };
    enumerate(problem, &limits).unwrap()
}

/// Infeasible, with a proof that holds up to rounding.
fn assert_proved_infeasible(problem: &HorizontalLcp) {
    let solution = default(problem);
    assert_eq!(solution.status, Status::Infeasible, "{:?}", solution.info);
    assert_proof(problem, &solution);
}

fn assert_proof(problem: &HorizontalLcp, solution: &Solution) {
    let farkas = solution.farkas().unwrap();
    // Sum and sum of the magnitudes.
    let product = |entry: &dyn Fn(usize) -> f64| {
        let terms = farkas.iter().enumerate().map(|(i, f)| entry(i) * f);
        terms.fold((0.0_f64, 0.0_f64), |(sum, size), v| (sum + v, size + v.abs()))
    };
    for j in 0..problem.order() {
        for (sum, size) in [product(&|i| problem.a()[(i, j)]), product(&|i| problem.b()[(i, j)])] {
            assert!(sum <= 1e-12 * size, "column {j}: {sum} of {size}");
        }
    }
    let (sum, size) = product(&|i| problem.c()[i]);
    assert!(sum > 1e-9 * size, "{sum} of {size}");
}

/// The planted answer, to 1e-10 of its largest entry.
fn assert_planted(solution: &Solution, known: &KnownAnswer) {
    let KnownAnswer::Unique { t, y } = known else {
        panic!("the class has one solution: {known:?}")
    };
    for (found, planted) in [(&solution.t, t), (&solution.y, y)] {
        let size = planted.iter().fold(0.0_f64, |max, v| max.max(*v));
        let is_near = |(f, p): (&f64, &f64)| (f - p).abs() <= 1e-10 * size;
        assert!(found.iter().zip(planted).all(is_near), "{found:?} {planted:?}");
    }
}

proptest! {
    #![proptest_config(cases(1024))]

    #[test]
    fn positive_definite(n in 1..24_usize, seed in any::<u64>()) {
        let Instance { problem, known } = general(families::positive_definite(n, seed));
        let solution = first_attempt(&problem);
        assert_solved(&problem, &solution);
        assert_planted(&solution, &known);
    }

    #[test]
    fn p_matrix(n in 1..24_usize, seed in any::<u64>()) {
        let Instance { problem, known } = general(families::p_matrix(n, seed));
        let solution = first_attempt(&problem);
        assert_solved(&problem, &solution);
        assert_planted(&solution, &known);
    }

    #[test]
    fn harker_pang(n in 1..40_usize, seed in any::<u64>()) {
        let problem = general(families::harker_pang(n, seed)).problem;
        assert_solved(&problem, &first_attempt(&problem));
    }

    #[test]
    fn positive_semidefinite(n in 1..24_usize, seed in any::<u64>()) {
        let problem = general(families::positive_semidefinite(n, seed)).problem;
        assert_solved(&problem, &first_attempt(&problem));
    }

    #[test]
    fn ties(n in 1..24_usize, seed in any::<u64>()) {
        let problem = general(families::ties(n, seed)).problem;
        assert_solved(&problem, &first_attempt(&problem));
    }

    #[test]
    fn strictly_copositive(n in 1..24_usize, seed in any::<u64>()) {
        let problem = general(families::strictly_copositive(n, seed)).problem;
        assert_solved(&problem, &first_attempt(&problem));
    }

    #[test]
    fn copositive_plus(n in 1..24_usize, seed in any::<u64>()) {
        let problem = general(families::copositive_plus(n, seed)).problem;
        assert_solved(&problem, &first_attempt(&problem));
    }

    /// Monotone in the general form, with singular `A` and `B`: principal pivots keep it so.
    #[test]
    fn horizontal_monotone(n in 1..24_usize, seed in any::<u64>()) {
        let problem = families::horizontal_monotone(n, seed).problem;
        assert_solved(&problem, &first_attempt(&problem));
    }

    /// The conditions of quadratic programs with equations: free multipliers with a zero block.
    #[test]
    fn mixed_monotone(n in 1..24_usize, seed in any::<u64>()) {
        let problem = families::mixed_monotone(n, seed).problem.to_general();
        assert_solved(&problem, &first_attempt(&problem));
    }

    #[test]
    fn infeasible_semidefinite(n in 2..40_usize, seed in any::<u64>()) {
        assert_proved_infeasible(&general(families::infeasible_semidefinite(n, seed)).problem);
    }

    #[test]
    fn infeasible(n in 1..40_usize, seed in any::<u64>()) {
        assert_proved_infeasible(&families::infeasible(n, seed).problem);
    }

    /// From all `w` every covering vector ends on a ray; with a pair in place of the artificial variable
    /// the path of Lemke and Howson always ends on an equilibrium.
    #[test]
    fn bimatrix(rows in 1..12_usize, columns in 1..12_usize, seed in any::<u64>()) {
        let problem = general(families::bimatrix(rows, columns, seed)).problem;
        assert_solved(&problem, &default(&problem));
    }

    /// No class: perhaps a ray, but never a wrong answer.
    #[test]
    fn no_class(n in 1..16_usize, seed in any::<u64>()) {
        for problem in [
            families::horizontal_singular(n, seed).problem,
            families::mixed_singular(n, seed).problem.to_general(),
        ] {
            let solution = default(&problem);
            match solution.status {
                Status::Solved => assert_right(&problem, &solution),
                Status::NoComplementaryBasis => prop_assert!(!all_solutions(&problem).has_basis),
                status => prop_assert_eq!(status, Status::RayTermination),
            }
        }
    }

    /// Anything at all: no panic, and `Solved` means solved.
    #[test]
    fn anything(
        (n, a, b, c) in (1..8_usize).prop_flat_map(|n| {
            let entries = |count| vec((-3..=3_i8).prop_map(f64::from), count);
            (Just(n), entries(n * n), entries(n * n), entries(n))
        })
    ) {
        let matrix = |values: &[f64]| Mat::from_fn(n, n, |i, j| values[i * n + j]);
        let problem = HorizontalLcp::new(matrix(&a), matrix(&b), c).unwrap();
        let solution = default(&problem);
        if solution.is_solved() {
            assert_right(&problem, &solution);
        }
    }
}

/// Membranes of some size: the contact zone is found exactly.
#[test]
fn obstacle() {
    for side in [1, 2, 5, 10, 20] {
        let Instance { problem, known } = general(families::obstacle(side));
        let solution = first_attempt(&problem);
        assert_eq!(solution.status, Status::Solved);
        assert_planted(&solution, &known);
    }
}

/// Without a class nothing is promised, but most small problems are solved by one of the attempts: a
/// floor under the share, in percent.
#[test]
fn most_problems_of_no_class_are_solved() {
    let horizontal = |n, seed| families::horizontal_singular(n, seed).problem;
    let mixed = |n, seed| families::mixed_singular(n, seed).problem.to_general();
    let shares = |problem: &dyn Fn(usize, u64) -> HorizontalLcp| {
        [4, 8, 12].map(|n| {
            let is_solved = |seed: &u64| default(&problem(n, *seed)).is_solved();
            (0..200).filter(is_solved).count() / 2
        })
    };
    for (name, found, floor) in
        [("horizontal", shares(&horizontal), [97, 96, 85]), ("mixed", shares(&mixed), [95, 96, 96])]
    {
        assert!(found.iter().zip(floor).all(|(found, floor)| *found >= floor), "{name}: {found:?}");
    }
}
