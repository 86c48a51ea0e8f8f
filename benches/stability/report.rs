//! The sweeps as a page: `docs/stability.md`, and a picture for every theme.

use std::fmt::{self, Write};
use std::path::Path;

use lcp::Status;
use masonry::scene::Route;

use super::common::routes::ROUTES;
use super::picture::{Line, Mark, Panel, picture};
use super::problems;
use super::sweep::{Point, Reached, Sweep};

/// Sweeps that are drawn in one picture.
pub(crate) struct Theme {
    /// Part of the name of its picture.
    pub(crate) file: &'static str,
    pub(crate) title: &'static str,
    pub(crate) sweeps: Vec<(Sweep, Vec<Point>)>,
}

const HEAD: &str = "\
# How far answers can be trusted

The [hard cases](hard_cases.md) with their parameters varied, from harmless to hopeless, by every route. The pictures show where
an answer becomes less accurate, and where a route says that it has none. What is called solved is held against checks that use
nothing of the methods; asked for were residuals of 1e-10, of `alm` 1e-8.

* **Error**: the worst of balance, friction cone, gaps, sliding, nodal forces and energy. Forces are compared with those on the
  same block, but with a millionth of the largest ones at least.
* **Backward error**: the smallest relative change of loads, stiffness and contact forces with which the answer would be exact.
  Where it is near rounding and the error is not, the scene itself is sensitive: no method in these numbers has more digits.
* **Promised** is that residuals are below what was asked for relative to the largest forces and displacements, thus up to a
  hundred times that on single blocks, and more only where forces on blocks differ by more; and that a block carries its own loads to a thousandth.

Written by `cargo bench --bench stability -- --write`, which fails if an answer is worse than what is promised, or if something is called
solved that cannot stand. A few values of every sweep are tested by `cargo test --test hard_cases`.
";

const OF_PROBLEMS: &str = "
## Problems of `lcp`

The [hard problems](hard_problems.md) that have a parameter, by every method of `lcp`, asked for 1e-10. The error is the residual, recomputed from the data in numbers of
twice the digits; the backward error is relative to all terms of the equations, row by row.

![Problems of lcp: residuals over parameters](pictures/stability_problems.svg)
";

/// Writes the page and the pictures into the folder of the documents.
pub(crate) fn write(docs: &Path, themes: &[Theme], problems: &[problems::Sweep]) {
    let mut text = HEAD.to_owned();
    write_counts(&mut text, themes).unwrap();
    for theme in themes {
        write_theme(&mut text, theme).unwrap();
        let drawn = picture(theme.title, &theme.sweeps.iter().map(panel).collect::<Vec<_>>());
        std::fs::write(docs.join(format!("pictures/stability_{}.svg", theme.file)), drawn).unwrap();
    }
    text += OF_PROBLEMS;
    let panels: Vec<Panel> = problems.iter().map(problem_panel).collect();
    let drawn = picture("Problems of lcp", &panels);
    std::fs::write(docs.join("pictures/stability_problems.svg"), drawn).unwrap();
    std::fs::write(docs.join("stability.md"), text).unwrap();
}

fn write_counts(text: &mut String, themes: &[Theme]) -> fmt::Result {
    let of = |k: usize| {
        let points = themes.iter().flat_map(|theme| &theme.sweeps).flat_map(|(_, points)| points);
        points.map(move |point| point.ends[k])
    };
    let row = |text: &mut String, name: &str, count: &dyn Fn(Reached) -> bool| {
        let counts = (0..ROUTES.len()).map(|k| of(k).filter(|end| count(*end)).count());
        let cells: Vec<String> = counts.map(|it| it.to_string()).collect();
        writeln!(text, "| {name} | {} |", cells.join(" | "))
    };
    writeln!(text, "\n| scenes | {} |", ROUTES.map(|it| it.name().to_owned()).join(" | "))?;
    writeln!(text, "|---|{}", "--:|".repeat(ROUTES.len()))?;
    row(text, "solved", &|end| matches!(end, Reached::Solved { .. }))?;
    row(text, "gave up, and said so", &|end| matches!(end, Reached::GaveUp { .. }))?;
    row(text, "not treated, or too large to try", &|end| matches!(end, Reached::Nothing))?;
    // The bench has failed otherwise.
    row(text, "called solved, and worse than promised", &|_| false)
}

fn write_theme(text: &mut String, theme: &Theme) -> fmt::Result {
    writeln!(text, "\n## {}\n", theme.title)?;
    writeln!(
        text,
        "![{}: errors over parameters](pictures/stability_{}.svg)\n",
        theme.title, theme.file
    )?;
    writeln!(text, "How many values were solved, and the worst error of these:\n")?;
    writeln!(
        text,
        "| sweep | parameter | values | {} |",
        ROUTES.map(|it| it.name().to_owned()).join(" | ")
    )?;
    writeln!(text, "|---|---|--:|{}", "---|".repeat(ROUTES.len()))?;
    for (sweep, points) in &theme.sweeps {
        let [first, last] = [sweep.values[0], sweep.values[sweep.values.len() - 1]];
        write!(
            text,
            "| {} | {}, {} to {} | {} |",
            sweep.title,
            sweep.parameter,
            number(first),
            number(last),
            points.len()
        )?;
        for k in 0..ROUTES.len() {
            write!(text, " {} |", cell(points.iter().map(|point| point.ends[k])))?;
        }
        writeln!(text)?;
    }
    Ok(())
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

fn panel((sweep, points): &(Sweep, Vec<Point>)) -> Panel {
    let lines = ROUTES.iter().enumerate().map(|(k, route)| {
        let mark = |point: &Point| match point.ends[k] {
            Reached::Solved { error, backward } => {
                Some(Mark::Answer { x: point.value, error, backward })
            }
            Reached::GaveUp { residual, .. } => Some(Mark::GaveUp { x: point.value, residual }),
            Reached::Nothing => None,
        };
        let points = points.iter().filter_map(mark).collect();
        Line { name: route.name().to_owned(), style: style(*route), points }
    });
    Panel {
        title: sweep.title.clone(),
        x: sweep.parameter.to_owned(),
        promised: 1e-8,
        lines: lines.collect(),
    }
}

fn problem_panel(sweep: &problems::Sweep) -> Panel {
    let lines = sweep.methods.iter().enumerate().map(|(style, (method, found))| {
        let at = sweep.values.iter().zip(found).filter(|(value, _)| **value > 0.0);
        let mark = |(&x, found): (&f64, &Option<problems::Found>)| {
            let problems::Found { status, residual, backward } = (*found)?;
            let is_answer = status == Status::Solved;
            Some(if is_answer {
                Mark::Answer { x, error: residual, backward }
            } else {
                Mark::GaveUp { x, residual }
            })
        };
        Line { name: method.name().to_owned(), style, points: at.filter_map(mark).collect() }
    });
    Panel {
        title: sweep.name.to_owned(),
        x: format!("{} [-]", sweep.parameter),
        promised: 1e-10,
        lines: lines.collect(),
    }
}

/// The colours of the pictures of studies.
fn style(route: Route) -> usize {
    let order = [Route::Lemke, Route::Interior, Route::Qp, Route::Pgs, Route::Alm, Route::Newton];
    order.iter().position(|it| *it == route).unwrap_or(order.len())
}
