//! `masonry study`: error and cost of routes, tolerances and meshes.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use crate::end::{Failure, NOT_SOLVED, SOLVED, listing, names, print};
use crate::interrupt;
use crate::out_dir::OutDir;
use crate::progress::Progress;
use crate::route::OneRoute;
use masonry::analysis::study::{Settings, machine, study};
use masonry_import::read_scene;
use masonry_report::study as output;

#[derive(Debug, Args)]
pub(super) struct StudyArgs {
    /// The scene file (TOML).
    scene: PathBuf,
    /// Directory for tables and pictures; created if it does not exist.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Routes, separated by commas.
    #[arg(long, value_delimiter = ',')]
    routes: Option<Vec<OneRoute>>,
    /// Tolerances for the residuals, separated by commas.
    #[arg(long, value_delimiter = ',')]
    tolerances: Option<Vec<f64>>,
    /// Factors of the numbers of elements in each direction, separated by commas.
    #[arg(long, value_delimiter = ',')]
    meshes: Option<Vec<u32>>,
    /// Time limit of one solve, in seconds.
    #[arg(long, default_value_t = 20.0)]
    time_limit: f64,
    /// Print one JSON object instead of the report.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &StudyArgs) -> Result<u8, Failure> {
    let scene = read_scene(&args.scene)?;
    let settings = settings(args)?;
    interrupt::listen();
    let out = args.out.as_deref().map(|out| OutDir::open(out, "study", None)).transpose()?;
    let progress = Progress::new();
    let mut shown = None;
    let study = study(&scene, &settings, &mut |at| {
        // Progress is shown only once for each solve, since more output would disturb the measurement of times.
        if shown != Some(at) {
            progress.say(format!("mesh {}, {} to {:e}", at.mesh, at.route.name(), at.tolerance));
            shown = Some(at);
        }
        interrupt::asked()
    });
    progress.clear();
    let study = study?;
    let written = match &out {
        Some(out) => output::write(&study, out.path()),
        None => Ok(Vec::new()),
    };
    // The results are printed even if some file could not be written.
    let files = written.as_deref().unwrap_or_default();
    if args.json {
        let names = names(files);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        print(&output::json(&study, &names)?)?;
    } else {
        print(&format!("{}\n{}", output::table(&study), listing(files)))?;
    }
    out.map_or(Ok(()), |out| out.finish(files, study.is_interrupted))?;
    written?;
    Ok(if study.is_solved() && !study.is_interrupted { SOLVED } else { NOT_SOLVED })
}

fn settings(args: &StudyArgs) -> Result<Settings, Failure> {
    let default = Settings::default();
    let seconds = args.time_limit;
    let time_limit = Duration::try_from_secs_f64(seconds)
        .map_err(|error| format!("--time-limit {seconds}: {error}; give seconds"))?;
    Ok(Settings {
        routes: args
            .routes
            .as_ref()
            .map_or(default.routes, |routes| routes.iter().map(|it| it.0).collect()),
        tolerances: args.tolerances.clone().unwrap_or(default.tolerances),
        meshes: args.meshes.clone().unwrap_or(default.meshes),
        mesh_names: default.mesh_names,
        time_limit,
        repeats: default.repeats,
        machine: Some(machine()),
    })
}
