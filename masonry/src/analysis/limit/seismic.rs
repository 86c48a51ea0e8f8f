//! The seismic check of a limit load under accelerations, by linear kinematic analysis.
//!
//! The mechanism of the limit gives every weight `P_i` a virtual displacement `d_i` along the acceleration. The
//! formulas of Circolare 7/2019, C8.7.1.2.1, for the mechanism as a system of one degree of freedom are
//!
//! ```text
//! M* = (sum P d)^2 / (g sum P d^2),   e* = g M* / sum P,   a_0* = alpha_0 g / (e* FC)  >=  a_g S / q,
//! ```
//!
//! `alpha_0` is the component of the acceleration perpendicular to gravity at the limit, divided by gravity; `d` is
//! along this component. Sums are over the weights of the blocks that [move](crate::verify::moving), each at its
//! centroid, and over loads with a mass on these blocks, each at its place. A weight that does not move has no part in
//! the mechanism, and would only make `e*` smaller.
//!
//! Several mechanisms may belong to one limit: any bed joint may slide if all slide at the same factor. No `e*` is
//! above one, so that `a_0* >= alpha_0 g / FC` for all mechanisms.

use nalgebra::{Point2, Vector2};

use super::{Answer, Associative, Limit, LoadedStructure, Path};
use crate::geometry::SAME_PLACE;
use crate::model::{Cause, Model, PlacedBlock, PlacedForce};
use crate::scene::{LoadKind, Scene, Seismic};
use crate::system::rigid::Modes;
use crate::verify::moving::moving;

/// The seismic check of a limit load by linear kinematic analysis (Circolare 7/2019, C8.7.1.2.1).
///
/// The data are in `[limit.seismic]` of the scene, and the formulas in docs/reference/limit.md.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SeismicCheck {
    /// Whether load factor and mechanism are those of the path with Coulomb's law, instead of those of associated flow.
    pub is_of_path: bool,
    /// The component of the acceleration perpendicular to gravity at the limit, divided by gravity: `alpha_0` \[-\].
    pub multiplier: f64,
    /// The sum of the weights that move in the mechanism, `sum P` \[N\].
    pub weight: f64,
    /// The participating mass `M*` \[kg\].
    pub mass: f64,
    /// The fraction of participating mass `e*` \[-\].
    pub fraction: f64,
    /// The spectral acceleration that activates the mechanism, `a_0*` \[m/s^2\].
    pub capacity: f64,
    /// The least `a_0*` \[m/s^2\] that any mechanism of the same limit can have: the value for `e* = 1`.
    pub least_capacity: f64,
    /// The spectral acceleration of the site, `a_g S / q` \[m/s^2\]; `None` if the scene does not have its data.
    pub demand: Option<f64>,
    /// The acceleration of gravity \[m/s^2\].
    pub gravity: f64,
    /// The data `[limit.seismic]` of the scene, or their defaults.
    pub data: Seismic,
}

impl SeismicCheck {
    /// Returns `true` if all mechanisms of the limit meet the demand, and `false` if the mechanism that was found does
    /// not. Returns `None` if that mechanism meets the demand but others may not, or if there is no demand.
    pub fn is_satisfied(&self) -> Option<bool> {
        let demand = self.demand?;
        if self.least_capacity >= demand {
            Some(true)
        } else if self.capacity < demand {
            Some(false)
        } else {
            None
        }
    }
}

impl Limit {
    /// Whether the seismic check of this limit load is worse than that of `other`. The results of the checks are
    /// compared first; if they are equal, this `a_0*`, computed with the least factor that is not carried, with the
    /// other `a_0*`.
    pub fn has_worse_check(&self, other: &Self) -> bool {
        let rank = |it: &SeismicCheck| match it.is_satisfied() {
            Some(false) => 0,
            None => 1,
            Some(true) => 2,
        };
        match (&self.seismic, &other.seismic) {
            (Some(own), Some(others)) => {
                let most = own.capacity * (self.not_carried() / self.carried());
                rank(own) < rank(others) || (rank(own) == rank(others) && most < others.capacity)
            }
            (Some(own), None) => own.is_satisfied() == Some(false),
            (None, _) => false,
        }
    }

    /// Adds a warning if another direction or combination, `other`, has a worse seismic check than this limit load,
    /// which governs.
    pub fn compare_check(&mut self, name: &str, other: &Self) {
        if other.has_worse_check(self) {
            self.warnings.push(format!(
                "The factor is the smallest, but the seismic check is not the worst: that of {name} is worse."
            ));
        }
    }
}

/// Computes the check by the law of [`carried`](super::Limit::carried), or returns the reason why there is no check.
pub(super) fn of(
    scene: &Scene,
    structure: &LoadedStructure<'_>,
    associative: Option<&Associative>,
    path: Option<&Path>,
) -> Result<SeismicCheck, &'static str> {
    let model = structure.model;
    let gravity = model.gravity.norm();
    if gravity <= 0.0 {
        return Err("the scene has no gravity");
    }
    if !is_of_accelerations(scene, structure.grows) {
        return Err(
            "the growing group has other loads than accelerations; a weight that an earthquake moves is a load with \
             `mass` in another group",
        );
    }
    let pushed = structure.under(0.0, 1.0).accelerations;
    let push: Vector2<f64> = pushed.iter().map(|it| it.value).sum();
    let down = model.gravity / gravity;
    let across = push - down * push.dot(&down);
    if across.norm() <= SAME_PLACE * push.norm() {
        return Err("the acceleration has no component across gravity");
    }
    let (factor, rates) = match (path, associative) {
        (Some(path), _) => of_path(path)?,
        (None, Some(found)) => of_flow(found)?,
        (None, None) => return Err(UNDECIDED),
    };
    let along = across.normalize();
    let (mut weight, mut work, mut square) = (0.0, 0.0, 0.0);
    for ((block, rates), _) in
        model.blocks.iter().zip(rates).zip(moving(rates)).filter(|(_, moves)| *moves)
    {
        let modes = Modes::of(&block.corners);
        let amplitudes = modes.amplitudes(&block.corners, rates);
        for (place, load) in weights_on(model, block) {
            let displacement = modes.displacement(place, &amplitudes).dot(&along);
            weight += load;
            work += load * displacement;
            square += load * displacement * displacement;
        }
    }
    if work == 0.0 {
        return Err("no weight moves across gravity in the mechanism");
    }
    let fraction = work * work / (square * weight);
    let data = scene.limit.seismic.unwrap_or_default();
    let multiplier = factor * across.norm() / gravity;
    let least_capacity = multiplier * gravity / data.confidence;
    let site = data.ground.zip(data.soil);
    Ok(SeismicCheck {
        is_of_path: path.is_some(),
        multiplier,
        weight,
        mass: fraction * weight / gravity,
        fraction,
        capacity: least_capacity / fraction,
        least_capacity,
        demand: site.map(|(ground, soil)| ground * gravity * soil / data.behaviour),
        gravity,
        data,
    })
}

const UNDECIDED: &str = "the limit is undecided";
const FALLS: &str = "the structure falls without the growing loads";
const UNLIMITED: &str = "there is no limit";

/// A load factor, and the displacement rates of the corners of every block in its mechanism.
type Found<'a> = (f64, &'a [Vec<Vector2<f64>>]);

fn of_path(path: &Path) -> Result<Found<'_>, &'static str> {
    if !path.decided {
        return Err(UNDECIDED);
    }
    let factor = path.load_factor.ok_or(FALLS)?;
    let without = if path.falls.is_some() { "the path has no mechanism" } else { UNLIMITED };
    Ok((factor, path.mechanism.as_ref().ok_or(without)?))
}

fn of_flow(found: &Associative) -> Result<Found<'_>, &'static str> {
    match (found.answer, found.load_factor, &found.mechanism) {
        (Answer::Falls, ..) => Err(FALLS),
        (Answer::Unlimited, ..) => Err(UNLIMITED),
        (Answer::Fails, Some(factor), Some(rates)) if found.proved => Ok((factor, rates)),
        _ => Err(UNDECIDED),
    }
}

fn is_of_accelerations(scene: &Scene, grows: &[bool]) -> bool {
    let mut growing = scene.loads.iter().zip(grows).filter(|(_, grows)| **grows).peekable();
    growing.peek().is_some()
        && growing.all(|(load, _)| matches!(load.kind(), Some(LoadKind::Acceleration(_))))
}

/// Lists the weights \[N\] on a block with their places: the weight of the block, and those of loads with a mass.
fn weights_on(model: &Model, block: &PlacedBlock) -> Vec<(Point2<f64>, f64)> {
    let down = model.gravity.normalize();
    let part = |cause: Cause| match cause {
        Cause::Weight => 1.0,
        Cause::Load(load) => model.loads[load.index()].mass.unwrap_or(0.0),
    };
    let weight = |(cause, it): (Cause, PlacedForce)| (it.at, part(cause) * it.force.dot(&down));
    model.causes_on(block).into_iter().map(weight).filter(|(_, weight)| *weight > 0.0).collect()
}
