//! The curves of a load history: loads or reactions against displacements, and both step by step.

use super::diagram::{Chart, Look, Series, charts};
use crate::history::{History, StepRecord};
use crate::model::Model;
use crate::report::figures::Table;
use crate::report::figures::history::steps;

/// Curves of one chart are at most so many.
const MOST: usize = 7;
/// What changes by less than this part of the largest value is constant.
const CONSTANT: f64 = 1e-9;

/// Factors of loads against the largest displacement, reactions against the movement of a support, and the largest
/// displacement and the reactions step by step. `None` for less than two steps.
pub fn history(title: &str, model: &Model, history: &History) -> Option<String> {
    curves(title, model, history, false)
}

/// The same, for a page with marks of the steps.
pub(in crate::report) fn curves(
    title: &str,
    model: &Model,
    history: &History,
    for_page: bool,
) -> Option<String> {
    let table = &steps(model, history);
    let moved = format!("largest displacement [{}]", model.units.length_name());
    let force = model.units.force_name();
    let reactions = |support: &str| {
        ["fx", "fy"].map(|part| format!("{support} {part}")).map(|key| [key.clone(), key])
    };
    let against = Against { table, x: "max_displacement", sense: 1.0 };
    let loads = history.loads.iter().map(|name| [format!("load {name}"), name.clone()]);
    let gravity = [["gravity".to_owned(), "gravity".to_owned()]];
    let factors = against.varying(gravity.into_iter().chain(loads));
    let mut list = Vec::new();
    if !factors.is_empty() {
        list.push(against.chart([&moved, "factor of loads [-]"], factors));
    }
    if let Some(Moved { support, x, sense, axis }) = most_moved(model, table) {
        let against = Against { table, x: &x, sense };
        let own = reactions(support).map(|column| against.curve(column)).to_vec();
        let y = format!("reaction of \"{support}\" [{force}]");
        list.push(against.chart([&axis, &y], own));
    }
    let against = Against { table, x: "number", sense: 1.0 };
    let displacement = against.curve(["max_displacement", "displacement"].map(str::to_owned));
    let all = model.supports.iter().flat_map(|support| reactions(&support.name));
    let all = against.varying(all);
    for (name, series) in [(moved, vec![displacement]), (format!("reactions [{force}]"), all)] {
        let chart = against.chart(["step", &name], series);
        list.push(Chart { stages: stages(&history.records), ..chart });
    }
    if !for_page {
        for chart in &mut list {
            chart.steps.clear();
        }
    }
    charts(&format!("{title}: load history"), &list)
}

/// Curves of columns against one of them.
struct Against<'a> {
    table: &'a Table,
    x: &'a str,
    /// Minus one if the axis shows the opposite of the column, so that curves run from left to right.
    sense: f64,
}

impl Against<'_> {
    /// The curve of a column with a name in the legend.
    fn curve(&self, [key, name]: [String; 2]) -> Series {
        let points = self.steps().into_iter().zip(self.table.numbers(&key));
        let points = points.map(|(x, y)| [x, y]).collect();
        Series { name, style: 0, look: Look::Full, points }
    }

    /// The curves of what is not the same in all steps, those first that change most.
    fn varying(&self, columns: impl Iterator<Item = [String; 2]>) -> Vec<Series> {
        let largest =
            |it: &Series| it.points.iter().map(|it| it[1]).fold(f64::NEG_INFINITY, f64::max);
        let least = |it: &Series| it.points.iter().map(|it| it[1]).fold(f64::INFINITY, f64::min);
        let mut list: Vec<Series> = columns.map(|column| self.curve(column)).collect();
        let size = list.iter().map(|it| largest(it).max(-least(it))).fold(0.0, f64::max);
        list.retain(|it| largest(it) - least(it) > CONSTANT * size);
        list.sort_by(|a, b| (largest(b) - least(b)).total_cmp(&(largest(a) - least(a))));
        list.truncate(MOST);
        list
    }

    fn chart(&self, axes: [&str; 2], series: Vec<Series>) -> Chart {
        Chart { steps: self.steps(), ..Chart::of(axes.map(str::to_owned), series) }
    }

    /// Where the steps are on the axis.
    fn steps(&self) -> Vec<f64> {
        self.table.numbers(self.x).into_iter().map(|it| self.sense * it).collect()
    }
}

/// How a support moves.
struct Moved<'a> {
    support: &'a str,
    /// The column, its sign at the largest movement, and what an axis calls the movement.
    x: String,
    sense: f64,
    axis: String,
}

/// The support that moves furthest, and how: up or down, to a side, or by turning alone.
fn most_moved<'a>(model: &'a Model, table: &Table) -> Option<Moved<'a>> {
    let furthest = |part: &'static str| {
        let names = model.supports.iter().map(|it| it.name.as_str());
        let largest = |name| {
            let places = table.numbers(&format!("{name} {part}")).into_iter();
            (name, places.fold(0.0, |most: f64, it| if it.abs() > most.abs() { it } else { most }))
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

/// The first step of every stage, and its name.
fn stages(records: &[StepRecord]) -> Vec<(f64, String)> {
    let first = |(number, record): (u32, &StepRecord)| {
        (record.step.number == 1).then(|| (f64::from(number), record.step.stage.clone()))
    };
    (1..).zip(records).filter_map(first).collect()
}
