//! `masonry limit`.

use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::end::{Failure, NOT_SOLVED, SOLVED, listing, names, print};
use crate::interrupt;
use crate::out_dir::OutDir;
use crate::page;
use crate::progress::Progress;
use masonry::analysis::limit::{
    Answer, Associative, Bracket, Laws, Limit, Path, least_thickness_observed, limit_observed,
    ranges,
};
use masonry::report::{self, limit as output};
use masonry::scene::Scene;

/// The law of friction of a limit load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Law {
    /// Joints that slide open by mu times the slip: a linear program, and an upper bound for Coulomb's friction.
    Associative,
    /// Coulomb's friction: the factor grows step by step until the blocks no longer come to rest.
    Path,
    /// Both, one after the other.
    Both,
}

impl From<Law> for Laws {
    fn from(law: Law) -> Self {
        match law {
            Law::Associative => Self::Associative,
            Law::Path => Self::Path,
            Law::Both => Self::Both,
        }
    }
}

#[derive(Debug, Args)]
pub(super) struct LimitArgs {
    /// The scene file (TOML).
    scene: PathBuf,
    /// The law of friction.
    #[arg(long, value_enum, default_value_t = Law::Both)]
    law: Law,
    /// The load or group of loads that grows, in place of that of the scene.
    #[arg(long, conflicts_with = "range")]
    group: Option<String>,
    /// Also take the opposite direction of the load, from which an earthquake comes as well; files are of the one that governs.
    #[arg(long, conflicts_with_all = ["range", "thickness"])]
    both: bool,
    /// Find the least and the largest reactions under the loads of the scene instead.
    #[arg(long)]
    range: bool,
    /// Find the least thickness of an arch under the loads of the scene instead.
    #[arg(long, value_name = "ARCH", conflicts_with_all = ["range", "group"])]
    thickness: Option<String>,
    /// Directory for the pictures; created if it does not exist.
    #[arg(long, conflicts_with = "range")]
    out: Option<PathBuf>,
    /// Also write the report with its pictures as one page of HTML.
    #[arg(long, value_name = "FILE", conflicts_with = "range")]
    report: Option<PathBuf>,
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
    interrupt::listen();
    let out = out_dir(args)?;
    page::check(args.report.as_deref(), &args.scene)?;
    let progress = Progress::new();
    let found = |scene: &Scene| {
        let limit = limit_observed(scene, args.law.into(), &mut |at| follow(&progress, at));
        progress.clear();
        limit
    };
    let given = found(&scene)?;
    let reversed = args.both.then(|| found(&scene.reversed(&given.group))).transpose()?;
    let other_governs = reversed.as_ref().is_some_and(|it| carried(it) < carried(&given));
    let (mut limit, other) = match reversed {
        Some(reversed) if other_governs => (reversed, Some(given)),
        reversed => (given, reversed),
    };
    if other.is_none() && scene.is_earthquake(&limit.group) {
        limit.warnings.push(format!(
            "\"{}\" acts in one direction: `--both` also takes the opposite one.",
            limit.group
        ));
    }
    let written = match &out {
        Some(out) => output::write(&limit, out.path()),
        None => Ok(Vec::new()),
    };
    // What was computed is printed even when a file could not be written.
    let in_out = written.as_deref().unwrap_or_default();
    let mut files = in_out.to_vec();
    let page = page::write(args.report.as_deref(), || report::page::limit(&limit), &mut files);
    let text = match (&other, args.json) {
        (None, true) => output::json(&limit, &names(&files))?,
        (Some(other), true) => output::json_both(&limit, other, other_governs, &names(&files))?,
        (None, false) => format!("{}\n{}", output::table(&limit), listing(&files)),
        (Some(other), false) => {
            let both = in_both(&limit, other, other_governs);
            format!("{both}{}\n{}", output::table(&limit), listing(&files))
        }
    };
    print(&text)?;
    out.map_or(Ok(()), |out| out.finish(in_out, limit.is_interrupted))?;
    written?;
    page?;
    let is_solved = [&limit].into_iter().chain(&other).all(is_solved);
    Ok(if is_solved { SOLVED } else { NOT_SOLVED })
}

/// Whether the factor of every law is known.
fn is_solved(limit: &Limit) -> bool {
    let is_known = |it: &Associative| matches!(it.answer, Answer::Fails | Answer::Unlimited);
    let by_path = |path: &Path| path.decided && path.load_factor.is_some();
    limit.associative.as_ref().is_none_or(is_known)
        && limit.path.as_ref().is_none_or(by_path)
        && !limit.is_interrupted
}

/// The factor that is carried: by Coulomb's friction, if it was asked for.
fn carried(limit: &Limit) -> f64 {
    let by_path = limit.path.as_ref().map(|it| it.load_factor);
    let by_flow = limit.associative.as_ref().map(|it| match it.answer {
        Answer::Unlimited => Some(f64::INFINITY),
        _ => it.load_factor,
    });
    by_path.or(by_flow).flatten().unwrap_or(0.0)
}

/// What is found in both directions, before the report of the one that governs.
fn in_both(governing: &Limit, other: &Limit, is_reversed: bool) -> String {
    let (given, reversed) = if is_reversed { (other, governing) } else { (governing, other) };
    let which = if is_reversed { "The opposite direction" } else { "The given direction" };
    format!(
        "Given direction: {}\nOpposite direction: {}\n{which} governs:\n\n",
        given.sentence, reversed.sentence
    )
}

/// Shows what is known; after Ctrl-C asks the search to end.
fn follow(progress: &Progress, at: Bracket) -> ControlFlow<()> {
    let known = [("stands at", at.stands), ("falls at", at.falls)];
    let known: Vec<String> = known
        .into_iter()
        .filter_map(|(what, value)| Some(format!("{what} {:.5}", value?)))
        .collect();
    progress.say(known.join(", "));
    interrupt::asked()
}

fn out_dir(args: &LimitArgs) -> Result<Option<OutDir>, Failure> {
    args.out.as_deref().map(|out| OutDir::open(out, "limit", None)).transpose()
}

fn range(scene: &Scene, json: bool) -> Result<u8, Failure> {
    let range = ranges(scene)?;
    let text = if json { output::range_json(&range)? } else { output::range_table(&range) };
    print(&text)?;
    Ok(if range.supports.is_some() { SOLVED } else { NOT_SOLVED })
}

fn thickness(scene: &Scene, arch: &str, args: &LimitArgs) -> Result<u8, Failure> {
    interrupt::listen();
    let out = out_dir(args)?;
    page::check(args.report.as_deref(), &args.scene)?;
    let progress = Progress::new();
    let found = least_thickness_observed(scene, arch, &mut |at| follow(&progress, at));
    progress.clear();
    let found = found?;
    let written = match &out {
        Some(out) => output::write_thickness(&found, out.path()),
        None => Ok(Vec::new()),
    };
    let in_out = written.as_deref().unwrap_or_default();
    let mut files = in_out.to_vec();
    let page = page::write(args.report.as_deref(), || report::page::thickness(&found), &mut files);
    if args.json {
        print(&output::thickness_json(&found, &names(&files))?)?;
    } else {
        print(&format!("{}\n{}", output::thickness_table(&found), listing(&files)))?;
    }
    out.map_or(Ok(()), |out| out.finish(in_out, found.is_interrupted))?;
    written?;
    page?;
    Ok(if found.proved { SOLVED } else { NOT_SOLVED })
}
