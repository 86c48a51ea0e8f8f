//! General problems that are standard problems in another form.

use super::{HorizontalLcp, Lcp};
use crate::{Basis, Matrix, Side, WarmStart};

/// A general problem written in the standard form. See [`HorizontalLcp::to_standard`].
#[derive(Debug, Clone)]
pub struct StandardForm {
    lcp: Lcp,
    /// The side of every pair that is `w`.
    sides: Vec<Side>,
}

impl HorizontalLcp {
    /// The same problem in the standard form, if no elimination is needed: one column of every pair has a single
    /// entry, all of them in different rows. The variable of that column is `w`, the other one is `z`. `None` for all
    /// other problems.
    ///
    /// ```
    /// use faer::mat;
    /// use lcp::HorizontalLcp;
    /// // The second pair is the other way round.
    /// let problem = HorizontalLcp::new(
    ///     mat![[-2.0, 0.0], [-1.0, 4.0]], mat![[1.0, -1.0], [0.0, -8.0]], vec![-5.0, -24.0])?;
    /// let standard = problem.to_standard().expect("columns y_1 and t_2 have one entry");
    /// assert_eq!(standard.lcp().m()[(1, 0)], 0.25);
    /// assert_eq!(standard.to_pairs(&[1.0, 2.0], &[3.0, 4.0]), (vec![1.0, 4.0], vec![3.0, 2.0]));
    /// # Ok::<(), lcp::Error>(())
    /// ```
    pub fn to_standard(&self) -> Option<StandardForm> {
        let n = self.order();
        let mut of_row: Vec<Option<(usize, f64)>> = vec![None; n];
        let mut sides = vec![Side::Y; n];
        let mut undecided = Vec::new();
        for pair in 0..n {
            let [t, y] = [Side::T, Side::Y].map(|side| self.column(pair, side).single());
            let (side, (row, value)) = match (t, y) {
                (None, None) => return None,
                (Some(_), Some(_)) => {
                    undecided.push(pair);
                    continue;
                }
                (Some(single), None) => (Side::T, single),
                (None, Some(single)) => (Side::Y, single),
            };
            sides[pair] = side;
            if of_row[row].replace((pair, value)).is_some() {
                return None;
            }
        }
        for pair in undecided {
            let single = |side| Some((side, self.column(pair, side).single()?));
            let mut singles = [Side::Y, Side::T].into_iter().filter_map(single);
            let (side, (row, value)) = singles.find(|(_, (row, _))| of_row[*row].is_none())?;
            sides[pair] = side;
            of_row[row] = Some((pair, value));
        }
        let of_row: Vec<(usize, f64)> = of_row.into_iter().collect::<Option<_>>()?;
        Some(StandardForm { lcp: self.divided(&sides, &of_row)?, sides })
    }

    /// `M` and `q`: rows in the order of their `w`, divided by the coefficient of that `w`.
    fn divided(&self, sides: &[Side], of_row: &[(usize, f64)]) -> Option<Lcp> {
        let n = self.order();
        let mut q = vec![0.0; n];
        of_row.iter().zip(self.c()).for_each(|((pair, value), c)| q[*pair] = c / value);
        let entries = (0..n).flat_map(|j| {
            let matrix = sides[j].of(self.b(), self.a());
            matrix.column(j).map(move |(row, v)| {
                let (pair, value) = of_row[row];
                (pair, j, -v / value)
            })
        });
        let m = Matrix::assembled(n, self.is_sparse(), entries);
        // Divisions may overflow.
        Lcp::new(m, q).ok()
    }
}

impl StandardForm {
    /// The standard problem.
    pub fn lcp(&self) -> &Lcp {
        &self.lcp
    }

    /// The point of the general problem that belongs to `(z, w)`, or `(z, w)` from a point of the general problem:
    /// the entries of the pairs whose `t` is `w` are exchanged.
    ///
    /// # Panics
    /// If `z` or `w` does not have one entry for every pair.
    pub fn to_pairs(&self, z: &[f64], w: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let n = self.sides.len();
        assert!(z.len() == n && w.len() == n, "a point has one entry for every pair");
        let pairs = z.iter().zip(w).zip(&self.sides);
        pairs.map(|((z, w), side)| side.of((*w, *z), (*z, *w))).unzip()
    }

    /// The start for the standard problem from a start for the general problem.
    pub(crate) fn start(&self, start: &WarmStart) -> WarmStart {
        start.of_pairs(self.pairs())
    }

    /// A basis of either problem as a basis of the other one.
    pub(crate) fn basis(&self, basis: &Basis) -> Basis {
        basis.of_pairs(self.pairs())
    }

    /// All pairs, and whether their `t` is `w`.
    fn pairs(&self) -> impl Iterator<Item = (usize, bool)> {
        self.sides.iter().map(|side| *side == Side::T).enumerate()
    }
}
