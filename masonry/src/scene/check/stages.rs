//! Checks of the load history, and of combinations.

use super::{Check, at_least_one, at_most, finite, not_negative, unwanted, value};
use crate::scene::rules::unknown;
use crate::scene::{Combination, Fault, KeyPath, LoadError, OPPOSITE, Scene, Stage};

/// Largest rotation of a support \[rad\]; at this rotation the normals of its joints are off by a tenth.
const LARGEST_TURN: f64 = 0.1;
/// Largest number of steps of one stage.
const MOST_STEPS: u32 = 100_000;
/// Largest number of combinations of a scene. Chosen: more than codes require, and each is an analysis of its own.
const MOST_COMBINATIONS: u32 = 1000;

impl Scene {
    /// Checks a stage: its loads and supports exist, and its numbers are in their ranges.
    pub(super) fn check_stage(&self, at: &KeyPath, stage: &Stage) -> Check {
        let steps = at.key("steps");
        at_least_one(steps.clone(), stage.steps, "a stage has at least one step")?;
        at_most(steps, "steps of one stage", f64::from(stage.steps), MOST_STEPS)?;
        if let Some(factor) = stage.gravity {
            let because = "is a factor of the gravity of the scene, which has none";
            let otherwise = ", or add `gravity` to the scene";
            unwanted(self.gravity.is_none(), at, "gravity", because, otherwise)?;
            finite(at.key("gravity"), factor)?;
        }
        self.check_factors(&at.key("loads"), &stage.loads)?;
        let supports = self.all_supports();
        for (name, to) in &stage.moves {
            let at = at.key("moves").key(name);
            if !supports.iter().any(|support| support.name == *name) {
                let known = supports.iter().map(|support| support.name.clone()).collect();
                let missing = "it under [[supports]]".to_owned();
                return Err(unknown(at, "support", name, known, missing));
            }
            finite(at.key("x"), to.x)?;
            finite(at.key("y"), to.y)?;
            finite(at.key("turn"), to.turn)?;
            let wanted = "displacements are small: a support turns by at most 0.1 rad";
            value(at.key("turn"), to.turn, to.turn.abs() <= LARGEST_TURN, wanted)?;
        }
        Ok(())
    }

    /// Checks a combination: it has a name, its loads exist, and its numbers are in their ranges.
    pub(super) fn check_combination(&self, at: &KeyPath, combination: &Combination) -> Check {
        let count = self.combinations.len() as f64;
        at_most(KeyPath::of("combinations"), "combinations", count, MOST_COMBINATIONS)?;
        if combination.name.ends_with(OPPOSITE) {
            let error = LoadError::Opposite(combination.name.clone());
            return Err(Fault::new(at.key("name"), error));
        }
        not_negative(at.key("gravity"), combination.gravity)?;
        self.check_factors(&at.key("loads"), &combination.loads)
    }
}
