//! A problem as integers: rows multiplied by powers of two.

use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

use super::ExactPoint;
use lcp::{HorizontalLcp, Side};

/// The number of a variable: `t` before `y` in every pair.
pub(super) fn number(pair: usize, side: Side) -> usize {
    2 * pair + side.of(0, 1)
}

/// `A`, `B` and `c` with every row multiplied by a power of two.
#[derive(Debug)]
pub(super) struct Integers {
    /// Rows, with the columns in the order of [`number`] and `c` at the end.
    pub(super) rows: Vec<Vec<IBig>>,
    /// The factors of the rows.
    pub(super) factors: Vec<UBig>,
}

impl Integers {
    pub(super) fn new(problem: &HorizontalLcp) -> Self {
        let n = problem.order();
        let row = |i: usize| {
            let entries = (0..n).flat_map(|j| [problem.a()[(i, j)], problem.b()[(i, j)]]);
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
    pub(super) fn system(&self, variables: &[usize]) -> Vec<Vec<IBig>> {
        let rows = self.rows.iter();
        rows.map(|row| {
            let columns = variables.iter().map(|&v| row[v].clone());
            columns.chain(row.last().cloned()).collect()
        })
        .collect()
    }
}

impl ExactPoint {
    /// A point or direction of `n` pairs from integers over a common denominator; other variables are zero.
    pub(super) fn new(
        n: usize,
        values: impl IntoIterator<Item = (usize, IBig)>,
        denominator: &IBig,
    ) -> Self {
        let mut point = Self { t: vec![RBig::ZERO; n], y: vec![RBig::ZERO; n] };
        for (variable, numerator) in values {
            let side = if variable.is_multiple_of(2) { &mut point.t } else { &mut point.y };
            side[variable / 2] = RBig::from_parts_signed(numerator, denominator.clone());
        }
        point
    }
}

fn exact(value: f64) -> RBig {
    RBig::try_from(value).unwrap_or_else(|e| unreachable!("data are finite: {e:?}"))
}
