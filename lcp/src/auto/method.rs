//! The methods with their settings.

use std::time::Duration;

use super::constants::{FEW_ATTEMPTS, FEW_PAIRS, TRIAL};
use super::enumerated::Enumeration;
use crate::conversion::General;
use crate::divide::Divide;
use crate::enumerate::MOST_PAIRS;
use crate::{
    InteriorPoint, InteriorPointSettings, Lemke, LemkeSettings, Method, SemismoothNewton,
    SemismoothNewtonSettings, Solver, WarmStart,
};

/// A method of a plan, and the reason for it.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Choice {
    /// The method.
    #[cfg_attr(feature = "serde", serde(rename = "solver"))]
    pub method: Method,
    /// The reason for this method at this place, with the numbers on which it is based.
    pub reason: String,
    /// Whether pivots end after a few attempts, because another method follows that may take less.
    #[cfg_attr(feature = "serde", serde(default))]
    pub is_brief: bool,
}

/// A method of a chain, whose reason is put into words only if the method runs or the plan is shown.
#[derive(Debug, Clone, Copy)]
pub struct Link {
    pub(super) method: Method,
    words: Words,
    pub(super) is_brief: bool,
}

/// The reason for the place of a method.
#[derive(Debug, Clone, Copy)]
enum Words {
    These(&'static str),
    /// The small number of choices of sides in a block of dependent variables.
    Few(usize),
}

impl Link {
    pub(super) fn new(method: Method, words: &'static str) -> Self {
        Self { method, words: Words::These(words), is_brief: false }
    }

    pub(super) fn told<P: Planned>(self, problem: &P) -> Choice {
        let subject = problem.subject();
        let reason = match self.words {
            Words::These(words) => format!("{subject}: {words}"),
            Words::Few(choices) => format!(
                "{subject}: at most {choices} pairs depend on each other in turn, so few that choices of sides can be gone \
                 through, with proofs"
            ),
        };
        Choice { method: self.method, reason, is_brief: self.is_brief }
    }
}

/// The chain of a problem with enumeration of all choices of sides: after a few attempts of pivots if enumeration takes
/// no longer than these attempts, else at the end.
pub(super) fn chain_of<P: Planned>(problem: &P, max_attempts: Option<usize>) -> Vec<Link> {
    let mut steps = problem.chain();
    let pairs = problem.pairs();
    let pivots = steps.iter().position(|step| step.method == Method::Lemke);
    let Some(pivots) = pivots.filter(|_| pairs <= MOST_PAIRS) else { return steps };
    let choices = problem.choices();
    if choices > FEW_PAIRS {
        let words = "choices of sides are tried as long as the limit of work allows";
        steps.push(Link::new(Method::Enumeration, words));
        return steps;
    }
    steps[pivots].is_brief = true;
    let words = Words::Few(choices);
    steps.insert(pivots + 1, Link { method: Method::Enumeration, words, is_brief: false });
    if pairs > FEW_PAIRS && max_attempts.is_none_or(|most| most > FEW_ATTEMPTS) {
        steps.push(Link::new(Method::Lemke, "pivots from as many starts as some seconds allow"));
    }
    steps
}

/// A problem with a chain of methods, implemented by the problems of the library only.
pub trait Planned: Divide {
    /// Number of pairs of a start.
    fn pairs(&self) -> usize;

    /// Number of pairs of which either side may be zero, in the largest block of mutually dependent variables. The
    /// blocks can be decided one after the other.
    fn choices(&self) -> usize {
        self.pairs()
    }

    /// The class and the size that determine the chain, with numbers.
    fn subject(&self) -> String;

    /// The chain.
    fn chain(&self) -> Vec<Link>;

    /// A method of the chain with its settings.
    fn solver(&self, method: Method, effort: &Budget<'_>) -> Box<dyn Solver<Self>>;
}

/// The settings of a method in a chain.
#[derive(Debug, Clone, Copy)]
pub struct Budget<'a> {
    pub(super) tolerance: f64,
    pub(super) time_limit: Option<Duration>,
    /// Attempts of Lemke's method.
    pub(super) max_attempts: Option<usize>,
    pub(super) start: &'a WarmStart,
}

impl Budget<'_> {
    /// A method that treats every problem. [`Planned::solver`] has the other methods.
    pub(super) fn common<P>(&self, method: Method) -> Box<dyn Solver<P>>
    where
        P: General,
        Lemke: Solver<P>,
        InteriorPoint: Solver<P>,
    {
        let Self { tolerance, time_limit, max_attempts, .. } = *self;
        let start = self.start.clone();
        match method {
            Method::Lemke => {
                let defaults = LemkeSettings::default();
                let settings =
                    LemkeSettings { tolerance, time_limit, max_attempts, start, ..defaults };
                Box::new(Lemke::new(settings))
            }
            Method::Enumeration => Box::new(Enumeration { tolerance, time_limit }),
            Method::Interior => {
                let defaults = InteriorPointSettings::default();
                let settings = InteriorPointSettings { tolerance, time_limit, start, ..defaults };
                Box::new(InteriorPoint::new(settings))
            }
            other => unreachable!("a chain has {other}, and its problem no arm for it"),
        }
    }

    /// Steps are factorisations: they are few if convergence is not guaranteed.
    pub(super) fn newton(&self, is_sure: bool) -> SemismoothNewton {
        let Self { tolerance, time_limit, .. } = *self;
        let start = self.start.clone();
        let sure = SemismoothNewtonSettings { tolerance, time_limit, start, ..Default::default() };
        let max_iterations = if is_sure { sure.max_iterations } else { TRIAL };
        SemismoothNewton::new(SemismoothNewtonSettings { max_iterations, ..sure })
    }
}
