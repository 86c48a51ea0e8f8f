//! Strict reading of arrays and tables, which refuses input that serde would accept.
//!
//! Serde stops reading an array when it is full, so that a third coordinate would be dropped silently. Serde also
//! reads a list as the fields of a struct in their order.

use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

/// Reads a value strictly: at any depth, pairs must have exactly two items, and structs must be read from tables.
pub(super) fn read<'de, D: Deserializer<'de>, T: Strict<'de>>(from: D) -> Result<T, D::Error> {
    T::read(from)
}

pub(super) trait Strict<'de>: Sized {
    fn read<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error>;
}

/// A wrapper whose deserialisation by serde uses [`Strict`].
struct Read<T>(T);

impl<'de, T: Strict<'de>> Deserialize<'de> for Read<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        T::read(from).map(Self)
    }
}

impl<'de, T: Strict<'de>> Strict<'de> for Option<T> {
    fn read<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Ok(Option::<Read<T>>::deserialize(from)?.map(|Read(value)| value))
    }
}

impl<'de, T: Strict<'de>> Strict<'de> for Vec<T> {
    fn read<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Ok(Vec::<Read<T>>::deserialize(from)?.into_iter().map(|Read(value)| value).collect())
    }
}

impl<'de, T: Strict<'de>> Strict<'de> for BTreeMap<String, T> {
    fn read<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let tables = BTreeMap::<String, Read<T>>::deserialize(from)?;
        Ok(tables.into_iter().map(|(name, Read(value))| (name, value)).collect())
    }
}

macro_rules! values {
    ($($value:ty),+) => { $(
        impl<'de> Strict<'de> for $value {
            fn read<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                Self::deserialize(from)
            }
        }
    )+ };
}

/// Reads a struct from a table, and refuses lists.
pub(super) fn table<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    from: D,
) -> Result<T, D::Error> {
    from.deserialize_map(TableVisitor(PhantomData))
}

/// Implements [`Strict`] for these types by the function [`table`].
macro_rules! tables {
    ($($table:ty),+) => { $(
        impl<'de> strict::Strict<'de> for $table {
            fn read<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                strict::table(from)
            }
        }
    )+ };
}
pub(super) use tables;

values!(f64, u32, String);

struct TableVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for TableVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table such as { key = value }")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map))
    }
}

impl<'de, T: Strict<'de>> Strict<'de> for [T; 2] {
    fn read<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(PairVisitor(PhantomData))
    }
}

struct PairVisitor<T>(PhantomData<T>);

impl<'de, T: Strict<'de>> Visitor<'de> for PairVisitor<T> {
    type Value = [T; 2];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of exactly 2 items")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<[T; 2], A::Error> {
        let first = list.next_element()?.map(|Read(item)| item);
        let second = list.next_element()?.map(|Read(item)| item);
        let mut length = usize::from(first.is_some()) + usize::from(second.is_some());
        while list.next_element::<IgnoredAny>()?.is_some() {
            length += 1;
        }
        match (first, second) {
            (Some(first), Some(second)) if length == 2 => Ok([first, second]),
            _ => Err(A::Error::invalid_length(length, &self)),
        }
    }
}

/// Reads a fraction from 0 to 1; `true` is 1 and `false` is 0.
pub(super) fn part<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    Ok(Option::<Fraction>::deserialize(from)?.map(|Fraction(part)| part))
}

struct Fraction(f64);

impl<'de> Deserialize<'de> for Fraction {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(FractionVisitor).map(Self)
    }
}

struct FractionVisitor;

impl Visitor<'_> for FractionVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("true, false, or a number from 0 to 1")
    }

    fn visit_bool<E: Error>(self, all: bool) -> Result<f64, E> {
        Ok(if all { 1.0 } else { 0.0 })
    }

    fn visit_f64<E: Error>(self, part: f64) -> Result<f64, E> {
        Ok(part)
    }

    fn visit_i64<E: Error>(self, part: i64) -> Result<f64, E> {
        Ok(part as f64)
    }

    fn visit_u64<E: Error>(self, part: u64) -> Result<f64, E> {
        Ok(part as f64)
    }
}

/// Reads the numbers of elements along two directions; a single number counts for both.
pub(super) fn mesh<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[u32; 2]>, D::Error> {
    Ok(Option::<MeshCounts>::deserialize(from)?.map(|MeshCounts(counts)| counts))
}

struct MeshCounts([u32; 2]);

impl<'de> Deserialize<'de> for MeshCounts {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(MeshCountsVisitor).map(Self)
    }
}

struct MeshCountsVisitor;

impl<'de> Visitor<'de> for MeshCountsVisitor {
    type Value = [u32; 2];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number of elements, or a list of exactly 2 items")
    }

    fn visit_i64<E: Error>(self, count: i64) -> Result<[u32; 2], E> {
        let count = u64::try_from(count);
        count.map_or_else(
            |_| Err(E::custom("a number of elements is at least 1")),
            |it| self.visit_u64(it),
        )
    }

    fn visit_u64<E: Error>(self, count: u64) -> Result<[u32; 2], E> {
        Ok([u32::try_from(count).unwrap_or(u32::MAX); 2])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<[u32; 2], A::Error> {
        PairVisitor(PhantomData).visit_seq(list)
    }
}
