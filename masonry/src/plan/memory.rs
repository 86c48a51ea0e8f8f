//! Memory of the machine, which a plan may exceed.

/// The assumed memory of a machine whose memory is unknown \[10^9 bytes\].
const UNTOLD: f64 = 64.0;

/// A plan that does not fit into the memory of the machine.
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

/// Whether a number of bytes fits.
pub(super) fn fits(bytes: usize) -> Result<(), TooLarge> {
    let (gigabytes, limit) = (bytes as f64 / 1e9, of_machine().unwrap_or(UNTOLD));
    if gigabytes > limit { Err(TooLarge { gigabytes, limit }) } else { Ok(()) }
}

/// Memory of this machine \[10^9 bytes\], if it is known.
fn of_machine() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let total = text.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let kibibytes: f64 = total.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024.0 / 1e9)
}
