//! Standard and mixed problems that are the conditions of a convex quadratic program.

use super::definite::indefiniteness;
use super::form::{Bounds, Form, Point};
use crate::{Error, Lcp, Matrix, MixedLcp};

/// `min z M z / 2 + q z` subject to `z >= 0`, or what is in the way.
pub(super) fn standard_form(lcp: &Lcp) -> Result<Form, String> {
    lcp.m().check_symmetric("M").map_err(not_symmetric)?;
    let s = lcp.m().clone().into_sparse();
    if let Some(reason) = indefiniteness("M", &s) {
        return Err(reason);
    }
    let n = lcp.order();
    let empty = |rows, cols| Matrix::from_entries(rows, cols, std::iter::empty()).into_sparse();
    Ok(Form {
        p: empty(0, 0),
        d: empty(n, 0),
        s,
        linear: Vec::new(),
        offset: lcp.q().to_vec(),
        bounds: vec![Bounds::Nonnegative; n],
    })
}

/// `(z, w)` of a point.
pub(super) fn standard_point(form: &Form, point: &Point) -> (Vec<f64>, Vec<f64>) {
    let positive = |v: &[f64]| v.iter().map(|v| v.max(0.0)).collect();
    (positive(&point.lambda), positive(&form.slacks(point)))
}

/// A mixed problem `[P, -G^T; G, S]` as a form, with the variables that are its `x` and its rows.
#[derive(Debug)]
pub(super) struct MixedForm {
    pub(super) form: Form,
    free: Vec<usize>,
    paired: Vec<usize>,
}

impl MixedForm {
    /// The form, or what is in the way of the blocks being as they must.
    pub(super) fn new(mixed: &MixedLcp) -> Result<Self, String> {
        let m = mixed.m();
        let order = mixed.order();
        let (free, paired): (Vec<usize>, Vec<usize>) = (0..order).partition(|&i| mixed.free()[i]);
        check_structure(mixed)?;
        let [p, d, s] = [(&free, &free), (&paired, &free), (&paired, &paired)].map(
            |(rows, cols): (&Vec<usize>, &Vec<usize>)| {
                let entries = cols.iter().enumerate().flat_map(|(k, &j)| {
                    m.column(j)
                        .filter(|(_, v)| *v != 0.0)
                        .filter_map(move |(i, v)| Some((rows.binary_search(&i).ok()?, k, v)))
                });
                Matrix::from_entries(rows.len(), cols.len(), entries).into_sparse()
            },
        );
        for (what, block) in [("the block of the free variables", &p), ("the other block", &s)] {
            if let Some(reason) = indefiniteness(what, block) {
                return Err(reason);
            }
        }
        let of = |indices: &[usize]| indices.iter().map(|&i| mixed.q()[i]).collect();
        let (linear, offset) = (of(&free), of(&paired));
        let bounds = vec![Bounds::Nonnegative; paired.len()];
        Ok(Self { form: Form { p, d, s, linear, offset, bounds }, free, paired })
    }

    /// The point of the general problem.
    pub(super) fn to_pairs(&self, mixed: &MixedLcp, point: &Point) -> (Vec<f64>, Vec<f64>) {
        let (lambda, slacks) = standard_point(&self.form, point);
        let (mut z, mut w) = (vec![0.0; mixed.order()], vec![0.0; mixed.order()]);
        self.free.iter().zip(&point.x).for_each(|(&i, x)| z[i] = *x);
        for (k, &i) in self.paired.iter().enumerate() {
            (z[i], w[i]) = (lambda[k], slacks[k]);
        }
        mixed.to_pairs(&z, &w)
    }
}

/// That `M` is symmetric within the free and within the other variables, and skew between them.
fn check_structure(mixed: &MixedLcp) -> Result<(), String> {
    let Some((i, j)) = mixed.asymmetry() else { return Ok(()) };
    let kind = if mixed.free()[i] == mixed.free()[j] {
        "symmetric within the free and within the complementary variables"
    } else {
        "skew between free and complementary variables"
    };
    let (v, mirrored) = (mixed.m()[(i, j)], mixed.m()[(j, i)]);
    Err(format!("M must be {kind}, but M[{i}, {j}] is {v} and M[{j}, {i}] is {mirrored}"))
}

fn not_symmetric(error: Error) -> String {
    match error {
        Error::NotSymmetric { what, row, col, value, mirrored } => format!(
            "{what} is not symmetric: {what}[{row}, {col}] is {value} and {what}[{col}, {row}] is \
             {mirrored}"
        ),
        other => other.to_string(),
    }
}
