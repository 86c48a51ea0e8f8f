//! The scene of a text, which may name another file of its directory as its list of blocks.

use std::fs;
use std::path::{Component, Path, PathBuf};

use masonry::Scene;
use masonry::scene::SceneError;

use super::fault::{Fault, SCENE};
use super::text::Text;

/// The longest text of a scene \[bytes\]. Chosen: the text of a wall of 10 000 single blocks.
pub const LONGEST_TEXT: usize = 4 << 20;
/// The largest file with a list of blocks \[bytes\]. Chosen: a block takes several times as much space in a drawing as
/// in a scene.
const LARGEST_LIST: u64 = 16 << 20;

/// A function that reads a scene from its text and the path that its file would have.
pub type ReadScene = fn(&str, &Path) -> Result<Scene, SceneError>;

/// The directory of a scene, and the function that reads a scene which names files of this directory.
#[derive(Debug, Clone)]
pub struct Files {
    directory: PathBuf,
    read: ReadScene,
}

impl Files {
    /// Creates the files of a directory; `read` reads a scene that names one of them.
    pub fn new(directory: &Path, read: ReadScene) -> Self {
        // The directory of a path without directories is the current one.
        let here = directory.as_os_str().is_empty();
        let directory = if here { Path::new(".") } else { directory };
        Self { directory: directory.to_owned(), read }
    }

    /// Refuses a list of blocks that is too large, or outside the directory (a link counts as the file to which it
    /// leads). The reader reports other mistakes.
    fn check(&self, list: &str) -> Result<(), String> {
        let is_inner = |it| matches!(it, Component::Normal(_) | Component::CurDir);
        let path = self.directory.join(list);
        let real = [&self.directory, &path].map(|it| fs::canonicalize(it).ok());
        let is_inside = match real {
            [Some(directory), Some(file)] => file.starts_with(directory),
            _ => true,
        };
        if !is_inside || !Path::new(list).components().all(is_inner) {
            return Err(format!(
                "{list} is not in the directory of the scene, and the page reads no file elsewhere: copy it there"
            ));
        }
        let bytes = fs::metadata(&path).map_or(0, |it| it.len());
        if bytes > LARGEST_LIST {
            return Err(format!(
                "{list} has {bytes} bytes, and the page reads at most {LARGEST_LIST}: use `masonry solve`"
            ));
        }
        Ok(())
    }
}

/// Reads the scene of a text. A list of blocks is read only with `files`.
pub(super) fn scene(text: &str, files: Option<&Files>) -> Result<Scene, Fault> {
    if text.len() > LONGEST_TEXT {
        let message = format!(
            "the text has {} bytes, and the page treats at most {LONGEST_TEXT}: solve it with `masonry solve`",
            text.len()
        );
        return Err(Fault::new(&message));
    }
    let read = Text::read(text);
    let Some(list) = read.get("block_list") else { return Ok(Scene::from_toml(text)?) };
    let line = read.line(list.span().start);
    let refused = |message: &str| Fault {
        message: format!("block_list: {message}"),
        line: Some(line),
        column: Some(1),
    };
    let Some(files) = files else {
        return Err(refused(
            "this page cannot read files: open the scene with `masonry live`, or put the blocks into it as [[blocks]]",
        ));
    };
    files.check(list.get_ref().as_str().unwrap_or_default()).map_err(|it| refused(&it))?;
    Ok((files.read)(text, &files.directory.join(SCENE))?)
}
