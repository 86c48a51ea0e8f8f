//! Forces per area on edges: uniform, or linear along a segment.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};

/// A force per area on an edge \[force/length^2\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EdgeStress {
    /// A pressure against the outward normal.
    Pressure(Pressure),
    /// A traction in global axes.
    Traction([f64; 2]),
    /// The pressure of earth or water, against the outward normal.
    Earth(Earth),
}

/// Earth or water beside an edge. The pressure is `K gamma` times the depth below the level, and zero above the level.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Earth {
    /// Weight per volume of the earth or water \[force/length^3\].
    pub gamma: f64,
    /// Horizontal pressure divided by vertical pressure, `K` \[-\]; 1 for water.
    #[serde(rename = "K")]
    pub k: f64,
    /// Height of the surface, as a coordinate y \[length\].
    pub level: f64,
}

impl Earth {
    /// Returns the pressure \[force/length^2\] at a height at or below the level.
    pub(crate) fn pressure_at(self, y: f64) -> f64 {
        self.k * self.gamma * (self.level - y)
    }
}

/// A pressure that varies linearly between its values at both ends of a segment \[force/length^2\]. In TOML it is one
/// number for a uniform pressure, or two numbers.
///
/// ```
/// use masonry::scene::Pressure;
/// assert_eq!(Pressure::from(5.0), Pressure { from: 5.0, to: 5.0 });
/// assert_eq!(Pressure::from([0.0, 5.0]), Pressure { from: 0.0, to: 5.0 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressure {
    /// The pressure at the end `from` of the segment.
    pub from: f64,
    /// The pressure at the end `to` of the segment.
    pub to: f64,
}

impl From<f64> for Pressure {
    fn from(uniform: f64) -> Self {
        Self { from: uniform, to: uniform }
    }
}

impl From<[f64; 2]> for Pressure {
    fn from([from, to]: [f64; 2]) -> Self {
        Self { from, to }
    }
}

impl Pressure {
    /// Returns whether the pressure is uniform on the segment.
    pub(super) fn is_uniform(self) -> bool {
        // The bits are compared, since a value that differs in any bit is written.
        self.from.to_bits() == self.to.to_bits()
    }
}

impl Serialize for Pressure {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { from, to } = *self;
        if self.is_uniform() {
            from.serialize(serializer)
        } else {
            [from, to].serialize(serializer)
        }
    }
}

impl<'de> Deserialize<'de> for Pressure {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(PressureVisitor)
    }
}

// The visitor is written by hand because an untagged enum would lose the place of a mistake in the list.
struct PressureVisitor;

impl<'de> Visitor<'de> for PressureVisitor {
    type Value = Pressure;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or a list of exactly 2 numbers, at `from` and at `to`")
    }

    fn visit_f64<E: Error>(self, uniform: f64) -> Result<Pressure, E> {
        Ok(uniform.into())
    }

    fn visit_i64<E: Error>(self, uniform: i64) -> Result<Pressure, E> {
        Ok((uniform as f64).into())
    }

    fn visit_u64<E: Error>(self, uniform: u64) -> Result<Pressure, E> {
        Ok((uniform as f64).into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Pressure, A::Error> {
        let (from, to) = (list.next_element()?, list.next_element()?);
        let mut length = usize::from(from.is_some()) + usize::from(to.is_some());
        while list.next_element::<IgnoredAny>()?.is_some() {
            length += 1;
        }
        match (from, to) {
            (Some(from), Some(to)) if length == 2 => Ok(Pressure { from, to }),
            _ => Err(A::Error::invalid_length(length, &self)),
        }
    }
}

/// Implements the schema of a number or a pair of numbers.
#[cfg(test)]
impl schemars::JsonSchema for Pressure {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Pressure".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let (number, pair) =
            (generator.subschema_for::<f64>(), generator.subschema_for::<[f64; 2]>());
        schemars::json_schema!({
            "description": "A number, or two: at `from` and at `to`, linear between them.",
            "anyOf": [number, pair]
        })
    }
}
