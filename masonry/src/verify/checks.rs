//! Checks of states: errors in equilibrium and in the laws of the joints, from displacements, forces and data only.
//! The checks do not depend on the method that found the state: they use matrices of single elements, but no rows and
//! no residuals of the problem. `recover` computes gaps and slips again from the displacements.
//!
//! # Scales of errors
//! A force is divided by the sum of the sizes of all forces on the same block: loads, contact forces, and the tensile
//! strengths of its points, since contact forces are computed relative to these strengths. So a heavy neighbour does
//! not hide an error on a light block. A length is divided by the largest length of the blocks that meet:
//! displacements, and initial gaps and slips and compressions of joints at their points. If one of the blocks is
//! rigid, the length is divided by the largest length of all blocks, since a rigid block has no displacement scale of
//! its own.
//!
//! Rounding errors limit the accuracy of force and length errors. Blocks that touch share forces and displacements,
//! and their equations hold only up to the rounding errors of the largest term: `eps` times the number of terms times
//!
//! * for a force on a block, the largest sum of forces on the block or on a block that it touches, and for an elastic
//!   block also the largest product of stiffness and displacement at one of its nodes;
//! * for a length, the largest length of all blocks.
//!
//! An error that is not larger than these rounding errors counts as 1e-9 at most, since it cannot be reduced. It can
//! hide an error on a light block only if another block is about 1e13 times as heavy; [`Checks::uncarried`] detects
//! that case.
//!
//! | module | content |
//! |---|---|
//! | `bodies` | forces on blocks |
//! | `elements` | forces at nodes |
//! | `lengths` | displacements of blocks |
//! | `contact` | gaps, slips and forces of points against the law |
//! | `energy` | work, and its storage and dissipation; shapes of rigid blocks |

use serde::Serialize;

use crate::data::state::{PointStatus, State};
use crate::model::Model;

mod bodies;
mod contact;
mod elements;
mod energy;
mod lengths;

use bodies::Bodies;
use contact::Pair;
use lengths::Lengths;

/// Errors of equilibrium and of the contact law of a state \[-\], relative to the scales described [above](self); and
/// numbers of contact points by status.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Checks {
    /// Largest unbalanced force of a block, relative to the sum of the sizes of all forces on it.
    pub force_balance: f64,
    /// Largest unbalanced moment of a block about its centroid, divided by the size of the block, relative to the
    /// forces on it.
    pub moment_balance: f64,
    /// Largest part of a load that is not carried \[-\]: the larger of two ratios. One is the unbalanced force of a
    /// block divided by the loads on the block, zero if the force is below 1e-9 of all forces on the block; the other
    /// is the unbalanced force divided by all loads. The value detects a light block whose loads are smaller than the
    /// rounding errors of its neighbours' forces, and forces whose rounding errors exceed the loads.
    pub uncarried: f64,
    /// Largest unbalanced force at a node of an elastic block, from its elements, loads and contact forces. It is
    /// divided by the largest sum of loads and contact forces at a node, or by the forces on the block spread over all
    /// nodes if that is more.
    pub nodal_balance: f64,
    /// Largest violation of the [law](crate::law) of a joint by a force, relative to the forces on the lighter of the
    /// blocks that meet. A violation of the bound of friction is divided by `mu` if `mu` is above one, since the bound
    /// has `mu` times the error of the normal force.
    pub cone_violation: f64,
    /// Deepest interpenetration, relative to the lengths of the blocks that meet.
    pub penetration: f64,
    /// Largest violation of complementarity: a force across an open gap, or a tangential force off the bound at a
    /// point that slides in the step. The measure is the smaller of two errors: the gap or slip, as a relative length,
    /// and the relative error of the force.
    pub complementarity: f64,
    /// The error of the energy balance `f.u + t.y = 2 U + t.x`, plus the work of friction if it is positive, relative
    /// to the sum of the sizes of all terms. The terms are the work of loads and of forces on gaps and slips, the
    /// strain energy `U`, and the work on initial gaps and slips.
    pub energy: f64,
    /// Largest change of the shape of a rigid block, relative to its largest displacement.
    pub deformation: f64,
    /// Backward error \[-\]: the smallest relative change of loads, stiffness and contact forces (for rigid blocks, of
    /// loads and contact forces) for which the forces at all nodes are in equilibrium. The value does not count as an
    /// error.
    pub backward: f64,
    /// Ratio of the largest to the smallest sum of forces on a block \[-\]. The value does not count as an error.
    pub spread: f64,
    /// Number of open contact points.
    pub open: usize,
    /// Number of sticking contact points.
    pub stick: usize,
    /// Number of sliding contact points.
    pub slip: usize,
}

/// Lower bound of the tolerance, and upper bound of an error that is within rounding \[-\]. A well posed problem is
/// solved to some digits more; the accuracy of an ill posed one is limited.
const LARGEST_ERROR: f64 = 1e-9;
/// Lower bound of the tolerance for the part of the loads that is not carried \[-\].
const LARGEST_UNCARRIED: f64 = 1e-3;

impl Checks {
    /// Returns whether the state is an equilibrium: every error is at most the tolerance, or 1e-9 if that is larger,
    /// and the part of the loads that is not carried is at most a thousandth, or the tolerance if that is larger.
    ///
    /// The bound of a thousandth has to be weaker than that of the errors: if the forces on blocks exceed the loads by
    /// a factor near the reciprocal of the rounding error, their rounding errors hide how much of a small load is
    /// carried.
    pub fn hold(&self, tolerance: f64) -> bool {
        self.excess(tolerance) <= 1.0 && self.uncarried <= tolerance.max(LARGEST_UNCARRIED)
    }

    /// Returns the largest error divided by its limit in [`hold`](Self::hold).
    pub(crate) fn excess(&self, tolerance: f64) -> f64 {
        self.worst() / tolerance.max(LARGEST_ERROR)
    }

    /// Returns the largest error; [`uncarried`](Self::uncarried), [`backward`](Self::backward) and
    /// [`spread`](Self::spread) are not included.
    pub fn worst(&self) -> f64 {
        let errors = [
            self.force_balance,
            self.moment_balance,
            self.nodal_balance,
            self.cone_violation,
            self.penetration,
            self.complementarity,
            self.energy,
            self.deformation,
        ];
        errors.into_iter().fold(0.0, larger)
    }

    /// Checks a state of the model, whose initial slips are those at the start of the step ([`Model::under`]).
    ///
    /// ```
    /// # use masonry::{Model, State, verify::checks::Checks};
    /// fn is_balanced(model: &Model, state: &State) -> bool {
    ///     let checks = Checks::of(model, state);
    ///     checks.force_balance < 1e-8 && checks.moment_balance < 1e-8
    /// }
    /// ```
    pub fn of(model: &Model, state: &State) -> Self {
        let nodes = elements::nodes(model, state);
        let bodies = Bodies::of(model, state, &nodes);
        let lengths = Lengths::of(model, state, &nodes, &bodies);
        let contacts = model.contacts.iter().zip(&state.contacts);
        let pairs: Vec<Pair> =
            contacts.map(|(contact, it)| Pair::of(model, state, contact, it)).collect();
        let of_pairs = |error: &dyn Fn(&Pair) -> f64| pairs.iter().map(error).fold(0.0, larger);
        let of_bodies = bodies.sizes().zip(bodies.roundings());
        let elastic = nodes.iter().zip(of_bodies);
        let at_nodes =
            elastic.filter_map(|(it, (size, around))| Some(it.as_ref()?.error(size, around)));
        let backward = nodes.iter().flatten().map(elements::NodeForces::backward);
        let (force_balance, moment_balance) = (bodies.force_balance(), bodies.moment_balance());
        let count = |status| state.contacts.iter().filter(|s| s.status == status).count();
        Self {
            force_balance,
            moment_balance,
            uncarried: bodies.uncarried(LARGEST_ERROR),
            nodal_balance: at_nodes.fold(0.0, larger),
            cone_violation: of_pairs(&|pair| pair.outside_cone(&bodies)),
            penetration: of_pairs(&|pair| pair.inside(&lengths)),
            complementarity: of_pairs(&|pair| pair.against_law(&bodies, &lengths)),
            energy: energy::error(model, state, &pairs),
            deformation: energy::deformation(model, state),
            backward: backward.fold(larger(force_balance, moment_balance), larger),
            spread: bodies.spread(),
            open: count(PointStatus::Open),
            stick: count(PointStatus::Stick),
            slip: count(PointStatus::Slip),
        }
    }
}

/// Returns the larger of two numbers; NaN counts as infinite.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// Returns `part / whole` as a relative error; at most [`LARGEST_ERROR`] if `part` is within the rounding error.
fn known(part: f64, whole: f64, rounding: f64) -> f64 {
    let error = relative(part, whole);
    if part <= rounding { error.min(LARGEST_ERROR) } else { error }
}

/// Returns `part / whole`: zero if `part` is not positive, infinite if one of the numbers is not finite.
fn relative(part: f64, whole: f64) -> f64 {
    if part <= 0.0 {
        0.0
    } else if part.is_finite() && whole.is_finite() {
        part / whole
    } else {
        f64::INFINITY
    }
}
