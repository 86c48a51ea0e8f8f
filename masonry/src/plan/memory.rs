//! The memory of the machine, against which a plan is checked.

/// Memory \[10^9 bytes\] that is assumed if the memory of the machine is unknown.
const UNTOLD: f64 = 64.0;

/// The error of a plan that does not fit into the memory of the machine.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "about {gigabytes:.0} GB of memory would be needed, and this machine has {limit:.0} GB: use fewer elements or contact \
     points"
)]
pub struct TooLarge {
    /// Memory needed \[10^9 bytes\].
    pub gigabytes: f64,
    /// Memory of the machine \[10^9 bytes\].
    pub limit: f64,
}

/// Checks that a number of bytes fits into the memory of the machine.
pub(super) fn fits(bytes: usize) -> Result<(), TooLarge> {
    let (gigabytes, limit) = (bytes as f64 / 1e9, of_machine().unwrap_or(UNTOLD));
    if gigabytes > limit { Err(TooLarge { gigabytes, limit }) } else { Ok(()) }
}

/// Returns the memory of this machine \[10^9 bytes\]; `None` if it is unknown.
fn of_machine() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let total = text.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let kibibytes: f64 = total.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024.0 / 1e9)
}
