//! Arrays and tables that refuse what serde would let pass.
//!
//! Serde's own arrays stop reading when they are full, so that a third coordinate
//! would be dropped without a word; its structs also read a list as their fields in order.

use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

pub(super) fn pair<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<[T; 2], D::Error> {
    ExactLength::deserialize(deserializer).map(|ExactLength(items)| items)
}

pub(super) fn some_pair<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<Option<[T; 2]>, D::Error> {
    pair(deserializer).map(Some)
}

pub(super) fn corners<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<[f64; 2]>, D::Error> {
    let corners = Vec::<ExactLength<f64, 2>>::deserialize(deserializer)?;
    Ok(corners.into_iter().map(|ExactLength(corner)| corner).collect())
}

/// Two points.
type TwoPoints = [[f64; 2]; 2];

pub(super) fn some_segments<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Vec<TwoPoints>>, D::Error> {
    let segments = Vec::<ExactLength<ExactLength<f64, 2>, 2>>::deserialize(deserializer)?;
    let segment = |ExactLength([ExactLength(from), ExactLength(to)])| [from, to];
    Ok(Some(segments.into_iter().map(segment).collect()))
}

/// A fraction from 0 to 1: `true` is 1 and `false` 0.
pub(super) fn some_part<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<f64>, D::Error> {
    deserializer.deserialize_any(ShareVisitor).map(Some)
}

struct ShareVisitor;

impl Visitor<'_> for ShareVisitor {
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

struct ExactLength<T, const N: usize>([T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for ExactLength<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ExactVisitor(PhantomData))
    }
}

struct ExactVisitor<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for ExactVisitor<T, N> {
    type Value = ExactLength<T, N>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of exactly {N} items")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<ExactLength<T, N>, A::Error> {
        let mut items = Vec::with_capacity(N);
        while items.len() < N {
            let Some(item) = list.next_element()? else { break };
            items.push(item);
        }
        let mut length = items.len();
        while list.next_element::<IgnoredAny>()?.is_some() {
            length += 1;
        }
        match <[T; N]>::try_from(items) {
            Ok(items) if length == N => Ok(ExactLength(items)),
            _ => Err(A::Error::invalid_length(length, &self)),
        }
    }
}

pub(super) fn table<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<T, D::Error> {
    TableOnly::deserialize(deserializer).map(|TableOnly(item)| item)
}

pub(super) fn some_table<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<Option<T>, D::Error> {
    table(deserializer).map(Some)
}

pub(super) fn named_tables<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<BTreeMap<String, T>, D::Error> {
    let tables = BTreeMap::<String, TableOnly<T>>::deserialize(deserializer)?;
    Ok(tables.into_iter().map(|(name, TableOnly(item))| (name, item)).collect())
}

pub(super) fn tables<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<Vec<T>, D::Error> {
    let tables = Vec::<TableOnly<T>>::deserialize(deserializer)?;
    Ok(tables.into_iter().map(|TableOnly(item)| item).collect())
}

struct TableOnly<T>(T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for TableOnly<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(TableVisitor(PhantomData))
    }
}

struct TableVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for TableVisitor<T> {
    type Value = TableOnly<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table such as { key = value }")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TableOnly<T>, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(TableOnly)
    }
}
