//! Misuse: errors name the place and the remedy. What the mathematics decides is a
//! [`Status`](crate::Status), not an error.

#[cfg(feature = "clarabel")]
use crate::QuadraticProgram;
use crate::{Auto, InteriorPoint, Lemke, ProjectedGaussSeidel, SemismoothNewton};

/// Why a problem or a setting was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Matrices and vectors do not fit together.
    #[error("{what} is {rows} x {cols}, but must be {expected_rows} x {expected_cols}")]
    Shape {
        /// Which datum.
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
        /// Which datum.
        what: &'static str,
        /// Row of the entry, from 0.
        row: usize,
        /// Column of the entry, from 0.
        col: usize,
        /// The entry.
        value: f64,
    },
    /// A matrix that must be symmetric and is not.
    #[error(
        "{what} must be symmetric, but {what}[{row}, {col}] is {value} and {what}[{col}, {row}] is {mirrored}"
    )]
    NotSymmetric {
        /// Which matrix.
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
    /// A variable that no value fits.
    #[error(
        "bounds of variable {index} are {lower} and {upper}: the lower one must not exceed the upper \
         one, their distance must be a finite number, and -inf or inf is for no bound"
    )]
    Bounds {
        /// The variable, from 0.
        index: usize,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
    /// A setting outside its range.
    #[error("setting `{name}` is {value}, but must be {range}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
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
    /// Something is larger than a limit in the settings.
    #[error(
        "the {what} is {value}, but `{name}` allows {limit}: raise it or take a smaller problem"
    )]
    Limit {
        /// What is too large.
        what: &'static str,
        /// Its value.
        value: usize,
        /// Name of the setting.
        name: &'static str,
        /// The limit that it sets.
        limit: usize,
    },
    /// A method that cannot treat a problem of this kind.
    #[error("{} cannot treat this problem: {reason}", full_name(.solver))]
    NotTreated {
        /// The short name of the method, as [`Solver::name`](crate::Solver::name) has it.
        solver: &'static str,
        /// What is in the way, and which method to take instead.
        reason: String,
    },
}

/// The name of a method in text for people, from its short one.
pub(crate) fn full_name(solver: &str) -> &str {
    match solver {
        Auto::NAME => "the automatic choice",
        Lemke::NAME => "Lemke's method",
        SemismoothNewton::NAME => "semismooth Newton",
        #[cfg(feature = "clarabel")]
        QuadraticProgram::NAME => "quadratic programming",
        InteriorPoint::NAME => "the interior-point method",
        ProjectedGaussSeidel::NAME => "projected Gauss-Seidel",
        other => other,
    }
}
