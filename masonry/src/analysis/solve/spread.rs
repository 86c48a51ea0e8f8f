//! The second loading of a load history, and the differences of its answer from that of the first.

use std::ops::ControlFlow;

use super::{Event, Run, SolveError};
use crate::history::{SecondLoading, Spread};
use crate::scene::Scene;

/// Ratio of the speeds of the second and the first loading: the drag of the second may carry this many times as large a
/// part of the loads. Chosen: large enough to matter, and still slow.
const FASTER: f64 = 10.0;

/// Ratio of the numbers of steps of the first and the second loading. Chosen: the answers of twenty and of eighty steps
/// differ by less than those of the two loadings (docs/scaling.md), and the second loading takes half the time of the
/// first.
const COARSER: u32 = 4;

impl Run {
    /// Loads the scene a second time, ten times as fast and with a quarter of the steps in every stage (at least two),
    /// and keeps the [outcome](SecondLoading). Does nothing for a scene of one step, or if some steps are not solved.
    ///
    /// # Errors
    /// As [`Run::new`]. If a step of the second loading fails, that loading stops there without an error.
    pub fn compare(
        &mut self,
        scene: &Scene,
        observer: &mut dyn FnMut(Event) -> ControlFlow<()>,
    ) -> Result<(), SolveError> {
        let Some(end) = self.at_end() else { return Ok(()) };
        let mut scene = scene.clone();
        for stage in &mut scene.stages {
            stage.steps = (stage.steps / COARSER).max(2);
        }
        let mut other = Self::new(&scene, observer)?;
        other.request.slowness *= FASTER;
        while other.advance(observer).unwrap_or(false) {}
        let (solved, steps) = (other.solved_steps(), other.steps());
        self.second_loading = Some(match other.at_end() {
            Some(other) => SecondLoading::Ended(Spread::of(&end, &other, steps)),
            None => SecondLoading::Stopped { solved, steps },
        });
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

    use super::*;
    use crate::analysis::outcome::Outcome;

    /// The second loading gives the same differences as a separate run with as few steps and the same speed.
    #[test]
    fn differences_are_those_of_two_states() {
        let go_on = &mut |_: Event| ControlFlow::Continue(());
        let scene = include_str!("../../../../scenes/wall_settlement.toml");
        let scene = Scene::from_toml(scene).unwrap();
        let mut first = Run::new(&scene, go_on).unwrap();
        while first.advance(go_on).unwrap() {}
        first.compare(&scene, go_on).unwrap();
        let first = first.finish();
        let second = first.history.as_ref().unwrap().second_loading.unwrap();
        let SecondLoading::Ended(spread) = second else { panic!("{second:?}") };

        let mut fewer = scene;
        fewer.stages[0].steps = 2;
        fewer.stages[1].steps = 2;
        let mut faster = Run::new(&fewer, go_on).unwrap();
        faster.request.slowness *= FASTER;
        while faster.advance(go_on).unwrap() {}
        let faster = faster.finish();

        let gaps = |outcome: &Outcome| -> Vec<f64> {
            outcome.state.as_ref().unwrap().contacts.iter().map(|contact| contact.y_n).collect()
        };
        let (one, two) = (gaps(&first), gaps(&faster));
        let apart: f64 = one.iter().zip(&two).map(|(a, b)| (a - b).powi(2)).sum();
        let openings = (apart / one.iter().map(|gap| gap.powi(2)).sum::<f64>()).sqrt();
        assert!((spread.openings - openings).abs() < 1e-6 * openings, "{spread:?}, {openings}");
        let told = format!("two loadings differ by {:.0} %", 100.0 * spread.largest());
        let sentence = &first.judgement.sentence;
        assert_eq!(sentence.contains(&told), !spread.is_unique(), "{sentence}");
    }
}
