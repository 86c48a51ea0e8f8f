//! The command-line program `masonry`.
//!
//! `--json` prints one JSON object on standard output and nothing else there; progress and errors go to standard error.
//! The exit code is 0 if solved, 1 if not solved, 2 for bad input.

mod completions;
mod end;
mod import;
mod interrupt;
mod limit;
mod live;
mod new;
mod out_dir;
mod page;
mod progress;
mod route;
mod solve;
mod study;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, CommandFactory, Parser, Subcommand};

use crate::end::{
    BAD_INPUT, Failure, MARK, SOLVED, is_same, keep_foreign, keep_scene, print, without_controls,
};
use crate::route::RouteValue;
use masonry::files::write_atomically;
use masonry::model::Model;
use masonry::plan::Plan;
use masonry::scene::Scene;
use masonry_import::read_scene;
use masonry_report::{dxf, svg, table};

/// Calculates how a wall or an arch of blocks carries its load.
#[derive(Debug, Parser)]
#[command(name = "masonry", version, about, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Show what a scene needs: effects, unknowns, memory, and the method.
    Plan(PlanArgs),
    /// Solve a scene: print the report, and write pictures, tables and a mesh.
    Solve(solve::SolveArgs),
    /// Find the factor of a load at which the structure fails.
    Limit(limit::LimitArgs),
    /// Measure error and cost of routes, tolerances and meshes.
    Study(study::StudyArgs),
    /// Open a page that solves a scene while it is changed.
    Live(live::LiveArgs),
    /// Make a scene from a drawing: DXF, SVG, OBJ, COMPAS JSON.
    Import(import::ImportArgs),
    /// Print or write a commented scene to begin with.
    New(new::NewArgs),
    /// Print the JSON schema of scene files, for editors.
    Schema,
    /// Draw a scene: blocks, supports, loads and contact points.
    Draw(DrawArgs),
    /// Print a script for the completion of commands and options in a shell.
    Completions(completions::CompletionsArgs),
}

#[derive(Debug, Args)]
struct PlanArgs {
    /// The scene file (TOML).
    scene: PathBuf,
    /// The route to the solution, instead of that of the scene.
    #[arg(long)]
    route: Option<RouteValue>,
    /// Print one JSON object instead of the report.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct DrawArgs {
    /// The scene file (TOML).
    scene: PathBuf,
    /// The picture; by default next to the scene, with the extension `.svg`.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Also solve the scene, and write blocks, forces, line of thrust and mechanism as a drawing (DXF); the picture is
    /// written only with `--out`.
    #[arg(long, value_name = "FILE")]
    dxf: Option<PathBuf>,
}

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Plan(args) => plan(&args),
        Command::Solve(args) => solve::run(&args),
        Command::Limit(args) => limit::run(&args),
        Command::Study(args) => study::run(&args),
        Command::Live(args) => live::run(&args),
        Command::Import(args) => import::run(&args),
        Command::New(args) => new::run(&args),
        Command::Schema => print(Scene::schema()).map(|()| SOLVED),
        Command::Draw(args) => draw(&args),
        Command::Completions(args) => completions::run(&args, Cli::command()),
    };
    ExitCode::from(result.unwrap_or_else(|failure| {
        eprintln!("error: {}", without_controls(&failure.to_string()));
        BAD_INPUT
    }))
}

fn plan(args: &PlanArgs) -> Result<u8, Failure> {
    let mut scene = read_scene(&args.scene)?;
    if let Some(route) = args.route {
        scene = scene.route(route.0);
    }
    let model = Model::from_scene(&scene)?;
    for warning in model.unusual() {
        eprintln!("warning: {}", without_controls(&warning));
    }
    let plan = Plan::of(&scene, &model);
    if args.json {
        print(&(serde_json::to_string_pretty(&plan)? + "\n"))?;
    } else {
        print(&format!("{}\n\n{}\n", scene.title, table::plan(&plan)))?;
    }
    Ok(SOLVED)
}

fn draw(args: &DrawArgs) -> Result<u8, Failure> {
    let scene = read_scene(&args.scene)?;
    let beside = || args.scene.with_extension("svg");
    let picture = args.out.clone().or_else(|| args.dxf.is_none().then(beside));
    for (out, option) in [(&picture, "--out"), (&args.dxf, "--dxf")] {
        if let Some(out) = out {
            keep_scene(&scene, out, option)?;
            keep_foreign(out, option)?;
        }
    }
    if let (Some(out), Some(dxf)) = (&picture, &args.dxf)
        && (out == dxf || is_same(out, dxf))
    {
        return Err(format!("{} is both --out and --dxf: choose two files", out.display()).into());
    }
    let mut files = Vec::new();
    if let Some(out) = picture {
        let picture = svg::scene(&scene.title, &Model::from_scene(&scene)?);
        files.push((out, format!("{picture}<!-- {MARK} -->\n")));
    }
    if let Some(out) = args.dxf.clone() {
        // The code 999 begins a comment in DXF.
        files.push((out, format!("999\n{MARK}\n{}", dxf::drawing(&masonry::solve(&scene)?))));
    }
    for (out, text) in files {
        write_atomically(&out, text.as_bytes())
            .map_err(|error| format!("cannot write {}: {error}", out.display()))?;
        print(&format!("{}\n", out.display()))?;
    }
    Ok(SOLVED)
}
