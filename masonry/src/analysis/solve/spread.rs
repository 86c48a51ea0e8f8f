//! A second loading of a load history, and how far its answer is from that of the first.

use std::ops::ControlFlow;

use super::{Event, Run, SolveError};
use crate::history::spread::{Reached, Spread};
use crate::scene::Scene;

/// How much faster the second loading is: the part of the loads that its drag may carry, by that of the first. Chosen: far
/// enough to matter, and still slow.
const FASTER: f64 = 10.0;

impl Run {
    /// Loads the scene a second time, with half as many steps in every stage (two of a stage of one) and ten times as fast, and
    /// keeps how far the two answers [differ](Spread). Nothing is done for a scene of one step, if steps of it are not solved,
    /// or if the second loading does not come to its end.
    ///
    /// # Errors
    /// As [`solve`](super::solve).
    pub fn compare(
        &mut self,
        scene: &Scene,
        observer: &mut dyn FnMut(Event) -> ControlFlow<()>,
    ) -> Result<(), SolveError> {
        if !self.has_history() || self.solved_steps() < self.steps() {
            return Ok(());
        }
        let mut scene = scene.clone();
        for stage in &mut scene.stages {
            stage.steps = if stage.steps == 1 { 2 } else { stage.steps / 2 };
        }
        let mut other = Self::new(&scene, observer)?;
        other.request.slowness *= FASTER;
        while other.advance(observer)? {}
        let reached = |run: &Self| {
            let (model, state) = run.at_end()?;
            Some((model.clone(), state.clone(), run.dissipation()))
        };
        let all = other.solved_steps() == other.steps();
        if let (true, Some(one), Some(two)) = (all, reached(self), reached(&other)) {
            let [one, two] = [&one, &two].map(|(model, state, dissipation)| Reached {
                model,
                state,
                dissipation: *dissipation,
            });
            self.spread = Some(Spread::of(&one, &two, other.steps()));
        }
        Ok(())
    }
}
