//! Problems made of shuffled blocks fall into these, and come together again.

use faer::{Mat, mat};

use super::*;
use crate::random::SplitMix;
use crate::{Lemke, Solver, Status};

/// A dense block with a dominant diagonal.
fn dominant(n: usize, random: &mut SplitMix) -> Mat<f64> {
    let mut m = Mat::from_fn(n, n, |_, _| 2.0 * random.next_f64() - 1.0);
    (0..n).for_each(|i| m[(i, i)] = n as f64 + 1.0);
    m
}

/// Blocks on the diagonal.
fn blocks(sizes: &[usize], random: &mut SplitMix) -> Mat<f64> {
    let n = sizes.iter().sum();
    let mut m = Mat::zeros(n, n);
    let mut at = 0;
    for &size in sizes {
        m.submatrix_mut(at, at, size, size).copy_from(dominant(size, random));
        at += size;
    }
    m
}

fn shuffled(n: usize, random: &mut SplitMix) -> Vec<usize> {
    let mut left: Vec<usize> = (0..n).collect();
    let mut order = Vec::new();
    while let Some(&next) = random.pick(&left) {
        left.retain(|it| *it != next);
        order.push(next);
    }
    order
}

fn permuted(m: &Mat<f64>, rows: &[usize], cols: &[usize]) -> Mat<f64> {
    Mat::from_fn(rows.len(), cols.len(), |i, j| m[(rows[i], cols[j])])
}

fn sparse(m: &Mat<f64>) -> Matrix {
    let places = (0..m.ncols()).flat_map(|j| (0..m.nrows()).map(move |i| (i, j)));
    let entries = places.map(|(i, j)| (i, j, m[(i, j)])).filter(|(_, _, v)| *v != 0.0);
    Matrix::from_entries(m.nrows(), m.ncols(), entries)
}

fn vector(n: usize, random: &mut SplitMix) -> Vec<f64> {
    (0..n).map(|_| 2.0 * random.next_f64() - 1.0).collect()
}

/// Solves a problem as a whole and by its parts, of which it has so many: the same answers.
fn agree<P: Divide>(problem: &P, count: usize, order: usize)
where
    Lemke: Solver<P>,
{
    let lemke = Lemke::default();
    let whole = lemke.solve(problem).expect("valid settings");
    let parts = problem.parts().expect("several parts");
    assert_eq!(parts.len(), count);
    let (mut t, mut y) = (vec![f64::NAN; order], vec![f64::NAN; order]);
    let mut sides = vec![Side::T; order];
    for part in &parts {
        let solution = lemke.solve(&part.problem).expect("valid settings");
        assert_eq!(solution.status, Status::Solved);
        part.put_pairs(&solution.t, &mut t);
        part.put_pairs(&solution.y, &mut y);
        if let Some(basis) = solution.basis {
            part.put_pairs(basis.sides(), &mut sides);
        }
        assert!(part.problem.parts().is_none(), "a part falls no further");
    }
    assert_eq!(whole.status, Status::Solved);
    for (a, b) in whole.t.iter().chain(&whole.y).zip(t.iter().chain(&y)) {
        assert!((a - b).abs() <= 1e-12 * a.abs().max(1.0), "{a} {b}");
    }
    // Of contact it is none of these pairs.
    assert!(whole.basis.is_none_or(|basis| basis.sides() == sides));
}

#[test]
fn the_standard_form_falls_into_blocks() {
    let mut random = SplitMix::new(1);
    let order = shuffled(10, &mut random);
    let m = permuted(&blocks(&[3, 1, 4, 2], &mut random), &order, &order);
    let q = vector(10, &mut random);
    agree(&Lcp::new(sparse(&m), q.clone()).expect("fits"), 4, 10);
    agree(&Lcp::new(m.clone(), q.clone()).expect("fits"), 4, 10);
    let free: Vec<bool> = order.iter().map(|i| i % 3 == 0).collect();
    agree(&MixedLcp::new(m.clone(), q.clone(), free).expect("fits"), 4, 10);
    let upper: Vec<f64> =
        order.iter().map(|&i| if i % 2 == 0 { 0.1 } else { f64::INFINITY }).collect();
    agree(&BoxedLcp::new(m, q, vec![0.0; 10], upper).expect("fits"), 4, 15);
}

/// Rows and pairs in different orders.
#[test]
fn the_general_form_falls_into_blocks() {
    let mut random = SplitMix::new(2);
    let (rows, pairs) = (shuffled(9, &mut random), shuffled(9, &mut random));
    let a = permuted(&blocks(&[2, 4, 3], &mut random), &rows, &pairs);
    let b = permuted(&blocks(&[2, 4, 3], &mut random), &rows, &pairs);
    let b = Mat::from_fn(9, 9, |i, j| -b[(i, j)]);
    agree(&HorizontalLcp::new(a, b, vector(9, &mut random)).expect("fits"), 3, 9);
}

#[test]
fn contacts_fall_into_bodies() {
    let mut random = SplitMix::new(3);
    let order = [2, 0, 3, 1];
    let pairs: Vec<usize> = order.iter().flat_map(|k| [2 * k, 2 * k + 1]).collect();
    let w = permuted(&blocks(&[4, 2, 2], &mut random), &pairs, &pairs);
    let friction = Friction2d::new(w, vector(8, &mut random), vec![0.1, 0.2, 0.3, 0.0]);
    agree(&friction.expect("fits"), 3, 12);

    // Two bodies with the points 0, 2 and 1, of which one has no friction.
    let k = mat![
        [2.0, 0.0, 0.0, 0.0],
        [0.0, 3.0, 0.0, -1.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0, 2.0]
    ];
    let c_n = mat![[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let c_t = mat![[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0]];
    let contact = Contact2d::new(
        k,
        vec![-1.0, -2.0, 0.1, 0.5],
        c_n,
        c_t,
        vec![0.0, 0.1, 0.0],
        vec![0.0; 3],
        vec![0.5, 0.3, 0.0],
    );
    let contact = contact.expect("fits");
    agree(&contact, 2, contact.order());
    let whole = Lemke::default().solve(&contact).expect("valid settings");
    let state = contact.recover(&whole.t, &whole.y);
    let nan = || vec![f64::NAN; 3];
    let (u, mut joined) = (vec![f64::NAN; 4], contact.state(vec![0.0; 4], nan(), nan()));
    joined.u = u;
    for part in contact.parts().expect("two bodies") {
        let solution = Lemke::default().solve(&part.problem).expect("valid settings");
        part.put_state(&part.problem.recover(&solution.t, &solution.y), &mut joined);
    }
    let all = |state: &ContactState| {
        [&state.u, &state.t_n, &state.t_t, &state.gap, &state.slip].map(Clone::clone).concat()
    };
    for (a, b) in all(&state).iter().zip(all(&joined)) {
        assert!((a - b).abs() < 1e-13, "{a} {b}");
    }
}

#[test]
fn a_connected_problem_has_no_parts() {
    let mut random = SplitMix::new(4);
    let m = dominant(5, &mut random);
    assert!(Lcp::new(m.clone(), vec![1.0; 5]).expect("fits").parts().is_none());
    assert!(HorizontalLcp::new(m.clone(), m, vec![1.0; 5]).expect("fits").parts().is_none());
    assert!(Lcp::new(Mat::zeros(0, 0), Vec::new()).expect("fits").parts().is_none());
}

/// A row and a pair of zeros belong together, since a part has as many rows as pairs.
#[test]
fn odd_rows_and_pairs_make_one_part() {
    let a = mat![[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let b = mat![[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 2.0]];
    let parts = HorizontalLcp::new(a, b, vec![1.0, 2.0, 3.0]).expect("fits").parts();
    let parts = parts.expect("several parts");
    let places: Vec<_> = parts.iter().map(|it| (it.rows.clone(), it.pairs.clone())).collect();
    assert_eq!(places, [(vec![0], vec![0]), (vec![1], vec![1]), (vec![2], vec![2])]);
}

#[test]
fn starts_and_proofs_find_their_places() {
    let m = mat![[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let parts = Lcp::new(m, vec![-1.0, -1.0, -1.0]).expect("fits").parts().expect("three");
    let start = WarmStart::Point { t: vec![1.0, 2.0, 3.0], y: vec![4.0, 5.0, 6.0] };
    assert_eq!(parts[1].start(&start), WarmStart::Point { t: vec![2.0], y: vec![5.0] });
    let basis = WarmStart::Basis(Basis::new(vec![Side::T, Side::Y, Side::T]));
    assert_eq!(parts[1].start(&basis), WarmStart::Basis(Basis::all(Side::Y, 1)));
    let proof = parts[1].certificate(&Certificate::Farkas { pi: vec![-1.0] }, 3);
    assert_eq!(proof, Certificate::Farkas { pi: vec![0.0, -1.0, 0.0] });
}
