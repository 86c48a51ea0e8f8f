//! The progress of the pivots.

/// The progress of a solve of [`Lemke`](crate::Lemke), for an observer.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// The attempt, from 1.
    pub attempt: usize,
    /// Pivots of this attempt.
    pub pivots: usize,
    /// Order of the problem.
    pub order: usize,
    /// Value of the artificial variable, relative to its first one: 1 before it enters, and in attempts in which
    /// the variable of a pair replaces it.
    pub artificial: f64,
}
