//! `masonry new`: commented scenes with which a user can begin.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};

use crate::end::{Failure, SOLVED, listing, print};
use masonry_live::beginnings::BEGINNINGS;

#[derive(Debug, Args)]
pub(super) struct NewArgs {
    /// The kind of scene.
    #[arg(value_parser = kinds())]
    kind: String,
    /// The file, which must not exist yet; by default the scene is printed.
    #[arg(long)]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &NewArgs) -> Result<u8, Failure> {
    let found = BEGINNINGS.into_iter().find(|it| it.name == args.kind);
    let text = found.ok_or("there is no scene of this kind")?.text;
    let Some(out) = &args.out else {
        print(text)?;
        return Ok(SOLVED);
    };
    // An existing file is not overwritten, since a user may have worked on it.
    let file = std::fs::OpenOptions::new().write(true).create_new(true).open(out);
    file.and_then(|mut file| file.write_all(text.as_bytes()))
        .map_err(|error| format!("cannot write {}: {error}; choose another name", out.display()))?;
    print(&listing(std::slice::from_ref(out)))?;
    Ok(SOLVED)
}

/// Returns the kinds of scenes with their descriptions.
fn kinds() -> PossibleValuesParser {
    PossibleValuesParser::new(BEGINNINGS.map(|it| PossibleValue::new(it.name).help(it.meaning)))
}
