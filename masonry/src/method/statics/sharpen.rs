//! Motions refined to the last digit: the edges of the friction cones on which a motion does no work are found, and the
//! motion is changed so that it does exactly no work there.
//!
//! Just above the limit load, a proof depends on a small difference of large forces, and a program gives the motion
//! with few digits. The motion still shows the edges on which it does no work. The projection onto the null space of
//! the rows `E_A^T` of these edges is `delta (E_A E_A^T + delta)^-1`, applied a few times. The rounding errors of the
//! projection lie in the null space.

use faer::sparse::SparseColMatRef;
use lcp_linalg::Gram;

use crate::columns::column;
use crate::rounding;

/// The columns of `E` on which a motion is made to do no work.
enum Idle {
    /// The columns on which the work of the motion is below this part of its largest velocity.
    AtRest(f64),
    /// The columns whose force, divided by the largest force, is at least as large as their work, divided by the
    /// largest work.
    Pressed,
}

/// The sets of columns that are tried, one after the other. Measured on the tests and scenes: a motion that comes with
/// forces needs the first set, and a motion without forces one of the other sets.
const ATTEMPTS: [Idle; 4] =
    [Idle::Pressed, Idle::AtRest(1e-9), Idle::AtRest(1e-7), Idle::AtRest(1e-5)];
/// The shift `delta`, divided by the largest diagonal entry of `E_A E_A^T`.
const SHIFT: f64 = 1e-9;
/// Number of projections, each of which makes the part outside of the null space at least a million times smaller.
const PASSES: usize = 3;

/// Lists a motion, and nearby motions that do no work on some columns; `forces` belong to the first columns, and may be
/// empty.
pub(super) fn candidates<'a>(
    motion: &'a [f64],
    forces: &'a [f64],
    columns: SparseColMatRef<'a, usize, f64>,
) -> impl Iterator<Item = Vec<f64>> + 'a {
    let work = (0..columns.ncols()).map(|k| column(columns, k).map(|(i, v)| v * motion[i]).sum());
    let work: Vec<f64> = work.collect();
    let [fastest, most, farthest] = [motion, forces, &work[..forces.len()]].map(rounding::largest);
    let mut last = Vec::new();
    let mut factors = None;
    let near = ATTEMPTS.iter().filter_map(move |attempt| {
        let mut is_idle: Vec<bool> = match attempt {
            Idle::AtRest(part) => work.iter().map(|work| work.abs() <= part * fastest).collect(),
            Idle::Pressed => {
                let pairs = work.iter().zip(forces);
                pairs.map(|(work, force)| work * most <= force * farthest).collect()
            }
        };
        is_idle.resize(work.len(), false);
        if is_idle == last || !fastest.is_finite() {
            return None;
        }
        last.clone_from(&is_idle);
        projected(motion, columns, &is_idle, &mut factors)
    });
    std::iter::once(motion.to_vec()).chain(near)
}

/// Projects a motion onto the null space in which it does no work on the idle columns; `factors` are kept for the next
/// set of idle columns.
fn projected(
    motion: &[f64],
    columns: SparseColMatRef<'_, usize, f64>,
    is_idle: &[bool],
    factors: &mut Option<Gram>,
) -> Option<Vec<f64>> {
    let mut diagonal = vec![0.0; motion.len()];
    for k in (0..is_idle.len()).filter(|&k| is_idle[k]) {
        column(columns, k).for_each(|(i, v)| diagonal[i] += v * v);
    }
    let shift = SHIFT * rounding::largest(&diagonal);
    if shift <= 0.0 {
        return None;
    }
    if factors.is_none() {
        *factors = Gram::new(None, columns.symbolic()).ok();
    }
    let factors = factors.as_mut()?;
    let idle: Vec<f64> = is_idle.iter().map(|is_idle| f64::from(u8::from(*is_idle))).collect();
    factors.factorise(None, columns, &idle, shift).ok()?;
    let mut motion = motion.to_vec();
    for _ in 0..PASSES {
        for v in &mut motion {
            *v *= shift;
        }
        factors.solve(&mut motion);
    }
    Some(motion)
}
