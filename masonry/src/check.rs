//! Checks of a state that use nothing of the method that found it.

use serde::Serialize;

/// Balances and violations, dimensionless, recomputed from the contact forces and the loads.
#[derive(Debug, Clone, Serialize)]
pub struct Checks {
    /// Largest unbalanced force of a block, relative to the largest of the total load and the
    /// largest contact force.
    pub force_balance: f64,
    /// Largest unbalanced moment of a block about its centroid, relative to the same force times
    /// the block's size.
    pub moment_balance: f64,
    /// Largest violation of `|t_t| <= mu t_n`, `t_n >= 0`, relative to the largest contact force.
    pub cone_violation: f64,
    /// Deepest interpenetration, relative to the largest displacement.
    pub penetration: f64,
    /// Number of open contact points.
    pub open: usize,
    /// Number of sticking contact points.
    pub stick: usize,
    /// Number of sliding contact points.
    pub slip: usize,
}
