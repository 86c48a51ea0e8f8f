//! Checks of a state that use nothing of the method that found it.

use nalgebra::Vector2;
use serde::Serialize;

use crate::geometry;
use crate::model::{Anchor, Block, ContactPoint, Model, PlacedForce};
use crate::recover;
use crate::state::{ContactState, ContactStatus, State};

/// Balances and violations, dimensionless, recomputed from the contact forces and the loads.
#[derive(Debug, Clone, Serialize)]
pub struct Checks {
    /// Largest unbalanced force of a block, relative to ten times the sum of the forces on it. This counts as
    /// at least a hundredth of the largest of the total load and the largest contact force, and at most as that.
    pub force_balance: f64,
    /// Largest unbalanced moment of a block about its centroid, relative to the same sum times the
    /// block's size.
    pub moment_balance: f64,
    /// Largest part of a load that nothing carries: the unbalanced force of a block relative to the loads on
    /// that block, unless it is below 1e-9 of all forces on it; and relative to all loads. It tells a light block
    /// that hovers beside heavy ones, and forces so large that the loads are lost among their digits.
    pub uncarried: f64,
    /// Largest violation of the [law](crate::law) of a joint by a force, relative to the largest contact force.
    pub cone_violation: f64,
    /// Deepest interpenetration, relative to the largest displacement or initial gap.
    pub penetration: f64,
    /// Number of open contact points.
    pub open: usize,
    /// Number of sticking contact points.
    pub stick: usize,
    /// Number of sliding contact points.
    pub slip: usize,
}

/// Balances and violations up to this are rounding.
const LARGEST_ERROR: f64 = 1e-9;
/// Loads that nothing carries are parts of this size, and more.
const LARGEST_UNCARRIED: f64 = 1e-3;
/// Iterations converge to a part of the largest forces. So those on a single block count as so many times
/// what they are,
const SINGLE_BLOCK: f64 = 10.0;
/// and as at least this part of the largest.
const SMALLEST_PART: f64 = 0.01;

impl Checks {
    /// Whether every block balances, no friction cone is left and nothing penetrates, to
    /// 1e-9 or to the tolerance that was asked for, whichever is larger; and all loads are carried, to a
    /// thousandth or that tolerance.
    pub fn hold(&self, tolerance: f64) -> bool {
        let errors =
            [self.force_balance, self.moment_balance, self.cone_violation, self.penetration];
        errors.iter().all(|&error| error <= tolerance.max(LARGEST_ERROR))
            && self.uncarried <= tolerance.max(LARGEST_UNCARRIED)
    }

    /// Recomputes everything from the contact forces, the displacements and the loads of the model:
    /// resultants of the geometry, no matrix of the method.
    ///
    /// ```
    /// # use masonry::{Model, State, verify::checks::Checks};
    /// fn is_balanced(model: &Model, state: &State) -> bool {
    ///     let checks = Checks::of(model, state);
    ///     checks.force_balance < 1e-8 && checks.moment_balance < 1e-8
    /// }
    /// ```
    pub fn of(model: &Model, state: &State) -> Self {
        // A force is computed as what it has beyond the tensile strength, with the rounding errors of that.
        let contact_force = |(contact, s): (&ContactPoint, &ContactState)| {
            s.t_n.hypot(s.t_t).max(contact.law.tension)
        };
        let both = model.contacts.iter().zip(&state.contacts);
        let largest_contact = largest(both.map(contact_force));
        let total = total_load(model);
        let balances = unbalanced(model, state, [largest_contact, total]);
        let violation =
            |(contact, s): (&ContactPoint, &ContactState)| contact.law.violation(s.t_n, s.t_t);
        let contacts = model.contacts.iter().zip(&state.contacts);
        let both = model.contacts.iter().zip(&state.contacts);
        let depth = both.map(|(contact, s)| -gap(model, state, contact, s));
        let displacement = largest(state.displacements.iter().flatten().map(Vector2::norm))
            .max(largest(model.contacts.iter().map(|contact| contact.gap.abs())));
        let count = |status| state.contacts.iter().filter(|s| s.status == status).count();
        Self {
            force_balance: largest(balances.iter().map(|b| b.force)),
            moment_balance: largest(balances.iter().map(|b| b.moment)),
            uncarried: largest(balances.iter().map(|b| b.uncarried)),
            cone_violation: relative(largest(contacts.map(violation)), largest_contact),
            penetration: relative(largest(depth), displacement),
            open: count(ContactStatus::Open),
            stick: count(ContactStatus::Stick),
            slip: count(ContactStatus::Slip),
        }
    }
}

/// What is left over on one block, relative to the forces on it and, of the moment, to its size.
struct Unbalanced {
    force: f64,
    moment: f64,
    uncarried: f64,
}

/// Of every block, where the largest contact force and all loads are `[contact, total]` \[N\].
fn unbalanced(model: &Model, state: &State, [contact, total]: [f64; 2]) -> Vec<Unbalanced> {
    let most = contact.max(total);
    let magnitude = |forces: &[PlacedForce]| forces.iter().map(|(_, f)| f.norm()).sum::<f64>();
    let mut forces: Vec<Vec<PlacedForce>> =
        model.blocks.iter().map(|block| model.forces_on(block)).collect();
    let loads: Vec<f64> = forces.iter().map(|forces| magnitude(forces)).collect();
    let mut strength = vec![0.0; forces.len()];
    for (contact, s) in model.contacts.iter().zip(&state.contacts) {
        let normal = model.joints[contact.joint.index()].normal;
        let on_b = normal * s.t_n + Vector2::new(normal.y, -normal.x) * s.t_t;
        for (anchor, force) in [(Some(contact.b), on_b), (contact.a, -on_b)] {
            let Some(Anchor { block, edge, at }) = anchor else { continue };
            // The faces of a film feel its force in the middle between them.
            let place = match contact.film {
                Some(_) => contact.position,
                None => geometry::on_edge(&model.blocks[block.index()].corners, edge, at),
            };
            forces[block.index()].push((place, force));
            strength[block.index()] += contact.law.tension;
        }
    }
    let resultant =
        |(((block, forces), load), strength): (((&Block, &Vec<PlacedForce>), &f64), &f64)| {
            let centroid = geometry::centroid(&block.corners);
            let force: Vector2<f64> = forces.iter().map(|(_, f)| f).sum();
            let moment: f64 = forces.iter().map(|(p, f)| geometry::cross(p - centroid, *f)).sum();
            let sum = magnitude(forces) + strength;
            // A light block must not be excused by a heavy one elsewhere.
            let reference = (SINGLE_BLOCK * sum).max(SMALLEST_PART * most).min(most);
            let arm = geometry::size(&block.corners);
            let left = force.norm();
            let of_its_own = if left > LARGEST_ERROR * sum { relative(left, *load) } else { 0.0 };
            Unbalanced {
                force: relative(left, reference),
                moment: relative(moment.abs() / arm, reference),
                uncarried: of_its_own.max(relative(left, total)),
            }
        };
    model.blocks.iter().zip(&forces).zip(&loads).zip(&strength).map(resultant).collect()
}

/// Sum of the magnitudes of all loads \[N\].
fn total_load(model: &Model) -> f64 {
    model
        .blocks
        .iter()
        .flat_map(|block| model.forces_on(block))
        .map(|(_, force)| force.norm())
        .sum()
}

/// The normal gap \[m\] at a contact point, from the displacements and the compression of its film.
fn gap(model: &Model, state: &State, contact: &ContactPoint, s: &ContactState) -> f64 {
    let normal = model.joints[contact.joint.index()].normal;
    let relative = recover::relative_displacement(model, &state.displacements, contact);
    let compressed = contact.film.map_or(0.0, |film| film.compliance[0] * s.t_n);
    relative.dot(&normal) + contact.gap + compressed
}

/// The largest value, at least zero; one that is not a number counts as infinite.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |m: f64, x| if x.is_nan() { f64::INFINITY } else { m.max(x) })
}

/// Zero when there is nothing to compare with: then the value itself is zero too.
fn relative(value: f64, reference: f64) -> f64 {
    if !value.is_finite() {
        f64::INFINITY
    } else if reference > 0.0 {
        value / reference
    } else {
        0.0
    }
}
