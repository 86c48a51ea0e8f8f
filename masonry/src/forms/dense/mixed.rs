//! The standard problem `w = M z + q` with the rigid amplitudes as unknowns.
//!
//! `z = (t_n, b+, b-, lambda, alpha+, alpha-)`,
//! `w = (y_n, lambda + y_t, lambda - y_t, mu t_n + C_0 - b+ - b-, e, -e)`, where
//! `y = F t + G alpha + C K^+ f + x` and `e = -(G^T t + N^T f)` are the unbalanced forces. `F` is positive
//! semidefinite, `G` enters skew, and of the friction rows only `mu lambda t_n` is left in `z.M z`: `M` is
//! copositive.
//!
//! The forces `q = q+ - q-` of the bars of mortar strips are unknowns as well, at the end: `y` has the
//! term `F_CL q` too, and their rows are `+-(H q + F_LC t + L K^+ f)`. Eliminated, they would couple
//! all blocks, the farther the less, and pivots would choose between numbers that are next to nothing.

use faer::Mat;

use super::{Equations, Form, FormKind, Layout, Scale};
use crate::forms::reduction::Reduction;
use crate::system::System;

pub(super) fn build(system: &System, reduction: &Reduction) -> Result<Form, lcp::Error> {
    let scale = Scale::of(reduction);
    let layout = Layout::of(system, scale);
    let (m_f, rows) = (layout.friction.len(), layout.rows());
    let g = system.rigid_rows();
    let rigid = g.ncols();
    let bars = layout.bars;
    let order = layout.points + 3 * m_f + 2 * rigid + 2 * bars;
    let mut m = Mat::zeros(order, order);
    let mut q = vec![0.0; order];

    // A row of the system acts on two rows of w, +y_t and -y_t, where it is tangential; and it takes
    // its force from the same two places of z.
    let places: Vec<Vec<(usize, f64)>> = (0..rows).map(|row| layout.terms(row, 1.0)).collect();
    let f = reduction.flexibility(system);
    let free = reduction.block_gaps(system, &vec![0.0; rows]);
    let stiff = scale.force / scale.length;
    let first = layout.points + 3 * m_f;
    let alpha = |k: usize| [(first + k, 1.0), (first + rigid + k, -1.0)];
    for (i, place) in places.iter().enumerate() {
        for &(p, sign) in place {
            q[p] = sign * free[i] / scale.length;
            for (j, other) in places.iter().enumerate().take(f.ncols()) {
                for &(s, other_sign) in other {
                    m[(p, s)] = sign * other_sign * stiff * f[(i, j)];
                }
            }
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
    if let Some(of_bars) = &reduction.bars {
        let bar = |k: usize| [(order - 2 * bars + k, 1.0), (order - bars + k, -1.0)];
        for (p, sign, k) in (0..bars).flat_map(|k| bar(k).map(|(p, sign)| (p, sign, k))) {
            q[p] = sign * of_bars.free[k] / scale.length;
            for j in 0..bars {
                for (s, other_sign) in bar(j) {
                    m[(p, s)] = sign * other_sign * stiff * of_bars.own[(k, j)];
                }
            }
            for (i, place) in places.iter().enumerate() {
                for &(s, other_sign) in place {
                    let value = sign * other_sign * stiff * of_bars.on_rows[(k, i)];
                    m[(p, s)] = value;
                    m[(s, p)] = value;
                }
            }
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
