//! The spread: the difference between the answers of two loadings, neither of which is more right than the other.

use serde::Serialize;

use crate::data::state::State;
use crate::model::Model;

/// Largest relative difference between two loadings at which the answer counts as unique. Chosen: engineers compare
/// widths of cracks to a few per cent.
const UNIQUE: f64 = 0.05;

/// The outcome of the second loading of a load history.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SecondLoading {
    /// The second loading reached its end; the differences from the first are given.
    Ended(Spread),
    /// The second loading stopped before its end, so that it is not known whether the answer is unique.
    Stopped {
        /// Number of steps that the second loading solved.
        solved: usize,
        /// Number of all steps of the second loading.
        steps: usize,
    },
}

/// The differences between the states at the ends of two loadings, relative to the state of the first: root mean
/// squares of all nodes, contacts and supports \[-\].
///
/// The second loading has a quarter of the steps in every stage, at least two, and is ten times as fast. Friction may
/// admit several equilibria, and the differences are the distance between two of them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Spread {
    /// Number of steps of the second loading.
    pub steps: usize,
    /// The relative difference of the displacements of all nodes.
    pub displacements: f64,
    /// The relative difference of the gaps of all contact points, which are the widths of cracks.
    pub openings: f64,
    /// The relative difference of the reactions.
    pub reactions: f64,
    /// The relative difference of the energy dissipated by friction.
    pub dissipation: f64,
}

/// The state at the end of a load history, of which some values are compared.
pub(crate) struct AtEnd<'a> {
    pub(crate) model: &'a Model,
    pub(crate) state: &'a State,
    pub(crate) dissipation: f64,
}

impl Spread {
    /// Computes the differences between two states of one structure, relative to the state `one`.
    pub(crate) fn of(one: &AtEnd<'_>, other: &AtEnd<'_>, steps: usize) -> Self {
        let displacements = |it: &AtEnd<'_>| -> Vec<f64> {
            it.state.displacements.iter().flatten().flat_map(|u| [u.x, u.y]).collect()
        };
        let openings = |it: &AtEnd<'_>| -> Vec<f64> {
            it.state.contacts.iter().map(|contact| contact.y_n).collect()
        };
        let reactions = |it: &AtEnd<'_>| -> Vec<f64> {
            let all = crate::recover::reactions(it.model, &it.state.contacts);
            all.iter().flat_map(|reaction| [reaction.fx, reaction.fy]).collect()
        };
        Self {
            steps,
            displacements: difference(&displacements(one), &displacements(other)),
            openings: difference(&openings(one), &openings(other)),
            reactions: difference(&reactions(one), &reactions(other)),
            dissipation: difference(&[one.dissipation], &[other.dissipation]),
        }
    }

    /// Returns the largest difference of the values that can be seen or measured: displacements, cracks and reactions.
    pub fn largest(&self) -> f64 {
        self.displacements.max(self.openings).max(self.reactions)
    }

    /// Whether both answers agree within five per cent, so that the answer counts as unique.
    pub fn is_unique(&self) -> bool {
        self.largest() <= UNIQUE
    }
}

/// Computes the norm of the differences of two lists, divided by the norm of the first list; zero if that is zero.
fn difference(one: &[f64], other: &[f64]) -> f64 {
    let squares = |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>();
    let size = squares(&mut one.iter().copied());
    let apart = squares(&mut one.iter().zip(other).map(|(a, b)| a - b));
    if size > 0.0 { (apart / size).sqrt() } else { 0.0 }
}
