//! `masonry limit`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::end::{Failure, NOT_SOLVED, SOLVED, listing, names, print};
use crate::analysis::limit::{Answer, least_thickness, limit, ranges};
use crate::report::limit as output;
use crate::scene::Scene;

/// The law of friction that a limit load is asked of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Law {
    /// Joints that slide open by mu times the slip: a linear program, and an upper bound for Coulomb's friction.
    Associative,
}

#[derive(Debug, Args)]
pub(super) struct LimitArgs {
    /// The scene file (TOML).
    scene: PathBuf,
    /// The law of friction.
    #[arg(long, value_enum, default_value_t = Law::Associative)]
    law: Law,
    /// The load or group of loads that grows, instead of that of the scene.
    #[arg(long, conflicts_with = "range")]
    group: Option<String>,
    /// Ask for the least and the largest reactions under the loads of the scene instead.
    #[arg(long)]
    range: bool,
    /// Ask for the least thickness of an arch under the loads of the scene instead.
    #[arg(long, value_name = "ARCH", conflicts_with_all = ["range", "group"])]
    thickness: Option<String>,
    /// The directory to write pictures into, if any; created when missing.
    #[arg(long, conflicts_with = "range")]
    out: Option<PathBuf>,
    /// Print one JSON object instead of the report.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &LimitArgs) -> Result<u8, Failure> {
    let mut scene = Scene::read(&args.scene)?;
    if args.range {
        return range(&scene, args.json);
    }
    if let Some(arch) = &args.thickness {
        return thickness(&scene, arch, args);
    }
    if let Some(group) = &args.group {
        scene = scene.limit_group(group);
    }
    let Law::Associative = args.law;
    let limit = limit(&scene)?;
    let written = match &args.out {
        Some(out) => output::write(&limit, out),
        None => Ok(Vec::new()),
    };
    // What was computed is printed even when a file could not be written.
    let files = written.as_deref().unwrap_or_default();
    if args.json {
        print(&output::json(&limit, &names(files))?)?;
    } else {
        print(&format!("{}\n{}", output::table(&limit), listing(files)))?;
    }
    written?;
    let solved = matches!(limit.associative.answer, Answer::Fails | Answer::Unlimited);
    Ok(if solved { SOLVED } else { NOT_SOLVED })
}

fn range(scene: &Scene, json: bool) -> Result<u8, Failure> {
    let range = ranges(scene)?;
    let text = if json { output::range_json(&range)? } else { output::range_table(&range) };
    print(&text)?;
    Ok(if range.supports.is_some() { SOLVED } else { NOT_SOLVED })
}

fn thickness(scene: &Scene, arch: &str, args: &LimitArgs) -> Result<u8, Failure> {
    let found = least_thickness(scene, arch)?;
    let written = match &args.out {
        Some(out) => output::write_thickness(&found, out),
        None => Ok(Vec::new()),
    };
    let files = written.as_deref().unwrap_or_default();
    if args.json {
        print(&output::thickness_json(&found, &names(files))?)?;
    } else {
        print(&format!("{}\n{}", output::thickness_table(&found), listing(files)))?;
    }
    written?;
    Ok(if found.proved { SOLVED } else { NOT_SOLVED })
}
