//! Solves of a scene within a time limit, each measured.

use std::ops::ControlFlow;
use web_time::{Duration, Instant};

use lcp::Status;

use super::{End, Figures, Record, Settings, StudyObserver, StudyProgress};
use crate::analysis::outcome::Outcome;
use crate::analysis::solve::solve_observed;
use crate::model::Model;
use crate::plan::Plan;
use crate::scene::{Form, Route, Scene};
use crate::verify::checks::Checks;

/// A solve that takes longer is not repeated.
const SHORT: Duration = Duration::from_secs(1);

/// The time limit counts as kept up to this multiple of it.
const OVERRUN: f64 = 1.1;

/// Largest order of a dense matrix that is built. The reduction and the factorisation of larger ones take minutes,
/// during which no observer can stop the solve.
const LARGEST_DENSE: usize = 4000;

/// The result of one solve.
pub(super) struct Ran {
    pub(super) end: End,
    pub(super) seconds: Option<f64>,
    /// The outcome; `None` if the solve was refused or skipped.
    pub(super) outcome: Option<Outcome>,
}

impl Ran {
    pub(super) fn skipped(reason: String) -> Self {
        Self { end: End::Skipped(reason), seconds: None, outcome: None }
    }

    /// Returns the limit that the solve exceeded, and that a solve to a tighter tolerance would exceed too; `None` if
    /// it exceeded no limit.
    fn is_beyond(&self) -> Option<Beyond> {
        match self.end {
            End::Ended(Status::TimeLimit) => Some(Beyond::Time),
            End::Ended(Status::IterationLimit) => Some(Beyond::Iterations),
            _ => None,
        }
    }

    /// Returns the outcome if the solve ended with a solution.
    pub(super) fn solved(&self) -> Option<&Outcome> {
        self.outcome.as_ref().filter(|_| self.end.is_solved())
    }

    /// Returns the residual that was reached; `None` without an outcome or if it is infinite.
    pub(super) fn residual(&self) -> Option<f64> {
        let residual = self.outcome.as_ref().map(|it| it.solve.residuals.worst());
        residual.filter(|residual| residual.is_finite())
    }

    /// Returns forces, stresses and energy of the solution; `None` if the solve ended without one.
    pub(super) fn figures(&self) -> Option<Figures> {
        let outcome = self.solved()?;
        outcome.state.as_ref().map(|state| Figures::of(&outcome.model, state))
    }
}

/// A limit that a solve exceeded.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Beyond {
    /// The time limit, which solves on finer meshes exceed too.
    Time,
    Iterations,
}

/// Runs the solves of a study, and remembers those that exceeded a limit of time or of iterations.
pub(super) struct Runner<'a> {
    settings: &'a Settings,
    observer: &'a mut StudyObserver<'a>,
    is_interrupted: bool,
    beyond: Vec<(Beyond, StudyProgress)>,
    /// The last record by Lemke's method, with the checks of its state.
    pivots: Option<(Record, Checks)>,
}

impl<'a> Runner<'a> {
    pub(super) fn new(settings: &'a Settings, observer: &'a mut StudyObserver<'a>) -> Self {
        Self { settings, observer, is_interrupted: false, beyond: Vec::new(), pivots: None }
    }

    /// Whether the observer has ended the study.
    pub(super) fn is_interrupted(&self) -> bool {
        self.is_interrupted
    }

    /// Returns the name of a mesh in reports.
    pub(super) fn mesh_name(&self, factor: u32) -> String {
        self.settings.mesh_name(factor)
    }

    /// Runs one solve and returns its record.
    pub(super) fn record(
        &mut self,
        scene: &Scene,
        at: StudyProgress,
        reference: Option<&Figures>,
    ) -> Record {
        if let Some(same) = self.same_pivots(at) {
            return same;
        }
        let ran = self.run(scene, at);
        let StudyProgress { mesh, route, tolerance } = at;
        let count = |outcome: &Outcome| match route {
            Route::Lemke => outcome.solve.pivots,
            _ => outcome.solve.iterations,
        };
        let errors = ran.figures().zip(reference).map(|(found, it)| found.errors(it));
        let checks = ran.solved().and_then(|outcome| outcome.checks.clone());
        let record = Record {
            route,
            tolerance,
            mesh,
            residual: ran.residual(),
            seconds: ran.seconds,
            overrun: ran
                .seconds
                .is_some_and(|it| it > OVERRUN * self.settings.time_limit.as_secs_f64()),
            iterations: ran.outcome.as_ref().map(count),
            errors,
            end: ran.end,
        };
        if route == Route::Lemke {
            self.pivots = checks.map(|checks| (record.clone(), checks));
        }
        record
    }

    /// Returns the last record by Lemke's method, with another tolerance, if it is valid for it: the pivots do not
    /// depend on the tolerance, which decides only whether the residual at their end counts as solved.
    fn same_pivots(&self, at: StudyProgress) -> Option<Record> {
        let StudyProgress { mesh, route, tolerance } = at;
        let (last, checks) = self.pivots.as_ref()?;
        let is_same = route == Route::Lemke && last.mesh == mesh && tolerance <= last.tolerance;
        let is_reached = last.residual.is_some_and(|residual| residual <= tolerance);
        (is_same && is_reached && checks.hold(tolerance))
            .then(|| Record { tolerance, ..last.clone() })
    }

    /// Solves a scene, several times if the solve is quick. The solve is skipped if the time ran out at a looser
    /// tolerance or on a coarser mesh, or if the iterations ran out at a looser tolerance.
    pub(super) fn run(&mut self, scene: &Scene, at: StudyProgress) -> Ran {
        let is_easier = |(beyond, other): &&(Beyond, StudyProgress)| {
            let on_mesh = other.mesh == at.mesh || *beyond == Beyond::Time && other.mesh <= at.mesh;
            other.route == at.route && on_mesh && other.tolerance >= at.tolerance
        };
        if let Some((beyond, easier)) = self.beyond.iter().find(is_easier) {
            let what = match beyond {
                Beyond::Time => "the time",
                Beyond::Iterations => "the number of iterations",
            };
            let mesh = self.settings.mesh_name(easier.mesh);
            return Ran::skipped(format!("{what} ran out to {:e} on {mesh}", easier.tolerance));
        }
        if self.ask(at).is_break() {
            return Ran::skipped("the study was interrupted".to_owned());
        }
        let scene = &on_route(scene, at);
        if let Some(order) = dense_order(scene).filter(|order| *order > LARGEST_DENSE) {
            return Ran::skipped(format!(
                "it may build dense matrices of order {order}, and those above {LARGEST_DENSE} take long"
            ));
        }
        let mut ran = self.once(scene, at);
        if let Some(beyond) = ran.is_beyond() {
            self.beyond.push((beyond, at));
        }
        let mut times: Vec<f64> = ran.seconds.into_iter().collect();
        let is_short = times.iter().all(|time| *time < SHORT.as_secs_f64());
        if is_short && ran.solved().is_some() {
            times.extend((1..self.settings.repeats).filter_map(|_| self.once(scene, at).seconds));
        }
        times.sort_by(f64::total_cmp);
        ran.seconds = times.get(times.len() / 2).copied();
        ran
    }

    /// Calls the observer, unless it has ended the study before; returns `Break` if the study has ended.
    fn ask(&mut self, at: StudyProgress) -> ControlFlow<()> {
        self.is_interrupted = self.is_interrupted || (self.observer)(at).is_break();
        if self.is_interrupted { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn once(&mut self, scene: &Scene, at: StudyProgress) -> Ran {
        let began = Instant::now();
        let limit = self.settings.time_limit;
        let result = solve_observed(scene, &mut |_| {
            if began.elapsed() < limit { self.ask(at) } else { ControlFlow::Break(()) }
        });
        let seconds = Some(began.elapsed().as_secs_f64());
        match result {
            Ok(outcome) => {
                let status = match outcome.solve.status {
                    Status::Cancelled if !self.is_interrupted => Status::TimeLimit,
                    status => status,
                };
                Ran { end: End::Ended(status), seconds, outcome: Some(outcome) }
            }
            Err(error) => Ran { end: End::Refused(error.to_string()), seconds, outcome: None },
        }
    }
}

/// Returns the scene with the settings of a solve: its route, its tolerance, and the stresses that are compared.
fn on_route(scene: &Scene, StudyProgress { route, tolerance, .. }: StudyProgress) -> Scene {
    let mut scene = scene.clone().route(route).tolerance(tolerance).stresses(true);
    scene.solver.soft = None;
    if route != Route::Lemke {
        scene.solver.form = Form::Auto;
        scene.solver.max_pivots = None;
    }
    scene
}

/// Returns the order of the largest dense matrix of Lemke's method; `None` for other routes.
fn dense_order(scene: &Scene) -> Option<usize> {
    let model =
        Model::from_scene(scene).ok().filter(|_| scene.solver.route == Route::Lemke.into())?;
    let plan = Plan::of(scene, &model);
    Some(plan.largest_order.max(plan.largest_block))
}
