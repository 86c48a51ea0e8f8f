//! A scene on its way through the steps of its load history, of which there is often only one.

use std::ops::ControlFlow;

use lcp::Status;
use nalgebra::Vector2;

use super::chain::{Before, Chain, Tried};
use super::{Clock, Event, SolveError};
use crate::analysis::checkpoint::{Checkpoint, CheckpointError};
use crate::analysis::outcome::{Frame, Outcome};
use crate::data::info::SolveInfo;
use crate::data::state::State;
use crate::data::statics::Statics;
use crate::data::verdict::Judgement;
use crate::forms::{Sparse, Start};
use crate::history::energy::{self, FrictionWork, Snapshot};
use crate::history::spread::AtEnd;
use crate::history::{self, History, SecondLoading, Step, StepRecord};
use crate::method::Request;
use crate::method::sparse::UNKNOWN;
use crate::model::Model;
use crate::plan::Plan;
use crate::recover;
use crate::rounding::cleared;
use crate::scene::{Scene, Solver};
use crate::system::System;
use crate::verify::checks::Checks;
use crate::verify::verdict::{self, Findings, LoadingEnd};

/// A scene that is solved step by step.
///
/// ```
/// use std::ops::ControlFlow;
/// use masonry::scene::{Block, Joint, Load, Material, Movement, Scene, Stage, Support};
/// use masonry::analysis::solve::Run;
/// use masonry::units::Units;
///
/// // A block on a floor that is drawn away below it.
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
    title: String,
    /// The model under the only step; if there are several, with all loads in full and all supports in
    /// their places.
    model: Model,
    plan: Plan,
    system: System,
    steps: Vec<Step>,
    loads: Vec<String>,
    /// Unusual magnitudes of the scene.
    unusual: Vec<String>,
    /// The scene that a checkpoint must match; empty for one step, without checkpoint.
    origin: String,
    pub(super) request: Request,
    with_stresses: bool,
    /// How many steps were solved.
    solved: usize,
    /// Records of these steps; empty for one step.
    records: Vec<StepRecord>,
    /// What another loading has come to.
    pub(super) second_loading: Option<SecondLoading>,
    reached: Option<Reached>,
    last: Option<Last>,
    /// Where the pivots of the next step start.
    basis: Option<Start>,
    /// The sparse problem of the last step that was tried, if it was built.
    sparse: Option<Sparse>,
    clock: Clock,
}

/// What the last step that was solved has come to.
#[derive(Debug)]
struct Reached {
    info: SolveInfo,
    state: State,
    checks: Option<Checks>,
    /// The step as the next one needs it; `None` where there is only one.
    in_history: Option<InHistory>,
}

/// The model of a step, and what tells the work to the next one.
#[derive(Debug)]
struct InHistory {
    model: Model,
    /// How far every contact point had slid where the slips of the state are measured from \[m\].
    slips: Vec<f64>,
    snapshot: Snapshot,
}

/// How the last step that was tried ended.
#[derive(Debug)]
struct Last {
    info: SolveInfo,
    statics: Option<Statics>,
    led: Option<LoadingEnd>,
    mechanism: Option<Vec<Vec<Vector2<f64>>>>,
}

impl Run {
    /// Builds what all steps have in common.
    ///
    /// # Errors
    /// [`SolveError`] when the scene is wrong or too large.
    pub fn new(
        scene: &Scene,
        observer: &mut dyn FnMut(Event) -> ControlFlow<()>,
    ) -> Result<Self, SolveError> {
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
        let Solver { tolerance, form, max_pivots, max_steps, soft, .. } = scene.solver;
        let [max_pivots, max_steps] =
            [max_pivots, max_steps].map(|limit| limit.map(|it| it as usize));
        Ok(Self {
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
            solved: 0,
            records: Vec::new(),
            second_loading: None,
            reached: None,
            last: None,
            basis: None,
            sparse: None,
            clock,
        })
    }

    /// Goes on from the last step of a checkpoint.
    ///
    /// Route, tolerance, output, and stages that are still to come may differ from those of the run that
    /// wrote it.
    ///
    /// # Errors
    /// [`CheckpointError`] when it belongs to another scene, to steps that are not those of this one, when a state
    /// in it does not hold, and for scenes of one step.
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
            let StepRecord { step: Step { stage, number, .. }, .. } = &records[position];
            return Err(CheckpointError::OtherSteps { stage: stage.clone(), step: *number }.into());
        }
        let Some(record) = records.last() else { return Ok(self) };
        let slips = vec![0.0; self.model.contacts.len()];
        let model = self.model.under(&record.step.actions, &slips);
        let state = checkpoint.state(&model, self.with_stresses)?;
        self.system.reload(&model);
        let snapshot = Snapshot::of(&model, &self.system, &state);
        let slips = checkpoint.slips(&model)?;
        let model = self.model.under(&record.step.actions, &slips);
        // Its slips are those of the last step, while those of the state are all that have been.
        let mut of_step = state.clone();
        of_step.contacts.iter_mut().zip(&slips).for_each(|(contact, slip)| contact.y_t -= slip);
        let checks = Checks::of(&model, &of_step);
        let info = checkpoint.solve.clone();
        let tolerance = self.request.tolerance.max(record.residuals.worst());
        if info.status != Status::Solved || !checks.hold(tolerance) {
            return Err(CheckpointError::NoEquilibrium.into());
        }
        let in_history = Some(InHistory { model, slips, snapshot });
        let reached = Reached { info: info.clone(), state, checks: Some(checks), in_history };
        self.reached = Some(reached);
        self.last = Some(Last { info, statics: None, led: None, mechanism: None });
        self.solved = records.len();
        self.records.clone_from(records);
        self.basis = checkpoint.basis(self.system.rows.len() + self.system.friction.len());
        Ok(self)
    }

    /// Solves the next step; false when there is none, or the last one failed. `Break` cancels the step, which fails then.
    ///
    /// # Errors
    /// As [`solve`](super::solve). Steps that were solved before are kept.
    pub fn advance(
        &mut self,
        observer: &mut dyn FnMut(Event) -> ControlFlow<()>,
    ) -> Result<bool, SolveError> {
        let is_over = self.last.as_ref().is_some_and(|last| last.info.status != Status::Solved);
        let Some(step) = self.steps.get(self.solved).filter(|_| !is_over).cloned() else {
            return Ok(false);
        };
        let stepped = self.has_history().then(|| {
            let slips = self.slips();
            (self.model.under(&step.actions, &slips), slips)
        });
        let before = match (&stepped, self.records.last()) {
            (Some((_, slips)), Some(record)) => {
                self.system.reload(&self.model.under(&record.step.actions, slips));
                Some(Sparse::new(&self.system)?.problem)
            }
            _ => None,
        };
        if let Some((model, _)) = &stepped {
            let (number, of) = (self.solved + 1, self.steps.len());
            if observer(Event::Step { number, of }).is_break() {
                let info = SolveInfo::new(self.plan.routes[0].route, Status::Cancelled, UNKNOWN);
                self.last = Some(Last { info, statics: None, led: None, mechanism: None });
                return Ok(true);
            }
            self.system.reload(model);
        }
        let model = stepped.as_ref().map_or(&self.model, |(model, _)| model);
        let before = before.zip(self.reached.as_ref());
        let before = before.map(|(problem, reached)| Before { problem, state: &reached.state });
        self.sparse = None;
        let (clock, with_stresses) = (&mut self.clock, self.with_stresses);
        let chain = Chain::new(model, &self.system, self.request, with_stresses, clock, observer);
        let found = chain.after(self.basis.take(), before).run(&self.plan.routes);
        match found {
            Ok(found) => self.take(step, stepped, found),
            Err(error) if self.solved == 0 => return Err(error),
            Err(error) => {
                let info =
                    SolveInfo::new(self.plan.routes[0].route, Status::NumericalTrouble, UNKNOWN);
                self.last = Some(Last { info, statics: None, led: None, mechanism: None });
                let Step { stage, number, .. } = step;
                let error = Box::new(error);
                return Err(SolveError::Step { stage, step: number, error });
            }
        }
        Ok(true)
    }

    /// The slip of every contact point after the last step.
    fn slips(&self) -> Vec<f64> {
        match &self.reached {
            Some(reached) => reached.state.contacts.iter().map(|contact| contact.y_t).collect(),
            None => vec![0.0; self.model.contacts.len()],
        }
    }

    /// Keeps a solved step, or the state of an unsolved one if there is no earlier state.
    /// An only step has nothing to remember except its state.
    fn take(&mut self, step: Step, stepped: Option<(Model, Vec<f64>)>, found: Tried) {
        let Tried { info, state, checks, mechanism, basis, statics, led, moved, account, sparse } =
            found;
        (self.basis, self.sparse) = (basis, sparse);
        if let (Some(moved), None) = (&moved, &stepped) {
            // The state is judged with slips from where the blocks came to.
            self.model = self.model.slid(moved);
        }
        if let Some(mut state) = state {
            let model = stepped.as_ref().map_or(&self.model, |(model, _)| model);
            let friction = match &account {
                Some(account) => FrictionWork::of_way(account),
                None => FrictionWork::of_step(model, &state.contacts),
            };
            let in_history = stepped.map(|(mut model, mut slips)| {
                if let Some(moved) = &moved {
                    slips.iter_mut().zip(moved).for_each(|(slip, moved)| *slip += moved);
                    model = self.model.under(&step.actions, &slips);
                }
                let steps = model.contacts.iter().zip(&mut state.contacts).zip(&slips);
                let frictional = steps.filter(|((contact, _), _)| contact.law.resists_sliding());
                let moved = state.displacements.iter().flatten().map(nalgebra::Matrix::amax);
                let most = moved.fold(0.0, f64::max);
                for ((_, contact), slip) in frictional {
                    contact.y_t = slip + cleared(contact.y_t, most);
                }
                let snapshot = Snapshot::of(&model, &self.system, &state);
                InHistory { model, slips, snapshot }
            });
            let is_solved = info.status == Status::Solved;
            if is_solved || self.reached.is_none() {
                let reached = Reached { info: info.clone(), state, checks, in_history };
                if is_solved {
                    self.solved += 1;
                    self.records.extend(self.record(step, friction, &reached));
                }
                self.reached = Some(reached);
            }
        }
        self.last = Some(Last { info, statics, led, mechanism });
    }

    /// The record of a step that follows the last one reached; `None` where there is no history.
    fn record(&self, step: Step, friction: FrictionWork, reached: &Reached) -> Option<StepRecord> {
        let Reached { info, state, checks, in_history } = reached;
        let InHistory { model, snapshot, .. } = in_history.as_ref()?;
        let before = self.reached.as_ref().and_then(|it| it.in_history.as_ref());
        let work = match before {
            Some(before) => before.snapshot.work_to(snapshot),
            None => snapshot.at_rest().work_to(snapshot),
        };
        let held_before =
            self.reached.as_ref().map_or(0.0, |before| energy::held(model, &before.state.contacts));
        let held = energy::held(model, &state.contacts) - held_before;
        let largest = state.displacements.iter().flatten().map(nalgebra::Matrix::amax);
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
            largest_displacement: largest.fold(0.0, f64::max),
            contacts: checks.as_ref().map_or([0; 3], |it| [it.open, it.stick, it.slip]),
            reactions: recover::reactions(model, &state.contacts),
        })
    }

    /// Whether there are several steps.
    pub fn has_history(&self) -> bool {
        self.steps.len() > 1
    }

    /// How many steps were solved.
    pub fn solved_steps(&self) -> usize {
        self.solved
    }

    /// How many steps there are.
    pub fn steps(&self) -> usize {
        self.steps.len()
    }

    /// The state after the last step that was solved; `None` before the first, and for a scene of one step.
    pub fn frame(&self) -> Option<Frame> {
        let position = self.records.len().checked_sub(1)?;
        let Reached { state, in_history, .. } = self.reached.as_ref()?;
        let InHistory { model, .. } = in_history.as_ref()?;
        let step = self.records[position].step.clone();
        Some(Frame { step, position, model: model.clone(), state: state.clone() })
    }

    /// What the last step of a history has come to; `None` before it is solved.
    pub(super) fn at_end(&self) -> Option<AtEnd<'_>> {
        let Reached { state, in_history, .. } =
            self.reached.as_ref().filter(|_| self.solved == self.steps.len())?;
        let dissipation = self.records.iter().map(|record| record.dissipation).sum();
        Some(AtEnd { model: &in_history.as_ref()?.model, state, dissipation })
    }

    /// Everything that the next step needs; `None` before the first, and for a scene of one step.
    pub fn checkpoint(&self) -> Option<Checkpoint> {
        let Reached { info, state, in_history, .. } = self.reached.as_ref()?;
        let slips = &in_history.as_ref()?.slips;
        (!self.records.is_empty()).then(|| {
            let (origin, records) = (self.origin.clone(), self.records.clone());
            Checkpoint::new(origin, records, info.clone(), state, slips, self.basis.as_ref())
        })
    }

    /// The outcome: the state after the last step that was solved.
    pub fn finish(self) -> Outcome {
        let failed = self.steps.get(self.solved).cloned();
        let Last { info, statics, led, mechanism } = self.last.unwrap_or_else(|| {
            let info = SolveInfo::new(self.plan.routes[0].route, Status::Cancelled, UNKNOWN);
            Last { info, statics: None, led: None, mechanism: None }
        });
        let steps = self.steps.len();
        let Self { records, loads, second_loading, .. } = self;
        let history = History { records, failed, steps, loads, second_loading };
        let (model, state, checks) = match self.reached {
            Some(Reached { state, checks, in_history, .. }) => {
                (in_history.map_or(self.model, |it| it.model), Some(state), checks)
            }
            None => (self.model, None, None),
        };
        let contacts = state.as_ref().map(|state| &state.contacts);
        let reactions =
            contacts.map_or_else(Vec::new, |contacts| recover::reactions(&model, contacts));
        let history = (steps > 1).then_some(history);
        let build = || Sparse::new(&self.system).ok();
        let sparse = state.as_ref().and_then(|_| self.sparse.or_else(build));
        let circulating = state.as_ref().zip(sparse);
        let judgement = Judgement::of(&Findings {
            model: &model,
            info: &info,
            state: state.as_ref(),
            statics: statics.as_ref(),
            led,
            history: history.as_ref(),
            at_rest: self.system.is_at_rest(),
            unusual: &self.unusual,
            circulating: circulating
                .map_or(0, |(state, sparse)| verdict::circulating(&model, &sparse.problem, state)),
        });
        Outcome {
            title: self.title,
            model,
            plan: self.plan,
            solve: info,
            state,
            checks,
            reactions,
            history,
            mechanism,
            judgement,
            times: self.clock.times,
        }
    }
}
