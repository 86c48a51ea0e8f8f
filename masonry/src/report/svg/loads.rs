//! Loads as arrows with their values: on edges, at places of blocks, and of all mass beside the structure.

use nalgebra::{Point2, Vector2};

use super::canvas::{Anchor, Canvas, Pixel};
use super::labels::Labels;
use super::marks;
use super::names;
use super::sheet::{Bounds, Frame, Margins, Sheet, label_room};
use super::style::TEXT;
use crate::geometry;
use crate::ids::LoadId;
use crate::model::Model;
use crate::report::format::{InUnits, acceleration_text, significant, stress_text};
use crate::report::summary::loaded_part;

const COLOUR: &str = "#a02020";
const LONGEST: f64 = 32.0;
const SHORTEST: f64 = 12.0;
const SPACING: f64 = 24.0;
/// Height that an acceleration takes beside the structure: its arrow, its label and room between.
const ACCELERATION_ROOM: f64 = LONGEST + 2.0 * TEXT;

/// Everything that acts and is not zero.
#[derive(Debug)]
pub(super) struct Loads {
    edges: Vec<Push>,
    points: Vec<Push>,
    accelerations: Vec<Acceleration>,
}

/// A force at a place of a block, or the traction of a load on edges in one line, which share a label.
#[derive(Debug)]
struct Push {
    on: On,
    value: Vector2<f64>,
    /// Out of the loaded blocks; seen from the place of a force, to where its arrow lies: one that pulls at an edge begins
    /// there, all others end there.
    outwards: Vector2<f64>,
    /// Size relative to the largest one of its kind in the model.
    part: f64,
    label: String,
    /// The load of the scene that it is.
    load: LoadId,
}

/// Where a load acts.
#[derive(Debug)]
enum On {
    Edges(Vec<[Point2<f64>; 2]>),
    Place(Point2<f64>),
}

/// The arrows on an edge, and the line that joins the tails of those which press.
struct Strokes {
    arrows: Vec<[Pixel; 2]>,
    bar: Option<[Pixel; 2]>,
}

impl Push {
    fn length(&self) -> f64 {
        SHORTEST + (LONGEST - SHORTEST) * self.part
    }

    /// Whether a traction runs along the edge, so that arrows stand beside it.
    fn is_tangential(&self) -> bool {
        self.value.dot(&self.outwards).abs() < 0.2 * self.value.norm()
    }

    fn strokes(&self, frame: &Frame) -> Vec<Strokes> {
        match &self.on {
            On::Edges(pieces) => {
                pieces.iter().map(|ends| self.on_edge(ends.map(|end| frame.at(end)))).collect()
            }
            On::Place(at) => {
                let (at, n) = (frame.at(*at), self.outwards);
                let far = at.shifted(n.x, -n.y, self.length());
                let arrow = if n.dot(&self.value) > 0.0 { [at, far] } else { [far, at] };
                vec![Strokes { arrows: vec![arrow], bar: None }]
            }
        }
    }

    fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        for Strokes { arrows, bar } in self.strokes(frame) {
            for [tail, tip] in arrows {
                canvas.arrow(tail, tip, COLOUR);
            }
            if let Some([from, to]) = bar {
                canvas.line(from, to, &format!("stroke=\"{COLOUR}\" stroke-width=\"1\""));
            }
        }
        if let On::Place(at) = self.on {
            canvas.circle(frame.at(at), 2.2, &format!("fill=\"{COLOUR}\""));
        }
    }

    fn on_edge(&self, [from, to]: [Pixel; 2]) -> Strokes {
        let (t, n, length) = (self.value, self.outwards, self.length());
        let mut count = 1.0;
        while from.distance(to) / (count + 1.0) > SPACING {
            count += 1.0;
        }
        let mut arrows = Vec::new();
        let mut index = 0.5;
        while index < count {
            let foot = from.between(to, index / count);
            arrows.push(if self.is_tangential() {
                let middle = foot.shifted(n.x, -n.y, 7.0);
                let half = 0.5 * length.min(0.9 * from.distance(to));
                [middle.shifted(-t.x, t.y, half), middle.shifted(t.x, -t.y, half)]
            } else if t.dot(&n) < 0.0 {
                [foot.shifted(-t.x, t.y, length), foot]
            } else {
                [foot, foot.shifted(t.x, -t.y, length)]
            });
            index += 1.0;
        }
        let presses = t.dot(&n) < 0.0 && !self.is_tangential();
        let bar = presses.then(|| [from, to].map(|end| end.shifted(-t.x, t.y, length)));
        Strokes { arrows, bar }
    }

    /// Where a label is best.
    fn label_at(&self, frame: &Frame) -> Pixel {
        let (n, t) = (self.outwards, self.value.normalize());
        let (middle, reach) = match &self.on {
            On::Place(at) => (*at, self.length()),
            On::Edges(pieces) => {
                let extent = Bounds::of(pieces.iter().flatten().copied());
                let beside = self.length() * t.dot(&n).abs();
                let reach = if self.is_tangential() { 12.0 } else { beside };
                (nalgebra::center(&extent.low, &extent.high), reach)
            }
        };
        frame.at(middle).shifted(n.x, -n.y, reach + 5.0)
    }
}

/// An acceleration of all mass.
#[derive(Debug)]
struct Acceleration {
    value: Vector2<f64>,
    label: String,
    load: LoadId,
}

impl Acceleration {
    /// Whether it stands right of the structure: one to the left pushes from there.
    fn is_right(&self) -> bool {
        self.value.x < -0.5 * self.value.norm()
    }

    /// Room beside the structure.
    fn width(&self) -> f64 {
        label_room(&self.label).max(LONGEST) + 8.0
    }
}

impl Loads {
    pub(super) fn of(model: &Model, units: InUnits) -> Self {
        let accelerations = model.accelerations.iter().filter(|it| it.value.norm() > 0.0);
        let acceleration = |it: &crate::model::Acceleration| {
            let label = acceleration_text(it.value.norm());
            Acceleration { value: it.value, label, load: it.load }
        };
        Self {
            edges: tractions(model),
            points: forces(model, units),
            accelerations: accelerations.map(acceleration).collect(),
        }
    }

    fn pushes(&self) -> impl Iterator<Item = &Push> {
        self.edges.iter().chain(&self.points)
    }

    /// Room that arrows and labels need around the structure.
    pub(super) fn margins(&self) -> Margins {
        let mut margins = self.margins_of_forces();
        for it in &self.accelerations {
            let [left, right] = self.beside(it.is_right());
            margins.left = margins.left.max(left);
            margins.right = margins.right.max(right);
        }
        margins
    }

    /// Room beside the structure with accelerations on one side.
    fn beside(&self, is_right: bool) -> [f64; 2] {
        let on_side = self.accelerations.iter().filter(|it| it.is_right() == is_right);
        let width = on_side.map(Acceleration::width).fold(0.0, f64::max);
        let Margins { left, right, .. } = self.margins_of_forces();
        if is_right { [left, right + width] } else { [left + width, right] }
    }

    fn margins_of_forces(&self) -> Margins {
        let mut margins = Margins::HATCH;
        for it in self.pushes() {
            let (n, label) = (it.outwards, &it.label);
            let reach = it.length() + 12.0;
            let (beside, above) = (reach + label_room(label), reach + TEXT + 6.0);
            if n.x > 0.5 {
                margins.right = margins.right.max(beside);
            } else if n.x < -0.5 {
                margins.left = margins.left.max(beside);
            }
            if n.y > 0.5 {
                margins.top = margins.top.max(above);
            } else if n.y < -0.5 {
                margins.bottom = margins.bottom.max(above);
            }
        }
        margins
    }

    /// Keeps labels away from all arrows.
    pub(super) fn mark(&self, frame: &Frame, labels: &mut Labels) {
        for Strokes { arrows, bar } in self.pushes().flat_map(|it| it.strokes(frame)) {
            for [from, to] in arrows.into_iter().chain(bar) {
                labels.avoid(from, to);
            }
        }
    }

    /// Draws arrows, labels where they do not collide, and legend entries.
    pub(super) fn draw(&self, sheet: &mut Sheet, model: &Model, labels: &mut Labels) {
        let frame = sheet.frame;
        sheet.canvas.group("class=\"loads\"", |canvas| {
            for push in self.pushes() {
                canvas.group(&names::load(model, push.load), |canvas| push.draw(canvas, &frame));
            }
            for it in self.pushes() {
                canvas.group(&names::load(model, it.load), |canvas| {
                    labels.draw(canvas, it.label_at(&frame), it.outwards, TEXT, &it.label);
                });
            }
        });
        if !self.accelerations.is_empty() {
            sheet.canvas.group("class=\"accelerations\"", |canvas| {
                self.draw_accelerations(canvas, &frame, model);
            });
        }
        let units = InUnits(model.units);
        let tractions = self.edges.iter().map(|it| it.value);
        entry(sheet, "edge load", tractions, stress_text, stress_text);
        let forces = self.points.iter().map(|it| it.value);
        let number = |value| significant(units.force(value), 4);
        entry(sheet, "point load", forces, number, |value| units.force_text(value));
        let accelerations = self.accelerations.iter().map(|it| it.value);
        let number = |value| significant(value, 4);
        entry(sheet, "body acceleration", accelerations, number, acceleration_text);
    }

    /// One below the other at half the height of the structure.
    fn draw_accelerations(&self, canvas: &mut Canvas, frame: &Frame, model: &Model) {
        let bounds = marks::bounds(model);
        let Margins { left, right, .. } = self.margins_of_forces();
        let (low, high) = (frame.at(bounds.low), frame.at(bounds.high));
        for is_right in [false, true] {
            let on_side = || self.accelerations.iter().filter(move |it| it.is_right() == is_right);
            let rooms: f64 = on_side().map(|_| ACCELERATION_ROOM).sum();
            let mut y = 0.5 * (low.y + high.y - rooms) + 0.5 * LONGEST;
            for it in on_side() {
                let half = 0.5 * it.width();
                let x = if is_right { high.x + right + half } else { low.x - left - half };
                let (middle, a) = (Pixel::new(x, y), it.value);
                let tail = middle.shifted(-a.x, a.y, 0.5 * LONGEST);
                let base = y + 0.5 * LONGEST + TEXT;
                canvas.group(&names::load(model, it.load), |canvas| {
                    canvas.arrow(tail, middle.shifted(a.x, -a.y, 0.5 * LONGEST), COLOUR);
                    canvas.rimmed_text(Pixel::new(x, base), Anchor::Middle, TEXT, &it.label);
                });
                y += ACCELERATION_ROOM;
            }
        }
    }
}

/// All edge loads that are not zero, those of one load with one traction in one line together.
fn tractions(model: &Model) -> Vec<Push> {
    let near = 1e-9 * marks::bounds(model).diagonal();
    let mut list: Vec<Push> = Vec::new();
    for block in &model.blocks {
        for load in block.edge_loads() {
            let (from, to) = loaded_part(block, load);
            let along = to - from;
            if load.traction.norm() == 0.0 || along.norm() == 0.0 {
                continue;
            }
            let normal = Vector2::new(along.y, -along.x).normalize();
            let same = list.iter_mut().find_map(|it| match &mut it.on {
                On::Edges(pieces)
                    if it.load == load.load
                        && it.value == load.traction
                        && it.outwards.dot(&normal) > 1.0 - 1e-9
                        && (from - pieces[0][0]).dot(&normal).abs() <= near =>
                {
                    Some(pieces)
                }
                _ => None,
            });
            if let Some(pieces) = same {
                pieces.push([from, to]);
            } else {
                let (on, value) = (On::Edges(vec![[from, to]]), load.traction);
                let label = stress_text(value.norm());
                list.push(Push { on, value, outwards: normal, part: 1.0, label, load: load.load });
            }
        }
    }
    in_parts(list)
}

/// All forces at places of blocks that are not zero.
fn forces(model: &Model, units: InUnits) -> Vec<Push> {
    let mut list: Vec<Push> = Vec::new();
    for block in &model.blocks {
        for load in block.point_loads().filter(|load| load.force.norm() > 0.0) {
            let (at, force) = (load.at, load.force);
            let near = 1e-9 * geometry::size(&block.corners);
            let pulls = (0..block.corners.len())
                .map(|k| (block.corners[k], geometry::outward_normal(&block.corners, k)))
                .any(|(corner, normal)| {
                    (at - corner).dot(&normal) > -near && force.dot(&normal) > 0.0
                });
            let outwards = if pulls { force.normalize() } else { -force.normalize() };
            let label = units.force_text(force.norm());
            let (on, load) = (On::Place(at), load.load);
            list.push(Push { on, value: force, outwards, part: 1.0, label, load });
        }
    }
    in_parts(list)
}

/// Sizes relative to the largest.
fn in_parts(mut list: Vec<Push>) -> Vec<Push> {
    let largest = list.iter().map(|it| it.value.norm()).fold(0.0, f64::max);
    for it in &mut list {
        it.part = it.value.norm() / largest;
    }
    list
}

/// The legend entry of these loads, if there are any.
fn entry(
    sheet: &mut Sheet,
    name: &str,
    loads: impl Iterator<Item = Vector2<f64>> + Clone,
    number: impl Fn(f64) -> String,
    with_unit: impl Fn(f64) -> String,
) {
    let sizes = loads.clone().map(|it| it.norm());
    let most = sizes.clone().fold(0.0, f64::max);
    let least = sizes.fold(f64::INFINITY, f64::min);
    let Some(first) = loads.clone().next().filter(|_| most > 0.0) else { return };
    // Their direction, if they have one.
    let is_one = loads.map(|it| it.normalize()).all(|it| it.dot(&first.normalize()) > 1.0 - 1e-9);
    let way = if is_one { first } else { Vector2::new(0.0, -1.0) };
    let text = if least < most {
        format!("{name}s, {} to {}", number(least), with_unit(most))
    } else {
        format!("{name}, {}", with_unit(most))
    };
    sheet.entry(&text, |symbol| {
        let middle = Pixel::new(0.0, 0.0);
        symbol.arrow(
            middle.shifted(-way.x, way.y, 10.0),
            middle.shifted(way.x, -way.y, 10.0),
            COLOUR,
        );
    });
}
