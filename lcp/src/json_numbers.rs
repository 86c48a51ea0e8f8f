//! Numbers in files: an infinite number, which is a residual out of range or a bound that does not exist, is
//! written as `null` and read back as infinite.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Serialises infinity as `null`.
pub(crate) mod infinity {
    use super::{Deserialize, Deserializer, Serialize, Serializer, finite};

    #[allow(clippy::trivially_copy_pass_by_ref, reason = "the signature is that of serde")]
    pub(crate) fn serialize<S: Serializer>(value: &f64, to: S) -> Result<S::Ok, S::Error> {
        finite(*value).serialize(to)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
    }
}

/// Serialises minus infinity as `null`.
pub(crate) mod minus_infinity {
    pub(crate) use super::infinity::serialize;
    use super::{Deserialize, Deserializer};

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(from)?.unwrap_or(f64::NEG_INFINITY))
    }
}

/// Serialises every infinity of a list as `null`.
pub(crate) mod infinities {
    use super::{Deserialize, Deserializer, Serializer, finite};

    pub(crate) fn serialize<S: Serializer>(values: &[f64], to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(values.iter().map(|&value| finite(value)))
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
        let values: Vec<Option<f64>> = Vec::deserialize(from)?;
        Ok(values.into_iter().map(|value| value.unwrap_or(f64::INFINITY)).collect())
    }
}
