//! Settings of limit loads.

use serde::{Deserialize, Serialize};

use super::setters::setters;
use super::{Axle, Load, Scene, fill, strict};
use crate::rounding::rounded;

/// Settings of a [limit load](crate::analysis::limit).
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LimitLoad {
    /// The load, or the group of loads, whose factor grows. By default it is the only group, or the only group with a
    /// factor.
    pub group: Option<String>,
    /// Data of the seismic check: the site, and the knowledge of the building.
    #[serde(default, deserialize_with = "strict::read")]
    pub seismic: Option<Seismic>,
    /// A train that crosses a bridge, for `masonry limit --train`.
    #[serde(default, deserialize_with = "strict::read")]
    pub train: Option<Train>,
}

/// A train of axles that crosses a bridge, whose [limit load](crate::analysis::limit::train) is computed at every
/// position.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Train {
    /// The arch, wall or block that carries the train.
    pub over: String,
    /// The axles, each by its distance from the position of the train along x \[length\] and its force \[force\].
    #[serde(deserialize_with = "strict::read")]
    pub axles: Vec<[f64; 2]>,
    /// The first position of the train along x \[length\].
    pub from: f64,
    /// The last position of the train along x \[length\].
    pub to: f64,
    /// Number of positions, at equal distances from each other.
    #[serde(default = "forty", skip_serializing_if = "is_forty")]
    pub positions: u32,
    /// Height of the top of the fill \[length\]; without it the axles stand on the highest edges below them.
    pub level: Option<f64>,
    /// Angle from the vertical at which the fill spreads the forces \[degrees\]; used only if `level` is given.
    #[serde(default = "fill::spread", skip_serializing_if = "fill::is_spread")]
    pub angle_deg: f64,
}

impl Train {
    /// Makes a train of these axles, with 40 positions between `from` and `to` \[length\].
    pub fn new(over: &str, axles: impl Into<Vec<[f64; 2]>>, [from, to]: [f64; 2]) -> Self {
        let (over, axles) = (over.to_owned(), axles.into());
        Self { over, axles, from, to, positions: 40, level: None, angle_deg: fill::spread() }
    }

    setters! {
        /// Sets the number of positions.
        pub fn positions(mut self, positions: u32) { self.positions = positions }
        /// Puts the train on a fill with its top at this level \[length\].
        pub fn level(mut self, level: f64) { self.level = Some(level) }
    }

    /// Returns the positions of the train \[length\].
    pub(crate) fn places(&self) -> impl Iterator<Item = f64> {
        let parts = f64::from(self.positions.saturating_sub(1).max(1));
        (0..self.positions).map(move |k| self.from + (self.to - self.from) * f64::from(k) / parts)
    }
}

/// The name of the group of the axles of a train.
const TRAIN: &str = "train";

/// Returns whether a name is that of the group of a train, or of one of its axles.
pub(super) fn is_of_train(name: &str) -> bool {
    let axle = name.strip_prefix(TRAIN).and_then(|it| it.strip_prefix(" axle "));
    name == TRAIN || axle.is_some_and(|number| number.parse::<u32>().is_ok())
}

impl Scene {
    /// Returns the scene with a train at a position \[length\]: the axles are loads of the group "train", which grows.
    #[must_use]
    pub fn with_train(&self, train: &Train, position: f64) -> Self {
        let axle = |(number, [offset, force]): (usize, &[f64; 2])| {
            let Train { over, level, angle_deg, .. } = train.clone();
            let axle = Axle { over, x: position + offset, force: *force, level, angle_deg };
            Load::axle(&format!("{TRAIN} axle {number}"), axle).group(TRAIN)
        };
        let mut scene = self.clone();
        scene.loads.extend((1..).zip(&train.axles).map(axle));
        scene.limit.train = None;
        let unit = self.units.length_name();
        scene.title = format!("{}, train at {} {unit}", self.title, rounded(position));
        scene.limit_group(TRAIN)
    }
}

/// Returns the default number of positions of a train. Chosen: each position costs a linear program.
fn forty() -> u32 {
    40
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
fn is_forty(positions: &u32) -> bool {
    *positions == forty()
}

impl LimitLoad {
    /// Returns whether the scene has no settings of limit loads.
    pub(super) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// Data of the [seismic check](crate::analysis::limit::SeismicCheck) of a limit load under accelerations.
///
/// ```
/// use masonry::scene::Seismic;
/// let site = Seismic::site(0.15, 1.2).behaviour(2.0).confidence(1.2);
/// assert_eq!((site.ground, site.soil), (Some(0.15), Some(1.2)));
/// assert_eq!(Seismic::default().confidence, 1.35);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct Seismic {
    /// Peak ground acceleration on rock, `a_g`, as a part of gravity \[g\]. The demand is computed only if `a_g` and
    /// `S` are given.
    #[serde(rename = "a_g")]
    pub ground: Option<f64>,
    /// Factor of soil and topography `S` \[-\]; required with `a_g`.
    #[serde(rename = "S")]
    pub soil: Option<f64>,
    /// Behaviour factor `q` \[-\].
    #[serde(rename = "q")]
    pub behaviour: f64,
    /// Confidence factor `FC` \[-\]; 1.35 by default, for the least knowledge.
    #[serde(rename = "FC")]
    pub confidence: f64,
}

/// The default is the behaviour factor of elements on the ground, and the confidence factor of the least knowledge
/// (LC1), which the Circolare requires if crushing is neglected (Circolare 7/2019, C8.7.1.2.1).
impl Default for Seismic {
    fn default() -> Self {
        Self { ground: None, soil: None, behaviour: 2.0, confidence: 1.35 }
    }
}

impl Seismic {
    /// Makes the data of a site: the peak ground acceleration as a part of gravity \[g\], and the factor of soil and
    /// topography \[-\].
    pub fn site(ground: f64, soil: f64) -> Self {
        Self { ground: Some(ground), soil: Some(soil), ..Self::default() }
    }

    setters! {
        /// Sets the behaviour factor \[-\].
        pub fn behaviour(mut self, q: f64) { self.behaviour = q }
        /// Sets the confidence factor \[-\].
        pub fn confidence(mut self, factor: f64) { self.confidence = factor }
    }
}
