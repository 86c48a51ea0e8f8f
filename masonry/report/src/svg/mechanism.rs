//! The motion by which a structure without equilibrium collapses, with its hinges and sliding joints.

use nalgebra::Vector2;

use super::arrows::{Arrows, Displaced, Growth, Pushed};
use super::canvas::{Canvas, Pixel, closed, open};
use super::deformed::moved;
use super::labels::{Label, Labels};
use super::legend;
use super::motion::Motion;
use super::names;
use super::sheet::{Bounds, Sheet};
use super::structure::{self, counted};
use super::style::{HINGE, LARGEST_BRICK};
use crate::format::significant;
use crate::hinges::{Yield, YieldingJoint, yielding};
use masonry::geometry::cross;
use masonry::model::Model;
use masonry::rounding::largest;
use masonry::verify::moving::{SLOW, speed};

/// Blocks whose rates are below this part of the fastest rate are drawn as at rest.
const AT_REST: f64 = 1e-6;
/// The largest number of hinges and sliding joints that are numbered. In a mechanism with more, numbers would hide the
/// structure, and slow joints have no marks.
const NUMBERED: usize = 48;

/// A mechanism, and the loads in its picture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Collapse<'a> {
    pub(crate) title: &'a str,
    pub(crate) model: &'a Model,
    /// Displacement rates of the corners of every block.
    pub(crate) rates: &'a [Vec<Vector2<f64>>],
    /// The load group that grows, if the mechanism is that of a limit load.
    pub(crate) growth: Option<Growth<'a>>,
}

/// Draws the structure displaced along `rates`, the displacement rates of the corners of every block, over its outline,
/// with its loads. Only ratios between rates have a meaning, so that the picture has no displacement scale. Hinges and
/// sliding joints are marked and, if they are few, numbered in the order of the joints.
pub fn mechanism(title: &str, model: &Model, rates: &[Vec<Vector2<f64>>]) -> String {
    collapse(&Collapse { title, model, rates, growth: None }, false)
}

/// Draws the picture of [`mechanism`]; a page can change the amplitude.
pub(crate) fn collapse(collapse: &Collapse<'_>, for_page: bool) -> String {
    let Collapse { title, model, rates, growth } = *collapse;
    let fastest = largest(rates.iter().map(|rate| speed(rate)));
    let still = structure::bounds(model);
    let motion = Motion::seen(fastest, &still, for_page);
    let blocks = model.blocks.iter().zip(rates);
    let furthest = blocks.flat_map(|(block, rate)| moved(&block.corners, rate, motion.furthest()));
    let bounds = Bounds::of(furthest.chain(still.ends()));
    let loads = Arrows::of_loads(model, growth);
    let mut sheet = Sheet::new(format!("{title}: mechanism"), model, bounds, loads.margins());
    structure::outlines(&mut sheet, "undeformed", &model.blocks);
    draw_blocks(&mut sheet, collapse, motion, fastest);
    structure::supports(&mut sheet, model, Motion::NONE);
    if for_page {
        sheet.tell("amplitude", "1");
    }
    let mut labels = Labels::within(sheet.room);
    let joints = yielding(model, rates);
    draw_yielding(&mut sheet, model, &joints, motion, &mut labels);
    let rate = |on: &Pushed| rate_of(collapse, on);
    loads.draw(&mut sheet, model, &mut labels, &Displaced { motion, rate: &rate });
    // A growing weight has no arrow whose label could show the load factor.
    let has_arrow = |it: &Growth<'_>| model.loads.iter().any(|load| load.group == it.group);
    if let Some(Growth { group, factor }) = growth.filter(|it| !has_arrow(it)) {
        let factor = significant(factor, 4);
        sheet.legend.note(&format!("factor of \"{group}\" {factor}"));
    }
    sheet.legend.note("amplitude is arbitrary");
    sheet.finish()
}

/// Draws blocks in colours by speed, the fastest on top, and writes the number of moving blocks.
fn draw_blocks(sheet: &mut Sheet, collapse: &Collapse<'_>, motion: Motion, fastest: f64) {
    let Collapse { model, rates, .. } = *collapse;
    let kind = |rate: &[Vector2<f64>]| match speed(rate) {
        it if it <= AT_REST * fastest => 0,
        it if it < SLOW * fastest => 1,
        _ => 2,
    };
    let slow = format!("slower than {} % of the fastest", 100.0 * SLOW);
    let kinds = [("still", "at rest"), ("slow", slow.as_str()), ("moving", "moving")];
    for (index, (class, name)) in kinds.into_iter().enumerate() {
        let all = model.blocks.iter().zip(rates);
        let own: Vec<_> = all.filter(|(_, rate)| kind(rate) == index).collect();
        if own.is_empty() {
            continue;
        }
        sheet.layer(class, |canvas, frame| {
            for (block, rate) in &own {
                motion.path(canvas, &names::block(block), |factor| {
                    closed(moved(&block.corners, rate, factor).map(|corner| frame.at(corner)))
                });
            }
        });
        let text = format!("{name}: {}", counted(own.len(), "block"));
        sheet.legend.add(&text, class, legend::block);
    }
}

/// Draws marks of hinges and sliding joints at their displaced places, with their numbers.
fn draw_yielding(
    sheet: &mut Sheet,
    model: &Model,
    joints: &[YieldingJoint],
    motion: Motion,
    labels: &mut Labels,
) {
    let numbered: Vec<&YieldingJoint> = joints.iter().filter(|it| it.number.is_some()).collect();
    let has_numbers = numbered.len() <= NUMBERED;
    let is_marked = |it: &&YieldingJoint| has_numbers || it.opens.max(it.slides) >= SLOW;
    let mark = |it: &YieldingJoint| Mark {
        does: it.does,
        at: sheet.frame.at(it.at + it.rate * motion.factor),
        along: model.joints[it.joint.index()].tangent(),
        radius: HINGE * sheet.marks(),
        number: it.number.map_or_else(String::new, |it| it.to_string()),
        name: names::joint(model, it.joint) + &motion.of_mark(&sheet.frame, it.rate),
    };
    let marks: Vec<Mark> = numbered.iter().copied().filter(is_marked).map(mark).collect();
    for mark in &marks {
        labels.avoid(mark.ends());
    }
    for (does, name) in [(Yield::Hinge, "hinge"), (Yield::Slides, "sliding")] {
        let count = joints.iter().filter(|it| it.does == does).count();
        if count == 0 {
            continue;
        }
        let own = marks.iter().filter(|mark| mark.does == does);
        sheet.layer(does.name(), |canvas, _| own.for_each(|mark| mark.draw(canvas)));
        let text = format!("{name}: {}", counted(count, "joint"));
        sheet.legend.add(&text, does.name(), |symbol| Mark::symbol(does).draw(symbol));
    }
    if has_numbers {
        sheet.layer("labels", |canvas, _| {
            for Mark { at, along, radius, number, name, .. } in &marks {
                let up = Vector2::new(-along.y, along.x);
                let side = if up.y < 0.0 { -up } else { up };
                let at = at.along(side, radius + 2.0);
                labels.draw(canvas, &Label { text: number, size: 12.0, at, side, name });
            }
        });
    }
    let (unmarked, apart) = (numbered.len() - marks.len(), joints.len() - numbered.len());
    if unmarked > 0 {
        let count = counted(unmarked, "joint");
        let slow = 100.0 * SLOW;
        sheet.legend.note(&format!("no mark: {count}, slower than {slow} % of the fastest"));
    }
    if apart > 0 {
        sheet.legend.note(&format!("coming apart: {}", counted(apart, "joint")));
    }
    if joints.iter().any(|it| it.dilates) {
        sheet.legend.note("associated flow: joints that slide also open, by mu times the slip");
    }
}

/// The mark of a joint that yields.
struct Mark {
    does: Yield,
    at: Pixel,
    /// The unit vector along the joint.
    along: Vector2<f64>,
    radius: f64,
    number: String,
    /// SVG attributes of the elements of the mark.
    name: String,
}

impl Mark {
    /// Returns the mark of a horizontal joint for the legend.
    fn symbol(does: Yield) -> Self {
        let (number, name) = (String::new(), String::new());
        let (at, radius) = (Pixel::new(0.0, 0.0), HINGE * LARGEST_BRICK);
        Self { does, at, along: Vector2::x(), radius, number, name }
    }

    /// Returns the ends of the mark along the joint.
    fn ends(&self) -> [Pixel; 2] {
        let half = if self.does == Yield::Hinge { self.radius } else { 2.2 * self.radius };
        [-half, half].map(|half| self.at.along(self.along, half))
    }

    /// Draws a ring for a hinge, and a line with half arrows on both sides for a sliding joint.
    fn draw(&self, canvas: &mut Canvas) {
        let radius = self.radius;
        if self.does == Yield::Hinge {
            return canvas.circle(self.at, radius, &self.name);
        }
        let half_arrow = |[from, to]: [Pixel; 2]| {
            let along = from.towards(to);
            let across = Vector2::new(along.y, -along.x);
            let [start, tip] = [from, to].map(|it| it.along(across, 0.45 * radius));
            open([start, tip, to.along(across, 1.3 * radius).along(-along, 1.3 * radius)])
        };
        let [from, to] = self.ends();
        canvas.path(&(half_arrow([from, to]) + &half_arrow([to, from])), &self.name);
    }
}

/// Returns the displacement rate of the point at which a load acts; the point turns with its block.
fn rate_of(collapse: &Collapse<'_>, on: &Pushed) -> Vector2<f64> {
    let Some(block) = on.block else { return Vector2::zeros() };
    let corners = &collapse.model.blocks[block.index()].corners;
    let rates = &collapse.rates[block.index()];
    let edge = corners[1] - corners[0];
    let turn = cross(edge, rates[1] - rates[0]) / edge.norm_squared();
    let arm = nalgebra::center(&on.ends[0], &on.ends[1]) - corners[0];
    rates[0] + Vector2::new(-arm.y, arm.x) * turn
}
