//! The forces in the joints: resultants where they act, the paths between them, and how much of friction is used.

mod reactions;

use crate::data::state::ContactState;
use nalgebra::{Point2, Vector2};

use super::canvas::{Canvas, Pixel, fixed};
use super::labels::Labels;
use super::loads::Loads;
use super::marks::{self, BRICK, COMPRESSION, TENSION};
use super::names;
use super::sheet::{Bounds, Margins, SYMBOL, Sheet};
use crate::model::{Body, Model};
use crate::report::format::InUnits;
use crate::report::joints::{self, JointForce};
use reactions::Reactions;

/// Resultants below this part of the largest are not drawn.
const LEAST: f64 = 1e-6;
/// Resultants below this part are left out of structures with many joints.
const LEAST_OF_MANY: f64 = 1e-2;
/// From so many joints on.
const MANY: usize = 150;
/// Structures with so few joints have the value of every resultant.
const FEW: usize = 24;
/// Blocks carry forces on the paths between their joints.
const PATH: &str = "#9cc7e3";
/// Least use of friction, colour, and what the legend says.
const USES: [(f64, &str, &str); 3] = [
    (0.995, "#c4161c", "friction used up"),
    (0.8, "#f07c12", "80 % of friction used or more"),
    (0.5, "#e8c51f", "50 % of friction used or more"),
];
/// Half the middle third, in lengths of a joint, with room for rounding errors.
const MIDDLE_THIRD: f64 = 1.0 / 6.0 + 1e-9;
/// Half a joint, with room for rounding errors.
const ENDS: f64 = 0.5 + 1e-6;

/// What pictures of forces share, so that those of a load history can be compared.
#[derive(Debug, Clone, Copy)]
pub(in crate::report) struct Shared {
    /// The largest resultant \[N\].
    largest: f64,
    bounds: Bounds,
    /// Room for the arrows and labels of all.
    margins: Margins,
}

impl Shared {
    /// The scale of structures and their contact forces.
    pub(in crate::report) fn of(states: &[(&Model, &[ContactState])]) -> Self {
        let (mut largest, mut margins) = (0.0_f64, Margins::HATCH);
        for (model, contacts) in states {
            let units = InUnits(model.units);
            let all = joints::forces(model, contacts);
            largest = all.iter().map(|it| it.force.norm()).fold(largest, f64::max);
            let reactions = Reactions::of(model, &all, units);
            margins = margins.and(Loads::of(model, units).margins()).and(reactions.margins());
        }
        let all = states.iter().map(|(model, _)| marks::bounds(model));
        let bounds = Bounds::of(all.flat_map(|bounds| [bounds.low, bounds.high]));
        Self { largest, bounds, margins }
    }
}

/// The structure with the resultant of every joint as a stroke in its direction, through the place where it crosses the
/// joint; the length goes with the force.
///
/// Behind them are the paths of the forces: lines from joint to joint, as wide as the force is large; in an arch the
/// line of thrust. Dots are hollow where the resultant has left the middle third. Joints in colour use much of their
/// friction. Supports have their reactions. Loads are those of the model.
pub fn forces(title: &str, model: &Model, contacts: &[ContactState]) -> String {
    shared(title, model, contacts, &Shared::of(&[(model, contacts)]))
}

/// The same, as long and as wide as others.
pub(in crate::report) fn shared(
    title: &str,
    model: &Model,
    contacts: &[ContactState],
    by: &Shared,
) -> String {
    let units = InUnits(model.units);
    let loads = Loads::of(model, units);
    let all = joints::forces(model, contacts);
    let reactions = Reactions::of(model, &all, units);
    let mut sheet = Sheet::new(&format!("{title}: forces"), model, by.bounds, by.margins);
    marks::bricks(&mut sheet, &model.blocks, BRICK);
    marks::supports(&mut sheet, model);
    let largest = by.largest;
    let least = if all.len() > MANY { LEAST_OF_MANY } else { LEAST };
    let large: Vec<&JointForce> =
        all.iter().filter(|it| it.force.norm() > least * largest).collect();
    // With tensile strength a joint can carry a moment whose resultant passes beside it.
    let drawn: Vec<&JointForce> =
        large.iter().copied().filter(|it| it.eccentricity.abs() <= ENDS).collect();
    draw_paths(&mut sheet, model, &drawn, largest);
    draw_uses(&mut sheet, model, &drawn);
    draw_resultants(&mut sheet, model, &drawn, largest);
    let mut labels = Labels::within(sheet.room());
    marks::avoid_supports(&sheet.frame, model, &mut labels);
    loads.mark(&sheet.frame, &mut labels);
    reactions.mark(&sheet.frame, &mut labels);
    for it in &drawn {
        let [from, to] = stroke(&sheet, it, largest);
        labels.avoid(from, to);
    }
    loads.draw(&mut sheet, model, &mut labels);
    reactions.draw(&mut sheet, &mut labels);
    if drawn.len() <= FEW {
        draw_values(&mut sheet, model, &drawn, units, &mut labels);
    }
    let (small, beside) = (all.len() - large.len(), large.len() - drawn.len());
    if all.len() > MANY && small > 0 {
        let count = marks::counted(small, "joint");
        sheet.note(&format!("left out: {count} with less than 1 % of the largest force"));
    }
    if beside > 0 {
        let count = marks::counted(beside, "joint");
        sheet.note(&format!("left out: {count} whose resultant passes beside them"));
    }
    sheet.note("one of many sets of forces where they are not unique");
    sheet.finish()
}

/// Lines from every joint of a block to the middle of its forces: of a block with two joints one straight line.
fn draw_paths(sheet: &mut Sheet, model: &Model, drawn: &[&JointForce], largest: f64) {
    let mut of_blocks: Vec<Vec<(Point2<f64>, f64)>> = vec![Vec::new(); model.blocks.len()];
    for it in drawn.iter().filter(|it| it.normal > 0.0) {
        let joint = &model.joints[it.joint.index()];
        let end = (it.at, it.force.norm());
        of_blocks[joint.b.index()].push(end);
        if let Body::Block(a) = joint.a {
            of_blocks[a.index()].push(end);
        }
    }
    if of_blocks.iter().all(|ends| ends.len() < 2) {
        return;
    }
    let (frame, widest) = (sheet.frame, (0.16 * sheet.brick).clamp(1.5, 9.0));
    let style = format!("class=\"paths\" stroke=\"{PATH}\" stroke-linecap=\"round\"");
    sheet.canvas.group(&style, |canvas| {
        for ends in of_blocks.iter().filter(|ends| ends.len() > 1) {
            let sum: f64 = ends.iter().map(|(_, force)| force).sum();
            let middle: Vector2<f64> =
                ends.iter().map(|(at, force)| at.coords * (force / sum)).sum();
            for (at, force) in ends {
                let width = fixed((widest * force / largest).max(0.3));
                let (from, to) = (frame.at(*at), frame.at(Point2::from(middle)));
                canvas.line(from, to, &format!("stroke-width=\"{width}\""));
            }
        }
    });
    sheet.entry("path of forces, as wide as the force is large", |symbol| {
        let style = format!("stroke=\"{PATH}\" stroke-width=\"6\" stroke-linecap=\"round\"");
        symbol.line(Pixel::new(-19.0, 0.0), Pixel::new(19.0, 0.0), &style);
    });
}

/// Joints that use much of their friction.
fn draw_uses(sheet: &mut Sheet, model: &Model, drawn: &[&JointForce]) {
    let frame = sheet.frame;
    let width = (0.05 * sheet.brick).clamp(0.8, 3.2);
    let mut below = f64::INFINITY;
    for (least, colour, name) in USES {
        let within =
            |it: &&&JointForce| it.utilisation.is_some_and(|use_| use_ >= least && use_ < below);
        let found: Vec<_> = drawn.iter().filter(within).collect();
        below = least;
        if found.is_empty() {
            continue;
        }
        let style = format!("class=\"used\" stroke=\"{colour}\" stroke-width=\"{}\"", fixed(width));
        sheet.canvas.group(&style, |canvas| {
            for it in &found {
                let joint = &model.joints[it.joint.index()];
                let name = names::joint(model, it.joint);
                canvas.line(frame.at(joint.from), frame.at(joint.to), &name);
            }
        });
        let text = format!("{name}: {}", marks::counted(found.len(), "joint"));
        sheet.line_entry(&text, colour, "3.2");
    }
}

fn draw_resultants(sheet: &mut Sheet, model: &Model, drawn: &[&JointForce], largest: f64) {
    let (frame, units) = (sheet.frame, InUnits(model.units));
    let (width, radius) =
        ((0.03 * sheet.brick).clamp(0.6, 2.0), (0.035 * sheet.brick).clamp(0.8, 2.8));
    let look = |radius: f64, colour: &str, inside: bool| {
        let fill = if inside { colour } else { "#ffffff" };
        let rim = fixed(0.45 * radius);
        format!("fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"{rim}\"")
    };
    let dot = |canvas: &mut Canvas, colour: &str, inside: bool| {
        canvas.circle(Pixel::new(0.0, 0.0), 2.8, &look(2.8, colour, inside));
    };
    for (presses, colour, name) in [(true, COMPRESSION, "pressing"), (false, TENSION, "pulling")] {
        let of_kind = || drawn.iter().filter(move |it| (it.normal > 0.0) == presses);
        let most = of_kind().map(|it| it.force.norm()).fold(0.0, f64::max);
        if most <= 0.0 {
            continue;
        }
        let style =
            format!("class=\"{name}\" stroke=\"{colour}\" stroke-width=\"{}\"", fixed(width));
        let identity = |it: &JointForce| names::joint(model, it.joint);
        let strokes: Vec<_> =
            of_kind().map(|it| (stroke(sheet, it, largest), identity(it))).collect();
        sheet.canvas.group(&style, |canvas| {
            for ([from, to], identity) in strokes {
                canvas.stroke(from, to, &identity);
            }
        });
        sheet.canvas.group(&format!("class=\"{name} points\""), |canvas| {
            for it in of_kind() {
                let attributes =
                    format!("{} {}", look(radius, colour, is_inside(it)), identity(it));
                canvas.circle(frame.at(it.at), radius, &attributes);
            }
        });
        let text = format!("resultant in a joint, {name}, up to {}", units.force_text(most));
        sheet.entry(&text, |symbol| {
            let style = format!("stroke=\"{colour}\" stroke-width=\"1.8\"");
            symbol.line(Pixel::new(-SYMBOL, 0.0), Pixel::new(SYMBOL, 0.0), &style);
            dot(symbol, colour, true);
        });
        let outside = of_kind().filter(|it| !is_inside(it)).count();
        if outside > 0 {
            let text = format!("outside the middle third: {}", marks::counted(outside, "joint"));
            sheet.entry(&text, |symbol| dot(symbol, colour, false));
        }
    }
}

fn is_inside(it: &JointForce) -> bool {
    it.eccentricity.abs() <= MIDDLE_THIRD
}

/// The ends of the stroke of a resultant: the largest is nearly as long as a brick.
fn stroke(sheet: &Sheet, it: &JointForce, largest: f64) -> [Pixel; 2] {
    let (at, half) = (sheet.frame.at(it.at), 0.45 * sheet.brick * it.force.norm() / largest);
    [-half, half].map(|half| at.shifted(it.force.x, -it.force.y, half))
}

/// The value of every resultant between blocks beside it, where there is room; supports have their reactions.
fn draw_values(
    sheet: &mut Sheet,
    model: &Model,
    drawn: &[&JointForce],
    units: InUnits,
    labels: &mut Labels,
) {
    let is_between_blocks =
        |it: &&&JointForce| matches!(model.joints[it.joint.index()].a, Body::Block(_));
    let frame = sheet.frame;
    sheet.canvas.group(&format!("class=\"values\" fill=\"{COMPRESSION}\""), |canvas| {
        for it in drawn.iter().filter(is_between_blocks) {
            let mut side = Vector2::new(it.force.y, -it.force.x).normalize();
            if side.x < 0.0 || (side.x < 1e-9 && side.y < 0.0) {
                side = -side;
            }
            let at = frame.at(it.at).shifted(side.x, -side.y, 5.0);
            labels.draw(canvas, at, side, 11.0, &units.force_text(it.force.norm()));
        }
    });
}
