//! The text from which a scene was read, and places in this text.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use toml::de::{DeTable, DeValue};

use super::json_span;
use super::key_path::{KeyPath, PathStep};

/// The text from which a scene was read and its file, for the line and column of errors; empty for a scene built in
/// Rust.
///
/// All sources compare as equal, so that two scenes are equal if their data are equal, even if they come from
/// different files.
#[derive(Debug, Clone, Default)]
pub(super) struct Source(Arc<Text>);

#[derive(Debug, Default)]
struct Text {
    file: Option<PathBuf>,
    scene: String,
    list: Option<List>,
}

/// The file that the key `block_list` names, which has more blocks of the scene.
#[derive(Debug)]
pub(super) struct List {
    pub(super) path: PathBuf,
    /// The content of the file; for a drawing, its blocks as TOML.
    pub(super) text: String,
    /// The place of each block in the drawing; `None` for a JSON list.
    pub(super) entities: Option<Vec<String>>,
    /// The changes to the drawing and the omissions from it, one kind in each line.
    pub(super) changes: Vec<String>,
}

/// The place of a value: its file, and an excerpt of the text or an entity of the drawing.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Located {
    pub(super) file: Option<PathBuf>,
    pub(super) place: Option<Excerpt>,
    pub(super) entity: Option<String>,
}

impl PartialEq for Source {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Source {
    /// Makes a source with this text; the file is `None` if the text is not from a file.
    pub(super) fn new(text: &str, file: Option<&Path>) -> Self {
        let (scene, file) = (text.to_owned(), file.map(Path::to_owned));
        Self(Arc::new(Text { file, scene, list: None }))
    }

    /// Returns the source with the file of its `block_list` added.
    pub(super) fn with_list(&self, list: List) -> Self {
        let (file, scene) = (self.path().map(Path::to_owned), self.as_str().to_owned());
        Self(Arc::new(Text { file, scene, list: Some(list) }))
    }

    /// Returns the path of a file whose path in the scene is relative to the scene's own file.
    pub(super) fn beside(&self, file: &Path) -> PathBuf {
        self.path().and_then(Path::parent).map_or(file.to_owned(), |it| it.join(file))
    }

    pub(super) fn as_str(&self) -> &str {
        &self.0.scene
    }

    pub(super) fn path(&self) -> Option<&Path> {
        self.0.file.as_deref()
    }

    /// Returns the file with more blocks; `None` if the scene has no such file.
    pub(super) fn list(&self) -> Option<&List> {
        self.0.list.as_ref()
    }

    /// Returns the file and the place of the value at `path`, or of the innermost table around it that was written.
    pub(super) fn locate(&self, path: &KeyPath) -> Located {
        self.locate_in_list(path).unwrap_or_else(|| Located {
            file: self.path().map(Path::to_owned),
            place: self.locate_in_scene(path),
            entity: None,
        })
    }

    /// Returns the place of a value in the list of blocks; `None` if the value is not one of a block in the list.
    fn locate_in_list(&self, path: &KeyPath) -> Option<Located> {
        let list = self.list()?;
        let [PathStep::Key(key), PathStep::Index(index), inner @ ..] = path.steps() else {
            return None;
        };
        let table = DeTable::parse(self.as_str()).ok()?;
        let own = match table.get_ref().get("blocks").map(toml::Spanned::get_ref) {
            Some(DeValue::Array(blocks)) => blocks.len(),
            _ => 0,
        };
        let in_list = index.checked_sub(own).filter(|_| key == "blocks")?;
        let mut located = Located { file: Some(list.path.clone()), ..Located::default() };
        if let Some(entities) = &list.entities {
            located.entity = entities.get(in_list).cloned();
        } else {
            let steps = [&[PathStep::Index(in_list)], inner].concat();
            let span = json_span::locate(&list.text, &steps);
            located.place = span.and_then(|span| Excerpt::new(&list.text, span));
        }
        Some(located)
    }

    fn locate_in_scene(&self, path: &KeyPath) -> Option<Excerpt> {
        let table = DeTable::parse(self.as_str()).ok()?;
        let mut span = None;
        let mut value: Option<&DeValue<'_>> = None;
        for step in path.steps() {
            let inner = match (step, value) {
                (PathStep::Key(key), None) => table.get_ref().get(key.as_str()),
                (PathStep::Key(key), Some(DeValue::Table(table))) => table.get(key.as_str()),
                (PathStep::Index(index), Some(DeValue::Array(array))) => array.get(*index),
                _ => None,
            };
            let Some(inner) = inner else { break };
            span = Some(inner.span());
            value = Some(inner.get_ref());
        }
        span.and_then(|span| self.place(span))
    }

    /// Returns the excerpt of the text around a range of bytes.
    pub(super) fn place(&self, span: Range<usize>) -> Option<Excerpt> {
        Excerpt::new(self.as_str(), span)
    }
}

/// Largest number of characters that are shown before a mistake, of the mistake, and after it: a JSON list may be one
/// long line.
const SHOWN: usize = 60;

/// The line of a mistake, shortened to the part around the mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Excerpt {
    /// Line, from 1.
    pub(super) line: usize,
    /// Column in characters, from 1.
    pub(super) column: usize,
    /// The text that is shown before the mistake, of the mistake, and after it.
    before: String,
    marked: String,
    after: String,
}

impl Excerpt {
    /// Returns the excerpt at a line and a column, both from 1.
    pub(super) fn at(text: &str, line: usize, column: usize) -> Option<Self> {
        let before: usize = text.split_inclusive('\n').take(line.max(1) - 1).map(str::len).sum();
        let in_line = text.get(before..)?.char_indices().nth(column.max(1) - 1);
        let start = in_line.map_or(text.len(), |(offset, _)| before + offset);
        Self::new(text, start..start)
    }

    fn new(text: &str, span: Range<usize>) -> Option<Self> {
        let before = text.get(..span.start)?;
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line_end = line_start + text[line_start..].lines().next().unwrap_or("").len();
        let end = span.end.min(line_end).max(span.start);
        let (marked, after) = (text.get(span.start..end)?, text.get(end..line_end.max(end))?);
        let from_left = |text: &str| clipped(text.chars());
        let before_it: String =
            clipped(text[line_start..span.start].chars().rev()).chars().rev().collect();
        Some(Self {
            line: before.matches('\n').count() + 1,
            column: text[line_start..span.start].chars().count() + 1,
            before: before_it,
            marked: from_left(marked),
            after: from_left(after),
        })
    }

    /// Formats the line with its number, and carets below the mistake.
    pub(super) fn snippet(&self) -> String {
        let Self { before, marked, after, .. } = self;
        let number = self.line.to_string();
        let margin = " ".repeat(number.len());
        // Tabs are kept so that the carets stand below the same column.
        let indent: String = before.chars().map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
        let carets = "^".repeat(marked.chars().count().max(1));
        format!("{margin} |\n{number} | {before}{marked}{after}\n{margin} | {indent}{carets}")
    }
}

/// Returns the first characters of a text, with dots instead of the rest, and without characters that would act on a
/// terminal.
fn clipped(mut text: impl Iterator<Item = char>) -> String {
    let plain = |c: char| if c.is_control() && c != '\t' { '\u{fffd}' } else { c };
    let mut shown: String = text.by_ref().take(SHOWN).map(plain).collect();
    if text.next().is_some() {
        shown.push_str("...");
    }
    shown
}
