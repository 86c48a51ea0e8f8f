//! Settings of the search for contact and of its enforcement.

use serde::{Deserialize, Serialize};

/// Settings of the search for contact and of its enforcement.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct Contact {
    /// The places on a joint at which the contact law is enforced.
    pub points: PointRule,
    /// Bodies closer than this may meet \[length\]; zero: only bodies that touch.
    pub gap_limit: f64,
    /// Distance \[length\] below which corners of single blocks are put onto corners and edges of other blocks and onto
    /// supports, by the least movements. If no tolerance is given, corners are moved only if blocks overlap, by up to
    /// 1e-5 of the shortest edge of a single block: coordinates in metres with six decimals err by less on bricks that
    /// are 0.2 m high.
    pub tolerance: Option<f64>,
    /// The terms of mortar films that are kept.
    pub films: Films,
}

/// The places on a joint at which the contact law is enforced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PointRule {
    /// Both ends of every part of the overlap on which the shape functions of both sides are
    /// linear, with trapezoidal weights.
    #[default]
    Vertices,
    /// Places at which each side has a node (on a support: the block), weighted by tributary length: the node pairs of
    /// the paper.
    NodalPairs,
    /// Two Gauss points in every part on which the shape functions of both sides are linear.
    Gauss,
}

/// The terms of mortar films that are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Films {
    /// Terms across the joint: a compliance in series with each contact point, without strain along the joint.
    #[default]
    Compliance,
    /// The whole strip (3.28)-(3.39), also with the stress along the joint and the strain that it shares with the
    /// blocks. It is integrated at its Gauss points: `points` must be `gauss`.
    Strips,
}
