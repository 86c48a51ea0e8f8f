//! Units of a scene and their conversion to SI.

use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// Unit of length of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum LengthUnit {
    /// Millimetre.
    Mm,
    /// Centimetre.
    Cm,
    /// Metre.
    M,
    /// Kilometre.
    Km,
}

/// Unit of force of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub enum ForceUnit {
    /// Newton.
    N,
    /// Kilonewton.
    #[serde(rename = "kN")]
    Kn,
    /// Meganewton.
    #[serde(rename = "MN")]
    Mn,
    /// Giganewton.
    #[serde(rename = "GN")]
    Gn,
}

/// The units in which a scene gives its lengths and forces; all other units follow from these two.
///
/// Stresses and moduli are force / length^2. Density is always kg/m^3, gravity m/s^2 and angles
/// degrees, whatever the units of length and force.
///
/// ```
/// use masonry::units::{ForceUnit, LengthUnit, Units};
/// let units = Units { length: LengthUnit::M, force: ForceUnit::Kn };
/// assert_eq!(units.stress_to_si(), 1e3);
/// assert_eq!(units.stress_name(), "kN/m2");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Units {
    /// Unit of length: `mm`, `cm`, `m` or `km`.
    pub length: LengthUnit,
    /// Unit of force: `N`, `kN`, `MN` or `GN`.
    pub force: ForceUnit,
}

impl Units {
    /// SI units: metres and newtons.
    pub const SI: Self = Self { length: LengthUnit::M, force: ForceUnit::N };

    /// Converts a place of a scene to a point \[m\].
    pub(crate) fn point(self, [x, y]: [f64; 2]) -> Point2<f64> {
        Point2::new(x, y) * self.length_to_si()
    }

    /// Returns the number of metres in one unit of length.
    pub fn length_to_si(self) -> f64 {
        match self.length {
            LengthUnit::Mm => 1e-3,
            LengthUnit::Cm => 1e-2,
            LengthUnit::M => 1.0,
            LengthUnit::Km => 1e3,
        }
    }

    /// Returns the number of newtons in one unit of force.
    pub fn force_to_si(self) -> f64 {
        match self.force {
            ForceUnit::N => 1.0,
            ForceUnit::Kn => 1e3,
            ForceUnit::Mn => 1e6,
            ForceUnit::Gn => 1e9,
        }
    }

    /// Returns the number of pascals in one unit of stress.
    pub fn stress_to_si(self) -> f64 {
        self.force_to_si() / (self.length_to_si() * self.length_to_si())
    }

    /// Returns the number of pascals per metre in one unit of joint stiffness, which is force / length^3.
    pub fn stiffness_to_si(self) -> f64 {
        self.stress_to_si() / self.length_to_si()
    }

    /// Returns the number of joules in one unit of energy, and of newton metres in one unit of moment.
    pub fn energy_to_si(self) -> f64 {
        self.force_to_si() * self.length_to_si()
    }

    /// Returns the symbol of the unit of length.
    pub fn length_name(self) -> &'static str {
        match self.length {
            LengthUnit::Mm => "mm",
            LengthUnit::Cm => "cm",
            LengthUnit::M => "m",
            LengthUnit::Km => "km",
        }
    }

    /// Returns the symbol of the unit of force.
    pub fn force_name(self) -> &'static str {
        match self.force {
            ForceUnit::N => "N",
            ForceUnit::Kn => "kN",
            ForceUnit::Mn => "MN",
            ForceUnit::Gn => "GN",
        }
    }

    /// Returns the symbol of the unit of stress, such as `kN/m2`.
    pub fn stress_name(self) -> String {
        format!("{}/{}2", self.force_name(), self.length_name())
    }

    /// Returns the symbol of the unit of energy and moment, such as `kNm`.
    pub fn energy_name(self) -> String {
        format!("{}{}", self.force_name(), self.length_name())
    }
}
