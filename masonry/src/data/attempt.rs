//! Attempts of routes as sentences.

use std::fmt::{Display, Formatter, Result};

use lcp::lemke::{self, AttemptCovering, AttemptEnd};
use lcp::{Ending, Status};

use crate::data::info::RouteAttempt;
use crate::data::route::Route;

impl Display for RouteAttempt {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Pivots { form, start, path } => {
                write!(f, "{form}: ")?;
                pivots(f, start.as_deref(), path)
            }
            Self::Sparse { route, status, iterations, factorisations, residual } => write!(
                f,
                "{}: {} after {iterations} {} and {factorisations} factorisations, residual {residual:.1e}",
                route.name(),
                solved(*status),
                counted(*route)
            ),
            Self::Motion { ending, factorisations } => write!(
                f,
                "interior: loaded slowly, the blocks {}, after {factorisations} factorisations",
                moved(*ending)
            ),
            Self::Forces { status, are_found, factorisations } => {
                let forces = forces(*status, *are_found);
                write!(f, "forces: {forces}, after {factorisations} factorisations")
            }
            Self::Refinement { residual } => {
                write!(f, "refined on all displacements, residual {residual:.1e}")
            }
            Self::Left { route, iterations } => write!(
                f,
                "{}: left after {iterations} steps, since no forces inside friction balance the loads",
                route.name()
            ),
        }
    }
}

fn pivots(f: &mut Formatter<'_>, start: Option<&str>, path: &lemke::Attempt) -> Result {
    match start {
        Some(name) => write!(f, "start {name}, covering vector ")?,
        None => write!(f, "start {}, covering vector ", path.start)?,
    }
    match path.covering {
        AttemptCovering::Given => f.write_str("cohesive")?,
        covering => covering.fmt(f)?,
    }
    let end = match path.end {
        AttemptEnd::Complementary => "complementary basis",
        AttemptEnd::Ray => "ray",
        AttemptEnd::PivotLimit => "pivot limit",
        AttemptEnd::Cycle => "cycle",
        AttemptEnd::Singular => "singular basis",
        AttemptEnd::Cancelled => "cancelled",
        _ => "ended",
    };
    write!(f, ": {end} after {} pivots", path.pivots)?;
    path.residual.map_or(Ok(()), |residual| write!(f, ", residual {residual:.1e}"))
}

fn solved(status: Status) -> String {
    match status {
        Status::Solved => "solved".to_owned(),
        Status::Infeasible => "proved to have no solution".to_owned(),
        status => status.to_string(),
    }
}

/// Returns the name for the steps of a route in sentences.
fn counted(route: Route) -> &'static str {
    match route {
        Route::Qp => "programs",
        Route::Pgs => "rounds",
        Route::Alm => "iterations",
        _ => "steps",
    }
}

fn moved(ending: Ending) -> String {
    match ending {
        Ending::Rests => "have come to rest".to_owned(),
        Ending::Flows => "go on moving, and nothing resists them".to_owned(),
        Ending::Left => "have moved beyond small displacements".to_owned(),
        _ => format!("were neither brought to rest nor shown to fall: {}", ending.status()),
    }
}

fn forces(status: Status, are_found: bool) -> &'static str {
    match status {
        Status::Solved => "found forces that balance the loads, with all blocks at rest",
        Status::AlmostSolved => "found no forces that are exact enough",
        Status::Infeasible => "found a motion that proves that no forces balance the loads",
        Status::Cancelled => "cancelled before forces were found",
        _ if are_found => "found forces that balance the loads, but no displacements for them",
        _ => "found neither forces nor a proof that there are none",
    }
}
