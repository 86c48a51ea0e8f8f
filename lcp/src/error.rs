//! Errors are mistakes in the input; they name the place and the remedy. A mathematical outcome is a
//! [`Status`](crate::Status), not an error.

use std::str::FromStr;

use crate::Method;

/// The reason for which a problem or a setting was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Matrices and vectors with sizes that do not agree.
    #[error("{what} is {rows} x {cols}, but must be {expected_rows} x {expected_cols}")]
    Shape {
        /// The datum.
        what: &'static str,
        /// Rows that it has.
        rows: usize,
        /// Columns that it has.
        cols: usize,
        /// Rows that it must have.
        expected_rows: usize,
        /// Columns that it must have.
        expected_cols: usize,
    },
    /// A NaN or an infinity in the data.
    #[error("{what}[{row}, {col}] is {value}: every entry must be finite")]
    NotFinite {
        /// The datum.
        what: &'static str,
        /// Row of the entry, from 0.
        row: usize,
        /// Column of the entry, from 0.
        col: usize,
        /// The entry.
        value: f64,
    },
    /// Numbers whose sum overflows.
    #[error(
        "the sizes of {what} in row {row} add up to more than the largest number: choose units in which they are \
         smaller"
    )]
    Overflow {
        /// The matrix or vector.
        what: &'static str,
        /// The row, from 0.
        row: usize,
    },
    /// An entry outside a matrix.
    #[error("entry ({row}, {col}) lies outside a matrix of {rows} x {cols}: indices begin at 0")]
    Outside {
        /// Row of the entry, from 0.
        row: usize,
        /// Column of the entry, from 0.
        col: usize,
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        cols: usize,
    },
    /// Rows of different lengths.
    #[error("row {row} has {len} entries, but row 0 has {expected}: all rows must be equally long")]
    RowLength {
        /// The row, from 0.
        row: usize,
        /// Entries that it has.
        len: usize,
        /// Entries of the first row.
        expected: usize,
    },
    /// An entry of a row of a contact point.
    #[error(
        "contact point {point} has the entry ({index}, {value}) in its {row} row: the index must be below \
         {displacements}, the number of displacements, and the value finite"
    )]
    PointEntry {
        /// The point, from 0.
        point: usize,
        /// The name of the row.
        row: &'static str,
        /// The displacement that the entry names, from 0.
        index: usize,
        /// The entry.
        value: f64,
        /// Number of displacements.
        displacements: usize,
    },
    /// A number of a contact point.
    #[error("contact point {point} has the {name} {value}, but it must be {range}")]
    PointValue {
        /// The point, from 0.
        point: usize,
        /// The name of the number.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The values that are allowed.
        range: &'static str,
    },
    /// A matrix that must be symmetric and is not.
    #[error(
        "{what} must be symmetric, but {what}[{row}, {col}] is {value} and {what}[{col}, {row}] is {mirrored}"
    )]
    NotSymmetric {
        /// The name of the matrix.
        what: &'static str,
        /// Row of the entry, from 0.
        row: usize,
        /// Column of the entry, from 0.
        col: usize,
        /// The entry.
        value: f64,
        /// The mirrored entry.
        mirrored: f64,
    },
    /// A matrix that must be positive semidefinite and is not.
    #[error("{reason}: bodies would gain energy by deforming; check the signs of its springs")]
    Indefinite {
        /// The reason.
        reason: String,
    },
    /// A variable, or a row of a program, without an admissible value.
    #[error(
        "{what} {index} is to be between {lower:?} and {upper:?}: the lower number must not exceed the upper \
         one, their distance must be finite, and -inf or inf is for no bound"
    )]
    Bounds {
        /// The kind: a row or a variable.
        what: &'static str,
        /// Its number, from 0.
        index: usize,
        /// The lower bound.
        lower: f64,
        /// The upper bound.
        upper: f64,
    },
    /// A program that is not convex.
    #[error("{reason}: methods for convex programs do not find the minimum of such a program")]
    NotConvex {
        /// The reason.
        reason: String,
    },
    /// A setting outside its range.
    #[error("setting `{name}` is {value}, but must be {range}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The values that are allowed.
        range: &'static str,
    },
    /// A vector of a setting has the wrong length.
    #[error("`{name}` has {len} entries, but must have {expected}")]
    Length {
        /// Name of the vector.
        name: &'static str,
        /// Entries that it has.
        len: usize,
        /// Entries that it must have.
        expected: usize,
    },
    /// A number above a limit in the settings.
    #[error(
        "the {what} is {value}, but `{name}` allows {limit}: raise it or take a smaller problem"
    )]
    Limit {
        /// The number that is too large.
        what: &'static str,
        /// Its value.
        value: usize,
        /// Name of the setting.
        name: &'static str,
        /// The limit that it sets.
        limit: usize,
    },
    /// A method that cannot treat a problem of this kind.
    #[error("{} cannot treat this problem: {reason}", .method.full_name())]
    NotTreated {
        /// The method.
        method: Method,
        /// The reason, and the method to use instead.
        reason: String,
    },
    /// A name that no method has.
    #[error("there is no method `{name}`: take one of {}", Method::ALL.map(Method::name).join(", "))]
    UnknownMethod {
        /// The name.
        name: String,
    },
    /// Sparse factors that cannot be planned.
    #[error("the sparse factors of {what} cannot be planned: {reason}")]
    Factors {
        /// The matrix.
        what: &'static str,
        /// The reason.
        reason: String,
    },
}

/// Parses a method from its short name.
impl FromStr for Method {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        let found = Self::ALL.into_iter().find(|method| method.name() == name);
        found.ok_or_else(|| Error::UnknownMethod { name: name.to_owned() })
    }
}
