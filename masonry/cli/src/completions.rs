//! `masonry completions`: scripts with which shells complete commands and options.

use clap::Args;
use clap_complete::Shell;

use crate::end::{Failure, SOLVED, print};

#[derive(Debug, Args)]
pub(super) struct CompletionsArgs {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the completion script for the given command definition.
pub(super) fn run(args: &CompletionsArgs, mut command: clap::Command) -> Result<u8, Failure> {
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command, name, &mut script);
    print(&String::from_utf8(script)?)?;
    Ok(SOLVED)
}
