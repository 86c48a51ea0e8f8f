//! Properties that a matrix shows without a factorisation.

use super::constants::FEW_PAIRS;
use crate::Matrix;
use crate::enumerate::MOST_PAIRS;

/// The largest sum of `choices` over a block of mutually dependent variables: `i` depends on `j` if row `i` has an
/// entry in column `j`. The blocks of a triangular matrix are single variables; an irreducible matrix is one block.
pub(super) fn largest_block(m: &Matrix, choices: impl Fn(usize) -> usize) -> usize {
    let n = m.ncols();
    let all = (0..n).map(&choices).sum();
    if all <= FEW_PAIRS || n > MOST_PAIRS {
        return all;
    }
    // A bit for every variable on which one depends, directly and then through others (Warshall 1962).
    let mut reached = vec![0_u128; n];
    for j in 0..n {
        m.column(j).filter(|(_, v)| *v != 0.0).for_each(|(i, _)| reached[i] |= 1 << j);
    }
    for k in 0..n {
        let over = reached[k];
        reached.iter_mut().filter(|it| **it >> k & 1 == 1).for_each(|it| *it |= over);
    }
    let is_mutual = |i: usize, j: usize| i == j || reached[i] >> j & reached[j] >> i & 1 == 1;
    let block = |i: usize| (0..n).filter(|&j| is_mutual(i, j)).map(&choices).sum();
    (0..n).map(block).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use faer::Mat;

    use super::*;

    /// Blocks of 3 and 20, coupled below the diagonal only; a cycle through both joins them.
    #[test]
    fn blocks_of_a_reducible_matrix() {
        let mut m = Mat::from_fn(23, 23, |i, j| f64::from(u8::from(i >= 3 && j < 3)));
        for (first, count) in [(0, 3), (3, 20)] {
            (0..count).for_each(|k| m[(first + k, first + (k + 1) % count)] = 1.0);
        }
        let largest = |m: &Mat<f64>| largest_block(&m.clone().into(), |_| 1);
        assert_eq!(largest(&m), 20);
        m[(1, 7)] = -1.0;
        assert_eq!(largest(&m), 23);
        assert_eq!(largest(&Mat::from_fn(60, 60, |i, j| f64::from(u8::from(i > j)))), 1);
    }
}
