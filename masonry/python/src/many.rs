//! Many problems: all at once on all cores, or one `q` after the other.
#![expect(clippy::needless_pass_by_value, reason = "functions own what they take from Python")]

use std::num::NonZero;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, Builder};

use lcp::{Auto, Lcp, Solution, Solver, Vector, WarmStart};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::answer::Answer;
use crate::arrays::{GivenMatrix, GivenVector, vector};
use crate::options::Options;
use crate::watch::{PATIENCE, Watch, detached, refused};

/// Solves many standard problems on all cores; the answers are in the order of the problems.
#[pyfunction]
pub(crate) fn solve_many(
    py: Python<'_>,
    problems: Vec<(GivenMatrix<'_>, GivenVector<'_>)>,
    options: Options,
) -> PyResult<Vec<Answer>> {
    let problem = |(number, (m, q)): (usize, &(GivenMatrix<'_>, GivenVector<'_>))| {
        let named =
            |error: PyErr| PyValueError::new_err(format!("problem {number}: {}", error.value(py)));
        let problem = m.matrix().map(|m| Lcp::new(m, vector(q)).map_err(|error| refused(&error)));
        problem.and_then(|problem| problem).map_err(named)
    };
    let problems = problems.iter().enumerate().map(problem).collect::<PyResult<Vec<Lcp>>>()?;
    let solver = options.auto(WarmStart::None)?;
    let answers = detached(py, || solved(&solver, &problems))??;
    Ok(answers.into_iter().map(|answer| Answer::of_pairs(py, answer)).collect())
}

/// Solves all problems. Worker threads take one problem after the other, while this thread, which receives the signals
/// of the process, checks for signals.
fn solved(solver: &Auto, problems: &[Lcp]) -> PyResult<Vec<Solution<Lcp>>> {
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let (next, is_over) = (AtomicUsize::new(0), AtomicBool::new(false));
    let observer = |_: &lcp::Iteration| {
        if is_over.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..cores.min(problems.len()) {
            let (sender, next, is_over) = (sender.clone(), &next, &is_over);
            let work = move || {
                while !is_over.load(Ordering::Relaxed) {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(problem) = problems.get(number) else { break };
                    let answer = solver.solve_observed(problem, &mut { observer });
                    // Sending fails if the receiver is gone after an exception.
                    let _ = sender.send((number, answer));
                }
            };
            Builder::new().spawn_scoped(scope, work)?;
        }
        drop(sender);
        let mut answers: Vec<_> = problems.iter().map(|_| None).collect();
        let mut watch = Watch::new(None);
        loop {
            match receiver.recv_timeout(PATIENCE) {
                Ok((number, answer)) => answers[number] = Some(answer),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            if watch.ask(()).is_break() {
                is_over.store(true, Ordering::Relaxed);
                break;
            }
        }
        watch.finish()?;
        let answers = answers.into_iter().flatten();
        answers.map(|answer| answer.map_err(|error| refused(&error))).collect()
    })
}

/// A standard problem that is solved for one `q` after the other.
#[pyclass(frozen)]
pub(crate) struct Sequence {
    /// The sequence behind a lock, so that one thread solves at a time.
    sequence: Mutex<lcp::Sequence<usize>>,
}

#[pymethods]
impl Sequence {
    #[new]
    fn new(m: GivenMatrix<'_>, options: Options) -> PyResult<Self> {
        let m = m.matrix()?;
        let zero = vec![0.0; m.nrows()];
        let keys: Vec<usize> = (0..m.nrows()).collect();
        let lcp = Lcp::new(m, Vector::from(zero)).map_err(|error| refused(&error))?;
        let settings = options.auto(WarmStart::None)?.settings().clone();
        let sequence = lcp::Sequence::new(lcp, &keys, settings).map_err(|error| refused(&error))?;
        Ok(Self { sequence: Mutex::new(sequence) })
    }

    fn solve(&self, py: Python<'_>, q: GivenVector<'_>) -> PyResult<Answer> {
        let q = vector(&q);
        let mut watch = Watch::new(None);
        let solution = detached(py, || {
            let mut sequence = self.sequence.lock().unwrap_or_else(PoisonError::into_inner);
            sequence.solve_observed(&q, &mut |at| watch.at(at)).cloned()
        })?;
        watch.finish()?;
        Ok(Answer::of_pairs(py, solution.map_err(|error| refused(&error))?))
    }
}
