//! The rules of `auto`: the routes of a scene and their order, the time that each may take, the results that are final,
//! and additional questions. Nothing else in the crate chooses routes: [`Plan::routes`](crate::plan::Plan::routes) has
//! the list with its reasons, and [`analysis`](crate::analysis::solve) runs it.
//!
//! The cheapest method that can decide runs first; slower ones follow only for cases that they alone can decide:
//!
//! 1. Rigid blocks without gaps, in joints that do not give way: the program of admissible forces
//!    ([`statics`](crate::method::statics)) decides either way.
//! 2. All other walls: the interior-point method, at every size. If it has no solution after [`STEPS_BEFORE_PROOF`],
//!    that program checks whether any forces balance the loads at all; a proof that none do is the result.
//! 3. Lemke's method, for a second opinion, if its dense matrices take about a second.
//!
//! A result is final if it is a checked equilibrium, or a proof that there is no equilibrium. A secondary ray of
//! Lemke's method is not a proof if there is friction: the next route follows, as after a route that refuses the scene.

use lcp::Status;

use crate::data::info::SolveInfo;
use crate::data::route::Route;
use crate::forms::FormKind;
use crate::scene::{Form, RouteSetting, SolverSettings};

/// Pivots on dense matrices of this order take about a second; the time grows with the cube.
const FEW: usize = 2000;
/// Steps of the interior points that suffice for most walls.
pub(crate) const STEPS_BEFORE_PROOF: usize = 40;

/// The facts that decide between the routes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Facts {
    /// All blocks are rigid, no joint gives way, and all gaps are closed before supports move.
    pub(crate) at_rest: bool,
    /// Order of the largest dense matrix of the pivots.
    pub(crate) largest_dense: usize,
}

/// The routes of a scene in the order in which they are tried, each with the reason for its place.
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

/// The forms that pivots try, one after the other until one has a solution.
pub(crate) fn forms(form: Form) -> &'static [FormKind] {
    match form {
        Form::Auto => &[FormKind::Coulomb, FormKind::Mixed],
        Form::Coulomb => &[FormKind::Coulomb],
        Form::StewartTrinkle => &[FormKind::StewartTrinkle],
        Form::Mixed => &[FormKind::Mixed],
    }
}

/// Pivots of one attempt at most, in multiples of the order: two to three are usual.
const PIVOTS: usize = 5;

/// The largest number of pivots of an attempt on a problem of this order, if other routes follow.
pub(crate) fn max_pivots(route: Route, order: usize, routes: usize) -> Option<usize> {
    (route == Route::Lemke && routes > 1).then_some(PIVOTS * order)
}

/// Whether a route may decide more than is known.
pub(crate) fn is_asked(route: Route, known: Rank) -> bool {
    // Forces that balance the loads need not result from the loading, but a proof that there are none decides.
    known != Rank::Motion || route == Route::Forces
}

/// Whether a proof that there is no equilibrium may end a route that takes many steps: one of the routes after it would
/// look for this proof.
pub(crate) fn may_be_cut(mut later: impl Iterator<Item = Route>) -> bool {
    later.any(|route| route == Route::Forces)
}

/// Whether the verdict depends on forces that balance the loads: if there is no answer, if the answer is far away, or
/// if blocks are at rest. Such forces decide the verdict on blocks at rest, whatever the tolerance of another route.
pub(crate) fn needs_statics(status: Status, is_far: bool, at_rest: bool) -> bool {
    status != Status::Cancelled && (status != Status::Solved || is_far || at_rest)
}

/// Whether the verdict depends on the loading from a state without stresses: a prestress that no loading causes may
/// hold blocks at rest with friction.
pub(crate) fn needs_loading(status: Status, at_rest: bool, has_friction: bool) -> bool {
    status == Status::Solved && at_rest && has_friction
}

/// The rank of an attempt by what it decides, the most decisive first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Rank {
    Solved,
    /// There is no equilibrium, with a proof.
    Proved,
    /// Blocks with mass move on under their loads.
    Motion,
    Mechanism,
    /// A state was found that does not hold.
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

    /// Whether no other route can decide more. A ray is as good as a proof if there is no friction.
    pub(crate) fn is_final(self, has_friction: bool) -> bool {
        match self {
            Self::Solved | Self::Proved => true,
            Self::Mechanism => !has_friction,
            Self::Motion | Self::Almost | Self::Open => false,
        }
    }
}
