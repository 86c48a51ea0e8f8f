//! Reading scenes from text, and writing them.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use toml::de::DeTable;

use super::drawn::{Drawings, Drawn};
use super::source::{List, Source};
use super::{Fault, KeyPath, Scene, SceneError, SceneErrorKind, block_list};
use crate::files::read_bounded;

/// The largest size of the file of a scene, and of the file of its list of blocks \[bytes\]. Theory: a hundred bytes
/// for each block of the largest scene.
const LARGEST_FILE: usize = 100 << 20;

impl Scene {
    /// Reads a scene from TOML text and [checks](Scene::check) the scene.
    ///
    /// # Errors
    /// The first mistake in the text or in the data, with line and column.
    pub fn from_toml(text: &str) -> Result<Self, SceneError> {
        Self::parse(&Source::new(text, None), None)
    }

    /// Reads a scene from a TOML file and [checks](Scene::check) the scene.
    ///
    /// # Errors
    /// [`SceneErrorKind::Read`] if the file cannot be read as UTF-8 text; otherwise as [`Scene::from_toml`], with the
    /// path of the file.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        Self::read_by(path, None)
    }

    pub(super) fn read_by(path: &Path, drawings: Option<Drawings>) -> Result<Self, SceneError> {
        let unreadable = |message: String| SceneError::unreadable(path, message);
        let bytes =
            read_bounded(path, LARGEST_FILE).map_err(|error| unreadable(error.to_string()))?;
        let text = String::from_utf8(bytes).map_err(|error| unreadable(error.to_string()))?;
        Self::parse(&Source::new(&text, Some(path)), drawings)
    }

    /// Writes the scene as TOML text, which reads back as an equal scene.
    ///
    /// # Errors
    /// [`SceneErrorKind::Write`] if TOML cannot represent a value.
    pub fn to_toml(&self) -> Result<String, SceneError> {
        toml::to_string(self).map_err(|error| SceneError::unwritable(error.to_string()))
    }

    /// Returns the paths of the files from which the scene was read: its own file and that of its list of blocks.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let list = self.source.list().map(|list| list.path.as_path());
        self.source.path().into_iter().chain(list)
    }

    /// Returns the changes and omissions that were made when the drawing of the scene was read, in sentences.
    pub(crate) fn changes_of_drawing(&self) -> Vec<String> {
        let Some(list) = self.source.list() else { return Vec::new() };
        let name = list.path.file_name().unwrap_or(list.path.as_os_str()).to_string_lossy();
        let sentence =
            |it: &String| format!("Reading the drawing {name}: {}.", it.trim_end_matches(", ..."));
        list.changes.iter().map(sentence).collect()
    }

    pub(super) fn without_source(&self) -> Self {
        Self { source: Source::default(), ..self.clone() }
    }

    pub(super) fn parse(source: &Source, drawings: Option<Drawings>) -> Result<Self, SceneError> {
        let mut scene = Self { source: source.clone(), ..Self::of(source)? };
        if let Some(list) = &scene.block_list {
            let read = more_blocks(source.beside(list), &scene, drawings).map_err(|message| {
                let path = list.clone();
                Fault::new(KeyPath::of("block_list"), SceneErrorKind::BlockList { path, message })
                    .locate(&scene)
            })?;
            let source = source.with_list(read);
            scene = Self { source: source.clone(), ..Self::of(&source)? };
        }
        scene.check()?;
        Ok(scene)
    }

    /// Reads the scene of a source, together with the blocks of its list.
    pub(super) fn of(source: &Source) -> Result<Self, SceneError> {
        let mut scene: Self = toml::from_str(source.as_str()).map_err(|error| {
            // An error without a place, such as a missing key of the whole scene, is shown at the top.
            let span = error.span().unwrap_or(0..0);
            let mut message = error.message().to_owned();
            if let Some(line) = unclosed_above(source.as_str(), span.start) {
                let _ = write!(
                    message,
                    "; the list or table in brackets that begins in line {line} may lack its end"
                );
            }
            SceneError::syntax(&message, source.place(span), source.path())
        })?;
        if let Some(list) = source.list() {
            if list.entities.is_some() {
                let drawn: Drawn = toml::from_str(&list.text)
                    .map_err(|error| SceneError::syntax(error.message(), None, Some(&list.path)))?;
                scene.blocks.extend(drawn.blocks);
                scene.supports.extend(drawn.supports);
                scene.between.extend(drawn.between);
            } else {
                scene.blocks.extend(block_list::blocks(list)?);
            }
            scene.block_list = None;
        }
        Ok(scene)
    }
}

/// Finds the line of the last bracket that is not closed before a place, if the line is above the place. The parser
/// stops only at the next opening bracket, which may be many lines below the mistake. `None` if all of the text is
/// TOML.
fn unclosed_above(text: &str, place: usize) -> Option<usize> {
    DeTable::parse(text).err()?;
    let mut open = Vec::new();
    let before = text.get(..place)?;
    for (row, line) in before.lines().enumerate() {
        // The quotation mark that ends the current string; brackets inside a string do not count.
        let mut string = None;
        for letter in line.chars() {
            match letter {
                _ if string.is_some() => string = string.filter(|mark| *mark != letter),
                '#' => break,
                '"' | '\'' => string = Some(letter),
                '[' | '{' => open.push(row + 1),
                ']' | '}' => drop(open.pop()),
                _ => {}
            }
        }
    }
    let rows = 1 + before.matches('\n').count();
    open.pop().filter(|row| *row < rows)
}

/// Reads a file with more blocks: a JSON list, or a drawing if `drawings` is given. The error is the reason why the
/// file could not be read.
fn more_blocks(path: PathBuf, scene: &Scene, drawings: Option<Drawings>) -> Result<List, String> {
    let bytes = read_bounded(&path, LARGEST_FILE).map_err(|error| {
        format!("{error}: name a JSON list or a drawing, relative to the scene")
    })?;
    let begins = bytes.iter().find(|byte| !byte.is_ascii_whitespace());
    let Some(read) = drawings.filter(|_| begins != Some(&b'[')) else {
        let text =
            String::from_utf8(bytes).map_err(|error| format!("{error}: save it as UTF-8"))?;
        return Ok(List { path, text, entities: None, changes: Vec::new() });
    };
    let drawn = read(&path, &bytes, scene)?;
    let text = toml::to_string(&drawn).map_err(|error| error.to_string())?;
    Ok(List { path, text, entities: Some(drawn.places), changes: drawn.changes })
}
