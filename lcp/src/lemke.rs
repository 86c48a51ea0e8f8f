//! Lemke's method on the general form.

mod finish;
mod path;
mod ratio;
mod start;
mod tableau;

use std::ops::ControlFlow;
use std::time::Instant;

use finish::{Point, solve_basis};
use path::{Limits, Path, StartTableau};
use start::Equilibrated;

use crate::random::SplitMix;
use crate::{
    Attempt, AttemptEnd, Basis, Covering, Error, HorizontalLcp, Info, LemkeSettings, Ray, Side,
    Solution, Status,
};

/// How far a solve has come, for an observer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// The attempt, from 1.
    pub attempt: usize,
    /// Pivots of this attempt.
    pub pivots: usize,
    /// Order of the problem.
    pub order: usize,
}

/// Lemke's method (Lemke 1965; Cottle, Pang and Stone, *The Linear Complementarity Problem*,
/// section 4.4) on the general form `A t + B y = c` as it stands.
///
/// A nonsingular complementary basis, given or found, turns the problem into `w + T z = q`, which
/// is equilibrated by powers of two. The artificial variable `z0` enters with the covering vector
/// `d`, and complementary pivots follow until it leaves. Ties go to `z0` first, then to the
/// lexicographic rule. The tableau is checked against the data in every block of pivots and
/// rebuilt when it has drifted; the final basis is solved anew from the original matrices,
/// refined, and called [`Solved`](Status::Solved) only if its residuals, computed from the
/// original data, are below the tolerance.
///
/// # Guarantee
/// With exact arithmetic a solution, or a proof that there is none, for copositive-plus `M` (which
/// includes positive semidefinite `M`) in the standard form. For other classes the path may end on
/// a secondary ray although a solution exists: then other covering vectors and start bases are
/// tried, every attempt is recorded in [`Info::attempts`], and after the last one the status is
/// [`RayTermination`](Status::RayTermination), which is not a proof.
///
/// # Cost
/// Memory of about nine dense matrices of order `n` at the peak; a pivot costs about `200 n` flops and its
/// share of a blocked matrix product, `2 n^2` flops.
#[derive(Debug, Clone, Default)]
pub struct Lemke {
    settings: LemkeSettings,
}

impl Lemke {
    /// A solver with the given settings.
    pub fn new(settings: LemkeSettings) -> Self {
        Self { settings }
    }

    /// Solves a problem.
    ///
    /// # Errors
    /// For settings out of range. What the mathematics decides is in [`Solution::status`].
    pub fn solve(&self, problem: &HorizontalLcp) -> Result<Solution, Error> {
        self.solve_observed(problem, &mut |_| ControlFlow::Continue(()))
    }

    /// Solves a problem, calling the observer once in every block of pivots; `Break` stops with
    /// [`Status::Cancelled`].
    ///
    /// # Errors
    /// For settings out of range. What the mathematics decides is in [`Solution::status`].
    pub fn solve_observed(
        &self,
        problem: &HorizontalLcp,
        observer: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        let began = Instant::now();
        let mut solution = Search::new(&self.settings, problem).run(observer);
        solution.info.seconds = began.elapsed().as_secs_f64();
        Ok(solution)
    }
}

/// What an attempt varies besides its start basis.
struct Trial {
    covering: Covering,
    /// Seed of the perturbation of the right-hand side.
    perturbation: Option<u64>,
}

impl Trial {
    /// After a cycle the same once more without ties; else another covering vector, and plain data
    /// only where the last basis is nearly right.
    fn after(last: &Self, end: AttemptEnd, seed: u64) -> Self {
        let covering = match (end, &last.covering) {
            (AttemptEnd::Cycle, covering) if last.perturbation.is_none() => covering.clone(),
            (_, Covering::Random { .. }) => Covering::Ones,
            _ => Covering::Random { seed },
        };
        let perturbation = (end != AttemptEnd::Complementary).then_some(seed);
        Self { covering, perturbation }
    }
}

/// The attempts on one problem.
struct Search<'a> {
    settings: &'a LemkeSettings,
    problem: &'a HorizontalLcp,
    scaling: Equilibrated,
    info: Info,
    /// The best complementary point so far that is above the tolerance.
    almost: Option<(Point, Basis)>,
    ray: Option<Ray>,
}

impl<'a> Search<'a> {
    fn new(settings: &'a LemkeSettings, problem: &'a HorizontalLcp) -> Self {
        let scaling = Equilibrated::new(problem);
        Self { settings, problem, scaling, info: Info::default(), almost: None, ray: None }
    }

    fn run(mut self, observer: &mut dyn FnMut(&Progress) -> ControlFlow<()>) -> Solution {
        if self.problem.c().iter().all(|&c| c == 0.0) {
            return self.give_up(Status::Solved);
        }
        let (mut start, mut name) = match self.first_start() {
            Ok(found) => found,
            Err(status) => return self.give_up(status),
        };
        let first = start.clone();
        let mut trial = Trial { covering: self.first_covering(&first), perturbation: None };
        for attempt in 1..=self.settings.max_attempts {
            let seed = attempt as u64;
            let (end, basis) = self.attempt(&start, &name, &trial, attempt, observer);
            trial = Trial::after(&trial, end, seed);
            match (end, basis) {
                (AttemptEnd::Cancelled, _) => return self.give_up(Status::Cancelled),
                (_, Some(basis)) => {
                    let point = solve_basis(self.problem, &self.scaling, &basis);
                    self.note_residual(point.as_ref());
                    if let Some(point) = point {
                        if point.residuals.worst() <= self.settings.tolerance {
                            return self.answer(Status::Solved, point, basis);
                        }
                        self.keep_better(point, basis.clone());
                    }
                    // A basis that is nearly right is the best place to go on from.
                    if let Some(next) = self.scaling.tableau(&basis, self.problem.c()) {
                        (start, name) = (next, "last basis".to_owned());
                    }
                }
                (AttemptEnd::Ray, None) if attempt % 2 == 0 => {
                    let flipped = first.flipped(seed);
                    if let Some(next) = self.scaling.tableau(&flipped, self.problem.c()) {
                        (start, name) = (next, format!("flipped, seed {seed}"));
                    }
                }
                _ => {}
            }
        }
        self.conclude()
    }

    fn first_start(&self) -> Result<(StartTableau, String), Status> {
        let c = self.problem.c();
        if let Some(given) = &self.settings.start
            && let Some(start) = self.scaling.tableau(given, c)
        {
            return Ok((start, "given".to_owned()));
        }
        let basis = self.scaling.find_basis().ok_or(Status::NoComplementaryBasis)?;
        let name = match basis.sides() {
            sides if sides.iter().all(|&side| side == Side::Y) => "all y",
            sides if sides.iter().all(|&side| side == Side::T) => "all t",
            _ => "found",
        };
        let start = self.scaling.tableau(&basis, c).ok_or(Status::NumericalTrouble)?;
        Ok((start, name.to_owned()))
    }

    /// The covering vector asked for; one that was given refers to the rows of the start basis that
    /// was given with it, and not to those of another.
    fn first_covering(&self, start: &StartTableau) -> Covering {
        match (&self.settings.covering, &self.settings.start) {
            (Covering::Given(_), Some(given)) if *given != start.basis => Covering::Ones,
            (covering, _) => covering.clone(),
        }
    }

    fn attempt(
        &mut self,
        start: &StartTableau,
        name: &str,
        trial: &Trial,
        attempt: usize,
        observer: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> (AttemptEnd, Option<Basis>) {
        let order = self.problem.order();
        let max_pivots = self.settings.max_pivots.unwrap_or(100 * order + 1000);
        let mut keep_going = |pivots| observer(&Progress { attempt, pivots, order }).is_continue();
        let mut path =
            Path::new(start, covering_entries(&trial.covering, start), trial.perturbation);
        let end = path.run(&mut Limits { max_pivots, keep_going: &mut keep_going });
        self.info.pivots += path.pivots;
        self.info.refactorisations += path.refactorisations;
        self.info.attempts.push(Attempt {
            start: name.to_owned(),
            covering: covering_name(&trial.covering),
            perturbed: trial.perturbation.is_some(),
            end,
            pivots: path.pivots,
            residual: None,
        });
        if end == AttemptEnd::Ray && self.ray.is_none() {
            self.ray = Some(in_problem_units(&path, start, self.problem));
        }
        (end, (end == AttemptEnd::Complementary).then(|| path.basis()))
    }

    /// What the original data says of the last attempt's basis.
    fn note_residual(&mut self, point: Option<&Point>) {
        if let Some(attempt) = self.info.attempts.last_mut() {
            match point {
                Some(point) => attempt.residual = Some(point.residuals.worst()),
                None => attempt.end = AttemptEnd::Singular,
            }
        }
    }

    fn keep_better(&mut self, point: Point, basis: Basis) {
        let worst = point.residuals.worst();
        if self.almost.as_ref().is_none_or(|(best, _)| worst < best.residuals.worst()) {
            self.almost = Some((point, basis));
        }
    }

    /// No attempt reached the tolerance: the best point if it is near, else what the attempts say.
    fn conclude(mut self) -> Solution {
        if let Some((point, basis)) = self.almost.take()
            && point.residuals.worst() <= self.settings.tolerance.sqrt()
        {
            return self.answer(Status::AlmostSolved, point, basis);
        }
        let ended = |end| self.info.attempts.iter().any(|attempt| attempt.end == end);
        let status = if ended(AttemptEnd::Ray) {
            Status::RayTermination
        } else if ended(AttemptEnd::PivotLimit) {
            Status::PivotLimit
        } else if ended(AttemptEnd::Cycle) {
            Status::Cycling
        } else {
            Status::NumericalTrouble
        };
        self.give_up(status)
    }

    fn answer(self, status: Status, point: Point, basis: Basis) -> Solution {
        let Point { t, y, residuals } = point;
        Solution { status, t, y, basis: Some(basis), residuals, ray: None, info: self.info }
    }

    /// Without a point there is still an answer: zero, with its residuals.
    fn give_up(self, status: Status) -> Solution {
        let zero = vec![0.0; self.problem.order()];
        let residuals = self.problem.residuals(&zero, &zero);
        let ray = if status == Status::RayTermination { self.ray } else { None };
        Solution { status, t: zero.clone(), y: zero, basis: None, residuals, ray, info: self.info }
    }
}

fn covering_entries(covering: &Covering, start: &StartTableau) -> Vec<f64> {
    let n = start.q.len();
    match covering {
        Covering::Ones => vec![1.0; n],
        Covering::Random { seed } => {
            let mut random = SplitMix::new(*seed);
            (0..n).map(|_| (6.0 * random.next_f64() - 3.0).exp2()).collect()
        }
        Covering::Given(d) => d.iter().zip(&start.row_factor).map(|(d, row)| d * row).collect(),
    }
}

fn covering_name(covering: &Covering) -> String {
    match covering {
        Covering::Ones => "ones".to_owned(),
        Covering::Random { seed } => format!("random, seed {seed}"),
        Covering::Given(_) => "given".to_owned(),
    }
}

fn in_problem_units(path: &Path<'_>, start: &StartTableau, problem: &HorizontalLcp) -> Ray {
    let (dw, dz, dz0) = path.ray();
    let n = dw.len();
    let (mut dt, mut dy) = (vec![0.0; n], vec![0.0; n]);
    for pair in 0..n {
        let (basic, nonbasic) = (dw[pair], dz[pair]);
        (dt[pair], dy[pair]) = match start.nonbasic_side(pair) {
            Side::T => (nonbasic, basic),
            Side::Y => (basic, nonbasic),
        };
    }
    let mut covering = vec![0.0; n];
    for (pair, d) in path.covering().enumerate() {
        let column = problem.column(pair, start.basis.sides()[pair]);
        covering.iter_mut().zip(column).for_each(|(sum, v)| *sum += d * v);
    }
    Ray { dt, dy, dz0, covering }
}
