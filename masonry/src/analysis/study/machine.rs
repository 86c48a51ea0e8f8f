//! The machine on which times are measured.

use std::thread::available_parallelism;

/// Describes the machine, for tables and pictures: the model of the processor, or its architecture if the model is
/// unknown, and the number of its threads.
///
/// ```
/// assert!(masonry::analysis::study::machine().contains("thread"));
/// ```
pub fn machine() -> String {
    let processor = model().unwrap_or_else(|| std::env::consts::ARCH.to_owned());
    match available_parallelism().map_or(1, std::num::NonZero::get) {
        1 => format!("{processor}, 1 thread"),
        threads => format!("{processor}, {threads} threads"),
    }
}

fn model() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("model name"))?;
    let name = line.split_once(':')?.1.split_whitespace().collect::<Vec<_>>().join(" ");
    (!name.is_empty()).then_some(name)
}
