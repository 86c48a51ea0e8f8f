//! Values in tables and in JSON objects.

use serde::Serialize;

/// A value of JSON; members of objects keep their order.
#[derive(Debug, Clone)]
pub(crate) enum Value {
    /// A value that is unknown, or does not exist: null in JSON.
    Nothing,
    Flag(bool),
    Count(usize),
    Number(f64),
    Words(String),
    List(Vec<Value>),
    Object(Members),
    /// A value that is already written as pretty-printed JSON.
    Json(String),
}

/// Members of a JSON object: keys and values.
pub(crate) type Members = Vec<(String, Value)>;

/// Makes the members of a JSON object from keys and values.
macro_rules! members {
    ($($key:literal: $value:expr),* $(,)?) => {
        vec![$(($key.to_owned(), $crate::figures::Value::from($value))),*]
    };
}

pub(crate) use members;

impl Value {
    /// Converts an object that can serialise itself into a value.
    pub(crate) fn of(it: &(impl Serialize + ?Sized)) -> Result<Self, serde_json::Error> {
        serde_json::to_string_pretty(it).map(Self::Json)
    }

    /// Returns the text of a JSON file with this value.
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

/// Writes the items of a list or an object on lines of their own. All lines can be indented, since strings of JSON have
/// no line breaks.
fn enclosed(
    [open, close]: [&str; 2],
    items: impl Iterator<Item = Result<String, serde_json::Error>>,
) -> Result<String, serde_json::Error> {
    let lines = items.collect::<Result<Vec<_>, _>>()?.join(",\n").replace('\n', "\n  ");
    let lines = if lines.is_empty() { lines } else { format!("\n  {lines}\n") };
    Ok(format!("{open}{lines}{close}"))
}

/// Implements `From` for types that become values.
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
