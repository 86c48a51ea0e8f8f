//! Layers that a drawing does not show.

use super::pairs::Record;

/// The reason for which a layer is not shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Hidden {
    /// The layer is frozen: blocks that are inserted on the layer are not shown either.
    Frozen,
    Off,
}

impl Hidden {
    /// Returns the reason from the entry of a layer in the tables: a flag, or a negative colour. `None` if the layer is
    /// shown.
    pub(super) fn of(layer: &Record) -> Option<Self> {
        const FROZEN: i64 = 1;
        let is_off = layer.flags(62) < 0;
        if layer.flags(70) & FROZEN != 0 { Some(Self::Frozen) } else { is_off.then_some(Self::Off) }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Frozen => "frozen",
            Self::Off => "off",
        }
    }
}
