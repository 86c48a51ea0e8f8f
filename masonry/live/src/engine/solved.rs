//! A scene that was solved, and what is seen of it.

use masonry::analysis::outcome::Frame;
use masonry::analysis::solve::Event;
use masonry::model::Model;
use masonry::{Outcome, Run, Scene, SolveError, State, Verdict};
use masonry_report::svg::{self, ReferenceLines};
use masonry_report::{dxf, json, page, table};
use serde::{Deserialize, Serialize};

use super::fault::Fault;
use super::watch::Watch;

/// What is seen beside the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Show {
    /// The picture that explains the verdict: forces of a wall that stands, the mechanism of one that falls.
    Answer,
    Forces,
    Stresses,
    Cracks,
    Deformed,
    Mechanism,
    Scene,
    /// The report as text.
    Report,
}

/// A kind of file.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Format {
    Page,
    Json,
    Text,
    Dxf,
}

/// A scene that was solved.
#[derive(Debug)]
pub(super) struct Solved {
    text: String,
    outcome: Outcome,
    /// The steps of a load history that have pictures.
    frames: Vec<Frame>,
    reference: Option<ReferenceLines>,
}

/// What the page shows of it.
#[derive(Debug, Serialize)]
pub(super) struct Shown {
    verdict: &'static str,
    sentence: String,
    warnings: Vec<String>,
    /// Time of the solve \[s\].
    seconds: f64,
    /// What can be seen.
    choices: Vec<Show>,
    /// What is seen.
    show: Show,
    picture: Option<String>,
    report: Option<String>,
    /// Names of the steps that have pictures; empty without a load history.
    steps: Vec<String>,
}

impl Solved {
    pub(super) fn new(
        text: &str,
        scene: &Scene,
        watch: &mut Watch<'_>,
    ) -> Result<Self, SolveError> {
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
        // The second loading of a history, which doubles its time, is left out.
        while run.advance(&mut observe)? {
            let is_shown = |it: &Frame| page::is_framed(it.position, run.steps());
            frames.extend(run.frame().filter(is_shown));
        }
        let reference = ReferenceLines::of(scene);
        Ok(Self { text: text.to_owned(), outcome: run.finish(), frames, reference })
    }

    pub(super) fn is_of(&self, text: &str) -> bool {
        self.text == text
    }

    /// Whether nobody has ended the solve early.
    pub(super) fn is_complete(&self) -> bool {
        self.outcome.solve.status != lcp::Status::Cancelled
    }

    /// What is seen of the state after a step, the last one without a number.
    pub(super) fn shown(&self, show: Show, step: Option<usize>) -> Shown {
        let outcome = &self.outcome;
        let choices = self.choices();
        let seen = if choices.contains(&show) { self.seen(show) } else { self.seen(Show::Answer) };
        let is_report = seen == Show::Report;
        let name = |it: &Frame| format!("{} {}/{}", it.step.stage, it.step.number, it.step.of);
        Shown {
            verdict: self.verdict(),
            sentence: outcome.judgement.sentence.clone(),
            warnings: outcome.judgement.warnings.clone(),
            seconds: outcome.times.iter().map(|it| it.seconds).sum(),
            choices,
            show: seen,
            picture: if is_report { None } else { self.picture(seen, step) },
            report: is_report.then(|| table::report(outcome)),
            steps: self.frames.iter().map(name).collect(),
        }
    }

    pub(super) fn verdict(&self) -> &'static str {
        match self.outcome.judgement.verdict {
            Verdict::Stands => "stands",
            Verdict::Falls => "falls",
            Verdict::Undecided => "undecided",
        }
    }

    /// What an answer shows.
    fn seen(&self, show: Show) -> Show {
        match show {
            Show::Answer if self.outcome.mechanism.is_some() => Show::Mechanism,
            Show::Answer if self.outcome.state.is_some() => Show::Forces,
            Show::Answer => Show::Scene,
            other => other,
        }
    }

    fn choices(&self) -> Vec<Show> {
        let outcome = &self.outcome;
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
        list.extend([Show::Scene, Show::Report]);
        list
    }

    /// The state after a step with its model.
    fn state(&self, step: Option<usize>) -> Option<(&Model, &State)> {
        match step.and_then(|it| self.frames.get(it)) {
            Some(frame) => Some((&frame.model, &frame.state)),
            None => Some((&self.outcome.model, self.outcome.state.as_ref()?)),
        }
    }

    /// A picture of the state after a step, the last one without a number.
    pub(super) fn picture(&self, show: Show, step: Option<usize>) -> Option<String> {
        let show = self.seen(show);
        let (outcome, title) = (&self.outcome, self.outcome.title.as_str());
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
            Show::Cracks => {
                svg::cracks(title, model, contacts).unwrap_or_else(|| svg::scene(title, model))
            }
            Show::Deformed => svg::deformed(title, model, state),
            _ => svg::scene(title, model),
        })
    }

    /// The text of a file.
    pub(super) fn file(&self, format: Format) -> Result<String, Fault> {
        let outcome = &self.outcome;
        Ok(match format {
            Format::Page => page::solved(outcome, &self.frames, self.reference.as_ref(), None),
            Format::Json => json::result(outcome, &[])?,
            Format::Text => table::report(outcome),
            Format::Dxf => dxf::drawing(outcome),
        })
    }
}
