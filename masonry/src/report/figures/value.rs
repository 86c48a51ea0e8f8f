//! What stands in a table or in a JSON object.

use serde::Serialize;

/// A value of JSON; members of objects keep their order.
#[derive(Debug, Clone)]
pub(in crate::report) enum Value {
    /// What is not known, or does not exist.
    Nothing,
    Flag(bool),
    Count(usize),
    Number(f64),
    Words(String),
    List(Vec<Value>),
    Object(Vec<(String, Value)>),
    /// The pretty-printed text of something else.
    Json(String),
}

/// A list of values.
macro_rules! values {
    ($($value:expr),* $(,)?) => { vec![$($crate::report::figures::Value::from($value)),*] };
}

/// Members of an object.
macro_rules! members {
    ($($key:literal: $value:expr),* $(,)?) => {
        vec![$(($key.to_owned(), $crate::report::figures::Value::from($value))),*]
    };
}

pub(in crate::report) use {members, values};

impl Value {
    /// What knows by itself how it is written.
    pub(in crate::report) fn of(it: &(impl Serialize + ?Sized)) -> Result<Self, serde_json::Error> {
        serde_json::to_string_pretty(it).map(Self::Json)
    }

    /// The text of a file.
    pub(in crate::report) fn file(&self) -> Result<String, serde_json::Error> {
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
            Self::List(items) => {
                let items: Result<Vec<_>, _> = items.iter().map(Self::pretty).collect();
                enclosed(["[", "]"], &items?)
            }
            Self::Object(members) => {
                let member = |(key, value): &(String, Self)| {
                    Ok(format!("{}: {}", serde_json::to_string(key)?, value.pretty()?))
                };
                let members: Result<Vec<_>, _> = members.iter().map(member).collect();
                enclosed(["{", "}"], &members?)
            }
        })
    }
}

/// Items on lines of their own; strings of JSON have no line breaks, so that all lines can be indented.
fn enclosed([open, close]: [&str; 2], items: &[String]) -> String {
    if items.is_empty() {
        return format!("{open}{close}");
    }
    let lines = items.join(",\n").replace('\n', "\n  ");
    format!("{open}\n  {lines}\n{close}")
}

impl From<bool> for Value {
    fn from(it: bool) -> Self {
        Self::Flag(it)
    }
}

impl From<usize> for Value {
    fn from(it: usize) -> Self {
        Self::Count(it)
    }
}

impl From<f64> for Value {
    fn from(it: f64) -> Self {
        Self::Number(it)
    }
}

impl From<&str> for Value {
    fn from(it: &str) -> Self {
        Self::Words(it.to_owned())
    }
}

impl From<String> for Value {
    fn from(it: String) -> Self {
        Self::Words(it)
    }
}

impl From<&String> for Value {
    fn from(it: &String) -> Self {
        Self::Words(it.clone())
    }
}

impl From<Vec<(String, Value)>> for Value {
    fn from(members: Vec<(String, Value)>) -> Self {
        Self::Object(members)
    }
}

impl From<&[String]> for Value {
    fn from(list: &[String]) -> Self {
        Self::List(list.iter().map(Self::from).collect())
    }
}

impl<T: Into<Value>> From<Option<T>> for Value {
    fn from(it: Option<T>) -> Self {
        it.map_or(Self::Nothing, Into::into)
    }
}
