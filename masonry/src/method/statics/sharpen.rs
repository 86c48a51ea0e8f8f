//! Motions brought to the last digit: the edges of the cones on which they do no work are found, and made to do exactly none.
//!
//! Just above the limit a proof is a small difference of large forces, and comes out of a program with few digits. The
//! edges on which it does no work it shows nevertheless; what they leave free is the null space of their rows `E_A^T`, onto
//! which `delta (E_A E_A^T + delta)^-1` projects when it is applied a few times. Its rounding errors lie in the null space.

use faer::sparse::SparseColMat;
use lcp::Gram;

use crate::columns::column;

/// Work of a force of one below these parts of the largest velocity is none, in attempts one after the other.
const AT_REST: [f64; 4] = [1e-9, 1e-7, 1e-5, 1e-3];
/// `delta`, relative to the largest diagonal.
const SHIFT: f64 = 1e-9;
/// Each makes what is not in the null space a million times smaller, or more.
const PASSES: usize = 3;

/// The motion itself, and those near it on which some edges do no work.
pub(super) fn candidates<'a>(
    motion: &'a [f64],
    edges: &'a SparseColMat<usize, f64>,
) -> impl Iterator<Item = Vec<f64>> + 'a {
    let largest = motion.iter().fold(0.0, |max: f64, v| max.max(v.abs()));
    let work = (0..edges.ncols()).map(|k| column(edges, k).map(|(i, v)| v * motion[i]).sum());
    let work: Vec<f64> = work.collect();
    let mut last = 0;
    let mut factors = None;
    let near = AT_REST.into_iter().filter_map(move |part| {
        let is_idle: Vec<bool> =
            work.iter().map(|work: &f64| work.abs() <= part * largest).collect();
        let count = is_idle.iter().filter(|is_idle| **is_idle).count();
        if count == last || !largest.is_finite() {
            return None;
        }
        last = count;
        if factors.is_none() {
            factors = Gram::new(None, edges.symbolic()).ok();
        }
        projected(motion, edges, &is_idle, factors.as_mut()?)
    });
    std::iter::once(motion.to_vec()).chain(near)
}

fn projected(
    motion: &[f64],
    edges: &SparseColMat<usize, f64>,
    is_idle: &[bool],
    factors: &mut Gram,
) -> Option<Vec<f64>> {
    let mut diagonal = vec![0.0; motion.len()];
    for k in (0..is_idle.len()).filter(|&k| is_idle[k]) {
        column(edges, k).for_each(|(i, v)| diagonal[i] += v * v);
    }
    let shift = SHIFT * diagonal.iter().fold(0.0, |max: f64, it| max.max(*it));
    if shift <= 0.0 {
        return None;
    }
    let idle: Vec<f64> = is_idle.iter().map(|is_idle| f64::from(u8::from(*is_idle))).collect();
    factors.factorise(None, edges.as_ref(), (&idle, shift));
    let mut motion = motion.to_vec();
    for _ in 0..PASSES {
        motion.iter_mut().for_each(|v| *v *= shift);
        factors.solve(&mut motion);
    }
    Some(motion)
}
