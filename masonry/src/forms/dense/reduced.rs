//! The rows that the reduced forms share: equilibrium (3.18) and compatibility (3.23).

use faer::Mat;

use super::{Equations, FormKind, Layout, Scale, Start};
use crate::forms::reduction::Reduction;
use crate::system::System;

/// A problem of the given order with one equation for every row of the system, at the same position:
/// * rows `E`:  `A t_E - R^T y_I - y_E = -c`;
/// * rows `I`:  `t_I - R t_E = t_0`.
///
/// The equations of the friction law, after these, are left to the form.
pub(super) fn build(
    kind: FormKind,
    system: &System,
    reduction: &Reduction,
    groups: usize,
) -> Equations {
    let scale = Scale::of(reduction);
    let layout = Layout::of(system, scale);
    let order = layout.points + groups * layout.friction.len();
    let (mut a, mut b) = (Mat::zeros(order, order), Mat::zeros(order, order));
    let mut c = vec![0.0; order];
    let (t_weight, y_weight) = kind.tangential_weights();
    let force_terms = |rows: &[usize]| -> Vec<_> {
        rows.iter().map(|row| layout.terms(*row, t_weight)).collect()
    };
    let gap_terms = |rows: &[usize]| -> Vec<_> {
        rows.iter().map(|row| layout.terms(*row, y_weight)).collect()
    };
    let Reduction { isostatic, others, .. } = reduction;
    let (t_i, t_e) = (force_terms(isostatic), force_terms(others));
    let (y_i, y_e) = (gap_terms(isostatic), gap_terms(others));

    let stiff = scale.force / scale.length;
    for (j, row) in others.iter().enumerate() {
        for (k, terms) in t_e.iter().enumerate().take(reduction.a.ncols()) {
            add(&mut a, *row, terms, stiff * reduction.a[(j, k)]);
        }
        for (k, terms) in y_i.iter().enumerate() {
            add(&mut b, *row, terms, -reduction.r[(k, j)]);
        }
        add(&mut b, *row, &y_e[j], -1.0);
        c[*row] = -reduction.c[j] / scale.length;
    }
    for (i, row) in isostatic.iter().enumerate() {
        add(&mut a, *row, &t_i[i], 1.0);
        for (k, terms) in t_e.iter().enumerate() {
            add(&mut a, *row, terms, -reduction.r[(i, k)]);
        }
        c[*row] = reduction.t0[i] / scale.force;
    }
    Equations { a, b, c, scale, layout }
}

fn add(matrix: &mut Mat<f64>, row: usize, terms: &[(usize, f64)], factor: f64) {
    for (column, weight) in terms {
        matrix[(row, *column)] += weight * factor;
    }
}

/// Whether the tangential row of every frictional point is isostatic.
pub(super) fn tangents_in_i(form: &Equations, reduction: &Reduction) -> Vec<bool> {
    let mut found = vec![false; form.layout.friction.len()];
    for row in &reduction.isostatic {
        if let Some(k) = row.checked_sub(form.layout.points) {
            found[k] = true;
        }
    }
    found
}

/// A start in which all points with friction slide forwards, along `t`, and one in which they slide backwards, each by the
/// rule of its form; the only one there is if nothing has friction.
pub(super) fn starts(form: &Equations, t_basic: impl Fn(bool) -> Vec<bool>) -> Vec<Start> {
    if form.layout.friction.is_empty() {
        return vec![Start { name: "isostatic normals", t_basic: t_basic(true) }];
    }
    let ways = [("all slide forwards", true), ("all slide backwards", false)];
    ways.map(|(name, forwards)| Start { name, t_basic: t_basic(forwards) }).into()
}

/// A start in which isostatic normals carry force and all other normals are open; the tangential
/// pairs, all still on their `y` side, are left to the form.
pub(super) fn normal_start(form: &Equations, reduction: &Reduction) -> Vec<bool> {
    let mut t_basic = vec![false; form.c.len()];
    for row in reduction.isostatic.iter().filter(|row| **row < form.layout.points) {
        t_basic[*row] = true;
    }
    t_basic
}
