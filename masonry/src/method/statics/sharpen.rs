//! Motions brought to the last digit: the edges of the cones on which they do no work are found, and made to do exactly none.
//!
//! Just above the limit a proof is a small difference of large forces, and comes out of a program with few digits. The
//! edges on which it does no work it shows nevertheless; what they leave free is the null space of their rows `E_A^T`, onto
//! which `delta (E_A E_A^T + delta)^-1` projects when it is applied a few times. Its rounding errors lie in the null space.

use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Col, Side};

use crate::rounding;

/// Work of a force of one below these parts of the largest velocity is none, in attempts one after the other.
const AT_REST: [f64; 4] = [1e-9, 1e-7, 1e-5, 1e-3];
/// A force, relative to the largest, is large beside its work, likewise, when it is so many times as large.
const LARGE: [f64; 3] = [1.0, 1e-2, 1e2];
/// `delta`, relative to the largest diagonal.
const SHIFT: f64 = 1e-9;
/// Each makes what is not in the null space a million times smaller, or more.
const PASSES: usize = 3;

/// The motion itself, and those near it on which some edges do no work.
pub(super) fn candidates<'a>(
    motion: &'a [f64],
    entries: &'a [(usize, usize, f64)],
    edges: usize,
) -> impl Iterator<Item = Vec<f64>> + 'a {
    let largest = motion.iter().fold(0.0, |max: f64, v| max.max(v.abs()));
    let mut work = vec![0.0; edges];
    for &(i, k, v) in entries {
        work[k] += v * motion[i];
    }
    let mut last = 0;
    let near = AT_REST.into_iter().filter_map(move |part| {
        let is_idle: Vec<bool> = work.iter().map(|work| work.abs() <= part * largest).collect();
        let count = is_idle.iter().filter(|is_idle| **is_idle).count();
        if count == last || !largest.is_finite() {
            return None;
        }
        last = count;
        projected(motion, entries, &is_idle)
    });
    std::iter::once(motion.to_vec()).chain(near)
}

/// Motions near one that comes with forces, on which the forces that are large beside their work do no work.
pub(super) fn complementary<'a>(
    motion: &'a [f64],
    forces: &'a [f64],
    entries: &'a [(usize, usize, f64)],
) -> impl Iterator<Item = Vec<f64>> + 'a {
    let mut work = vec![0.0; forces.len()];
    for &(i, k, v) in entries {
        work[k] += v * motion[i];
    }
    let [most, farthest] = [forces, &work[..]].map(rounding::largest);
    LARGE.into_iter().filter_map(move |large| {
        let pairs = work.iter().zip(forces);
        let is_idle: Vec<bool> =
            pairs.map(|(work, force)| large * work * most <= force * farthest).collect();
        projected(motion, entries, &is_idle)
    })
}

fn projected(
    motion: &[f64],
    entries: &[(usize, usize, f64)],
    is_idle: &[bool],
) -> Option<Vec<f64>> {
    let n = motion.len();
    let mut columns = vec![Vec::new(); is_idle.len()];
    for &(i, k, v) in entries.iter().filter(|(_, k, _)| is_idle[*k]) {
        columns[k].push((i, v));
    }
    let mut diagonal = vec![0.0; n];
    let mut products = Vec::new();
    for column in &columns {
        for &(i, v) in column {
            diagonal[i] += v * v;
            products.extend(column.iter().map(|&(j, w)| Triplet::new(i, j, v * w)));
        }
    }
    let shift = SHIFT * diagonal.iter().fold(0.0, |max: f64, it| max.max(*it));
    if shift <= 0.0 {
        return None;
    }
    products.extend((0..n).map(|i| Triplet::new(i, i, shift)));
    let matrix = SparseColMat::try_new_from_triplets(n, n, &products).ok()?;
    let factor = matrix.sp_cholesky(Side::Lower).ok()?;
    let mut motion: Col<f64> = Col::from_fn(n, |i| motion[i]);
    for _ in 0..PASSES {
        motion = factor.solve(&(&motion * faer::Scale(shift)));
    }
    Some(motion.iter().copied().collect())
}
