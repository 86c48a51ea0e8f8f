//! Mixed problems that are the conditions of a convex quadratic program.

use faer::sparse::SparseColMat;

use super::form::{Bounds, Form, ProgramPoint};
use crate::definite::indefiniteness;
use crate::problem::{Groups, column_of};
use crate::states::Scaled;
use crate::{Matrix, MixedLcp};

/// A mixed problem `[P, -G^T; G, S]` as a form, with the variables that are its `x` and its rows. A bounded variable
/// among the `x` has a further row, the variable itself.
#[derive(Debug)]
pub(super) struct MixedProgram {
    pub(super) form: Form,
    x: Vec<usize>,
    rows: Vec<usize>,
    /// Places among the `x`.
    bounded: Vec<usize>,
}

impl MixedProgram {
    /// The form in scaled units, or the reason for which the blocks do not have the required properties.
    pub(super) fn new(mixed: &MixedLcp, scaled: &Scaled) -> Result<Self, String> {
        let (m, free) = (mixed.m(), mixed.free());
        let Groups { is_x, sign } = mixed.groups().map_err(|(i, j)| no_groups(m, i, j))?;
        let (x, rows): (Vec<usize>, Vec<usize>) = (0..mixed.order()).partition(|&i| is_x[i]);
        let bounded: Vec<usize> = (0..x.len()).filter(|&k| !free[x[k]]).collect();
        let count = rows.len() + bounded.len();
        let block = |m: &SparseColMat<usize, f64>, of: &[usize], cols: &[usize]| {
            let mut entries = Vec::new();
            for (k, &j) in cols.iter().enumerate() {
                let nonzero = column_of(m, j).filter(|(_, v)| *v != 0.0);
                entries.extend(
                    nonzero.filter_map(|(i, v)| Some((of.binary_search(&i).ok()?, k, sign[i] * v))),
                );
            }
            entries
        };
        let sparse = |rows, cols, entries: Vec<(usize, usize, f64)>| {
            Matrix::from_entries(rows, cols, entries.into_iter()).into_sparse()
        };
        let given = m.clone().into_sparse();
        let of_x = if rows.is_empty() { "M" } else { "the block of the variables" };
        for (what, group) in [(of_x, &x), ("that of the multipliers", &rows)] {
            let block = sparse(group.len(), group.len(), block(&given, group, group));
            if let Some(reason) = indefiniteness(what, &block) {
                return Err(reason);
            }
        }
        let own = bounded.iter().enumerate().map(|(row, &k)| (rows.len() + row, k, 1.0));
        let d = block(&scaled.k, &rows, &x).into_iter().chain(own).collect();
        let (p, d) = (block(&scaled.k, &x, &x), sparse(count, x.len(), d));
        let s = sparse(count, count, block(&scaled.k, &rows, &rows));
        let p = sparse(x.len(), x.len(), p);
        let of = |indices: &[usize]| -> Vec<f64> {
            indices.iter().map(|&i| -sign[i] * scaled.f[i]).collect()
        };
        let (linear, mut offset) = (of(&x), of(&rows));
        offset.resize(count, 0.0);
        let bounds_of = |&i: &usize| if free[i] { Bounds::Free } else { Bounds::Nonnegative };
        let mut bounds: Vec<Bounds> = rows.iter().map(bounds_of).collect();
        bounds.resize(count, Bounds::Nonnegative);
        Ok(Self { form: Form { p, d, s, linear, offset, bounds }, x, rows, bounded })
    }

    /// Displacements and forces of the scaled problem: the variables, and the forces of their bounds.
    pub(super) fn to_scaled(
        &self,
        scaled: &Scaled,
        point: &ProgramPoint,
    ) -> (Vec<f64>, Vec<(f64, f64)>) {
        let slacks = self.form.slacks(point);
        let (mut z, mut w) = (vec![0.0; scaled.order()], vec![0.0; scaled.order()]);
        self.x.iter().zip(&point.x).for_each(|(&i, x)| z[i] = *x);
        for (k, &i) in self.rows.iter().enumerate() {
            (z[i], w[i]) = (point.lambda[k], slacks[k]);
        }
        for (k, &place) in self.bounded.iter().enumerate() {
            w[self.x[place]] = point.lambda[self.rows.len() + k];
        }
        let mut forces = Vec::with_capacity(scaled.points.len());
        for at in scaled.points.iter() {
            let j = at.columns[0];
            z[j] = z[j].max(0.0);
            forces.push((w[j].max(0.0), 0.0));
        }
        (z, forces)
    }
}

/// The message that there are no groups within which `M` is symmetric, and between which it is skew.
fn no_groups(m: &Matrix, i: usize, j: usize) -> String {
    format!(
        "M must be symmetric within the variables and within the multipliers of a program, and skew between them, but \
         M[{i}, {j}] is {} and M[{j}, {i}] is {}",
        m[(i, j)],
        m[(j, i)]
    )
}
