//! Factors `L D L^T` of positive definite matrices.

use faer::{MatMut, MatRef};

use super::analysis::Supernode;
use super::dense::{factorise_symmetric, solve_unit_lower, subtract_lower_product};
use super::fronts::Factor;

/// Pivots below this multiple of the diagonal, which is of order one, are rounding errors. Rounding: some eps.
const VANISHING: f64 = 1e-15;
/// What takes their place, so that their variable is zero, which iterative refinement of the caller has to make good.
const HELD: f64 = 1e60;
/// Columns that are eliminated at once. Chosen: products of this width are nearly as fast as any.
const BLOCK: usize = 256;
/// Columns that a solve passes over at once, so that vectors stay in registers. Chosen.
const TOGETHER: usize = 4;
/// Sums that a scalar product is split into. Chosen.
const LANES: usize = 4;

/// `D` on the diagonal of the block of a supernode, `L` below it: `order x width`, columns one after the other.
pub(super) struct Symmetric {
    lower: Vec<f64>,
}

impl Factor for Symmetric {
    const IS_SYMMETRIC: bool = true;

    fn of(node: &Supernode) -> Self {
        Self { lower: vec![0.0; node.order() * node.width] }
    }

    fn eliminate(&mut self, node: &Supernode, front: &mut [f64]) -> usize {
        let (width, order) = (node.width, node.order());
        let mut replaced = 0;
        for start in (0..width).step_by(BLOCK) {
            let end = width.min(start + BLOCK);
            let (columns, right) = front[order * start..].split_at_mut(order * (end - start));
            let block = MatMut::from_column_major_slice_mut(columns, order, end - start);
            let (_, block) = block.split_at_row_mut(start);
            let (mut block, mut below) = block.split_at_row_mut(end - start);
            replaced += factorise_symmetric(block.as_mut(), VANISHING, HELD);
            solve_unit_lower(block.as_ref(), below.as_mut().transpose_mut());
            // `L D` stands below the block, of which `L` is kept.
            let kept = &mut self.lower[order * start..order * end];
            kept.copy_from_slice(columns);
            for (j, column) in kept.chunks_exact_mut(order).enumerate() {
                let inverse = 1.0 / column[start + j];
                column[end..].iter_mut().for_each(|v| *v *= inverse);
            }
            let rest = order - end;
            let right = MatMut::from_column_major_slice_mut(right, order, rest);
            let of = |columns| {
                MatRef::from_column_major_slice(columns, order, end - start).subrows(end, rest)
            };
            let (lower, scaled) = (of(kept), of(columns));
            subtract_lower_product(right.subrows_mut(end, rest), lower, scaled.transpose());
        }
        replaced
    }

    fn forward(&self, node: &Supernode, x: &mut [f64], work: &mut Vec<f64>) {
        let (width, order) = (node.width, node.order());
        work.clear();
        work.extend_from_slice(&x[node.start..node.start + width]);
        work.extend(node.rows.iter().map(|row| x[*row as usize]));
        let mut columns = self.lower.chunks_exact(order * TOGETHER);
        let mut j = 0;
        for together in columns.by_ref() {
            let mut pivots = [0.0; TOGETHER];
            for (k, column) in together.chunks_exact(order).enumerate() {
                pivots[k] = work[j + k];
                let next = j + k + 1..j + TOGETHER;
                subtract(&mut work[next.clone()], &column[next], pivots[k]);
            }
            j += TOGETHER;
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| &together[order * k + j..order * (k + 1)]);
            for ((((v, a), b), c), d) in work[j..].iter_mut().zip(a).zip(b).zip(c).zip(d) {
                *v -= a * pivots[0] + b * pivots[1] + (c * pivots[2] + d * pivots[3]);
            }
        }
        for column in columns.remainder().chunks_exact(order) {
            let pivot = work[j];
            j += 1;
            subtract(&mut work[j..], &column[j..], pivot);
        }
        x[node.start..node.start + width].copy_from_slice(&work[..width]);
        node.rows.iter().zip(&work[width..]).for_each(|(row, v)| x[*row as usize] = *v);
    }

    fn backward(&self, node: &Supernode, x: &mut [f64], work: &mut Vec<f64>) {
        let (width, order) = (node.width, node.order());
        work.clear();
        work.extend_from_slice(&x[node.start..node.start + width]);
        work.extend(node.rows.iter().map(|row| x[*row as usize]));
        let (together, rest) = self.lower.split_at(width / TOGETHER * TOGETHER * order);
        let mut j = width;
        for column in rest.chunks_exact(order).rev() {
            let [sum] = dots([&column[j..]], &work[j..]);
            j -= 1;
            work[j] = work[j] / column[j] - sum;
        }
        for columns in together.chunks_exact(TOGETHER * order).rev() {
            let of = |k: usize| &columns[order * k..order * (k + 1)];
            let sums = dots([0, 1, 2, 3].map(|k| &of(k)[j..]), &work[j..]);
            for (k, sum) in sums.into_iter().enumerate().rev() {
                let at = j - TOGETHER + k;
                let [inside] = dots([&of(k)[at + 1..j]], &work[at + 1..j]);
                work[at] = work[at] / of(k)[at] - (sum + inside);
            }
            j -= TOGETHER;
        }
        x[node.start..node.start + width].copy_from_slice(&work[..width]);
    }
}

impl Symmetric {
    /// How many numbers they are.
    pub(super) fn stored(&self) -> usize {
        self.lower.len()
    }
}

/// `out -= factor * column`
fn subtract(out: &mut [f64], column: &[f64], factor: f64) {
    out.iter_mut().zip(column).for_each(|(v, c)| *v -= c * factor);
}

/// The scalar products of columns with a vector, each in four sums, which the processor adds at once.
fn dots<const N: usize>(columns: [&[f64]; N], x: &[f64]) -> [f64; N] {
    let mut sums = [[0.0; LANES]; N];
    let whole = x.len() / LANES * LANES;
    for at in (0..whole).step_by(LANES) {
        let x = &x[at..at + LANES];
        for (sums, column) in sums.iter_mut().zip(columns) {
            let column = &column[at..at + LANES];
            sums.iter_mut().zip(column).zip(x).for_each(|((sum, c), x)| *sum += c * x);
        }
    }
    std::array::from_fn(|k| {
        let rest = columns[k][whole..].iter().zip(&x[whole..]).map(|(c, x)| c * x);
        sums[k].iter().sum::<f64>() + rest.sum::<f64>()
    })
}
