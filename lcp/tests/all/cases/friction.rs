//! Friction that is nearly infinite: an error, or forces that obey the law.

use faer::{Mat, mat};
use lcp::{Error, Friction2d, Status};
use lcp_problems::exact::RBig;
use proptest::prelude::*;

use super::common::cases;
use super::draw::Draw;
use super::methods::{AUTO, Treated};

/// Of forces, which the data make about one, and of velocities as a part of the terms of their contact.
const ROUNDING: f64 = 1e-8;

fn exact(value: f64) -> RBig {
    RBig::try_from(value).unwrap()
}

/// Coulomb's law, with velocities without rounding.
fn violation(problem: &Friction2d, normal: &[f64], tangential: &[f64]) -> Option<String> {
    let forces: Vec<f64> = normal.iter().zip(tangential).flat_map(|(n, t)| [*n, *t]).collect();
    let size = |i: usize| {
        let sizes = (0..forces.len()).map(|j| (problem.w()[(i, j)] * forces[j]).abs());
        sizes.fold(problem.q()[i].abs(), |sum, size| sum + size)
    };
    let velocity = |i: usize| {
        let terms = (0..forces.len()).map(|j| exact(problem.w()[(i, j)]) * exact(forces[j]));
        let v = terms.fold(exact(problem.q()[i]), |sum, term| sum + term).to_f64().value();
        v / size(i).max(size(i ^ 1)).max(f64::MIN_POSITIVE)
    };
    for (i, &mu) in problem.mu().iter().enumerate() {
        let (force, friction, bound) = (normal[i], tangential[i], mu * normal[i]);
        let (v_n, v_t) = (velocity(2 * i), velocity(2 * i + 1));
        let slack = bound * ROUNDING + ROUNDING;
        let is_lawful = force >= -ROUNDING
            && v_n >= -ROUNDING
            && force.min(v_n) <= ROUNDING
            && friction.abs() <= bound + slack
            && (friction <= -bound + slack || v_t <= ROUNDING)
            && (friction >= bound - slack || v_t >= -ROUNDING);
        if !is_lawful {
            return Some(format!("contact {i}: {force} {friction} with {v_n:e} {v_t:e}"));
        }
    }
    None
}

/// With friction beyond this an error is a good answer, too, and so is one that is not called solved.
const LARGE: f64 = 1e5;

fn assert_lawful(w: &Mat<f64>, q: &[f64], mu: &[f64]) {
    let is_large = mu.iter().any(|mu| *mu > LARGE);
    let problem = match Friction2d::new(w.clone(), q.to_vec(), mu.to_vec()) {
        Err(Error::Setting { name: "mu", .. }) if is_large => return,
        problem => problem.unwrap(),
    };
    for (name, answer) in problem.answers() {
        match answer {
            Ok(solution) if solution.is_solved() => {
                let forces = problem.forces(&solution.t);
                let violation = violation(&problem, &forces.normal, &forces.tangential);
                assert_eq!(violation, None, "{name}, mu = {mu:?}, {w:?}, {q:?}");
            }
            Err(Error::Setting { name: "mu", .. }) if is_large => {}
            Ok(solution) if is_large && solution.status == Status::AlmostSolved => {}
            other => assert!(name != AUTO, "mu = {mu:?}, {w:?}, {q:?}: {other:?}"),
        }
    }
}

#[test]
fn a_contact_that_sticks_with_all_its_friction() {
    let w = mat![[2.0, -1.0], [-1.0, 1.0]];
    for exponent in 0..=300 {
        assert_lawful(&w, &[-2.0, -0.25], &[10_f64.powi(exponent)]);
    }
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn contacts_with_friction_of_all_sizes(seed in any::<u64>(), exponent in 0..=20_i32) {
        let draw = &mut Draw::new(seed);
        let contacts = 1 + draw.index(2);
        let n = 2 * contacts;
        let c = Mat::from_fn(n, n, |_, _| draw.number(-2, 2));
        let w = &c * c.transpose() + Mat::<f64>::identity(n, n);
        let q: Vec<f64> = (0..n).map(|_| 0.25 * draw.number(-9, 9)).collect();
        let mu: Vec<f64> = (0..contacts).map(|_| draw.number(1, 9) * 10_f64.powi(exponent)).collect();
        assert_lawful(&w, &q, &mu);
    }
}
