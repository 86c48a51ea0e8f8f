//! Data of problems that are numbers without rounding errors.

use lcp::faer::Mat;
use lcp::{Contact2d, Lcp};

use super::problem::Problem;

/// A point `(t, y)`, of a standard problem `(z, w)`.
pub type Point = (Vec<f64>, Vec<f64>);

/// `w = M z + q` with `q = w - M z`, which the catalogue checks to have no rounding error.
pub fn with_solution(m: Mat<f64>, (z, w): &Point) -> Problem {
    let mz = |i: usize| (0..z.len()).map(|j| m[(i, j)] * z[j]).sum::<f64>();
    let q = (0..z.len()).map(|i| w[i] - mz(i)).collect();
    standard(m, q)
}

pub fn standard(m: Mat<f64>, q: Vec<f64>) -> Problem {
    Problem::Standard(Lcp::new(m, q).unwrap())
}

/// One, two or three, on one side of every pair or the other.
pub fn strict(n: usize) -> Point {
    let value = |i: usize| f64::from(u8::try_from(1 + i % 3).unwrap());
    let side = |is_t: bool| (0..n).map(move |i| if (i % 2 == 0) == is_t { value(i) } else { 0.0 });
    (side(true).collect(), side(false).collect())
}

/// The same, where of ten pairs in sequence so many vanish.
pub fn degenerate(n: usize, tenths: usize) -> Point {
    let (mut t, mut y) = strict(n);
    // Three and ten have no common factor: the pairs that vanish are spread out.
    for i in (0..n).filter(|i| 3 * i % 10 < tenths) {
        (t[i], y[i]) = (0.0, 0.0);
    }
    (t, y)
}

/// Minus one, zero and one, without a pattern that a method could know.
pub fn sign(i: usize, j: usize) -> f64 {
    [0.0, 1.0, -1.0, 1.0, 0.0, -1.0, -1.0][(i * i + 3 * i * j + 5 * j) % 7]
}

/// `C C^T + 1` with signs in `C`: positive definite.
pub fn gram(n: usize) -> Mat<f64> {
    let c = Mat::from_fn(n, n, sign);
    &c * c.transpose() + Mat::<f64>::identity(n, n)
}

/// `L D L^T` with ones and signs in `L`, and `D` from one to `2^-bits`: the condition number is about `2^bits`.
pub fn ill_conditioned(n: usize, bits: u32) -> Mat<f64> {
    let l = |i: usize, k: usize| match i.cmp(&k) {
        std::cmp::Ordering::Less => 0.0,
        std::cmp::Ordering::Equal => 1.0,
        std::cmp::Ordering::Greater if k == 0 => 1.0,
        std::cmp::Ordering::Greater => sign(i, k),
    };
    let d = |k: usize| (-f64::from(bits) * k as f64 / (n - 1) as f64).round().exp2();
    Mat::from_fn(n, n, |i, j| (0..n).map(|k| l(i, k) * d(k) * l(j, k)).sum())
}

/// The Hilbert matrix times the least common multiple of its denominators.
pub fn hilbert(n: usize) -> Mat<f64> {
    let gcd = |mut a: u64, mut b: u64| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let multiple = (1..2 * n as u64).fold(1, |all, k| all / gcd(all, k) * k);
    Mat::from_fn(n, n, |i, j| (multiple / (i + j + 1) as u64) as f64)
}

/// Rows in which the diagonal outweighs the rest, a P-matrix.
pub fn dominant(n: usize) -> Mat<f64> {
    let others = |i: usize| (0..n).filter(|j| *j != i).map(|j| sign(i, j).abs()).sum::<f64>();
    Mat::from_fn(n, n, |i, j| if i == j { others(i) + 1.0 } else { sign(i, j) })
}

/// Exponents from `-half` to `half` in a mixed order.
pub fn exponents(n: usize, half: f64) -> Vec<f64> {
    let place = |i: usize| (i * 7 + 3) % n;
    (0..n).map(|i| (half * (2.0 * place(i) as f64 / (n - 1) as f64 - 1.0)).round()).collect()
}

/// A problem `D M C z + D q`, and the point that is `C^-1 z` and `D w`: rows and columns times powers of two.
pub fn rescaled(
    m: &Mat<f64>,
    (z, w): &Point,
    (rows, columns): (&[f64], &[f64]),
) -> (Problem, Point) {
    let n = z.len();
    let scaled = Mat::from_fn(n, n, |i, j| m[(i, j)] * (rows[i] + columns[j]).exp2());
    let z = z.iter().zip(columns).map(|(z, e)| z * (-e).exp2()).collect();
    let w = w.iter().zip(rows).map(|(w, e)| w * e.exp2()).collect();
    let point = (z, w);
    (with_solution(scaled, &point), point)
}

/// A body that moves without turning, held by springs along both axes, on planes with these normals, which
/// need not have the length one: friction coefficients are those of forces in their units.
pub fn body(springs: [f64; 2], load: [f64; 2], normals: &[[f64; 2]], mu: f64) -> Problem {
    let m = normals.len();
    let k = Mat::from_fn(2, 2, |i, j| if i == j { springs[i] } else { 0.0 });
    let c_n = Mat::from_fn(m, 2, |i, j| normals[i][j]);
    let c_t = Mat::from_fn(m, 2, |i, j| [normals[i][1], -normals[i][0]][j]);
    let (zero, mu) = (vec![0.0; m], vec![mu; m]);
    let load = load.to_vec();
    Problem::Contact(Contact2d::new(k, load, c_n, c_t, zero.clone(), zero, mu).unwrap())
}

/// A rigid block on supports at places from its middle, with forces and a moment on it.
pub fn block(places: &[f64], load: [f64; 3], mu: f64) -> Contact2d {
    let m = places.len();
    let c_n = Mat::from_fn(m, 3, |i, j| [0.0, 1.0, places[i]][j]);
    let c_t = Mat::from_fn(m, 3, |_, j| [1.0, 0.0, 0.0][j]);
    let (zero, mu) = (vec![0.0; m], vec![mu; m]);
    Contact2d::new(Mat::zeros(3, 3), load.to_vec(), c_n, c_t, zero.clone(), zero, mu).unwrap()
}
