//! The augmented Lagrangian method as a route of scenes.

use lcp::{ContactState, Status};

use super::{AlmAnswer, AlmError, AlmIteration, AlmSettings, MortaredWall, solve};
use crate::data::info::SolveInfo;
use crate::forms::Sparse;
use crate::method::{self, Event, EventObserver, Request, sparse};
use crate::model::Model;
use crate::scene::Route;
use crate::system::System;

/// Factor on the tolerance at which the iteration with films as strips stops: residuals of the problem with contact
/// points in the films are measured row by row, and may be larger.
const BETTER: f64 = 0.1;

/// Runs the augmented Lagrangian method on a sparse problem whose contacts have no compliances
/// ([`Sparse::with_free_faces`]).
///
/// # Errors
/// As [`solve`].
pub fn by_multipliers(
    sparse: &Sparse,
    request: &Request,
    observer: EventObserver<'_>,
) -> Result<method::RouteAnswer, AlmError> {
    let problem = &sparse.problem;
    let settings = AlmSettings { tolerance: request.tolerance, ..AlmSettings::default() };
    let found = solve(problem, &settings, &mut told(observer))?;
    Ok(answer(sparse, found, problem.displacements()))
}

/// Runs the augmented Lagrangian method on a model with films as strips. The contact points in the films take no part
/// in the iterations, and get the responses of the films at the end. `sparse` is the problem with these points; its
/// residuals measure the answer.
///
/// # Errors
/// As [`MortaredWall::new`] and [`solve`].
pub fn by_films(
    model: &Model,
    system: &System,
    sparse: &Sparse,
    request: &Request,
    observer: EventObserver<'_>,
) -> Result<method::RouteAnswer, AlmError> {
    let wall = MortaredWall::new(model)?;
    let settings = AlmSettings { tolerance: BETTER * request.tolerance, ..AlmSettings::default() };
    let mut found = wall.solve(&settings, &mut told(observer))?;
    let (t_n, t_t) = at_points(model, &wall, &found.state);
    let tangential: Vec<f64> = system.friction.iter().map(|it| t_t[it.contact.index()]).collect();
    // The unknowns that follow those of the blocks are others in the problem with contact points in the films.
    let blocks = sparse.starts().last().copied().unwrap_or_default();
    found.state = sparse.with_forces(system, found.state.u[..blocks].to_vec(), &t_n, &tangential);
    found.residuals = sparse.problem.residuals(&found.state);
    if found.status == Status::Solved && found.residuals.worst() > request.tolerance {
        found.status = Status::AlmostSolved;
    }
    Ok(answer(sparse, found, wall.without_films().displacements()))
}

/// Returns the normal and the tangential forces of all contact points; the forces of points in films are the responses
/// of the films.
fn at_points(model: &Model, wall: &MortaredWall, found: &ContactState) -> (Vec<f64>, Vec<f64>) {
    let mut films = wall.films().iter().flat_map(|film| film.respond(&found.u).points);
    let mut dry = found.t_n.iter().zip(&found.t_t);
    let forces = model.contacts.iter().map(|contact| match contact.film {
        // Adding zero turns a force of -0.0 into 0.0.
        Some(_) => films.next().map_or((0.0, 0.0), |point| {
            (0.0 - point.stress.y * contact.weight, 0.0 - point.stress.z * contact.weight)
        }),
        None => dry.next().map_or((0.0, 0.0), |(t_n, t_t)| (*t_n, *t_t)),
    });
    forces.unzip()
}

/// Makes an observer of iterations that reports them as events of the route.
fn told(observer: EventObserver<'_>) -> impl FnMut(&AlmIteration) -> std::ops::ControlFlow<()> {
    let mut number = 0;
    move |at| {
        number += 1;
        observer(Event::Iteration { number, residual: at.unbalance })
    }
}

/// Makes the answer of the route; `order` is the order of its linear systems.
fn answer(sparse: &Sparse, found: AlmAnswer, order: usize) -> method::RouteAnswer {
    let info = SolveInfo {
        iterations: found.convergence.len(),
        factorisations: found.factorisations,
        convergence: found.convergence,
        ..SolveInfo::new(Route::Alm, found.status, found.residuals)
    };
    let mut answer = sparse::answer(sparse, info, found.state);
    answer.info.order = order;
    answer
}
