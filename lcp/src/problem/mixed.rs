//! Complementary pairs together with free variables.

use super::{BoxedLcp, HorizontalLcp, Lcp};
use crate::vector::check_length;
use crate::{Error, Matrix, Vector};

/// The mixed problem `w = M z + q` of order `n`. Every `z_i` is either free, with `w_i = 0`, or complementary:
/// `z_i >= 0`, `w_i >= 0`, `z_i w_i = 0`.
///
/// The block of the free variables may be singular: its inverse is not used.
///
/// ```
/// use faer::mat;
/// use lcp::{Lemke, MixedLcp, Solver};
/// // u free and v >= 0:  v - 1 = 0,  w = -u + v + 1: the block of u is zero
/// let mixed = MixedLcp::new(mat![[0.0, 1.0], [-1.0, 1.0]], vec![-1.0, 1.0], vec![true, false])?;
/// let solution = Lemke::default().solve(&mixed)?;
/// let (z, w) = mixed.variables(&solution);
/// assert_eq!((z, w), (vec![2.0, 1.0], vec![0.0, 0.0]));
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct MixedLcp {
    boxed: BoxedLcp,
    free: Vec<bool>,
}

impl MixedLcp {
    /// A problem of order `n` from `M` (n x n), `q` (n) and a flag for every variable, true if it is free (n).
    ///
    /// # Errors
    /// [`Error::Shape`] or [`Error::Length`] if the sizes do not agree, [`Error::NotFinite`] for a NaN or an infinity.
    pub fn new(m: impl Into<Matrix>, q: impl Into<Vector>, free: Vec<bool>) -> Result<Self, Error> {
        let q = q.into().into_entries();
        check_length("free", free.len(), q.len())?;
        let bound = |&free: &bool| if free { f64::NEG_INFINITY } else { 0.0 };
        let lower: Vec<f64> = free.iter().map(bound).collect();
        let upper = vec![f64::INFINITY; free.len()];
        Ok(Self { boxed: BoxedLcp::new(m, q, lower, upper)?, free })
    }

    /// A standard problem, without free variables.
    pub(crate) fn of_standard(lcp: &Lcp) -> Result<Self, Error> {
        Self::new(lcp.m().clone(), lcp.q().to_vec(), vec![false; lcp.order()])
    }

    /// Number of variables, free and complementary.
    pub fn order(&self) -> usize {
        self.free.len()
    }

    /// The matrix.
    pub fn m(&self) -> &Matrix {
        self.boxed.m()
    }

    /// The vector.
    pub fn q(&self) -> &[f64] {
        self.boxed.q()
    }

    /// Whether each variable is free.
    pub fn free(&self) -> &[bool] {
        &self.free
    }

    /// The general problem, of the same order: a complementary variable has the pair `(z_i, w_i)`, a free one the pair
    /// of its positive and its negative part.
    pub fn to_general(&self) -> HorizontalLcp {
        self.boxed.to_general()
    }

    /// `(z, w)` from a point of the general problem.
    ///
    /// # Panics
    /// If `t` or `y` does not have one entry for every pair of the general problem.
    pub fn recover(&self, t: &[f64], y: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.boxed.recover(t, y)
    }

    /// The point of the general problem that belongs to `(z, w)`.
    ///
    /// # Panics
    /// If `z` or `w` does not have `n` entries.
    pub fn to_pairs(&self, z: &[f64], w: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.boxed.to_pairs(z, w)
    }

    /// An entry that violates the symmetry of `M` among free or among other variables, or its skew symmetry between the
    /// two kinds.
    pub(crate) fn asymmetry(&self) -> Option<(usize, usize)> {
        let free = self.free();
        self.m().asymmetry(|i, j| if free[i] == free[j] { 1.0 } else { -1.0 })
    }

    /// The groups of a quadratic program to which the variables belong, or an entry that fits no groups.
    pub(crate) fn groups(&self) -> Result<Groups, (usize, usize)> {
        let (m, n, free) = (self.m(), self.order(), self.free());
        // The row of a free variable without a diagonal entry is an equation, whose sign does not matter. Such a
        // variable is coupled to the other group alone: a coupling within its own group would leave no semidefinite
        // block.
        let is_equation: Vec<bool> = (0..n).map(|i| free[i] && m[(i, i)] == 0.0).collect();
        // The group, and the sign that follows from the rows.
        let mut labels: Vec<Option<[bool; 2]>> = vec![None; n];
        let mut roots: Vec<usize> = (0..n).collect();
        roots.sort_by_key(|&j| (is_equation[j], !free[j], m[(j, j)] == 0.0));
        for root in roots {
            if labels[root].is_some() {
                continue;
            }
            labels[root] = Some([true; 2]);
            let mut next = vec![root];
            while let Some(j) = next.pop() {
                let Some([group, sign]) = labels[j] else { continue };
                for (i, v) in m.column(j).filter(|(i, v)| *v != 0.0 && *i != j) {
                    let is_same = match m.likeness(i, j, v) {
                        [true, true] => continue,
                        [false, false] => return Err((i, j)),
                        [is_same, _] => is_same,
                    };
                    let is_within = is_same && !is_equation[i] && !is_equation[j];
                    let label = [group == is_within, sign == is_same];
                    if !is_equation[i] && label[0] != label[1]
                        || labels[i].is_some_and(|it| it != label)
                    {
                        return Err((i, j));
                    }
                    if labels[i].is_none() {
                        labels[i] = Some(label);
                        next.push(i);
                    }
                }
            }
        }
        let labels: Vec<[bool; 2]> = labels.into_iter().flatten().collect();
        Ok(Groups {
            is_x: labels.iter().map(|label| label[0]).collect(),
            sign: labels
                .iter()
                .map(|[group, sign]| if group == sign { 1.0 } else { -1.0 })
                .collect(),
        })
    }

    /// The same problem in terms of bounds.
    pub fn boxed(&self) -> &BoxedLcp {
        &self.boxed
    }
}

/// The variables of a quadratic program and its multipliers: with signs for its rows `M` is symmetric within each of
/// these two groups, and skew between them.
#[derive(Debug, Clone)]
pub(crate) struct Groups {
    /// Whether a variable belongs to the program, and is not a multiplier.
    pub(crate) is_x: Vec<bool>,
    /// The sign of every row: minus one only for equations.
    pub(crate) sign: Vec<f64>,
}
