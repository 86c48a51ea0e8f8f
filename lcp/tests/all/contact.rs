//! Contact with friction in the plane: forms, residuals, closed forms.

use crate::common;

use faer::{Mat, mat};
use lcp::{
    Auto, Contact2d, ContactPoint, ContactState, InteriorPoint, Lemke, LemkeSettings, Solver,
    Status, WarmStart,
};
use lcp_problems::exact::{EnumerationSettings, enumerate};
use proptest::collection::vec;
use proptest::prelude::*;

/// The states that the method finds on the mixed and on the general form of a problem, judged by the data.
fn found(problem: &Contact2d) -> [Option<ContactState>; 2] {
    let mixed = Solver::<Contact2d>::solve(&Lemke::default(), problem).expect("valid settings");
    let general = Lemke::default().solve(&problem.to_general()).expect("valid settings");
    [mixed.of_pairs(), general].map(|solution| {
        let state = problem.recover(&solution.t, &solution.y);
        let worst = problem.residuals(&state).worst();
        assert!(!solution.is_solved() || worst < 1e-12, "{worst}");
        solution.is_solved().then_some(state)
    })
}

/// The same where the one on the mixed form must be there.
fn states(problem: &Contact2d) -> Vec<ContactState> {
    let found = found(problem);
    assert!(found[0].is_some());
    found.into_iter().flatten().collect()
}

fn assert_close(found: &[f64], expected: &[f64]) {
    let size = expected.iter().fold(1.0_f64, |max, v| max.max(v.abs()));
    let is_close = found.len() == expected.len()
        && found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-10 * size);
    assert!(is_close, "{found:?} instead of {expected:?}");
}

/// A mass of 2 with two displacements, under a load.
fn mass(load: [f64; 2], normals: &[[f64; 2]], mu: f64) -> Contact2d {
    let m = normals.len();
    let c_n = Mat::from_fn(m, 2, |i, j| normals[i][j]);
    let c_t = Mat::from_fn(m, 2, |i, j| [-normals[i][1], normals[i][0]][j]);
    let k = mat![[2.0, 0.0], [0.0, 2.0]];
    Contact2d::new(k, load.to_vec(), c_n, c_t, vec![0.0; m], vec![0.0; m], vec![mu; m])
        .expect("a valid problem")
}

#[test]
fn a_block_on_a_plane_sticks_or_slips() {
    for (push, expected_force, expected_velocity) in
        [(0.0, 0.0, 0.0), (3.0, 3.0, 0.0), (-3.0, -3.0, 0.0), (9.0, 5.0, 2.0), (-9.0, -5.0, -2.0)]
    {
        for state in states(&mass([push, -10.0], &[[0.0, 1.0]], 0.5)) {
            assert_close(&state.t_n, &[10.0]);
            // The tangent points to the left.
            assert_close(&state.t_t, &[expected_force]);
            assert_close(&state.u, &[expected_velocity, 0.0]);
            assert_close(&state.slip, &[-expected_velocity]);
        }
    }
}

#[test]
fn a_lifted_block_leaves_the_plane() {
    for state in states(&mass([1.0, 4.0], &[[0.0, 1.0]], 0.5)) {
        assert_close(&state.u, &[0.5, 2.0]);
        assert_close(&[state.t_n[0], state.t_t[0], state.gap[0]], &[0.0, 0.0, 2.0]);
    }
}

#[test]
fn a_block_pushed_against_a_wall_is_held_by_friction_or_falls() {
    for (push, friction, velocity) in [(16.0, 6.0, 0.0), (8.0, 4.0, -1.0), (0.0, 0.0, -3.0)] {
        for state in states(&mass([-push, -6.0], &[[1.0, 0.0]], 0.5)) {
            assert_close(&[state.t_n[0], state.t_t[0]], &[push, friction]);
            assert_close(&state.u, &[0.0, velocity]);
        }
    }
}

#[test]
fn a_wedge_between_two_inclined_planes() {
    let (first, second) = (0.3_f64, 0.8_f64);
    let normals = [[first.sin(), first.cos()], [-second.sin(), second.cos()]];
    let part = 10.0 / (first + second).sin();
    for state in states(&mass([0.0, -10.0], &normals, 0.0)) {
        assert_close(&state.t_n, &[part * second.sin(), part * first.sin()]);
        assert_close(&state.u, &[0.0, 0.0]);
    }
    // With friction the forces are not unique, but they carry the weight.
    let problem = mass([0.0, -10.0], &normals, 0.5);
    for ContactState { u, t_n, t_t, .. } in states(&problem) {
        assert_close(&u, &[0.0, 0.0]);
        let along = |k: usize, i: usize| {
            t_n[i] * normals[i][k] + t_t[i] * [-normals[i][1], normals[i][0]][k]
        };
        assert_close(&[along(0, 0) + along(0, 1), along(1, 0) + along(1, 1)], &[0.0, 10.0]);
    }
}

/// Where nothing moves and nothing is open the largest gap is noise, by which none should be measured.
#[test]
fn a_body_at_rest_is_not_measured_by_noise() {
    let problem = mass([0.0, -10.0], &[[0.0, 1.0]], 0.5);
    let noise = 1e-13;
    let state = problem.state(vec![noise, noise], vec![10.0], vec![0.0]);
    let residuals = problem.residuals(&state);
    assert!(residuals.worst() > 0.1 * noise && residuals.worst() < 1024.0 * noise, "{residuals:?}");
    // And where all contacts are open, the largest force.
    let problem = mass([0.0, 10.0], &[[0.0, 1.0]], 0.5);
    let residuals = problem.residuals(&problem.state(vec![0.0, 5.0], vec![noise], vec![0.0]));
    assert!(residuals.worst() < noise && residuals.natural > 0.01 * noise, "{residuals:?}");
}

/// Ties of many rows at once: rigid bodies on more supports than they need.
#[test]
fn a_beam_on_many_supports_is_carried() {
    let m = 12;
    let at = |i: usize| i as f64 - 5.5;
    let c_n = Mat::from_fn(m, 3, |i, j| [0.0, 1.0, at(i)][j]);
    let c_t = Mat::from_fn(m, 3, |_, j| [-1.0, 0.0, 0.0][j]);
    let k = Mat::from_fn(3, 3, |i, j| if i == j { [7.0, 7.0, 84.0][i] } else { 0.0 });
    let (zero, mu) = (vec![0.0; m], vec![0.5; m]);
    let load = vec![3.0, -70.0, 35.0];
    let problem = Contact2d::new(k, load, c_n, c_t, zero.clone(), zero, mu).unwrap();
    for state in states(&problem) {
        assert_close(&state.u, &[0.0, 0.0, 0.0]);
        let moment: f64 = state.t_n.iter().enumerate().map(|(i, t)| at(i) * t).sum();
        let (sum, friction): (f64, f64) = (state.t_n.iter().sum(), state.t_t.iter().sum());
        assert_close(&[sum, moment, friction], &[70.0, -35.0, 3.0]);
    }
}

/// A body of no stiffness between two walls that are too near to each other, and one that is lifted.
#[test]
fn what_cannot_be_is_proved() {
    let zero = Mat::<f64>::zeros(2, 2);
    let walls = mat![[1.0, 0.0], [-1.0, 0.0]];
    let ways = mat![[0.0, 1.0], [0.0, 1.0]];
    let squeezed = Contact2d::new(
        zero.clone(),
        vec![0.0, 0.0],
        walls,
        ways,
        vec![-1.0, -1.0],
        vec![0.0; 2],
        vec![0.5; 2],
    );
    let lifted = Contact2d::new(
        zero,
        vec![0.0, 3.0],
        mat![[0.0, 1.0]],
        mat![[-1.0, 0.0]],
        vec![0.0],
        vec![0.0],
        vec![0.5],
    );
    for problem in [squeezed.unwrap(), lifted.unwrap()] {
        let solution = Solver::<Contact2d>::solve(&Lemke::default(), &problem).unwrap();
        assert_eq!(solution.status, Status::Infeasible);
        let pi = solution.farkas().expect("the proof");
        let general = problem.to_general();
        for matrix in [general.a(), general.b()] {
            for j in 0..general.order() {
                let product: f64 = matrix.column(j).map(|(i, v)| v * pi[i]).sum();
                assert!(product <= 1e-14, "{j}: {product}");
            }
        }
        let gain: f64 = general.c().iter().zip(pi).map(|(c, pi)| c * pi).sum();
        assert!(gain > 0.1, "{gain}");
    }
}

fn integers(n: usize, low: i8, high: i8) -> impl Strategy<Value = Vec<f64>> {
    vec((low..=high).prop_map(f64::from), n)
}

fn matrix(rows: usize, columns: usize, entries: &[f64]) -> Mat<f64> {
    Mat::from_fn(rows, columns, |i, j| entries[i * columns + j])
}

/// Small integers, with `K` positive definite, and gaps that are not negative. Without slips of their own
/// there is a solution.
fn problems() -> impl Strategy<Value = Contact2d> {
    (1..=3usize, 1..=2usize).prop_flat_map(|(n, m)| {
        let matrices = (integers(n * n, -2, 2), integers(m * n, -2, 2), integers(m * n, -2, 2));
        let slips = prop_oneof![Just(vec![0.0; m]), integers(m, -1, 1)];
        let vectors = (integers(n, -6, 6), integers(m, 0, 2), slips);
        let mu = vec(prop::sample::select(vec![0.0, 0.25, 0.5, 1.0]), m);
        (matrices, vectors, mu).prop_map(move |((r, c_n, c_t), (f, x_0, s_0), mu)| {
            let r = matrix(n, n, &r);
            let k = &r * r.transpose() + Mat::<f64>::identity(n, n);
            let (c_n, c_t) = (matrix(m, n, &c_n), matrix(m, n, &c_t));
            Contact2d::new(k, f, c_n, c_t, x_0, s_0, mu).expect("a valid problem")
        })
    })
}

/// Stacks of rigid discs that fall, each on the one below or on two of them: more contacts than can be
/// independent.
fn stacks() -> impl Strategy<Value = Contact2d> {
    (3..=6usize, vec(-8..=8i8, 3 * 21), prop::sample::select(vec![0.25, 0.5, 1.0])).prop_map(
        |(rows, velocities, mu)| {
            // Row `i` from the bottom has `rows - i` discs of radius 1.
            let first = |row: usize| (0..row).map(|i| rows - i).sum::<usize>();
            let discs = first(rows);
            let (x, y) = (0.5, 0.75_f64.sqrt());
            let mut contacts: Vec<(usize, Option<usize>, [f64; 2])> =
                (0..rows).map(|i| (i, None, [0.0, 1.0])).collect();
            for row in 0..rows {
                for i in 0..rows - row {
                    let disc = first(row) + i;
                    if i > 0 {
                        contacts.push((disc, Some(disc - 1), [1.0, 0.0]));
                    }
                    if row > 0 {
                        let below = first(row - 1) + i;
                        contacts.push((disc, Some(below), [x, y]));
                        contacts.push((disc, Some(below + 1), [-x, y]));
                    }
                }
            }
            let (n, m) = (3 * discs, contacts.len());
            let (mut c_n, mut c_t) = (Mat::zeros(m, n), Mat::zeros(m, n));
            for (row, &(disc, other, [x, y])) in contacts.iter().enumerate() {
                for (disc, sign) in [(Some(disc), 1.0), (other, -1.0)] {
                    let Some(first) = disc.map(|disc| 3 * disc) else { continue };
                    (c_n[(row, first)], c_n[(row, first + 1)]) = (sign * x, sign * y);
                    (c_t[(row, first)], c_t[(row, first + 1)]) = (-sign * y, sign * x);
                    c_t[(row, first + 2)] = -1.0;
                }
            }
            let inertia = |j: usize| if j % 3 == 2 { 0.5 } else { 1.0 };
            let k = Mat::from_fn(n, n, |i, j| if i == j { inertia(j) } else { 0.0 });
            let load = |j: usize| {
                inertia(j) * f64::from(velocities[j]) - if j % 3 == 1 { 1.0 } else { 0.0 }
            };
            let (f, zero) = ((0..n).map(load).collect::<Vec<f64>>(), vec![0.0; m]);
            Contact2d::new(k, f, c_n, c_t, zero.clone(), zero, vec![mu; m])
                .expect("a valid problem")
        },
    )
}

/// A problem with any state, in multiples of 1/4.
fn problems_with_state() -> impl Strategy<Value = (Contact2d, ContactState)> {
    problems().prop_flat_map(|problem| {
        let (n, m) = (problem.displacements(), problem.points());
        (Just(problem), integers(n, -9, 9), integers(m, -2, 9), integers(m, -9, 9)).prop_map(
            |(problem, u, t_n, t_t)| {
                let [u, t_n, t_t] = [u, t_n, t_t].map(|v| v.iter().map(|v| 0.25 * v).collect());
                let with_friction = |t_t: Vec<f64>| {
                    let all = t_t.iter().zip(problem.mu());
                    all.map(|(t, &mu)| if mu > 0.0 { *t } else { 0.0 }).collect()
                };
                let state = problem.state(u, t_n, with_friction(t_t));
                (problem, state)
            },
        )
    })
}

/// The variables of the mixed problem that belong to a state.
fn mixed_point(problem: &Contact2d, state: &ContactState) -> Vec<f64> {
    let part = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        problem.frictional().iter().map(|&i| value(i)).collect()
    };
    let mut z = [state.u.clone(), state.t_n.clone()].concat();
    z.extend(part(&|i| state.t_t[i].max(0.0)));
    z.extend(part(&|i| (-state.t_t[i]).max(0.0)));
    z.extend(part(&|i| state.slip[i].abs()));
    z
}

/// A surface that moves on drags the body into a wall that its friction makes push it back no further.
#[test]
fn a_driven_body_may_jam() {
    let one = |v: f64| mat![[v]];
    let problem =
        Contact2d::new(one(1.0), vec![1.0], one(-1.0), one(-2.0), vec![0.0], vec![1.0], vec![0.5]);
    let problem = problem.unwrap();
    let all = enumerate(&problem.to_general(), &EnumerationSettings::default()).unwrap();
    assert!(!all.is_solvable());
    assert_eq!(found(&problem), [None, None]);
}

proptest! {
    #![proptest_config(common::cases(256))]

    /// Every solution of the general problem, by exact arithmetic, solves the mixed one; where it is the
    /// only one it is what is found of both, and where there is none nothing is.
    #[test]
    fn the_forms_have_the_same_solutions(problem in problems()) {
        let (general, mixed) = (problem.to_general(), problem.to_mixed());
        let all = enumerate(&general, &EnumerationSettings::default()).unwrap();
        let found = found(&problem);
        if problem.initial_slips().iter().all(|s| *s == 0.0) {
            prop_assert!(found[0].is_some());
        }
        let found: Vec<ContactState> = found.into_iter().flatten().collect();
        prop_assert!(all.is_solvable() || found.is_empty());
        for vertex in all.faces.iter().flat_map(|face| &face.vertices) {
            let (t, y) = vertex.rounded();
            let state = problem.recover(&t, &y);
            prop_assert!(problem.residuals(&state).worst() < 1e-13, "{:?}", problem.residuals(&state));
            let z = mixed_point(&problem, &state);
            let m = mixed.m();
            let mut w = mixed.q().to_vec();
            for (j, z) in z.iter().enumerate() {
                m.column(j).for_each(|(i, v)| w[i] += v * z);
            }
            let size = z.iter().chain(mixed.q()).fold(0.0_f64, |max, v| max.max(v.abs()));
            for (i, (&z, &w)) in z.iter().zip(&w).enumerate() {
                let least = if mixed.free()[i] { w.abs() } else { z.min(w).abs() };
                prop_assert!(least <= 1e-13 * (1.0 + size), "{i}: {z} and {w}");
            }
        }
        if let Some(only) = all.unique() {
            let (t, y) = only.rounded();
            let only = problem.recover(&t, &y);
            for state in found {
                assert_close(&state.u, &only.u);
                assert_close(&state.t_n, &only.t_n);
                assert_close(&state.t_t, &only.t_t);
            }
        }
    }

    /// A solution, in the pairs of the general problem, is a start for the next solve.
    #[test]
    fn an_answer_is_a_start(problem in problems()) {
        let solution = Solver::<Contact2d>::solve(&Lemke::default(), &problem).unwrap();
        prop_assume!(solution.is_solved());
        let start = WarmStart::Point { t: solution.t.clone(), y: solution.y.clone() };
        let from_point = Lemke::new(LemkeSettings { start, ..LemkeSettings::default() });
        let again = Solver::<Contact2d>::solve(&from_point, &problem).unwrap();
        prop_assert!(again.is_solved());
        if let Some(basis) = InteriorPoint::default().solve(&problem).unwrap().basis {
            let start = WarmStart::Basis(basis);
            let from_basis = Lemke::new(LemkeSettings { start, ..LemkeSettings::default() });
            prop_assert!(Solver::<Contact2d>::solve(&from_basis, &problem).unwrap().is_solved());
        }
    }

    #[test]
    fn stacks_of_rigid_discs_are_solved(problem in stacks()) {
        let solution = Solver::<Contact2d>::solve(&Lemke::default(), &problem).unwrap();
        prop_assert!(solution.is_solved(), "{}", solution.status);
        let state = problem.recover(&solution.t, &solution.y);
        let worst = problem.residuals(&state).worst();
        prop_assert!(worst < 1e-12, "{worst}");
    }

    #[test]
    fn a_state_comes_back_from_its_pairs((problem, state) in problems_with_state()) {
        let (t, y) = problem.to_pairs(&state);
        prop_assert_eq!(problem.recover(&t, &y), state.clone());
        prop_assert_eq!(problem.from_mixed(&mixed_point(&problem, &state)), state);
    }

    /// Forces, lengths, and every displacement in other units: a rotation is no length.
    #[test]
    fn residuals_do_not_depend_on_units(
        (problem, state) in problems_with_state(),
        force in -20..20i32,
        length in -20..20i32,
        units in vec(-20..20i32, 3),
    ) {
        let (force, length) = (2.0_f64.powi(force), 2.0_f64.powi(length));
        let (n, m) = (problem.displacements(), problem.points());
        // `u_j` is `unit[j]` times the new one, in units of length.
        let unit: Vec<f64> = units[..n].iter().map(|unit| 2.0_f64.powi(*unit)).collect();
        let scaled = |v: &[f64], by: f64| -> Vec<f64> { v.iter().map(|v| v * by).collect() };
        let dense = |matrix: &faer::sparse::SparseColMat<usize, f64>| matrix.to_dense();
        let (k, c_n, c_t) =
            (dense(problem.stiffness()), dense(problem.normal()), dense(problem.tangent()));
        let other = Contact2d::new(
            Mat::from_fn(n, n, |i, j| force / length * k[(i, j)] * unit[i] * unit[j]),
            problem.loads().iter().zip(&unit).map(|(f, unit)| force * f * unit).collect::<Vec<f64>>(),
            Mat::from_fn(m, n, |i, j| c_n[(i, j)] * unit[j]),
            Mat::from_fn(m, n, |i, j| c_t[(i, j)] * unit[j]),
            scaled(problem.initial_gaps(), length),
            scaled(problem.initial_slips(), length),
            problem.mu().to_vec(),
        ).unwrap();
        let u = state.u.iter().zip(&unit).map(|(u, unit)| length * u / unit).collect();
        let in_units = other.state(u, scaled(&state.t_n, force), scaled(&state.t_t, force));
        let (expected, found) = (problem.residuals(&state), other.residuals(&in_units));
        for (expected, found) in [
            (expected.equation, found.equation),
            (expected.feasibility, found.feasibility),
            (expected.complementarity, found.complementarity),
            (expected.natural, found.natural),
        ] {
            prop_assert!((expected - found).abs() <= 1e-13 * expected, "{expected} and {found}");
        }
    }
}

/// Boxes with mass, one on the other, in a step of time: gaps that rounding has left in closed contacts do not matter.
#[test]
fn gaps_of_rounding_are_closed() {
    let boxes = 6;
    let (mass, inertia, weight) = (2e4, 3e3, -20.0);
    let diagonal = |i: usize| if i % 3 == 2 { inertia } else { mass };
    let k = Mat::from_fn(3 * boxes, 3 * boxes, |i, j| if i == j { diagonal(i) } else { 0.0 });
    let f: Vec<f64> = (0..3 * boxes).map(|i| if i % 3 == 1 { weight } else { 0.0 }).collect();
    let mut builder = Contact2d::builder(k, f);
    for number in 0..boxes {
        for (corner, side) in [-0.5, 0.5].into_iter().enumerate() {
            let own = 3 * number;
            // A box turns about its middle, half a metre above the joint.
            let (mut normal, mut tangent) =
                (vec![(own + 1, 1.0), (own + 2, side)], vec![(own, 1.0), (own + 2, 0.5)]);
            if number > 0 {
                let below = own - 3;
                normal.extend([(below + 1, -1.0), (below + 2, -side)]);
                tangent.extend([(below, -1.0), (below + 2, 0.5)]);
            }
            let gap = [-6.7e-15, 0.0, 4.4e-16][(number + corner) % 3];
            builder.add_point(ContactPoint {
                normal: &normal,
                tangent: &tangent,
                gap,
                mu: 0.5,
                ..Default::default()
            });
        }
    }
    let problem = builder.build().unwrap();
    let by_auto = Auto::default().solve(&problem).unwrap();
    assert!(by_auto.info.factorisations < 60, "{}", by_auto.info.factorisations);
    let by_pivots = Solver::<Contact2d>::solve(&Lemke::default(), &problem).unwrap();
    for solution in [by_auto, by_pivots] {
        assert!(solution.is_solved(), "{:?}: {}", solution.info.method, solution.status);
        let state = problem.variables(&solution);
        assert!(problem.residuals(&state).worst() <= 1e-10);
        assert!(problem.residuals(&problem.recover(&solution.t, &solution.y)).worst() <= 1e-10);
        for (number, pair) in state.t_n.chunks(2).enumerate() {
            let carried = -weight * (boxes - number) as f64;
            assert!((pair[0] + pair[1] - carried).abs() < 1e-6 * carried, "{number}: {pair:?}");
        }
    }
}
