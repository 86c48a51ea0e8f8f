//! What an enumeration may cost.

use std::time::Instant;

use crate::Error;
use crate::solve::is_over;

/// When it has to end, and how much it may find.
pub(super) struct Budget {
    pub(super) deadline: Option<Instant>,
    /// Number of vertices and rays.
    pub(super) generators: usize,
}

/// Why an enumeration ends early.
pub(super) enum Stop {
    Time,
    Limit(Error),
}

impl Budget {
    /// That there is time left, and that so many vertices and rays are not more than allowed.
    pub(super) fn check(&self, value: usize) -> Result<(), Stop> {
        let limit = self.generators;
        if value > limit {
            let what = "number of vertices and rays";
            return Err(Stop::Limit(Error::Limit { what, value, name: "max_generators", limit }));
        }
        if is_over(self.deadline) { Err(Stop::Time) } else { Ok(()) }
    }
}
