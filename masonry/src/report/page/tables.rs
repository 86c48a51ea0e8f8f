//! Tables that a click on a column sorts.

use crate::data::state::{ContactState, Reaction};
use crate::model::Model;
use crate::report::format::{InUnits, body_name, significant};
use crate::report::hinges::YieldingJoint;
use crate::report::joints::{self, JointForce, Opening};
use crate::report::svg::escaped;

/// A table with its heading.
#[derive(Debug)]
pub(super) struct Table {
    title: String,
    heads: Vec<String>,
    rows: Vec<Vec<Cell>>,
    note: String,
}

/// What stands in a table.
#[derive(Debug)]
pub(super) enum Cell {
    /// Words, sorted as such.
    Words(String),
    /// A number, and its text.
    Number(f64, String),
    /// Nothing, sorted last.
    Nothing,
}

impl Cell {
    pub(super) fn number(value: f64, digits: usize) -> Self {
        Self::Number(value, significant(value, digits))
    }

    pub(super) fn count(value: usize) -> Self {
        Self::Number(value as f64, value.to_string())
    }

    pub(super) fn words(text: &str) -> Self {
        Self::Words(text.to_owned())
    }

    fn html(&self) -> String {
        match self {
            Self::Words(text) => format!("<td>{}</td>", escaped(text)),
            Self::Number(value, text) => {
                format!("<td class=\"number\" data-value=\"{value:e}\">{}</td>", escaped(text))
            }
            Self::Nothing => "<td></td>".to_owned(),
        }
    }
}

impl Table {
    pub(super) fn new(title: &str, heads: &[&str]) -> Self {
        let heads = heads.iter().map(|head| (*head).to_owned()).collect();
        Self { title: title.to_owned(), heads, rows: Vec::new(), note: String::new() }
    }

    pub(super) fn row(&mut self, cells: Vec<Cell>) {
        self.rows.push(cells);
    }

    pub(super) fn with_note(mut self, note: &str) -> Self {
        note.clone_into(&mut self.note);
        self
    }

    /// The table, unless it has no rows.
    pub(super) fn if_any(self) -> Option<Self> {
        (!self.rows.is_empty()).then_some(self)
    }

    pub(super) fn html(&self) -> String {
        let note = match self.note.as_str() {
            "" => String::new(),
            note => format!("<p>{}</p>\n", escaped(note)),
        };
        let head = |head: &String| format!("<th scope=\"col\">{}</th>", escaped(head));
        let heads: String = self.heads.iter().map(head).collect();
        let row = |cells: &Vec<Cell>| {
            let cells: String = cells.iter().map(Cell::html).collect();
            format!("<tr>{cells}</tr>\n")
        };
        let rows: String = self.rows.iter().map(row).collect();
        format!(
            "<section class=\"table\">\n<h2>{}</h2>\n{note}<div class=\"scroll\"><table>\n\
             <thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n</section>\n",
            escaped(&self.title)
        )
    }
}

/// The reactions of supports.
pub(super) fn reactions(title: &str, reactions: &[Reaction], units: InUnits) -> Option<Table> {
    let (force, moment) = (units.0.force_name(), units.0.energy_name());
    let heads =
        ["support", &format!("fx [{force}]"), &format!("fy [{force}]"), &format!("m [{moment}]")];
    let mut table =
        Table::new(title, &heads).with_note("Forces on the structure; moments about the origin.");
    for it in reactions {
        table.row(vec![
            Cell::words(&it.support),
            Cell::number(units.force(it.fx), 5),
            Cell::number(units.force(it.fy), 5),
            Cell::number(units.energy(it.m), 5),
        ]);
    }
    table.if_any()
}

/// What every joint carries and how far it has opened.
pub(super) fn joints(title: &str, model: &Model, contacts: &[ContactState]) -> Option<Table> {
    let units = InUnits(model.units);
    let force = units.0.force_name();
    let (forces, openings) = (joints::forces(model, contacts), joints::openings(model, contacts));
    let is_open = !openings.is_empty();
    let (normal, shear) = (format!("N [{force}]"), format!("T [{force}]"));
    let mut heads =
        vec!["joint", "between", "and", "class", &normal, &shear, "e / l", "friction used [%]"];
    if is_open {
        heads.extend(["open [mm]", "slip [mm]"]);
    }
    let mut table = Table::new(title, &heads).with_note(
        "N presses where it is positive; e / l is the eccentricity of the resultant in lengths of the joint, outside the \
         middle third above 0.167.",
    );
    for (index, joint) in model.joints.iter().enumerate() {
        let own = |it: &&JointForce| it.joint.index() == index;
        let carried = forces.iter().find(own);
        let opened = openings.iter().find(|it: &&Opening| it.joint.index() == index);
        if carried.is_none() && opened.is_none() {
            continue;
        }
        let number = |value: Option<f64>, digits| {
            value.map_or(Cell::Nothing, |value| Cell::number(value, digits))
        };
        let mut row = vec![Cell::count(index + 1)];
        row.extend(sides(model, index));
        row.push(Cell::words(model.joint_classes.get(joint.class).map_or("", |it| &it.name)));
        row.extend([
            number(carried.map(|it| units.force(it.normal)), 4),
            number(carried.map(|it| units.force(it.tangential)), 4),
            number(carried.map(|it| it.eccentricity), 3),
            number(carried.and_then(|it| it.utilisation).map(|it| 100.0 * it), 3),
        ]);
        if is_open {
            row.push(number(opened.map(|it| 1e3 * it.widest), 3));
            row.push(number(opened.map(|it| 1e3 * it.slip), 3));
        }
        table.row(row);
    }
    table.if_any()
}

/// Rates below this part of the largest are rounding errors.
const NO_RATE: f64 = 1e-9;

fn rate(it: f64) -> f64 {
    if it > NO_RATE { it } else { 0.0 }
}

/// The joints that yield in a mechanism, with the numbers of its picture.
pub(super) fn yielding(title: &str, model: &Model, joints: &[YieldingJoint]) -> Option<Table> {
    let heads = ["number", "between", "and", "what it does", "opens", "slides"];
    let mut table = Table::new(title, &heads)
        .with_note("Rates are relative to the fastest joint; numbers are those of the picture.");
    let mut number = 0;
    for it in joints {
        let mut row = Vec::with_capacity(heads.len());
        row.push(if it.does.is_marked() {
            number += 1;
            Cell::count(number)
        } else {
            Cell::Nothing
        });
        row.extend(sides(model, it.joint.index()));
        row.extend([
            Cell::words(it.does.name()),
            Cell::number(rate(it.opens), 3),
            Cell::number(rate(it.slides), 3),
        ]);
        table.row(row);
    }
    table.if_any()
}

/// The bodies on both sides of a joint.
pub(super) fn sides(model: &Model, joint: usize) -> [Cell; 2] {
    let joint = &model.joints[joint];
    let front = crate::model::Body::Block(joint.b);
    [joint.a, front].map(|body| Cell::words(body_name(model, body)))
}
