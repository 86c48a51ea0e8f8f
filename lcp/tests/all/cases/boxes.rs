//! Bounds so far away that they are none: an error, or an answer that does not feel them.

use faer::{Mat, mat};
use lcp::{BoxedLcp, Error};

use super::assert_near;
use super::methods::{AUTO, Treated};

fn assert_inside(m: &Mat<f64>, q: &[f64], (lower, upper): (f64, f64), exact: &[f64]) {
    let n = q.len();
    let boxed = match BoxedLcp::new(m.clone(), q.to_vec(), vec![lower; n], vec![upper; n]) {
        Err(Error::Bounds { .. }) => return,
        boxed => boxed.unwrap(),
    };
    for (name, answer) in boxed.answers() {
        let bounds = format!("{name} in [{lower:e}, {upper:e}]");
        match answer {
            Ok(solution) if solution.is_solved() => {
                let (z, _) = boxed.variables(&solution);
                assert_near(&bounds, &z, exact, 1.0);
            }
            Err(Error::Bounds { .. }) => {}
            other => assert_ne!(name, AUTO, "{bounds}: {other:?}"),
        }
    }
}

#[test]
fn an_identity_in_a_huge_box() {
    let m = mat![[1.0, 0.0], [0.0, 1.0]];
    assert_inside(&m, &[-5.0, -3.0], (-1e20, 1e20), &[5.0, 3.0]);
}

#[test]
fn a_huge_upper_bound() {
    let m = mat![[2.0, 1.0], [1.0, 2.0]];
    assert_inside(&m, &[-5.0, -6.0], (0.0, 1e16), &[4.0 / 3.0, 7.0 / 3.0]);
}

#[test]
fn bounds_of_all_sizes() {
    let m = mat![[3.0, -1.0, 0.0], [1.0, 2.0, 1.0], [0.0, -1.0, 4.0]];
    // M z = -q for z = (2, 1, 3).
    let (q, exact) = ([-5.0, -7.0, -11.0], [2.0, 1.0, 3.0]);
    for exponent in 1..=307 {
        let bound = 10_f64.powi(exponent);
        for bounds in [(-bound, bound), (0.0, bound), (-bound, 5.0), (-bound, f64::INFINITY)] {
            assert_inside(&m, &q, bounds, &exact);
        }
    }
}
