//! Places in files.

use std::fmt;

/// A place in a file: the entity, and its line.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Place {
    /// The entity, with its handle or name.
    pub entity: String,
    /// The line of the file, from 1.
    pub line: Option<usize>,
}

impl Place {
    /// Creates a place from an entity and its line, if it has one.
    pub fn new(entity: impl Into<String>, line: Option<usize>) -> Self {
        Self { entity: entity.into(), line }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Names of a file may be long.
        let mut rest = self.entity.chars();
        let entity: String = rest.by_ref().take(LONGEST_NAME).map(harmless).collect();
        let dots = if rest.next().is_some() { "..." } else { "" };
        write!(f, "{entity}{dots}")?;
        self.line.map_or(Ok(()), |line| write!(f, " (line {line})"))
    }
}

/// Returns a character, or a replacement if the character controls a terminal.
pub(super) fn harmless(c: char) -> char {
    if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }
}

/// The largest number of characters of a name that are shown. Chosen: one line of a terminal.
const LONGEST_NAME: usize = 100;
