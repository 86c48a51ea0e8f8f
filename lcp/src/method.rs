//! The methods by name.

use std::fmt;

/// A method of the library, with a short name in text and files.
///
/// ```
/// use lcp::Method;
/// assert_eq!(Method::GaussSeidel.to_string(), "pgs");
/// assert_eq!("newton".parse(), Ok(Method::Newton));
/// let error = "simplex".parse::<Method>().unwrap_err();
/// assert!(error.to_string().starts_with("there is no method `simplex`: take one of auto, lemke,"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
#[non_exhaustive]
pub enum Method {
    /// [`Auto`](crate::Auto): a method that suits the problem; if it fails, the next one.
    #[default]
    Auto,
    /// [`Lemke`](crate::Lemke).
    Lemke,
    /// [`SemismoothNewton`](crate::SemismoothNewton).
    Newton,
    /// [`InteriorPoint`](crate::InteriorPoint).
    Interior,
    /// `QuadraticProgram`, with the feature `clarabel`.
    #[cfg_attr(feature = "serde", serde(rename = "qp"))]
    QuadraticProgram,
    /// [`ProjectedGaussSeidel`](crate::ProjectedGaussSeidel).
    #[cfg_attr(feature = "serde", serde(rename = "pgs"))]
    GaussSeidel,
    /// The last resort of [`Auto`](crate::Auto) for small problems: all choices of sides, with proofs.
    Enumeration,
}

impl Method {
    /// All methods.
    pub const ALL: [Self; 7] = [
        Self::Auto,
        Self::Lemke,
        Self::Newton,
        Self::Interior,
        Self::QuadraticProgram,
        Self::GaussSeidel,
        Self::Enumeration,
    ];

    /// The short name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Lemke => "lemke",
            Self::Newton => "newton",
            Self::Interior => "interior",
            Self::QuadraticProgram => "qp",
            Self::GaussSeidel => "pgs",
            Self::Enumeration => "enumeration",
        }
    }

    /// The name in a sentence.
    pub fn full_name(self) -> &'static str {
        match self {
            Self::Auto => "the automatic choice",
            Self::Lemke => "Lemke's method",
            Self::Newton => "semismooth Newton",
            Self::Interior => "the interior-point method",
            Self::QuadraticProgram => "quadratic programming",
            Self::GaussSeidel => "projected Gauss-Seidel",
            Self::Enumeration => "enumeration",
        }
    }
}

/// The short name.
impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
