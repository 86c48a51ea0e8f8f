//! The rules of `auto`: the routes of a scene and their order, the limits of their work, the results that are final,
//! and the additional decisions for the verdict. No other part of the crate chooses routes:
//! [`Plan::routes`](crate::plan::Plan::routes) has the list with its reasons, and [`analysis`](crate::analysis::solve)
//! runs the list.
//!
//! The cheapest method that can decide runs first; slower methods follow only in cases that they alone can decide:
//!
//! 1. Rigid blocks without gaps, in joints without compliance: the program of admissible forces
//!    ([`statics`](crate::method::statics)) decides either way.
//! 2. All other walls: the interior-point method, at every size. If it has no solution after [`STEPS_BEFORE_PROOF`],
//!    the program of admissible forces checks whether any forces balance the loads at all; a proof that none do is the
//!    result.
//! 3. Lemke's method, for a second opinion, if its dense matrices take about a second.
//!
//! A result is final if it is a checked equilibrium, or a proof that there is no equilibrium. If there is friction, a
//! secondary ray of Lemke's method is not a proof: the next route follows, as it does after a route that refuses the
//! scene.

use lcp::Status;

use crate::data::info::SolveInfo;
use crate::data::route::Route;
use crate::forms::FormKind;
use crate::scene::{Form, RouteSetting, SolverSettings};

/// Order of dense matrices for which pivots take about a second; the time grows with the cube of the order.
const FEW: usize = 2000;
/// Number of steps of the interior-point method that suffices for most walls; after this number, a proof that there is
/// no equilibrium is looked for.
pub(crate) const STEPS_BEFORE_PROOF: usize = 40;

/// The facts about a scene that decide between the routes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Facts {
    /// Whether all blocks are rigid, no joint has a compliance, and all gaps are closed before supports move.
    pub(crate) at_rest: bool,
    /// Order of the largest dense matrix that Lemke's method would build.
    pub(crate) largest_dense: usize,
}

/// Lists the routes of a scene in the order in which they are tried, each with the reason for its place.
pub(crate) fn routes(solver: &SolverSettings, facts: Facts) -> Vec<(Route, String)> {
    let given = |route: Route| format!("solver.route = \"{}\"", route.name());
    match solver.route {
        RouteSetting::Auto if solver.form != Form::Auto => {
            vec![(Route::Lemke, "solver.form is given, which is a form of this route".to_owned())]
        }
        RouteSetting::Auto if solver.max_pivots.is_some() => {
            vec![(Route::Lemke, "solver.max_pivots is given, which limits this route".to_owned())]
        }
        RouteSetting::Auto => chosen(facts),
        RouteSetting::Only(Route::Pgs) if solver.soft.is_none() => vec![(
            Route::Pgs,
            format!(
                "{}; blocks float, so springs hold them, solver.soft = {}",
                given(Route::Pgs),
                crate::method::pgs::SOFT
            ),
        )],
        RouteSetting::Only(route) => vec![(route, given(route))],
    }
}

fn chosen(facts: Facts) -> Vec<(Route, String)> {
    let Facts { at_rest, largest_dense } = facts;
    let mut list = if at_rest {
        vec![
            (
                Route::Forces,
                "blocks are rigid and nothing has a gap: any forces inside friction that balance the loads are \
                 an equilibrium, and one convex program finds them or proves that there are none"
                    .to_owned(),
            ),
            (Route::Interior, "if the program leaves the answer open, or if supports move".to_owned()),
        ]
    } else {
        vec![
            (
                Route::Interior,
                "the sparse problem with all displacements takes tens of factorisations".to_owned(),
            ),
            (
                Route::Forces,
                format!(
                    "after {STEPS_BEFORE_PROOF} steps without an answer: forces inside friction that balance \
                     the loads, or a proof that there are none and the wall falls"
                ),
            ),
        ]
    };
    if largest_dense <= FEW {
        list.push((
            Route::Lemke,
            format!(
                "a second opinion: pivots take about a second on dense matrices of order up to {FEW}, and \
                 the largest is of order {largest_dense}"
            ),
        ));
    }
    list
}

/// Lists the forms that Lemke's method tries, one after the other until one has a solution.
pub(crate) fn forms(form: Form) -> &'static [FormKind] {
    match form {
        Form::Auto => &[FormKind::Coulomb, FormKind::Mixed],
        Form::Coulomb => &[FormKind::Coulomb],
        Form::StewartTrinkle => &[FormKind::StewartTrinkle],
        Form::Mixed => &[FormKind::Mixed],
    }
}

/// Largest number of pivots of one attempt, divided by the order of the problem: two to three are usual.
const PIVOTS: usize = 5;

/// Returns the largest number of pivots of an attempt on a problem of this order; `None` for other routes than Lemke's
/// method, or if no other route is planned.
pub(crate) fn max_pivots(route: Route, order: usize, routes: usize) -> Option<usize> {
    (route == Route::Lemke && routes > 1).then_some(PIVOTS * order)
}

/// Whether a route may decide more than is known already.
pub(crate) fn is_asked(route: Route, known: Rank) -> bool {
    // Admissible forces need not be reached by blocks that move, so that only a proof that there are none decides.
    known != Rank::Motion || route == Route::Forces
}

/// Whether a proof that there is no equilibrium may stop a route that takes many steps: if a later route would look for
/// this proof.
pub(crate) fn may_be_cut(mut later: impl Iterator<Item = Route>) -> bool {
    later.any(|route| route == Route::Forces)
}

/// Whether the verdict depends on the decision whether forces balance the loads: if no route has an answer, if the
/// answer is far from the scene, or if blocks are at rest. Such forces decide the verdict on blocks at rest, whatever
/// the tolerance of another route.
pub(crate) fn needs_statics(status: Status, is_far: bool, at_rest: bool) -> bool {
    status != Status::Cancelled && (status != Status::Solved || is_far || at_rest)
}

/// Whether the verdict depends on the loading from a state without stresses: if there is friction, blocks at rest may
/// be held by a prestress that no loading causes.
pub(crate) fn needs_loading(status: Status, at_rest: bool, has_friction: bool) -> bool {
    status == Status::Solved && at_rest && has_friction
}

/// The rank of an attempt by what it decides, from the most to the least decisive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Rank {
    Solved,
    /// It is proved that there is no equilibrium.
    Proved,
    /// Blocks with mass do not come to rest under their loads.
    Motion,
    Mechanism,
    /// A state was found that does not pass the checks.
    Almost,
    Open,
}

impl Rank {
    pub(crate) fn of(info: &SolveInfo, has_mechanism: bool) -> Self {
        match info.status {
            Status::Solved => Self::Solved,
            Status::Infeasible if info.proved => Self::Proved,
            Status::NoEquilibrium => Self::Motion,
            _ if has_mechanism => Self::Mechanism,
            Status::AlmostSolved => Self::Almost,
            _ => Self::Open,
        }
    }

    /// Whether no other route can decide more. If there is no friction, a secondary ray is as good as a proof.
    pub(crate) fn is_final(self, has_friction: bool) -> bool {
        match self {
            Self::Solved | Self::Proved => true,
            Self::Mechanism => !has_friction,
            Self::Motion | Self::Almost | Self::Open => false,
        }
    }
}
