//! The lines of the text that describe parts of the picture.

use serde::Serialize;

use super::text::{Text, Value, text_of};

/// Lines that describe a part of the picture.
#[derive(Debug, Serialize)]
pub(super) struct Place {
    /// `block`, whose name may be that of the wall or arch before the first `/`; `joint`, a class of joints; `support`
    /// or `load`.
    kind: &'static str,
    name: String,
    /// Lines, from 1.
    first: usize,
    last: usize,
}

/// The places at which a scene describes blocks, joint classes, supports and loads.
pub(super) fn places(text: &Text<'_>) -> Vec<Place> {
    let place = |kind: &'static str, name: &str, table: &Value<'_>| Place {
        kind,
        name: name.to_owned(),
        first: text.line(table.span().start),
        last: text.line(Text::end(table)),
    };
    let lists = [
        ("block", "walls"),
        ("block", "arches"),
        ("block", "blocks"),
        ("support", "supports"),
        ("load", "loads"),
    ];
    let mut list = Vec::new();
    for (kind, key) in lists {
        for table in text.tables(key) {
            list.extend(text_of(table, "name").map(|name| place(kind, name, table)));
        }
    }
    list.extend(text.named("joints").into_iter().map(|(name, it)| place("joint", name, it)));
    list
}
