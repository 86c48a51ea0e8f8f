//! Loads as arrows with their values: on edges, at places of blocks, and of all mass beside the structure.

use nalgebra::{Point2, Vector2};

use super::canvas::{Anchor, Canvas, Pixel};
use super::labels::Labels;
use super::marks;
use super::sheet::{Bounds, Frame, Margins, Sheet, label_room};
use super::style::TEXT;
use crate::geometry;
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
    edges: Vec<Group>,
    points: Vec<Force>,
    accelerations: Vec<Acceleration>,
}

/// A force at a place of a block.
#[derive(Debug)]
struct Force {
    at: Point2<f64>,
    value: Vector2<f64>,
    /// Where the arrow lies seen from the place: one that pulls at an edge begins there, all others end there.
    outwards: Vector2<f64>,
    /// Size relative to the largest force of the model.
    part: f64,
    label: String,
}

impl Force {
    fn length(&self) -> f64 {
        SHORTEST + (LONGEST - SHORTEST) * self.part
    }

    fn pulls(&self) -> bool {
        self.outwards.dot(&self.value) > 0.0
    }

    /// Tail and tip.
    fn arrow(&self, frame: &Frame) -> [Pixel; 2] {
        let (at, n) = (frame.at(self.at), self.outwards);
        let far = at.shifted(n.x, -n.y, self.length());
        if self.pulls() { [at, far] } else { [far, at] }
    }
}

/// An acceleration of all mass.
#[derive(Debug)]
struct Acceleration {
    value: Vector2<f64>,
    label: String,
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

/// Loads of one traction on edges in one line: they share a label.
#[derive(Debug)]
pub(super) struct Group {
    pieces: Vec<(Point2<f64>, Point2<f64>)>,
    traction: Vector2<f64>,
    /// Out of the loaded blocks.
    normal: Vector2<f64>,
    /// Size relative to the largest traction of the model.
    part: f64,
    label: String,
}

impl Group {
    fn length(&self) -> f64 {
        SHORTEST + (LONGEST - SHORTEST) * self.part
    }

    /// Whether the traction runs along the edge, so that arrows stand beside it.
    fn tangential(&self) -> bool {
        self.traction.dot(&self.normal).abs() < 0.2 * self.traction.norm()
    }
}

impl Loads {
    pub(super) fn of(model: &Model, units: InUnits) -> Self {
        let accelerations = model.accelerations.iter().filter(|it| it.value.norm() > 0.0);
        let acceleration = |value: Vector2<f64>| {
            let label = acceleration_text(value.norm());
            Acceleration { value, label }
        };
        Self {
            edges: groups(model),
            points: forces(model, units),
            accelerations: accelerations.map(|it| acceleration(it.value)).collect(),
        }
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
        let edges = self.edges.iter().map(|it| (it.normal, it.length(), &it.label));
        let points = self.points.iter().map(|it| (it.outwards, it.length(), &it.label));
        for (n, length, label) in edges.chain(points) {
            let reach = length + 12.0;
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
        for group in &self.edges {
            for (from, to) in group.pieces.iter().map(|(from, to)| (frame.at(*from), frame.at(*to)))
            {
                let bar = bar(group, from, to);
                for [from, to] in arrows(group, from, to).into_iter().chain(bar) {
                    labels.avoid(from, to);
                }
            }
        }
        for force in &self.points {
            let [tail, tip] = force.arrow(frame);
            labels.avoid(tail, tip);
        }
    }

    /// Draws arrows, labels where they do not collide, and legend entries.
    pub(super) fn draw(&self, sheet: &mut Sheet, model: &Model, labels: &mut Labels) {
        let frame = sheet.frame;
        sheet.canvas.group("class=\"loads\"", |canvas| {
            for group in &self.edges {
                for &(from, to) in &group.pieces {
                    draw_piece(canvas, group, frame.at(from), frame.at(to));
                }
            }
            for force in &self.points {
                let [tail, tip] = force.arrow(&frame);
                canvas.arrow(tail, tip, COLOUR);
                canvas.circle(frame.at(force.at), 2.2, &format!("fill=\"{COLOUR}\""));
            }
            self.draw_labels(canvas, &frame, labels);
        });
        if !self.accelerations.is_empty() {
            sheet.canvas.group("class=\"accelerations\"", |canvas| {
                self.draw_accelerations(canvas, &frame, marks::bounds(model));
            });
        }
        let units = InUnits(model.units);
        let tractions = self.edges.iter().map(|it| it.traction);
        entry(sheet, "edge load", tractions, stress_text, stress_text);
        let forces = self.points.iter().map(|it| it.value);
        let number = |value| significant(units.force(value), 4);
        entry(sheet, "point load", forces, number, |value| units.force_text(value));
        let accelerations = self.accelerations.iter().map(|it| it.value);
        let number = |value| significant(value, 4);
        entry(sheet, "body acceleration", accelerations, number, acceleration_text);
    }

    fn draw_labels(&self, canvas: &mut Canvas, frame: &Frame, labels: &mut Labels) {
        for group in &self.edges {
            let extent = Bounds::of(group.pieces.iter().flat_map(|&(from, to)| [from, to]));
            let middle = frame.at(nalgebra::center(&extent.low, &extent.high));
            let (n, t) = (group.normal, group.traction.normalize());
            let reach = if group.tangential() { 12.0 } else { group.length() * t.dot(&n).abs() };
            let at = middle.shifted(n.x, -n.y, reach + 5.0);
            labels.draw(canvas, at, n, TEXT, &group.label);
        }
        for force in &self.points {
            let n = force.outwards;
            let at = frame.at(force.at).shifted(n.x, -n.y, force.length() + 5.0);
            labels.draw(canvas, at, n, TEXT, &force.label);
        }
    }

    /// One below the other at half the height of the structure.
    fn draw_accelerations(&self, canvas: &mut Canvas, frame: &Frame, bounds: Bounds) {
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
                canvas.arrow(tail, middle.shifted(a.x, -a.y, 0.5 * LONGEST), COLOUR);
                let base = y + 0.5 * LONGEST + TEXT;
                canvas.rimmed_text(Pixel::new(x, base), Anchor::Middle, TEXT, &it.label);
                y += ACCELERATION_ROOM;
            }
        }
    }
}

/// All edge loads that are not zero, grouped.
fn groups(model: &Model) -> Vec<Group> {
    let near = 1e-9 * marks::bounds(model).diagonal();
    let mut groups: Vec<Group> = Vec::new();
    for block in &model.blocks {
        for load in block.edge_loads() {
            let (from, to) = loaded_part(block, load);
            let along = to - from;
            if load.traction.norm() == 0.0 || along.norm() == 0.0 {
                continue;
            }
            let normal = Vector2::new(along.y, -along.x).normalize();
            let same = groups.iter_mut().find(|group| {
                group.traction == load.traction
                    && group.normal.dot(&normal) > 1.0 - 1e-9
                    && (from - group.pieces[0].0).dot(&normal).abs() <= near
            });
            if let Some(group) = same {
                group.pieces.push((from, to));
            } else {
                let label = stress_text(load.traction.norm());
                let traction = load.traction;
                groups.push(Group { pieces: vec![(from, to)], traction, normal, part: 1.0, label });
            }
        }
    }
    let largest = groups.iter().map(|group| group.traction.norm()).fold(0.0, f64::max);
    for group in &mut groups {
        group.part = group.traction.norm() / largest;
    }
    groups
}

/// All forces at places of blocks that are not zero.
fn forces(model: &Model, units: InUnits) -> Vec<Force> {
    let mut forces: Vec<Force> = Vec::new();
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
            forces.push(Force { at, value: force, outwards, part: 1.0, label });
        }
    }
    let largest = forces.iter().map(|it| it.value.norm()).fold(0.0, f64::max);
    for it in &mut forces {
        it.part = it.value.norm() / largest;
    }
    forces
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

fn draw_piece(canvas: &mut Canvas, group: &Group, from: Pixel, to: Pixel) {
    for [tail, tip] in arrows(group, from, to) {
        canvas.arrow(tail, tip, COLOUR);
    }
    if let Some([from, to]) = bar(group, from, to) {
        canvas.line(from, to, &format!("stroke=\"{COLOUR}\" stroke-width=\"1\""));
    }
}

/// Tails and tips of the arrows on a loaded edge.
fn arrows(group: &Group, from: Pixel, to: Pixel) -> Vec<[Pixel; 2]> {
    let (t, n) = (group.traction, group.normal);
    let length = group.length();
    let mut count = 1.0;
    while from.distance(to) / (count + 1.0) > SPACING {
        count += 1.0;
    }
    let mut arrows = Vec::new();
    let mut index = 0.5;
    while index < count {
        let foot = from.between(to, index / count);
        arrows.push(if group.tangential() {
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
    arrows
}

/// The line that joins the tails of arrows which press.
fn bar(group: &Group, from: Pixel, to: Pixel) -> Option<[Pixel; 2]> {
    let t = group.traction;
    (t.dot(&group.normal) < 0.0 && !group.tangential())
        .then(|| [from, to].map(|end| end.shifted(-t.x, t.y, group.length())))
}
