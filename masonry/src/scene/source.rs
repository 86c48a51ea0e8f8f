//! The text of a scene and places in it.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use toml::de::{DeTable, DeValue};

use super::json_span;
use super::key_path::{KeyPath, PathStep};

/// The text from which a scene was read; empty for a scene built in Rust.
///
/// All sources are equal: two scenes from different files may be the same.
#[derive(Debug, Clone, Default)]
pub(super) struct Source(Arc<Text>);

#[derive(Debug, Default)]
struct Text {
    file: Option<PathBuf>,
    scene: String,
    list: Option<List>,
}

/// A file with more blocks.
#[derive(Debug)]
pub(super) struct List {
    pub(super) path: PathBuf,
    /// The content of the file, or the content of a drawing as TOML.
    pub(super) text: String,
    /// The places of the blocks in a drawing; `None` for a JSON list.
    pub(super) entities: Option<Vec<String>>,
    /// Changes and omissions of a drawing, one kind in each line.
    pub(super) changes: Vec<String>,
}

/// The place of a value: the file, and a part of its text or of its drawing.
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
    /// The source with this text, with or without a file.
    pub(super) fn new(text: &str, file: Option<&Path>) -> Self {
        let (scene, file) = (text.to_owned(), file.map(Path::to_owned));
        Self(Arc::new(Text { file, scene, list: None }))
    }

    /// The source with a file with more blocks.
    pub(super) fn with_list(&self, list: List) -> Self {
        let (file, scene) = (self.path().map(Path::to_owned), self.as_str().to_owned());
        Self(Arc::new(Text { file, scene, list: Some(list) }))
    }

    /// The path of a file that the scene gives relative to its own file.
    pub(super) fn beside(&self, file: &Path) -> PathBuf {
        self.path().and_then(Path::parent).map_or(file.to_owned(), |it| it.join(file))
    }

    pub(super) fn as_str(&self) -> &str {
        &self.0.scene
    }

    pub(super) fn path(&self) -> Option<&Path> {
        self.0.file.as_deref()
    }

    /// The list of blocks.
    pub(super) fn list(&self) -> Option<&List> {
        self.0.list.as_ref()
    }

    /// The file and the place of the value at `path`, or of the innermost written table around it.
    pub(super) fn locate(&self, path: &KeyPath) -> Located {
        self.locate_in_list(path).unwrap_or_else(|| Located {
            file: self.path().map(Path::to_owned),
            place: self.locate_in_scene(path),
            entity: None,
        })
    }

    /// The place of a value in the list of blocks, for blocks that are not in the scene itself.
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

    /// The place of a range of bytes.
    pub(super) fn place(&self, span: Range<usize>) -> Option<Excerpt> {
        Excerpt::new(self.as_str(), span)
    }
}

/// Characters of a line that are shown before, of and after a mistake: a list may be one long line.
const SHOWN: usize = 60;

/// The part of a line around a mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Excerpt {
    /// Line, from 1.
    pub(super) line: usize,
    /// Column in characters, from 1.
    pub(super) column: usize,
    /// The shown text before the mistake, of it, and after it.
    before: String,
    marked: String,
    after: String,
}

impl Excerpt {
    /// A place by its line and column, from 1.
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

    /// The line with its number, and carets below the mistake.
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

/// The first characters, with dots for the others, and without characters that would act on a terminal.
fn clipped(mut text: impl Iterator<Item = char>) -> String {
    let plain = |c: char| if c.is_control() && c != '\t' { '\u{fffd}' } else { c };
    let mut shown: String = text.by_ref().take(SHOWN).map(plain).collect();
    if text.next().is_some() {
        shown.push_str("...");
    }
    shown
}
