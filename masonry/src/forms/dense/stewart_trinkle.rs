//! The form in `t_n`, `b+`, `b-`, `lambda` on the reduced problem.

use super::reduced::{normal_start, tangents_in_i};
use super::{Equations, Form, FormKind, Start, reduced};
use crate::forms::reduction::Reduction;
use crate::system::System;

pub(super) fn build(system: &System, reduction: &Reduction) -> Result<Form, lcp::Error> {
    let mut form = reduced::build(FormKind::StewartTrinkle, system, reduction, 3);
    let layout = &form.layout;
    for (k, friction) in layout.friction.iter().enumerate() {
        let [plus, minus, lambda] = [1, 2, 3].map(|group| layout.pair(group, k));
        // s+ + s- = 2 lambda
        let row = layout.rows() + k;
        form.b[(row, plus)] = 1.0;
        form.b[(row, minus)] = 1.0;
        form.a[(row, lambda)] = -2.0;
        // w = mu t_n + C_0 - b+ - b-
        let row = row + layout.friction.len();
        form.b[(row, lambda)] = 1.0;
        form.a[(row, friction.contact.index())] = -friction.cone.mu;
        form.c[row] = friction.cone.base;
        form.a[(row, plus)] = 1.0;
        form.a[(row, minus)] = 1.0;
    }
    let starts = starts(&form, reduction);
    form.into_form(FormKind::StewartTrinkle, starts)
}

/// `y_nE`, `t_nI` and `(s+, b-, lambda)` or `(s-, b+, lambda)` are basic: sliding. At an isostatic tangential
/// row `(b+, s-, w)` or `(b-, s+, w)` are: sticking, the force given by equilibrium.
fn starts(form: &Equations, reduction: &Reduction) -> Vec<Start> {
    let held = tangents_in_i(form, reduction);
    reduced::starts(form, |forwards| {
        let mut t_basic = normal_start(form, reduction);
        for (k, held) in held.iter().enumerate() {
            let plus = if *held { forwards } else { !forwards };
            t_basic[form.layout.pair(1, k)] = plus;
            t_basic[form.layout.pair(2, k)] = !plus;
            t_basic[form.layout.pair(3, k)] = !held;
        }
        t_basic
    })
}
