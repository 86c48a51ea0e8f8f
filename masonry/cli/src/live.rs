//! `masonry live`: the page that solves a scene while its text is changed.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use clap::Args;

use crate::end::{Failure, print};
use masonry_live::server::{Desk, Server};

#[derive(Debug, Args)]
pub(super) struct LiveArgs {
    /// The scene file (TOML); the page begins with a choice of scenes if there is none.
    scene: Option<PathBuf>,
    /// Print the address of the page, and open no browser.
    #[arg(long)]
    no_browser: bool,
}

pub(super) fn run(args: &LiveArgs) -> Result<u8, Failure> {
    let desk = match &args.scene {
        Some(scene) => Desk::with_scene(scene)?,
        None => Desk::empty(Path::new("")),
    };
    let server = Server::new(desk)?;
    let address = server.address();
    print(&format!("{address}\nthe page is open to this machine alone; Ctrl-C ends it\n"))?;
    if !args.no_browser && !is_opened(&address) {
        eprintln!("no browser could be opened: open the address in one");
    }
    server.run()
}

/// Opens an address in the user's browser; `false` if the system has no browser.
fn is_opened(address: &str) -> bool {
    let (program, before): (&str, &[&str]) = if cfg!(target_os = "windows") {
        ("rundll32", &["url.dll,FileProtocolHandler"])
    } else if cfg!(target_os = "macos") {
        ("open", &[])
    } else {
        ("xdg-open", &[])
    };
    let mut command = Command::new(program);
    command
        .args(before)
        .arg(address)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.spawn().is_ok()
}
