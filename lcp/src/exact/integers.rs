//! A problem as integers: rows multiplied by powers of two.

use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

use super::ExactPoint;
use crate::{HorizontalLcp, Side};

/// A variable of the problem: pair and side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Variable {
    pub(super) pair: usize,
    pub(super) side: Side,
}

impl Variable {
    /// All variables of `n` pairs, `t` before `y` in each.
    pub(super) fn all(n: usize) -> impl Iterator<Item = Self> {
        (0..n).flat_map(|pair| [Side::T, Side::Y].map(|side| Self { pair, side }))
    }

    /// Position among [`all`](Self::all).
    pub(super) fn index(self) -> usize {
        2 * self.pair + usize::from(self.side == Side::Y)
    }
}

/// `A`, `B` and `c` with every row multiplied by a power of two.
#[derive(Debug)]
pub(super) struct Integers {
    /// Rows, with the columns in the order of [`Variable::all`] and `c` at the end.
    pub(super) rows: Vec<Vec<IBig>>,
    /// What the rows of the problem were multiplied by.
    pub(super) factors: Vec<UBig>,
}

impl Integers {
    pub(super) fn new(problem: &HorizontalLcp) -> Self {
        let n = problem.order();
        let row = |i: usize| {
            let entries = Variable::all(n).map(|Variable { pair, side }| match side {
                Side::T => problem.a()[(i, pair)],
                Side::Y => problem.b()[(i, pair)],
            });
            let entries: Vec<RBig> = entries.chain([problem.c()[i]]).map(exact).collect();
            // The largest power of two is a multiple of the others.
            let factor = entries.iter().map(RBig::denominator).max().cloned().unwrap_or(UBig::ONE);
            let integer = |v: &RBig| v.numerator() * (&factor / v.denominator());
            (entries.iter().map(integer).collect(), factor)
        };
        let (rows, factors) = (0..n).map(row).unzip();
        Self { rows, factors }
    }

    /// The row `columns | c` of a system in some of the variables only.
    pub(super) fn system(&self, variables: &[Variable]) -> Vec<Vec<IBig>> {
        let rows = self.rows.iter();
        rows.map(|row| {
            let columns = variables.iter().map(|v| row[v.index()].clone());
            columns.chain(row.last().cloned()).collect()
        })
        .collect()
    }
}

impl ExactPoint {
    /// A point or direction of `n` pairs from integers over a common denominator; other variables are zero.
    pub(super) fn new(
        n: usize,
        values: impl IntoIterator<Item = (Variable, IBig)>,
        denominator: &IBig,
    ) -> Self {
        let mut point = Self { t: vec![RBig::ZERO; n], y: vec![RBig::ZERO; n] };
        for (Variable { pair, side }, numerator) in values {
            let value = RBig::from_parts_signed(numerator, denominator.clone());
            match side {
                Side::T => point.t[pair] = value,
                Side::Y => point.y[pair] = value,
            }
        }
        point
    }
}

fn exact(value: f64) -> RBig {
    RBig::try_from(value).unwrap_or_else(|e| unreachable!("data are finite: {e:?}"))
}
