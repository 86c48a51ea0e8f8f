//! Ctrl-C: the first one makes a run end with the results so far, the second one ends the program at once.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// The exit code for a program that Ctrl-C has ended, by the convention of shells.
const ENDED_BY_SIGNAL: i32 = 130;

static ASKED: AtomicBool = AtomicBool::new(false);

/// Makes Ctrl-C request the end of the run. Ctrl-C still ends the program on a system without such signals.
pub(super) fn listen() {
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::SeqCst) {
            std::process::exit(ENDED_BY_SIGNAL);
        }
        eprintln!("interrupted: stopping with the last result; Ctrl-C again stops at once");
    });
}

/// `Continue` if the run should go on.
pub(super) fn asked() -> ControlFlow<()> {
    if ASKED.load(Ordering::SeqCst) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
