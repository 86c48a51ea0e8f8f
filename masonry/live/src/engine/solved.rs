//! A scene that was solved, and its views.

use std::fmt::Display;

use masonry::analysis::outcome::Frame;
use masonry::analysis::solve::Event;
use masonry::model::Model;
use masonry::scene::Combined;
use masonry::{Outcome, Run, Scene, SolveError, State, Verdict};
use masonry_report::cases::Cases;
use masonry_report::svg::{self, ReferenceLines};
use masonry_report::{dxf, json, page, table};
use serde::{Deserialize, Serialize};

use super::fault::Fault;
use super::watch::Watch;

/// A view that the page can show beside the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Show {
    /// The picture that explains the verdict: the forces if the structure stands, the mechanism if it falls.
    Answer,
    Forces,
    Stresses,
    Cracks,
    Deformed,
    Mechanism,
    Scene,
    Tables,
    /// The report as text.
    Report,
}

/// A kind of file that the page can export.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Format {
    Page,
    Json,
    Text,
    Dxf,
}

/// The view that the page requests, and the step of a load history; `None` for the last step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    pub(super) show: Show,
    pub(super) step: Option<usize>,
}

/// A scene that was solved; if the scene has combinations, the result is that of the governing combination.
#[derive(Debug)]
pub(super) struct Solved {
    scene: Scene,
    ran: Ran,
    /// The table of all combinations; `None` for a scene without combinations.
    cases: Option<Cases>,
    /// Whether the solve ran to its end.
    is_complete: bool,
    pub(super) reference: Option<ReferenceLines>,
}

/// The result of a solve after all steps.
#[derive(Debug)]
struct Ran {
    outcome: Outcome,
    /// The steps of a load history that have pictures.
    frames: Vec<Frame>,
}

impl Ran {
    fn of(scene: &Scene, watch: &mut Watch<'_>) -> Result<Self, SolveError> {
        let mut observe = |event: Event| match event {
            Event::Step { number, of } => watch(&format_args!("step {number} of {of}")),
            Event::Phase(phase) => watch(&phase),
            Event::Pivots(at) => {
                watch(&format_args!("pivot {} of attempt {}", at.pivots, at.attempt))
            }
            Event::Iteration { number, residual } => {
                watch(&format_args!("iteration {number}, residual {residual:.1e}"))
            }
        };
        let mut run = Run::new(scene, &mut observe)?;
        let mut frames = Vec::new();
        // The second loading of a load history is left out, since it would double the time.
        while run.advance(&mut observe)? {
            let is_shown = |it: &Frame| page::is_framed(it.position, run.steps());
            frames.extend(run.frame().filter(is_shown));
        }
        Ok(Self { outcome: run.finish(), frames })
    }

    /// Solves all combinations, and returns the result of the governing one with the table of all. No step has a
    /// picture, since scenes with combinations have no stages.
    fn governing(scene: &Scene, watch: &mut Watch<'_>) -> Result<(Self, Option<Cases>), Fault> {
        let mut list: Vec<Combined<Outcome>> = Vec::new();
        for Combined { name, of } in scene.combined() {
            let mut inner = |it: &dyn Display| watch(&format_args!("combination \"{name}\": {it}"));
            let ran = Self::of(&of, &mut inner).map_err(|error| {
                let fault = Fault::from(error);
                Fault { message: format!("combination \"{name}\": {}", fault.message), ..fault }
            })?;
            let is_cancelled = is_cancelled(&ran.outcome);
            list.push(Combined { name, of: ran.outcome });
            if is_cancelled {
                break;
            }
        }
        let cases = Cases::of_outcomes(&list);
        let governs = cases.as_ref().map_or(0, Cases::governs);
        let outcome = list.swap_remove(governs).of;
        Ok((Self { outcome, frames: Vec::new() }, cases))
    }
}

fn is_cancelled(outcome: &Outcome) -> bool {
    outcome.solve.status == lcp::Status::Cancelled
}

/// The answer for one view of a solved scene.
#[derive(Debug, Serialize)]
pub(super) struct Shown {
    verdict: &'static str,
    sentence: String,
    warnings: Vec<String>,
    /// Time of the solve \[s\].
    seconds: f64,
    /// The views that the solved scene has.
    choices: Vec<Show>,
    /// The view that this answer shows.
    show: Show,
    report: Option<String>,
    /// The tables in HTML, if the view shows tables.
    tables: Option<String>,
    /// Names of the steps that have pictures; empty without a load history.
    steps: Vec<String>,
}

impl Solved {
    pub(super) fn new(scene: Scene, watch: &mut Watch<'_>) -> Result<Self, Fault> {
        let mut is_complete = true;
        let mut inner = |it: &dyn Display| {
            let flow = watch(it);
            is_complete &= flow.is_continue();
            flow
        };
        let (ran, cases) = if scene.combinations.is_empty() {
            (Ran::of(&scene, &mut inner)?, None)
        } else {
            Ran::governing(&scene, &mut inner)?
        };
        is_complete &= !is_cancelled(&ran.outcome);
        let reference = ReferenceLines::of(&scene);
        Ok(Self { scene, ran, cases, is_complete, reference })
    }

    pub(super) fn is_of(&self, scene: &Scene) -> bool {
        self.scene == *scene
    }

    pub(super) fn is_complete(&self) -> bool {
        self.is_complete
    }

    pub(super) fn title(&self) -> &str {
        &self.ran.outcome.title
    }

    /// Returns the answer for the requested view.
    pub(super) fn shown(&self, show: Show) -> Shown {
        let outcome = &self.ran.outcome;
        let seen = self.seen(show);
        let name = |it: &Frame| format!("{} {}/{}", it.step.stage, it.step.number, it.step.of);
        Shown {
            verdict: self.verdict(),
            sentence: self.sentence(),
            warnings: outcome.judgement.warnings.clone(),
            seconds: outcome.times.iter().map(|it| it.seconds).sum(),
            choices: self.choices(),
            show: seen,
            report: (seen == Show::Report).then(|| self.report()),
            tables: (seen == Show::Tables).then(|| page::tables(outcome, self.cases.as_ref())),
            steps: self.ran.frames.iter().map(name).collect(),
        }
    }

    pub(super) fn verdict(&self) -> &'static str {
        match self.ran.outcome.judgement.verdict {
            Verdict::Stands => "stands",
            Verdict::Falls => "falls",
            Verdict::Undecided => "undecided",
        }
    }

    pub(super) fn sentence(&self) -> String {
        let sentence = &self.ran.outcome.judgement.sentence;
        match &self.cases {
            Some(cases) => format!("{}: {sentence}", cases.governing()),
            None => sentence.clone(),
        }
    }

    fn report(&self) -> String {
        let head = self.cases.as_ref().map_or_else(String::new, Cases::head);
        head + &table::report(&self.ran.outcome)
    }

    /// Returns the requested view if it exists; otherwise the view that explains the verdict.
    pub(super) fn seen(&self, show: Show) -> Show {
        let outcome = &self.ran.outcome;
        if show != Show::Answer && self.choices().contains(&show) {
            show
        } else if outcome.mechanism.is_some() {
            Show::Mechanism
        } else if outcome.state.is_some() {
            Show::Forces
        } else {
            Show::Scene
        }
    }

    fn choices(&self) -> Vec<Show> {
        let outcome = &self.ran.outcome;
        let mut list = vec![Show::Answer];
        if let Some(state) = &outcome.state {
            list.push(Show::Forces);
            if !state.stresses.is_empty() {
                list.push(Show::Stresses);
            }
            list.extend([Show::Cracks, Show::Deformed]);
        }
        if outcome.mechanism.is_some() {
            list.push(Show::Mechanism);
        }
        list.extend([Show::Scene, Show::Tables, Show::Report]);
        list
    }

    /// Returns the model and the state after a step.
    pub(super) fn state(&self, step: Option<usize>) -> Option<(&Model, &State)> {
        let Ran { outcome, frames } = &self.ran;
        match step.and_then(|it| frames.get(it)) {
            Some(frame) => Some((&frame.model, &frame.state)),
            None => Some((&outcome.model, outcome.state.as_ref()?)),
        }
    }

    /// Draws the picture of a view; `None` for tables and reports.
    pub(super) fn picture(&self, Seen { show, step }: Seen) -> Option<String> {
        let (outcome, title) = (&self.ran.outcome, self.title());
        let show = self.seen(show);
        if matches!(show, Show::Tables | Show::Report) {
            return None;
        }
        if show == Show::Mechanism {
            let rates = outcome.mechanism.as_ref()?;
            return Some(svg::mechanism(title, &outcome.model, rates));
        }
        let Some((model, state)) = self.state(step) else {
            return Some(svg::scene(title, &outcome.model));
        };
        let contacts = &state.contacts;
        Some(match show {
            Show::Forces => svg::forces(title, model, contacts),
            Show::Stresses => svg::principal_stresses(title, model, state, self.reference.as_ref()),
            Show::Cracks => svg::cracks_or_none(title, model, contacts),
            Show::Deformed => svg::deformed(title, model, state),
            _ => svg::scene(title, model),
        })
    }

    /// Returns the text of a file of this format.
    pub(super) fn file(&self, format: Format) -> Result<String, Fault> {
        let Ran { outcome, frames } = &self.ran;
        let cases = self.cases.as_ref();
        Ok(match format {
            Format::Page => page::solved(outcome, frames, self.reference.as_ref(), cases),
            Format::Json => {
                let object = json::result(outcome, &[])?;
                match cases {
                    Some(cases) => cases.json("result", &object)?,
                    None => object,
                }
            }
            Format::Text => self.report(),
            Format::Dxf => dxf::drawing(outcome),
        })
    }
}
