//! Answers of contact problems to twice the digits: closed forms, states that do not hold, redundant contacts,
//! bodies that float.

use faer::{Mat, mat};
use lcp::refine::{ContactStatus, Extended, Refined, Refinement};
use lcp::{Contact2d, ContactState, Error, InteriorPoint, Solver};
use lcp_problems::exact::{ExactVerdict, verify_basis};
use proptest::prelude::*;

use ContactStatus::{Backwards, Forwards, Open, Stick};

fn ext(value: f64) -> Extended {
    value.into()
}

/// How far a number is from a fraction of data, relative to it.
fn off(value: Extended, (p, q): (Extended, Extended)) -> f64 {
    ((value * q - p).rounded() / p.rounded()).abs()
}

/// Nothing moves, no force acts.
fn rest(problem: &Contact2d) -> ContactState {
    let m = problem.points();
    problem.state(vec![0.0; problem.displacements()], vec![0.0; m], vec![0.0; m])
}

fn refined(problem: &Contact2d, statuses: &[ContactStatus]) -> Refined {
    problem.refine(&rest(problem), statuses, Refinement::Extended).expect("valid")
}

/// Two springs of 3 and 4 with one of 1 between them; the first is pulled, the second may touch a wall.
fn springs(gap: f64, load: f64) -> Contact2d {
    Contact2d::new(
        mat![[4.0, -1.0], [-1.0, 5.0]],
        vec![load, 0.0],
        mat![[0.0, -1.0]],
        mat![[0.0, 0.0]],
        vec![gap],
        vec![0.0],
        vec![0.0],
    )
    .expect("valid")
}

/// A weight of 2 on a plane, pushed along it against a spring of 3.
fn sliding(mu: f64, push: f64) -> Contact2d {
    Contact2d::new(
        mat![[0.0, 0.0], [0.0, 3.0]],
        vec![-2.0, push],
        mat![[1.0, 0.0]],
        mat![[0.0, 1.0]],
        vec![0.0],
        vec![0.0],
        vec![mu],
    )
    .expect("valid")
}

#[test]
fn closed_forms_are_met_to_thirty_digits() {
    // Open: (4 5 - 1) u = (5, 1) load.
    let open = refined(&springs(1.0, 0.7), &[Open]);
    assert!(off(open.u[0], (ext(0.7) * 5.0, ext(19.0))) < 1e-29);
    assert!(off(open.u[1], (ext(0.7), ext(19.0))) < 1e-29);
    assert!(open.margin.least > 0.0 && open.margin.contact == Some(0));
    // Closed: the second is held at the gap, 4 u_1 = load + gap, t = u_1 - 5 gap.
    let closed = refined(&springs(0.01, 0.7), &[Stick]);
    let first = ext(0.7) + ext(0.01);
    assert!(off(closed.u[0], (first, ext(4.0))) < 1e-29);
    assert!(off(closed.u[1], (ext(0.01), ext(1.0))) < 1e-29);
    assert!(off(closed.t_n[0], (first - ext(0.01) * 20.0, ext(4.0))) < 1e-29);
    // Sliding: 3 u = push - mu 2.
    let slides = refined(&sliding(0.3, 1.4), &[Forwards]);
    assert!(off(slides.t_n[0], (ext(2.0), ext(1.0))) < 1e-29);
    assert!(off(slides.u[1], (ext(1.4) - ext(0.3) * 2.0, ext(3.0))) < 1e-29);
    assert!(off(slides.t_t[0], (-(ext(0.3) * 2.0), ext(1.0))) < 1e-29);
    for answer in [open, closed, slides] {
        assert!(answer.residual < 1e-30 && answer.correction < 1e-15, "{answer:?}");
        assert!(answer.shift.abs() <= 0.0 && answer.margin.least > 0.0);
    }
}

#[test]
fn a_status_that_does_not_hold_shows_in_the_margin() {
    for (problem, right, wrong) in [
        (springs(1.0, 0.7), Open, vec![Stick]),
        (springs(0.01, 0.7), Stick, vec![Open]),
        (sliding(0.3, 1.4), Forwards, vec![Stick, Backwards]),
        (sliding(0.3, -1.4), Backwards, vec![Stick, Forwards]),
        (sliding(0.3, 0.4), Stick, vec![Forwards, Backwards]),
    ] {
        assert!(refined(&problem, &[right]).margin.least > 0.01, "{right:?}");
        for status in wrong {
            let found = refined(&problem, &[status]);
            assert!(found.residual < 1e-30, "its equations have a solution");
            assert!(found.margin.least < -0.01, "{status:?} instead of {right:?}: {found:?}");
        }
    }
    // Without its contact nothing carries the weight.
    let falls = refined(&sliding(0.3, 1.4), &[Open]);
    assert!(falls.residual > 0.1, "{falls:?}");
}

#[test]
fn a_rough_answer_is_enough_to_find_the_exact_one() {
    for problem in [springs(1.0, 0.7), springs(0.01, 0.7), sliding(0.3, 1.4), sliding(0.3, 0.4)] {
        let solution = InteriorPoint::default().solve(&problem).expect("valid");
        let state = problem.recover(&solution.t, &solution.y);
        let exact = problem.verify(&state).expect("valid");
        let shaken = |v: &[f64]| v.iter().map(|v| v * (1.0 + 1e-7)).collect::<Vec<_>>();
        let rough = problem.state(shaken(&state.u), shaken(&state.t_n), shaken(&state.t_t));
        let again = problem.verify(&rough).expect("valid");
        assert_eq!(again.statuses, exact.statuses);
        assert!(again.refined.margin.least > 0.0);
        assert!(exact.refined.distance(&again.refined.on_bodies).unwrap_or(0.0) < 1e-29);
    }
}

#[test]
fn every_way_to_refine_comes_nearer() {
    let problem = springs(0.01, 0.7);
    let exact = refined(&problem, &[Stick]);
    let error = |refinement| {
        let found = problem.refine(&rest(&problem), &[Stick], refinement).expect("valid");
        (exact.distance(&found.on_bodies).expect("forces"), found.passes)
    };
    let (plain, single) = (error(Refinement::Plain), error(Refinement::Single));
    assert!(plain.0 < 1e-6 && plain.1 == 1, "{plain:?}");
    assert!(single.0 < 1e-14 && single.0 < plain.0 && single.1 == 2, "{single:?}");
    assert!(error(Refinement::Extended).0 < 1e-30);
}

/// A spring of 2 that is pressed against several walls at once.
fn pressed(gaps: &[f64]) -> Contact2d {
    let m = gaps.len();
    Contact2d::new(
        mat![[2.0]],
        vec![1.0],
        Mat::from_fn(m, 1, |_, _| -1.0),
        Mat::zeros(m, 1),
        gaps.to_vec(),
        vec![0.0; m],
        vec![0.0; m],
    )
    .expect("valid")
}

#[test]
fn redundant_contacts_keep_the_forces_that_they_have() {
    let problem = pressed(&[0.1; 3]);
    // 0.8 is to be carried by three.
    let given = problem.state(vec![0.1], vec![0.5, 0.2, 0.1 + 1e-9], vec![0.0; 3]);
    let found = problem.refine(&given, &[Stick; 3], Refinement::Extended).expect("valid");
    assert!(found.residual < 1e-30 && found.shift.abs() <= 0.0, "{found:?}");
    let sum = found.t_n.iter().fold(Extended::ZERO, |sum, t| sum + *t);
    assert!(off(sum, (ext(1.0) - ext(0.1) * 2.0, ext(1.0))) < 1e-29);
    for (found, given) in found.t_n.iter().zip([0.5, 0.2, 0.1]) {
        assert!((found.rounded() - given).abs() < 2e-9, "{found:?}");
    }
}

#[test]
fn gaps_that_contradict_each_other_in_the_last_digits_are_told() {
    let ulp = 0.1 * f64::EPSILON;
    let problem = pressed(&[0.1, 0.1 + ulp]);
    let given = problem.state(vec![0.1], vec![0.4, 0.4], vec![0.0; 2]);
    let found = problem.refine(&given, &[Stick; 2], Refinement::Extended).expect("valid");
    assert!(found.residual < 1e-28, "{found:?}");
    assert!(found.shift > 0.1 * ulp && found.shift < 10.0 * f64::EPSILON, "{found:?}");
    assert!(found.t_n.iter().all(|t| (t.rounded() - 0.4).abs() < 1e-12), "{found:?}");
    // What is more than rounding is no solution, and the residual says so.
    let problem = pressed(&[0.1, 0.1 + 1e-6]);
    let found = problem.refine(&given, &[Stick; 2], Refinement::Extended).expect("valid");
    assert!(found.residual > 1e-7, "{found:?}");
}

#[test]
fn bodies_that_nothing_touches_stay_where_they_are() {
    // Two masses on one spring beside one that is held; a contact above them.
    let problem = Contact2d::new(
        mat![[1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, 3.0]],
        vec![0.0, 0.0, 1.0],
        mat![[0.0, -1.0, 0.0]],
        Mat::zeros(1, 3),
        vec![1.0],
        vec![0.0],
        vec![0.0],
    )
    .expect("valid");
    let given = problem.state(vec![0.25, 0.25, 0.0], vec![0.0], vec![0.0]);
    let found = problem.refine(&given, &[Open], Refinement::Extended).expect("valid");
    assert_eq!(found.floating, 2);
    assert!(found.u[..2].iter().all(|u| *u == ext(0.25)), "{found:?}");
    assert!(off(found.u[2], (ext(1.0), ext(3.0))) < 1e-29 && found.residual < 1e-30);
}

#[test]
fn what_does_not_fit_is_refused() {
    let problem = springs(1.0, 0.7);
    let rest = rest(&problem);
    let refused = |state: &ContactState, statuses: &[ContactStatus]| {
        problem.refine(state, statuses, Refinement::Extended).unwrap_err()
    };
    assert!(matches!(refused(&rest, &[]), Error::Length { name: "statuses", .. }));
    let short = self::rest(&pressed(&[0.1]));
    assert!(matches!(refused(&short, &[Open]), Error::Length { name: "u", .. }));
    let mut broken = rest.clone();
    broken.t_n[0] = f64::NAN;
    assert!(matches!(refused(&broken, &[Open]), Error::NotFinite { what: "t_n", .. }));
    assert!(matches!(problem.verify(&broken), Err(Error::NotFinite { .. })));
}

proptest! {
    /// Rational arithmetic rounds the same answer.
    #[test]
    fn rational_arithmetic_agrees(
        entries in prop::collection::vec(-4_i32..=4, 12),
        load in prop::collection::vec(-6_i32..=6, 3),
        gaps in prop::collection::vec(0_i32..=2, 2),
        mu in prop::sample::select(vec![0.0, 0.25, 0.5]),
    ) {
        let of = |k: usize| f64::from(entries[k]);
        let root = mat![[2.0, of(0), of(1)], [0.0, 3.0, of(2)], [0.0, 0.0, 2.0]];
        let problem = Contact2d::new(
            root.transpose() * &root,
            load.iter().map(|f| f64::from(*f)).collect::<Vec<f64>>(),
            Mat::from_fn(2, 3, |i, j| of(3 + 3 * i + j)),
            Mat::from_fn(2, 3, |i, j| of(6 + 3 * (1 - i) + j)),
            gaps.iter().map(|x| f64::from(*x)).collect::<Vec<f64>>(),
            vec![0.0; 2],
            vec![mu; 2],
        ).expect("valid");
        let solution = InteriorPoint::default().solve(&problem).expect("valid");
        let basis = solution.basis.clone().filter(|_| solution.is_solved());
        let verdict = basis.map(|basis| verify_basis(&problem.to_general(), &basis));
        // Where contacts are redundant the basis has no single answer.
        let exact = match verdict {
            Some(ExactVerdict::Solution { t, y }) => Some(problem.recover(&t, &y)),
            _ => None,
        };
        prop_assume!(exact.is_some());
        let exact = exact.expect("assumed");
        let found = problem.verify(&problem.recover(&solution.t, &solution.y)).expect("valid");
        let size = exact.u.iter().fold(0.0_f64, |max, u| max.max(u.abs()));
        prop_assert!(found.refined.residual < 1e-28, "{:?}", found);
        prop_assert!(found.refined.margin.least > -1e-28, "{:?}", found);
        for (u, exact) in found.refined.u.iter().zip(&exact.u) {
            prop_assert!((u.rounded() - exact).abs() <= f64::EPSILON * size + 1e-30, "{u:?} {exact}");
        }
    }

    #[test]
    fn arithmetic_keeps_twice_the_digits(a in -1e3..1e3, b in 1e-3..1e3, c in -1e3..1e3) {
        let [x, y, z] = [ext(a) + ext(c * 1e-17), ext(b) - ext(c * 1e-18), ext(c)];
        let near = |left: Extended, right: Extended, size: f64| (left - right).rounded().abs() <= 1e-30 * size;
        let size = (a.abs() + c.abs()) * b;
        prop_assert!(near((x + z) * y, x * y + z * y, size));
        prop_assert!(near(x / y * y, x, a.abs() + 1e-10));
        prop_assert!(near(x * b, x * ext(b), a.abs() * b));
        prop_assert_eq!(Extended::product(a, b), ext(a) * ext(b));
        prop_assert_eq!((x - x).rounded().to_bits(), 0.0_f64.to_bits());
        prop_assert!((x.abs() - x).rounded().abs() <= 0.0 || a < 0.0 || x < Extended::ZERO);
        prop_assert!(x.rest().abs() <= f64::EPSILON * x.rounded().abs());
    }
}
