//! Settings of the search for contacts and of the contact law.

use serde::{Deserialize, Serialize};

/// Settings of the search for contacts: contact points, gaps, tolerance, and mortar films.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct Contact {
    /// The rule for the places on a joint at which the contact law is enforced.
    pub points: PointRule,
    /// Largest distance of bodies that may come into contact \[length\]; at zero only bodies that touch.
    pub gap_limit: f64,
    /// Distance \[length\] below which corners of single blocks are put onto supports and onto corners and edges of
    /// other blocks, by the least movements. If no tolerance is given, corners are moved only if blocks overlap, by up
    /// to 1e-5 of the shortest edge of a single block: coordinates in metres with six decimals have smaller errors on
    /// bricks that are 0.2 m high.
    pub tolerance: Option<f64>,
    /// The terms of mortar films that are kept.
    pub films: Films,
}

/// The rule for the places on a joint at which the contact law is enforced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PointRule {
    /// Contact points at both ends of every part of a joint, with trapezoidal weights. The shape functions of both sides
    /// are linear on a part.
    #[default]
    Vertices,
    /// Places at which both sides of the joint have a node (on a support: places at which the block has one), weighted
    /// by tributary length: the node pairs of the paper.
    NodalPairs,
    /// Two Gauss points in every part on which the shape functions of both sides are linear.
    Gauss,
}

/// The terms of mortar films that are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Films {
    /// Terms perpendicular to the joint and its shear: a compliance in series with each contact point, without strain
    /// along the joint.
    #[default]
    Compliance,
    /// All terms of a strip (3.28)-(3.39), including the stress along the joint and the strain that the strip shares
    /// with the blocks. The strip is integrated at its Gauss points: `points` must be `gauss`.
    Strips,
}
