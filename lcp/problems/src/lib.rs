//! Linear complementarity problems for the crate `lcp`: in files, and from generators.
//!
//! [`families`] makes problems whose solutions are known, for tests, benchmarks and examples.
//!
//! | feature | gives |
//! |---|---|
//! | `exact` | all solutions of a small problem in rational arithmetic: the module `exact` |
//! | `io` | problems in files: the module `io` |
//! | `cli` | the command `lcp`: the module `cli` |

use lcp::Matrix;

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "exact")]
pub mod exact;
pub mod families;
#[cfg(feature = "io")]
pub mod io;

/// A sparse matrix from entries `(row, column, value)` within its size; entries at the same place are
/// added.
fn sparse(
    rows: usize,
    cols: usize,
    entries: impl IntoIterator<Item = (usize, usize, f64)>,
) -> Matrix {
    let entries: Vec<(usize, usize, f64)> = entries.into_iter().collect();
    Matrix::from_triplets(rows, cols, &entries).expect("entries inside of the matrix")
}

/// The programs of the README and of the page about files are compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
#[cfg_attr(feature = "io", doc = include_str!("../../../docs/lcp/files.md"))]
struct PagesDoctest;
