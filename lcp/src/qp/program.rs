//! A problem during its solution: interior points of programs, and the exact states that follow from them.

use std::cell::OnceCell;
use web_time::{Duration, Instant};

use super::farkas::farkas_vector;
use super::form::Form;
use super::interior::End;
use super::settings::QuadraticProgramSettings;
use crate::active::{self, Original, Search};
use crate::solve::Monitor;
use crate::states::PointRef;
use crate::{Certificate, Error, HorizontalLcp, Method, Observer, Solution, Status};

/// The best point so far, its cost, and the proof that there is no solution.
pub(super) struct ProgramRun<'a> {
    pub(super) settings: &'a QuadraticProgramSettings,
    pub(super) search: Search<'a>,
    pub(super) monitor: Monitor<'a>,
    general: &'a dyn Fn() -> HorizontalLcp,
    proof: OnceCell<Option<Vec<f64>>>,
    /// Steps of the interior-point method, each of which takes a factorisation.
    pub(super) steps: usize,
}

impl<'a> ProgramRun<'a> {
    /// A run of at most `max_programs`.
    pub(super) fn new(
        settings: &'a QuadraticProgramSettings,
        problem: &'a dyn Original,
        general: &'a dyn Fn() -> HorizontalLcp,
        max_programs: usize,
        observer: &'a mut Observer<'_>,
    ) -> Result<Self, Error> {
        let monitor =
            Monitor::new(Method::QuadraticProgram, max_programs, settings.time_limit, observer);
        let search = Search::new(Method::QuadraticProgram, problem, settings.tolerance, None)?;
        Ok(Self { settings, search, monitor, general, proof: OnceCell::new(), steps: 0 })
    }

    /// The time left.
    pub(super) fn time(&self) -> Option<Duration> {
        self.monitor.deadline().map(|end| end.saturating_duration_since(Instant::now()))
    }

    /// The proof that there is no solution, which is searched at most once.
    pub(super) fn proof(&self) -> Option<&Vec<f64>> {
        let search = || farkas_vector(&(self.general)(), self.settings.max_iterations, self.time());
        self.proof.get_or_init(search).as_ref()
    }

    /// Whether no program has to be solved: the start of the settings, or the point without motion and forces,
    /// is a solution, or the form has only equations.
    pub(super) fn is_tried(&mut self, form: &Form) -> bool {
        let is_solved = self.search.try_start(&self.settings.start) || self.search.try_rest(true);
        let is_linear = form.rows() == 0;
        if is_linear && !is_solved {
            let (u, forces) = self.search.rest();
            self.search
                .try_point(PointRef { u: &u, forces: &forces }, Some(&active::Effort::ANCHORED));
        }
        is_solved || is_linear
    }

    /// The best point, or the proof that there is no solution.
    pub(super) fn finish(self, end: Result<End, Status>) -> Solution {
        let is_solved = self.search.residual() <= self.settings.tolerance;
        let mut farkas = None;
        let otherwise = match end {
            Err(status @ (Status::Cancelled | Status::TimeLimit)) => status,
            Ok(End::TimeLimit) => Status::TimeLimit,
            Ok(End::IterationLimit) => Status::IterationLimit,
            // The status `Solved` follows from the residuals of the point.
            _ if is_solved => Status::Stalled,
            Ok(End::ProgramPoint | End::NoPoint | End::Failed) | Err(_) => {
                farkas = self.proof().cloned();
                match end {
                    _ if farkas.is_some() => Status::Infeasible,
                    Err(status) => status,
                    Ok(End::Failed) => Status::NumericalTrouble,
                    Ok(_) => Status::Stalled,
                }
            }
        };
        let mut solution = self.search.finish(otherwise, self.monitor);
        if let (Some(pi), Status::Infeasible) = (farkas, solution.status) {
            solution.certificate = Some(Certificate::Farkas { pi });
        }
        solution.info.factorisations += self.steps;
        solution
    }
}
