//! Weights of rows in units of the loads.

use super::significance::spread;
use crate::matrix::Column;
use crate::parts::Parts;
use crate::sparse::Columns;
use crate::vector::WEAK;

/// One over the loads that every row feels, in units of the row: the largest right-hand side of its
/// connected part, and of others by how weakly they are coupled to it. `loads` are the sizes of the right-hand
/// sides, `row` and `col` factors of rows and columns that bring the entries near one. A part without any load takes the
/// largest of the others; without any at all they are zero, and only the terms measure.
pub(super) fn weights(columns: &[Column<'_>], loads: &[f64], row: &[f64], col: &[f64]) -> Vec<f64> {
    let rows = loads.len();
    let coupling = |i: usize, v: f64, col: f64| (row[i] * v.abs() * col).min(1.0);
    let mut parts = Parts::new(rows);
    for (column, col) in columns.iter().zip(col) {
        if parts.is_one() {
            break;
        }
        let mut first = None;
        column.for_each(|i, v| {
            if coupling(i, v, *col) >= WEAK {
                parts.join(*first.get_or_insert(i), i);
            }
        });
    }
    // Parts and, numbered behind them, columns.
    let mut felt = vec![0.0_f64; rows + columns.len()];
    for i in 0..rows {
        let part = parts.of(i);
        felt[part] = felt[part].max(loads[i] * row[i]);
    }
    if !parts.is_one() {
        let mut links = Vec::new();
        for (j, (column, col)) in columns.iter().zip(col).enumerate() {
            // A column within one part brings no load to another.
            let from = links.len();
            let mut is_within_one = true;
            column.for_each(|i, v| {
                let (part, hub, share) = (parts.of(i), rows + j, coupling(i, v, *col));
                if share > 0.0 {
                    links.extend([(part, hub, share), (hub, part, share)]);
                    is_within_one &= links[from].0 == part;
                }
            });
            if is_within_one {
                links.truncate(from);
            }
        }
        if !links.is_empty() {
            spread(&Columns::by_rows(felt.len(), links.iter().copied()), &mut felt);
        }
    }
    felt.truncate(rows);
    let largest = felt.iter().fold(0.0_f64, |max, v| max.max(*v));
    (0..rows).map(|i| per_load(row[i], felt[parts.of(i)], largest)).collect()
}

/// One over the loads that a row feels, or over the largest if it feels none; zero if there are none at all. Beyond the
/// range of numbers it is the largest.
pub(super) fn per_load(row: f64, felt: f64, largest: f64) -> f64 {
    let felt = if felt > 0.0 { felt } else { largest };
    if felt > 0.0 { (row / felt).min(f64::MAX) } else { 0.0 }
}
