//! Ctrl-C: the first one ends a run with the results so far, the second one ends the program at once.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// The exit code of a program that Ctrl-C has ended, by the convention of shells.
const ENDED_BY_SIGNAL: i32 = 130;

static ASKED: AtomicBool = AtomicBool::new(false);

/// Makes the first Ctrl-C request the end of the run. On a system without such signals, Ctrl-C still ends the program.
pub(super) fn listen() {
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::SeqCst) {
            std::process::exit(ENDED_BY_SIGNAL);
        }
        eprintln!("interrupted: stopping with the last result; Ctrl-C again stops at once");
    });
}

/// Returns `Continue` until Ctrl-C requests the end of the run.
pub(super) fn asked() -> ControlFlow<()> {
    if ASKED.load(Ordering::SeqCst) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
