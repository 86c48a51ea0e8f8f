//! What the benches share.

use std::path::{Path, PathBuf};

/// Whether this is `cargo bench`: `cargo test --benches` runs the same programs without the flag.
pub(crate) fn is_bench() -> bool {
    is_asked("--bench")
}

/// Whether the command has this option.
pub(crate) fn is_asked(name: &str) -> bool {
    std::env::args().any(|argument| argument == name)
}

/// The folder of the repository, whichever crate the bench is of.
pub(crate) fn root() -> PathBuf {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = crates.ancestors().find(|it| it.join("docs").is_dir());
    root.expect("the documents are in the repository").to_owned()
}

/// With `-- --write`, puts the table between the marks of the bench in a file of the repository.
pub(crate) fn write_if_asked(file: &str, bench: &str, table: &str) {
    rewrite_if_asked(file, bench, |_| table.to_owned());
}

/// The same with a table that is made of the one before.
pub(crate) fn rewrite_if_asked(file: &str, bench: &str, table: impl FnOnce(&str) -> String) {
    if !is_asked("--write") {
        return;
    }
    let path = root().join(file);
    let marks =
        [format!("<!-- begin: bench {bench} -->\n"), format!("<!-- end: bench {bench} -->")];
    let text = std::fs::read_to_string(&path).expect("the file is part of the repository");
    let (start, rest) = text.split_once(&marks[0]).expect("the file has the first mark");
    let (before, end) = rest.split_once(&marks[1]).expect("the file has the second mark");
    let table = table(before);
    let text = format!("{start}{}{table}{}{end}", marks[0], marks[1]);
    std::fs::write(path, text).expect("the file can be written");
}
