//! What the benches share.

use std::path::Path;
use std::process::Command;

/// Whether this is `cargo bench`: `cargo test --benches` runs the same programs without the flag.
pub(crate) fn is_bench() -> bool {
    std::env::args().any(|argument| argument == "--bench")
}

/// With `-- --write`, puts the table between the marks of the bench in a file of the repository.
pub(crate) fn write_if_asked(file: &str, bench: &str, table: &str) {
    if !std::env::args().any(|argument| argument == "--write") {
        return;
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let marks =
        [format!("<!-- begin: bench {bench} -->\n"), format!("<!-- end: bench {bench} -->")];
    let text = std::fs::read_to_string(&path).expect("the file is part of the repository");
    let (before, rest) = text.split_once(&marks[0]).expect("the file has the first mark");
    let (_, after) = rest.split_once(&marks[1]).expect("the file has the second mark");
    let text = format!("{before}{}{table}{}{after}", marks[0], marks[1]);
    std::fs::write(path, text).expect("the file can be written");
}

/// On what it was measured, and when.
pub(crate) fn machine() -> String {
    let said = |program: &str, argument: &str| {
        let output = Command::new(program).arg(argument).output().ok()?;
        Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let unknown = || "unknown".to_owned();
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let cores = std::thread::available_parallelism().map_or_else(|_| unknown(), |n| n.to_string());
    format!(
        "Measured on {}, {cores} cores of which one is used, {}, {}.\n",
        model.map_or_else(unknown, |(_, name)| name.to_owned()),
        said("rustc", "--version").unwrap_or_else(unknown),
        said("date", "+%Y-%m-%d").unwrap_or_else(unknown),
    )
}
