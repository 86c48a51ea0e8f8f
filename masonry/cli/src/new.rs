//! `masonry new`: commented scenes to begin with.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::end::{Failure, SOLVED, listing, print};

/// The kinds of new scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// A wall of rigid bricks with a window, pushed to the side.
    Wall,
    /// A segmental arch on piers with a load on its crown.
    Arch,
    /// An elastic panel between rigid walls.
    Panel,
    /// A wall with a door and a beam above it.
    Door,
}

#[derive(Debug, Args)]
pub(super) struct NewArgs {
    /// The kind of scene.
    #[arg(value_enum)]
    kind: Kind,
    /// The file, which must not exist yet; by default the scene is printed.
    #[arg(long)]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &NewArgs) -> Result<u8, Failure> {
    let text = match args.kind {
        Kind::Wall => include_str!("new/wall.toml"),
        Kind::Arch => include_str!("new/arch.toml"),
        Kind::Panel => include_str!("new/panel.toml"),
        Kind::Door => include_str!("new/door.toml"),
    };
    let Some(out) = &args.out else {
        print(text)?;
        return Ok(SOLVED);
    };
    // A scene that somebody has worked on is not overwritten.
    let file = std::fs::OpenOptions::new().write(true).create_new(true).open(out);
    file.and_then(|mut file| file.write_all(text.as_bytes()))
        .map_err(|error| format!("cannot write {}: {error}; choose another name", out.display()))?;
    print(&listing(std::slice::from_ref(out)))?;
    Ok(SOLVED)
}
