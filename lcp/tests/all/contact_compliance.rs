//! Contact with springs in series: closed forms, and the same springs as displacements of their own.

use crate::common;
use crate::common::methods;

use common::cases;
use faer::sparse::SparseColMat;
use faer::{Mat, mat};
use lcp::refine::Refinement;
use lcp::{
    Bedding, Certificate, Contact2d, ContactPoint, ContactState, Error, InteriorPoint, Lemke,
    Solver, Status,
};
use methods::{AUTO, Treated};
use proptest::collection::vec;
use proptest::prelude::*;

/// The states of all methods that solve a problem, each judged by the data; those named must solve it.
fn states(problem: &Contact2d, must: &[&str]) -> Vec<(&'static str, ContactState)> {
    let mut states = Vec::new();
    for (name, answer) in problem.answers() {
        let solution = match answer {
            Ok(solution) => solution,
            Err(Error::NotTreated { .. }) if !must.contains(&name) => continue,
            Err(error) => panic!("{name}: {error}"),
        };
        let state = problem.variables(&solution);
        let again = problem.state(state.u.clone(), state.t_n.clone(), state.t_t.clone());
        assert_eq!((&again.gap, &again.slip), (&state.gap, &state.slip), "{name}");
        let worst = problem.residuals(&state).worst();
        assert!(!solution.is_solved() || worst <= methods::TOLERANCE, "{name}: {worst:e}");
        assert!(solution.is_solved() || !must.contains(&name), "{name}: {solution:?}");
        if solution.is_solved() {
            states.push((name, state));
        }
    }
    states
}

#[cfg(feature = "clarabel")]
const ALL: [&str; 6] = [AUTO, "lemke", "newton", "interior", "pgs", "qp"];
#[cfg(not(feature = "clarabel"))]
const ALL: [&str; 5] = [AUTO, "lemke", "newton", "interior", "pgs"];
/// Methods that need no definite `K`.
const ANY: [&str; 4] = [AUTO, "lemke", "newton", "interior"];

fn near(found: &[f64], expected: &[f64], tolerance: f64) -> bool {
    let size = expected.iter().fold(1.0_f64, |max, v| max.max(v.abs()));
    let mut pairs = found.iter().zip(expected);
    found.len() == expected.len() && pairs.all(|(a, b)| (a - b).abs() <= tolerance * size)
}

fn assert_near(name: &str, found: &[f64], expected: &[f64]) {
    assert!(near(found, expected, 1e-9), "{name}: {found:?} instead of {expected:?}");
}

/// A block of weight 2 on a plane with `mu = 0.5`, pushed sideways against a spring.
fn block(push: f64, spring: f64, compliance: [f64; 2]) -> Contact2d {
    let mut builder = Contact2d::builder([[spring, 0.0], [0.0, 0.0]], vec![push, -2.0]);
    let (normal, tangent) = (&[(1, 1.0)], &[(0, 1.0)]);
    builder.add_point(ContactPoint { normal, tangent, mu: 0.5, compliance, ..Default::default() });
    builder.build().unwrap()
}

#[test]
fn a_block_sinks_and_is_drawn_aside_by_its_springs() {
    for unit in [1e-6, 1.0, 1e6] {
        let (a_n, a_t) = (0.3 * unit, 0.7 * unit);
        // Nothing but the contact holds it: it moves by `a_t P`.
        for push in [0.0, 0.4, -0.9] {
            for (name, state) in states(&block(push, 0.0, [a_n, a_t]), &ANY) {
                assert_near(name, &[state.t_n[0], state.t_t[0]], &[2.0, -push]);
                let moved = [state.u[0] / unit, state.u[1] / unit];
                assert_near(name, &moved, &[0.7 * push, -0.6]);
            }
        }
        // The spring of stiffness k takes what friction does not: `P - mu W = k u`, slip `u - a_t mu W`.
        let k = 3.0 / unit;
        for (push, side) in [(9.0, 1.0), (-9.0, -1.0)] {
            let problem = block(push, k, [a_n, a_t]);
            for (name, state) in states(&problem, &ANY) {
                let u = (push - side) / 3.0;
                assert_near(name, &[state.u[0] / unit, state.u[1] / unit], &[u, -0.6]);
                assert_near(name, &[state.t_n[0], state.t_t[0]], &[2.0, -side]);
                assert_near(name, &[state.slip[0] / unit], &[u - 0.7 * side]);
                assert!(state.gap[0].abs() < 1e-12 * unit, "{name}: {}", state.gap[0]);
            }
        }
        // While it sticks, both share the push: `t_t = -P / (1 + k a_t)`.
        for (name, state) in states(&block(1.0, k, [a_n, a_t]), &ANY) {
            assert_near(name, &[state.t_t[0], state.u[0] / unit], &[-1.0 / 3.1, 0.7 / 3.1]);
        }
    }
}

/// Two bodies on top of each other: springs in series add up.
#[test]
fn compliances_in_series_add_up() {
    let k = Mat::<f64>::zeros(2, 2);
    let c_n = mat![[1.0, 0.0], [-1.0, 1.0]];
    let problem = Contact2d::new(
        k,
        vec![0.0, -3.0],
        c_n,
        Mat::zeros(2, 2),
        vec![0.0, 0.1],
        vec![0.0; 2],
        vec![0.0; 2],
    );
    let problem = problem.unwrap().with_compliance(vec![[0.2, 0.0], [0.5, 7.0]]).unwrap();
    for (name, state) in states(&problem, &ANY) {
        assert_near(name, &state.u, &[-0.6, -2.2]);
        assert_near(name, &state.t_n, &[3.0, 3.0]);
    }
}

/// A rigid beam on three springs at -1, 0 and 1 under a load of 6 at `e`: statics of springs. Those are alike, so
/// that the beam turns by `6 e / 2 k` and lifts off at one end where `e` is above 2 / 3; it rests on two then.
#[test]
fn a_rigid_beam_on_springs() {
    let at = [-1.0, 0.0, 1.0];
    for e in [0.0, 0.3, 0.5, 0.8, -0.9] {
        let mut builder = Contact2d::builder(Mat::<f64>::zeros(2, 2), vec![-6.0, -6.0 * e]);
        for x in at {
            let compliance = [0.25, 0.0];
            builder.add_point(ContactPoint {
                normal: &[(0, 1.0), (1, x)],
                compliance,
                ..Default::default()
            });
        }
        let expected = if f64::abs(e) <= 2.0 / 3.0 {
            at.map(|x| 2.0 + 3.0 * e * x)
        } else {
            let (middle, end) = (6.0 * (1.0 - e.abs()), 6.0 * e.abs());
            if e > 0.0 { [0.0, middle, end] } else { [end, middle, 0.0] }
        };
        for (name, state) in states(&builder.build().unwrap(), &ANY) {
            assert_near(name, &state.t_n, &expected);
        }
    }
}

/// Between walls that are nearer to each other than it is wide a hard body cannot be; a soft one is pressed.
#[test]
fn what_is_squeezed_has_room_between_springs() {
    let walls = |compliance: [f64; 2]| {
        let mut builder = Contact2d::builder([[0.0]], vec![0.6]);
        for normal in [[(0, 1.0)], [(0, -1.0)]] {
            builder.add_point(ContactPoint {
                normal: &normal,
                gap: -1.0,
                compliance,
                ..Default::default()
            });
        }
        builder.build().unwrap()
    };
    let hard = walls([0.0; 2]);
    let proved = Solver::<Contact2d>::solve(&Lemke::default(), &hard).unwrap();
    assert_eq!(proved.status, Status::Infeasible);
    let certificate: &Certificate = proved.certificate.as_ref().unwrap();
    assert!(certificate.holds(&hard.to_general()));
    let soft = walls([0.25, 0.0]);
    // The gap rows have the forces in them now, which the proof says nothing of.
    assert!(!certificate.holds(&soft.to_general()));
    for (name, state) in states(&soft, &ANY) {
        assert_near(name, &state.t_n, &[3.7, 4.3]);
        assert_near(name, &state.u, &[0.075]);
    }
}

/// Springs hold nothing that pulls: the same loads fall, with a proof.
#[test]
fn no_forces_are_none_with_springs_either() {
    for push in [0.0, 1.4] {
        let lifted = block(push, 0.0, [0.2, 0.3]).with_loads(vec![push, 0.5]).unwrap();
        let solution = Solver::<Contact2d>::solve(&Lemke::default(), &lifted).unwrap();
        assert_eq!(solution.status, Status::Infeasible);
        assert!(solution.certificate.unwrap().holds(&lifted.to_general()));
    }
    let pushed = block(1.4, 0.0, [0.2, 0.3]);
    let solution = InteriorPoint::default().solve(&pushed).unwrap();
    assert_eq!(solution.status, Status::Infeasible, "{solution:?}");
    assert!(solution.certificate.unwrap().holds(&pushed.to_general()));
}

#[test]
fn mistakes_are_named() {
    let hard = || block(0.0, 0.0, [0.0; 2]);
    let error = |pairs: Vec<[f64; 2]>| hard().with_compliance(pairs).unwrap_err();
    assert!(matches!(error(vec![]), Error::Length { name: "compliance", len: 0, expected: 1 }));
    for (pair, of) in [
        ([-1.0, 0.0], "normal compliance"),
        ([f64::NAN, 0.0], "normal compliance"),
        ([0.0, f64::INFINITY], "tangential compliance"),
    ] {
        let error = error(vec![pair]);
        assert!(matches!(error, Error::PointValue { point: 0, name, .. } if name == of), "{error}");
    }
    assert!(matches!(hard().slid(&[]), Err(Error::Length { name: "slips", .. })));
    assert!(matches!(hard().slid(&[f64::NAN]), Err(Error::NotFinite { .. })));
}

/// What has slid does not go back: with its slips taken off, the state is at rest where it is.
#[test]
fn slips_are_taken_off() {
    let problem = block(9.0, 3.0, [0.3, 0.7]);
    let state = problem.variables(&Lemke::default().solve(&problem).unwrap());
    let there = problem.slid(&state.slip).unwrap();
    assert_near("slid", there.initial_slips(), &[-state.slip[0]]);
    let after = there.state(state.u.clone(), state.t_n.clone(), state.t_t.clone());
    assert!(after.slip[0].abs() < 1e-15);
    assert!(there.residuals(&after).worst() < 1e-14);
    // Hard contacts slide by what their bodies move.
    let hard = block(9.0, 3.0, [0.0; 2]);
    let state = hard.variables(&Lemke::default().solve(&hard).unwrap());
    let (slid, after) = (hard.slid(&state.slip).unwrap(), hard.after(&state.u).unwrap());
    assert_eq!(slid.initial_slips(), after.initial_slips());
}

/// The states solved in twice the digits: `t_t = -P / (1 + k a_t)`.
#[test]
fn states_are_refined_with_their_springs() {
    let problem = block(1.0, 3.0, [0.3, 0.7]);
    let state = problem.variables(&Lemke::default().solve(&problem).unwrap());
    let verified = problem.verify(&state).unwrap();
    assert!(verified.refined.residual < 1e-28, "{:e}", verified.refined.residual);
    let rest = problem.state(vec![0.0; 2], vec![0.0], vec![0.0]);
    for refinement in [Refinement::Plain, Refinement::Single, Refinement::Extended] {
        let refined = problem.refine(&rest, &verified.statuses, refinement).unwrap();
        let rounded = refined.rounded(&problem);
        let found = [rounded.u[0], rounded.u[1], rounded.t_n[0], rounded.t_t[0]];
        // One pass leaves a hundred-millionth.
        let tolerance = if refinement == Refinement::Plain { 1e-7 } else { 1e-14 };
        assert!(near(&found, &[0.7 / 3.1, -0.6, 2.0, -1.0 / 3.1], tolerance), "{found:?}");
    }
}

#[test]
fn what_is_made_of_a_problem_keeps_its_springs() {
    let problem = block(9.0, 3.0, [0.3, 0.7]);
    let bedding = Bedding::new(&problem, 1e-3).unwrap();
    let bedded = bedding.attached(&problem, &[0.0; 2]).unwrap();
    for made in
        [bedded, problem.with_loads(vec![1.0; 2]).unwrap(), problem.after(&[1.0; 2]).unwrap()]
    {
        assert_eq!(made.compliance(), problem.compliance());
    }
    let state = problem.variables(&Lemke::default().solve(&problem).unwrap());
    let (t, y) = problem.to_pairs(&state);
    let general = problem.to_general();
    assert!(general.residuals(&t, &y).worst() < 1e-14);
    assert!(near(&problem.recover(&t, &y).gap, &state.gap, 1e-15));
}

/// Every compliance as a displacement of its own, with the stiffness `1 / a` and a coefficient of one in the gap or
/// the slip of its point.
fn with_displacements(problem: &Contact2d) -> Contact2d {
    let (n, m) = (problem.displacements(), problem.points());
    let springs: Vec<(usize, usize, f64)> = (0..m)
        .flat_map(|i| [0, 1].map(|k| (i, k, problem.compliance()[i][k])))
        .filter(|&(i, k, a)| a > 0.0 && (k == 0 || problem.mu()[i] > 0.0))
        .collect();
    let all = n + springs.len();
    let [k, c_n, c_t] =
        [problem.stiffness(), problem.normal(), problem.tangent()].map(SparseColMat::to_dense);
    let more = |c: &Mat<f64>, side: usize| {
        Mat::from_fn(m, all, |i, j| match j.checked_sub(n) {
            None => c[(i, j)],
            Some(spring) => f64::from(springs[spring].0 == i && springs[spring].1 == side),
        })
    };
    let k = Mat::from_fn(all, all, |i, j| match (i < n && j < n, i == j) {
        (true, _) => k[(i, j)],
        (false, true) => 1.0 / springs[j - n].2,
        (false, false) => 0.0,
    });
    let mut f = problem.loads().to_vec();
    f.resize(all, 0.0);
    let (x_0, s_0) = (problem.initial_gaps().to_vec(), problem.initial_slips().to_vec());
    Contact2d::new(k, f, more(&c_n, 0), more(&c_t, 1), x_0, s_0, problem.mu().to_vec()).unwrap()
}

/// With no more friction there is one solution between soft contacts, as without any.
const LITTLE: f64 = 1.0 / 1024.0;

/// Elastic bodies without friction, with very little, or with a little.
fn problems() -> impl Strategy<Value = Contact2d> {
    let entries = |n: usize, most: i8| vec((-most..=most).prop_map(f64::from), n);
    (1..=5usize, 1..=5usize).prop_flat_map(move |(n, m)| {
        let matrices = (entries(n * n, 2), entries(m * n, 2), entries(m * n, 2));
        let largest = prop::sample::select(std::vec![0.0, LITTLE, 0.125]);
        let mu = (largest, vec(any::<bool>(), m));
        let offsets = vec(((-1..=2i8).prop_map(f64::from), (-2..=2i8).prop_map(f64::from)), m);
        let hard = prop::sample::select(std::vec![0.0, 0.0, 0.125, 0.5, 2.0, 16.0]);
        let soft = prop::sample::select(std::vec![0.125, 0.5, 2.0, 16.0]);
        let compliance = prop_oneof![vec([hard.clone(), hard], m), vec([soft.clone(), soft], m)];
        let all = (matrices, entries(n, 6), offsets, mu, compliance);
        all.prop_map(move |((r, c_n, c_t), f, offsets, (largest, with), compliance)| {
            let mu: Vec<f64> = with.iter().map(|with| if *with { largest } else { 0.0 }).collect();
            let r = Mat::from_fn(n, n, |i, j| r[i * n + j]);
            let k = &r * r.transpose() + Mat::<f64>::identity(n, n);
            // Rows without any entry are refused by sweeps.
            let row = |c: &[f64], i: usize, j: usize| {
                c[i * n + j]
                    + if c[i * n..(i + 1) * n].iter().all(|v| *v == 0.0) { 1.0 } else { 0.0 }
            };
            let c_n = Mat::from_fn(m, n, |i, j| row(&c_n, i, j));
            let c_t = Mat::from_fn(m, n, |i, j| row(&c_t, i, j));
            let (x_0, s_0): (Vec<f64>, Vec<f64>) = offsets.into_iter().unzip();
            let hard = Contact2d::new(k, f, c_n, c_t, x_0, s_0, mu).unwrap();
            hard.with_compliance(compliance).unwrap()
        })
    })
}

proptest! {
    #![proptest_config(cases(64))]

    /// In displacements, and where every contact is compliant or alone in forces too.
    #[test]
    fn springs_of_contacts_are_as_displacements_of_their_own(problem in problems()) {
        let other = with_displacements(&problem);
        let n = problem.displacements();
        let reference = Solver::<Contact2d>::solve(&Lemke::default(), &other).unwrap();
        if reference.is_solved() {
            let expected = other.variables(&reference);
            // Hard contacts may share forces in many ways.
            let are_soft = problem.compliance().iter().flatten().all(|a| *a > 0.0);
            let has_friction = !problem.frictional().is_empty();
            let is_one = !has_friction || are_soft && problem.mu().iter().all(|mu| *mu <= LITTLE);
            let must = if is_one { &ALL[..] } else { &[AUTO, "lemke"] };
            for (name, state) in states(&problem, must) {
                let size = expected.u.iter().fold(1.0_f64, |max, v| max.max(v.abs()));
                // Sweeps end at the tolerance.
                let tolerance = if name == "pgs" { 1e-6 } else { 1e-9 } * size;
                if is_one {
                    prop_assert!(near(&state.u, &expected.u[..n], tolerance), "{name}: {:?} {:?}", state.u, expected.u);
                }
                if is_one && are_soft {
                    prop_assert!(near(&state.t_n, &expected.t_n, tolerance), "{name}: {:?} {:?}", state.t_n, expected.t_n);
                    prop_assert!(near(&state.t_t, &expected.t_t, tolerance), "{name}: {:?} {:?}", state.t_t, expected.t_t);
                }
                // Each is a solution of the other problem, with the springs moved by their forces.
                let moved = (0..problem.points()).flat_map(|i| {
                    let [normal, tangential] = problem.compliance()[i];
                    let tangential = if problem.mu()[i] > 0.0 { tangential } else { 0.0 };
                    [normal * state.t_n[i], tangential * state.t_t[i]].into_iter().zip([normal, tangential])
                });
                let moved = moved.filter(|(_, a)| *a > 0.0).map(|(u, _)| u);
                let u = state.u.iter().copied().chain(moved).collect();
                let there = other.state(u, state.t_n.clone(), state.t_t.clone());
                let worst = other.residuals(&there).worst();
                // What sweeps leave in a slip may be more of what a spring gives.
                let tolerance = if name == "pgs" { 1e4 } else { 10.0 } * methods::TOLERANCE;
                prop_assert!(worst <= tolerance, "{name}: {worst:e}");
            }
        }
    }

    /// Bit for bit.
    #[test]
    fn none_is_as_if_there_were_no_springs(problem in problems()) {
        let none = vec![[0.0; 2]; problem.points()];
        let given = problem.clone().with_compliance(none).unwrap();
        let (k, c_n, c_t) = (problem.stiffness().clone(), problem.normal().clone(), problem.tangent().clone());
        let (f, mu) = (problem.loads().to_vec(), problem.mu().to_vec());
        let (x_0, s_0) = (problem.initial_gaps().to_vec(), problem.initial_slips().to_vec());
        let without = Contact2d::new(k, f, c_n, c_t, x_0, s_0, mu).unwrap();
        for ((name, a), (_, b)) in given.answers().into_iter().zip(without.answers()) {
            match (a, b) {
                (Ok(a), Ok(b)) => prop_assert_eq!((a.t, a.y), (b.t, b.y), "{}", name),
                (a, b) => prop_assert_eq!(a.is_err(), b.is_err()),
            }
        }
    }
}
