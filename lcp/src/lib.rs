//! Linear complementarity problems in the general (horizontal) form
//!
//! ```text
//! A t + B y = c,   t >= 0,   y >= 0,   t . y = 0.
//! ```
//!
//! Frictional contact, games, obstacle problems and quadratic programs lead here. Both matrices
//! may be singular; the standard form `w = M z + q` is the special case `A = -M`, `B = 1`.
//!
//! Problems:
//!
//! * [`HorizontalLcp`] is the general form; [`Lcp`], [`MixedLcp`] (with free variables) and [`BoxedLcp`]
//!   (with bounds) convert into it and back. Matrices are dense or sparse ([`Matrix`]).
//! * [`Contact2d`] is contact with friction in the plane with sparse matrices and the displacements as
//!   unknowns, [`Friction2d`] the same reduced to the contacts.
//!
//! Methods, each with settings of its own. [`Solver`] is implemented for the problems that a method treats:
//!
//! * [`Auto`] chooses one by class and size, says why, and goes on with another where that fails.
//! * [`Lemke`]: complementary pivoting. Treats everything, proves infeasibility; the one to start with.
//! * [`SemismoothNewton`]: active sets, for obstacle problems, M- and P-matrices, and for contact.
//! * `QuadraticProgram` (feature `clarabel`, on by default): symmetric positive semidefinite problems and contact, with friction
//!   as a sequence of programs; soft constraints.
//! * [`InteriorPoint`]: large sparse contact problems with friction, and mixed problems.
//! * [`ProjectedGaussSeidel`]: sweeps, also over rows without a matrix ([`Rows`]).
//! * [`Parametric`]: the solutions along a line of right-hand sides.
//!
//! Answers:
//!
//! * [`Solution`] carries the point, its [`Status`], its complementary [`Basis`] where the method has one,
//!   its [`Residuals`] from the original data, and what it cost ([`Info`]); where there is no solution,
//!   the proof, or the evidence ([`SoftSprings`]). Any point or basis is a [`WarmStart`] for any method
//!   that can use it.
//! * [`Lcp::error_bound`] says how far a point of a monotone problem is from the solution.
//!
//! ```
//! use faer::mat;
//! use lcp::{Lcp, Lemke, Solver, Status};
//!
//! let lcp = Lcp::new(mat![[2.0, 1.0], [1.0, 2.0]], vec![-5.0, -6.0])?;
//! let solution = Lemke::default().solve(&lcp)?;
//! assert_eq!(solution.status, Status::Solved);
//! assert!(solution.residuals.worst() < 1e-14);
//! # Ok::<(), lcp::Error>(())
//! ```
//!
//! The guides `docs/lcp.md` and `docs/methods.md` of the repository say which method to take when, and how
//! each works.
//!
//! With the feature `io` problems are read from files, and with `cli` there is the program `lcp`.
//! With `exact` all solutions of a small problem are found in rational arithmetic. The module
//! [`families`] makes problems whose answers are known.
//!
//! A status says what the mathematics decided; an [`Error`] says that the input was unusable. A
//! solver says [`Status::Solved`] only after the residuals were computed from the data that it was
//! given, and all tolerances are relative to that data: units do not matter. The library does not
//! print.

mod active;
mod auto;
mod basis;
mod certify;
#[cfg(feature = "cli")]
pub mod cli;
#[allow(dead_code)] // until the chain of methods begins with it
mod divide;
#[allow(dead_code)] // until the chain of methods ends with it
mod enumerate;
mod error;
#[cfg(feature = "exact")]
pub mod exact;
mod extended;
pub mod families;
mod interior;
#[cfg(feature = "io")]
pub mod io;
pub mod lemke;
mod linear;
mod lower;
mod matrix;
mod method;
mod newton;
mod nonnegative;
mod parts;
pub mod pgs;
mod pivoting;
mod problem;
#[cfg(feature = "clarabel")]
pub mod qp;
mod random;
pub mod refine;
mod scaling;
mod settings;
mod solution;
mod solve;
mod sparse;

pub use faer;

pub use auto::{Auto, AutoSettings, Choice};
pub use basis::{Basis, Side};
pub use certify::Residuals;
pub use error::Error;
pub use interior::{InteriorPoint, InteriorPointSettings};
#[doc(inline)]
pub use lemke::Lemke;
pub use matrix::Matrix;
pub use method::Method;
pub use newton::{SemismoothNewton, SemismoothNewtonSettings};
#[doc(inline)]
pub use pgs::{ProjectedGaussSeidel, ProjectedGaussSeidelSettings};
pub use problem::{
    Bedding, BoxedLcp, Contact2d, ContactForces, ContactState, ErrorBound, Friction2d,
    HorizontalLcp, Lcp, MixedLcp, Monotonicity, StandardForm,
};
#[cfg(feature = "clarabel")]
#[doc(inline)]
pub use qp::{QuadraticProgram, QuadraticProgramSettings};
pub use settings::{Covering, LemkeSettings, WarmStart};
pub use solution::{Info, Ray, Route, RouteEnd, SoftSprings, Solution, Status};
pub use solve::{Iteration, Observer, Solver};

/// The programs of the README are compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctest;

/// See [`ReadmeDoctest`].
#[cfg(all(doctest, feature = "clarabel", feature = "exact", feature = "io"))]
#[doc = include_str!("../../docs/lcp.md")]
struct GuideDoctest;
