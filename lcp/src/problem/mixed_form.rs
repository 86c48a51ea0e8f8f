//! Problems with bounds that are mixed problems in another form.

use super::boxed::{BoundKind, Distance};
use super::{BoxedLcp, MixedLcp};
use crate::{Basis, Error, Matrix, Side, WarmStart};

/// A problem with bounds as a mixed problem of the distances from the bounds nearer to zero. A second bound has a row
/// of its own with a multiplier; fixed variables are left out.
#[derive(Debug, Clone)]
pub(crate) struct MixedForm<'a> {
    problem: &'a BoxedLcp,
    mixed: MixedLcp,
    /// The pair of every variable in the general form of the problem with bounds, and whether `w` is first in that
    /// pair.
    pairs: Vec<(usize, bool)>,
    /// The row of the general form for every row, and its sign.
    rows: Vec<(usize, f64)>,
}

impl BoxedLcp {
    /// The same problem as a mixed one.
    ///
    /// # Errors
    /// [`Error::Overflow`] if distances exceed the range of numbers.
    pub(crate) fn to_mixed(&self) -> Result<MixedForm<'_>, Error> {
        let kinds = self.kinds();
        let mut right = self.q().to_vec();
        let (mut pairs, mut rows, mut places) = (Vec::new(), Vec::new(), vec![None; kinds.len()]);
        let (mut seconds, mut free) = (Vec::new(), Vec::new());
        for (j, &kind) in kinds.iter().enumerate() {
            let Distance { shift, sign, pair, other } = self.distance(j, kind);
            if shift != 0.0 {
                self.m().slice(j).add_to(shift, &mut right);
            }
            if kind == BoundKind::Fixed {
                continue;
            }
            seconds.extend(other.map(|other| (j, pair.max(other), other)));
            places[j] = Some(pairs.len());
            pairs.push((pair, false));
            rows.push((j, sign));
            free.push(kind == BoundKind::Free);
        }
        let mut q: Vec<f64> = rows.iter().map(|&(j, sign)| sign * right[j]).collect();
        let mut entries = Vec::new();
        for (place, &(j, sign)) in rows.iter().enumerate() {
            let nonzero = self.m().column(j).filter(|(_, v)| *v != 0.0);
            entries.extend(nonzero.filter_map(|(i, v)| {
                let row: usize = places[i]?;
                Some((row, place, rows[row].1 * v * sign))
            }));
        }
        for (j, row, pair) in seconds {
            let (Some(place), second) = (places[j], pairs.len()) else { continue };
            entries.extend([(place, second, 1.0), (second, place, -1.0)]);
            q.push(self.upper()[j] - self.lower()[j]);
            pairs.push((pair, true));
            rows.push((row, 1.0));
            free.push(false);
        }
        let m = Matrix::assembled(q.len(), self.m().is_sparse(), entries.into_iter());
        Ok(MixedForm { problem: self, mixed: MixedLcp::new(m, q, free)?, pairs, rows })
    }
}

impl MixedForm<'_> {
    pub(crate) fn mixed(&self) -> &MixedLcp {
        &self.mixed
    }

    /// The start for the mixed problem from a start for the problem with bounds.
    pub(crate) fn start(&self, start: &WarmStart) -> WarmStart {
        start.of_pairs(self.pairs.iter().copied())
    }

    /// The point of the general form of the problem with bounds.
    pub(crate) fn to_pairs(&self, t: &[f64], y: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let count = self.problem.pairs();
        let (mut t_all, mut y_all) = (vec![0.0; count], vec![0.0; count]);
        for (&(pair, is_exchanged), (&t, &y)) in self.pairs.iter().zip(t.iter().zip(y)) {
            (t_all[pair], y_all[pair]) = if is_exchanged { (y, t) } else { (t, y) };
        }
        let fixed = self.problem.fixed();
        if !fixed.is_empty() {
            let (z, _) = self.problem.recover(&t_all, &y_all);
            let w = self.problem.image(&z);
            for i in fixed {
                (t_all[i], y_all[i]) = ((-w[i]).max(0.0), w[i].max(0.0));
            }
        }
        (t_all, y_all)
    }

    /// A basis of the general form from one of the mixed problem.
    pub(crate) fn basis(&self, basis: &Basis, y: &[f64]) -> Basis {
        let side = |y: &f64| if *y > 0.0 { Side::Y } else { Side::T };
        let mut sides: Vec<Side> = y.iter().map(side).collect();
        for (&(pair, is_exchanged), side) in self.pairs.iter().zip(basis.sides()) {
            sides[pair] = if is_exchanged { side.complement() } else { *side };
        }
        Basis::new(sides)
    }

    /// A Farkas vector of the general form from one of the mixed problem.
    pub(crate) fn farkas(&self, pi: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.problem.pairs()];
        self.rows.iter().zip(pi).for_each(|(&(row, sign), pi)| all[row] = sign * pi);
        all
    }
}
