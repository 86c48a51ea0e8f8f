//! Materials of blocks and mortar, and the resistance of joints.

use serde::{Deserialize, Serialize};

use super::{PointRule, strict};
use crate::material::Elasticity;
use crate::units::Units;

/// A material of blocks or mortar: rigid if `E` is not given, elastic with `E` and `nu`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus \[force/length^2\]; blocks of a material without `E` are rigid.
    #[serde(rename = "E")]
    pub young: Option<f64>,
    /// Poisson's ratio \[-\], required with `E`.
    #[serde(rename = "nu")]
    pub poisson: Option<f64>,
    /// Mass density \[kg/m^3\], whatever the units of the scene.
    pub density: Option<f64>,
}

impl Material {
    /// Returns the elastic constants in SI units; `None` for a rigid material.
    pub(crate) fn elasticity(&self, units: Units) -> Option<Elasticity> {
        let young = self.young? * units.stress_to_si();
        Some(Elasticity { young, poisson: self.poisson? })
    }
}

/// A class of joints: exactly one of `mu` and `phi_deg`, and optionally cohesion, tensile strength, stiffness and
/// mortar. The joints obey the [law](crate::law) of contact with friction.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Coefficient of Coulomb friction \[-\]; zero for a frictionless joint.
    pub mu: Option<f64>,
    /// Angle of friction \[degrees\].
    pub phi_deg: Option<f64>,
    /// Cohesion \[force/length^2\]: the resistance to sliding without a normal force.
    pub cohesion: Option<f64>,
    /// Tensile strength \[force/length^2\], at most the cohesion divided by the coefficient of friction.
    pub tension: Option<f64>,
    /// Normal and tangential stiffness of the joint `[k_n, k_t]` \[force/length^3\]; without it the joint is rigid,
    /// except for its mortar.
    #[serde(default, deserialize_with = "strict::read")]
    pub stiffness: Option<[f64; 2]>,
    /// The rule for the places on the joints of the class at which the law is enforced, instead of
    /// [`Contact::points`](super::Contact::points).
    pub points: Option<PointRule>,
    /// Thickness of the mortar \[length\]; a joint whose thickness is zero or not given is dry.
    pub thickness: Option<f64>,
    /// Name of the elastic material of the mortar; required with a thickness above zero.
    pub material: Option<String>,
}

impl Joint {
    /// Returns the coefficient of friction \[-\]; zero if neither `mu` nor `phi_deg` is given.
    pub fn friction(&self) -> f64 {
        self.mu.or(self.phi_deg.map(|phi| phi.to_radians().tan())).unwrap_or(0.0)
    }

    /// Returns the thickness of the mortar \[length\]; zero for a dry joint.
    pub fn mortar_thickness(&self) -> f64 {
        self.thickness.unwrap_or(0.0)
    }
}

/// The class of all joints between two bodies, each given by the name of a block or of a wall.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Between {
    /// The names of the two bodies; twice the same wall for the joints within this wall.
    #[serde(deserialize_with = "strict::read")]
    pub blocks: [String; 2],
    /// The class of the joints between the two bodies.
    pub joint: String,
}
