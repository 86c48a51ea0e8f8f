//! The command-line program `masonry`.
//!
//! `--json` prints one JSON object on standard output and nothing else there; progress and errors
//! go to standard error. The exit code is 0 when solved, 1 when not solved, 2 for bad input.

mod end;
mod limit;
mod new;
mod page;
mod progress;
mod study;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};

use crate::analysis::checkpoint::{Checkpoint, CheckpointError};
use crate::analysis::outcome::{Frame, Outcome};
use crate::analysis::solve::Run;
use crate::model::Model;
use crate::plan::Plan;
use crate::report::svg::ReferenceLines;
use crate::report::{self, Options, json, svg, table};
use crate::scene::{Route, Scene};
use end::{BAD_INPUT, Failure, NOT_SOLVED, SOLVED, listing, names, print};
use progress::Progress;

/// How a wall or an arch of blocks carries its load.
#[derive(Debug, Parser)]
#[command(name = "masonry", version, about, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Say what a scene calls for, before anything is assembled.
    Plan(PlanArgs),
    /// Solve a scene and write pictures, tables and a mesh.
    Solve(SolveArgs),
    /// Say at which factor of a group of loads the structure fails.
    Limit(limit::LimitArgs),
    /// Say what accuracy costs: routes, tolerances and meshes against the most accurate answer.
    Study(study::StudyArgs),
    /// Print or write a commented scene to begin with.
    New(new::NewArgs),
    /// Print the JSON schema of scene files, by which editors complete and check them.
    Schema,
    /// Draw a scene: blocks, supports, loads and contact points.
    Draw(DrawArgs),
}

#[derive(Debug, Args)]
struct PlanArgs {
    /// The scene file (TOML).
    scene: PathBuf,
    /// The route to the solution, instead of that of the scene.
    #[arg(long)]
    route: Option<Route>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct SolveArgs {
    /// The scene file (TOML).
    scene: PathBuf,
    /// The directory to write into; created when missing.
    #[arg(long)]
    out: PathBuf,
    /// The route to the solution, instead of that of the scene.
    #[arg(long)]
    route: Option<Route>,
    /// Go on from `checkpoint.json` in that directory, which every step of a load history writes.
    #[arg(long)]
    resume: bool,
    /// Also write the report as one page of HTML, with pictures to choose from; opens without a network.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Print one JSON object instead of the report.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct DrawArgs {
    /// The scene file (TOML).
    scene: PathBuf,
    /// The picture to write; by default the scene's name with the ending `.svg`.
    #[arg(long)]
    out: Option<PathBuf>,
}

/// Runs the program on the arguments of the process.
pub fn run() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Plan(args) => plan(&args),
        Command::Solve(args) => solve(&args),
        Command::Limit(args) => limit::run(&args),
        Command::Study(args) => study::run(&args),
        Command::New(args) => new::run(&args),
        Command::Schema => print(&Scene::schema()).map(|()| SOLVED),
        Command::Draw(args) => draw(&args),
    };
    ExitCode::from(result.unwrap_or_else(|failure| {
        eprintln!("error: {failure}");
        BAD_INPUT
    }))
}

fn plan(args: &PlanArgs) -> Result<u8, Failure> {
    let scene = on_route(Scene::read(&args.scene)?, args.route);
    let model = Model::from_scene(&scene)?;
    let plan = Plan::of(&scene, &model);
    if args.json {
        print(&(serde_json::to_string_pretty(&plan)? + "\n"))?;
    } else {
        print(&format!("{}\n\n{}\n", scene.title, table::plan(&plan)))?;
    }
    Ok(SOLVED)
}

fn solve(args: &SolveArgs) -> Result<u8, Failure> {
    let scene = on_route(Scene::read(&args.scene)?, args.route);
    let Ran { outcome, frames, mut files, end } = run_steps(&scene, args)?;
    let options = Options { reference: ReferenceLines::of(&scene), ..Options::default() };
    let written = report::write_all(&outcome, &args.out, &options);
    // What was computed is printed even when a file could not be written.
    files.extend_from_slice(written.as_deref().unwrap_or_default());
    let page = || report::page::solved(&outcome, &frames, options.reference.as_ref());
    let page = page::write(args.report.as_deref(), page, &mut files);
    if args.json {
        print(&json::result(&outcome, &names(&files))?)?;
    } else {
        print(&format!("{}\n{}", table::report(&outcome), listing(&files)))?;
    }
    written?;
    page?;
    end?;
    let solved = outcome.solve.status == lcp::Status::Solved;
    Ok(if solved { SOLVED } else { NOT_SOLVED })
}

/// What became of all steps.
struct Ran {
    outcome: Outcome,
    /// The steps that a page has pictures of, if one is asked for.
    frames: Vec<Frame>,
    /// The checkpoint, if one was written.
    files: Vec<PathBuf>,
    /// What went wrong after a step that was solved.
    end: Result<(), Failure>,
}

fn run_steps(scene: &Scene, args: &SolveArgs) -> Result<Ran, Failure> {
    let path = args.out.join("checkpoint.json");
    let mut progress = Progress::new();
    let mut run = Run::new(scene, &mut |event| progress.show(event))?;
    if args.resume {
        if !run.has_history() {
            return Err(CheckpointError::OneStep.into());
        }
        run = run.resume(&Checkpoint::read(&path)?)?;
    }
    let (mut frames, mut files, mut end) = (Vec::new(), Vec::new(), Ok(()));
    loop {
        match run.advance(&mut |event| progress.show(event)) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) if run.solved_steps() == 0 => return Err(error.into()),
            Err(error) => {
                end = Err(error.into());
                break;
            }
        }
        let steps = run.steps();
        let is_shown = |it: &Frame| report::page::is_framed(it.position, steps);
        frames.extend(args.report.as_ref().and_then(|_| run.frame()).filter(is_shown));
        let Some(checkpoint) = run.checkpoint() else { continue };
        let written = std::fs::create_dir_all(&args.out)
            .map_err(|source| CheckpointError::Write { path: path.clone(), source })
            .and_then(|()| checkpoint.write(&path));
        match written {
            Ok(()) => files = vec![path.clone()],
            Err(error) => end = Err(error.into()),
        }
    }
    progress.clear();
    Ok(Ran { outcome: run.finish(), frames, files, end })
}

/// The scene with another route, if one is asked for; whether its keys fit is checked with the scene.
fn on_route(scene: Scene, route: Option<Route>) -> Scene {
    match route {
        Some(route) => scene.route(route),
        None => scene,
    }
}

fn draw(args: &DrawArgs) -> Result<u8, Failure> {
    let scene = Scene::read(&args.scene)?;
    let model = Model::from_scene(&scene)?;
    let out = args.out.clone().unwrap_or_else(|| args.scene.with_extension("svg"));
    std::fs::write(&out, svg::scene(&scene.title, &model))
        .map_err(|error| format!("cannot write {}: {error}", out.display()))?;
    print(&format!("{}\n", out.display()))?;
    Ok(SOLVED)
}
