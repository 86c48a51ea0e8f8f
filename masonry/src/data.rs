//! Plain data that modules pass to one another; these types need no other module of the crate, except the numbers of
//! parts (`ids`).
//!
//! | module | content |
//! |---|---|
//! | [`route`] | the routes to a solution |
//! | [`info`] | records of a solve: work, routes and times |
//! | [`state`] | displacements, contact forces, stresses, reactions |
//! | [`statics`] | admissible forces, or the proof that there are no such forces |
//! | [`motion`] | motions of a structure that has no equilibrium |
//! | [`verdict`] | whether a wall stands, with the evidence |
//!
//! The functions that make these data are in the modules of their methods: [`Proof::of`](statics::Proof::of) is in
//! [`method::statics`](crate::method::statics), [`Principal::of`](state::Principal::of) in
//! [`recover`](crate::recover).

mod attempt;
pub mod info;
pub mod motion;
pub mod route;
pub mod state;
pub mod statics;
pub mod verdict;
