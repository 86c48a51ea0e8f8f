//! Values in tables and in JSON objects.

use serde::Serialize;

/// A value of JSON; members of objects keep their order.
#[derive(Debug, Clone)]
pub(crate) enum Value {
    /// A value that is not known, or does not exist.
    Nothing,
    Flag(bool),
    Count(usize),
    Number(f64),
    Words(String),
    List(Vec<Value>),
    Object(Members),
    /// The pretty-printed text of another value.
    Json(String),
}

/// Members of an object, by their keys.
pub(crate) type Members = Vec<(String, Value)>;

/// Members of an object.
macro_rules! members {
    ($($key:literal: $value:expr),* $(,)?) => {
        vec![$(($key.to_owned(), $crate::figures::Value::from($value))),*]
    };
}

pub(crate) use members;

impl Value {
    /// The value of an object that can serialise itself.
    pub(crate) fn of(it: &(impl Serialize + ?Sized)) -> Result<Self, serde_json::Error> {
        serde_json::to_string_pretty(it).map(Self::Json)
    }

    /// The text of a file.
    pub(crate) fn file(&self) -> Result<String, serde_json::Error> {
        Ok(self.pretty()? + "\n")
    }

    fn pretty(&self) -> Result<String, serde_json::Error> {
        Ok(match self {
            Self::Nothing => "null".to_owned(),
            Self::Flag(it) => it.to_string(),
            Self::Count(it) => it.to_string(),
            Self::Number(it) => serde_json::to_string(it)?,
            Self::Words(it) => serde_json::to_string(it)?,
            Self::Json(text) => text.clone(),
            Self::List(items) => enclosed(["[", "]"], items.iter().map(Self::pretty))?,
            Self::Object(members) => {
                let member = |(key, value): &(String, Self)| {
                    Ok(format!("{}: {}", serde_json::to_string(key)?, value.pretty()?))
                };
                enclosed(["{", "}"], members.iter().map(member))?
            }
        })
    }
}

/// Items on lines of their own; strings of JSON have no line breaks, so that all lines can be indented.
fn enclosed(
    [open, close]: [&str; 2],
    items: impl Iterator<Item = Result<String, serde_json::Error>>,
) -> Result<String, serde_json::Error> {
    let lines = items.collect::<Result<Vec<_>, _>>()?.join(",\n").replace('\n', "\n  ");
    let lines = if lines.is_empty() { lines } else { format!("\n  {lines}\n") };
    Ok(format!("{open}{lines}{close}"))
}

/// Conversions into values.
macro_rules! from {
    ($($type:ty => $value:expr),* $(,)?) => {
        $(impl From<$type> for Value {
            fn from(it: $type) -> Self {
                ($value)(it)
            }
        })*
    };
}

from! {
    bool => Self::Flag,
    usize => Self::Count,
    f64 => Self::Number,
    String => Self::Words,
    &str => |it: &str| Self::Words(it.to_owned()),
    &String => |it: &String| Self::Words(it.clone()),
    Members => Self::Object,
    &[String] => |list: &[String]| Self::List(list.iter().map(Self::from).collect()),
}

impl<T: Into<Value>> From<Option<T>> for Value {
    fn from(it: Option<T>) -> Self {
        it.map_or(Self::Nothing, Into::into)
    }
}
