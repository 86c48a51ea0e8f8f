//! The variables that one relaxation changes together.

use std::ops::Range;

use super::coulomb::Coulomb;
use super::{Constraint, Rows};
use crate::vector::{check_interval, check_length};
use crate::{Error, Method};

/// A constraint with its first row and the entries of the matrix in its own rows and columns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block {
    row: usize,
    constraint: Constraint,
    /// The entries; only the first one counts for bounds, which are relaxed one by one.
    w: [[f64; 2]; 2],
}

impl Block {
    /// The blocks of a problem. A row that is ever relaxed must have a positive entry on the diagonal.
    pub(super) fn all<R: Rows + ?Sized>(
        rows: &mut R,
        constraints: &[Constraint],
    ) -> Result<Vec<Self>, Error> {
        let taken = constraints.iter().map(|constraint| constraint.rows()).sum();
        check_length("rows of the constraints", taken, rows.order())?;
        rows.clear();
        let mut unit = vec![0.0; rows.order()];
        let mut blocks = Vec::with_capacity(constraints.len());
        let mut row = 0;
        for (index, &constraint) in constraints.iter().enumerate() {
            constraint.check(index)?;
            let mut block = Self { row, constraint, w: [[0.0; 2]; 2] };
            for j in 0..constraint.rows() {
                unit[row + j] = 1.0;
                rows.moved(row + j, 1.0);
                for i in 0..constraint.rows() {
                    block.w[i][j] = rows.product(row + i, &unit);
                }
                unit[row + j] = 0.0;
                rows.moved(row + j, -1.0);
            }
            for i in 0..constraint.rows() {
                if block.is_fixed(i) {
                    block.w[i][i] = 1.0;
                } else if !(block.w[i][i] > 0.0 && block.w[i][i].is_finite()) {
                    let reason = format!(
                        "row {} has the diagonal entry {}, and only rows with a positive one can be \
                         relaxed: take Lemke's method",
                        row + i,
                        block.w[i][i]
                    );
                    return Err(Error::NotTreated { method: Method::GaussSeidel, reason });
                }
            }
            blocks.push(block);
            row += constraint.rows();
        }
        Ok(blocks)
    }

    pub(super) fn rows(&self) -> Range<usize> {
        self.row..self.row + self.constraint.rows()
    }

    pub(super) fn diagonals(&self) -> impl Iterator<Item = f64> + use<> {
        let w = self.w;
        (0..self.constraint.rows()).map(move |i| w[i][i])
    }

    /// Whether the constraint allows only one value in its row of this number.
    fn is_fixed(&self, i: usize) -> bool {
        match self.constraint {
            Constraint::Bounds { lower, upper } => lower >= upper,
            Constraint::Friction { mu } => i == 1 && mu == 0.0,
        }
    }

    /// The bounds of a row at `z`: those of the tangential force depend on the normal one.
    fn bounds(&self, row: usize, z: &[f64]) -> [f64; 2] {
        match self.constraint {
            Constraint::Bounds { lower, upper } => [lower, upper],
            Constraint::Friction { .. } if row == self.row => [0.0, f64::INFINITY],
            Constraint::Friction { mu } => [-mu * z[self.row], mu * z[self.row]],
        }
    }

    /// Projects `z` onto the values that the block allows.
    pub(super) fn project(&self, z: &mut [f64]) {
        for row in self.rows() {
            let [lower, upper] = self.bounds(row, z);
            // The sum gives zeros without a sign.
            z[row] = z[row].max(lower).min(upper) + 0.0;
        }
    }

    /// The part of `w` that the block allows at `z`: zero if `w` must vanish.
    pub(super) fn allowed(&self, z: &[f64], w: &mut [f64]) {
        for row in self.rows() {
            let [lower, upper] = self.bounds(row, z);
            let least = if z[row] >= upper { f64::NEG_INFINITY } else { 0.0 };
            let most = if z[row] <= lower { f64::INFINITY } else { 0.0 };
            w[row] = w[row].max(least).min(most);
        }
    }

    /// The entries of `z` that solve the block, with its part of the matrix divided by the over-relaxation;
    /// the second entry is used for contacts only.
    pub(super) fn relaxed<R: Rows + ?Sized>(
        &self,
        rows: &R,
        q: &[f64],
        z: &[f64],
        relaxation: f64,
    ) -> [f64; 2] {
        let w = |row: usize| rows.product(row, z) + q[row];
        let row = self.row;
        match self.constraint {
            Constraint::Bounds { lower, upper } => {
                let value = z[row] - relaxation * w(row) / self.w[0][0];
                [value.clamp(lower, upper), 0.0]
            }
            Constraint::Friction { mu } => {
                let contact = Coulomb { w: self.w.map(|w| w.map(|w| w / relaxation)), mu };
                let (r, v) = ([z[row], z[row + 1]], [w(row), w(row + 1)]);
                let p = [0, 1].map(|i| v[i] - contact.w[i][0] * r[0] - contact.w[i][1] * r[1]);
                contact.forces(p).unwrap_or_else(|| contact.in_turn(p, r[1]))
            }
        }
    }
}

impl Constraint {
    /// Checks that some value meets the constraint, which has this number.
    fn check(self, index: usize) -> Result<(), Error> {
        match self {
            Self::Bounds { lower, upper } => check_interval("variable", index, lower, upper),
            Self::Friction { mu } if !(mu >= 0.0 && mu.is_finite()) => {
                Err(Error::Setting { name: "mu", value: mu, range: "at least zero and finite" })
            }
            Self::Friction { .. } => Ok(()),
        }
    }
}
