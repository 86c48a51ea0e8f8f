//! The iterations of the augmented Lagrangian method, and the tests that end them.

use std::ops::ControlFlow;

use lcp::{Contact2d, ContactState, Status};

use super::contraction::Contraction;
use super::matrices::{Matrices, States};
use super::structure::{Structure, Taken};
use super::{AlmAnswer, AlmError, AlmIteration, AlmSettings};
use crate::data::state::PointStatus;

/// Penalty of a contact, relative to the stiffness at its row \[-\].
const PENALTY: f64 = 0.3;
/// Coefficient `delta` of the proximal term, relative to the diagonal stiffness \[-\].
const PROXIMAL: f64 = 1e-2;
/// Number of iterations that end an attempt if neither the measure nor the distance from the limit has decreased by a
/// tenth.
const PATIENCE: usize = 300;
/// The factor by which penalty and proximal term change in the next attempt, and the number of attempts.
const SOFTER: f64 = 3.0;
const ATTEMPTS: usize = 4;
/// Number of steps in which blocks are moved to the initial gaps and slips of the contacts, each to a hundredth of the
/// remaining distance.
const BROUGHT: usize = 6;
/// The largest number of times that a step is halved because it leaves larger unbalanced forces.
const HALVINGS: usize = 8;

/// Iterates until the answer is accurate enough, or the last attempt has ended.
pub(super) fn solve(
    structure: &Structure<'_>,
    settings: &AlmSettings,
    observer: &mut dyn FnMut(&AlmIteration) -> ControlFlow<()>,
) -> Result<AlmAnswer, AlmError> {
    let tolerance = settings.tolerance;
    if !(tolerance > 0.0 && tolerance < 1.0) {
        return Err(AlmError::Tolerance { tolerance });
    }
    let mut run = Iterations {
        structure,
        settings,
        convergence: Vec::new(),
        factorisations: 0,
        best: Best::rest(structure.problem),
    };
    let mut status = Status::Stalled;
    for attempt in 1..=ATTEMPTS {
        let softer = SOFTER.powi(i32::try_from(attempt).unwrap_or(i32::MAX) - 1);
        let matrices = Matrices::new(structure, PENALTY / softer, PROXIMAL * softer)?;
        status = run.attempt(attempt, &matrices, observer)?;
        if status != Status::Stalled {
            break;
        }
    }
    let Iterations { convergence, factorisations, best: Best { state, .. }, .. } = run;
    let residuals = structure.residuals(&state, &structure.taken(&state.u))?;
    Ok(AlmAnswer { status, state, residuals, convergence, factorisations })
}

/// The state of the iteration with the smallest measure of error.
struct Best {
    state: ContactState,
    measure: f64,
}

impl Best {
    fn rest(problem: &Contact2d) -> Self {
        let (n, m) = (problem.displacements(), problem.points());
        let state = problem.state(vec![0.0; n], vec![0.0; m], vec![0.0; m]);
        Self { state, measure: f64::INFINITY }
    }
}

/// The data of a solution in progress.
struct Iterations<'a> {
    structure: &'a Structure<'a>,
    settings: &'a AlmSettings,
    convergence: Vec<AlmIteration>,
    factorisations: usize,
    best: Best,
}

impl Iterations<'_> {
    /// Iterates from a start with all contacts closed; returns the status of the attempt.
    fn attempt(
        &mut self,
        attempt: usize,
        matrices: &Matrices<'_>,
        observer: &mut dyn FnMut(&AlmIteration) -> ControlFlow<()>,
    ) -> Result<Status, AlmError> {
        let Self { structure, settings, .. } = *self;
        let problem = structure.problem;
        let mut at = self.start(matrices)?;
        let mut taken = structure.taken(&at.u);
        let mut contacts = vec![PointStatus::Stick; problem.points()];
        let mut factors = None;
        // The least measure, and the least remaining distance.
        let (mut least, mut since) = ([f64::INFINITY; 2], 0);
        let [mut motion, mut pull] = structure.units().map(Contraction::new);
        while self.convergence.len() < settings.max_iterations {
            let states = States { contacts: &contacts, films: &taken.films };
            let present = if let Some(present) = factors.take() {
                present
            } else {
                self.factorisations += 1;
                matrices.factorised(states)?
            };
            let u = matrices.displacements(&present, states, &at);
            let u = self.shortened(matrices, &at, u);
            let trial = problem.state(u, at.t_n, at.t_t);
            let (t_n, t_t, next) = matrices.projected(&trial);
            let moved = structure.taken(&trial.u);
            let changes = contacts.iter().zip(&next).filter(|(a, b)| a != b).count()
                + changed_points(&taken, &moved);
            if changes == 0 {
                factors = Some(present);
            }
            motion.record(&at.u, &trial.u);
            pull.record(&taken.blocks, &moved.blocks);
            (contacts, taken) = (next, moved);
            at = problem.state(trial.u, t_n, t_t);

            let unbalance = structure.unbalance(&at, &taken);
            let distance = motion.remaining().max(pull.remaining());
            let iteration = AlmIteration { attempt, unbalance, distance, changes };
            self.convergence.push(iteration);
            let measure = unbalance.max(structure.slack(&at, &taken));
            let is_solved = measure.max(distance) <= settings.tolerance
                && structure.residuals(&at, &taken)?.worst() <= settings.tolerance;
            if is_solved || measure < self.best.measure {
                self.best = Best { state: at.clone(), measure };
            }
            let is_cancelled = observer(&iteration).is_break();
            if is_solved {
                return Ok(Status::Solved);
            }
            if is_cancelled {
                return Ok(Status::Cancelled);
            }
            since += 1;
            for (least, value) in least.iter_mut().zip([measure, distance]) {
                if value < 0.9 * *least {
                    (*least, since) = (value, 0);
                }
            }
            if !measure.is_finite() || since > PATIENCE {
                return Ok(Status::Stalled);
            }
        }
        Ok(Status::IterationLimit)
    }

    /// Returns the start of the iterations: rest, or, if gaps or slips do not start from zero (a support has moved),
    /// the state of the blocks with all contacts held. From rest the blocks would move to that state in the small
    /// steps of the proximal term.
    fn start(&mut self, matrices: &Matrices<'_>) -> Result<ContactState, AlmError> {
        let problem = self.structure.problem;
        let mut at = Best::rest(problem).state;
        let mut offsets = problem.initial_gaps().iter().chain(problem.initial_slips());
        if offsets.all(|offset| offset.abs() <= 0.0) {
            return Ok(at);
        }
        let all = vec![PointStatus::Stick; problem.points()];
        for _ in 0..BROUGHT {
            let taken = self.structure.taken(&at.u);
            let states = States { contacts: &all, films: &taken.films };
            self.factorisations += 1;
            let u = matrices.displacements(&matrices.factorised(states)?, states, &at);
            at = problem.state(u, at.t_n, at.t_t);
        }
        Ok(at)
    }

    /// Returns the step to `u`, or a part of the step if that leaves smaller unbalanced forces: full steps oscillate
    /// between the states of the Gauss points of films.
    fn shortened(&self, matrices: &Matrices<'_>, at: &ContactState, u: Vec<f64>) -> Vec<f64> {
        if self.structure.films.is_empty() {
            return u;
        }
        let before = matrices.lack(at, &at.u);
        let (mut least, mut best) = (matrices.lack(at, &u), u.clone());
        let mut share = 1.0;
        for _ in 0..HALVINGS {
            if least < before {
                break;
            }
            share *= 0.5;
            let way = at.u.iter().zip(&u);
            let part: Vec<f64> = way.map(|(from, to)| from + share * (to - from)).collect();
            let lack = matrices.lack(at, &part);
            if lack < least {
                (least, best) = (lack, part);
            }
        }
        best
    }
}

/// Counts the Gauss points of films whose states differ between the two responses.
fn changed_points(one: &Taken, other: &Taken) -> usize {
    let states = |taken: &Taken| -> Vec<PointStatus> {
        taken.films.iter().flat_map(|film| &film.points).map(|point| point.contact).collect()
    };
    states(one).iter().zip(states(other)).filter(|(a, b)| **a != *b).count()
}
