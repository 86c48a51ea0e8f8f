//! The output directory of a run: checked before the work begins, used by one run at a time, and cleared of the files
//! of the last run of the same command.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::path::{Component, Path, PathBuf};

use crate::end::{Failure, names};
use masonry_report as report;

/// The name of the locked file, which lists the files that the last run of every command has written.
pub(super) const RECORD: &str = ".masonry.json";

/// Names of written files by the name of the command.
type Record = BTreeMap<String, BTreeSet<String>>;

/// An output directory into which no other run writes at the same time.
#[derive(Debug)]
pub(super) struct OutDir {
    path: PathBuf,
    command: &'static str,
    /// The locked file; the operating system unlocks it if the run is killed.
    file: File,
    record: Record,
    /// The names of files that this run has written, or from which it continues.
    claimed: BTreeSet<String>,
    /// The directories and the record that this run has created, the innermost first.
    made: Vec<PathBuf>,
    is_used: bool,
}

impl OutDir {
    /// Creates the directory if it does not exist, and locks it until the end of the run. The run continues from the
    /// file `from`, if one is given.
    pub(super) fn open(
        path: &Path,
        command: &'static str,
        from: Option<&str>,
    ) -> Result<Self, Failure> {
        let failed = |error: io::Error| {
            format!("cannot write into {}: {error}; choose another --out", path.display())
        };
        let missing = path.ancestors().filter(|it| !it.as_os_str().is_empty() && !it.exists());
        let mut made: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        fs::create_dir_all(path).map_err(failed)?;
        let record = path.join(RECORD);
        if !record.exists() {
            made.insert(0, record.clone());
        }
        let mut options = File::options();
        let mut file = options
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(record)
            .map_err(failed)?;
        match file.try_lock() {
            Ok(()) => {}
            // Some network file systems do not support locks.
            Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {}
            Err(TryLockError::Error(error)) => return Err(failed(error).into()),
            Err(TryLockError::WouldBlock) => {
                return Err(format!(
                    "another run is writing into {}: wait for its end, or choose another --out",
                    path.display()
                )
                .into());
            }
        }
        let mut text = String::new();
        file.read_to_string(&mut text).map_err(failed)?;
        // A run that was killed while it wrote the record has left an incomplete record, which counts as empty.
        let record: Record = serde_json::from_str(&text).unwrap_or_default();
        let (path, claimed) = (path.to_owned(), BTreeSet::new());
        let opened = Self { path, command, file, record, claimed, made, is_used: false };
        let foreign = opened.foreign(from);
        if foreign.is_empty() {
            return Ok(opened);
        }
        Err(format!(
            "{} in {} would be overwritten, and no earlier run has written there: move it away, or choose another --out",
            foreign.join(", "),
            opened.path.display()
        )
        .into())
    }

    /// Returns the existing files that have a name of an output file, but that no run has written.
    fn foreign(&self, from: Option<&str>) -> Vec<&'static str> {
        let is_own = |name: &str| {
            from == Some(name) || self.record.values().any(|names| names.contains(name))
        };
        let names = report::FILES.into_iter().filter(|name| !is_own(name));
        names.filter(|name| self.path.join(name).exists()).collect()
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Records a file as written by this run, before the file is written.
    pub(super) fn claim(&mut self, name: &str) -> Result<(), Failure> {
        if !self.claimed.insert(name.to_owned()) {
            return Ok(());
        }
        let mut record = self.record.clone();
        record.entry(self.command.to_owned()).or_default().insert(name.to_owned());
        self.write(&record)
    }

    /// Ends a run that has written the files `written`, and lists them on standard error. Other files of the last run
    /// of the same command are removed, or stay if `kept`.
    pub(super) fn finish(mut self, written: &[PathBuf], kept: bool) -> Result<(), Failure> {
        self.claimed.extend(names(written));
        let mut record = self.record.clone();
        let earlier = record.remove(self.command).unwrap_or_default();
        // A file that this run has written no longer belongs to another command.
        for names in record.values_mut() {
            names.retain(|name| !self.claimed.contains(name));
        }
        let (mut left, mut removed) = (Vec::new(), Vec::new());
        for name in earlier.into_iter().filter(|it| is_file_name(it) && !self.claimed.contains(it))
        {
            let path = self.path.join(&name);
            if path.exists() {
                let is_removed = !kept && fs::remove_file(path).is_ok();
                if is_removed { removed.push(name) } else { left.push(name) }
            }
        }
        for (names, what) in [(&removed, "removed"), (&left, "left")] {
            if !names.is_empty() {
                eprintln!(
                    "{what} in {}, of an earlier run: {}",
                    self.path.display(),
                    names.join(", ")
                );
            }
        }
        record.insert(self.command.to_owned(), self.claimed.iter().cloned().chain(left).collect());
        self.write(&record)
    }

    fn write(&mut self, record: &Record) -> Result<(), Failure> {
        self.is_used = true;
        let text = serde_json::to_string(record)?;
        let file = &mut self.file;
        file.set_len(0)
            .and_then(|()| file.rewind())
            .and_then(|()| file.write_all(text.as_bytes()))
            .map_err(|error| {
                format!("cannot write {}: {error}", self.path.join(RECORD).display()).into()
            })
    }
}

/// Removes the directories that the run has created if it ends before it has written anything.
impl Drop for OutDir {
    fn drop(&mut self) {
        if self.is_used {
            return;
        }
        for path in &self.made {
            // Other programs may have written into a directory in the meantime, so that errors are ignored.
            let _ = if path.is_dir() { fs::remove_dir(path) } else { fs::remove_file(path) };
        }
    }
}

/// Whether `name` is the name of a file in the directory itself, without further directories.
fn is_file_name(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None))
}
