//! The judge of states: what one misses of equilibrium and of the laws of its joints, from displacements, forces and
//! data alone. Nothing of the method that found it is used: no matrix but those of single elements, no row, no residual.
//!
//! # What errors are compared with
//! A force is compared with the sum of the sizes of all on the same block: loads, contact forces, and the tensile
//! strengths of its points, beyond which forces are computed. So a light block is not excused by a heavy one beside it.
//! A length is compared with the displacements of the blocks that meet, and with gaps and slips at first and compressions of
//! films at their points; where one of them is rigid, with the largest of all, since a rigid block has no length of its own.
//!
//! Both end where the digits do. Blocks that touch share forces and displacements, and an equation of them is
//! known to the rounding errors of its largest term: `eps` times the number of terms times
//!
//! * of a force on a block, the largest sum of forces on it or on a block that it touches, and of an
//!   elastic one, stiffness times displacement at a node of its own;
//! * of a length, the largest of all.
//!
//! An error that is no more than this counts as 1e-9 at most, since no digits are left to do better. It can hide that a
//! block is light only where another one is about 1e13 times as heavy, and then [`Checks::uncarried`] tells.
//!
//! | module | content |
//! |---|---|
//! | `bodies` | forces on blocks |
//! | `elements` | forces at nodes |
//! | `lengths` | displacements of blocks |
//! | `contact` | gaps, slips and forces of points against the law |
//! | `energy` | work and what becomes of it; shapes of rigid blocks |

use serde::Serialize;

use crate::model::Model;
use crate::state::{ContactStatus, State};

mod bodies;
mod contact;
mod elements;
mod energy;
mod kinematics;
mod lengths;

use bodies::Bodies;
use contact::Pair;
use lengths::Lengths;

/// Balances and violations, dimensionless. What each is relative to is said [above](self).
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Checks {
    /// Largest unbalanced force of a block, relative to the forces on it.
    pub force_balance: f64,
    /// Largest unbalanced moment of a block about its centroid, divided by the block's size, relative to the
    /// same forces.
    pub moment_balance: f64,
    /// Largest part of a load that nothing carries: the unbalanced force of a block relative to the loads on
    /// that block, unless it is below 1e-9 of all forces on it; and relative to all loads. It tells a light block
    /// whose forces are lost among the digits of those around it, and forces so large that the loads are lost
    /// among their digits.
    pub uncarried: f64,
    /// Largest force left over at a node of an elastic block, where its elements meet loads and contact forces;
    /// relative to the largest of these at its nodes, or the forces on the block spread over all of them if that is more.
    pub nodal_balance: f64,
    /// Largest violation of the [law](crate::law) of a joint by a force, relative to the forces on the lighter of the
    /// blocks that meet. Where friction `mu` is above one its bound has the errors of the normal force `mu` times:
    /// it counts one `mu`-th.
    pub cone_violation: f64,
    /// Deepest interpenetration, relative to the lengths of the blocks that meet.
    pub penetration: f64,
    /// Forces where there should be none: across a gap, or, where a point slides in the step, other than the bound
    /// against it. The smaller one of the gap or slip, as a length, and of the force that is too much or lacks.
    pub complementarity: f64,
    /// What is missing in `f.u + t.y = 2 U + t.x`: work of the loads and of forces on gaps and slips, strain energy,
    /// work on initial gaps and slips. And the work of friction where it is positive. Relative to the sum of the sizes of all.
    pub energy: f64,
    /// Largest change of the shape of a rigid block, relative to its displacements.
    pub deformation: f64,
    /// The smallest change of loads, stiffness and contact forces, relative to them, with which the forces at
    /// all nodes are in equilibrium; of rigid blocks that of loads and contact forces. No error by itself.
    pub backward: f64,
    /// Forces on the block with the most relative to those on the one with the least. No error either.
    pub spread: f64,
    /// Number of open contact points.
    pub open: usize,
    /// Number of sticking contact points.
    pub stick: usize,
    /// Number of sliding contact points.
    pub slip: usize,
}

/// The least tolerance, and what rounding errors count as at most: a well posed problem is solved to some digits more, and an ill posed
/// one need not be.
const LARGEST_ERROR: f64 = 1e-9;
/// Loads that nothing carries are parts of this size, and more.
const LARGEST_UNCARRIED: f64 = 1e-3;

impl Checks {
    /// Whether a state is an equilibrium: every error at most the tolerance that was asked for, or 1e-9 if that is larger;
    /// and all loads carried, to a thousandth or that tolerance.
    ///
    /// A thousandth is weaker, and has to be: where blocks differ by more than the digits of a number, or forces exceed the
    /// loads by that, a load cannot be told from rounding errors any better.
    pub fn hold(&self, tolerance: f64) -> bool {
        self.worst() <= tolerance.max(LARGEST_ERROR)
            && self.uncarried <= tolerance.max(LARGEST_UNCARRIED)
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

    /// Of a state of the model, which has the slips that the step started from ([`Model::under`]).
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
        let lengths = Lengths::of(model, state, (&nodes, &bodies));
        let contacts = model.contacts.iter().zip(&state.contacts);
        let pairs: Vec<Pair> = contacts.map(|both| Pair::of(model, state, both)).collect();
        let of_pairs = |error: &dyn Fn(&Pair) -> f64| pairs.iter().map(error).fold(0.0, larger);
        let of_bodies = bodies.sizes().zip(bodies.roundings());
        let elastic = nodes.iter().zip(of_bodies);
        let at_nodes =
            elastic.filter_map(|(it, (size, around))| Some(it.as_ref()?.error(size, around)));
        let backward = nodes.iter().flatten().map(elements::Nodes::backward);
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
            open: count(ContactStatus::Open),
            stick: count(ContactStatus::Stick),
            slip: count(ContactStatus::Slip),
        }
    }
}

/// The larger one; what is no number is larger than all.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// A part of a whole that is known to a rounding error.
fn known(part: f64, whole: f64, rounding: f64) -> f64 {
    let error = relative(part, whole);
    if part <= rounding { error.min(LARGEST_ERROR) } else { error }
}

/// A part of a whole, zero where it is not positive; infinite where one of them is no number, or there is no whole.
fn relative(part: f64, whole: f64) -> f64 {
    if part <= 0.0 {
        0.0
    } else if part.is_finite() && whole.is_finite() {
        part / whole
    } else {
        f64::INFINITY
    }
}
