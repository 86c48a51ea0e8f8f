//! Weights of rows in units of the loads.

use lcp_linalg::Columns;

use super::significance::spread;
use crate::matrix::Column;
use crate::parts::Parts;
use crate::vector::WEAK;

/// The effect of loads on rows: in full on the rows of their connected part, and on others by the coupling of the
/// parts.
pub(crate) struct Couplings {
    row: Vec<f64>,
    /// The part of every row.
    part: Vec<usize>,
    /// Parts and, numbered behind them, columns, with the strength of their coupling; empty if there is one part.
    links: Columns,
}

impl Couplings {
    /// The couplings from the columns of a matrix and the factors of rows and columns that bring its entries near one.
    pub(crate) fn of(columns: &[Column<'_>], row: &[f64], col: &[f64]) -> Self {
        let rows = row.len();
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
        let mut links = Vec::new();
        if !parts.is_one() {
            for (j, (column, col)) in columns.iter().zip(col).enumerate() {
                // A column within one part transfers no load to another.
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
        }
        let count = if links.is_empty() { 0 } else { rows + columns.len() };
        let links = Columns::by_rows(count, links.iter().copied());
        let part = (0..rows).map(|i| parts.of(i)).collect();
        Self { row: row.to_vec(), part, links }
    }

    /// Calls `show` with every row and one over the loads that act on it, in units of the row: the largest right-hand
    /// side of its connected part, or of other parts times their coupling. A part without any load takes the
    /// largest of the others; without any load at all the weights are zero, and only the terms measure. `felt` is
    /// memory; nothing else is allocated if there is one part.
    pub(crate) fn weigh(
        &self,
        loads: impl Iterator<Item = f64>,
        felt: &mut Vec<f64>,
        mut show: impl FnMut(usize, f64),
    ) {
        let Self { row, part, links } = self;
        felt.clear();
        felt.resize(row.len().max(links.len()), 0.0);
        for ((load, row), &part) in loads.zip(row).zip(part) {
            felt[part] = felt[part].max(load * row);
        }
        if !links.is_empty() {
            spread(links, felt);
        }
        let largest = felt[..row.len()].iter().fold(0.0_f64, |max, v| max.max(*v));
        for (i, (row, &part)) in row.iter().zip(part).enumerate() {
            show(i, per_load(*row, felt[part], largest));
        }
    }
}

/// One over the loads that act on a row, or over the largest load if none acts on it; zero if there are no loads at
/// all. A result beyond the range of numbers is replaced by the largest number.
pub(super) fn per_load(row: f64, felt: f64, largest: f64) -> f64 {
    let felt = if felt > 0.0 { felt } else { largest };
    if felt > 0.0 { (row / felt).min(f64::MAX) } else { 0.0 }
}
