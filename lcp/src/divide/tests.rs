use faer::{Mat, mat};

use super::*;
use crate::Basis;

#[test]
fn a_connected_problem_has_no_parts() {
    let m = Mat::from_fn(5, 5, |i, j| (1 + i + 2 * j) as f64);
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
