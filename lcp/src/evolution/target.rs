//! The targets of steps, and the data that are kept while steps follow one another.

use crate::solve::Monitor;
use crate::states::Condensed;
use crate::vector::max_abs;
use crate::{Account, Contact2d, ContactState, Status};

/// The loads, gaps and slips without displacements of a problem, which change from step to step.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Data {
    pub(super) f: Vec<f64>,
    pub(super) x_0: Vec<f64>,
    pub(super) s_0: Vec<f64>,
}

impl Data {
    pub(super) fn of(problem: &Contact2d) -> Self {
        Self {
            f: problem.loads().to_vec(),
            x_0: problem.initial_gaps().to_vec(),
            s_0: problem.initial_slips().to_vec(),
        }
    }

    /// A part of the way to other data.
    pub(super) fn towards(&self, end: &Self, part: f64) -> Self {
        if part >= 1.0 {
            return end.clone();
        }
        let between = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| a + part * (b - a)).collect()
        };
        Self {
            f: between(&self.f, &end.f),
            x_0: between(&self.x_0, &end.x_0),
            s_0: between(&self.s_0, &end.s_0),
        }
    }
}

/// The target of a step.
#[derive(Clone, Copy)]
pub(super) struct Target<'a> {
    pub(super) problem: &'a Contact2d,
    /// The loads, gaps and slips at its end, in the place of those of the problem.
    pub(super) data: &'a Data,
    /// Its length; `None` leads to rest, whatever the mass.
    pub(super) h: Option<f64>,
}

/// The search for a solution without drag at the end of a step.
#[derive(Clone, Copy)]
pub(super) enum Rest {
    Never,
    /// From the states of the contacts at the end of the step.
    ByStates,
    /// From these states with more patience, and along the path of interior points.
    ByPath,
}

/// Whether a step was taken.
pub(super) enum Taken {
    /// The step was taken, with this account.
    Yes(Account),
    /// The step was taken, and the bodies rest at its end.
    Rests,
    /// The step was not taken: [`Status::Stalled`] if a shorter step may be, or a limit.
    No(Status),
}

/// The limits of steps that follow one another, and the plan of their factors.
pub(super) struct Course<'a, 'b> {
    pub(super) plan: Option<Condensed>,
    /// The number of factorisations after which no step begins.
    pub(super) last: usize,
    pub(super) monitor: &'a mut Monitor<'b>,
}

/// Sets gaps to zero that are within the tolerance of the largest displacement.
pub(super) fn close(state: &mut ContactState, tolerance: f64) {
    let least = tolerance * max_abs(&state.u);
    state.gap.iter_mut().filter(|gap| gap.abs() <= least).for_each(|gap| *gap = 0.0);
}
