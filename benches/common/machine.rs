//! On what a bench was measured.

use std::process::Command;

/// On what it was measured, and when, as a sentence.
pub(crate) fn machine() -> String {
    format!("Measured on {}.\n", machine_and_date())
}

/// Processor, cores, compiler and date.
pub(crate) fn machine_and_date() -> String {
    let said = |program: &str, argument: &str| {
        let output = Command::new(program).arg(argument).output().ok()?;
        Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let unknown = || "unknown".to_owned();
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    // A bench bound to one core still names all of the machine.
    let cores = info.lines().filter(|line| line.starts_with("processor")).count();
    let threads = match std::thread::available_parallelism().map_or(1, usize::from) {
        1 => "one thread".to_owned(),
        several => format!("up to {several} threads"),
    };
    format!(
        "{}, {threads} on {cores} cores, {}, {}",
        model.map_or_else(unknown, |(_, name)| name.to_owned()),
        said("rustc", "--version").unwrap_or_else(unknown),
        said("date", "+%Y-%m-%d").unwrap_or_else(unknown),
    )
}
