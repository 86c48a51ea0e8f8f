//! Files: reading up to a largest size, and writing that leaves no partial file.

use std::ffi::OsString;
use std::io::Read;
use std::path::Path;
use std::{fs, io};

/// Writes a file under a temporary name and then renames it, so that no reader finds a part of the file.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut temporary = OsString::from(path);
    temporary.push(format!(".{}.tmp", std::process::id()));
    let result = fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, path));
    if result.is_err() {
        // The first error is the one to report.
        let _ = fs::remove_file(&temporary);
    }
    result
}

/// Reads a file of at most `largest` bytes. Devices and pipes are refused, since reading them may never begin or end.
///
/// # Errors
/// The message of the operating system, or an error if the path is not a file or the file is too large.
pub fn read_bounded(path: &Path, largest: usize) -> io::Result<Vec<u8>> {
    // A pipe must not even be opened, since opening waits for a writer.
    let metadata = fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if !metadata.is_file() {
        return Err(io::Error::other("it is a device or a pipe, and not a file"));
    }
    let mut bytes = Vec::new();
    // One more byte than is allowed shows that the file is too large.
    fs::File::open(path)?.take(largest as u64 + 1).read_to_end(&mut bytes)?;
    if bytes.len() > largest {
        let message = format!("the file is larger than {} MB", largest >> 20);
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}
