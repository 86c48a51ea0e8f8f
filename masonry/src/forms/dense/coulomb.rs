//! The paper's form (3.26), (3.27) in `t_n`, `p+`, `p-`.

use super::reduced::{normal_start, tangents_in_i};
use super::{Equations, Form, FormKind, Start, reduced};
use crate::forms::reduction::Reduction;
use crate::system::System;

pub(super) fn build(system: &System, reduction: &Reduction) -> Result<Form, lcp::Error> {
    let mut form = reduced::build(FormKind::Coulomb, system, reduction, 2);
    // The definition of the cone, p+ + p- = 2 (mu t_n + C_0) (3.24).
    for (k, friction) in form.layout.friction.iter().enumerate() {
        let (plus, minus) = (form.layout.pair(1, k), form.layout.pair(2, k));
        let row = form.layout.rows() + k;
        form.a[(row, friction.contact.index())] = -2.0 * friction.cone.mu;
        form.c[row] = 2.0 * friction.cone.base;
        form.a[(row, plus)] = 1.0;
        form.a[(row, minus)] = 1.0;
    }
    let starts = starts(&form, reduction);
    form.into_form(FormKind::Coulomb, starts)
}

/// `y_nE`, `t_nI` and one of `(y+, p-)`, `(y-, p+)` are basic. At an isostatic tangential row both `p` are:
/// equilibrium gives their difference and the cone their sum.
fn starts(form: &Equations, reduction: &Reduction) -> Vec<Start> {
    let held = tangents_in_i(form, reduction);
    reduced::starts(form, |forwards| {
        let mut t_basic = normal_start(form, reduction);
        for (k, held) in held.iter().enumerate() {
            t_basic[form.layout.pair(1, k)] = *held || !forwards;
            t_basic[form.layout.pair(2, k)] = *held || forwards;
        }
        t_basic
    })
}
