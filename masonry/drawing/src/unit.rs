//! Units of drawings.

use std::fmt;

/// A unit of length of a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Millimetre.
    Millimetre,
    /// Centimetre.
    Centimetre,
    /// Metre.
    Metre,
    /// Inch.
    Inch,
    /// Foot.
    Foot,
    /// Kilometre.
    Kilometre,
}

impl Unit {
    /// All units, from the smallest.
    pub const ALL: [Self; 6] =
        [Self::Millimetre, Self::Centimetre, Self::Inch, Self::Foot, Self::Metre, Self::Kilometre];

    /// Returns the length of the unit in metres.
    pub fn metres(self) -> f64 {
        match self {
            Self::Millimetre => 1e-3,
            Self::Centimetre => 1e-2,
            Self::Metre => 1.0,
            Self::Inch => 0.0254,
            Self::Foot => 0.3048,
            Self::Kilometre => 1e3,
        }
    }

    /// Returns the symbol of the unit.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Metre => "m",
            Self::Inch => "in",
            Self::Foot => "ft",
            Self::Kilometre => "km",
        }
    }

    /// Returns the unit with this symbol; `None` for an unknown symbol.
    pub fn of_symbol(symbol: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.symbol() == symbol)
    }

    /// Returns the unit with this number in `$INSUNITS` of a DXF file; `None` for an unknown number.
    pub(super) fn of_dxf(number: i64) -> Option<Self> {
        match number {
            1 => Some(Self::Inch),
            2 => Some(Self::Foot),
            4 => Some(Self::Millimetre),
            5 => Some(Self::Centimetre),
            6 => Some(Self::Metre),
            7 => Some(Self::Kilometre),
            _ => None,
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}
