//! A problem as integers: rows and columns multiplied by powers of two.

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

/// `A`, `B` and `c` with row `i` multiplied by `2^row_exponents[i]` and every column by its own power
/// of two.
#[derive(Debug)]
pub(super) struct Integers {
    /// Rows, with the columns in the order of [`Variable::all`] and `c` at the end.
    pub(super) rows: Vec<Vec<IBig>>,
    row_exponents: Vec<i64>,
    column_exponents: Vec<i64>,
}

impl Integers {
    pub(super) fn new(problem: &HorizontalLcp) -> Self {
        let n = problem.order();
        let row = |i: usize| {
            let entries = Variable::all(n).map(|Variable { pair, side }| match side {
                Side::T => problem.a()[(i, pair)],
                Side::Y => problem.b()[(i, pair)],
            });
            entries.chain([problem.c()[i]]).map(Binary::new).collect()
        };
        let binary: Vec<Vec<Binary>> = (0..n).map(row).collect();
        let (row_exponents, column_exponents) = exponents(&binary, 2 * n + 1);
        let scale = |(row, r): (&Vec<Binary>, &i64)| {
            let scaled = row.iter().zip(&column_exponents).map(|(v, c)| v.times_power(r + c));
            scaled.collect()
        };
        let rows = binary.iter().zip(&row_exponents).map(scale).collect();
        Self { rows, row_exponents, column_exponents }
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

    /// The value in the problem's units of a variable that is `numerator / denominator` in those of
    /// the integers.
    pub(super) fn value(&self, variable: Variable, numerator: &IBig, denominator: &IBig) -> RBig {
        let exponent = self.column_exponents[variable.index()] - self.right_hand_exponent();
        let ratio = RBig::from_parts_signed(numerator.clone(), denominator.clone());
        times_power(ratio, exponent)
    }

    /// The same for a direction, in which `c` has no part.
    pub(super) fn direction(&self, variable: Variable, value: &IBig) -> RBig {
        times_power(RBig::from(value.clone()), self.column_exponents[variable.index()])
    }

    /// The multiplier of a row of the problem from that of a row of integers.
    pub(super) fn multiplier(&self, row: usize, value: &RBig) -> RBig {
        times_power(value.clone(), self.row_exponents[row])
    }

    /// A point or direction from its nonzero variables.
    pub(super) fn point(&self, values: impl IntoIterator<Item = (Variable, RBig)>) -> ExactPoint {
        let n = self.row_exponents.len();
        let mut point = ExactPoint { t: vec![RBig::ZERO; n], y: vec![RBig::ZERO; n] };
        for (Variable { pair, side }, value) in values {
            match side {
                Side::T => point.t[pair] = value,
                Side::Y => point.y[pair] = value,
            }
        }
        point
    }

    fn right_hand_exponent(&self) -> i64 {
        self.column_exponents.last().copied().unwrap_or(0)
    }
}

/// A floating-point number as `mantissa 2^exponent` with an odd mantissa, or zero.
#[derive(Debug, Clone, Copy)]
struct Binary {
    mantissa: i64,
    exponent: i64,
}

impl Binary {
    fn new(value: f64) -> Self {
        const FRACTION: u32 = f64::MANTISSA_DIGITS - 1;
        if value == 0.0 {
            return Self { mantissa: 0, exponent: 0 };
        }
        let bits = value.to_bits();
        let fraction = bits & ((1 << FRACTION) - 1);
        let biased = (bits >> FRACTION) & 0x7ff;
        let magnitude = if biased == 0 { fraction } else { fraction | (1 << FRACTION) };
        let zeros = magnitude.trailing_zeros();
        let odd = (magnitude >> zeros).cast_signed();
        let exponent = biased.max(1).cast_signed() - 1075 + i64::from(zeros);
        Self { mantissa: if value < 0.0 { -odd } else { odd }, exponent }
    }

    fn times_power(self, exponent: i64) -> IBig {
        let shift = usize::try_from(self.exponent + exponent).unwrap_or(0);
        IBig::from(self.mantissa) << shift
    }
}

/// Exponents of rows and columns such that all entries become integers and every column, after the
/// rows, has an odd one.
fn exponents(rows: &[Vec<Binary>], columns: usize) -> (Vec<i64>, Vec<i64>) {
    let entries = || {
        let all = rows
            .iter()
            .enumerate()
            .flat_map(|(i, row)| row.iter().enumerate().map(move |e| (i, e)));
        all.filter(|(_, (_, v))| v.mantissa != 0).map(|(i, (j, v))| (i, j, v.exponent))
    };
    let (mut row, mut column) = (vec![0; rows.len()], vec![0; columns]);
    // Twice: the second round takes from the rows what the columns gave.
    for _ in 0..2 {
        let mut least = vec![None; row.len()];
        entries().for_each(|(i, j, e)| keep_least(&mut least[i], e + column[j]));
        row = least.into_iter().map(|e| -e.unwrap_or(0)).collect();
        let mut least = vec![None; columns];
        entries().for_each(|(i, j, e)| keep_least(&mut least[j], e + row[i]));
        column = least.into_iter().map(|e| -e.unwrap_or(0)).collect();
    }
    (row, column)
}

fn keep_least(least: &mut Option<i64>, value: i64) {
    *least = Some(least.map_or(value, |least| least.min(value)));
}

fn times_power(value: RBig, exponent: i64) -> RBig {
    let power = UBig::ONE << usize::try_from(exponent.unsigned_abs()).unwrap_or(0);
    if exponent < 0 { value / power } else { value * power }
}
