//! Free variables together with complementary pairs, and a singular block of the free ones.

use faer::Mat;

use super::{Instance, Integers, KnownAnswer, Planting};
use lcp::MixedLcp;

/// The conditions of a convex quadratic program with equations, with a planted solution:
/// `M = [0 E; -E^T C C^T]`, monotone and with a zero block for the free variables, its multipliers.
/// About a third of the variables is free; `E` has full rank.
pub fn mixed_monotone(n: usize, seed: u64) -> Instance<MixedLcp> {
    let mut random = Integers::new(seed);
    let free = n / 3;
    let entries = random.matrix(n, n, -2, 2);
    let c = random.matrix(n, n / 3, -2, 2);
    let quadratic = &c * c.transpose();
    let e = |i: usize, j: usize| match i.cmp(&j) {
        std::cmp::Ordering::Less => entries[(i, j)],
        std::cmp::Ordering::Equal => 1.0,
        std::cmp::Ordering::Greater => 0.0,
    };
    let m = Mat::from_fn(n, n, |i, j| match (i < free, j < free) {
        (true, true) => 0.0,
        (true, false) => e(i, j - free),
        (false, true) => -e(j, i - free),
        (false, false) => quadratic[(i, j)],
    });
    with_solution(m, free, &mut random)
}

/// Of no class: random integers with a planted solution, half of the variables free, and every second
/// row of their block, from order 4 on, equal to the one before.
pub fn mixed_singular(n: usize, seed: u64) -> Instance<MixedLcp> {
    let mut random = Integers::new(seed);
    let free = n / 2;
    let entries = random.matrix(n, n, -3, 3);
    let in_block = |i: usize, j: usize| i.max(j) < free;
    let m = Mat::from_fn(n, n, |i, j| entries[(if in_block(i, j) { i - i % 2 } else { i }, j)]);
    with_solution(m, free, &mut random)
}

fn with_solution(m: Mat<f64>, free: usize, random: &mut Integers) -> Instance<MixedLcp> {
    let n = m.nrows();
    let (mut t, mut y) = random.solution(n, Planting::Strict);
    t[..free].copy_from_slice(&random.vector(free, -3, 3));
    y[..free].fill(0.0);
    let planted = super::with_solution(m, &t, &y);
    let is_free = (0..n).map(|i| i < free).collect();
    let problem = MixedLcp::new(planted.m().clone(), planted.q().to_vec(), is_free);
    let problem = problem.expect("finite and of one order");
    Instance { problem, known: KnownAnswer::Solution { t, y } }
}
