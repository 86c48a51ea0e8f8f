//! Wall-clock times of the phases of an analysis.

use std::ops::ControlFlow;
use web_time::Instant;

use crate::data::info::PhaseTime;
use crate::method::Event;

#[derive(Debug, Default)]
pub(super) struct Clock {
    pub(super) times: Vec<PhaseTime>,
}

impl Clock {
    pub(super) fn time<T>(
        &mut self,
        phase: &'static str,
        observer: &mut dyn FnMut(Event) -> ControlFlow<()>,
        work: impl FnOnce() -> T,
    ) -> T {
        // The answer of the observer is ignored: only the solver takes long enough to be cancelled.
        let _ = observer(Event::Phase(phase));
        let began = Instant::now();
        let result = work();
        self.add(phase, began);
        result
    }

    pub(super) fn add(&mut self, phase: &str, began: Instant) {
        let seconds = began.elapsed().as_secs_f64();
        // A phase may run several times, for several routes: its times are added.
        match self.times.iter_mut().find(|time| time.phase == phase) {
            Some(time) => time.seconds += seconds,
            None => self.times.push(PhaseTime { phase: phase.to_owned(), seconds }),
        }
    }
}
