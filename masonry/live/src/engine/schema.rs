//! The schema of scenes: the numbers that are counts, and the keys and values that a place allows.

use std::sync::LazyLock;

use masonry::Scene;
use serde::Serialize;
use serde_json::Value;

/// One step of a path into the data of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Entry<'a> {
    Key(&'a str),
    Item,
}

/// The JSON schema of scenes.
pub(super) struct Schema;

static ROOT: LazyLock<Value> =
    LazyLock::new(|| serde_json::from_str(Scene::schema()).unwrap_or(Value::Null));

impl Schema {
    /// Whether the number at a path is a count.
    pub(super) fn is_whole(path: &[Entry<'_>]) -> bool {
        let places = at(path);
        let has = |name: &str| places.iter().any(|it| types(it).any(|it| it == name));
        has("integer") && !has("number")
    }

    /// Returns the keys that the table at a path may have.
    pub(super) fn keys(path: &[Entry<'_>]) -> Vec<Key> {
        let properties = at(path).into_iter().filter_map(|it| it["properties"].as_object());
        let key = |(name, inner): (&String, &Value)| Key {
            name: name.clone(),
            meaning: inner["description"].as_str().unwrap_or_default().to_owned(),
        };
        properties.flatten().map(key).collect()
    }

    /// Returns the words that are possible values at a path.
    pub(super) fn words(path: &[Entry<'_>]) -> Vec<Key> {
        let mut list = Vec::new();
        for place in at(path) {
            let meaning = place["description"].as_str().unwrap_or_default();
            let words = place["enum"].as_array().into_iter().flatten().chain(place.get("const"));
            list.extend(words.filter_map(|word| {
                Some(Key { name: word.as_str()?.to_owned(), meaning: meaning.to_owned() })
            }));
        }
        list
    }
}

/// A key or a word that the schema allows, and its meaning.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(super) struct Key {
    pub(super) name: String,
    pub(super) meaning: String,
}

/// Returns the nodes of the schema that describe a path.
fn at(path: &[Entry<'_>]) -> Vec<&'static Value> {
    let mut places = alternatives(&ROOT);
    for step in path {
        let inner = places.into_iter().filter_map(|place| match step {
            Entry::Key(key) => place["properties"]
                .get(key)
                .or_else(|| place.get("additionalProperties").filter(|it| it.is_object())),
            Entry::Item => place.get("items"),
        });
        places = inner.flat_map(alternatives).collect();
    }
    places
}

/// Returns a node of the schema, or the nodes to which it refers.
fn alternatives(node: &'static Value) -> Vec<&'static Value> {
    let named = node["$ref"].as_str().and_then(|it| ROOT.pointer(it.trim_start_matches('#')));
    let listed = ["anyOf", "oneOf"].into_iter().filter_map(|it| node[it].as_array()).flatten();
    let inner: Vec<_> = named.into_iter().chain(listed).flat_map(alternatives).collect();
    if inner.is_empty() { vec![node] } else { inner }
}

fn types(node: &Value) -> impl Iterator<Item = &str> {
    let one = node["type"].as_str();
    let several = node["type"].as_array().into_iter().flatten().filter_map(Value::as_str);
    one.into_iter().chain(several)
}
