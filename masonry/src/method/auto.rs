//! The rules of `auto`: which routes a scene uses and in which order, how long each may take, when a result is final,
//! and what is asked besides. Nothing else in the crate chooses routes: [`Plan::routes`](crate::plan::Plan::routes) has
//! the list with its reasons, and [`analysis`](crate::analysis::solve) runs it.
//!
//! The cheapest method that can decide runs first; slower ones follow only for what they alone can decide:
//!
//! 1. Rigid blocks without gaps, in joints that do not give way: the program of admissible forces
//!    ([`statics`](crate::method::statics)) decides either way.
//! 2. All other walls: the interior-point method, at every size. If it has no solution after [`STEPS_BEFORE_PROOF`],
//!    that program checks whether any forces balance the loads at all; if it proves that none do, this is the result.
//! 3. Lemke's method, for a second opinion, if its dense matrices take about a second.
//!
//! A result is final if it is a checked equilibrium, or a proof that there is none. With friction a secondary ray of
//! Lemke's method is no proof, and the next route follows, as it does after a route that refuses the scene.

use lcp::Status;

use crate::data::info::SolveInfo;
use crate::data::route::Route;
use crate::forms::FormKind;
use crate::scene::{Form, RouteSetting, SolverSettings};

/// Pivots on dense matrices of this order take about a second; the time grows with the cube.
const FEW: usize = 2000;
/// Most walls are solved in so many steps of the interior points.
pub(crate) const STEPS_BEFORE_PROOF: usize = 40;

/// The facts that decide between the routes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Facts {
    /// All blocks are rigid, no joint gives way, and all gaps are closed before supports move.
    pub(crate) at_rest: bool,
    /// Order of the largest dense matrix that pivots would turn to.
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
            (Route::Interior, "where that leaves it open, or supports move".to_owned()),
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
                    "after {STEPS_BEFORE_PROOF} steps without an answer: whether any forces inside friction \
                     balance the loads, or none, which is a proof that the wall falls"
                ),
            ),
        ]
    };
    if largest_dense <= FEW {
        list.push((
            Route::Lemke,
            format!(
                "for a second opinion: pivots take about a second on dense matrices of order up to {FEW}, and \
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

/// Pivots of one attempt, in multiples of the order: two to three are usual.
const PIVOTS: usize = 5;

/// How many pivots an attempt on a problem of this order may take, if other routes follow.
pub(crate) fn max_pivots(route: Route, order: usize, routes: usize) -> Option<usize> {
    (route == Route::Lemke && routes > 1).then_some(PIVOTS * order)
}

/// Whether a route may say more than is known.
pub(crate) fn is_asked(route: Route, known: Rank) -> bool {
    // Forces that balance the loads are none that the loading leads to; that there are none is a proof.
    known != Rank::Motion || route == Route::Forces
}

/// Whether a route that takes many steps is asked to wait for the proof that there is no equilibrium, since the routes
/// after it would look for one.
pub(crate) fn may_be_cut(mut later: impl Iterator<Item = Route>) -> bool {
    later.any(|route| route == Route::Forces)
}

/// Whether the verdict needs to know if any forces balance the loads: if there is no answer, if the answer is far away, or if
/// blocks are at rest. Such forces are all there is to know of blocks at rest, at whatever tolerance another route found them.
pub(crate) fn needs_statics(status: Status, is_far: bool, at_rest: bool) -> bool {
    status != Status::Cancelled && (status != Status::Solved || is_far || at_rest)
}

/// Whether the verdict needs to know if loading from a state without stresses leads to rest: a prestress that nothing brings
/// about may hold blocks at rest with friction.
pub(crate) fn needs_loading(status: Status, at_rest: bool, has_friction: bool) -> bool {
    status == Status::Solved && at_rest && has_friction
}

/// How much an attempt says; what comes first says more.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Rank {
    Solved,
    /// There is none, with a proof.
    Proved,
    /// Blocks with mass move on under their loads.
    Motion,
    Mechanism,
    /// Something was found that does not hold.
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

    /// Whether no other route has more to say. Without friction a ray is as good as a proof.
    pub(crate) fn is_final(self, has_friction: bool) -> bool {
        match self {
            Self::Solved | Self::Proved => true,
            Self::Mechanism => !has_friction,
            Self::Motion | Self::Almost | Self::Open => false,
        }
    }
}
