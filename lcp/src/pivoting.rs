//! Records of the work of a pivoting method.

/// The ending of one attempt of a pivoting method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum AttemptEnd {
    /// The artificial variable left the basis.
    Complementary,
    /// No basic variable blocks the entering one.
    Ray,
    /// The limit on pivots was reached.
    PivotLimit,
    /// A basis was repeated.
    Cycle,
    /// The basis became singular to working precision.
    Singular,
    /// The observer stopped the attempt.
    Cancelled,
    /// The limit on wall-clock time was reached.
    TimeLimit,
}

/// The start basis of an attempt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum AttemptStart {
    /// The basis of the settings, or the basis of the point of the settings.
    Given,
    /// All `y`.
    AllY,
    /// All `t`.
    AllT,
    /// A basis that the solver found.
    Found,
    /// The basis on which the last attempt ended.
    LastBasis,
    /// The first basis after exchanges of pairs drawn at random.
    Flipped {
        /// Seed of the generator.
        seed: u64,
    },
}

impl std::fmt::Display for AttemptStart {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Given => f.write_str("given"),
            Self::AllY => f.write_str("all y"),
            Self::AllT => f.write_str("all t"),
            Self::Found => f.write_str("found"),
            Self::LastBasis => f.write_str("last basis"),
            Self::Flipped { seed } => write!(f, "flipped, seed {seed}"),
        }
    }
}

/// The covering vector of an attempt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum AttemptCovering {
    /// All ones after equilibration.
    Ones,
    /// Ones, increased by up to one for negative values of the start basis (by one for the lowest): the path
    /// begins near the right-hand side of the problem.
    Negative,
    /// Pseudo-random.
    Random {
        /// Seed of the generator.
        seed: u64,
    },
    /// The covering vector of the settings.
    Given,
    /// The column of the nonbasic variable of a pair, which replaces the artificial one (Lemke and Howson 1964).
    Column {
        /// The pair, from 0.
        pair: usize,
    },
}

impl std::fmt::Display for AttemptCovering {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ones => f.write_str("ones"),
            Self::Negative => f.write_str("negative values"),
            Self::Random { seed } => write!(f, "random, seed {seed}"),
            Self::Given => f.write_str("given"),
            Self::Column { pair } => write!(f, "column of pair {pair}"),
        }
    }
}

/// One attempt: its start, its covering vector, and its ending.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Attempt {
    /// The start basis.
    pub start: AttemptStart,
    /// The covering vector.
    pub covering: AttemptCovering,
    /// The ending of the attempt.
    pub end: AttemptEnd,
    /// Number of its pivots.
    pub pivots: usize,
    /// The worst residual of its complementary basis, if the attempt ended on a basis that could be solved.
    pub residual: Option<f64>,
}

/// A variable of the pivoting method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Variable {
    /// The first variable of a pair.
    T(usize),
    /// The second variable of a pair.
    Y(usize),
    /// The artificial variable.
    Artificial,
}

/// One pivot.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct PivotRecord {
    /// The attempt, from 1.
    pub attempt: usize,
    /// The variable that became basic.
    pub entering: Variable,
    /// The variable that left the basis.
    pub leaving: Variable,
    /// Value of the entering variable after the pivot, in equilibrated units.
    pub step: f64,
    /// Value of the artificial variable after the pivot, relative to its first one.
    pub artificial: f64,
}
