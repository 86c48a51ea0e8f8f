//! `masonry limit`: the load factor at which a structure fails.

use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::end::{Failure, NOT_SOLVED, SOLVED, listing, names, print};
use crate::interrupt;
use crate::out_dir::OutDir;
use crate::page;
use crate::progress::Progress;
use masonry::analysis::limit::{
    Bracket, Directions, Laws, Limit, growing, least_thickness_observed, limit_observed,
    ranges_observed, train_observed,
};
use masonry::scene::{Combined, OPPOSITE, Scene};
use masonry_import::read_scene;
use masonry_report::cases::Cases;
use masonry_report::{self as report, limit as output};

/// The law of friction of a limit load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Law {
    /// Joints that slide open by mu times the slip: a linear program, and an upper bound for Coulomb's friction.
    Associative,
    /// Coulomb's friction: the factor grows step by step until the blocks no longer come to rest.
    Path,
    /// Both laws, one after the other.
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
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of the command")]
pub(super) struct LimitArgs {
    /// The scene file (TOML).
    scene: PathBuf,
    /// The law of friction.
    #[arg(long, value_enum, default_value_t = Law::Both)]
    law: Law,
    /// The load or group of loads that grows, instead of that of the scene.
    #[arg(long, conflicts_with = "range")]
    group: Option<String>,
    /// Also take the opposite direction of the load, since an earthquake comes from both sides; files are of the one
    /// that governs.
    #[arg(long, conflicts_with_all = ["range", "thickness"])]
    both: bool,
    /// Find the least and the largest reactions under the loads of the scene instead.
    #[arg(long)]
    range: bool,
    /// Find the least thickness of an arch under the loads of the scene instead.
    #[arg(long, value_name = "ARCH", conflicts_with_all = ["range", "group"])]
    thickness: Option<String>,
    /// Find the limit load of the train of the scene at all of its positions instead.
    #[arg(long, conflicts_with_all = ["range", "thickness", "group", "both"])]
    train: bool,
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
    let mut scene = read_scene(&args.scene)?;
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
    page::check(args.report.as_deref(), &scene, args.out.as_deref())?;
    let Search { found, failed } = if args.train {
        crossing(&scene, args)?
    } else if scene.combinations.is_empty() {
        search(&scene, args)?
    } else {
        combined(&scene, args)?
    };
    let limit = found.limit();
    let written = match &out {
        Some(out) => output::write(limit, found.cases(), out.path()),
        None => Ok(Vec::new()),
    };
    // The results are printed even if some file could not be written.
    let in_out = written.as_deref().unwrap_or_default();
    let mut files = in_out.to_vec();
    let page = || report::page::limit(limit, found.cases());
    let page = page::write(args.report.as_deref(), page, &mut files);
    let names = names(&files);
    let text = match (&found, args.json) {
        (Found::Given(limit), true) => output::json(limit, &names)?,
        (Found::Both(both), true) => output::json_both(both, &names)?,
        (Found::Combined(All { lines, .. }) | Found::Crossing(_, lines), true) => {
            lines.json("limit", &output::json(limit, &names)?)?
        }
        (Found::Given(limit), false) => output::table(limit),
        (Found::Both(both), false) => output::table_both(both),
        (Found::Combined(All { lines, .. }) | Found::Crossing(_, lines), false) => {
            lines.head() + &output::table(limit)
        }
    };
    let text = if args.json { text } else { format!("{text}\n{}", listing(&files)) };
    print(&text)?;
    out.map_or(Ok(()), |out| out.finish(in_out, found.is_interrupted()))?;
    written?;
    page?;
    if let Some(error) = failed {
        return Err(error);
    }
    Ok(if found.is_solved() { SOLVED } else { NOT_SOLVED })
}

/// Computes the limit load of a scene, in one direction or in both.
fn search(scene: &Scene, args: &LimitArgs) -> Result<Search, Failure> {
    let progress = Progress::new();
    let mut given = limit_observed(scene, args.law.into(), &mut |at| follow(&progress, at))?;
    progress.clear();
    let group = given.group.clone();
    let mut failed = None;
    let is_one_way = scene.reversed(&group) == *scene;
    let found = if args.both && !is_one_way {
        let laws = args.law.into();
        let opposite = Directions::opposite(&given, scene, laws, &mut |at| follow(&progress, at));
        progress.clear();
        match opposite {
            Ok(opposite) => Found::Both(Box::new(Directions::of(given, opposite))),
            // The bounds of the given direction are reported even if the other direction fails.
            Err(error) => {
                failed = Some(format!("the opposite direction has no answer: {error}").into());
                Found::Given(Box::new(given))
            }
        }
    } else {
        if args.both {
            let words = "is a weight and acts in one direction: `--both` changes nothing.";
            given.warnings.push(format!("\"{group}\" {words}"));
        } else if scene.is_earthquake(&group) {
            given.warnings.push(format!(
                "\"{group}\" acts in one direction: `--both` also takes the opposite one."
            ));
        }
        Found::Given(Box::new(given))
    };
    Ok(Search { found, failed })
}

/// Computes the limit loads of all combinations in which the group acts. Earthquakes act in both directions in any
/// case, other loads only with `--both`.
fn combined(scene: &Scene, args: &LimitArgs) -> Result<Search, Failure> {
    let group = growing(scene)?;
    let mut scenes = scene.combined();
    scenes.retain(|it| it.of.acts(&group));
    let is_one_way = scene.reversed(&group) == *scene;
    if args.both && !is_one_way && !scene.is_earthquake(&group) {
        let both = |it: Combined<Scene>| {
            let (name, of) = (format!("{}{OPPOSITE}", it.name), it.of.reversed(&group));
            [it, Combined { name, of }]
        };
        scenes = scenes.into_iter().flat_map(both).collect();
    }
    let progress = Progress::new();
    let (mut list, mut failed) = (Vec::new(), None);
    for Combined { name, of } in scenes {
        let scene = of.limit_group(&group);
        match limit_observed(&scene, args.law.into(), &mut |at| follow(&progress, at)) {
            Ok(of) => list.push(Combined { name, of }),
            Err(error) => {
                failed = Some(format!("combination \"{name}\" has no answer: {error}").into());
            }
        }
        progress.clear();
        if list.last().is_some_and(|it| it.of.is_interrupted) {
            break;
        }
    }
    match (Cases::of_limits(&mut list), failed) {
        (Some(lines), failed) => Ok(Search { found: Found::Combined(All { list, lines }), failed }),
        (None, Some(failed)) => Err(failed),
        (None, None) => Err(format!(
            "\"{group}\" acts in no combination: name it in one, or choose another --group"
        )
        .into()),
    }
}

/// Computes the limit load of a train at the governing position.
fn crossing(scene: &Scene, args: &LimitArgs) -> Result<Search, Failure> {
    let progress = Progress::new();
    let crossing = train_observed(scene, args.law.into(), &mut |at| follow(&progress, at))?;
    progress.clear();
    let lines = Cases::of_train(&crossing);
    Ok(Search { found: Found::Crossing(Box::new(crossing.limit), lines), failed: None })
}

/// The result of a search, and the error of a part of the search that failed.
struct Search {
    found: Found,
    failed: Option<Failure>,
}

/// The limit load of a scene, of both directions, of all combinations, or of a train.
enum Found {
    Given(Box<Limit>),
    Both(Box<Directions>),
    Combined(All),
    /// The limit load at the governing position of a train, and the table of all positions.
    Crossing(Box<Limit>, Cases),
}

/// The limit loads of all combinations, and their table.
struct All {
    list: Vec<Combined<Limit>>,
    lines: Cases,
}

impl Found {
    /// Returns the limit load that is shown in pictures.
    fn limit(&self) -> &Limit {
        match self {
            Self::Given(limit) | Self::Crossing(limit, _) => limit,
            Self::Both(both) => both.governing(),
            Self::Combined(all) => &all.list[all.lines.governs()].of,
        }
    }

    fn cases(&self) -> Option<&Cases> {
        match self {
            Self::Given(_) | Self::Both(_) => None,
            Self::Combined(All { lines, .. }) | Self::Crossing(_, lines) => Some(lines),
        }
    }

    fn all(&self, is_so: impl Fn(&Limit) -> bool) -> bool {
        match self {
            Self::Given(limit) | Self::Crossing(limit, _) => is_so(limit),
            Self::Both(both) => is_so(&both.given) && is_so(&both.opposite),
            Self::Combined(all) => all.list.iter().all(|it| is_so(&it.of)),
        }
    }

    fn is_solved(&self) -> bool {
        self.all(Limit::is_solved)
    }

    fn is_interrupted(&self) -> bool {
        !self.all(|limit| !limit.is_interrupted)
    }
}

/// Shows the bounds that are known so far; ends the search after Ctrl-C.
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
    interrupt::listen();
    let range = ranges_observed(scene, &mut |_| interrupt::asked())?;
    let text = if json { output::range_json(&range)? } else { output::range_table(&range) };
    print(&text)?;
    let is_solved = range.supports.is_some() && !range.is_interrupted;
    Ok(if is_solved { SOLVED } else { NOT_SOLVED })
}

fn thickness(scene: &Scene, arch: &str, args: &LimitArgs) -> Result<u8, Failure> {
    interrupt::listen();
    let out = out_dir(args)?;
    page::check(args.report.as_deref(), scene, args.out.as_deref())?;
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
