//! Problems that have no solution by a hair: far out, what a row lacks is small against its terms.

use crate::common;

use common::cases;
use faer::Mat;
use lcp::{
    Auto, Contact2d, Error, InteriorPoint, Lcp, MixedLcp, QuadraticProgram, Solution, Solver,
};
use proptest::collection::vec;
use proptest::prelude::*;

const LARGEST: usize = 9;

/// `M` symmetric, semidefinite and of small whole numbers, with `M v = 0` for a `v > 0`; and `q` with
/// `q.v = -lack v_0`. A solution would have `w = M z + q >= 0`, and thus `q.v = w.v >= 0`.
#[derive(Debug, Clone)]
struct Contradiction {
    m: Mat<f64>,
    q: Vec<f64>,
}

fn contradictions() -> impl Strategy<Value = Contradiction> {
    let numbers = (vec(1..=2_i8, 2..=LARGEST), vec(any::<(u8, u8)>(), 1..=LARGEST));
    (numbers, vec(-4..=4_i8, LARGEST), 12..=29_i32).prop_map(|((v, edges), mut q, bits)| {
        let n = v.len();
        let mut m = Mat::zeros(n, n);
        for (i, j) in edges.into_iter().map(|(i, j)| (usize::from(i) % n, usize::from(j) % n)) {
            // The square of `v_j x_i - v_i x_j`.
            let row = [(i, f64::from(v[j])), (j, -f64::from(v[i]))];
            for ((a, x), (b, y)) in row.into_iter().flat_map(|a| row.map(|b| (a, b))) {
                m[(a, b)] += if i == j { 0.0 } else { x * y };
            }
        }
        q.truncate(n);
        let mut q: Vec<f64> = q.into_iter().map(f64::from).collect();
        let work: f64 = q.iter().zip(&v).map(|(q, v)| q * f64::from(*v)).sum();
        q[0] -= work / f64::from(v[0]);
        // Shared by all rows, and relative to their terms, it is still above the tolerance.
        let size = q.iter().fold(1.0_f64, |max, q| max.max(q.abs()));
        q[0] -= 8.0 * size * 2_f64.powi(-bits);
        Contradiction { m, q }
    })
}

fn is_solved<P>(solution: Result<Solution<P>, Error>) -> bool {
    solution.unwrap().is_solved()
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn there_is_no_solution_however_far_out(Contradiction { m, q } in contradictions()) {
        let n = q.len();
        let standard = Lcp::new(m.clone(), q.clone()).unwrap();
        let mixed = MixedLcp::new(m.clone(), q.clone(), vec![false; n]).unwrap();
        prop_assert!(!is_solved(InteriorPoint::default().solve(&mixed)));
        prop_assert!(!is_solved(QuadraticProgram::default().solve(&standard)));
        prop_assert!(!is_solved(QuadraticProgram::default().solve(&mixed)));
        prop_assert!(!is_solved(Auto::default().solve(&standard)));
        prop_assert!(!is_solved(Auto::default().solve(&mixed)));
        // Gaps are the displacements themselves: the same problem.
        let loads: Vec<f64> = q.iter().map(|q| -q).collect();
        let (one, none) = (Mat::identity(n, n), vec![0.0; n]);
        let contact = Contact2d::new(m, loads, one, Mat::zeros(n, n), none.clone(), none.clone(), none);
        let contact = contact.unwrap();
        prop_assert!(!is_solved(InteriorPoint::default().solve(&contact)));
        prop_assert!(!is_solved(QuadraticProgram::default().solve(&contact)));
        prop_assert!(!is_solved(Auto::default().solve(&contact)));
    }
}
