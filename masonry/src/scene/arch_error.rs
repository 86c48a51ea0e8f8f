//! Errors of arches.

/// A mistake in an arch. Lengths are in units of the scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArchError {
    /// The rise of a segmental arch is larger than that of half a circle.
    #[error(
        "a rise of {rise} is more than that of half a circle of this span: give at most {largest}, or \
         `shape = \"pointed\"`"
    )]
    TooHigh {
        /// The rise.
        rise: f64,
        /// Half the span.
        largest: f64,
    },
    /// A pointed arch has no point at the crown.
    #[error(
        "an arch with a rise of {rise} is not pointed: a pointed arch of this span rises by more than {least}; give a \
         larger rise, or `shape = \"segmental\"`"
    )]
    TooLow {
        /// The rise.
        rise: f64,
        /// Half the span.
        least: f64,
    },
    /// A pointed arch has a voussoir at the crown.
    #[error(
        "an odd number of voussoirs ({count}) puts one on the crown, and that voussoir is not convex: give an even \
         number, such as {even}"
    )]
    Odd {
        /// The number of voussoirs.
        count: u32,
        /// The next even number.
        even: u32,
    },
    /// The ends of a joint coincide.
    #[error("the joint has no length, because both of its ends are [{x}, {y}]: move one of them")]
    NoLength {
        /// Coordinate of the ends.
        x: f64,
        /// Coordinate of the ends.
        y: f64,
    },
    /// Two joints bound no voussoir, whose number is given, from 1.
    #[error(
        "this joint and the one before bound no convex voussoir (number {0}): list joints from left to right, each \
         from the intrados to the extrados, such that no two cross"
    )]
    NoVoussoir(usize),
    /// The springing has no room on a pier.
    #[error("a pier {width} wide does not reach below the springing: give more than {least}")]
    NarrowPier {
        /// Width of the pier.
        width: f64,
        /// The distance of the springing's far end from the end of the intrados.
        least: f64,
    },
    /// A springing, `left` or `right`, leans over the opening.
    #[error(
        "piers need a springing that rises outwards from the intrados, and the {0} one does not: turn the {0} \
         joint of `lines`"
    )]
    Overhang(&'static str),
}
