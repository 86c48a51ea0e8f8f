//! Fill over an arch, a wall or a block, and axles on it.

use serde::{Deserialize, Serialize};

/// Fill over an arch, a wall or a block: vertical weight on the edges below it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Fill {
    /// The arch, wall or block that carries the fill.
    pub over: String,
    /// Height of the level top of the fill \[length\].
    pub level: f64,
    /// The weight of the fill \[force/length^3\].
    pub gamma: f64,
}

/// An axle on the level top of a fill, through which its force spreads, or on the top edge of a block.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Axle {
    /// The arch, wall or block that carries the axle.
    pub over: String,
    /// The place of the axle along x \[length\].
    pub x: f64,
    /// The force of the axle \[force\], which presses down over the whole thickness.
    pub force: f64,
    /// Height of the top of the fill \[length\]; the axle stands on the highest edge below it if no level
    /// is given.
    pub level: Option<f64>,
    /// Angle from the vertical at which the fill spreads the force \[degrees\]; with a `level` only.
    #[serde(default = "spread", skip_serializing_if = "is_spread")]
    pub angle_deg: f64,
}

impl Axle {
    /// An axle at `x` \[length\] on the top edge of the body `over` that carries it, with its force
    /// \[force\].
    pub fn new(over: &str, x: f64, force: f64) -> Self {
        Self { over: over.to_owned(), x, force, level: None, angle_deg: spread() }
    }

    /// Puts the axle on a fill with its top at this level \[length\].
    #[must_use]
    pub fn level(self, level: f64) -> Self {
        Self { level: Some(level), ..self }
    }
}

/// A slope of one horizontally to two vertically, the usual assumption for roads: 26.565 degrees.
pub(super) fn spread() -> f64 {
    0.5_f64.atan().to_degrees()
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
pub(crate) fn is_spread(angle: &f64) -> bool {
    angle.to_bits() == spread().to_bits()
}
