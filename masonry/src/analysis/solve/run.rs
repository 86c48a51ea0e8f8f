//! A run: the solution of a scene, step by step along its load history, which often has only one step.

use std::ops::ControlFlow;

use lcp::{Contact2d, Status};

use super::chain::{Before, Chain};
use super::{Event, SolveError};
use crate::analysis::checkpoint::{Checkpoint, CheckpointError};
use crate::analysis::clock::Clock;
use crate::analysis::outcome::{Frame, Outcome};
use crate::data::info::SolveInfo;
use crate::data::state::State;
use crate::data::verdict::Judgement;
use crate::forms::Sparse;
use crate::history::energy::{self, FrictionWork, Snapshot};
use crate::history::spread::AtEnd;
use crate::history::{self, History, HistoryStep, SecondLoading, StepRecord};
use crate::method::Request;
use crate::method::sparse::UNKNOWN;
use crate::model::Model;
use crate::plan::Plan;
use crate::recover;
use crate::rounding::cleared;
use crate::scene::{Scene, SolverSettings};
use crate::system::System;
use crate::verify::checks::Checks;
use crate::verify::step::StepResult;
use crate::verify::verdict::{self, Findings};

/// The analysis of a scene, which is solved step by step.
///
/// ```
/// use std::ops::ControlFlow;
/// use masonry::scene::{Block, Joint, Load, Material, Movement, Scene, Stage, Support};
/// use masonry::analysis::solve::Run;
/// use masonry::units::Units;
///
/// // A block on a floor that is pulled away below the block.
/// let scene = Scene::new("Floor drawn away", Units::SI)
///     .thickness(1.0)
///     .gravity([0.0, -10.0])
///     .material("stone", Material::rigid().density(1000.0))
///     .joint("floor", Joint::mu(0.5))
///     .joint("stop", Joint::mu(0.0))
///     .block(Block::new("block", "stone", [[0.0, 0.0], [1.0, 0.0], [1.0, 0.2], [0.0, 0.2]]))
///     .support(Support::new("ground", [-1.0, 0.0], [2.0, 0.0], "floor"))
///     .support(Support::new("stop", [1.0, 0.0], [1.0, 0.2], "stop"))
///     .stage(Stage::new("weight"))
///     .stage(Stage::new("draw").steps(2).moves("ground", Movement::by(0.1, 0.0)));
/// let mut run = Run::new(&scene, &mut |_| ControlFlow::Continue(()))?;
/// while run.advance(&mut |_| ControlFlow::Continue(()))? {}
/// let history = run.finish().history.unwrap();
/// // The friction of half the weight, 1 kN, over 0.1 m less the millionths that the joints give way.
/// assert!((history.dissipation() / 100.0 - 1.0).abs() < 1e-4);
/// # Ok::<(), masonry::analysis::solve::SolveError>(())
/// ```
#[derive(Debug)]
pub struct Run {
    /// The noun for the structure in sentences: "wall" or "arch".
    structure: &'static str,
    title: String,
    /// The model under the actions of the only step. If there are several steps: the model with all loads in full and
    /// all supports in their original places.
    model: Model,
    plan: Plan,
    system: System,
    steps: Vec<HistoryStep>,
    loads: Vec<String>,
    /// Warnings about unusual magnitudes in the scene.
    unusual: Vec<String>,
    /// The part of the scene, as text, that a checkpoint must have in common with it; empty for a scene of one step,
    /// which has no checkpoint.
    origin: String,
    pub(super) request: Request,
    with_stresses: bool,
    /// The records of the steps that were solved; empty for a scene of one step.
    records: Vec<StepRecord>,
    /// The outcome of the second loading; `None` if it was not requested.
    pub(super) second_loading: Option<SecondLoading>,
    /// The result of the last step that was solved.
    solved: Option<StepResult>,
    /// The model and slips of the last state that was kept; `None` if there is only one step.
    reached: Option<Situation>,
    /// The result of the step after the last solved one, if that step was tried and not solved.
    failed: Option<StepResult>,
    /// The sparse problem of the last step that was tried; `None` if it was not built.
    sparse: Option<Sparse>,
    clock: Clock,
}

/// The model of a step of the load history, with the slips from which it starts.
#[derive(Debug)]
struct Situation {
    /// The model under the actions of the step.
    model: Model,
    /// The slip \[m\] of every contact point at the state from which slips are measured.
    slips: Vec<f64>,
}

impl Run {
    /// Builds the parts of the analysis that all steps have in common.
    ///
    /// # Errors
    /// [`SolveError`] when the scene is wrong or too large.
    pub fn new(
        scene: &Scene,
        observer: &mut dyn FnMut(Event) -> ControlFlow<()>,
    ) -> Result<Self, SolveError> {
        scene.check_single()?;
        let mut clock = Clock::default();
        let mut model = clock.time("model", observer, || Model::from_scene(scene))?;
        let unusual = model.unusual();
        let plan = Plan::of(scene, &model);
        plan.fits()?;
        let mut steps = history::steps(scene);
        steps.drain(..steps.len() - plan.steps);
        let origin = if let [only] = steps.as_slice() {
            model.act(&only.actions);
            String::new()
        } else {
            Checkpoint::origin_of(scene)?
        };
        let build = if plan.dense_numbers() > 0 { System::new } else { System::without_factors };
        let system = clock.time("system", observer, || build(&model))?;
        let SolverSettings { tolerance, form, max_pivots, max_steps, soft, .. } = scene.solver;
        let [max_pivots, max_steps] =
            [max_pivots, max_steps].map(|limit| limit.map(|it| it as usize));
        Ok(Self {
            structure: noun(scene),
            title: scene.title.clone(),
            model,
            plan,
            system,
            steps,
            unusual,
            loads: scene.loads.iter().map(|load| load.name.clone()).collect(),
            origin,
            request: Request { form, max_pivots, max_steps, soft, ..Request::new(tolerance) },
            with_stresses: scene.output.stresses,
            records: Vec::new(),
            second_loading: None,
            solved: None,
            reached: None,
            failed: None,
            sparse: None,
            clock,
        })
    }

    /// Continues from the last step of a checkpoint.
    ///
    /// Route, tolerance, output, and stages that are still to come may differ from those of the run that wrote the
    /// checkpoint.
    ///
    /// # Errors
    /// [`CheckpointError`] if the checkpoint belongs to another scene or to other steps, if a state in it is not an
    /// equilibrium, and for scenes of one step.
    pub fn resume(mut self, checkpoint: &Checkpoint) -> Result<Self, SolveError> {
        if !self.has_history() {
            return Err(CheckpointError::OneStep.into());
        }
        let Checkpoint { origin, records, .. } = checkpoint;
        if *origin != self.origin {
            return Err(CheckpointError::OtherScene.into());
        }
        let planned = self.steps.iter().map(Some).chain(std::iter::repeat(None));
        if let Some(position) =
            records.iter().zip(planned).position(|(record, step)| Some(&record.step) != step)
        {
            let StepRecord { step: HistoryStep { stage, number, .. }, .. } = &records[position];
            return Err(CheckpointError::OtherSteps { stage: stage.clone(), step: *number }.into());
        }
        let Some(record) = records.last() else { return Ok(self) };
        let slips = vec![0.0; self.model.contacts.len()];
        let model = self.model.under(&record.step.actions, &slips);
        let state = checkpoint.state(&model, self.with_stresses)?;
        let slips = checkpoint.slips(&model)?;
        let model = self.model.under(&record.step.actions, &slips);
        // The checks need only the slips of the last step, but the state has the sums over all steps.
        let mut of_step = state.clone();
        of_step.contacts.iter_mut().zip(&slips).for_each(|(contact, slip)| contact.y_t -= slip);
        let checks = Checks::of(&model, &of_step);
        let info = checkpoint.solve.clone();
        let tolerance = self.request.tolerance.max(record.residuals.worst());
        if info.status != Status::Solved || !checks.hold(tolerance) {
            return Err(CheckpointError::NoEquilibrium.into());
        }
        let basis = checkpoint.basis(self.system.rows.len() + self.system.friction.len());
        self.reached = Some(Situation { model, slips });
        let (state, checks) = (Some(state), Some(checks));
        self.solved = Some(StepResult { state, checks, basis, ..StepResult::new(info) });
        self.records.clone_from(records);
        Ok(self)
    }

    /// Solves the next step; returns false if there is no next step, or if the last one failed. `Break` cancels the
    /// step, which then counts as failed.
    ///
    /// # Errors
    /// As [`solve`](super::solve). Steps that were solved before are kept.
    pub fn advance(
        &mut self,
        observer: &mut dyn FnMut(Event) -> ControlFlow<()>,
    ) -> Result<bool, SolveError> {
        let solved = self.solved_steps();
        let Some(step) = self.steps.get(solved).filter(|_| self.failed.is_none()).cloned() else {
            return Ok(false);
        };
        let situation = self.has_history().then(|| self.situation(&step));
        let mut before = None;
        if let Some(Situation { model, slips }) = &situation {
            let (number, of) = (solved + 1, self.steps.len());
            if observer(Event::Step { number, of }).is_break() {
                self.failed = Some(self.without_state(Status::Cancelled));
                return Ok(true);
            }
            before = self.before(slips)?;
            self.system.reload(model);
        }
        self.sparse = None;
        let model = situation.as_ref().map_or(&self.model, |situation| &situation.model);
        let (problem, snapshot) = before.unzip();
        let before = self.solved.as_ref().zip(problem).and_then(|(solved, problem)| {
            let (state, basis) = (solved.state.as_ref()?, solved.basis.as_ref());
            Some(Before { problem, state, basis })
        });
        let (clock, with_stresses) = (&mut self.clock, self.with_stresses);
        let mut chain =
            Chain::new(model, &self.system, self.request, with_stresses, clock, observer);
        chain.before = before;
        match chain.run(&self.plan.routes) {
            Ok((tried, sparse)) => {
                self.sparse = sparse;
                self.take(step, situation, snapshot.as_ref(), tried);
                Ok(true)
            }
            Err(error) if solved == 0 => Err(error),
            Err(error) => {
                self.failed = Some(self.without_state(Status::NumericalTrouble));
                let HistoryStep { stage, number, .. } = step;
                Err(SolveError::Step { stage, step: number, error: Box::new(error) })
            }
        }
    }

    /// Returns the model for a step after the last solved one, with the slips at its start.
    fn situation(&self, step: &HistoryStep) -> Situation {
        let state = self.solved.as_ref().and_then(|solved| solved.state.as_ref());
        let slips: Vec<f64> = match state {
            Some(state) => state.contacts.iter().map(|contact| contact.y_t).collect(),
            None => vec![0.0; self.model.contacts.len()],
        };
        Situation { model: self.model.under(&step.actions, &slips), slips }
    }

    /// Builds the problem of the last step that was solved, with slips measured from its state, and the snapshot from
    /// which the work of the next step is computed; `None` before the first step.
    fn before(&mut self, slips: &[f64]) -> Result<Option<(Contact2d, Snapshot)>, SolveError> {
        let state = self.solved.as_ref().and_then(|solved| solved.state.as_ref());
        let Some((record, state)) = self.records.last().zip(state) else { return Ok(None) };
        let model = self.model.under(&record.step.actions, slips);
        let snapshot = Snapshot::of(&model, state);
        self.system.reload(&model);
        Ok(Some((Sparse::new(&self.system)?.problem, snapshot)))
    }

    /// Returns the result of a step without an answer: no route ran, or all routes refused the step.
    fn without_state(&self, status: Status) -> StepResult {
        let info = SolveInfo::new(self.plan.routes[0].route, status, UNKNOWN);
        StepResult::new(SolveInfo { because: "planned; no route has ended".to_owned(), ..info })
    }

    /// Keeps the result of a step. If there is only one step, nothing else is kept.
    fn take(
        &mut self,
        step: HistoryStep,
        situation: Option<Situation>,
        before: Option<&Snapshot>,
        mut tried: StepResult,
    ) {
        if let Some(situation) = situation {
            self.remember(step, situation, before, &mut tried);
        } else if let Some(moved) = &tried.moved {
            // Slips of the state are measured from the places that the blocks have reached.
            self.model = self.model.slid(moved);
        }
        let place = if tried.is_solved() { &mut self.solved } else { &mut self.failed };
        *place = Some(tried);
    }

    /// Keeps the record of a solved step, and the model and slips of its state. The state of an unsolved step is kept
    /// only if no step before it was solved.
    fn remember(
        &mut self,
        step: HistoryStep,
        situation: Situation,
        before: Option<&Snapshot>,
        tried: &mut StepResult,
    ) {
        let is_solved = tried.is_solved();
        if !is_solved && self.solved.is_some() {
            return;
        }
        let friction = tried.friction(&situation.model);
        let Some(reached) = self.reached_by(&step, situation, tried) else { return };
        if is_solved {
            self.records.extend(self.record(step, friction, tried, &reached.model, before));
        }
        self.reached = Some(reached);
    }

    /// Returns the model and slips of the state of a result, and changes the slips of this state to sums over all
    /// steps.
    fn reached_by(
        &self,
        step: &HistoryStep,
        situation: Situation,
        tried: &mut StepResult,
    ) -> Option<Situation> {
        let Situation { mut model, mut slips } = situation;
        let state = tried.state.as_mut()?;
        if let Some(moved) = &tried.moved {
            slips.iter_mut().zip(moved).for_each(|(slip, moved)| *slip += moved);
            model = self.model.under(&step.actions, &slips);
        }
        let most = largest_displacement(state);
        let contacts = model.contacts.iter().zip(&mut state.contacts).zip(&slips);
        for ((_, contact), slip) in contacts.filter(|((it, _), _)| it.law.resists_sliding()) {
            contact.y_t = slip + cleared(contact.y_t, most);
        }
        Some(Situation { model, slips })
    }

    /// Returns the record of a step after the last one that was solved; `None` if `result` has no state.
    fn record(
        &self,
        step: HistoryStep,
        friction: FrictionWork,
        result: &StepResult,
        model: &Model,
        before: Option<&Snapshot>,
    ) -> Option<StepRecord> {
        let StepResult { info, state: Some(state), checks, .. } = result else { return None };
        let work = Snapshot::of(model, state).work_from(before);
        let before = self.solved.as_ref().and_then(|solved| solved.state.as_ref());
        let held_before = before.map_or(0.0, |before| energy::held(model, &before.contacts));
        let held = energy::held(model, &state.contacts) - held_before;
        Some(StepRecord {
            step,
            route: info.route,
            way: info.way,
            factorisations: info.factorisations,
            residuals: info.residuals,
            work,
            dissipation: friction.dissipation + held,
            friction_power: friction.power(),
            energy_created: friction.created,
            dragged: friction.dragged,
            strain_energy: state.strain_energy,
            largest_displacement: largest_displacement(state),
            contacts: checks.as_ref().map_or([0; 3], |it| [it.open, it.stick, it.slip]),
            reactions: recover::reactions(model, &state.contacts),
        })
    }

    /// Whether the scene has several steps.
    pub fn has_history(&self) -> bool {
        self.steps.len() > 1
    }

    /// Returns the number of steps that were solved.
    pub fn solved_steps(&self) -> usize {
        if self.has_history() { self.records.len() } else { usize::from(self.solved.is_some()) }
    }

    /// Returns the number of steps of the scene.
    pub fn steps(&self) -> usize {
        self.steps.len()
    }

    /// Returns the state after the last step that was solved; `None` before the first step, and for a scene of one
    /// step.
    pub fn frame(&self) -> Option<Frame> {
        let position = self.records.len().checked_sub(1)?;
        let AtEnd { model, state, .. } = self.reached()?;
        let step = self.records[position].step.clone();
        Some(Frame { step, position, model: model.clone(), state: state.clone() })
    }

    /// Returns the state at the end of the load history; `None` if the last step is not solved.
    pub(super) fn at_end(&self) -> Option<AtEnd<'_>> {
        self.reached().filter(|_| self.records.len() == self.steps.len())
    }

    /// Returns the state after the last step that was solved; `None` before the first step, and for a scene of one
    /// step.
    fn reached(&self) -> Option<AtEnd<'_>> {
        let (solved, reached) = (self.solved.as_ref()?, self.reached.as_ref()?);
        let dissipation = self.records.iter().map(|record| record.dissipation).sum();
        Some(AtEnd { model: &reached.model, state: solved.state.as_ref()?, dissipation })
    }

    /// Returns the data that the next step needs; `None` before the first step, and for a scene of one step.
    pub fn checkpoint(&self) -> Option<Checkpoint> {
        let StepResult { info, state, basis, .. } = self.solved.as_ref()?;
        let slips = &self.reached.as_ref()?.slips;
        let (origin, records, info) = (self.origin.clone(), self.records.clone(), info.clone());
        Some(Checkpoint::new(origin, records, info, state.as_ref()?, slips, basis.as_ref()))
    }

    /// Returns the outcome: the state after the last step that was solved and, if a step failed, the reason.
    pub fn finish(mut self) -> Outcome {
        let step = match (self.failed.take(), self.solved.take()) {
            (Some(failed), Some(StepResult { state, checks, .. })) => {
                StepResult { state, checks, ..failed }
            }
            (Some(only), None) | (None, Some(only)) => only,
            (None, None) => self.without_state(Status::Cancelled),
        };
        let history = self.has_history().then(|| History {
            failed: self.steps.get(self.records.len()).cloned(),
            records: self.records,
            steps: self.steps.len(),
            loads: self.loads,
            second_loading: self.second_loading,
        });
        let model = self.reached.map_or(self.model, |reached| reached.model);
        let build = || Sparse::new(&self.system).ok();
        let circulating = step.state.as_ref().and_then(|state| {
            let sparse = self.sparse.or_else(build)?;
            Some(verdict::circulating(&model, &sparse.problem, state, self.system.is_at_rest()))
        });
        let judgement = Judgement::of(&Findings {
            structure: self.structure,
            model: &model,
            step: &step,
            history: history.as_ref(),
            at_rest: self.system.is_at_rest(),
            unusual: &self.unusual,
            circulating: circulating.unwrap_or(0),
        });
        let StepResult { info, state, checks, mechanism, .. } = step;
        let reactions = state.as_ref().map(|state| recover::reactions(&model, &state.contacts));
        Outcome {
            title: self.title,
            model,
            plan: self.plan,
            solve: info,
            state,
            checks,
            reactions: reactions.unwrap_or_default(),
            history,
            mechanism,
            judgement,
            times: self.clock.times,
        }
    }
}

fn largest_displacement(state: &State) -> f64 {
    state.displacements.iter().flatten().map(nalgebra::Matrix::amax).fold(0.0, f64::max)
}

/// Returns the noun for the structure of a scene in sentences.
fn noun(scene: &Scene) -> &'static str {
    if scene.walls.is_empty() && !scene.arches.is_empty() { "arch" } else { "wall" }
}
