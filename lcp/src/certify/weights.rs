//! What a row counts in units of the loads.

use super::constants::{INTO_RANGE, ROUNDS, STRONG};
use crate::matrix::Column;
use crate::parts::Parts;
use crate::scaling::equilibrate;

/// For every row one over the loads that it feels, in units of the row: the largest right-hand side of its
/// connected part, and of others by how weakly they are coupled to it. `loads` are the sizes of the right-hand
/// sides. A part without any takes the largest of the others; without any at all they are zero, and only the terms
/// measure.
pub(super) fn weights(columns: &[Column<'_>], loads: &[f64]) -> Vec<f64> {
    let rows = loads.len();
    let (row, col) = equilibrate(rows, columns);
    weights_of(columns, loads, &row, &col)
}

/// The same with the factors of rows and columns that bring the entries near one.
pub(super) fn weights_of(
    columns: &[Column<'_>],
    loads: &[f64],
    row: &[f64],
    col: &[f64],
) -> Vec<f64> {
    let rows = loads.len();
    let mut parts = Parts::new(rows);
    let mut weakly = false;
    for (column, col) in columns.iter().zip(col) {
        if parts.is_one() {
            break;
        }
        let mut first = None;
        column.for_each(|i, v| {
            let coupling = row[i] * v.abs() * col;
            if coupling >= STRONG {
                parts.join(*first.get_or_insert(i), i);
            }
            weakly |= coupling > 0.0 && coupling < STRONG;
        });
    }
    let part: Vec<usize> = (0..rows).map(|i| parts.of(i)).collect();
    let mut felt = vec![0.0_f64; rows];
    for i in 0..rows {
        felt[part[i]] = felt[part[i]].max(loads[i] * row[i]);
    }
    for _ in 0..if weakly && !parts.is_one() { ROUNDS } else { 0 } {
        for (column, col) in columns.iter().zip(col) {
            let coupling = |i: usize, v: f64| (row[i] * v.abs() * col).min(1.0);
            let mut passed = 0.0_f64;
            column.for_each(|i, v| passed = passed.max(felt[part[i]] * coupling(i, v)));
            column.for_each(|i, v| {
                felt[part[i]] = felt[part[i]].max(passed * coupling(i, v));
            });
        }
    }
    let largest = felt.iter().fold(0.0_f64, |max, v| max.max(*v));
    (0..rows).map(|i| per_load(row[i], or_largest(felt[part[i]], largest))).collect()
}

/// Where no load is felt, what is zero at the solution is measured by the loads of other parts.
pub(super) fn or_largest(felt: f64, largest: f64) -> f64 {
    if felt > 0.0 { felt } else { largest }
}

/// One over the loads that a row feels, zero where there are none. Beyond the range of numbers it is the largest.
pub(super) fn per_load(row: f64, felt: f64) -> f64 {
    if felt > 0.0 { (row / felt).min(f64::MAX) } else { 0.0 }
}

/// Numbers whose sums do not leave the range of numbers if those of the given ones do by little.
pub(super) fn into_range(numbers: &[f64]) -> Vec<f64> {
    numbers.iter().map(|v| v * INTO_RANGE).collect()
}

/// The weights of such numbers.
pub(super) fn weights_in_range(weights: &[f64]) -> Vec<f64> {
    weights.iter().map(|weight| (weight / INTO_RANGE).min(f64::MAX)).collect()
}
