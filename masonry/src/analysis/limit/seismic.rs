//! The seismic check of a limit load under accelerations, by linear kinematic analysis.
//!
//! The mechanism of the limit gives every weight `P_i` a virtual displacement `d_i` along the acceleration. By Circolare
//! 7/2019, C8.7.1.2.1, with the mechanism as a system of one degree of freedom,
//!
//! ```text
//! M* = (sum P d)^2 / (g sum P d^2),   e* = g M* / sum P,   a_0* = alpha_0 g / (e* FC)  >=  a_g S / q,
//! ```
//!
//! and `alpha_0` is the acceleration at the limit over gravity. Sums are over the weights of the blocks that
//! [move](crate::verify::moving), each in its centroid, and over loads with a mass on these blocks, each in its place. A weight
//! at rest has no part in the mechanism, and would only make `e*` smaller.

use nalgebra::{Point2, Vector2};

use super::{Associative, LoadedStructure, Path};
use crate::model::{Cause, Model, PlacedBlock, PlacedForce};
use crate::scene::{LoadKind, Scene, Seismic};
use crate::system::rigid::Modes;
use crate::verify::moving::moving;

/// The seismic check of a limit load by linear kinematic analysis (Circolare 7/2019, C8.7.1.2.1).
///
/// The scene has its data as `[limit.seismic]`; the reference on limit loads has its formulas.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SeismicCheck {
    /// Whether factor and mechanism are those of the path with Coulomb's law; else they are those of associated flow.
    pub is_of_path: bool,
    /// The acceleration at the limit over gravity, `alpha_0` \[-\].
    pub multiplier: f64,
    /// The sum of the weights that move, `sum P` \[N\].
    pub weight: f64,
    /// The participating mass `M*` \[kg\].
    pub mass: f64,
    /// The fraction of participating mass `e*` \[-\].
    pub fraction: f64,
    /// The spectral acceleration that activates the mechanism, `a_0*` \[m/s^2\].
    pub capacity: f64,
    /// The spectral acceleration of the site, `a_g S / q` \[m/s^2\], if the scene has its data.
    pub demand: Option<f64>,
    /// Gravity \[m/s^2\].
    pub gravity: f64,
    /// The data of the scene, or their defaults.
    pub data: Seismic,
}

impl SeismicCheck {
    /// Whether the capacity is at least the demand, if there is one.
    pub fn is_satisfied(&self) -> Option<bool> {
        self.demand.map(|demand| self.capacity >= demand)
    }
}

/// Why a scene with data for the check has none: it has no gravity, or something else than accelerations grows.
pub(super) fn warning(scene: &Scene, group: &str) -> Option<String> {
    let is_left_out = scene.limit.seismic.is_some() && !is_of_accelerations(scene, group);
    is_left_out.then(|| {
        if has_gravity(scene) {
            format!(
                "The seismic check is left out: \"{group}\" has other loads than accelerations. A weight that an \
                 earthquake moves is a load with `mass`."
            )
        } else {
            "The seismic check is left out: the scene has no gravity.".to_owned()
        }
    })
}

fn has_gravity(scene: &Scene) -> bool {
    scene.gravity.is_some_and(|it| it.iter().any(|it| it.abs() > 0.0))
}

fn is_of_accelerations(scene: &Scene, group: &str) -> bool {
    let mut members = scene.loads.iter().filter(|load| load.is_called(group)).peekable();
    has_gravity(scene)
        && members.peek().is_some()
        && members.all(|load| matches!(load.kind(), Some(LoadKind::Acceleration(_))))
}

/// The check by the law that [carries](super::Limit::carried), if its limit is known and it has a mechanism.
pub(super) fn of(
    scene: &Scene,
    group: &str,
    structure: &LoadedStructure<'_>,
    associative: Option<&Associative>,
    path: Option<&Path>,
) -> Option<SeismicCheck> {
    if !is_of_accelerations(scene, group) {
        return None;
    }
    let (factor, rates) = match (path, associative) {
        (Some(path), _) if path.decided => (path.load_factor?, path.mechanism.as_ref()?),
        (None, Some(found)) if found.proved => (found.load_factor?, found.mechanism.as_ref()?),
        _ => return None,
    };
    let pushed = structure.under(0.0, 1.0).accelerations;
    let push: Vector2<f64> = pushed.iter().map(|it| it.value).sum();
    let along = push.try_normalize(0.0)?;
    let model = structure.model;
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
    if square <= 0.0 {
        return None;
    }
    let gravity = model.gravity.norm();
    let data = scene.limit.seismic.unwrap_or_default();
    let fraction = work * work / (square * weight);
    let multiplier = factor * push.norm() / gravity;
    let site = data.ground.zip(data.soil);
    Some(SeismicCheck {
        is_of_path: path.is_some(),
        multiplier,
        weight,
        mass: fraction * weight / gravity,
        fraction,
        capacity: multiplier * gravity / (fraction * data.confidence),
        demand: site.map(|(ground, soil)| ground * gravity * soil / data.behaviour),
        gravity,
        data,
    })
}

/// The weights \[N\] on a block and their places: its own, and those of loads with a mass.
fn weights_on(model: &Model, block: &PlacedBlock) -> Vec<(Point2<f64>, f64)> {
    let down = model.gravity.normalize();
    let part = |cause: Cause| match cause {
        Cause::Weight => 1.0,
        Cause::Load(load) => model.loads[load.index()].mass.unwrap_or(0.0),
    };
    let weight = |(cause, it): (Cause, PlacedForce)| (it.at, part(cause) * it.force.dot(&down));
    model.causes_on(block).into_iter().map(weight).filter(|(_, weight)| *weight > 0.0).collect()
}
