//! `masonry solve`: the equilibrium of a scene.

use std::path::{Path, PathBuf};

use clap::Args;
use lcp::Status;

use crate::end::{Failure, NOT_SOLVED, SOLVED, listing, names, print};
use crate::interrupt;
use crate::out_dir::OutDir;
use crate::page;
use crate::progress::Progress;
use crate::route::RouteValue;
use masonry::Verdict;
use masonry::analysis::checkpoint::{Checkpoint, CheckpointError};
use masonry::analysis::outcome::{Frame, Outcome};
use masonry::analysis::solve::Run;
use masonry::scene::{Combined, Scene};
use masonry_import::read_scene;
use masonry_report::cases::Cases;
use masonry_report::svg::ReferenceLines;
use masonry_report::{self as report, ReportOptions, json, table};

/// The name of the file with the state after the last solved step of a load history.
const CHECKPOINT: &str = "checkpoint.json";

#[derive(Debug, Args)]
pub(super) struct SolveArgs {
    /// The scene file (TOML).
    scene: PathBuf,
    /// Directory for pictures, tables and a mesh; created if it does not exist.
    #[arg(long)]
    out: Option<PathBuf>,
    /// The route to the solution, instead of that of the scene.
    #[arg(long)]
    route: Option<RouteValue>,
    /// Continue a load history from `checkpoint.json` in the directory of `--out`.
    #[arg(long, requires = "out")]
    resume: bool,
    /// Leave out the second loading of a load history, which shows how far its answer is unique.
    #[arg(long)]
    no_spread: bool,
    /// Also write the report with its pictures as one page of HTML.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Print one JSON object instead of the report.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &SolveArgs) -> Result<u8, Failure> {
    let mut scene = read_scene(&args.scene)?;
    if let Some(route) = args.route {
        scene = scene.route(route.0);
    }
    interrupt::listen();
    let from = args.resume.then_some(CHECKPOINT);
    let mut out = args.out.as_deref().map(|out| OutDir::open(out, "solve", from)).transpose()?;
    page::check(args.report.as_deref(), &scene, args.out.as_deref())?;
    let (Ran { outcome, frames, files: mut in_out, end }, lines) = if scene.combinations.is_empty()
    {
        (run_steps(&scene, args, out.as_mut())?, None)
    } else {
        run_combinations(&scene, args)?
    };
    let options =
        ReportOptions { reference: ReferenceLines::of(&scene), ..ReportOptions::default() };
    let written = match &out {
        Some(out) => report::write_all(&outcome, out.path(), &options),
        None => Ok(Vec::new()),
    };
    // The results are printed even if some file could not be written.
    in_out.extend_from_slice(written.as_deref().unwrap_or_default());
    let mut files = in_out.clone();
    let (reference, lines) = (options.reference.as_ref(), lines.as_ref());
    let page = || report::page::solved(&outcome, &frames, reference, lines);
    let page = page::write(args.report.as_deref(), page, &mut files);
    let names = names(&files);
    print(&match (lines, args.json) {
        (None, true) => json::result(&outcome, &names)?,
        (Some(lines), true) => lines.json("result", &json::result(&outcome, &names)?)?,
        (None, false) => format!("{}\n{}", table::report(&outcome), listing(&files)),
        (Some(lines), false) => {
            format!("{}{}\n{}", lines.head(), table::report(&outcome), listing(&files))
        }
    })?;
    let is_cancelled = outcome.solve.status == Status::Cancelled;
    out.map_or(Ok(()), |out| out.finish(&in_out, is_cancelled))?;
    if is_cancelled && lines.is_none() {
        say_how_to_go_on(args, &outcome);
    }
    written?;
    page?;
    end?;
    Ok(if outcome.judgement.verdict == Verdict::Stands { SOLVED } else { NOT_SOLVED })
}

/// Solves all combinations until Ctrl-C; returns the result of the governing combination, and the table of all.
fn run_combinations(scene: &Scene, args: &SolveArgs) -> Result<(Ran, Option<Cases>), Failure> {
    if args.resume {
        return Err(CheckpointError::OneStep.into());
    }
    let mut list: Vec<Combined<Outcome>> = Vec::new();
    for Combined { name, of } in scene.combined() {
        let ran = run_steps(&of, args, None);
        let ran = ran.map_err(|error| format!("combination \"{name}\": {error}"))?;
        ran.end?;
        list.push(Combined { name, of: ran.outcome });
        if list.last().is_some_and(|it| it.of.solve.status == Status::Cancelled) {
            break;
        }
    }
    let lines = Cases::of_outcomes(&list);
    let governs = lines.as_ref().map_or(0, Cases::governs);
    let outcome = list.swap_remove(governs).of;
    // Scenes with combinations have no stages, so that there is no step to continue from, and no step has a picture.
    Ok((Ran { outcome, frames: Vec::new(), files: Vec::new(), end: Ok(()) }, lines))
}

/// The result of a solve after all steps.
struct Ran {
    outcome: Outcome,
    /// The steps that have pictures on the page of `--report`.
    frames: Vec<Frame>,
    /// The path of the checkpoint, if one was written.
    files: Vec<PathBuf>,
    /// The error that occurred after a step was solved, such as that of writing the checkpoint.
    end: Result<(), Failure>,
}

fn run_steps(
    scene: &Scene,
    args: &SolveArgs,
    mut out: Option<&mut OutDir>,
) -> Result<Ran, Failure> {
    let path = out.as_ref().map(|out| out.path().join(CHECKPOINT));
    let mut progress = Progress::new();
    let mut run = Run::new(scene, &mut |event| progress.show(event))?;
    if let (true, Some(out), Some(path)) = (args.resume, &mut out, &path) {
        if !run.has_history() {
            return Err(CheckpointError::OneStep.into());
        }
        run = run.resume(&Checkpoint::read(path)?)?;
        out.claim(CHECKPOINT)?;
    }
    let (mut frames, mut files, mut end) = (Vec::new(), Vec::new(), Ok(()));
    loop {
        let solved = run.solved_steps();
        match run.advance(&mut |event| progress.show(event)) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) if run.solved_steps() == 0 => return Err(error.into()),
            Err(error) => {
                end = Err(error.into());
                break;
            }
        }
        let is_new = run.solved_steps() > solved;
        if args.report.is_some() && is_new {
            let is_shown = |it: &Frame| report::page::is_framed(it.position, run.steps());
            frames.extend(run.frame().filter(is_shown));
        }
        let checkpoint = run.checkpoint().filter(|_| is_new);
        let (Some(checkpoint), Some(out), Some(path)) = (checkpoint, &mut out, &path) else {
            continue;
        };
        let claimed = out.claim(CHECKPOINT);
        match claimed.and_then(|()| Ok(checkpoint.write(path)?)) {
            Ok(()) => files = vec![path.clone()],
            Err(error) => end = Err(error),
        }
    }
    if !args.no_spread && end.is_ok() {
        end = run.compare(scene, &mut |event| progress.show(event)).map_err(Failure::from);
    }
    progress.clear();
    Ok(Ran { outcome: run.finish(), frames, files, end })
}

/// Prints on standard error the command that continues an interrupted run from its last step.
fn say_how_to_go_on(args: &SolveArgs, outcome: &Outcome) {
    let Some(history) = &outcome.history else { return };
    let (solved, steps) = (history.records.len(), history.steps);
    match &args.out {
        _ if solved == 0 => {
            eprintln!("interrupted in the first of {steps} steps: nothing to continue from");
        }
        None => eprintln!(
            "interrupted after step {solved} of {steps}; with --out a run can continue from there"
        ),
        Some(out) => {
            let [scene, out] = [&args.scene, out].map(|path| quoted(path));
            let route =
                args.route.map_or(String::new(), |route| format!(" --route {}", route.0.name()));
            let report = args
                .report
                .as_ref()
                .map_or(String::new(), |path| format!(" --report {}", quoted(path)));
            let json = if args.json { " --json" } else { "" };
            eprintln!(
                "interrupted after step {solved} of {steps}; this goes on from there:\n  \
                 masonry solve {scene} --out {out} --resume{route}{report}{json}"
            );
        }
    }
}

/// Returns a path, quoted for shells.
fn quoted(path: &Path) -> String {
    let text = path.display().to_string();
    let is_plain = |c: char| c.is_alphanumeric() || "/._-+:,@".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        text
    } else {
        format!("'{}'", text.replace('\'', "'\\''"))
    }
}
