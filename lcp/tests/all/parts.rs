//! Problems that fall into independent parts.

use crate::common;

use faer::{Mat, mat};
use lcp::{
    Auto, BoxedLcp, Contact2d, Friction2d, HorizontalLcp, Lcp, Lemke, Matrix, Method, MixedLcp,
    Solution, Solver, Status,
};
use proptest::prelude::*;

fn auto<P>(problem: &P) -> Solution<P>
where
    Auto: Solver<P>,
{
    Auto::default().solve(problem).unwrap()
}

/// Blocks on the diagonal, then rows and columns in another order.
fn joined(blocks: &[(Mat<f64>, Vec<f64>)], order: &[usize]) -> Lcp {
    let n = order.len();
    let (mut m, mut q) = (Mat::zeros(n, n), Vec::<f64>::new());
    for (block, rhs) in blocks {
        m.submatrix_mut(q.len(), q.len(), rhs.len(), rhs.len()).copy_from(block);
        q.extend(rhs);
    }
    let m = Mat::from_fn(n, n, |i, j| m[(order[i], order[j])]);
    Lcp::new(m, order.iter().map(|&i| q[i]).collect::<Vec<f64>>()).unwrap()
}

/// The same problem in units a trillion times larger: all digits of both.
#[test]
fn each_part_has_its_own_units() {
    let m = mat![[2.0, 1.0], [1.0, 2.0]];
    for unit in [1e-12, 1e12] {
        let large = Mat::from_fn(2, 2, |i, j| unit * m[(i, j)]);
        let blocks = [(m.clone(), vec![-5.0, -6.0]), (large, vec![-5.0, -6.0])];
        let solution = auto(&joined(&blocks, &[0, 2, 1, 3]));
        assert_eq!(solution.status, Status::Solved);
        for (z, expected) in solution.t.iter().zip([4.0, 4.0 / unit, 7.0, 7.0 / unit]) {
            assert!((3.0 * z / expected - 1.0).abs() < 1e-15, "{z}");
        }
        assert!(solution.basis.is_some_and(|basis| basis.len() == 4));
        assert!(solution.info.runs[0].reason.starts_with("2 of 2 independent parts"));
    }
}

/// Of 32 pairs two have no solution, though the linear conditions have one: their choices are few, those of the whole
/// are 2^32.
#[test]
fn a_part_without_a_solution_is_a_proof_of_the_whole() {
    // w1 = z2 - 2 z1 - 2 and w2 = 2 z2 - 2 z1 - 2: z = (0, 2) is feasible, and w2 is 2 there.
    let none = (mat![[-2.0, 1.0], [-2.0, 2.0]], vec![-2.0, -2.0]);
    let solvable =
        (mat![[2.0, -1.0, 0.5], [1.0, 2.0, 0.0], [0.0, 1.0, 2.0]], vec![-1.0, 2.0, -3.0]);
    let mut blocks = vec![solvable; 10];
    blocks.insert(4, none);
    let order: Vec<usize> = (0..32).map(|i| 5 * i % 32).collect();
    let problem = joined(&blocks, &order);
    let solution = auto(&problem);
    assert_eq!(solution.status, Status::NoSolution);
    let certificate = solution.certificate.unwrap();
    assert!(certificate.is_proof() && certificate.holds(&HorizontalLcp::from(problem)));
}

/// `z_i = max(0, -q_i / m_i)`, as one problem: the first method has them all.
#[test]
fn many_small_parts_are_solved_together() {
    let n = 3000;
    let entries: Vec<_> = (0..n).map(|i| (i, i, 1.0 + (i % 7) as f64)).collect();
    let m = Matrix::from_triplets(n, n, &entries).unwrap();
    let q: Vec<f64> = (0..n).map(|i| (i % 11) as f64 - 5.0).collect();
    let problem = Lcp::new(m, q.clone()).unwrap();
    let solution = auto(&problem);
    assert_eq!((solution.status, solution.info.method), (Status::Solved, Method::Newton));
    for (i, z) in solution.t.iter().enumerate() {
        let expected = (-q[i] / (1.0 + (i % 7) as f64)).max(0.0);
        assert!((z - expected).abs() <= 1e-15 * expected, "{z} {expected}");
    }
    assert_eq!(solution.info.runs.len(), 1);
}

/// A box far away keeps its digits: the answer has them by its variables.
#[test]
fn bounded_variables_of_parts_keep_their_digits() {
    let m = mat![[1.0, 0.0], [0.0, 3.0]];
    let boxed = BoxedLcp::new(m, vec![-5.0, -9.0], vec![-1e20, 0.0], vec![1e20, 2.0]).unwrap();
    let solution = auto(&boxed);
    assert!(solution.is_solved());
    let (z, w) = boxed.variables(&solution);
    assert_eq!((z, w), (vec![5.0, 2.0], vec![0.0, -3.0]));
}

/// A block that rests and one that is pushed away beside it, which nothing holds.
#[test]
fn a_body_that_falls_beside_one_that_stands_is_a_mechanism_of_both() {
    let select = |part| Mat::from_fn(2, 4, |i, j| f64::from(u8::from(j == 2 * i + part)));
    let bodies = |pushes: [f64; 2]| {
        let (c_n, c_t) = (select(0), select(1));
        let loads = vec![-2.0, pushes[0], -2.0, pushes[1]];
        Contact2d::new(
            Mat::<f64>::zeros(4, 4),
            loads,
            c_n,
            c_t,
            vec![0.0; 2],
            vec![0.0; 2],
            vec![0.5; 2],
        )
        .unwrap()
    };
    let standing = bodies([0.4, -0.9]);
    let solution = auto(&standing);
    assert!(solution.is_solved(), "{}", solution.status);
    let state = standing.variables(&solution);
    assert!((state.t_n[0] - 2.0).abs() < 1e-12 && (state.t_t[1] - 0.9).abs() < 1e-12);
    let falling = bodies([0.4, 1.1]);
    let solution = auto(&falling);
    assert_eq!(solution.status, Status::Infeasible);
    let certificate = solution.certificate.unwrap();
    assert!(certificate.is_proof() && certificate.holds(&falling.to_general()));
}

/// Numbers between -1 and 1.
fn number(i: usize, j: usize) -> f64 {
    (7.0 * i as f64 + 13.0 * j as f64 + 1.0).sin()
}

/// Blocks with dominant diagonals, their rows and columns in other orders.
fn shuffled(sizes: &[usize], rows: &[usize], cols: &[usize]) -> Mat<f64> {
    let n: usize = sizes.iter().sum();
    let mut m = Mat::<f64>::zeros(n, n);
    let mut at = 0;
    for &size in sizes {
        let diagonal = |i, j| if i == j { n as f64 + 1.0 } else { number(i + at, j) };
        m.submatrix_mut(at, at, size, size).copy_from(Mat::from_fn(size, size, diagonal));
        at += size;
    }
    Mat::from_fn(n, n, |i, j| m[(rows[i], cols[j])])
}

fn assert_close(found: &[f64], expected: &[f64]) {
    let is_close = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-11 * a.abs().max(1.0);
    let is_all = found.len() == expected.len() && found.iter().zip(expected).all(is_close);
    assert!(is_all, "{found:?} instead of {expected:?}");
}

/// The parts, so many, have together the answer of the whole. Both answers.
fn assert_joined<P>(problem: &P, count: usize) -> [Solution<P>; 2]
where
    Auto: Solver<P>,
    Lemke: Solver<P>,
{
    let (parts, whole) = (auto(problem), Lemke::default().solve(problem).unwrap());
    assert!(parts.is_solved() && whole.is_solved());
    let reason = &parts.info.runs[0].reason;
    assert!(reason.contains(&format!("of {count} independent parts")), "{reason}");
    assert_close(&parts.t, &whole.t);
    assert_close(&parts.y, &whole.y);
    if let (Some(whole), Some(parts)) = (&whole.basis, &parts.basis) {
        assert_eq!(whole, parts);
    }
    [parts, whole]
}

#[test]
fn every_form_falls_into_blocks() {
    let order = [3, 9, 0, 6, 2, 8, 5, 1, 7, 4];
    let m = shuffled(&[3, 1, 4, 2], &order, &order);
    let q: Vec<f64> = (0..10).map(|i| number(i, 3)).collect();
    let lcp = Lcp::new(m.clone(), q.clone()).unwrap();
    assert_joined(&lcp, 4);
    assert_joined(&Lcp::new(Matrix::from(m.clone()).to_sparse(), q.clone()).unwrap(), 4);
    let free: Vec<bool> = order.iter().map(|i| i % 3 == 0).collect();
    assert_joined(&MixedLcp::new(m.clone(), q.clone(), free).unwrap(), 4);
    let upper = |i: &usize| if i.is_multiple_of(2) { 0.1 } else { f64::INFINITY };
    let upper: Vec<f64> = order.iter().map(upper).collect();
    let boxed = BoxedLcp::new(m.clone(), q.clone(), vec![0.0; 10], upper).unwrap();
    let [(z, w), (z_of_whole, w_of_whole)] =
        assert_joined(&boxed, 4).map(|it| boxed.variables(&it));
    assert_close(&z, &z_of_whole);
    assert_close(&w, &w_of_whole);
    // Rows and pairs in different orders.
    let pairs = [5, 2, 8, 0, 9, 4, 7, 1, 3, 6];
    let a = shuffled(&[2, 5, 3], &order, &pairs);
    let b = Mat::from_fn(10, 10, |i, j| -a[(i, j)] * if i % 2 == j % 3 { 1.0 } else { 0.9 });
    assert_joined(&HorizontalLcp::new(a, b, q).unwrap(), 3);
}

#[test]
fn contacts_fall_into_bodies() {
    let order = [4, 5, 0, 1, 6, 7, 2, 3];
    let w = shuffled(&[4, 2, 2], &order, &order);
    // All pressed, so that the forces are unique.
    let q: Vec<f64> =
        (0..8).map(|i| if usize::is_multiple_of(i, 2) { -2.0 } else { number(i, 2) }).collect();
    assert_joined(&Friction2d::new(w, q, vec![0.1, 0.2, 0.3, 0.4]).unwrap(), 3);
    // Two bodies with the points 0, 2 and 1, of which one has no friction.
    let k = mat![
        [2.0, 0.0, 0.0, 0.0],
        [0.0, 3.0, 0.0, -1.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0, 2.0]
    ];
    let c_n = mat![[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let c_t = mat![[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0]];
    let loads = vec![-1.0, -2.0, 0.8, 0.5];
    let gaps = vec![0.0, 0.1, 0.0];
    let contact = Contact2d::new(k, loads, c_n, c_t, gaps, vec![0.0; 3], vec![0.5, 0.3, 0.0]);
    let contact = contact.unwrap();
    let [parts, whole] = assert_joined(&contact, 2).map(|it| contact.variables(&it));
    for (parts, whole) in [
        (parts.u, whole.u),
        (parts.t_n, whole.t_n),
        (parts.t_t, whole.t_t),
        (parts.gap, whole.gap),
        (parts.slip, whole.slip),
    ] {
        assert_close(&parts, &whole);
    }
}

/// Integers, with zeros: solvable or not, and often degenerate.
fn block() -> impl Strategy<Value = (Mat<f64>, Vec<f64>)> {
    (1..=3_usize).prop_flat_map(|n| {
        let numbers = proptest::collection::vec(-2..=2_i8, n * n + n);
        numbers.prop_map(move |v| {
            let entry = |k: usize| f64::from(v[k]);
            (
                Mat::from_fn(n, n, |i, j| entry(n * i + j)),
                (0..n).map(|i| entry(n * n + i)).collect(),
            )
        })
    })
}

proptest! {
    #![proptest_config(common::cases(256))]

    /// The whole is solved where all its parts are; else there is a proof.
    #[test]
    fn the_whole_is_what_its_parts_are(
        blocks in proptest::collection::vec(block(), 2..6),
        seed in 0..1000_usize,
    ) {
        let n: usize = blocks.iter().map(|(_, q)| q.len()).sum();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by_key(|i| (i * 7919 + seed * (i + 3)) % 104_729);
        let alone = |(m, q): &(Mat<f64>, Vec<f64>)| auto(&Lcp::new(m.clone(), q.clone()).unwrap());
        let are_solved = blocks.iter().all(|block| alone(block).is_solved());
        let problem = joined(&blocks, &order);
        let solution = auto(&problem);
        prop_assert_eq!(solution.is_solved(), are_solved, "{}", solution.status);
        if !are_solved {
            let certificate = solution.certificate.unwrap();
            prop_assert!(certificate.is_proof());
            prop_assert!(certificate.holds(&HorizontalLcp::from(problem)));
        }
    }
}
