//! The result of a trace.

use crate::{Basis, Status};

/// The ending of a trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ParametricEnd {
    /// The parameter has reached its last value.
    Reached,
    /// Nothing blocks after the last breakpoint: the solution continues along [`ParametricPath::ray`] without end.
    Ray,
    /// The path has turned back to the first value of the parameter.
    TurnedBack,
    /// No solution to start from: the status of the solve at the first value.
    NoStart(Status),
    /// The limit on breakpoints was reached.
    BreakpointLimit,
    /// The limit on wall-clock time was reached.
    TimeLimit,
    /// A basis was repeated.
    Cycle,
    /// Rounding errors are too large.
    NumericalTrouble,
}

/// A point of the path.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Breakpoint {
    /// Value of the parameter.
    pub lambda: f64,
    /// The first variable of every pair.
    pub t: Vec<f64>,
    /// The second variable of every pair.
    pub y: Vec<f64>,
}

/// The direction of an unbounded path.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ParametricRay {
    /// Rate of the parameter.
    pub dlambda: f64,
    /// Direction in `t`.
    pub dt: Vec<f64>,
    /// Direction in `y`.
    pub dy: Vec<f64>,
}

/// A piecewise linear path of solutions: between two consecutive breakpoints every point on the straight line solves
/// the problem for the parameter on that line.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ParametricPath {
    /// The ending of the trace.
    pub end: ParametricEnd,
    /// The breakpoints, from the first value of the parameter on. The parameter need not increase from one to the
    /// next: the path can turn back if the problem is not monotone, and the parameter is constant if the solutions
    /// for one value form a segment.
    pub breakpoints: Vec<Breakpoint>,
    /// The complementary basis between consecutive breakpoints, and after the last one if the path ends on a ray.
    pub bases: Vec<Basis>,
    /// The direction of the path if it is unbounded.
    pub ray: Option<ParametricRay>,
    /// The worst residual of all breakpoints, from the original data.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
    pub residual: f64,
}

impl ParametricPath {
    /// Every solution on the path for a value of the parameter, in order: none outside the traced values, several if
    /// the path turns back.
    pub fn solutions_at(&self, lambda: f64) -> Vec<Breakpoint> {
        let mut found: Vec<Breakpoint> = Vec::new();
        for pair in self.breakpoints.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            let (low, high) = (a.lambda.min(b.lambda), a.lambda.max(b.lambda));
            if !(low..=high).contains(&lambda) {
                continue;
            }
            let share = if high > low { (lambda - a.lambda) / (b.lambda - a.lambda) } else { 0.0 };
            let mix = |(a, b): (&f64, &f64)| (1.0 - share) * a + share * b;
            let t = a.t.iter().zip(&b.t).map(mix).collect();
            let point = Breakpoint { lambda, t, y: a.y.iter().zip(&b.y).map(mix).collect() };
            if found.last() != Some(&point) {
                found.push(point);
            }
        }
        if let ([only], []) = (self.breakpoints.as_slice(), found.as_slice())
            && only.lambda.total_cmp(&lambda).is_eq()
        {
            found.push(only.clone());
        }
        found
    }
}
