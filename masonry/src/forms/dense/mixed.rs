//! The mixed form: the standard problem `w = M z + q` with the rigid amplitudes as unknowns.
//!
//! `z = (t_n, b+, b-, lambda, alpha+, alpha-)`, `w = (y_n, lambda + y_t, lambda - y_t, mu t_n + C_0 - b+ - b-, e, -e)`,
//! where `y = F t + G alpha + C K^+ f + x` and `e = -(G^T t + N^T f)` are the unbalanced forces. `F` is positive
//! semidefinite, `G` enters `M` skew-symmetrically, and the friction rows leave only `mu lambda t_n` in `z.M z`: `M` is
//! copositive.
//!
//! The forces `q = q+ - q-` of the bars of mortar strips are unknowns as well, at the end of `z`. The term `F_CL q` is
//! added to `y`, and the rows of the bars in `w` are `+-(H q + F_LC t + L K^+ f)`. An elimination of `q` would couple
//! all blocks, more weakly the farther apart they are, and pivots would choose between numbers that are almost zero.

use faer::Mat;

use super::{DenseForm, Equations, FormKind, FormScale, Layout};
use crate::forms::reduction::Reduction;
use crate::system::System;

pub(super) fn build(system: &System, reduction: &Reduction) -> Result<DenseForm, lcp::Error> {
    let scale = FormScale::of(reduction);
    let layout = Layout::of(system, scale);
    let rows = layout.rows();
    let g = system.rigid_rows();
    let rigid = g.ncols();
    let first = layout.points + 3 * layout.friction.len();
    let bars = first + 2 * rigid;
    let order = bars + 2 * layout.bars;
    let mut m = Mat::zeros(order, order);
    let mut q = vec![0.0; order];

    // A tangential row of the system acts on two rows of w, +y_t and -y_t, and takes its force from the same two places
    // of z. A bar does the same.
    let of_rows = (0..rows).map(|row| layout.terms(row, 1.0));
    let of_bars = (0..layout.bars).map(|k| vec![(bars + k, 1.0), (bars + layout.bars + k, -1.0)]);
    let places: Vec<Vec<(usize, f64)>> = of_rows.chain(of_bars).collect();
    let f = if system.gives_way() { reduction.flexibility.matrix() } else { Mat::new() };
    let free = reduction.flexibility.gaps(&vec![0.0; places.len()]);
    let stiff = scale.force / scale.length;
    let alpha = |k: usize| [(first + k, 1.0), (first + rigid + k, -1.0)];
    for (i, place) in places.iter().enumerate() {
        for &(p, sign) in place {
            q[p] = sign * free[i] / scale.length;
            for (j, other) in places.iter().enumerate().take(f.ncols()) {
                for &(s, other_sign) in other {
                    m[(p, s)] = sign * other_sign * stiff * f[(i, j)];
                }
            }
        }
    }
    for (i, place) in places[..rows].iter().enumerate() {
        for &(p, sign) in place {
            for k in 0..rigid {
                for (s, alpha_sign) in alpha(k) {
                    m[(p, s)] = sign * alpha_sign * g[(i, k)];
                    m[(s, p)] = -sign * alpha_sign * g[(i, k)];
                }
            }
        }
    }
    for (k, resultant) in system.resultants().iter().enumerate() {
        for (p, sign) in alpha(k) {
            q[p] = -sign * resultant / scale.force;
        }
    }
    for (k, friction) in layout.friction.iter().enumerate() {
        let [plus, minus, lambda] = [1, 2, 3].map(|group| layout.pair(group, k));
        m[(plus, lambda)] = 1.0;
        m[(minus, lambda)] = 1.0;
        m[(lambda, plus)] = -1.0;
        m[(lambda, minus)] = -1.0;
        m[(lambda, friction.contact.index())] = friction.cone.mu;
        q[lambda] = friction.cone.base;
    }
    let a = -m;
    let b = Mat::identity(order, order);
    Equations { a, b, c: q, scale, layout }.into_form(FormKind::Mixed, Vec::new())
}
