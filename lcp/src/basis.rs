//! Complementary bases: one column of every pair.

use crate::vector::max_abs;

/// The basic variable of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Side {
    /// The first variable, `t_i`: column `i` of `A`.
    T,
    /// The second variable, `y_i`: column `i` of `B`.
    Y,
}

impl Side {
    /// The other variable of the pair.
    #[must_use]
    pub fn complement(self) -> Self {
        match self {
            Self::T => Self::Y,
            Self::Y => Self::T,
        }
    }

    /// The one of two values that belongs to this side.
    pub fn of<T>(self, t: T, y: T) -> T {
        match self {
            Self::T => t,
            Self::Y => y,
        }
    }
}

/// A complementary basis: for every pair the variable that may be positive.
///
/// ```
/// use lcp::{Basis, Side};
/// let basis = Basis::all(Side::Y, 3);
/// assert_eq!(basis.sides().len(), 3);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Basis(Vec<Side>);

impl Basis {
    /// A basis from the basic side of every pair.
    pub fn new(sides: Vec<Side>) -> Self {
        Self(sides)
    }

    /// The basis of `n` pairs that has the same side everywhere.
    pub fn all(side: Side, n: usize) -> Self {
        Self(vec![side; n])
    }

    /// The basis of the larger variable of every pair, each in units of the largest of its vector.
    pub(crate) fn of_larger(t: &[f64], y: &[f64]) -> Self {
        let (t_max, y_max) = (max_abs(t), max_abs(y));
        let share = |v: f64, max: f64| if max > 0.0 { v / max } else { 0.0 };
        let side = |(&t, &y): (&f64, &f64)| {
            if share(t, t_max) > share(y, y_max) { Side::T } else { Side::Y }
        };
        Self(t.iter().zip(y).map(side).collect())
    }

    /// The sides of these pairs, whose variables may be exchanged.
    pub(crate) fn of_pairs(&self, pairs: impl Iterator<Item = (usize, bool)>) -> Self {
        let side = |(pair, is_exchanged): (usize, bool)| {
            if is_exchanged { self.0[pair].complement() } else { self.0[pair] }
        };
        Self(pairs.map(side).collect())
    }

    /// Replaces the sides by others of the same number.
    pub(crate) fn set(&mut self, sides: impl Iterator<Item = Side>) {
        self.0.iter_mut().zip(sides).for_each(|(side, other)| *side = other);
    }

    /// The basic side of every pair.
    pub fn sides(&self) -> &[Side] {
        &self.0
    }

    /// Number of pairs.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether the basis has no pairs.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}
