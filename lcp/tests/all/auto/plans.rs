//! What decides about a plan, and what does not.

use faer::{Mat, mat};
use lcp::{BoxedLcp, Friction2d, HorizontalLcp, Lcp, MixedLcp};
use lcp_problems::families;
use proptest::prelude::*;

use super::{CHOICES, INTERIOR, LEMKE, NEWTON, alternating, auto, common, masses, sparse};

#[test]
fn signs_and_size_decide_about_standard_problems() {
    // The active set method wherever the diagonal is positive, then pivots where they are cheap.
    let dense = families::positive_definite(30, 1).problem;
    assert_eq!(plan!(&dense), [NEWTON, LEMKE, INTERIOR, CHOICES]);
    // One after the other decides the sides of a triangular matrix.
    let triangular = Mat::from_fn(30, 30, |i, j| f64::from(u8::from(i > j)));
    let triangular = Lcp::new(triangular, vec![1.0; 30]).unwrap();
    assert_eq!(plan!(&triangular), [LEMKE, CHOICES, INTERIOR, LEMKE]);
    let symmetric = families::fathi(10).problem;
    assert_eq!(plan!(&symmetric), [NEWTON, LEMKE, CHOICES, INTERIOR]);
    let games = families::bimatrix(4, 5, 1).problem;
    assert_eq!(plan!(&games), [LEMKE, CHOICES, INTERIOR]);
    // M-matrices of any size, also such as are not dominant.
    for side in [3, 40] {
        let plan = auto().plan(&families::obstacle(side).problem);
        assert_eq!(plan[0].method, NEWTON);
        assert!(plan[0].reason.contains("M-matrices"), "{}", plan[0].reason);
    }
    let z = Lcp::new(mat![[1.0, -3.0], [-2.0, 1.0]], vec![-1.0, 2.0]).unwrap();
    assert_eq!(plan!(&z)[0], NEWTON);
    // Large sparse ones.
    let entry = |i: usize, j: usize| if i == j { 3.0 } else { 1.0 };
    let problem = Lcp::new(sparse(600, entry, &[1]), alternating(600)).unwrap();
    assert_eq!(plan!(&problem), [NEWTON, INTERIOR, LEMKE]);
    let entry = |i: usize, j: usize| if i == j { 3.0 } else { i as f64 - j as f64 };
    let problem = Lcp::new(sparse(600, entry, &[1]), alternating(600)).unwrap();
    assert_eq!(plan!(&problem), [NEWTON, INTERIOR, LEMKE]);
    let entry = |i: usize, j: usize| i as f64 - j as f64;
    let problem = Lcp::new(sparse(600, entry, &[1]), alternating(600)).unwrap();
    assert_eq!(plan!(&problem), [INTERIOR, LEMKE]);
}

#[test]
fn other_forms_have_their_plans() {
    let obstacle = families::obstacle(5).problem;
    let expected = plan!(&obstacle);
    assert_eq!(plan!(&HorizontalLcp::from(obstacle)), expected);
    // Two parts, one of them a standard problem in disguise.
    let horizontal = families::horizontal_monotone(9, 1).problem;
    assert_eq!(plan!(&horizontal), [LEMKE, CHOICES, INTERIOR]);
    let reasons: Vec<_> = auto().plan(&horizontal).into_iter().map(|it| it.reason).collect();
    assert!(reasons[0].starts_with("2 of 2 independent parts"), "{reasons:?}");
    assert_eq!(plan!(&families::mixed_monotone(9, 1).problem), [LEMKE, CHOICES, INTERIOR]);
    assert_eq!(plan!(&families::mixed_singular(8, 1).problem), [LEMKE, CHOICES, INTERIOR]);
    let entry = |i: usize, j: usize| if i == j { 3.0 } else { 1.0 };
    let m = sparse(900, entry, &[1]);
    let free = (0..900).map(|i| i % 3 == 0).collect();
    let mixed = MixedLcp::new(m.clone(), alternating(900), free).unwrap();
    assert_eq!(plan!(&mixed), [INTERIOR, LEMKE]);
    let bounded =
        |upper| BoxedLcp::new(m.clone(), alternating(900), vec![0.0; 900], upper).unwrap();
    assert_eq!(plan!(&bounded(vec![0.5; 900])), [INTERIOR, LEMKE]);
    let free = BoxedLcp::new(
        mat![[2.0, 1.0], [1.0, 2.0]],
        vec![1.0; 2],
        vec![f64::NEG_INFINITY, 0.0],
        vec![f64::INFINITY, 1.0],
    );
    assert_eq!(plan!(&free.unwrap()), [LEMKE, CHOICES, INTERIOR]);
    let friction = Friction2d::new(mat![[2.0, 0.0], [0.0, 1.0]], vec![-2.0, -0.25], vec![0.5]);
    assert_eq!(plan!(&friction.unwrap()), [LEMKE, CHOICES, INTERIOR]);
}

#[test]
fn points_and_friction_decide_about_contact() {
    assert_eq!(plan!(&masses(1, 0.5, 0.0)), [LEMKE, CHOICES, INTERIOR]);
    assert_eq!(plan!(&masses(1, 0.5, 1.0)), [INTERIOR, LEMKE, CHOICES]);
    assert_eq!(plan!(&masses(60, 0.5, 1.0)), [INTERIOR, LEMKE]);
    assert_eq!(plan!(&masses(60, 0.0, 1.0)), [INTERIOR, LEMKE]);
    assert_eq!(plan!(&masses(600, 0.5, 1.0)), [INTERIOR, LEMKE]);
}

fn power_of_ten(exponent: i32) -> f64 {
    10.0_f64.powi(exponent)
}

proptest! {
    #![proptest_config(common::cases(48))]

    /// Units of the pairs whose product is work: rows and columns alike.
    #[test]
    fn units_do_not_matter_for_the_plan(
        kind in 0..4_usize,
        exponents in proptest::collection::vec(-6..=6_i32, 36),
    ) {
        let problem = match kind {
            0 => families::obstacle(6).problem,
            1 => families::fathi(12).problem,
            2 => families::positive_definite(12, 5).problem,
            _ => Lcp::new(
                sparse(600, |i, j| if i == j { 3.0 } else { 1.0 }, &[1]),
                alternating(600),
            ).unwrap(),
        };
        let n = problem.order();
        let unit = |i: usize| power_of_ten(exponents[i % 36]);
        let scaled = |rows: &dyn Fn(usize) -> f64| {
            let dense = problem.m().to_dense();
            let m = Mat::from_fn(n, n, |i, j| rows(i) * dense[(i, j)] * unit(j));
            let m = if problem.m().is_sparse() {
                sparse(n, |i, j| m[(i, j)], &(1..7).collect::<Vec<_>>())
            } else {
                m.into()
            };
            let q: Vec<f64> = problem.q().iter().enumerate().map(|(i, q)| rows(i) * q).collect();
            Lcp::new(m, q).unwrap()
        };
        let names = |problem: &Lcp| plan!(problem);
        prop_assert_eq!(names(&scaled(&unit)), names(&problem));
        // Signs do not depend on units.
        let other = scaled(&|i| power_of_ten(exponents[(i + 7) % 36]));
        if kind != 3 {
            prop_assert_eq!(names(&other)[0], names(&problem)[0]);
        }
    }
}
