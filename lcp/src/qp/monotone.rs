//! Standard and mixed problems that are the conditions of a convex quadratic program.

use super::form::{Bounds, Form, Point};
use crate::definite::indefiniteness;
use crate::problem::Groups;
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

/// A mixed problem `[P, -G^T; G, S]` as a form, with the variables that are its `x` and its rows. One that is not free
/// among the `x` has a further row, which is the variable itself.
#[derive(Debug)]
pub(super) struct MixedForm {
    pub(super) form: Form,
    x: Vec<usize>,
    rows: Vec<usize>,
    /// Places among the `x`.
    bounded: Vec<usize>,
}

impl MixedForm {
    /// The form, or what is in the way of the blocks being as they must.
    pub(super) fn new(mixed: &MixedLcp) -> Result<Self, String> {
        let (m, free) = (mixed.m(), mixed.free());
        let Groups { is_x, sign } = mixed.groups().map_err(|(i, j)| no_groups(m, i, j))?;
        let sign = &sign;
        let (x, rows): (Vec<usize>, Vec<usize>) = (0..mixed.order()).partition(|&i| is_x[i]);
        let bounded: Vec<usize> = (0..x.len()).filter(|&k| !free[x[k]]).collect();
        let count = rows.len() + bounded.len();
        let block = |of: &'_ [usize], cols: &'_ [usize]| -> Vec<(usize, usize, f64)> {
            let entries = cols.iter().enumerate().flat_map(|(k, &j)| {
                let nonzero = m.column(j).filter(|(_, v)| *v != 0.0);
                nonzero.filter_map(move |(i, v)| Some((of.binary_search(&i).ok()?, k, sign[i] * v)))
            });
            entries.collect()
        };
        let sparse = |rows, cols, entries: Vec<(usize, usize, f64)>| {
            Matrix::from_entries(rows, cols, entries.into_iter()).into_sparse()
        };
        let p = sparse(x.len(), x.len(), block(&x, &x));
        let own = bounded.iter().enumerate().map(|(row, &k)| (rows.len() + row, k, 1.0));
        let d = sparse(count, x.len(), block(&rows, &x).into_iter().chain(own).collect());
        let s = sparse(count, count, block(&rows, &rows));
        for (what, block) in [("the block of the variables", &p), ("that of the multipliers", &s)] {
            if let Some(reason) = indefiniteness(what, block) {
                return Err(reason);
            }
        }
        let of = |indices: &[usize]| -> Vec<f64> {
            indices.iter().map(|&i| sign[i] * mixed.q()[i]).collect()
        };
        let (linear, mut offset) = (of(&x), of(&rows));
        offset.resize(count, 0.0);
        let bounds_of = |&i: &usize| if free[i] { Bounds::Free } else { Bounds::Nonnegative };
        let mut bounds: Vec<Bounds> = rows.iter().map(bounds_of).collect();
        bounds.resize(count, Bounds::Nonnegative);
        Ok(Self { form: Form { p, d, s, linear, offset, bounds }, x, rows, bounded })
    }

    /// The point of the general problem.
    pub(super) fn to_pairs(&self, mixed: &MixedLcp, point: &Point) -> (Vec<f64>, Vec<f64>) {
        let slacks = self.form.slacks(point);
        let (mut z, mut w) = (vec![0.0; mixed.order()], vec![0.0; mixed.order()]);
        self.x.iter().zip(&point.x).for_each(|(&i, x)| z[i] = *x);
        for (k, &i) in self.rows.iter().enumerate() {
            z[i] = point.lambda[k];
            if !mixed.free()[i] {
                (z[i], w[i]) = (z[i].max(0.0), slacks[k].max(0.0));
            }
        }
        for (k, &place) in self.bounded.iter().enumerate() {
            let i = self.x[place];
            (z[i], w[i]) = (z[i].max(0.0), point.lambda[self.rows.len() + k].max(0.0));
        }
        mixed.to_pairs(&z, &w)
    }
}

/// That there are no groups within which `M` is symmetric, and between which it is skew.
fn no_groups(m: &Matrix, i: usize, j: usize) -> String {
    format!(
        "M must be symmetric within the variables and within the multipliers of a program, and skew between them, which \
         M[{i}, {j}] = {} and M[{j}, {i}] = {} do not allow",
        m[(i, j)],
        m[(j, i)]
    )
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
