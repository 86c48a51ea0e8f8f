//! The state of a contact, and its consequences for forces.

use std::ops::{Mul, Neg};

/// The state of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ContactStatus {
    /// No force.
    Open,
    /// No gap and, with friction, no slip.
    Stick,
    /// No gap, slip forwards against all friction, `t_t = -mu t_n`.
    Forwards,
    /// No gap, slip backwards against all friction, `t_t = mu t_n`.
    Backwards,
}

impl ContactStatus {
    /// Whether the state requires a gap of zero, and a slip of zero.
    pub(crate) fn is_closed(self, mu: f64) -> [bool; 2] {
        [self != Self::Open, self == Self::Stick && mu > 0.0]
    }

    /// The normal and the tangential force cut to those that the state allows.
    pub(crate) fn on_cone<T>(self, mu: f64, [t_n, t_t]: [T; 2]) -> [T; 2]
    where
        T: Copy + Default + Neg<Output = T> + Mul<f64, Output = T>,
    {
        match self {
            Self::Open => [T::default(); 2],
            Self::Stick => [t_n, t_t],
            Self::Forwards => [t_n, -(t_n * mu)],
            Self::Backwards => [t_n, t_n * mu],
        }
    }
}
