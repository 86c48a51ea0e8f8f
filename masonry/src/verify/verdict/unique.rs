//! Whether contact forces are unique: forces that circulate between contacts without any effect on the blocks can be
//! added to them.

use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Col, Side};
use lcp::Contact2d;

use crate::model::{ContactPoint, Model};
use crate::state::{ContactState, State};

/// Normal forces below this part of the largest are none, and forces this near to an edge of the cone are on it.
const NONE: f64 = 1e-9;
/// Of the stiffness that the contacts would have, what makes the matrix definite.
const SHIFT: f64 = 1e-10;
/// What circulates of forces of order one, above rounding.
const CIRCULATES: f64 = 1e-3;

/// How many contact points have forces that are not unique.
///
/// A force may change along both directions inside its cone, along the edge where it slides, and not where it is zero. Of
/// a set of such changes `d` of order one, `d - B^T (B B^T)^-1 B d` is what the blocks do not feel, where `B` makes
/// forces on the displacements of them.
pub(crate) fn circulating(model: &Model, problem: &Contact2d, state: &State) -> usize {
    let changes = changes(model, problem, state);
    let Some(unfelt) = unfelt(problem.displacements(), &changes) else { return 0 };
    let mut points: Vec<usize> = changes
        .iter()
        .zip(&unfelt)
        .filter(|(_, unfelt)| unfelt.abs() > CIRCULATES)
        .map(|(change, _)| change.point)
        .collect();
    points.dedup();
    points.len()
}

/// A way in which the force at a point may change.
struct Change {
    point: usize,
    /// What the displacements feel of it.
    effect: Vec<(usize, f64)>,
}

fn changes(model: &Model, problem: &Contact2d, state: &State) -> Vec<Change> {
    let contacts = || model.contacts.iter().zip(&state.contacts);
    // How far a force is from opening the joint.
    let pressed = |(point, force): (&ContactPoint, &ContactState)| force.t_n + point.law.tension;
    let largest = contacts().map(pressed).fold(0.0, f64::max);
    let normals = rows(problem.normal());
    let tangents = rows(problem.tangent());
    let mut list = Vec::new();
    for (point, (contact, force)) in contacts().enumerate() {
        let ContactState { t_n, t_t, .. } = *force;
        let law = contact.law;
        if pressed((contact, force)) <= NONE * largest {
            continue;
        }
        let along = |t: f64| {
            let tangent = tangents[point].iter().map(|(j, v)| (*j, t * v));
            normals[point].iter().copied().chain(tangent).collect::<Vec<_>>()
        };
        let is_inside = t_t.abs() < (1.0 - NONE) * law.bound(t_n);
        if is_inside {
            list.push(Change { point, effect: normals[point].clone() });
            list.push(Change { point, effect: tangents[point].clone() });
        } else {
            let edge = if law.mu > 0.0 { law.mu.copysign(t_t) } else { 0.0 };
            list.push(Change { point, effect: along(edge) });
        }
    }
    list
}

fn rows(matrix: &SparseColMat<usize, f64>) -> Vec<Vec<(usize, f64)>> {
    let mut rows = vec![Vec::new(); matrix.nrows()];
    for entry in matrix.triplet_iter() {
        rows[entry.row].push((entry.col, *entry.val));
    }
    rows
}

/// The part of changes of order one that no displacement feels.
fn unfelt(displacements: usize, changes: &[Change]) -> Option<Vec<f64>> {
    let mut diagonal = vec![0.0; displacements];
    let mut entries = Vec::new();
    for Change { effect, .. } in changes {
        for &(i, v) in effect {
            diagonal[i] += v * v;
            entries.extend(effect.iter().map(|&(j, w)| Triplet::new(i, j, v * w)));
        }
    }
    let shift = SHIFT * diagonal.iter().fold(0.0, |max: f64, it| max.max(*it));
    if shift <= 0.0 {
        return None;
    }
    entries.extend((0..displacements).map(|i| Triplet::new(i, i, shift)));
    let matrix =
        SparseColMat::try_new_from_triplets(displacements, displacements, &entries).ok()?;
    let factor = matrix.sp_cholesky(Side::Lower).ok()?;
    let mut left: Vec<f64> = (0..changes.len()).map(scattered).collect();
    // The shift is gone after the second time.
    for _ in 0..2 {
        let mut felt = Col::zeros(displacements);
        for (Change { effect, .. }, left) in changes.iter().zip(&left) {
            for &(j, v) in effect {
                felt[j] += v * left;
            }
        }
        let moved = factor.solve(&felt);
        for (Change { effect, .. }, left) in changes.iter().zip(&mut left) {
            *left -= effect.iter().map(|&(j, v)| v * moved[j]).sum::<f64>();
        }
    }
    Some(left)
}

/// Numbers between 1/2 and 1 of either sign that have nothing to do with the structure.
fn scattered(k: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let fraction = (GOLDEN * (k as f64 + 1.0)).fract();
    if fraction < 0.5 { fraction - 1.0 } else { fraction }
}
