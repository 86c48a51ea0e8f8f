//! A hard problem, and what every method gives for it.

use lcp::{Error, HorizontalLcp, LemkeSettings, Solution, Status};
use lcp_problems::exact::{
    EnumerationSettings, ExactEnumeration, Feasibility, enumerate, feasibility,
};
use lcp_problems::families::{Instance, KnownAnswer};

use super::data::Point;
use super::measure::{Measure, is_proof, largest, of_general};
use super::problem::{ASKED, Method, Problem};

/// What is known about the answers.
pub enum Truth {
    /// There is one, exactly this one for the data as they are; with the condition number of its basis.
    Unique { t: Vec<f64>, y: Vec<f64>, condition: f64, units: Option<Point> },
    /// This is one of them, exactly.
    Planted { t: Vec<f64>, y: Vec<f64> },
    /// All of them, in rational numbers.
    All(ExactEnumeration),
    /// There is one.
    Solvable,
    /// There is none.
    None,
}

/// A problem of the catalogue.
pub struct Case {
    pub name: String,
    pub why: &'static str,
    pub parameters: String,
    pub problem: Problem,
    pub truth: Truth,
    /// What is known, in words.
    pub expected: String,
    /// The settings of Lemke's method.
    pub lemke: LemkeSettings,
}

/// Problems that are hard for one reason, with what the methods gave.
pub struct Theme {
    pub title: &'static str,
    pub cases: Vec<Tried>,
}

pub struct Tried {
    pub case: Case,
    pub ends: Vec<End>,
}

/// What one method gave.
pub enum End {
    /// It does not treat the problem.
    Refused,
    Ended {
        solution: Box<Solution>,
        measure: Measure,
    },
}

/// Orders up to which rational arithmetic is asked.
const ENUMERATED: usize = 12;
const PROVED: usize = 30;

impl Case {
    pub fn new(name: &str, why: &'static str, problem: Problem) -> Self {
        Self {
            name: name.to_owned(),
            why,
            parameters: String::new(),
            problem,
            truth: Truth::Solvable,
            expected: "solvable".to_owned(),
            lemke: LemkeSettings::default(),
        }
    }

    /// A problem of a family, with what is known of it; `condition` is that of its basis.
    pub fn of<P>(
        name: &str,
        why: &'static str,
        instance: Instance<P>,
        (problem, condition): (fn(P) -> Problem, f64),
    ) -> Self {
        let case = Self::new(name, why, problem(instance.problem));
        let pairs = |t: Vec<f64>, y: Vec<f64>| match &case.problem {
            Problem::Mixed(mixed) => mixed.to_pairs(&t, &y),
            _ => (t, y),
        };
        match instance.known {
            KnownAnswer::Unique { t, y } => {
                let point = pairs(t, y);
                case.unique(point, condition)
            }
            KnownAnswer::Solution { t, y } => {
                let point = pairs(t, y);
                case.planted(point)
            }
            KnownAnswer::Infeasible { .. } => case.unsolvable("no solution, with a planted proof"),
            KnownAnswer::Solvable => case,
        }
    }

    #[must_use]
    pub fn parameters(mut self, parameters: &str) -> Self {
        parameters.clone_into(&mut self.parameters);
        self
    }

    #[must_use]
    pub fn unique(mut self, (t, y): Point, condition: f64) -> Self {
        "one solution, planted".clone_into(&mut self.expected);
        self.truth = Truth::Unique { t, y, condition, units: None };
        self
    }

    /// One solution, every number of which is compared in a unit of its own.
    #[must_use]
    pub fn unique_in(self, point: Point, condition: f64, units: Point) -> Self {
        let mut case = self.unique(point, condition);
        if let Truth::Unique { units: none, .. } = &mut case.truth {
            *none = Some(units);
        }
        case
    }

    #[must_use]
    pub fn planted(mut self, (t, y): Point) -> Self {
        "a solution is planted, and there may be more".clone_into(&mut self.expected);
        self.truth = Truth::Planted { t, y };
        self
    }

    #[must_use]
    pub fn solvable(mut self, expected: &str) -> Self {
        expected.clone_into(&mut self.expected);
        self
    }

    #[must_use]
    pub fn unsolvable(mut self, expected: &str) -> Self {
        expected.clone_into(&mut self.expected);
        self.truth = Truth::None;
        self
    }

    /// All solutions, counted.
    #[must_use]
    pub fn enumerated(mut self) -> Self {
        let all = enumerate(&self.problem.general(), &EnumerationSettings::default()).unwrap();
        let points = all.faces.iter().filter(|face| face.dimension == 0).count();
        let wider = all.faces.len() - points;
        self.expected = match (points, wider) {
            (0, 0) if all.is_feasible() => {
                "no solution, only points without complementarity".to_owned()
            }
            (0, 0) => "no solution, even without complementarity".to_owned(),
            (1, 0) => "one solution".to_owned(),
            (_, 0) => format!("{points} solutions"),
            (0, 1) => "a continuum of solutions".to_owned(),
            (0, _) => format!("{wider} continua of solutions"),
            _ => format!("solutions: {points} isolated, and {wider} in continua"),
        };
        self.expected.push_str(", by enumeration");
        self.truth = Truth::All(all);
        self
    }

    #[must_use]
    pub fn lemke(mut self, settings: LemkeSettings) -> Self {
        self.lemke = settings;
        self
    }

    pub fn tried(self) -> Tried {
        let ends = Method::ALL.map(|method| self.by(method)).into();
        Tried { case: self, ends }
    }

    pub fn by(&self, method: Method) -> End {
        match self.problem.by(method, &self.lemke) {
            Some(Ok(solution)) => {
                let measure = Measure::of(&self.problem, &solution);
                End::Ended { solution: Box::new(solution), measure }
            }
            None | Some(Err(Error::NotTreated { .. })) => End::Refused,
            Some(Err(error)) => panic!("{} by {}: {error}", self.name, method.name()),
        }
    }
}

impl Tried {
    /// What is wrong with answers and with claims that there are none, a line for each.
    pub fn wrong(&self) -> Vec<String> {
        let case = &self.case;
        let general = case.problem.general();
        let mut list = case.untrue(&general);
        let mut is_solved = false;
        for (method, end) in Method::ALL.into_iter().zip(&self.ends) {
            let End::Ended { solution, measure } = end else { continue };
            let wrong = match solution.status {
                Status::Solved => {
                    is_solved = true;
                    case.wrong_answer(solution, *measure)
                }
                Status::Infeasible => case.wrong_proof(&general, solution),
                _ => None,
            };
            list.extend(wrong.map(|it| format!("{} by {}: {it}", case.name, method.name())));
        }
        let is_certain = matches!(case.truth, Truth::Unique { .. } | Truth::Planted { .. });
        if is_certain && !is_solved {
            list.push(format!("{}: solved by no method", case.name));
        }
        list
    }
}

impl Case {
    pub fn is_solvable(&self) -> bool {
        match &self.truth {
            Truth::All(all) => all.is_solvable(),
            Truth::None => false,
            _ => true,
        }
    }

    /// Where what is said to be known is wrong itself.
    fn untrue(&self, general: &HorizontalLcp) -> Vec<String> {
        let mut list = Vec::new();
        if let Truth::Unique { t, y, .. } | Truth::Planted { t, y } = &self.truth {
            let residual = of_general(general, (t, y)).residual;
            if residual != 0.0 {
                list.push(format!("{}: the planted answer is off by {residual:e}", self.name));
            }
        }
        if general.order() <= ENUMERATED && !matches!(self.truth, Truth::All(_)) {
            let all = enumerate(general, &EnumerationSettings::default()).unwrap();
            let is_true = match &self.truth {
                Truth::Unique { .. } => all.unique().is_some(),
                _ => all.is_solvable() == self.is_solvable(),
            };
            if !is_true {
                list.push(format!("{}: {} faces of solutions", self.name, all.faces.len()));
            }
        }
        list
    }

    fn wrong_answer(&self, solution: &Solution, measure: Measure) -> Option<String> {
        // The last digits of the residual itself are rounded where the library computes it.
        if measure.residual.is_nan() || measure.residual > ASKED * (1.0 + 1e-4) {
            return Some(format!("called solved, with the residual {:e}", measure.residual));
        }
        match &self.truth {
            Truth::Unique { t, y, condition, units } => {
                let (bound, error) = match units {
                    None => (
                        FACTOR * condition * measure.residual.max(f64::EPSILON),
                        distance(&solution.t, t).max(distance(&solution.y, y)),
                    ),
                    // What is asked for in units that the residual does not know.
                    Some((t_units, y_units)) => (
                        FACTOR * condition * ASKED,
                        apart(&solution.t, t, t_units).max(apart(&solution.y, y, y_units)),
                    ),
                };
                let is_far = bound < 1.0 && (error.is_nan() || error > bound);
                is_far.then(|| format!("off by {error:e}, more than {bound:e}"))
            }
            Truth::All(all) if !all.is_solvable() => Some("there is no solution".to_owned()),
            Truth::All(all) if all.faces.iter().all(|face| face.dimension == 0) => {
                let apart = all.faces.iter().map(|face| {
                    let (t, y) = face.vertices[0].rounded();
                    distance(&solution.t, &t).max(distance(&solution.y, &y))
                });
                let apart = apart.fold(f64::INFINITY, f64::min);
                (apart > 1e-6).then(|| format!("{apart:e} away from all solutions"))
            }
            Truth::None => Some("there is no solution".to_owned()),
            _ => None,
        }
    }

    fn wrong_proof(&self, general: &HorizontalLcp, solution: &Solution) -> Option<String> {
        if self.is_solvable() {
            return Some("there is a solution".to_owned());
        }
        let is_proved = solution.farkas().is_some_and(|pi| is_proof(general, pi));
        if !is_proved {
            return Some("the proof is none".to_owned());
        }
        let is_feasible =
            general.order() <= PROVED && matches!(feasibility(general), Feasibility::Feasible(_));
        is_feasible.then(|| "the linear conditions can be met".to_owned())
    }
}

/// The error of an answer may be this many times its residual and the condition number.
const FACTOR: f64 = 10.0;

/// The largest difference in these units.
fn apart(found: &[f64], expected: &[f64], units: &[f64]) -> f64 {
    let pairs = found.iter().zip(expected).zip(units);
    pairs.map(|((a, b), unit)| ((a - b) / unit).abs()).fold(0.0, f64::max)
}

/// The largest difference, relative to the largest entry of what is expected.
fn distance(found: &[f64], expected: &[f64]) -> f64 {
    let differences: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
    let (apart, size) = (largest(&differences), largest(expected));
    if apart > 0.0 && size > 0.0 { apart / size } else { apart }
}
