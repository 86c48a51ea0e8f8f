//! Curves of a load history: loads or reactions against displacements, and both step by step. Curves of a limit load:
//! the load factor along the path, and against the position of a train.

use super::diagram::{CurveStart, Diagram, Look, Series, picture};
use crate::figures::history::steps;
use crate::figures::limit::curve;
use crate::figures::{Table, Value};
use masonry::analysis::limit::Path;
use masonry::history::{History, StepRecord};
use masonry::model::Model;
use masonry::rounding::largest;

/// The largest number of curves in one diagram.
const MOST: usize = 7;
/// A column counts as constant if its values change by less than this part of the largest value.
const CONSTANT: f64 = 1e-9;

/// Draws load factors against the largest displacement, reactions against the movement of a support, and the largest
/// displacement and the reactions step by step. `None` for fewer than two steps.
pub fn history(title: &str, model: &Model, history: &History) -> Option<String> {
    curves(title, model, history, false)
}

/// Draws the curves of [`history`], with marks of the steps for a page.
pub(crate) fn curves(
    title: &str,
    model: &Model,
    history: &History,
    for_page: bool,
) -> Option<String> {
    let table = &steps(model, history);
    if table.rows.len() < 2 {
        return None;
    }
    let moved = format!("largest displacement [{}]", model.units.length_name());
    let force = model.units.force_name();
    let reactions =
        |support: &str| ["fx", "fy"].map(|part| Column::same(format!("{support} {part}")));
    let by_step = Against { table, x: "number", sense: 1.0, for_page };
    let by_displacement = Against { x: "max_displacement", ..by_step };
    let gravity = [Column { key: "gravity".to_owned(), name: "gravity".to_owned() }];
    let loads = history.loads.iter();
    let loads = loads.map(|name| Column { key: format!("load {name}"), name: name.clone() });
    let factors = by_displacement.varying(gravity.into_iter().chain(loads));
    let mut list = vec![by_displacement.diagram([&moved, "factor of loads [-]"], factors)];
    if let Some(Moved { support, x, sense, axis }) = most_moved(model, table) {
        let against = Against { x: &x, sense, ..by_step };
        let own = reactions(support).map(|column| against.curve(column)).to_vec();
        list.push(against.diagram([&axis, &format!("reaction of \"{support}\" [{force}]")], own));
    }
    let displacement =
        Column { key: "max_displacement".to_owned(), name: "displacement".to_owned() };
    let displacement = vec![by_step.curve(displacement)];
    let all = by_step.varying(model.supports.iter().flat_map(|support| reactions(&support.name)));
    for (name, series) in [(moved, displacement), (format!("reactions [{force}]"), all)] {
        let diagram = by_step.diagram(["step", &name], series);
        list.push(Diagram { stages: stages(&history.records), ..diagram });
    }
    picture(&format!("{title}: load history"), &list, &[])
}

/// A column of a table, and its name in the legend.
struct Column {
    key: String,
    name: String,
}

impl Column {
    fn same(key: String) -> Self {
        Self { name: key.clone(), key }
    }
}

/// Settings of diagrams that show columns of a table against the column `x`.
#[derive(Clone, Copy)]
struct Against<'a> {
    table: &'a Table,
    x: &'a str,
    /// Minus one if the axis shows the column `x` with the opposite sign, so that curves run from left to right.
    sense: f64,
    /// Whether the diagram is on a page, which marks its step in the diagram.
    for_page: bool,
}

impl Against<'_> {
    fn curve(&self, Column { key, name }: Column) -> Series {
        let points = self.steps().into_iter().zip(self.table.numbers(&key));
        Series { name, style: 0, look: Look::Full, points: points.map(<[f64; 2]>::from).collect() }
    }

    /// Returns the curves of all columns that vary with the steps, by decreasing variation.
    fn varying(&self, columns: impl Iterator<Item = Column>) -> Vec<Series> {
        let mut list: Vec<Series> = columns.map(|column| self.curve(column)).collect();
        let values = |it: &Series| it.points.iter().map(|it| it[1]).collect::<Vec<_>>();
        let span = |it: &Series| {
            let ends = values(it)
                .into_iter()
                .reduce(f64::max)
                .zip(values(it).into_iter().reduce(f64::min));
            ends.map_or(0.0, |(most, least)| most - least)
        };
        let size = largest(list.iter().flat_map(values));
        list.retain(|it| span(it) > CONSTANT * size);
        list.sort_by(|a, b| span(b).total_cmp(&span(a)));
        list.truncate(MOST);
        list
    }

    fn diagram(&self, axes: [&str; 2], series: Vec<Series>) -> Diagram {
        let steps = if self.for_page { self.steps() } else { Vec::new() };
        Diagram { steps, ..Diagram::linear(axes, series) }
    }

    /// Returns the values of the steps on the horizontal axis.
    fn steps(&self) -> Vec<f64> {
        self.table.numbers(self.x).into_iter().map(|it| self.sense * it).collect()
    }
}

/// The movement of a support, as the horizontal axis of a diagram.
struct Moved<'a> {
    support: &'a str,
    /// The key of the column; then its sign at the largest movement, and the name of the movement on the axis.
    x: String,
    sense: f64,
    axis: String,
}

/// Finds the support with the largest movement, and the kind of the movement: up or down, to a side, or by turning
/// alone. `None` if no support moves.
fn most_moved<'a>(model: &'a Model, table: &Table) -> Option<Moved<'a>> {
    let furthest = |part: &'static str| {
        let names = model.supports.iter().map(|it| it.name.as_str());
        let largest = |name| {
            let places = table.numbers(&format!("{name} {part}")).into_iter();
            (name, places.max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0))
        };
        names.map(largest).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    };
    let (right, up, turned) = (furthest("x")?, furthest("y")?, furthest("turn")?);
    let length = model.units.length_name();
    let ((support, most), part, [backwards, forwards], unit) =
        if up.1 != 0.0 && up.1.abs() >= right.1.abs() {
            (up, "y", ["moves down", "moves up"], length)
        } else if right.1 != 0.0 {
            (right, "x", ["moves to the left", "moves to the right"], length)
        } else if turned.1 != 0.0 {
            (turned, "turn", ["turns clockwise", "turns counter-clockwise"], "rad")
        } else {
            return None;
        };
    let how = if most < 0.0 { backwards } else { forwards };
    let axis = format!("\"{support}\" {how} by [{unit}]");
    Some(Moved { support, x: format!("{support} {part}"), sense: most.signum(), axis })
}

/// Returns the first step of every stage.
fn stages(records: &[StepRecord]) -> Vec<CurveStart> {
    let all = (1..).zip(records).filter(|(_, it)| it.step.number == 1);
    all.map(|(number, it)| CurveStart { at: f64::from(number), name: it.step.stage.clone() })
        .collect()
}

/// Draws the load factors of the states of rest against their displacements, and the load factor above which the
/// structure falls. `None` for fewer than two states.
pub fn path(title: &str, group: &str, path: &Path) -> Option<String> {
    let table = curve(path);
    let displacements = table.numbers("displacement");
    let last = *displacements.last().filter(|_| path.curve.len() > 1)?;
    let points = displacements.iter().copied().zip(table.numbers("load_factor"));
    let points = points.map(<[f64; 2]>::from).collect();
    let rest = Series { name: "states at rest".to_owned(), style: 0, look: Look::Full, points };
    let falls = path.falls.map(|falls| Series {
        name: "falls".to_owned(),
        style: 1,
        look: Look::Bound,
        points: vec![[0.0, falls], [last, falls]],
    });
    let across = format!("largest displacement [{}]", path.model.units.length_name());
    let up = format!("factor of \"{group}\" [-]");
    let series = std::iter::once(rest).chain(falls).collect();
    let diagram = Diagram::linear([&across, &up], series);
    picture(&format!("{title}: load factor along the path"), &[diagram], &[])
}

/// Load factors of a train beyond this multiple of the least factor are not drawn. Chosen: the curve shows its worst
/// part clearly.
const SHOWN: f64 = 10.0;

/// Draws the load factor of a train by a law of friction against the position of the train, and marks the worst
/// position. The values come from the table of positions. `None` for fewer than two load factors.
pub(crate) fn train(title: &str, law: &str, positions: &Table, critical: usize) -> Option<String> {
    let places = positions.numbers("position");
    let factor = |row: &Vec<Value>| match row[1] {
        Value::Number(factor) => Some(factor),
        _ => None,
    };
    let points = places.iter().zip(&positions.rows);
    let points: Vec<Option<[f64; 2]>> =
        points.map(|(place, row)| Some([*place, factor(row)?])).collect();
    let governs = points[critical]?;
    let is_shown = |it: &Option<[f64; 2]>| it.is_some_and(|it| it[1] <= SHOWN * governs[1]);
    // The curve has gaps at positions with a large load factor or without one.
    let runs = points.chunk_by(|a, b| is_shown(a) == is_shown(b)).filter(|run| is_shown(&run[0]));
    let runs: Vec<Vec<[f64; 2]>> =
        runs.map(|run| run.iter().flatten().copied().collect()).collect();
    if runs.concat().len() < 2 {
        return None;
    }
    let mut names = [law].into_iter();
    let mut series: Vec<Series> = Vec::new();
    for points in runs {
        let name = names.next().unwrap_or_default().to_owned();
        series.push(Series { name, style: 0, look: Look::Full, points });
    }
    let name = "worst position".to_owned();
    series.push(Series { name, style: 1, look: Look::Full, points: vec![governs] });
    let length = positions.units.0.length_name();
    let axes = [&format!("position of the train [{length}]"), "factor of the train [-]"];
    // All pieces between gaps belong to one curve and have one style.
    let diagram = Diagram { series, ..Diagram::linear(axes, Vec::new()) };
    picture(&format!("{title}: load factor by position"), &[diagram], &[])
}
