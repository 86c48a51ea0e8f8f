//! One wall of the bench: its verdict, and what that costs.

use std::fmt;
use std::ops::ControlFlow;
use std::time::Instant;

use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::{Event, Run};
use masonry::data::info::PhaseTime;
use masonry::forms::Sparse;
use masonry::model::Model;
use masonry::system::System;
use masonry::{Evidence, Verdict};

use crate::sparse;
use crate::walls::{Case, Wall};

/// The head of the table of rows.
pub(crate) const HEAD: &str = "| case | mu | bricks | verdict | evidence | steps | of these keep the law | least P / cap | \
     factorisations, mean of steps | most | time \\[s\\] | time / Cholesky | memory \\[MB\\] |\n\
     |:--|--:|:--|:--|:--|--:|--:|--:|--:|--:|--:|--:|--:|\n";

/// One wall in one case.
pub(crate) struct Row {
    pub(crate) case: Case,
    pub(crate) mu: f64,
    pub(crate) bricks: String,
    pub(crate) number: usize,
    pub(crate) verdict: Verdict,
    evidence: Evidence,
    /// Steps that were solved, of all; `None` without a history.
    steps: Option<[usize; 2]>,
    /// How many of them keep Coulomb's law, and the least that friction took of what it could.
    law: Option<(usize, f64)>,
    /// Of every step; without a history the steps of all methods that were tried.
    counts: Vec<usize>,
    pub(crate) seconds: f64,
    pub(crate) phases: Vec<PhaseTime>,
    /// Seconds of one Cholesky factorisation of a matrix with the pattern of the steps.
    pub(crate) yardstick: f64,
    /// Largest resident memory, in megabytes, where the system tells it.
    pub(crate) memory: Option<f64>,
}

impl Row {
    pub(crate) fn of(
        wall: &Wall,
        bricks: &str,
        (case, limit): (Case, f64),
        yardstick: f64,
    ) -> Self {
        sparse::forget_peak();
        let began = Instant::now();
        let mut iterations = 0;
        let mut observer = |event: Event| {
            iterations += usize::from(matches!(event, Event::Iteration { .. }));
            ControlFlow::Continue(())
        };
        let mut run = Run::new(&wall.scene(case, limit), &mut observer).expect("a sound scene");
        while run.advance(&mut observer).expect("sound data") {}
        let outcome = run.finish();
        let seconds = began.elapsed().as_secs_f64();
        let history = outcome.history.as_ref();
        Self {
            case,
            mu: wall.mu,
            bricks: bricks.to_owned(),
            number: outcome.model.blocks.len(),
            verdict: outcome.judgement.verdict,
            evidence: outcome.judgement.evidence,
            steps: history.map(|it| [it.records.len(), it.steps]),
            law: history.map(|it| {
                let powers = it.records.iter().filter_map(|record| record.friction_power);
                (it.records.len() - it.steps_against_law(), powers.fold(1.0, f64::min))
            }),
            counts: counts(&outcome, iterations),
            seconds,
            phases: outcome.times,
            yardstick,
            memory: sparse::peak(),
        }
    }

    /// The mean of all steps.
    pub(crate) fn factorisations(&self) -> f64 {
        self.counts.iter().sum::<usize>() as f64 / self.counts.len().max(1) as f64
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { case, mu, bricks, verdict, evidence, .. } = self;
        let steps =
            self.steps.map_or_else(|| "1".to_owned(), |[solved, all]| format!("{solved} of {all}"));
        let law = self
            .law
            .map_or_else(|| "- | -".to_owned(), |(kept, least)| format!("{kept} | {least:.4}"));
        let most = self.counts.iter().max().copied().unwrap_or(0);
        let memory = self.memory.map_or_else(|| "-".to_owned(), |it| format!("{it:.0}"));
        write!(
            f,
            "| {case} | {mu} | {bricks} | {verdict} | {evidence:?} | {steps} | {law} | {:.0} | {most} | \
             {:.1} | {:.0} | {memory} |",
            self.factorisations(),
            self.seconds,
            self.seconds / self.yardstick
        )
    }
}

fn counts(outcome: &Outcome, iterations: usize) -> Vec<usize> {
    let Some(history) = &outcome.history else { return vec![iterations] };
    history.records.iter().map(|record| record.factorisations).collect()
}

/// Seconds of one Cholesky factorisation, symbolic and numeric, of a matrix with the pattern of the steps.
pub(crate) fn yardstick(wall: &Wall) -> f64 {
    let model = Model::from_scene(&wall.scene(Case::Lean, 0.0)).expect("a sound scene");
    let system = System::new(&model).expect("sound blocks");
    let problem = Sparse::new(&system).expect("finite data").problem;
    let matrix = sparse::condensed(&problem);
    let (symbolic, numeric) =
        sparse::fastest(3, |(s, n): &(f64, f64)| s + n, || sparse::cholesky(&matrix));
    symbolic + numeric
}
