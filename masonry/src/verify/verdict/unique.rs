//! The uniqueness of contact forces. They are not unique if other forces can be added that circulate between contacts
//! without any effect on the blocks.

use faer::sparse::{SparseColMat, SparseColMatRef};
use lcp::Contact2d;
use lcp_linalg::Gram;

use crate::columns::{ColumnMatrix, column};
use crate::data::state::{PointState, State};
use crate::model::{JointPoint, Model};

/// Threshold of zero \[-\]: normal forces below this part of the largest count as zero, and forces within this part of
/// the bound count as lying on the edge of their cone.
const NONE: f64 = 1e-9;
/// The stiffness, relative to that of the contacts, that is added to make the matrix definite \[-\].
const SHIFT: f64 = 1e-10;
/// The circulating part of a force of order one above which the force is not unique \[-\]: far above rounding errors.
const CIRCULATES: f64 = 1e-3;

/// Counts the contact points whose forces are not unique.
///
/// A force inside its cone may change in both directions; a force at a sliding point may change along the edge of the
/// cone; a zero force may not change. At rest no point slides, and a force on the edge may change inwards: forces of
/// least size often lie on the edge. Let `d` be arbitrary changes of order one, and let `B` map changes to forces on
/// the displacements. The part `d - B^T (B B^T)^-1 B d` has no effect on the blocks: the points at which it is not
/// zero are counted.
pub(crate) fn circulating(
    model: &Model,
    problem: &Contact2d,
    state: &State,
    at_rest: bool,
) -> usize {
    let changes = changes(model, problem, state, at_rest);
    let Some(Changes { points, effects }) = changes else { return 0 };
    let Some(unfelt) = unfelt(effects.as_ref()) else { return 0 };
    let circulating = points.iter().zip(&unfelt).filter(|(_, unfelt)| unfelt.abs() > CIRCULATES);
    let mut points: Vec<usize> = circulating.map(|(point, _)| *point).collect();
    points.dedup();
    points.len()
}

/// The possible changes of contact forces, each with its point, in the order of the points.
struct Changes {
    points: Vec<usize>,
    /// The forces on the displacements by each change, one change per column.
    effects: SparseColMat<usize, f64>,
}

/// Returns the possible changes of forces, and their effects on the balance of the blocks; `None` if memory does not
/// suffice.
fn changes(model: &Model, problem: &Contact2d, state: &State, at_rest: bool) -> Option<Changes> {
    let contacts = || model.contacts.iter().zip(&state.contacts);
    // The distance of the normal force from the value at which the joint opens.
    let pressed = |(point, force): (&JointPoint, &PointState)| force.t_n + point.law.tension;
    let largest = contacts().map(pressed).fold(0.0, f64::max);
    let normals = problem.normal().as_ref().transpose().to_col_major().ok()?;
    let tangents = problem.tangent().as_ref().transpose().to_col_major().ok()?;
    let [normals, tangents] = [normals.as_ref(), tangents.as_ref()];
    let (mut points, mut effects) = (Vec::new(), ColumnMatrix::default());
    for (point, (contact, force)) in contacts().enumerate() {
        let PointState { t_n, t_t, .. } = *force;
        let law = contact.law;
        if pressed((contact, force)) <= NONE * largest {
            continue;
        }
        points.push(point);
        let bound = law.bound(t_n);
        if bound > 0.0 && (at_rest || t_t.abs() < (1.0 - NONE) * bound) {
            points.push(point);
            effects.push(column(normals, point));
            effects.push(column(tangents, point));
        } else {
            let slope = law.cone().slope(t_t);
            effects.push(sum(column(normals, point), slope, column(tangents, point)));
        }
    }
    Some(Changes { points, effects: effects.assembled(problem.displacements()) })
}

/// Returns the entries of the sum of a column and a multiple of another column.
fn sum(
    first: impl Iterator<Item = (usize, f64)>,
    factor: f64,
    other: impl Iterator<Item = (usize, f64)>,
) -> Vec<(usize, f64)> {
    let mut entries: Vec<(usize, f64)> = first.chain(other.map(|(i, v)| (i, factor * v))).collect();
    entries.sort_by_key(|(i, _)| *i);
    entries.dedup_by(|(i, v), (before, sum)| {
        let is_same = i == before;
        if is_same {
            *sum += *v;
        }
        is_same
    });
    entries
}

/// Returns the part of changes of order one that has no effect on any displacement; `None` if no change has an effect,
/// or if memory does not suffice.
fn unfelt(effects: SparseColMatRef<'_, usize, f64>) -> Option<Vec<f64>> {
    let count = effects.ncols();
    let mut diagonal = vec![0.0; effects.nrows()];
    for k in 0..count {
        column(effects, k).for_each(|(i, v)| diagonal[i] += v * v);
    }
    let shift = SHIFT * diagonal.iter().fold(0.0, |max: f64, it| max.max(*it));
    if shift <= 0.0 {
        return None;
    }
    let mut factors = Gram::new(None, effects.symbolic()).ok()?;
    factors.factorise(None, effects, &vec![1.0; count], shift).ok()?;
    let mut left: Vec<f64> = (0..count).map(scattered).collect();
    // The effect of the shift is gone after the second time.
    for _ in 0..2 {
        let mut moved = vec![0.0; effects.nrows()];
        for (k, left) in left.iter().enumerate() {
            column(effects, k).for_each(|(i, v)| moved[i] += v * left);
        }
        factors.solve(&mut moved);
        for (k, left) in left.iter_mut().enumerate() {
            *left -= column(effects, k).map(|(i, v)| v * moved[i]).sum::<f64>();
        }
    }
    Some(left)
}

/// Returns the `k`-th of a sequence of numbers of either sign, of size 1/2 to 1, that are unrelated to the structure.
fn scattered(k: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let fraction = (GOLDEN * (k as f64 + 1.0)).fract();
    if fraction < 0.5 { fraction - 1.0 } else { fraction }
}
