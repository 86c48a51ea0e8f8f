//! The sweeps as a page, `docs/stability.md`, with the tables of `docs/data/stability.md`; and a picture for every theme.

use std::fmt::{self, Write};
use std::path::Path;

use lcp::Status;
use masonry::scene::Route;
use masonry_report::study::style;
use masonry_report::svg::diagram::{Diagram, Look, Series, picture};

use super::common::routes::ROUTES;
use super::problems::{self, Method};
use super::sweep::{Expected, Point, Reached, Sweep};

/// Sweeps that are drawn in one picture.
pub(crate) struct Theme {
    /// The name of its picture.
    pub(crate) file: &'static str,
    pub(crate) title: &'static str,
    pub(crate) sweeps: Vec<(Sweep, Vec<Point>)>,
}

const INTRODUCTION: &str = "
Every [hard case](hard_cases.md) has a parameter. A sweep varies it from harmless to hopeless, and every route solves every value. Every solution is checked
independently of the methods. The tolerance is 1e-10, for `alm` 1e-8.

![Errors of four hard cases over their parameters](pictures/stability.svg)

*Four of the cases. Full markers are solutions, drawn at their worst error. Hollow markers are failures, drawn at the residual that the route reports. Dots are
backward errors. Grey lines are the largest errors promised for known values; for `alm` they are a hundred times as large.*
";

const MEANINGS: &str = "
## What the words mean

* **Error**: the worst of the [checks](theory/solutions.md#10-residuals-and-balances): balance, friction cone, gaps, sliding, nodal forces and energy. Forces are relative
  to those on the same block. Rounding errors of larger forces on its neighbours count as 1e-9 at most.
* **Backward error**: the relative change of loads, stiffness and contact forces with which equilibrium alone holds exactly. Gaps and friction are not included.
  If it is near rounding and all routes have the same larger error, the scene itself is sensitive.
* **Promised**: the errors of an answer called solved are at most 1e-9, for `alm` 1e-8. A known value of a solution may be off by a hundred times the tolerance.
  If forces on blocks differ by a factor of more than ten, it may be off by more, in proportion, but by at most 1e-3, since the forces on a block carry its
  loads to a thousandth. In two scenes this bound is larger: for slender bricks by a factor of 1e-8 times the square of the ratio of their sides, for wedges by
  one over the sine of the angle.
* **Exists**: a solution is known to exist, or it is known that none exists (the load is above its limit), or neither is known. A load that is above its limit
  by at most twenty times the tolerance cannot be distinguished from one below it, and may be called solved. (Twenty times, since the load is only one of the
  terms of the equations.)

## Further numbers and pictures

[Tables](data/stability.md) have the number of solved values and the worst error of every case, and the same for problems of `lcp`. `cargo bench --bench
stability` draws all cases into `target/stability/`, and prints every value. It fails if a solution is worse than promised, or if a scene is called solved that
cannot stand. With `-- --write` it also writes this page. `cargo test --test hard_cases` tests some of the values.
";

const TABLES: &str = "\
# Stability: all cases

The tables of [the page on stability](../stability.md), written by `cargo bench --bench stability -- --write`. A cell has the number of solved values, and their
worst error. *Expected* is what is known: a solution exists (*an answer*), none exists (*none*), this is unknown (*open*), or it differs from value to value.
";

/// The cases on the page: bad elements, stiff and soft mortar, the limit of a stack, a wall that grows.
const SHOWN: [&str; 4] = [
    "slender bricks",
    "mortar in a wall",
    "tipping stack, elastic, below its limit",
    "wall that grows",
];

const HOW_TO_READ: &str = "full: called solved, at the worst of its checks; hollow: gave up, at the residual it reports; \
                           dots: backward error; grey: promised, by alm a hundred times that; drawn at 1e-17: all below";
/// The ends of the vertical axis, at which what is beyond is drawn: rounding and less at the bottom.
const ERRORS: [f64; 2] = [1e-17, 1.0];

const OF_PROBLEMS: &str = "
## Problems of `lcp`

Families of [hard problems](../hard_problems.md), by every method of `lcp`, with a tolerance of 1e-10. The error is the residual, recomputed from the data in double-double arithmetic; the backward error is relative to the largest terms of all equations.

";

/// Draws every theme into a folder.
pub(crate) fn draw(folder: &Path, themes: &[Theme], problems: &[problems::Sweep]) {
    std::fs::create_dir_all(folder).unwrap();
    let save = |file: &str, drawn: Option<String>| {
        // A theme of which no sweep is wanted has no picture.
        if let Some(drawn) = drawn {
            std::fs::write(folder.join(format!("{file}.svg")), drawn).unwrap();
        }
    };
    for theme in themes {
        let diagrams: Vec<Diagram> = theme.sweeps.iter().map(diagram).collect();
        save(theme.file, picture(theme.title, &diagrams, &[HOW_TO_READ.to_owned()]));
    }
    let diagrams: Vec<Diagram> = problems.iter().map(of_problem).collect();
    let notes = [HOW_TO_READ.replace(", by alm a hundred times that", "")];
    save("problems", picture("Problems of lcp", &diagrams, &notes));
}

/// Writes the page, its picture and its tables into the folder of the documents.
pub(crate) fn write(docs: &Path, themes: &[Theme], problems: &[problems::Sweep]) {
    let mut text = headline(themes, problems) + INTRODUCTION;
    write_counts(&mut text, themes).unwrap();
    text += MEANINGS;
    std::fs::write(docs.join("stability.md"), text).unwrap();

    let all = || themes.iter().flat_map(|theme| &theme.sweeps);
    let shown = |title: &str| all().find(|(sweep, _)| sweep.title == title).map(diagram).unwrap();
    let drawn = picture("Hard cases", &SHOWN.map(shown), &[HOW_TO_READ.to_owned()]).unwrap();
    std::fs::write(docs.join("pictures/stability.svg"), drawn).unwrap();

    let mut text = TABLES.to_owned();
    for theme in themes {
        write_theme(&mut text, theme).unwrap();
    }
    text += OF_PROBLEMS;
    write_problems(&mut text, problems).unwrap();
    std::fs::write(docs.join("data/stability.md"), text).unwrap();
}

/// The answer of the page, before anything else.
fn headline(themes: &[Theme], problems: &[problems::Sweep]) -> String {
    let points = || themes.iter().flat_map(|theme| &theme.sweeps).flat_map(|(_, points)| points);
    let is_solved = |end: &&Reached| matches!(end, Reached::Solved { .. });
    let routes = points().flat_map(|point| &point.ends).filter(is_solved).count();
    let found = problems.iter().flat_map(|sweep| &sweep.methods).flat_map(|(_, found)| found);
    let methods = found.map(|it| reached(it.as_ref())).filter(|end| is_solved(&end)).count();
    let wrong: usize = points().map(|it| it.wrong.len()).sum();
    let wrong = wrong + problems.iter().map(|sweep| sweep.wrong.len()).sum::<usize>();
    format!(
        "# Do hard cases stay stable?\n\n\
         Answers called solved: {} ({routes} by the routes of `masonry`, {methods} by the methods of `lcp`). Answers worse than promised: **{wrong}**.\n",
        routes + methods
    )
}

fn write_counts(text: &mut String, themes: &[Theme]) -> fmt::Result {
    let of = |k: usize| {
        let points = themes.iter().flat_map(|theme| &theme.sweeps).flat_map(|(_, points)| points);
        points.map(move |point| (point.expected, point.ends[k]))
    };
    let row = |text: &mut String, name: &str, count: &dyn Fn(Expected, Reached) -> bool| {
        let counted = |k: usize| of(k).filter(|(expected, end)| count(*expected, *end)).count();
        let counts = (0..ROUTES.len()).map(counted);
        let cells: Vec<String> = counts.map(|it| it.to_string()).collect();
        writeln!(text, "| {name} | {} |", cells.join(" | "))
    };
    writeln!(
        text,
        "\n| values of all sweeps | {} |",
        ROUTES.map(|it| it.name().to_owned()).join(" | ")
    )?;
    writeln!(text, "|---|{}", "--:|".repeat(ROUTES.len()))?;
    row(text, "solved", &|_, end| matches!(end, Reached::Solved { .. }))?;
    for (words, expected) in [
        ("no solution found, although one exists", Expected::Answer),
        ("no solution found, existence unknown", Expected::Open),
        ("no solution found, none exists", Expected::None),
    ] {
        row(text, words, &|it, end| it == expected && matches!(end, Reached::GaveUp { .. }))?;
    }
    row(text, "not treated, or too large", &|_, end| matches!(end, Reached::Nothing))?;
    let points = || themes.iter().flat_map(|theme| &theme.sweeps).flat_map(|(_, points)| points);
    let worse = ROUTES.map(|route| {
        let words = format!(" by {route:?}: ");
        points().flat_map(|it| &it.wrong).filter(|line| line.contains(&words)).count()
    });
    let cells = worse.map(|it| it.to_string());
    writeln!(text, "| called solved, but worse than promised | {} |", cells.join(" | "))
}

fn write_theme(text: &mut String, theme: &Theme) -> fmt::Result {
    writeln!(text, "\n## {}\n", theme.title)?;
    writeln!(
        text,
        "| sweep | parameter | expected | values | {} |",
        ROUTES.map(|it| it.name().to_owned()).join(" | ")
    )?;
    writeln!(text, "|---|---|---|--:|{}", "---|".repeat(ROUTES.len()))?;
    for (sweep, points) in &theme.sweeps {
        let [first, last] = [sweep.values[0], sweep.values[sweep.values.len() - 1]];
        write!(
            text,
            "| {} | {}, {} to {} | {} | {} |",
            sweep.title,
            sweep.parameter,
            number(first),
            number(last),
            expected(points),
            points.len()
        )?;
        for k in 0..ROUTES.len() {
            write!(text, " {} |", cell(points.iter().map(|point| point.ends[k])))?;
        }
        writeln!(text)?;
    }
    Ok(())
}

fn write_problems(text: &mut String, sweeps: &[problems::Sweep]) -> fmt::Result {
    let Some(first) = sweeps.first() else { return Ok(()) };
    let names: Vec<&str> = first.methods.iter().map(|(method, _)| method.name()).collect();
    writeln!(text, "| sweep | parameter | expected | values | {} |", names.join(" | "))?;
    writeln!(text, "|---|---|---|--:|{}", "---|".repeat(names.len()))?;
    for sweep in sweeps {
        let [first, last] = [sweep.values[0], sweep.values[sweep.values.len() - 1]];
        write!(
            text,
            "| {} | {}, {} to {} | {} | {} |",
            sweep.name,
            sweep.parameter,
            number(first),
            number(last),
            if sweep.is_solvable { "an answer" } else { "none" },
            sweep.values.len()
        )?;
        for (_, found) in &sweep.methods {
            write!(text, " {} |", cell(found.iter().map(|it| reached(it.as_ref()))))?;
        }
        writeln!(text)?;
    }
    Ok(())
}

fn expected(points: &[Point]) -> &'static str {
    let of = |expected: Expected| points.iter().all(|point| point.expected == expected);
    if of(Expected::Answer) {
        "an answer"
    } else if of(Expected::None) {
        "none"
    } else if of(Expected::Open) {
        "open"
    } else {
        "differs"
    }
}

fn cell(ends: impl Iterator<Item = Reached> + Clone) -> String {
    if ends.clone().all(|end| matches!(end, Reached::Nothing)) {
        return "-".to_owned();
    }
    let errors = ends.filter_map(|end| match end {
        Reached::Solved { error, .. } => Some(error),
        _ => None,
    });
    let count = errors.clone().count();
    let worst = errors.fold(0.0, f64::max);
    if count == 0 { "0".to_owned() } else { format!("{count}, {worst:.0e}") }
}

fn number(value: f64) -> String {
    if (1e-3..1e4).contains(&value) { value.to_string() } else { format!("{value:.0e}") }
}

/// How a method of `lcp` ended, as routes do.
fn reached(found: Option<&problems::Found>) -> Reached {
    match found {
        None => Reached::Nothing,
        Some(it) if it.status == Status::Solved => {
            Reached::Solved { error: it.residual, backward: it.backward }
        }
        Some(it) => Reached::GaveUp { status: it.status, residual: it.residual },
    }
}

fn diagram((sweep, points): &(Sweep, Vec<Point>)) -> Diagram {
    let promised = points.iter().map(|it| [it.value, it.promised.max(1e-8)]);
    let mut series = vec![bound(promised.collect())];
    for (k, route) in ROUTES.iter().enumerate() {
        let ends = points.iter().map(|it| (it.value, it.ends[k]));
        series.extend(line(route.name(), style(*route), &ends.collect::<Vec<_>>()));
    }
    let axes = [sweep.parameter, "error [-]"].map(str::to_owned);
    Diagram { title: sweep.title.clone(), axes, least: Some(ERRORS), series, ..Diagram::default() }
}

fn of_problem(sweep: &problems::Sweep) -> Diagram {
    let mut series = vec![bound(sweep.values.iter().map(|it| [*it, 1e-10]).collect())];
    for (method, found) in &sweep.methods {
        let ends = sweep.values.iter().copied().zip(found.iter().map(|it| reached(it.as_ref())));
        series.extend(line(method.name(), style_of_method(*method), &ends.collect::<Vec<_>>()));
    }
    let axes = [format!("{} [-]", sweep.parameter), "error [-]".to_owned()];
    Diagram {
        title: sweep.name.to_owned(),
        axes,
        least: Some(ERRORS),
        series,
        ..Diagram::default()
    }
}

fn bound(points: Vec<[f64; 2]>) -> Series {
    Series { name: String::new(), style: 0, look: Look::Bound, points }
}

/// The answers of a route, what it reports where it gave up, and backward errors.
fn line(name: &str, style: usize, ends: &[(f64, Reached)]) -> Vec<Series> {
    let of = |look, points| Series { name: String::new(), style, look, points };
    let mut series = vec![Series { name: name.to_owned(), ..of(Look::Full, Vec::new()) }];
    let [low, high] = ERRORS;
    let is_answer = |end: &Reached| matches!(end, Reached::Solved { .. });
    // Errors of answers and residuals of none are different numbers.
    for run in ends.chunk_by(|a, b| is_answer(&a.1) == is_answer(&b.1)) {
        let point = |(x, end): &(f64, Reached)| match *end {
            Reached::Solved { error, .. } => Some([*x, error.clamp(low, high)]),
            Reached::GaveUp { residual, .. } => Some([*x, residual.clamp(low, high)]),
            Reached::Nothing => None,
        };
        let look = if is_answer(&run[0].1) { Look::Full } else { Look::Hollow };
        series.push(of(look, run.iter().filter_map(point).collect()));
    }
    let backward = ends.iter().filter_map(|(x, end)| match *end {
        Reached::Solved { backward, .. } => Some([*x, backward.clamp(low, high)]),
        _ => None,
    });
    series.push(of(Look::Dots, backward.collect()));
    series
}

/// The colours of the routes that run the same method; the others have those that are left.
fn style_of_method(method: Method) -> usize {
    match method {
        Method::LemkeDense => style(Route::Lemke),
        Method::Interior => style(Route::Interior),
        Method::Quadratic => style(Route::Qp),
        Method::Sweeps => style(Route::Pgs),
        Method::Newton => 5,
        Method::LemkeSparse => style(Route::Alm),
        Method::Auto => 6,
    }
}
