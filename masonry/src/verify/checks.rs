//! Checks of states: errors in equilibrium and in the laws of the joints, from displacements, forces and data only. The
//! checks do not depend on the method that found the state: they use only matrices of single elements, no rows and no
//! residuals. Gaps and slips are formed anew from the displacements by `recover`.
//!
//! # Scales of errors
//! A force is relative to the sum of the sizes of all forces on the same block: loads, contact forces, and the tensile
//! strengths of its points, since contact forces are computed relative to these. So a heavy neighbour does not excuse a
//! light block. A length is relative to the displacements of the blocks that meet, and to initial gaps and slips and
//! compressions of joints at their points. If one of the blocks is rigid, the length is relative to the largest length
//! of all, since a rigid block has no displacement scale of its own.
//!
//! Rounding errors limit force and length errors. Blocks that touch share forces and displacements, and an equation of
//! them is known up to the rounding errors of its largest term: `eps` times the number of terms times
//!
//! * for a force on a block, the largest sum of forces on it or on a block that it touches, and for an elastic block
//!   also stiffness times displacement at one of its nodes;
//! * for a length, the largest of all.
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

/// Balances and violations, dimensionless. Their scales are described [above](self).
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Checks {
    /// Largest unbalanced force of a block, relative to the forces on it.
    pub force_balance: f64,
    /// Largest unbalanced moment of a block about its centroid, divided by the block's size, relative to the
    /// same forces.
    pub moment_balance: f64,
    /// Largest part of a load that is not carried: the unbalanced force of a block relative to the loads on that block,
    /// unless it is below 1e-9 of all forces on it; and relative to all loads. It detects a light block whose forces
    /// are lost among the digits of its neighbours, and forces so large that the loads are lost among their digits.
    pub uncarried: f64,
    /// Largest unbalanced force at a node of an elastic block, between its elements, loads and contact forces; relative
    /// to the largest of these forces at the nodes, or to the forces on the block spread over all nodes if that is
    /// more.
    pub nodal_balance: f64,
    /// Largest violation of the [law](crate::law) of a joint by a force, relative to the forces on the lighter of the
    /// blocks that meet. If friction `mu` is above one, the bound has `mu` times the error of the normal force, so that
    /// the violation is divided by `mu`.
    pub cone_violation: f64,
    /// Deepest interpenetration, relative to the lengths of the blocks that meet.
    pub penetration: f64,
    /// Forces across gaps, and tangential forces off the bound at points that slide in the step. The measure is the smaller of
    /// the gap or slip (as a length) and the error of the force.
    pub complementarity: f64,
    /// The error of `f.u + t.y = 2 U + t.x`: work of the loads and of forces on gaps and slips, strain energy, work on
    /// initial gaps and slips; plus the work of friction if it is positive. Relative to the sum of the sizes of all
    /// terms.
    pub energy: f64,
    /// Largest change of the shape of a rigid block, relative to its displacements.
    pub deformation: f64,
    /// The smallest relative change of loads, stiffness and contact forces for which the forces at all nodes are in
    /// equilibrium; for rigid blocks, of loads and contact forces. The value is not an error by itself.
    pub backward: f64,
    /// Ratio of the forces on the block with the largest to those on the block with the smallest forces; not an error
    /// by itself.
    pub spread: f64,
    /// Number of open contact points.
    pub open: usize,
    /// Number of sticking contact points.
    pub stick: usize,
    /// Number of sliding contact points.
    pub slip: usize,
}

/// The least tolerance, and the largest value of an error within rounding: a well posed problem is solved to some
/// digits more, and an ill posed one need not be.
const LARGEST_ERROR: f64 = 1e-9;
/// The least part of the loads that counts as not carried.
const LARGEST_UNCARRIED: f64 = 1e-3;

impl Checks {
    /// Whether a state is an equilibrium: every error is at most the tolerance, or 1e-9 if that is larger; and all
    /// loads are carried, to a thousandth or the tolerance.
    ///
    /// The limit of a thousandth has to be weaker. If the forces on blocks exceed the loads by a factor near the
    /// reciprocal of the rounding error, these rounding errors hide how much of a small load is carried.
    pub fn hold(&self, tolerance: f64) -> bool {
        self.excess(tolerance) <= 1.0 && self.uncarried <= tolerance.max(LARGEST_UNCARRIED)
    }

    /// The largest error, relative to the limit of [`hold`](Self::hold).
    pub(crate) fn excess(&self, tolerance: f64) -> f64 {
        self.worst() / tolerance.max(LARGEST_ERROR)
    }

    /// The largest error.
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

    /// Checks a state of the model, which has the slips at the start of the step ([`Model::under`]).
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

/// The larger number; NaN counts as larger than all.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// The relative error of a part of a whole, at most [`LARGEST_ERROR`] if the part is within rounding.
fn known(part: f64, whole: f64, rounding: f64) -> f64 {
    let error = relative(part, whole);
    if part <= rounding { error.min(LARGEST_ERROR) } else { error }
}

/// A part divided by the whole: zero if the part is not positive, infinite if either is not a number or the whole is zero.
fn relative(part: f64, whole: f64) -> f64 {
    if part <= 0.0 {
        0.0
    } else if part.is_finite() && whole.is_finite() {
        part / whole
    } else {
        f64::INFINITY
    }
}
