//! Units that do not fit together, and numbers at the ends of the range.

use super::case::Case;
use super::data::{dominant, exponents, rescaled, strict};

pub const TITLE: &str = "Units and ranges";

pub fn cases() -> Vec<Case> {
    let n = 10;
    let units = "Every row and every unknown has its own unit.";
    let ranges = "Products of data overflow or underflow.";
    let rows = exponents(n, 40.0);
    let columns: Vec<f64> = rows.iter().rev().copied().collect();
    let none = vec![0.0; n];
    let all = |exponent: f64| vec![exponent; n];
    let case = |name: &str, why, parameters: &str, rows: &[f64], columns: &[f64]| {
        let power =
            |exponents: &[f64], sign: f64| exponents.iter().map(|e| (sign * e).exp2()).collect();
        let units = (power(columns, -1.0), power(rows, 1.0));
        let (problem, point) = rescaled(&dominant(n), &strict(n), (rows, columns));
        Case::new(name, why, problem).parameters(parameters).unique_in(point, 1e3, units)
    };
    vec![
        case(
            "rows from 1e-12 to 1e12",
            units,
            "P-matrix, n = 10: `m_ij = s_ij` off the diagonal, `m_ii` by one more than the rest of its row in magnitude; rows times powers of two in a mixed order",
            &rows,
            &none,
        ),
        case(
            "unknowns from 1e-12 to 1e12",
            units,
            "the same matrix, columns times these powers",
            &none,
            &rows,
        ),
        case(
            "rows and unknowns from 1e-12 to 1e12",
            units,
            "the same matrix, rows and columns: entries from 1e-24 to 1e24",
            &rows,
            &columns,
        ),
        case(
            "data of 1e150",
            ranges,
            "the same matrix, `M` and `q` times 2^498",
            &all(498.0),
            &none,
        ),
        case("data of 1e-150", ranges, "`M` and `q` times 2^-498", &all(-498.0), &none),
        case("unknowns of 1e150", ranges, "`q` times 2^498", &all(498.0), &all(-498.0)),
        case("unknowns of 1e-150", ranges, "`q` times 2^-498", &all(-498.0), &all(498.0)),
        case(
            "unknowns of 1e300",
            ranges,
            "`M` times 2^-498, `q` times 2^498",
            &all(498.0),
            &all(-996.0),
        ),
        case(
            "data below the normal numbers",
            ranges,
            "`M` and `q` times 2^-1060, about 1e-319",
            &all(-1060.0),
            &none,
        ),
    ]
}
