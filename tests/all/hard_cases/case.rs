//! A hard case, and what every route gives for it.

use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::scene::{Route, Scene};
use masonry::verify::checks::Checks;

use super::common::routes::ROUTES;
use super::common::state;

/// What is known about the answer.
pub enum Truth {
    /// Numbers in closed form: the largest relative error of an answer in them.
    Known(Box<dyn Fn(&Outcome) -> f64 + Send + Sync>),
    /// There may be several answers, or none: what is called one has to be one.
    Open,
    /// Nothing stands: the load is too large by this part of it, and answers to errors above that are none.
    Falls(f64),
}

/// A case of the catalogue.
pub struct Case {
    pub name: String,
    pub why: &'static str,
    pub parameters: String,
    pub expected: String,
    pub scene: Scene,
    pub truth: Truth,
    /// How much larger the errors of a known answer are than the residuals that cause them.
    pub amplified: f64,
    /// Routes that would take minutes.
    pub slow: Vec<Route>,
    /// Routes that take seconds.
    pub long: Vec<Route>,
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
    Solved { outcome: Box<Outcome>, checks: Checks },
    /// It says that it found nothing.
    GaveUp { outcome: Box<Outcome> },
    /// It does not treat such scenes.
    Refused,
    /// It would take minutes, or it is left to the long tests.
    Slow,
}

impl Case {
    pub fn new(name: &str, why: &'static str, scene: Scene) -> Self {
        let (parameters, expected) = (String::new(), String::new());
        let (slow, long) = (Vec::new(), Vec::new());
        Self {
            name: name.to_owned(),
            why,
            parameters,
            expected,
            scene,
            truth: Truth::Open,
            amplified: 1.0,
            slow,
            long,
        }
    }

    #[must_use]
    pub fn slow_by(mut self, routes: &[Route]) -> Self {
        self.slow.extend(routes);
        self
    }

    #[must_use]
    pub fn long_by(mut self, routes: &[Route]) -> Self {
        self.long.extend(routes);
        self
    }

    /// Without the routes that take seconds.
    #[must_use]
    pub fn shortened(mut self) -> Self {
        self.slow.append(&mut self.long);
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
    pub fn amplified(mut self, by: f64) -> Self {
        self.amplified = by.max(1.0);
        self
    }

    #[must_use]
    pub fn open(mut self, expected: &str) -> Self {
        expected.clone_into(&mut self.expected);
        self
    }

    /// Nothing stands: loads would have to be less by this part of them.
    #[must_use]
    pub fn falls_by(mut self, part: f64, expected: &str) -> Self {
        expected.clone_into(&mut self.expected);
        self.truth = Truth::Falls(part);
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
                // Anew: a history ends in a state that is not the one of its last solution.
                let checks = Checks::of(&outcome.model, state(&outcome));
                End::Solved { checks, outcome: Box::new(outcome) }
            }
            Ok(outcome) => End::GaveUp { outcome: Box::new(outcome) },
            Err(error) if error.is_refusal() => End::Refused,
            Err(error) => panic!("{} by {route:?}: {error}", self.name),
        }
    }
}

impl Tried {
    /// What is wrong with what is called solved, a line for each route. `bound` is how far a known answer may be off.
    pub fn wrong(&self, bound: fn(Route, &Checks) -> f64) -> Vec<String> {
        let mut list = Vec::new();
        let name = &self.case.name;
        for (route, end) in ROUTES.into_iter().zip(&self.ends) {
            let End::Solved { outcome, checks } = end else { continue };
            let bound = bound(route, checks) * self.case.amplified;
            if !checks.hold(asked(route)) {
                list.push(format!("{name} by {route:?}: {checks:?}"));
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
                Truth::Falls(part) if *part > ABOVE * asked(route) => {
                    list.push(format!("{name} by {route:?}: nothing stands"));
                }
                Truth::Open | Truth::Falls(_) => {}
            }
        }
        list
    }

    /// Whether no route has an answer, although there is one.
    pub fn is_unsolved(&self) -> bool {
        let is_solved = self.ends.iter().any(|end| matches!(end, End::Solved { .. }));
        matches!(self.case.truth, Truth::Known(_)) && !is_solved
    }
}

/// A load above its limit is less of all terms of the equations that it is in.
const ABOVE: f64 = 20.0;

/// The required residual: the augmented Lagrangian method converges by a fixed factor only.
fn asked(route: Route) -> f64 {
    if route == Route::Alm { 1e-8 } else { 1e-10 }
}

/// How far answers of the catalogue may be off. The routes are asked for residuals relative to the
/// largest forces and displacements; single numbers may have a hundred times as much.
pub fn strict(route: Route, _: &Checks) -> f64 {
    100.0 * asked(route)
}

/// How far answers may be off, whatever the parameters: residuals are relative to the largest forces,
/// and on the block with the least ones they are as much larger. But every block carries its load to a thousandth.
pub fn promised(route: Route, checks: &Checks) -> f64 {
    strict(route, checks).max((10.0 * asked(route) * checks.spread).min(1e-3))
}
