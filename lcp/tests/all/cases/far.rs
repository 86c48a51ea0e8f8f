//! Problems with solutions at the end of no path, and problems that are solved by nothing but points far out.

use faer::{Mat, mat};
use lcp::{HorizontalLcp, Lcp, Solution, Status};
use lcp_problems::exact::RBig;
use proptest::prelude::*;

use super::common::cases;
use super::draw::Draw;
use super::methods::{AUTO, Treated};
use super::{solved, truth};

fn exact(value: f64) -> RBig {
    RBig::try_from(value).unwrap()
}

/// `w = M z + q` in exact arithmetic, with `z` and `w` complementary but for rounding.
fn assert_solves(name: &str, lcp: &Lcp, z: &[f64]) {
    let n = z.len();
    for i in 0..n {
        let terms = (0..n).map(|j| exact(lcp.m()[(i, j)]) * exact(z[j]));
        let w = terms.fold(exact(lcp.q()[i]), |sum, term| sum + term).to_f64().value();
        assert!(z[i] >= 0.0 && w >= -1e-9 && z[i].min(w) <= 1e-9, "{name}: {i}, {w} of {z:?}");
    }
}

#[test]
fn a_ray_beside_a_solution() {
    let lcp = Lcp::new(mat![[0.0, 1.0], [0.0, 0.0]], vec![-1.0, 0.0]).unwrap();
    for (name, solution) in solved(&lcp) {
        assert_solves(name, &lcp, &solution.t);
    }
}

/// The proof in exact arithmetic: `-pi.M <= 0`, `pi <= 0` and `pi.q > 0`. What the first misses by rounding leaves no
/// room for points within a million times the right-hand side.
fn assert_proved(lcp: &Lcp, solution: &Solution<Lcp>) {
    let pi: Vec<RBig> = solution.farkas().unwrap().iter().map(|pi| exact(*pi)).collect();
    let n = pi.len();
    let product = |entry: &dyn Fn(usize) -> f64| {
        let sum = (0..n).fold(RBig::ZERO, |sum, i| sum + exact(entry(i)) * &pi[i]);
        sum.to_f64().value()
    };
    let gap = product(&|i| lcp.q()[i]);
    assert!(gap > 0.0 && pi.iter().all(|pi| *pi <= RBig::ZERO));
    assert!((0..n).all(|j| product(&|i| -lcp.m()[(i, j)]) <= 1e-6 * gap), "{pi:?}");
}

/// `w_1 + w_2 = -size`, which is infeasible by a little: the proof, or a point as near to a solution as there is, but
/// nothing far out.
#[test]
fn infeasible_by_a_little() {
    for exponent in 1..=15 {
        let gap = 10_f64.powi(-exponent);
        let lcp = Lcp::new(mat![[1.0, -1.0], [-1.0, 1.0]], vec![-1.0, 1.0 - gap]).unwrap();
        for (name, answer) in lcp.answers() {
            let Ok(solution) = answer else {
                assert_ne!(name, AUTO);
                continue;
            };
            let is_near =
                (solution.t[0] - 1.0).abs() <= 2.0 * gap && solution.t[1].abs() <= 2.0 * gap;
            match solution.status {
                Status::Infeasible => assert_proved(&lcp, &solution),
                // A point anywhere on the way out may be within the tolerance of a method that goes there.
                Status::Solved => assert!(
                    gap < 1e-9 && (is_near || name != AUTO && solution.t[0] < 1e4),
                    "{name}, {gap:e}: {:?}",
                    solution.t
                ),
                Status::AlmostSolved => {
                    assert!(is_near && gap < 1e-4, "{name}, {gap:e}: {:?}", solution.t);
                }
                status => assert_ne!(name, AUTO, "{gap:e}: {status} at {:?}", solution.t),
            }
        }
    }
}

proptest! {
    #![proptest_config(cases(256))]

    /// Strictly triangular matrices, of which no power but the first few is nonzero: nothing pushes back.
    #[test]
    fn triangular_problems(seed in any::<u64>()) {
        let draw = &mut Draw::new(seed);
        let n = 2 + draw.index(4);
        let m = Mat::from_fn(n, n, |i, j| if i < j { draw.number(-2, 2) } else { 0.0 });
        let q: Vec<f64> = (0..n).map(|_| draw.number(-2, 2)).collect();
        let lcp = Lcp::new(m, q).unwrap();
        prop_assume!(truth(&HorizontalLcp::from(lcp.clone())).is_solvable());
        for (name, solution) in solved(&lcp) {
            assert_solves(name, &lcp, &solution.t);
        }
    }
}
