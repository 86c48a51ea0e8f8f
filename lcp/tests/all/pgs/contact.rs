//! Contact with friction, reduced to the contacts and with the displacements.

use faer::{Mat, mat};
use lcp::{
    Contact2d, Error, Friction2d, HorizontalLcp, Lemke, Method, ProjectedGaussSeidel,
    ProjectedGaussSeidelSettings, Solver, Status, WarmStart,
};
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::cases;
use super::{check_honest, distance, settings, sparse, to};

/// `W = G^T G / n + 1`, and small coefficients of friction: one solution.
fn friction() -> impl Strategy<Value = Friction2d> {
    (1..=10_usize, any::<bool>()).prop_flat_map(|(contacts, is_sparse)| {
        let n = 2 * contacts;
        let data = (vec(-1.0..1.0_f64, n * n), vec(-3.0..1.0_f64, n), vec(0.0..0.3_f64, contacts));
        data.prop_map(move |(g, q, mut mu)| {
            if contacts > 2 {
                mu[1] = 0.0;
            }
            let g = Mat::from_fn(n, n, |i, j| g[i * n + j]);
            let w = g.transpose() * &g / faer::Scale(n as f64) + Mat::<f64>::identity(n, n);
            Friction2d::new(if is_sparse { sparse(&w) } else { w.into() }, q, mu).unwrap()
        })
    })
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn friction_agrees_with_lemke(friction in friction(), relaxation in 0.8..1.2_f64) {
        let general: HorizontalLcp = friction.standard().clone().into();
        let expected = Lemke::default().solve(&general).unwrap();
        prop_assert!(expected.is_solved());
        let expected = friction.forces(&expected.t);
        for tolerance in [1e-4, 1e-8, 1e-12] {
            let settings = ProjectedGaussSeidelSettings { tolerance, relaxation, ..settings() };
            let solution = ProjectedGaussSeidel::new(settings).solve(&friction).unwrap();
            check_honest(&solution, &general, tolerance);
            prop_assert_eq!(solution.status, Status::Solved);
            let forces = friction.forces(&solution.t);
            prop_assert!(distance(&forces.normal, &expected.normal) <= 1e2 * tolerance);
            for ((tangential, normal), mu) in forces.tangential.iter().zip(&forces.normal).zip(friction.mu()) {
                prop_assert!(tangential.abs() <= mu * normal * (1.0 + 1e-15));
            }
        }
    }

    /// Contacts in any state, with any coefficient of friction: whatever is called solved is.
    #[test]
    fn friction_is_never_wrong(
        (w, q, mu) in (1..=4_usize).prop_flat_map(|contacts| {
            let n = 2 * contacts;
            (vec(-1.0..1.0_f64, n * n), vec(-2.0..1.0_f64, n), vec(0.0..4.0_f64, contacts))
        })
    ) {
        let n = q.len();
        let w = Mat::from_fn(n, n, |i, j| w[i * n + j] + if i == j { 1.5 } else { 0.0 });
        let friction = Friction2d::new(w, q, mu).unwrap();
        let settings = ProjectedGaussSeidelSettings { max_iterations: 600, ..settings() };
        let solution = ProjectedGaussSeidel::new(settings).solve(&friction).unwrap();
        check_honest(&solution, &friction.standard().clone().into(), 1e-8);
    }
}

/// One contact pushed ever harder: it sticks, then it slides with the force `mu r_N`.
#[test]
fn a_contact_sticks_and_slides() {
    for (push, force) in [(0.0, 0.0), (0.5, -0.5), (-0.5, 0.5), (3.0, -1.0), (-3.0, 1.0)] {
        let friction =
            Friction2d::new(Mat::<f64>::identity(2, 2), vec![-2.0, push], vec![0.5]).unwrap();
        let solution = to(1e-14).solve(&friction).unwrap();
        assert!(solution.is_solved());
        let forces = friction.forces(&solution.t);
        assert_eq!((forces.normal, forces.tangential), (vec![2.0], vec![force]));
    }
}

/// Two blocks of masses 1 and 2, coupled by nothing but their contacts, with a floor.
fn blocks(push: f64) -> Contact2d {
    let masses = mat![
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 2.0, 0.0],
        [0.0, 0.0, 0.0, 2.0],
    ];
    let normal = mat![[0.0, 1.0, 0.0, 0.0], [0.0, -1.0, 0.0, 1.0]];
    let tangent = mat![[1.0, 0.0, 0.0, 0.0], [-1.0, 0.0, 1.0, 0.0]];
    let loads = vec![0.0, -1.0, push, -2.0];
    Contact2d::new(masses, loads, normal, tangent, vec![0.0; 2], vec![0.0; 2], vec![0.5; 2])
        .unwrap()
}

/// The upper block is pushed: it sticks up to the force `mu` times its weight, then slides.
#[test]
fn blocks_on_each_other() {
    for (push, force) in [(0.4, -0.4), (5.0, -1.0), (-5.0, 1.0)] {
        let contact = blocks(push);
        let solution = to(1e-13).solve(&contact).unwrap();
        assert!(solution.is_solved(), "{:?} {:?}", solution.status, solution.residuals);
        let state = contact.recover(&solution.t, &solution.y);
        assert!(distance(&state.t_n, &[3.0, 2.0]) <= 1e-12, "{state:?}");
        assert!((state.t_t[1] - force).abs() <= 1e-12, "{state:?}");
        assert_eq!(solution.info.factorisations, 4);
    }
}

/// Masses on top of each other, pushed to the side, come to rest: every contact carries what is above,
/// and holds all pushes above. Without any displacement there is no length to measure gaps by.
#[test]
fn a_pile_comes_to_rest() {
    const COUNT: usize = 12;
    let n = 2 * COUNT;
    let entry = |i: usize, j: usize, axis: usize| {
        let (body, is_same) = (j / 2, j % 2 == axis);
        if is_same && body == i {
            1.0
        } else if is_same && body + 1 == i {
            -1.0
        } else {
            0.0
        }
    };
    let masses = Mat::from_fn(n, n, |i, j| if i == j { 1.0 + (i / 2 % 3) as f64 } else { 0.0 });
    let loads: Vec<f64> = (0..n).map(|j| if j % 2 == 0 { 0.1 } else { -1.0 }).collect();
    let [tangent, normal] = [0, 1].map(|axis| Mat::from_fn(COUNT, n, |i, j| entry(i, j, axis)));
    let none = || vec![0.0; COUNT];
    let contact =
        Contact2d::new(masses, loads, normal, tangent, none(), none(), vec![0.2; COUNT]).unwrap();
    let above: Vec<f64> = (0..COUNT).map(|i| (COUNT - i) as f64).collect();
    let pushes: Vec<f64> = above.iter().map(|above| -0.1 * above).collect();
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let settings = ProjectedGaussSeidelSettings { tolerance, relaxation: 1.6, ..settings() };
        let solution = ProjectedGaussSeidel::new(settings).solve(&contact).unwrap();
        assert_eq!(solution.status, Status::Solved);
        let state = contact.recover(&solution.t, &solution.y);
        assert!(contact.residuals(&state).worst() <= tolerance);
        assert!(state.u.iter().all(|u| u.abs() <= 1e2 * tolerance));
        assert!(distance(&state.t_n, &above) <= 1e2 * tolerance);
        assert!(distance(&state.t_t, &pushes) <= 1e2 * tolerance);
        // It is the residual that decreases, not a threshold that is met.
        let history = &solution.info.history;
        assert!(history[3 * history.len() / 4] <= 0.1, "{history:?}");
    }
}

/// An elastic chain of which every node may touch a floor, with friction at every other one.
fn elastic(nodes: usize, q: &[f64]) -> Contact2d {
    let n = 2 * nodes;
    let mut k = Mat::<f64>::zeros(n, n);
    for i in 0..n {
        k[(i, i)] += 2.5;
        if i + 2 < n {
            k[(i, i + 2)] -= 1.0;
            k[(i + 2, i)] -= 1.0;
        }
    }
    let normal = Mat::from_fn(nodes, n, |i, j| f64::from(u8::from(j == 2 * i + 1)));
    let tangent = Mat::from_fn(nodes, n, |i, j| f64::from(u8::from(j == 2 * i)));
    let mu: Vec<f64> = (0..nodes).map(|i| if i % 2 == 0 { 0.3 } else { 0.0 }).collect();
    let gaps = vec![0.1; nodes];
    Contact2d::new(k, q.to_vec(), normal, tangent, gaps, vec![0.0; nodes], mu).unwrap()
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn elastic_contact_agrees_with_lemke(
        (nodes, loads) in (1..=12_usize).prop_flat_map(|n| (Just(n), vec(-1.0..1.0_f64, 2 * n)))
    ) {
        let contact = elastic(nodes, &loads);
        let lemke = Solver::<Contact2d>::solve(&Lemke::default(), &contact).unwrap();
        prop_assert!(lemke.is_solved());
        let expected = contact.recover(&lemke.t, &lemke.y);
        for tolerance in [1e-4, 1e-8, 1e-12] {
            let solution = to(tolerance).solve(&contact).unwrap();
            prop_assert_eq!(solution.status, Status::Solved);
            let state = contact.recover(&solution.t, &solution.y);
            let residual = contact.residuals(&state).worst();
            prop_assert!(residual <= tolerance * (1.0 + 1e-3) + 1e-15);
            prop_assert!(distance(&state.u, &expected.u) <= 1e3 * tolerance);
        }
        let point = WarmStart::Point { t: lemke.t, y: lemke.y };
        let warm = ProjectedGaussSeidelSettings { start: point, ..settings() };
        let solution = ProjectedGaussSeidel::new(warm).solve(&contact).unwrap();
        prop_assert_eq!((solution.status, solution.info.iterations), (Status::Solved, 0));
    }
}

#[test]
fn floating_bodies_are_not_treated() {
    let contact = |k: Mat<f64>, c_n: Mat<f64>| {
        let c_t = mat![[1.0, 0.0]];
        Contact2d::new(k, vec![0.0; 2], c_n, c_t, vec![0.0], vec![0.0], vec![0.5]).unwrap()
    };
    let reason = |contact: Contact2d| match to(1e-8).solve(&contact) {
        Err(Error::NotTreated { method: Method::GaussSeidel, reason }) => reason,
        other => panic!("{other:?}"),
    };
    let (zero, unit) = (mat![[1.0, 0.0], [0.0, 0.0]], Mat::<f64>::identity(2, 2));
    assert!(reason(contact(zero, mat![[0.0, 1.0]])).contains("not positive definite"));
    let spring = mat![[1.0, -1.0], [-1.0, 1.0]];
    assert!(reason(contact(spring, mat![[0.0, 1.0]])).contains("not positive definite"));
    let nearly = mat![[3.0, -1.0 / 3.0], [-1.0 / 3.0, 1.0 / 27.0 + 1e-18]];
    assert!(reason(contact(nearly, mat![[0.0, 1.0]])).contains("not positive definite"));
    assert!(reason(contact(unit, mat![[0.0, 0.0]])).contains("row 0 has the diagonal entry 0"));
}
