//! Lines of the text that describe parts of the picture.

use serde::Serialize;

use super::text::{Text, Value, text_of};

/// The lines of the text that describe one part of the picture.
#[derive(Debug, Serialize)]
pub(super) struct Place {
    /// The kind of the part: `block`, `joint` (a joint class), `support` or `load`. The name of a `block` may be that
    /// of a wall or an arch, whose blocks have this name before the first `/` of theirs.
    kind: &'static str,
    name: String,
    /// The first and the last line, from 1.
    first: usize,
    last: usize,
}

/// Returns the lines of a scene that describe blocks, joint classes, supports and loads.
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
