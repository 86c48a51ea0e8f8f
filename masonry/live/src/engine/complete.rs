//! Completion: the keys, words and names that fit at the cursor.

use serde::Serialize;

use super::schema::{Entry, Key, Schema};
use super::text::{Text, text_of};

/// The possible continuations of a text at the cursor.
#[derive(Debug, Serialize)]
pub(super) struct Completion {
    /// The length of the word before the cursor, in UTF-16 code units.
    before: usize,
    /// The words that may replace the word before the cursor.
    entries: Vec<Key>,
    /// The text to write after the word: ` = ` after a key of a table.
    after: &'static str,
}

/// Returns the keys, words or names that fit at the cursor. `until` is the text before the cursor; names are taken from
/// the `whole` text.
pub(super) fn complete(until: &str, whole: &Text<'_>) -> Completion {
    let line_start = until.rfind('\n').map_or(0, |it| it + 1);
    let (above, line) = until.split_at(line_start);
    let is_in_word = |c: char| c.is_alphanumeric() || "_-/\"".contains(c);
    let before_word = line.trim_end_matches(is_in_word);
    let (context, word) = line.split_at(before_word.len());
    let mut path = header(above);
    path.extend(braces(context));
    let mut after = "";
    let entries = match context.trim_end().strip_suffix('=') {
        Some(key) => {
            let key = key.trim_end().rsplit(|c: char| !is_in_word(c) && c != '.').next();
            path.extend(key.unwrap_or_default().split('.').map(Entry::Key));
            values(&path, whole)
        }
        // There are no keys to complete in a comment or a header.
        None if context.contains('#') || context.trim_end().ends_with(['[', '.']) => Vec::new(),
        None => {
            // Keys at the top level of a scene may be tables, which have headers instead of ` = `.
            after = if path.is_empty() { "" } else { " = " };
            Schema::keys(&path)
        }
    };
    let fits = |entry: &Key| entry.name.starts_with(word) && entry.name != word;
    Completion {
        before: word.encode_utf16().count(),
        entries: entries.into_iter().filter(fits).collect(),
        after,
    }
}

/// Returns the path of the table that the last header above the cursor opens.
fn header(above: &str) -> Vec<Entry<'_>> {
    let Some(line) = above.lines().rev().map(str::trim).find(|it| it.starts_with('[')) else {
        return Vec::new();
    };
    let name = line.split(']').next().unwrap_or_default().trim_start_matches('[');
    let mut path: Vec<Entry<'_>> = name.split('.').map(|it| Entry::Key(it.trim())).collect();
    if line.starts_with("[[") {
        path.push(Entry::Item);
    }
    path
}

/// Returns the path of the inline tables and lists of a line that are still open at its end.
fn braces(line: &str) -> Vec<Entry<'_>> {
    let mut open: Vec<Vec<Entry<'_>>> = Vec::new();
    for (at, letter) in line.char_indices() {
        let key =
            || line[..at].trim_end().strip_suffix('=').and_then(|it| it.split_whitespace().last());
        match letter {
            '[' => open.push(key().map(Entry::Key).into_iter().chain([Entry::Item]).collect()),
            '{' => open.push(key().map(Entry::Key).into_iter().collect()),
            ']' | '}' => drop(open.pop()),
            _ => {}
        }
    }
    open.concat()
}

/// Returns the values that fit, as they are written: the words that the schema allows, or the names to which the key
/// refers.
fn values(path: &[Entry<'_>], whole: &Text<'_>) -> Vec<Key> {
    let mut list = Schema::words(path);
    let Some(Entry::Key(key)) = path.last() else { return list };
    let mut refer = |names: Vec<&str>, what: &str| {
        let key =
            |name: &str| Key { name: name.to_owned(), meaning: format!("{what} of this scene") };
        list.extend(names.into_iter().map(key));
    };
    let keys = |table: &str| whole.named(table).into_iter().map(|(name, _)| name).collect();
    let groups = || {
        let of = |it| text_of(it, "group").or_else(|| text_of(it, "name"));
        let mut names: Vec<&str> = whole.tables("loads").into_iter().filter_map(of).collect();
        names.dedup();
        names
    };
    match *key {
        "material" => refer(keys("materials"), "a material"),
        "joint" | "springing" | "bed" | "head" => refer(keys("joints"), "a class of joints"),
        "group" => refer(groups(), "a group of loads"),
        _ => {}
    }
    for entry in &mut list {
        entry.name = format!("\"{}\"", entry.name);
    }
    list
}
