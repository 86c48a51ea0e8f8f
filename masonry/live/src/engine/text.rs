//! The text of a scene as tables and values, each with its place in the text. Broken parts are left out, so that the
//! other parts can be changed.

use std::ops::Range;

use serde::Serialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::schema::{Entry, Schema};

/// A value and the bytes of the text that it occupies.
pub(super) type Value<'a> = Spanned<DeValue<'a>>;

/// The text of a scene with its values.
#[derive(Debug)]
pub(super) struct Text<'a> {
    source: &'a str,
    root: Spanned<DeTable<'a>>,
    /// For every byte of the text, the number of UTF-16 code units before it; scripts count in these units.
    units: Vec<usize>,
}

/// A number in the text that can be changed. Positions are in UTF-16 code units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Number {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) value: f64,
    /// Whether the number is a count.
    pub(super) whole: bool,
    /// The least value that the number may have: zero for sizes and factors, one for counts; `None` for coordinates and
    /// components.
    pub(super) least: Option<f64>,
}

impl<'a> Text<'a> {
    pub(super) fn read(source: &'a str) -> Self {
        let (root, _) = DeTable::parse_recoverable(source);
        let mut units = Vec::with_capacity(source.len() + 1);
        let mut before = 0;
        for letter in source.chars() {
            units.extend(std::iter::repeat_n(before, letter.len_utf8()));
            before += letter.len_utf16();
        }
        units.push(before);
        Self { source, root, units }
    }

    /// Returns the value of a top-level key of the scene.
    pub(super) fn get(&self, key: &str) -> Option<&Value<'a>> {
        self.root.get_ref().get(key)
    }

    /// Returns the tables in the list of a top-level key of the scene.
    pub(super) fn tables(&self, key: &str) -> Vec<&Value<'a>> {
        let list = self.get(key).and_then(|it| it.get_ref().as_array());
        list.into_iter().flatten().filter(|it| it.get_ref().is_table()).collect()
    }

    /// Returns the tables below a top-level key of the scene, with their names.
    pub(super) fn named(&self, key: &str) -> Vec<(&str, &Value<'a>)> {
        let tables = self.get(key).and_then(|it| it.get_ref().as_table());
        tables.into_iter().flatten().map(|(name, it)| (name.get_ref().as_ref(), it)).collect()
    }

    /// Returns all numbers of the text, in their order.
    pub(super) fn numbers(&self) -> Vec<Number> {
        let mut list = Vec::new();
        let top = self.root.get_ref().iter();
        for (key, value) in top {
            let mut path = vec![Entry::Key(key.get_ref())];
            self.collect(value, &mut path, &mut list);
        }
        list.sort_by_key(|it| it.from);
        list
    }

    fn collect<'b>(&self, value: &'b Value<'a>, path: &mut Vec<Entry<'b>>, list: &mut Vec<Number>) {
        let mut inside = |step: Entry<'b>, inner: &'b Value<'a>, list: &mut Vec<Number>| {
            path.push(step);
            self.collect(inner, path, list);
            path.pop();
        };
        match value.get_ref() {
            DeValue::Table(table) => {
                for (key, inner) in table {
                    inside(Entry::Key(key.get_ref()), inner, list);
                }
            }
            DeValue::Array(array) => {
                for inner in array {
                    inside(Entry::Item, inner, list);
                }
            }
            _ => list.extend(self.number(value, path)),
        }
    }

    /// Returns a number with the properties that the schema gives for its path.
    pub(super) fn number(&self, value: &Value<'a>, path: &[Entry<'_>]) -> Option<Number> {
        let number = match value.get_ref() {
            DeValue::Integer(it) if it.radix() == 10 => it.as_str().parse::<f64>().ok()?,
            DeValue::Float(it) => it.as_str().parse().ok()?,
            _ => return None,
        };
        let whole = Schema::is_whole(path);
        let is_component = path.last() == Some(&Entry::Item);
        let least = match whole {
            true => Some(1.0),
            false if is_component || number < 0.0 => None,
            false => Some(0.0),
        };
        let Range { start, end } = value.span();
        let (from, to) = (self.units[start], self.units[end]);
        number.is_finite().then_some(Number { from, to, value: number, whole, least })
    }

    /// Returns the number of a key in a table of a list, such as `loads[2].factor`.
    pub(super) fn number_in(
        &self,
        list: &str,
        table: &Value<'a>,
        path: &[Entry<'_>],
    ) -> Option<Number> {
        let mut value = table;
        for step in path {
            let Entry::Key(key) = step else { return None };
            value = value.get_ref().as_table()?.get(*key)?;
        }
        self.number(value, &[&[Entry::Key(list), Entry::Item], path].concat())
    }

    /// Returns the line of a byte, from 1.
    pub(super) fn line(&self, byte: usize) -> usize {
        self.source[..byte].matches('\n').count() + 1
    }

    /// Returns the place for a new key of a table, and the text to write before the key: in an inline table (in
    /// braces), the place after one of its values; otherwise a new line.
    pub(super) fn room_after(&self, table: &Value<'a>, value: &Value<'a>) -> (usize, &'static str) {
        let end = value.span().end;
        if self.source[table.span().start..].starts_with('{') {
            return (self.units[end], ", ");
        }
        let line_end = self.source[end..].find('\n').map_or(self.source.len(), |it| end + it);
        (self.units[line_end], "\n")
    }

    /// Returns the last byte of a table, including all its keys.
    pub(super) fn end(value: &Value<'_>) -> usize {
        let inner = match value.get_ref() {
            DeValue::Table(table) => table.iter().map(|(_, it)| Self::end(it)).max(),
            DeValue::Array(array) => array.iter().map(Self::end).max(),
            _ => None,
        };
        inner.map_or(value.span().end, |end| end.max(value.span().end))
    }
}

/// Returns the value of a key in a table.
pub(super) fn value_of<'t, 'a>(table: &'t Value<'a>, key: &str) -> Option<&'t Value<'a>> {
    table.get_ref().as_table()?.get(key)
}

/// Returns the text of a key in a table.
pub(super) fn text_of<'t>(table: &'t Value<'_>, key: &str) -> Option<&'t str> {
    value_of(table, key)?.get_ref().as_str()
}
