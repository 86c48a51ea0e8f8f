//! What the generated problems say of themselves, against exact arithmetic.

use crate::common;

use common::cases;
use faer::{Mat, mat};
use lcp::{Auto, Basis, BoxedLcp, HorizontalLcp, Lcp, MixedLcp, Side, Solver, Status};
use lcp_problems::exact::{EnumerationSettings, ExactVerdict, RBig, enumerate, verify_basis};
use lcp_problems::families::{self, Instance, KnownAnswer};
use proptest::prelude::*;

fn exact(value: f64) -> RBig {
    RBig::try_from(value).unwrap()
}

fn dot(a: impl Iterator<Item = f64>, b: &[f64]) -> RBig {
    a.zip(b).fold(RBig::ZERO, |sum, (a, b)| sum + exact(a) * exact(*b))
}

/// Whether `A t + B y = c` without any rounding, and the rest of the conditions.
fn solves(problem: &HorizontalLcp, t: &[f64], y: &[f64]) -> bool {
    let n = problem.order();
    let equation = |i: usize| {
        let row = |m: &dyn Fn(usize) -> f64, x: &[f64]| dot((0..n).map(m), x);
        row(&|j| problem.a()[(i, j)], t) + row(&|j| problem.b()[(i, j)], y)
    };
    (0..n).all(|i| equation(i) == exact(problem.c()[i]))
        && t.iter().zip(y).all(|(&t, &y)| t.min(y) == 0.0)
}

fn proves_infeasibility(problem: &HorizontalLcp, farkas: &[f64]) -> bool {
    let n = problem.order();
    let column = |m: &dyn Fn(usize) -> f64| dot((0..n).map(m), farkas);
    (0..n).all(|j| column(&|i| problem.a()[(i, j)]) <= RBig::ZERO)
        && (0..n).all(|j| column(&|i| problem.b()[(i, j)]) <= RBig::ZERO)
        && dot(problem.c().iter().copied(), farkas) > RBig::ZERO
}

fn assert_true(instance: &Instance) {
    let problem = &instance.problem;
    let all = enumerate(problem, &EnumerationSettings::default()).unwrap();
    match &instance.known {
        KnownAnswer::Unique { t, y } => {
            assert_eq!(all.unique().unwrap().rounded(), (t.clone(), y.clone()));
        }
        KnownAnswer::Solution { t, y } => assert!(solves(problem, t, y)),
        KnownAnswer::Solvable => assert!(all.is_solvable()),
        KnownAnswer::Infeasible { farkas } => {
            assert!(proves_infeasibility(problem, farkas) && !all.is_feasible());
        }
    }
}

fn general(instance: Instance<Lcp>) -> Instance {
    Instance { problem: instance.problem.into(), known: instance.known }
}

fn mixed(Instance { problem, known }: Instance<MixedLcp>) -> Instance {
    let KnownAnswer::Solution { t, y } = known else { panic!("planted: {known:?}") };
    let (t, y) = problem.to_pairs(&t, &y);
    Instance { problem: problem.to_general(), known: KnownAnswer::Solution { t, y } }
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn random_families_know_their_answers(n in 0..8_usize, seed in any::<u64>()) {
        for family in [
            families::positive_definite,
            families::positive_semidefinite,
            families::p_matrix,
            families::strictly_copositive,
            families::copositive_plus,
            families::ties,
            families::harker_pang,
            families::indefinite,
            families::triangular,
            families::infeasible_semidefinite,
        ] {
            assert_true(&general(family(n, seed)));
        }
        assert_true(&general(families::bimatrix(n / 2, n - n / 2, seed)));
        for family in [families::mixed_monotone, families::mixed_singular] {
            assert_true(&mixed(family(n, seed)));
        }
        for family in [
            families::horizontal_monotone,
            families::horizontal_singular,
            families::infeasible,
        ] {
            assert_true(&family(n, seed));
        }
    }
}

#[test]
fn textbook_families_know_their_answers() {
    for n in 0..8 {
        assert_true(&general(families::murty(n)));
        assert_true(&general(families::fathi(n)));
    }
    assert_true(&general(families::kostreva_1()));
    assert_true(&general(families::kostreva_2()));
    (0..4).for_each(|side| assert_true(&general(families::obstacle(side))));
}

fn assert_singular(problem: &HorizontalLcp, side: Side) {
    let verdict = verify_basis(problem, &Basis::all(side, problem.order()));
    assert!(matches!(verdict, ExactVerdict::Singular { .. }), "{verdict:?}");
}

/// There is no way to the standard form by `A^-1` or `B^-1`, nor by eliminating the free variables.
#[test]
fn general_families_have_singular_matrices() {
    for seed in 0..20 {
        for family in [families::horizontal_monotone, families::horizontal_singular] {
            let problem = family(12, seed).problem;
            assert_singular(&problem, Side::T);
            assert_singular(&problem, Side::Y);
        }
        for family in [families::mixed_monotone, families::mixed_singular] {
            let problem = family(12, seed).problem;
            let free = problem.free().iter().filter(|free| **free).count();
            let block = Mat::from_fn(free, free, |i, j| problem.m()[(i, j)]);
            let zero = vec![0.0; free];
            assert_singular(&HorizontalLcp::new(block.clone(), block, zero).unwrap(), Side::T);
        }
    }
}

/// Model-predictive control of 400 systems, whose states fade away by up to thirty powers of ten.
#[test]
fn control_is_solved() {
    for seed in 0..100 {
        for steps in [5, 10, 20, 40] {
            let problem = families::control(steps, seed).problem;
            let solution = Auto::default().solve(&problem).unwrap();
            assert!(solution.is_solved(), "{steps} steps, seed {seed}: {}", solution.status);
            let (z, w) = problem.variables(&solution);
            assert!(problem.residuals(&z, &w).worst() < 1e-10);
        }
    }
}

/// Bounds that cannot be met stay a proof, whatever small there is beside them.
#[test]
fn bounds_that_contradict_are_proved() {
    let m = mat![[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let (lower, upper) = (vec![-1.0, -1.0, f64::NEG_INFINITY], vec![1.0, 1.0, f64::INFINITY]);
    let problem = BoxedLcp::new(m, vec![0.0, 1e-12, -2.0], lower, upper).unwrap();
    let solution = Auto::default().solve(&problem).unwrap();
    assert_eq!(solution.status, Status::Infeasible);
    assert!(solution.certificate.is_some());
}

/// The boundary of exercise and the value above it approach Merton's, as the grid does.
#[test]
fn an_option_is_worth_what_merton_says() {
    for (interest, volatility) in [(0.02, 0.4), (0.05, 0.2), (0.1, 0.2)] {
        let g = 2.0 * interest / (volatility * volatility);
        let exercise: f64 = g / (1.0 + g);
        let error = |points: usize| {
            let problem = families::perpetual_option(points, interest, volatility).problem;
            let solution = Auto::default().solve(&problem).unwrap();
            assert!(solution.is_solved(), "{}", solution.status);
            let step = 5.0 / (points + 1) as f64;
            let errors = solution.t.iter().enumerate().map(|(i, beyond)| {
                let price = (exercise.ln() - 1.0 + step * (i + 1) as f64).exp();
                let worth = if price <= exercise {
                    1.0 - price
                } else {
                    (1.0 - exercise) * (price / exercise).powf(-g)
                };
                (beyond - (worth - (1.0 - price))).abs()
            });
            errors.fold(0.0, f64::max)
        };
        let [coarse, fine] = [200, 800].map(error);
        assert!(fine < 2e-3 && fine < 0.35 * coarse, "{coarse:e} {fine:e}");
    }
}
