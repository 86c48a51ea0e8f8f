//! Linear complementarity problems: contact with friction, obstacles, games, quadratic programs.
//!
//! # A contact problem
//!
//! A body of weight 2 stands on a plane (`mu = 0.5`), is pushed along it by 1.4, and has a spring of stiffness 3
//! behind it. Friction holds 1 of the push, and the spring the rest:
//!
//! ```
//! use lcp::{Auto, Contact2d, ContactPoint, Solver};
//!
//! let (x, y) = (0, 1); // the displacements: along the plane, away from it
//! let mut builder = Contact2d::builder([[3.0, 0.0], [0.0, 0.0]], vec![1.4, -2.0]);
//! let foot = builder.add_point(ContactPoint {
//!     normal: &[(y, 1.0)],
//!     tangent: &[(x, 1.0)],
//!     mu: 0.5,
//!     ..Default::default()
//! });
//! let contact = builder.build()?;
//! let solution = Auto::default().solve(&contact)?;
//! assert!(solution.is_solved());
//! let state = contact.variables(&solution);
//! assert!((state.t_n[foot] - 2.0).abs() < 1e-12 && (state.t_t[foot] + 1.0).abs() < 1e-12);
//! assert!((3.0 * state.u[x] - 0.4).abs() < 1e-12);
//! # Ok::<(), lcp::Error>(())
//! ```
//!
//! # A time step
//!
//! The unknowns are velocities and the forces are impulses if the mass matrix takes the place of the stiffness. A point
//! may at most close its gap within a step `h`: `gap / h + v_n >= 0`. A block falls on the floor and slides until it
//! stops:
//!
//! ```
//! use lcp::{Auto, Contact2d, ContactPoint, Solver};
//!
//! let (mass, gravity, mu, h) = (2.0, 9.81, 0.3, 0.01);
//! let (mut position, mut velocity) = ([0.0, 0.05], [1.0, 0.0]);
//! for _ in 0..100 {
//!     // M v_new = M v_old + h f + impulses
//!     let momentum = vec![mass * velocity[0], mass * (velocity[1] - h * gravity)];
//!     let mut builder = Contact2d::builder([[mass, 0.0], [0.0, mass]], momentum);
//!     builder.add_point(ContactPoint {
//!         normal: &[(1, 1.0)],
//!         tangent: &[(0, 1.0)],
//!         gap: position[1] / h,
//!         mu,
//!         ..Default::default()
//!     });
//!     let step = builder.build()?;
//!     let state = step.variables(&Auto::default().solve(&step)?);
//!     for i in 0..2 {
//!         velocity[i] = state.u[i];
//!         position[i] += h * velocity[i];
//!     }
//! }
//! assert!(velocity.iter().all(|v| v.abs() < 1e-9) && position[1].abs() < 1e-9);
//! # Ok::<(), lcp::Error>(())
//! ```
//!
//! # Problems
//!
//! All problems are converted to the general (horizontal) form, in which both matrices may be singular:
//!
//! ```text
//! A t + B y = c,   t >= 0,   y >= 0,   t . y = 0
//! ```
//!
//! | type | problem | `problem.variables(&solution)` |
//! |---|---|---|
//! | [`Contact2d`] | plane contact with friction, sparse, with all displacements or velocities | [`ContactState`]: displacements, forces, gaps, slips |
//! | [`Friction2d`] | the same reduced to the contacts | [`ContactForces`] |
//! | [`Lcp`] | `w = M z + q`, `z >= 0`, `w >= 0`, `z . w = 0` | `(z, w)` |
//! | [`MixedLcp`] | the same with free variables | `(z, w)` |
//! | [`BoxedLcp`] | the same with bounds, `lower <= z <= upper` | `(z, w)` |
//! | [`Qp`] | convex quadratic programs; their [conditions](Qp::mixed) are solved | [`QpPoint`]: variables, multipliers, objective |
//! | [`HorizontalLcp`] | the general form | `t` and `y` of the solution |
//!
//! Matrices and vectors are made from arrays, rows, triplets, those of `faer` and, with the feature `nalgebra`, of
//! `nalgebra`: see [`Matrix`] and [`Vector`].
//!
//! # Methods
//!
//! Each method has its own settings. [`Solver`] is implemented for the problems that a method treats.
//!
//! | type | method | for |
//! |---|---|---|
//! | [`Auto`] | chooses a method by class and size, and tries the next one if it fails | all |
//! | [`Lemke`] | Lemke's method (complementary pivoting) | all; proves infeasibility |
//! | [`SemismoothNewton`] | active sets | obstacle problems, M- and P-matrices |
//! | `QuadraticProgram` | convex programs; a sequence of them with friction (feature `clarabel`, on by default) | symmetric positive semidefinite matrices, contact, soft constraints |
//! | [`Evolution`] | implicit steps in time, with velocities and energies | load histories, moving supports; bodies with mass that slide, fall, settle or flow |
//! | [`InteriorPoint`] | interior-point method on the sparse form | large contact problems, mixed problems |
//! | [`ProjectedGaussSeidel`] | projected Gauss-Seidel, also on rows without a matrix ([`pgs::Rows`]) | large easy problems, rough solutions |
//! | [`lemke::Parametric`] | the solutions along a line of right-hand sides | all |
//! | [`Sequence`] | one problem after the other, from the states and in the memory of the one before | steps of simulations, dense |
//!
//! # Solutions
//!
//! A [`Solution`] has the point, its [`Status`], its [`Residuals`] from the original data, its complementary [`Basis`]
//! if the method has one, and the cost ([`Info`]). If there is no solution, it has the proof. Any point or basis is a
//! [`WarmStart`] for any method that can use it. [`Lcp::error_bound`] bounds the distance of a point of a monotone
//! problem from the solution, and [`refine`] computes states of contacts in double-double arithmetic.
//! [`Solution::into_result`] returns an error for every status except `Solved`, and [`Solver::solve_all`] solves many
//! problems on all cores.
//!
//! A status is a mathematical outcome; an [`Error`] is a mistake in the input. The status is
//! [`Status::Solved`] only after the residuals were computed from the given data. All tolerances are relative to that
//! data, so units do not matter. The library does not print.
//!
//! # Features
//!
//! | feature | gives |
//! |---|---|
//! | `clarabel` (default) | `QuadraticProgram` |
//! | `nalgebra` | problems from matrices of `nalgebra` |
//! | `serde` | problems, settings and results that can be written and read back |
//!
//! The crate `lcp-problems` reads problems from files, makes problems whose solutions are known, finds all solutions of
//! small ones in rational arithmetic, and has the command `lcp`. The guides `docs/lcp.md` and `docs/methods.md` of the
//! repository describe the methods and their use.

mod active;
mod auto;
mod basis;
mod certify;
mod conversion;
mod definite;
mod divide;
mod enumerate;
mod error;
mod evolution;
mod extended;
mod interior;
#[cfg(feature = "serde")]
mod json_numbers;
pub mod lemke;
mod matrix;
mod method;
mod newton;
mod nonnegative;
mod parallel;
mod parts;
pub mod pgs;
mod pivoting;
mod problem;
#[cfg(feature = "clarabel")]
pub mod qp;
mod random;
pub mod refine;
mod scaling;
mod sequence;
mod settings;
mod solution;
mod solve;
mod states;
mod status;
mod variables;
mod vector;

pub use faer;

pub use auto::{Auto, AutoSettings, Choice, Enumeration};
pub use basis::{Basis, Side};
pub use certify::{Certificate, Leaf, Ray, Residuals};
pub use error::Error;
pub use evolution::{Account, Ending, Evolution, EvolutionSettings};
pub use interior::{InteriorPoint, InteriorPointSettings, LeastForces};
#[doc(inline)]
pub use lemke::Lemke;
pub use matrix::Matrix;
pub use method::Method;
pub use newton::{SemismoothNewton, SemismoothNewtonSettings};
#[doc(inline)]
pub use pgs::{ProjectedGaussSeidel, ProjectedGaussSeidelSettings};
#[cfg(feature = "serde")]
#[doc(hidden)]
pub use problem::Stored;
pub use problem::{
    Bedding, BoxedLcp, Contact2d, Contact2dBuilder, ContactForces, ContactPoint, ContactState,
    ErrorBound, Friction2d, HorizontalLcp, Lcp, MixedLcp, Monotonicity, Qp, QpPoint, StandardForm,
};
#[cfg(feature = "clarabel")]
#[doc(inline)]
pub use qp::{QuadraticProgram, QuadraticProgramSettings};
#[doc(hidden)]
pub use random::SplitMix;
pub use sequence::Sequence;
pub use settings::{Covering, LemkeSettings, WarmStart};
pub use solution::{Info, MethodRun, RunEnd, Solution, Unsolved};
pub use solve::{Iteration, Named, Observer, Solver, Step, StepKind};
pub use status::Status;
pub use vector::Vector;

/// The programs of the README are compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctest;

/// The programs of the guide are compiled and run likewise, page by page.
#[cfg(all(doctest, feature = "clarabel"))]
mod guide {
    #[doc = include_str!("../../docs/lcp/problems.md")]
    struct Problems;

    #[doc = include_str!("../../docs/lcp/solving.md")]
    struct Solving;

    #[doc = include_str!("../../docs/lcp/settings.md")]
    struct Settings;

    #[doc = include_str!("../../docs/lcp/certificates.md")]
    struct Certificates;

    #[doc = include_str!("../../docs/methods/evolution.md")]
    struct Evolution;

    #[doc = include_str!("../../docs/lcp/paths_and_exact_solutions.md")]
    struct PathsAndExactSolutions;
}
