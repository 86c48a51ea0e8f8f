//! The reduced forms: equilibrium (3.18) and compatibility (3.23) in the contact forces, with the law of friction in
//! the variables of the paper (3.26), (3.27) or in those of Stewart and Trinkle.

use faer::Mat;

use super::{DenseForm, Equations, FormKind, FormScale, Layout, Start};
use crate::forms::reduction::Reduction;
use crate::system::System;

pub(super) fn build(
    kind: FormKind,
    system: &System,
    reduction: &Reduction,
) -> Result<DenseForm, lcp::Error> {
    let scale = FormScale::of(reduction);
    let layout = Layout::of(system, scale);
    let order = layout.points + kind.unknowns_per_friction() * layout.friction.len();
    let (a, b) = (Mat::zeros(order, order), Mat::zeros(order, order));
    let mut form = Equations { a, b, c: vec![0.0; order], scale, layout };
    form.add_rows(kind, reduction);
    for k in 0..form.layout.friction.len() {
        if kind == FormKind::Coulomb { form.add_cone(k) } else { form.add_sliding(k) }
    }
    let starts = form.starts(kind, reduction);
    form.into_form(kind, starts)
}

impl Equations {
    /// Adds one equation for every row of the system, at the same position:
    /// * rows `E`:  `A t_E - R^T y_I - y_E = -c`;
    /// * rows `I`:  `t_I - R t_E = t_0`.
    fn add_rows(&mut self, kind: FormKind, reduction: &Reduction) {
        let Self { a, b, c, scale, layout } = self;
        let (t_weight, y_weight) = kind.tangential_weights();
        let terms = |rows: &[usize], weight: f64| -> Vec<_> {
            rows.iter().map(|row| layout.terms(*row, weight)).collect()
        };
        let Reduction { isostatic, others, .. } = reduction;
        let (t_i, t_e) = (terms(isostatic, t_weight), terms(others, t_weight));
        let (y_i, y_e) = (terms(isostatic, y_weight), terms(others, y_weight));

        let stiff = scale.force / scale.length;
        for (j, row) in others.iter().enumerate() {
            for (k, terms) in t_e.iter().enumerate().take(reduction.a.ncols()) {
                add(a, *row, terms, stiff * reduction.a[(j, k)]);
            }
            for (k, terms) in y_i.iter().enumerate() {
                add(b, *row, terms, -reduction.r[(k, j)]);
            }
            add(b, *row, &y_e[j], -1.0);
            c[*row] = -reduction.c[j] / scale.length;
        }
        for (i, row) in isostatic.iter().enumerate() {
            add(a, *row, &t_i[i], 1.0);
            for (k, terms) in t_e.iter().enumerate() {
                add(a, *row, terms, -reduction.r[(i, k)]);
            }
            c[*row] = reduction.t0[i] / scale.force;
        }
    }

    /// Adds the definition of the friction cone at point `k`, `p+ + p- = 2 (mu t_n + C_0)` (3.24).
    fn add_cone(&mut self, k: usize) {
        let Self { a, c, layout, .. } = self;
        let (row, friction) = (layout.rows() + k, layout.friction[k]);
        a[(row, friction.contact.index())] = -2.0 * friction.cone.mu;
        c[row] = 2.0 * friction.cone.base;
        a[(row, layout.pair(1, k))] = 1.0;
        a[(row, layout.pair(2, k))] = 1.0;
    }

    /// Adds the equations `s+ + s- = 2 lambda` and `w = mu t_n + C_0 - b+ - b-` at point `k`.
    fn add_sliding(&mut self, k: usize) {
        let Self { a, b, c, layout, .. } = self;
        let [plus, minus, lambda] = [1, 2, 3].map(|group| layout.pair(group, k));
        let (row, friction) = (layout.rows() + k, layout.friction[k]);
        b[(row, plus)] = 1.0;
        b[(row, minus)] = 1.0;
        a[(row, lambda)] = -2.0;
        let row = row + layout.friction.len();
        b[(row, lambda)] = 1.0;
        a[(row, friction.contact.index())] = -friction.cone.mu;
        c[row] = friction.cone.base;
        a[(row, plus)] = 1.0;
        a[(row, minus)] = 1.0;
    }

    /// Returns two start bases: all points with friction slide forwards, along `t`, in the first, and backwards in the
    /// second. Returns a single basis if no point has friction.
    fn starts(&self, kind: FormKind, reduction: &Reduction) -> Vec<Start> {
        let ways: &[_] = if self.layout.friction.is_empty() {
            &[("isostatic normals", true)]
        } else {
            &[("all slide forwards", true), ("all slide backwards", false)]
        };
        let start = |&(name, forwards)| {
            let t_basic = self.sliding(kind, reduction, forwards);
            Start { name, t_basic }
        };
        ways.iter().map(start).collect()
    }

    /// Returns, for every pair, whether its `t` variable is basic if all points slide. Isostatic normals carry force,
    /// and all other normals are open. The basic variables of a point with friction are `(y+, p-)` or `(y-, p+)`, or,
    /// in the other form, `(s+, b-, lambda)` or `(s-, b+, lambda)`. Equilibrium gives the force of an isostatic
    /// tangential row, in which both `p` are basic, or `(b+, s-, w)`, or `(b-, s+, w)`.
    fn sliding(&self, kind: FormKind, reduction: &Reduction, forwards: bool) -> Vec<bool> {
        let layout = &self.layout;
        let mut is_held = vec![false; layout.rows()];
        reduction.isostatic.iter().for_each(|row| is_held[*row] = true);
        let (normals, tangents) = is_held.split_at(layout.points);
        let mut t_basic = normals.to_vec();
        t_basic.resize(self.c.len(), false);
        for (k, held) in tangents.iter().enumerate() {
            let mut set = |group: usize, is_t: bool| t_basic[layout.pair(group, k)] = is_t;
            if kind == FormKind::Coulomb {
                set(1, *held || !forwards);
                set(2, *held || forwards);
            } else {
                set(1, *held == forwards);
                set(2, *held != forwards);
                set(3, !held);
            }
        }
        t_basic
    }
}

fn add(matrix: &mut Mat<f64>, row: usize, terms: &[(usize, f64)], factor: f64) {
    for (column, weight) in terms {
        matrix[(row, *column)] += weight * factor;
    }
}
