//! What one relaxation changes together.

use super::coulomb::Coulomb;
use super::{Constraint, Rows};
use crate::vector::check_length;
use crate::{Error, Method};

/// A constraint with its first row and what its relaxation needs of the matrix.
#[derive(Debug, Clone, Copy)]
pub(super) enum Block {
    Bounds { row: usize, diagonal: f64, lower: f64, upper: f64 },
    Contact { row: usize, contact: Coulomb },
}

impl Block {
    /// The blocks of a problem, with the entries of the matrix that belong to one block. Its diagonal
    /// must be positive where a row is ever relaxed.
    pub(super) fn all<R: Rows + ?Sized>(
        rows: &mut R,
        constraints: &[Constraint],
        method: Method,
    ) -> Result<Vec<Self>, Error> {
        let taken = constraints.iter().map(|constraint| constraint.rows()).sum();
        check_length("rows of the constraints", taken, rows.order())?;
        rows.clear();
        let mut entries = Entries { unit: vec![0.0; rows.order()], rows, method };
        let mut row = 0;
        let mut block = |(index, &constraint): (usize, &Constraint)| {
            let first = row;
            row += constraint.rows();
            Self::new(&mut entries, first, constraint, index)
        };
        constraints.iter().enumerate().map(&mut block).collect()
    }

    fn new<R: Rows + ?Sized>(
        entries: &mut Entries<'_, R>,
        row: usize,
        constraint: Constraint,
        index: usize,
    ) -> Result<Self, Error> {
        match constraint {
            Constraint::Bounds { lower, upper } => {
                let is_ordered =
                    lower <= upper && lower < f64::INFINITY && upper > f64::NEG_INFINITY;
                if !is_ordered {
                    return Err(Error::Bounds { index, lower, upper });
                }
                let is_fixed = lower >= upper;
                let diagonal = if is_fixed { 1.0 } else { entries.positive(row)? };
                Ok(Self::Bounds { row, diagonal, lower, upper })
            }
            Constraint::Friction { mu } => {
                if !(mu >= 0.0 && mu.is_finite()) {
                    let range = "at least zero and finite";
                    return Err(Error::Setting { name: "mu", value: mu, range });
                }
                let normal = entries.positive(row)?;
                let tangential = if mu > 0.0 { entries.positive(row + 1)? } else { 1.0 };
                let w = [
                    [normal, entries.entry(row, row + 1)],
                    [entries.entry(row + 1, row), tangential],
                ];
                Ok(Self::Contact { row, contact: Coulomb { w, mu } })
            }
        }
    }

    /// First row, and number of rows.
    pub(super) fn rows(&self) -> std::ops::Range<usize> {
        match *self {
            Self::Bounds { row, .. } => row..row + 1,
            Self::Contact { row, .. } => row..row + 2,
        }
    }

    /// The diagonal entries of its rows.
    pub(super) fn diagonals(&self) -> impl Iterator<Item = f64> {
        let (first, second) = match *self {
            Self::Bounds { diagonal, .. } => (diagonal, None),
            Self::Contact { contact: Coulomb { w, .. }, .. } => (w[0][0], Some(w[1][1])),
        };
        std::iter::once(first).chain(second)
    }

    /// Moves `z` to where the block allows it to be.
    pub(super) fn project(&self, z: &mut [f64]) {
        match *self {
            Self::Bounds { row, lower, upper, .. } => z[row] = z[row].max(lower).min(upper),
            Self::Contact { row, contact } => {
                z[row] = z[row].max(0.0);
                let bound = contact.mu * z[row];
                z[row + 1] = z[row + 1].max(-bound).min(bound) + 0.0;
            }
        }
    }

    /// The part of `w` that the block allows at `z`: zero where `w` must vanish.
    pub(super) fn allowed(&self, z: &[f64], w: &mut [f64]) {
        match *self {
            Self::Bounds { row, lower, upper, .. } => {
                let least = if z[row] >= upper { f64::NEG_INFINITY } else { 0.0 };
                let most = if z[row] <= lower { f64::INFINITY } else { 0.0 };
                w[row] = w[row].max(least).min(most);
            }
            Self::Contact { row, contact } => {
                let (normal, tangential) = (z[row], z[row + 1]);
                let bound = contact.mu * normal;
                w[row] = if normal > 0.0 { 0.0 } else { w[row].max(0.0) };
                let least = if tangential >= bound { f64::NEG_INFINITY } else { 0.0 };
                let most = if tangential <= -bound { f64::INFINITY } else { 0.0 };
                w[row + 1] = w[row + 1].max(least).min(most);
            }
        }
    }

    /// The entries of `z` that solve the block, with its part of the matrix divided by the over-relaxation;
    /// of a single row the first one.
    pub(super) fn relaxed<R: Rows + ?Sized>(
        &self,
        rows: &R,
        q: &[f64],
        z: &[f64],
        relaxation: f64,
    ) -> [f64; 2] {
        let w = |row: usize| rows.product(row, z) + q[row];
        match *self {
            Self::Bounds { row, diagonal, lower, upper } => {
                let value = z[row] - relaxation * w(row) / diagonal;
                [value.max(lower).min(upper), 0.0]
            }
            Self::Contact { row, contact } => {
                let (r, v) = ([z[row], z[row + 1]], [w(row), w(row + 1)]);
                let relaxed =
                    Coulomb { w: contact.w.map(|w| w.map(|w| w / relaxation)), ..contact };
                let p = [0, 1].map(|i| v[i] - relaxed.w[i][0] * r[0] - relaxed.w[i][1] * r[1]);
                relaxed.forces(p).unwrap_or_else(|| relaxed.in_turn(p, r[1]))
            }
        }
    }
}

/// Entries of the matrix, from products with unit vectors.
struct Entries<'a, R: ?Sized> {
    rows: &'a mut R,
    /// Zero between the calls, as is the state of the rows.
    unit: Vec<f64>,
    method: Method,
}

impl<R: Rows + ?Sized> Entries<'_, R> {
    fn entry(&mut self, i: usize, j: usize) -> f64 {
        self.unit[j] = 1.0;
        self.rows.moved(j, 1.0);
        let entry = self.rows.product(i, &self.unit);
        self.unit[j] = 0.0;
        self.rows.moved(j, -1.0);
        entry
    }

    fn positive(&mut self, i: usize) -> Result<f64, Error> {
        let diagonal = self.entry(i, i);
        if diagonal > 0.0 && diagonal.is_finite() {
            return Ok(diagonal);
        }
        let reason = format!(
            "row {i} has the diagonal entry {diagonal}, and only rows with a positive one can be \
             relaxed: take Lemke's method"
        );
        Err(Error::NotTreated { method: self.method, reason })
    }
}
