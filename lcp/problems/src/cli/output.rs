//! The results and the output of commands.

use std::fmt::Write as _;
use std::io::{ErrorKind, Write};
use std::path::Path;

use lcp::Residuals;

pub(super) type Failure = Box<dyn std::error::Error>;

pub(super) const SOLVED: u8 = 0;
pub(super) const NOT_SOLVED: u8 = 1;
pub(super) const BAD_INPUT: u8 = 2;

/// The failure with the name of the file, which an error with a place in the file lacks.
pub(super) fn in_file(path: &Path, error: &dyn std::fmt::Display) -> Failure {
    let name = if path.as_os_str() == "-" { Path::new("standard input") } else { path };
    format!("{}: {error}", name.display()).into()
}

pub(super) fn residual_lines(residuals: &Residuals) -> String {
    let Residuals { equation, feasibility, complementarity, natural, loads } = residuals;
    let named = [
        ("equation", equation),
        ("feasibility", feasibility),
        ("complementarity", complementarity),
        ("natural", natural),
        ("loads", loads),
    ];
    named.iter().fold("residuals, relative to the data\n".to_owned(), |mut lines, (name, value)| {
        let _ = writeln!(lines, "  {name:<16} {value:.1e}");
        lines
    })
}

/// Prints the object as JSON, or the report for people.
pub(super) fn show(
    out: &mut dyn Write,
    is_json: bool,
    object: &impl serde::Serialize,
    report: impl FnOnce() -> String,
) -> Result<(), Failure> {
    print(out, &if is_json { serde_json::to_string(object)? + "\n" } else { report() })
}

/// Prints the text; a pipe that its reader has closed is not a failure.
pub(super) fn print(out: &mut dyn Write, text: &str) -> Result<(), Failure> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => Ok(other?),
    }
}
