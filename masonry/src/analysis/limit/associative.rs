//! The limit load of associated flow: a linear program, which gives a lower and an upper bound.

use nalgebra::Vector2;
use serde::Serialize;

use super::watch::Watch;
use super::{LimitError, LoadedStructure, NOTHING};
use crate::data::state::{PointState, Reaction};
use crate::data::statics::Statics;
use crate::method::statics;
use crate::method::statics::limit::Growing;
use crate::model::Model;
use crate::recover;
use crate::verify::moving::moving;

/// The outcome of a limit analysis of a structure under a growing group of loads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
pub enum Answer {
    /// There is a largest load factor, at which the structure fails.
    #[serde(rename = "fails")]
    Fails,
    /// Forces within friction balance the loads at every load factor.
    #[serde(rename = "does not fail")]
    Unlimited,
    /// The structure falls without the group: no forces within friction balance the other loads.
    #[serde(rename = "falls without the group")]
    Falls,
    /// Neither a limit load nor a proof of one of the other answers was found.
    #[serde(rename = "undecided")]
    Undecided,
}

/// The limit load of associated flow, which is the limit of ideal plasticity and an upper bound for Coulomb's friction.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Associative {
    /// The outcome of the analysis by associated flow.
    pub answer: Answer,
    /// The largest load factor \[-\] for which forces were found that balance the loads; `None` if there is no such
    /// factor.
    pub load_factor: Option<f64>,
    /// The smallest load factor \[-\] at which it is proved that no forces balance the loads; `None` if none is known.
    pub bound: Option<f64>,
    /// Whether the answer is proved by forces and a motion, recomputed from the geometry, whose load factors are almost
    /// equal.
    pub proved: bool,
    /// The forces under [`load_factor`](Self::load_factor) at all contact points; gaps and slips are zero.
    pub forces: Option<Vec<PointState>>,
    /// The reactions of the supports under [`load_factor`](Self::load_factor), to the same `forces`.
    pub reactions: Vec<Reaction>,
    /// The scale of load factors \[-\]: the factor at which the growing loads are as large as the others, or
    /// [`load_factor`](Self::load_factor) if that is larger.
    pub(super) size: f64,
    /// The motion that proves the bound: displacement rates of the corners of every block, scaled to a largest
    /// component of one.
    pub mechanism: Option<Vec<Vec<Vector2<f64>>>>,
    /// The load factors of the rest of the structure while the blocks of the mechanism are held. `None` if the
    /// mechanism moves several blocks and more than a tenth of all, or if the group does not act on the rest.
    pub rest: Option<Rest>,
}

/// The load factors \[-\] of a structure in which some blocks are held.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rest {
    /// The largest load factor for which forces were found that balance the loads on the other blocks.
    pub load_factor: Option<f64>,
    /// The smallest load factor at which a motion proves that no forces balance the loads on the other blocks.
    pub bound: Option<f64>,
}

impl Associative {
    fn new(answer: Answer, proved: bool) -> Self {
        Self {
            answer,
            load_factor: None,
            bound: None,
            proved,
            forces: None,
            reactions: Vec::new(),
            size: 0.0,
            mechanism: None,
            rest: None,
        }
    }

    /// Whether it is proved that the structure carries no part of the group, up to rounding errors.
    pub fn carries_nothing(&self) -> bool {
        self.proved && self.bound.is_some_and(|bound| bound <= NOTHING * self.size)
    }

    fn with_forces(self, model: &Model, forces: Option<Vec<PointState>>) -> Self {
        let reactions =
            forces.as_ref().map_or_else(Vec::new, |forces| recover::reactions(model, forces));
        Self { forces, reactions, ..self }
    }
}

pub(super) fn of(
    structure: &LoadedStructure<'_>,
    growth: &[f64],
    watch: &mut Watch<'_>,
) -> Result<Associative, LimitError> {
    let (model, system) = structure.system(1.0, 0.0)?;
    let at_zero = statics::decide(&model, &system, &mut watch.steps())?.statics;
    if let Statics::Impossible(proof) = at_zero {
        let answer = Associative::new(Answer::Falls, true);
        return Ok(Associative { mechanism: Some(proof.rates), ..answer });
    }
    let at = |factor| structure.under(1.0, factor);
    let growing = Growing { at: &at, system: &system, growth, held: &[] };
    let bounds = growing.largest(&mut watch.steps())?;
    if bounds.above.is_none() {
        // If some forces carry the group alone without any strength, any multiple of these forces can be added.
        let mut alone = structure.under(0.0, 1.0);
        alone.remove_strength();
        let system = crate::system::System::without_factors(&alone)?;
        let alone = statics::decide(&alone, &system, &mut watch.steps())?.statics;
        if let (Statics::Admissible(_), Statics::Admissible(forces)) = (alone, &at_zero) {
            let forces = recover::forces_at_rest(&model, forces);
            return Ok(Associative::new(Answer::Unlimited, true).with_forces(&model, Some(forces)));
        }
    }
    let (proved, size) = (bounds.is_closed(), bounds.size);
    let answer = if proved { Answer::Fails } else { Answer::Undecided };
    let (load_factor, forces) = bounds.below.unzip();
    let (bound, proof) = bounds.above.unzip();
    let forces = forces.map(|forces| recover::forces_at_rest(&model, &forces));
    let found = Associative::new(answer, proved).with_forces(&model, forces);
    let mechanism = proof.map(|proof| proof.rates);
    let held = mechanism.as_ref().map(|rates| moving(rates));
    // The rest of the structure carries any load factor if the group does not act on it.
    let is_pushed = |held: &Vec<bool>| {
        let on_rest = growth.chunks(3).zip(held).filter(|(_, held)| !**held);
        on_rest.flat_map(|(growth, _)| growth).any(|force| force.abs() > 0.0)
    };
    let rest = match held.filter(|held| is_small_part(held) && is_pushed(held)) {
        Some(held) => {
            let bounds = Growing { held: &held, ..growing }.largest(&mut watch.steps())?;
            let load_factor = bounds.below.map(|(factor, _)| factor);
            Some(Rest { load_factor, bound: bounds.above.map(|(factor, _)| factor) })
        }
        None => None,
    };
    Ok(Associative { load_factor, bound, size, mechanism, rest, ..found })
}

/// The largest share of all blocks that move in a partial mechanism, unless only one block moves. Chosen: a larger
/// share is a collapse.
const SMALL_PART: f64 = 0.1;

fn is_small_part(moving: &[bool]) -> bool {
    let count = moving.iter().filter(|moves| **moves).count();
    moving.len() > 1 && (count == 1 || count as f64 <= SMALL_PART * moving.len() as f64)
}
