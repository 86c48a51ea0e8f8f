//! The observer of a search for a limit, which may end the search.

use std::ops::ControlFlow;

use lcp::Iteration;

/// The bounds of a limit that are known during its search.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bracket {
    /// The largest load factor \[-\], or the smallest thickness \[m\], at which the structure was found to stand.
    pub stands: Option<f64>,
    /// The smallest load factor \[-\], or the largest thickness \[m\], at which the structure was found to fall.
    pub falls: Option<f64>,
}

/// A function that is called many times during the search with the bounds that are known; `Break` ends the search.
pub type LimitObserver<'a> = dyn FnMut(Bracket) -> ControlFlow<()> + 'a;

/// An observer, the bounds that it is called with, and whether it has ended the search.
pub(super) struct Watch<'a> {
    observer: &'a mut LimitObserver<'a>,
    pub(super) known: Bracket,
    pub(super) is_ended: bool,
}

impl<'a> Watch<'a> {
    pub(super) fn new(observer: &'a mut LimitObserver<'a>) -> Self {
        Self { observer, known: Bracket::default(), is_ended: false }
    }

    /// Calls the observer, unless it has ended the search before; returns `Break` if the search has ended.
    pub(super) fn ask(&mut self) -> ControlFlow<()> {
        self.is_ended = self.is_ended || (self.observer)(self.known).is_break();
        if self.is_ended { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Returns a function that calls the observer at every step of a solver.
    pub(super) fn steps(&mut self) -> impl FnMut(&Iteration) -> ControlFlow<()> {
        |_| self.ask()
    }
}
