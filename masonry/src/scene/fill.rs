//! Fill over an arch, a wall or a block, and axles on it.

use serde::{Deserialize, Serialize};

/// Fill over an arch, a wall or a block: a vertical load on the edges below the fill.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Fill {
    /// The arch, wall or block that carries the fill.
    pub over: String,
    /// Height of the level top of the fill \[length\].
    pub level: f64,
    /// The weight of the fill per volume \[force/length^3\].
    pub gamma: f64,
}

/// An axle, on the level top of a fill, through which its force spreads, or on the top edge of a block.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Axle {
    /// The arch, wall or block that carries the axle.
    pub over: String,
    /// The coordinate x of the axle \[length\].
    pub x: f64,
    /// The downward force of the axle over the whole thickness \[force\].
    pub force: f64,
    /// Height of the top of the fill \[length\]. If no level is given, the axle stands on the highest edge below it.
    pub level: Option<f64>,
    /// Angle from the vertical at which the fill spreads the force \[degrees\]; used only if `level` is given.
    #[serde(default = "spread", skip_serializing_if = "is_spread")]
    pub angle_deg: f64,
}

impl Axle {
    /// Makes an axle at `x` \[length\] on the top edge of the body `over`, with its force \[force\].
    pub fn new(over: &str, x: f64, force: f64) -> Self {
        Self { over: over.to_owned(), x, force, level: None, angle_deg: spread() }
    }

    /// Puts the axle on a fill with its top at this level \[length\].
    #[must_use]
    pub fn level(self, level: f64) -> Self {
        Self { level: Some(level), ..self }
    }
}

/// Returns the default angle of spread \[degrees\]: one horizontally to two vertically, the usual assumption for
/// roads, 26.565 degrees.
pub(super) fn spread() -> f64 {
    0.5_f64.atan().to_degrees()
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
pub(crate) fn is_spread(angle: &f64) -> bool {
    angle.to_bits() == spread().to_bits()
}
