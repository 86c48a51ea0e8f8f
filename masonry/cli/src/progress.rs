//! Progress of a long solve on standard error.

use std::ops::ControlFlow;

use indicatif::{ProgressBar, ProgressStyle};

use crate::interrupt;
use masonry::analysis::solve::Event;

/// A spinner that shows the current phase; hidden if standard error is not a terminal.
pub(super) struct Progress(ProgressBar);

impl Progress {
    pub(super) fn new() -> Self {
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {msg}") {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// Shows the progress of a solve; ends the solve after Ctrl-C.
    pub(super) fn show(&mut self, event: Event) -> ControlFlow<()> {
        self.0.set_message(match event {
            Event::Step { number, of } => format!("step {number} of {of}"),
            Event::Phase(phase) => phase.to_owned(),
            Event::Pivots(at) => {
                format!("solve: order {}, attempt {}, pivot {}", at.order, at.attempt, at.pivots)
            }
            Event::Iteration { number, residual } => {
                format!("solve: iteration {number}, residual {residual:.1e}")
            }
        });
        self.0.tick();
        interrupt::asked()
    }

    pub(super) fn say(&self, text: String) {
        self.0.set_message(text);
        self.0.tick();
    }

    pub(super) fn clear(&self) {
        self.0.finish_and_clear();
    }
}
