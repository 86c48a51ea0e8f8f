//! Whether any contact forces balance the loads, wherever the bodies are.

use faer::sparse::SparseColMat;

use super::constants::{LEAST_WORK, ROW_ROUNDING};
use super::program;
use crate::problem::column_of;
use crate::states::Scaled;
use crate::vector::max_abs;
use crate::{Matrix, MixedLcp, Solution};

/// What is known of forces that balance the loads.
pub(super) enum Balance {
    /// There are none: a motion without deformation, on which the loads do work, opens every contact by
    /// more than friction could make good.
    Impossible,
    /// These do, inside their cones.
    Possible(Vec<(f64, f64)>),
    /// Neither came out.
    Open,
}

/// Decides whether there are forces `t` inside their cones and displacements `u`, whatever their gaps, with
/// `K u = f + C^T t`.
///
/// What is left over at best, `v = f + C^T t - K u` with the least `|v|`, is zero if there are. Else it is the
/// proof that there are none: by the conditions of that convex problem `K v = 0`, `C_n v >= mu |C_t v|`, and
/// `f.v = |v|^2` (Moreau 1962), so that the work of all forces on `v` is positive in whatever state, and that
/// of bodies at rest is zero. Proof and forces are checked by themselves.
pub(super) fn balance(
    problem: &Scaled,
    solve: impl FnOnce(&MixedLcp) -> Option<Solution>,
) -> Balance {
    let edges = program::edges(problem);
    let Some(mixed) = nearest(problem, &edges) else { return Balance::Open };
    let Some(solution) = solve(&mixed) else { return Balance::Open };
    let (z, _) = mixed.recover(&solution.t, &solution.y);
    let (v, rest) = z.split_at(problem.order());
    if is_proof(problem, &edges, &without_noise(v)) {
        return Balance::Impossible;
    }
    if !solution.is_solved() {
        return Balance::Open;
    }
    let parts = &rest[problem.order()..];
    Balance::Possible(problem.of_edges(parts.iter().copied()))
}

/// The conditions of the least `|f + C^T t - K u|^2 / 2`, with `v`, `u` and then the parts of the forces
/// along the edges as variables.
fn nearest(problem: &Scaled, edges: &SparseColMat<usize, f64>) -> Option<MixedLcp> {
    let n = problem.order();
    let order = 2 * n + edges.ncols();
    let mut entries: Vec<(usize, usize, f64)> = (0..n).map(|j| (j, j, 1.0)).collect();
    for j in 0..n {
        for (i, k) in column_of(&problem.k, j) {
            entries.extend([(i, n + j, k), (n + j, i, -k)]);
        }
    }
    for k in 0..edges.ncols() {
        for (j, value) in column_of(edges, k) {
            entries.extend([(j, 2 * n + k, -value), (2 * n + k, j, value)]);
        }
    }
    let m = Matrix::from_entries(order, order, entries.into_iter());
    let mut q: Vec<f64> = problem.f.iter().map(|f| -f).collect();
    q.resize(order, 0.0);
    MixedLcp::new(m, q, (0..order).map(|j| j < 2 * n).collect()).ok()
}

/// What does not move but for rounding errors is at rest: errors of their own size would contradict a proof.
fn without_noise(v: &[f64]) -> Vec<f64> {
    let noise = ROW_ROUNDING * max_abs(v);
    v.iter().map(|v| if v.abs() <= noise { 0.0 } else { *v }).collect()
}

/// Whether a motion proves that no forces balance the loads.
fn is_proof(problem: &Scaled, edges: &SparseColMat<usize, f64>, v: &[f64]) -> bool {
    let size = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (load, motion) = (size(&problem.f), size(v));
    let work: f64 = problem.f.iter().zip(v).map(|(f, v)| f * v).sum();
    let sum = |entries: &mut dyn Iterator<Item = (usize, f64)>| {
        entries.fold((0.0, 0.0), |(sum, terms), (i, value)| {
            (sum + value * v[i], terms + (value * v[i]).abs())
        })
    };
    // `K` is symmetric: its columns are its rows.
    let is_free = (0..v.len()).all(|j| {
        let (sum, terms) = sum(&mut column_of(&problem.k, j));
        sum.abs() <= ROW_ROUNDING * terms
    });
    let opens = (0..edges.ncols()).all(|k| {
        let (sum, terms) = sum(&mut column_of(edges, k));
        sum >= -ROW_ROUNDING * terms
    });
    max_abs(v) > 0.0 && work >= LEAST_WORK * load * motion && is_free && opens
}
