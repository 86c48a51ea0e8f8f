//! Properties of the answers of the interior-point method to random contact problems.

use faer::Mat;
use lcp::{Contact2d, InteriorPoint, InteriorPointSettings, Lemke, Solver, WarmStart};
use proptest::collection::vec;
use proptest::prelude::*;

use super::bodies::{in_units, problems};
use super::{assert_close, common, default, solve};

/// Rows and points in the opposite order.
fn reversed(problem: &Contact2d) -> Contact2d {
    let (n, m) = (problem.displacements(), problem.points());
    let [k, c_n, c_t] = [problem.stiffness(), problem.normal(), problem.tangent()]
        .map(faer::sparse::SparseColMat::to_dense);
    let back = |v: &[f64]| v.iter().rev().copied().collect::<Vec<f64>>();
    Contact2d::new(
        Mat::from_fn(n, n, |i, j| k[(n - 1 - i, n - 1 - j)]),
        back(problem.loads()),
        Mat::from_fn(m, n, |i, j| c_n[(m - 1 - i, n - 1 - j)]),
        Mat::from_fn(m, n, |i, j| c_t[(m - 1 - i, n - 1 - j)]),
        back(problem.initial_gaps()),
        back(problem.initial_slips()),
        back(problem.mu()),
    )
    .unwrap()
}

proptest! {
    #![proptest_config(common::cases(256))]

    /// Gaps that are not negative and a regular stiffness: there is a solution. Its energy is that of
    /// Lemke's where there is no friction, and with it both are solutions, of which there may be several.
    #[test]
    fn elastic_bodies_are_solved(problem in problems()) {
        let solution = solve(&problem);
        prop_assert!(solution.is_solved(), "{:?}", solution.status);
        let found = problem.recover(&solution.t, &solution.y);
        prop_assert!(problem.residuals(&found).worst() <= 1e-10);
        if problem.frictional().is_empty() {
            let lemke = Solver::<Contact2d>::solve(&Lemke::default(), &problem).unwrap();
            prop_assert!(lemke.is_solved());
            assert_close(&found.u, &problem.recover(&lemke.t, &lemke.y).u);
        }
    }

    #[test]
    fn units_do_not_matter(
        problem in problems(),
        (force, length) in (-30..30i32, -30..30i32),
        units in vec(-10..10i32, 6),
    ) {
        let (force, length) = (f64::from(force).exp2(), f64::from(length).exp2());
        let unit: Vec<f64> = units[..problem.displacements()].iter().map(|u| f64::from(*u).exp2()).collect();
        let other = in_units(&problem, force, length, &unit);
        let (first, second) = (solve(&problem), solve(&other));
        prop_assert!(first.is_solved() && second.is_solved(), "{:?}", second.status);
        if problem.frictional().is_empty() {
            let (u, other) = (
                problem.recover(&first.t, &first.y).u,
                other.recover(&second.t, &second.y).u,
            );
            let back: Vec<f64> = other.iter().zip(&unit).map(|(u, unit)| u * unit / length).collect();
            assert_close(&back, &u);
        }
    }

    #[test]
    fn the_order_does_not_matter(problem in problems()) {
        let other = reversed(&problem);
        let (first, second) = (solve(&problem), solve(&other));
        prop_assert!(first.is_solved() && second.is_solved(), "{:?}", second.status);
        if problem.frictional().is_empty() {
            let mut u = other.recover(&second.t, &second.y).u;
            u.reverse();
            assert_close(&u, &problem.recover(&first.t, &first.y).u);
        }
    }

    /// A point near a solution has its states.
    #[test]
    fn a_point_is_a_start(problem in problems()) {
        let solution = solve(&problem);
        prop_assert!(solution.is_solved());
        let start = WarmStart::Point { t: solution.t.clone(), y: solution.y.clone() };
        let again = InteriorPoint::new(InteriorPointSettings { start, ..default() });
        let again = again.solve(&problem).unwrap();
        prop_assert!(again.is_solved());
        prop_assert!(again.info.factorisations <= solution.info.factorisations);
    }

    /// Without crossover the answer is a point inside, as good as was asked for. Where no body is near any
    /// contact, its forces have nothing by which they could be measured.
    #[test]
    fn points_inside_are_as_good_as_asked_for(problem in problems(), digits in 2..8i32) {
        prop_assume!(problem.normal().val().iter().any(|v| *v != 0.0));
        let tolerance = 10.0_f64.powi(-digits);
        let settings = InteriorPointSettings { tolerance, crossover: false, ..default() };
        let solution = InteriorPoint::new(settings).solve(&problem).unwrap();
        prop_assert!(solution.is_solved(), "{:?} {:?}", solution.status, solution.residuals);
        let state = problem.recover(&solution.t, &solution.y);
        prop_assert!(solution.basis.is_none() && problem.residuals(&state).worst() <= tolerance);
    }
}
