//! Fill over an arch, a wall or a block, and axles on it.

use serde::{Deserialize, Serialize};

/// Fill over an arch, a wall or a block: vertical weight on the edges below it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Fill {
    /// The arch, wall or block that carries it.
    pub over: String,
    /// Height of its level top \[length\].
    pub level: f64,
    /// Its weight \[force/length^3\].
    pub gamma: f64,
}

/// An axle on the level top of a fill, through which its force spreads, or on the top edge of a block.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Axle {
    /// The arch, wall or block that carries it.
    pub over: String,
    /// Its place along x \[length\].
    pub x: f64,
    /// Its force \[force\], which presses down over the whole thickness.
    pub force: f64,
    /// Height of the top of the fill \[length\]; without it the axle stands on the highest edge below it.
    pub level: Option<f64>,
    /// Angle from the vertical at which the fill spreads the force \[degrees\]; with a `level` only.
    #[serde(default = "spread", skip_serializing_if = "is_spread")]
    pub angle_deg: f64,
}

impl Axle {
    /// An axle at `x` \[length\] on the top edge of what carries it, with its force \[force\].
    pub fn new(over: &str, x: f64, force: f64) -> Self {
        Self { over: over.to_owned(), x, force, level: None, angle_deg: spread() }
    }

    /// Puts the axle on a fill with its top at this level \[length\].
    #[must_use]
    pub fn level(self, level: f64) -> Self {
        Self { level: Some(level), ..self }
    }
}

/// A slope of one horizontally to two vertically, as roads are commonly assessed: 26.565 degrees.
pub(super) fn spread() -> f64 {
    0.5_f64.atan().to_degrees()
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
pub(crate) fn is_spread(angle: &f64) -> bool {
    angle.to_bits() == spread().to_bits()
}
