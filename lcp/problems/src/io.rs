//! Problems in files.
//!
//! [`read_file`] and [`read`] return the problem and its format. The format is recognised by the content, or named by
//! the caller. A file that fits two formats or none, or that contains more than its problem, is refused.
//!
//! # JSON
//! One object with a `kind` and the fields of that kind, all of them and no others:
//!
//! | `kind` | fields | problem |
//! |---|---|---|
//! | `"lcp"` | `m`, `q` | [`Lcp`] |
//! | `"horizontal"` | `a`, `b`, `c` | [`HorizontalLcp`] |
//! | `"mixed"` | `m`, `q`, `free` (booleans) | [`MixedLcp`] |
//! | `"boxed"` | `m`, `q`, `lower`, `upper` (`null`: no bound) | [`BoxedLcp`] |
//! | `"friction"` | `w`, `q`, `mu` | [`Friction2d`] |
//! | `"contact"` | `k`, `f`, `c_n`, `c_t`, `x_0`, `s_0`, `mu`, and `compliance` if there is any | [`Contact2d`] |
//! | `"qp"` | `p`, `q`, `a`, `l`, `u` (`null`: no bound), and `lower`, `upper`, `constant` if there are any | [`Qp`] |
//!
//! A matrix is an array of its rows, or `{"rows": 2, "cols": 2, "triplets": [[0, 1, 2.5]]}` with indices from 0;
//! values at the same place are added. [`to_json`] writes this form, with all digits.
//!
//! # Plain text
//! `n`, then the `n x n` numbers of `M` by rows, then the `n` numbers of `q`, separated by white
//! space; `#` begins a comment. The problem is an [`Lcp`].
//!
//! # QPS
//! Convex quadratic programs, in free or fixed format: the sections `NAME`, `OBJSENSE` (`MIN`), `ROWS`, `COLUMNS`, `RHS`,
//! `RANGES`, `BOUNDS`, and `QUADOBJ` or `QSECTION` (one triangle of `P`) or `QMATRIX` (all its entries). The objective has
//! minus its right-hand side as constant. Lines of `RHS`, `RANGES` and `BOUNDS` may leave out the name of the set.
//! Bounds from 1e20 on count as infinite. A negative `UP` without `LO` frees its variable below; `BV` is between 0 and
//! 1, integer or not.
//!
//! # Siconos
//! The `.dat` files of that library for linear complementarity problems, mixed ones, relays (variables between bounds,
//! `inf` for no bound: the problem is a [`BoxedLcp`]), and plane contact with friction, reduced to the contacts
//! (`FrictionContactProblem`) or with the velocities of the bodies (`GlobalFrictionContactProblem`, `M v = q + H r`,
//! `u = H^T v + b`: the problem is a [`Contact2d`] of velocities and impulses); dense, in sparse blocks, or sparse.
//! Text may follow the last number, except for contact problems.
//!
//! # Matrix Market
//! [`market`] reads the matrices and vectors of a problem one by one.

mod error;
mod format;
mod json;
pub mod market;
mod problem;
mod qps;
mod siconos;
mod text;
mod tokens;

use std::path::Path;

#[cfg(doc)]
use lcp::{BoxedLcp, Contact2d, Friction2d, HorizontalLcp, Lcp, MixedLcp, Qp};

pub use error::{Position, ReadError};
pub use format::ProblemFormat;
pub use json::to_json;
pub use problem::Problem;
#[cfg(feature = "cli")]
pub(crate) use problem::{each, pairs_of_forces};

impl ProblemFormat {
    fn parse(self, text: &str) -> Result<Problem, ReadError> {
        match self {
            Self::Json => json::read(text),
            Self::Text => text::read(text),
            Self::Qps => qps::read(text),
            Self::SiconosLcp => siconos::read_lcp(text),
            Self::SiconosMlcp => siconos::read_mlcp(text),
            Self::SiconosRelay => siconos::read_relay(text),
            Self::SiconosFriction => siconos::read_friction(text),
            Self::SiconosGlobalFriction => siconos::read_global(text),
        }
    }
}

/// A problem, and the format that it was read from.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ProblemFile {
    /// The format.
    pub format: ProblemFormat,
    /// The problem.
    pub problem: Problem,
}

/// Reads a file. A name that ends in `.json`, `.qps` or `.mps` names the format, like `format` does.
///
/// # Errors
/// [`ReadError`], with the place in the file.
pub fn read_file(path: &Path, format: Option<ProblemFormat>) -> Result<ProblemFile, ReadError> {
    let ending = path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
    let named = match ending.as_deref().and_then(|ending| ending.to_str()) {
        Some("json") => Some(ProblemFormat::Json),
        Some("qps" | "mps") => Some(ProblemFormat::Qps),
        _ => None,
    };
    let bytes = std::fs::read(path)
        .map_err(|error| ReadError::File { path: path.to_owned(), reason: error.to_string() })?;
    read(&bytes, format.or(named))
}

/// Reads the content of a file, in the given format or in the one that the content fits.
///
/// Allocations are in proportion to the content, whatever sizes its header announces.
///
/// ```
/// use lcp_problems::io::{ProblemFormat, read};
/// let file = read(b"2   2 1  1 2   -5 -6  # n, M by rows, q", None)?;
/// assert_eq!(file.format, ProblemFormat::Text);
/// assert_eq!(file.problem.order(), 2);
/// # Ok::<(), lcp_problems::io::ReadError>(())
/// ```
///
/// # Errors
/// [`ReadError`], with the place in the content.
pub fn read(content: &[u8], format: Option<ProblemFormat>) -> Result<ProblemFile, ReadError> {
    let text = String::from_utf8_lossy(content);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    if format.is_none() && text.starts_with(market::BANNER) {
        return Err(ReadError::OneMatrix);
    }
    let is_json = text.trim_start().starts_with('{');
    match format.or(is_json.then_some(ProblemFormat::Json)) {
        Some(format) => Ok(ProblemFile { format, problem: format.parse(text)? }),
        None => read_by_content(text),
    }
}

/// Reads the content in the one format that fits, or fails with the error of the format that came furthest.
fn read_by_content(text: &str) -> Result<ProblemFile, ReadError> {
    let mut fits: Vec<ProblemFile> = Vec::new();
    let mut failure: Option<(ProblemFormat, ReadError)> = None;
    for format in ProblemFormat::ALL.into_iter().filter(|&format| format != ProblemFormat::Json) {
        match format.parse(text) {
            Ok(problem) => fits.push(ProblemFile { format, problem }),
            Err(error) => {
                let best = failure.as_ref().map(|(_, error)| error.reach());
                if best.is_none_or(|best| error.reach() > best) {
                    failure = Some((format, error));
                }
            }
        }
    }
    match (fits.pop(), failure) {
        (Some(file), _) if fits.is_empty() => Ok(file),
        (None, Some((format, source))) => {
            Err(ReadError::Unrecognised { format, source: Box::new(source) })
        }
        (last, _) => {
            let formats = fits.into_iter().chain(last).map(|file| file.format).collect();
            Err(ReadError::Ambiguous { formats })
        }
    }
}
