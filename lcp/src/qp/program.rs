//! A form that is solved: interior point, polish, and the best of what was met.

use std::cell::OnceCell;

use super::form::{Form, Point};
use super::interior::{Effort, End, Interior};
use super::polish::{places_of, polish};
use super::reduced::{Law, Place};
use super::scale::Scaled;
use crate::{Contact2d, ContactState, Residuals};

/// A point of the general problem with its residuals.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    pub(super) t: Vec<f64>,
    pub(super) y: Vec<f64>,
    /// The state that it is, of a contact problem.
    pub(super) contact: Option<ContactState>,
    pub(super) residuals: Residuals,
}

impl Candidate {
    /// The point that a state of a contact problem is.
    pub(super) fn of(contact: &Contact2d, state: &ContactState) -> Self {
        let (t, y) = contact.to_pairs(state);
        Self { t, y, contact: Some(state.clone()), residuals: contact.residuals(state) }
    }
}

/// Makes the point of the general problem from unknowns in the units of the user and, after a polish, the
/// places of the multipliers.
pub(super) type Assemble<'a> = dyn Fn(&Point, Option<&[Place]>) -> Candidate + 'a;

/// The proof that there is no solution, looked for at most once.
pub(super) struct Proof<'a> {
    search: &'a dyn Fn() -> Option<Vec<f64>>,
    answer: OnceCell<Option<Vec<f64>>>,
}

impl<'a> Proof<'a> {
    pub(super) fn new(search: &'a dyn Fn() -> Option<Vec<f64>>) -> Self {
        Self { search, answer: OnceCell::new() }
    }

    pub(super) fn is_found(&self) -> bool {
        self.answer.get_or_init(self.search).is_some()
    }

    pub(super) fn into_farkas(self) -> Option<Vec<f64>> {
        self.answer.into_inner().unwrap_or_else(self.search)
    }
}

/// The best point so far, and what it cost.
pub(super) struct Best {
    pub(super) candidate: Candidate,
    /// Its worst residual, also in units of the loads.
    pub(super) residual: f64,
    pub(super) factorisations: usize,
}

impl Best {
    /// The zero point of a form.
    pub(super) fn new(scaled: &Scaled, assemble: &Assemble<'_>) -> Self {
        let zero = Point::zero(&scaled.form);
        let candidate = assemble(&zero, None);
        let residual = candidate.residuals.worst();
        Self { candidate, residual, factorisations: 0 }
    }

    /// Takes a scaled point if it is better.
    pub(super) fn offer(
        &mut self,
        scaled: &Scaled,
        (point, places): (&Point, Option<&[Place]>),
        assemble: &Assemble<'_>,
    ) -> f64 {
        let candidate = assemble(&scaled.unscaled(point), places);
        let residual = candidate.residuals.worst();
        if residual < self.residual {
            (self.candidate, self.residual) = (candidate, residual);
        }
        residual
    }

    /// Polishes a scaled point, from the places that it suggests.
    pub(super) fn polish(
        &mut self,
        scaled: &Scaled,
        law: Law<'_>,
        start: &Point,
        assemble: &Assemble<'_>,
    ) {
        let places = places_of(&scaled.form, law, start);
        self.polish_from(scaled, law, (places, start), assemble);
    }

    /// Polishes the zero point, which may be good to a tolerance that is large.
    pub(super) fn polish_zero(&mut self, scaled: &Scaled, assemble: &Assemble<'_>) {
        if self.residual > EXACT {
            self.polish(scaled, Law::Coulomb, &Point::zero(&scaled.form), assemble);
        }
    }

    /// Polishes from given places.
    pub(super) fn polish_from(
        &mut self,
        scaled: &Scaled,
        law: Law<'_>,
        start: (Vec<Place>, &Point),
        assemble: &Assemble<'_>,
    ) {
        let systems = polish(&scaled.form, law, start, &mut |point, places| {
            self.offer(scaled, (point, Some(places)), assemble) <= EXACT
        });
        self.factorisations += systems;
    }
}

/// Residuals at which there is nothing left to gain.
const EXACT: f64 = 1e-15;

/// Solves a form without cones: one run of the interior-point method and a polish.
pub(super) fn solve_convex(
    scaled: &Scaled,
    effort: Effort,
    assemble: &Assemble<'_>,
    best: &mut Best,
) -> End {
    let form = &scaled.form;
    let limits = vec![0.0; form.rows()];
    let law = Law::Tresca(&limits);
    if form.is_linear() {
        best.polish(scaled, law, &Point::zero(form), assemble);
        return End::Point;
    }
    let Some(mut interior) = Interior::new(form, effort) else { return End::Failed };
    let found = interior.solve(form, &limits, effort.time);
    best.factorisations += found.iterations;
    if matches!(found.end, End::Point | End::IterationLimit | End::TimeLimit) {
        best.offer(scaled, (&found.point, None), assemble);
        best.polish(scaled, law, &found.point, assemble);
    }
    found.end
}

impl Form {
    /// Whether there is nothing but equations.
    fn is_linear(&self) -> bool {
        self.bounds.iter().all(|bounds| *bounds == super::form::Bounds::Free)
    }
}
