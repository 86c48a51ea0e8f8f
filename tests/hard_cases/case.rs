//! A hard case, and what every route gives for it.

use lcp::Status;
use masonry::outcome::Outcome;
use masonry::scene::{Route, Scene};
use masonry::solve::{SolveError, solve};

use super::checks::Errors;
use super::common::routes::ROUTES;

/// What is known about the answer.
pub enum Truth {
    /// Numbers in closed form: the largest relative error of an answer in them.
    Known(Box<dyn Fn(&Outcome) -> f64 + Send + Sync>),
    /// There may be several answers, or none: what is called one has to be one.
    Open,
    /// Nothing stands.
    Falls,
}

/// A case of the catalogue.
pub struct Case {
    pub name: String,
    pub why: &'static str,
    pub parameters: String,
    pub expected: String,
    pub scene: Scene,
    pub truth: Truth,
    /// Routes that would take minutes.
    pub slow: Vec<Route>,
}

/// A list of cases that are hard for one reason.
pub struct Theme {
    pub title: &'static str,
    pub cases: Vec<Tried>,
}

/// A case with what the routes gave.
pub struct Tried {
    pub case: Case,
    pub ends: Vec<End>,
}

/// What one route gave.
pub enum End {
    /// What it calls solved.
    Solved { outcome: Box<Outcome>, errors: Errors },
    /// It says that it found nothing.
    GaveUp { status: Status, residual: f64 },
    /// It does not treat such scenes.
    Refused,
    /// It would take minutes.
    Slow,
}

impl Case {
    pub fn new(name: &str, why: &'static str, scene: Scene) -> Self {
        let (parameters, expected) = (String::new(), String::new());
        let (name, slow) = (name.to_owned(), Vec::new());
        Self { name, why, parameters, expected, scene, truth: Truth::Open, slow }
    }

    #[must_use]
    pub fn slow_by(mut self, routes: &[Route]) -> Self {
        self.slow.extend(routes);
        self
    }

    #[must_use]
    pub fn parameters(mut self, parameters: &str) -> Self {
        parameters.clone_into(&mut self.parameters);
        self
    }

    /// An answer in closed form, `expected` in words.
    #[must_use]
    pub fn known(
        mut self,
        expected: &str,
        error: impl Fn(&Outcome) -> f64 + Send + Sync + 'static,
    ) -> Self {
        expected.clone_into(&mut self.expected);
        self.truth = Truth::Known(Box::new(error));
        self
    }

    #[must_use]
    pub fn open(mut self, expected: &str) -> Self {
        expected.clone_into(&mut self.expected);
        self
    }

    #[must_use]
    pub fn falls(mut self, expected: &str) -> Self {
        expected.clone_into(&mut self.expected);
        self.truth = Truth::Falls;
        self
    }

    pub fn tried(self) -> Tried {
        let ends = ROUTES.map(|route| self.by(route)).into();
        Tried { case: self, ends }
    }

    fn by(&self, route: Route) -> End {
        if self.slow.contains(&route) {
            return End::Slow;
        }
        match solve(&self.scene.clone().route(route).tolerance(asked(route))) {
            Ok(outcome) if outcome.solve.status == Status::Solved => {
                End::Solved { errors: Errors::of(&outcome), outcome: Box::new(outcome) }
            }
            Ok(outcome) => End::GaveUp {
                status: outcome.solve.status,
                residual: outcome.solve.residuals.worst(),
            },
            Err(SolveError::Solver(lcp::Error::NotTreated { .. })) => End::Refused,
            Err(error) => panic!("{} by {route:?}: {error}", self.name),
        }
    }
}

impl Tried {
    /// What is wrong with what is called solved, a line for each route.
    pub fn wrong(&self) -> Vec<String> {
        let mut list = Vec::new();
        let name = &self.case.name;
        for (route, end) in ROUTES.into_iter().zip(&self.ends) {
            let End::Solved { outcome, errors } = end else { continue };
            let bound = bound(route);
            if errors.worst() > bound {
                list.push(format!("{name} by {route:?}: {errors:?} above {bound:e}"));
            }
            match &self.case.truth {
                Truth::Known(error) => {
                    let error = error(outcome);
                    if error.is_nan() || error > bound {
                        list.push(format!(
                            "{name} by {route:?}: off by {error:e}, above {bound:e}"
                        ));
                    }
                }
                Truth::Open => {}
                Truth::Falls => list.push(format!("{name} by {route:?}: nothing stands")),
            }
        }
        let is_solved = self.ends.iter().any(|end| matches!(end, End::Solved { .. }));
        if matches!(self.case.truth, Truth::Known(_)) && !is_solved {
            list.push(format!("{name}: solved by no route"));
        }
        list
    }
}

/// The residual that is asked for: the augmented Lagrangian method converges by a fixed factor only.
fn asked(route: Route) -> f64 {
    if route == Route::Alm { 1e-8 } else { 1e-10 }
}

/// The largest error of an answer. The routes are asked for residuals relative to the largest forces and
/// displacements; single blocks may have a hundred times as much.
fn bound(route: Route) -> f64 {
    100.0 * asked(route)
}
