//! Ctrl-C: the first asks a run to end with what is known, the second ends the program at once.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// What shells expect of a program that Ctrl-C has ended.
const ENDED_BY_SIGNAL: i32 = 130;

static ASKED: AtomicBool = AtomicBool::new(false);

/// Makes Ctrl-C ask the run to end. A system without such signals goes on ending the program.
pub(super) fn listen() {
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::SeqCst) {
            std::process::exit(ENDED_BY_SIGNAL);
        }
        eprintln!("interrupted: stopping with the last result; Ctrl-C again stops at once");
    });
}

/// Whether the run should go on.
pub(super) fn asked() -> ControlFlow<()> {
    if ASKED.load(Ordering::SeqCst) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
