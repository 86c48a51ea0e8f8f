//! A method that suits a problem; if it fails, the next one.

mod chain;
mod constants;
mod contact;
mod divided;
mod enumerated;
mod facts;
mod method;
mod mixed;
mod settings;
mod standard;

pub use enumerated::Enumeration;
pub use method::Choice;
pub use settings::AutoSettings;

use method::Planned;

use crate::solve::named;
use crate::{Error, Method, Observer, Solution, Solver};

/// Chooses the methods for a problem by its class and size, and runs one after the other until one finds a solution.
/// Every method checks the residuals in the given data.
///
/// The choice needs no factorisation and depends on the order, whether matrices are stored sparse, signs, and the
/// number of contact points, not on units. [`plan`](Self::plan) returns the choice and the reasons, and
/// [`Info::runs`](crate::Info::runs) lists the methods that were tried and their endings.
///
/// | problem | chain |
/// |---|---|
/// | [`Lcp`](crate::Lcp) | semismooth Newton†, then as the next lines |
/// | dense, or up to order 500 | Lemke, interior point‡ |
/// | sparse and larger | interior point, Lemke |
/// | [`HorizontalLcp`](crate::HorizontalLcp) | as a standard problem if it can be converted, else Lemke |
/// | [`Contact2d`](crate::Contact2d), up to 100 pairs and with bodies that no spring holds | Lemke, interior point |
/// | other [`Contact2d`](crate::Contact2d) | interior point, Lemke |
///
/// † if the diagonal is positive; ‡ if sparse, or dense up to order 500. The lines without a class are for
/// [`MixedLcp`](crate::MixedLcp), [`BoxedLcp`](crate::BoxedLcp) and [`Friction2d`](crate::Friction2d) too. Quadratic
/// programs and sweeps are in no chain: no case of the bench `corpus` is decided by them alone.
///
/// Problems of up to 100 pairs have enumeration as well: branching over the sides of pairs, with a solution or a proof
/// for each choice. Enumeration comes last, with the work of one or two seconds, except if the largest block of
/// mutually dependent pairs has at most 18 (each pair of a triangular matrix is a block by itself, since its sides
/// follow one from another). In that case enumeration follows 40 attempts of Lemke's method, and more attempts come at
/// the end if there are more than 18 pairs in all.
///
/// # Independent parts
/// Rows and variables that no entry connects are independent problems. Each has its own chain, so a body that touches
/// no other costs the same as alone, and small parts are treated as small problems. A part without a solution proves
/// that the whole has none. A plan and its [`MethodRun`](crate::MethodRun)s have one line for all parts with the same course.
/// More than 256 parts are first tried as one problem. The smallest part comes first, and each has an equal share of the
/// time that is left.
///
/// # When it ends
/// The chain ends with an answer, which is [`Solved`](crate::Status::Solved), or
/// [`Infeasible`](crate::Status::Infeasible) or [`NoSolution`](crate::Status::NoSolution) with a checked proof; or at
/// the time limit. A method that does not treat the problem, or needs more memory than there is, is skipped. Each
/// method gets three quarters of the time that is left, the last one all of it.
///
/// Otherwise the result is, in this order: a point with residuals below the square root of the tolerance; a ray
/// ([`RayTermination`](crate::Status::RayTermination)); the point with the smallest residual.
///
/// # Observer
/// The observer is passed to each method in turn, which counts its iterations from 0. `Break` ends the chain like the
/// time limit: with [`Cancelled`](crate::Status::Cancelled), unless a previous method found a ray.
///
/// # Cost
/// The cost is that of the methods that were tried: some seconds if all fail on a problem of up to 100 pairs. A method
/// that fails on a larger problem may take long: set [`AutoSettings::time_limit`] if that matters.
///
/// ```
/// use lcp::{Auto, Method, Solver};
/// use lcp_problems::families;
/// let problem = families::obstacle(40).problem;
/// let auto = Auto::default();
/// let first = &auto.plan(&problem)[0];
/// assert_eq!(first.method, Method::Newton);
/// assert!(first.reason.starts_with("order 1600, sparse with 7840 nonzeros"));
/// let solution = auto.solve(&problem)?;
/// assert!(solution.is_solved());
/// assert_eq!(solution.info.method, Method::Newton);
/// assert_eq!(solution.info.runs.len(), 1);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Auto {
    settings: AutoSettings,
}

named!(Auto, AutoSettings, Method::Auto);

impl Auto {
    /// The methods for a problem, in order.
    pub fn plan<P: Planned>(&self, problem: &P) -> Vec<Choice> {
        divided::plan(problem, self.settings.max_attempts)
    }
}
/// The problems are those in the table of [`Auto`].
impl<P: Planned> Solver<P> for Auto {
    fn solve_pairs(&self, problem: &P, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        divided::run(problem, &self.settings, observer)
    }
}
