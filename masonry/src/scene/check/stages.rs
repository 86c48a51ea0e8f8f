//! Checks of the load history.

use super::{Check, finite, too_many, unique, unknown, unwanted, value};
use crate::scene::{KeyPath, Scene, Stage};

/// Rotation of a support \[rad\] at which its joints' normals are off by a tenth.
const LARGEST_TURN: f64 = 0.1;
/// Steps of one stage, at most.
const MOST_STEPS: u32 = 100_000;

impl Scene {
    /// Stages: names of their own, loads and supports that exist, numbers in their range.
    pub(super) fn check_stages(&self) -> Check {
        unique("stage", "stages", self.stages.iter().map(|stage| &stage.name))?;
        for (k, stage) in self.stages.iter().enumerate() {
            self.check_stage(&KeyPath::of("stages").item(k), stage)?;
        }
        Ok(())
    }

    fn check_stage(&self, at: &KeyPath, stage: &Stage) -> Check {
        let (key, steps) = (at.key("steps"), stage.steps);
        value(key.clone(), f64::from(steps), steps > 0, "a stage has at least one step")?;
        if steps > MOST_STEPS {
            return Err(too_many(key, "steps of one stage", f64::from(steps), MOST_STEPS));
        }
        if let Some(factor) = stage.gravity {
            if self.gravity.is_none() {
                let because = "is a factor of the gravity of the scene, which has none";
                return Err(unwanted(at, "gravity", because, ", or add `gravity` to the scene"));
            }
            finite(at.key("gravity"), factor)?;
        }
        self.check_stage_loads(&at.key("loads"), stage)?;
        for (name, to) in &stage.moves {
            let at = at.key("moves").key(name);
            let supports = self.all_supports();
            there_is("support", "supports", name, supports.iter().map(|it| &it.name), &at)?;
            finite(at.key("x"), to.x)?;
            finite(at.key("y"), to.y)?;
            finite(at.key("turn"), to.turn)?;
            let wanted = "displacements are small: a support turns by at most 0.1 rad";
            value(at.key("turn"), to.turn, to.turn.abs() <= LARGEST_TURN, wanted)?;
        }
        Ok(())
    }
}

fn there_is<'a>(
    what: &'static str,
    table: &'static str,
    name: &str,
    names: impl Iterator<Item = &'a String>,
    at: &KeyPath,
) -> Check {
    let known: Vec<String> = names.cloned().collect();
    if known.iter().any(|known| known == name) {
        return Ok(());
    }
    Err(unknown(at.clone(), what, name, known, table))
}
