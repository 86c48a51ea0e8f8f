//! All solutions of a tiny complementarity problem with a nonsingular basis, by trying every basis.

use masonry::forms::DenseForm;
use nalgebra::{DMatrix, DVector};

/// All basic solutions `(t, y)`; those of degenerate bases may repeat.
pub fn solutions(form: &DenseForm) -> Vec<(Vec<f64>, Vec<f64>)> {
    let n = form.order();
    assert!(n <= 16, "{n} pairs have too many bases");
    let c = DVector::from_column_slice(form.problem.c());
    (0..1_u32 << n).filter_map(|mask| basic_solution(form, &c, mask)).collect()
}

fn basic_solution(form: &DenseForm, c: &DVector<f64>, mask: u32) -> Option<(Vec<f64>, Vec<f64>)> {
    let n = form.order();
    let t_basic = |j: usize| mask >> j & 1 == 1;
    let basis = DMatrix::from_fn(n, n, |i, j| {
        if t_basic(j) { form.problem.a()[(i, j)] } else { form.problem.b()[(i, j)] }
    });
    let x = basis.clone().lu().solve(c)?;
    let residual = (basis * &x - c).amax();
    let size = 1.0 + x.amax();
    if !(residual <= 1e-12 * size && size < 1e8 && x.min() >= -1e-11 * size) {
        return None;
    }
    let part = |t: bool| (0..n).map(|j| if t_basic(j) == t { x[j] } else { 0.0 }).collect();
    Some((part(true), part(false)))
}

/// Largest violation of `A t + B y = c`, `t >= 0`, `y >= 0`, `t.y = 0`, relative to the variables.
pub fn violation(form: &DenseForm, t: &[f64], y: &[f64]) -> f64 {
    let size = t.iter().chain(y).fold(1.0, |m: f64, x| m.max(x.abs()));
    let row = |i: usize| {
        let sum: f64 = (0..form.order())
            .map(|j| form.problem.a()[(i, j)] * t[j] + form.problem.b()[(i, j)] * y[j])
            .sum();
        (sum - form.problem.c()[i]).abs()
    };
    let equation = (0..form.order()).map(row).fold(0.0, f64::max);
    let pairs = t.iter().zip(y).map(|(t, y)| t.min(*y).abs());
    pairs.fold(equation, f64::max) / size
}
