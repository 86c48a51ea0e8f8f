//! Scenes whose films are whole strips: the contact points in films take no part in the iterations, and have the
//! answers of the films afterwards.

use lcp::{ContactState, Status};

use super::{MortaredError, MortaredWall, Settings};
use crate::data::info::SolveInfo;
use crate::forms::Sparse;
use crate::method::sparse;
use crate::method::{Answer, Method, Observer, Request, RouteError, RouteProgress};
use crate::model::Model;
use crate::scene::Route;
use crate::system::System;

/// The iteration goes on until it is better than the tolerance by this factor, because residuals of the problem
/// with contact points in the films are measured row by row.
const BETTER: f64 = 0.1;

/// The route on a model with strips.
#[derive(Debug, Clone, Copy)]
pub struct Strips<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its system.
    pub system: &'a System,
    /// The same with contact points in the films, by which the answer is judged.
    pub sparse: &'a Sparse,
}

impl Strips<'_> {
    /// Displacements and forces of the problem with contact points in the films.
    fn with_points(&self, wall: &MortaredWall, found: &ContactState) -> ContactState {
        let films = wall.films().iter().flat_map(|film| film.respond(&found.u).points);
        let (mut films, mut dry) = (films, found.t_n.iter().zip(&found.t_t));
        let forces = self.model.contacts.iter().map(|contact| match contact.film {
            Some(_) => films.next().map_or([0.0; 2], |point| {
                // Adding zero turns a force of -0.0 into 0.0.
                [0.0 - point.stress.y * contact.weight, 0.0 - point.stress.z * contact.weight]
            }),
            None => dry.next().map_or([0.0; 2], |(t_n, t_t)| [*t_n, *t_t]),
        });
        let (t_n, t_t): (Vec<f64>, Vec<f64>) = forces.map(|[t_n, t_t]| (t_n, t_t)).unzip();
        let friction = self.system.friction.iter();
        let tangential: Vec<f64> = friction.map(|it| t_t[it.contact.index()]).collect();
        // What follows the blocks is another list in the problem with points in the films.
        let blocks = self.sparse.starts().last().copied().unwrap_or_default();
        self.sparse.with_forces(self.system, found.u[..blocks].to_vec(), &t_n, &tangential)
    }
}

impl Method for Strips<'_> {
    fn solve(&self, request: &Request, observer: Observer<'_>) -> Result<Answer, RouteError> {
        let wall = MortaredWall::new(self.model)?;
        let settings = Settings { tolerance: BETTER * request.tolerance, ..Settings::default() };
        let mut number = 0;
        let answer = wall.solve(&settings, &mut |at| {
            number += 1;
            observer(RouteProgress::Iteration { number, residual: at.unbalance })
        })?;
        let state = self.with_points(&wall, &answer.state);
        let residuals = self.sparse.problem.residuals(&state);
        let status = match answer.status {
            Status::Solved if residuals.worst() > request.tolerance => Status::AlmostSolved,
            status => status,
        };
        let info = SolveInfo {
            iterations: answer.convergence.len(),
            factorisations: answer.factorisations,
            convergence: answer.convergence,
            ..SolveInfo::new(Route::Alm, status, residuals)
        };
        let mut answer = sparse::answer(self.sparse, info, state);
        answer.info.order = wall.without_films().displacements();
        Ok(answer)
    }
}

impl From<MortaredError> for RouteError {
    fn from(error: MortaredError) -> Self {
        match error {
            MortaredError::Data(error) => error.into(),
            other => Self::NotTreated {
                route: Route::Alm,
                reason: format!("{other}, or take another route"),
            },
        }
    }
}
