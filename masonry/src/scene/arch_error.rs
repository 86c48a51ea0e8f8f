//! Errors of arches.

/// A mistake in the data of an arch. Lengths are in units of the scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArchError {
    /// The rise of a segmental arch is larger than that of half a circle.
    #[error(
        "a rise of {rise} is more than that of half a circle of this span: give at most {largest}, or \
         `shape = \"pointed\"`"
    )]
    TooHigh {
        /// The given rise.
        rise: f64,
        /// The largest possible rise: half the span.
        largest: f64,
    },
    /// A pointed arch has no point at the crown.
    #[error(
        "an arch with a rise of {rise} is not pointed: a pointed arch of this span rises by more than {least}; give a \
         larger rise, or `shape = \"segmental\"`"
    )]
    TooLow {
        /// The given rise.
        rise: f64,
        /// The lower bound of the rise: half the span.
        least: f64,
    },
    /// A pointed arch has an odd number of voussoirs, so that one voussoir lies at the crown.
    #[error(
        "an odd number of voussoirs ({count}) puts one on the crown, and that voussoir is not convex: give an even \
         number, such as {even}"
    )]
    Odd {
        /// The given number of voussoirs.
        count: u32,
        /// The next even number.
        even: u32,
    },
    /// The ends of a joint coincide.
    #[error("the joint has no length, because both of its ends are [{x}, {y}]: move one of them")]
    NoLength {
        /// Coordinate x of both ends.
        x: f64,
        /// Coordinate y of both ends.
        y: f64,
    },
    /// A joint and the one before do not bound a convex voussoir, whose number, from 1, is given.
    #[error(
        "this joint and the one before bound no convex voussoir (number {0}): list joints from left to right, each \
         from the intrados to the extrados, such that no two cross"
    )]
    NoVoussoir(usize),
    /// A pier is too narrow for the springing.
    #[error("a pier {width} wide does not reach below the springing: give more than {least}")]
    NarrowPier {
        /// The given width of the pier.
        width: f64,
        /// The least width: the horizontal distance between the two ends of the springing.
        least: f64,
    },
    /// A springing, `left` or `right`, leans over the opening, so that it cannot rest on a pier.
    #[error(
        "piers need a springing that rises outwards from the intrados, and the {0} one does not: turn the {0} \
         joint of `lines`"
    )]
    Overhang(&'static str),
}
