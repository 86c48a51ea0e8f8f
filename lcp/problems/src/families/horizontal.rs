//! Problems in the general form, with singular `A` and `B`.

use faer::Mat;

use super::{Instance, Integers, KnownAnswer, Planting, product};
use lcp::{HorizontalLcp, Matrix};

/// Monotone with both matrices singular (from order 6 on), with a planted solution: a semidefinite
/// problem whose matrix has a rank of a third of its order, with the variables of every other pair
/// swapped, and another row added to or subtracted from every row.
pub fn horizontal_monotone(n: usize, seed: u64) -> Instance {
    let mut random = Integers::new(seed);
    let c = random.matrix(n, n / 3, -2, 2);
    let (m, one) = (&c * c.transpose(), Mat::<f64>::identity(n, n));
    let mut mixing = one.clone();
    for i in 1..n {
        mixing[(i, random.index(i))] = random.next(-1, 1);
    }
    let column = |i: usize, j: usize, is_m: bool| if is_m { -m[(i, j)] } else { one[(i, j)] };
    let a = &mixing * Mat::from_fn(n, n, |i, j| column(i, j, j % 2 == 0));
    let b = &mixing * Mat::from_fn(n, n, |i, j| column(i, j, j % 2 == 1));
    let (t, y) = random.solution(n, Planting::Degenerate);
    Instance { problem: with_solution(a, b, &t, &y), known: KnownAnswer::Solution { t, y } }
}

/// Of no class: random integers, with a quarter of the columns of `A` sums of two others, and
/// likewise in `B` (from order 4 on), with a planted solution.
pub fn horizontal_singular(n: usize, seed: u64) -> Instance {
    let mut random = Integers::new(seed);
    let mut matrix = |dependent: &dyn Fn(usize) -> usize| {
        let mut m = random.matrix(n, n, -3, 3);
        for k in 0..n / 4 {
            let (first, second) = (random.index(n), random.index(n));
            let sum: Vec<f64> = (0..n).map(|i| m[(i, first)] + m[(i, second)]).collect();
            m.col_as_slice_mut(dependent(k)).copy_from_slice(&sum);
        }
        m
    };
    // Never both columns of a pair, so that a complementary basis remains.
    let (a, b) = (matrix(&|k| k), matrix(&|k| n - 1 - k));
    let (t, y) = random.solution(n, Planting::Strict);
    Instance { problem: with_solution(a, b, &t, &y), known: KnownAnswer::Solution { t, y } }
}

/// Random integers with the signs of columns and of `c` such that a random vector proves
/// infeasibility. One column of every pair outweighs the rest of its row, so that a complementary
/// basis exists.
pub fn infeasible(n: usize, seed: u64) -> Instance {
    let n = n.max(1);
    let mut random = Integers::new(seed);
    let mut farkas = random.vector(n, -2, 2);
    farkas[0] = 1.0;
    let in_a: Vec<bool> = (0..n).map(|_| random.index(2) == 0).collect();
    let value = |v: &[f64]| v.iter().zip(&farkas).map(|(v, f)| v * f).sum::<f64>();
    let mut matrix = |is_a: bool| {
        let mut m = random.matrix(n, n, -3, 3);
        for j in 0..n {
            let column = m.col_as_slice_mut(j);
            column[j] += if in_a[j] == is_a { 3.0 * n as f64 + 1.0 } else { 0.0 };
            let sign = if value(column) > 0.0 { -1.0 } else { 1.0 };
            for v in column {
                *v *= sign;
            }
        }
        m
    };
    let (a, b) = (matrix(true), matrix(false));
    let mut c = random.vector(n, -3, 3);
    // `farkas[0]` is one: the first entry compensates the deficit of the others.
    c[0] += (1.0 - value(&c)).max(0.0);
    Instance { problem: general(a, b, c), known: KnownAnswer::Infeasible { farkas } }
}

fn with_solution(a: Mat<f64>, b: Mat<f64>, t: &[f64], y: &[f64]) -> HorizontalLcp {
    let (a, b) = (a.into(), b.into());
    let c = product(&a, t).iter().zip(product(&b, y)).map(|(at, by)| at + by).collect();
    general(a, b, c)
}

fn general(a: impl Into<Matrix>, b: impl Into<Matrix>, c: Vec<f64>) -> HorizontalLcp {
    HorizontalLcp::new(a, b, c).expect("finite and of one order")
}
