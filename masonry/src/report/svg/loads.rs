//! Edge loads as arrows with their values.

use nalgebra::{Point2, Vector2};

use super::canvas::{Anchor, Canvas, Pixel, text_width};
use super::marks;
use super::sheet::{Bounds, Frame, Margins, Sheet, label_room};
use crate::model::Model;
use crate::report::format::{InUnits, significant};
use crate::report::summary::loaded_part;

const COLOUR: &str = "#a02020";
const LONGEST: f64 = 32.0;
const SHORTEST: f64 = 12.0;
const SPACING: f64 = 24.0;
const LABEL_SIZE: f64 = 13.0;

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

/// All edge loads that are not zero, grouped.
pub(super) fn groups(model: &Model, units: InUnits) -> Vec<Group> {
    let near = 1e-9 * marks::bounds(model).diagonal();
    let mut groups: Vec<Group> = Vec::new();
    for block in &model.blocks {
        for load in &block.edge_loads {
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
                let label = units.stress_text(load.traction.norm());
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

/// Room that arrows and labels need around the structure.
pub(super) fn margins(groups: &[Group]) -> Margins {
    let mut margins = Margins::HATCH;
    for group in groups {
        let (n, reach) = (group.normal, group.length() + 12.0);
        let (beside, above) = (reach + label_room(&group.label), reach + LABEL_SIZE + 6.0);
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

/// Draws arrows, labels where they do not collide, and the legend entry.
pub(super) fn draw(sheet: &mut Sheet, model: &Model, groups: &[Group]) {
    let frame = sheet.frame;
    sheet.canvas.group("class=\"loads\"", |canvas| {
        for group in groups {
            for &(from, to) in &group.pieces {
                draw_piece(canvas, group, frame.at(from), frame.at(to));
            }
        }
        draw_labels(canvas, &frame, groups);
    });
    let sizes = || groups.iter().map(|group| group.traction.norm());
    let (least, most) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    if groups.is_empty() {
        return;
    }
    let units = InUnits(model.units);
    let text = if least < most {
        let least = significant(units.stress(least), 4);
        format!("edge loads, {least} to {}", units.stress_text(most))
    } else {
        format!("edge load, {}", units.stress_text(most))
    };
    sheet.entry(&text, |symbol| {
        symbol.arrow(Pixel::new(0.0, -10.0), Pixel::new(0.0, 10.0), COLOUR);
    });
}

fn draw_piece(canvas: &mut Canvas, group: &Group, from: Pixel, to: Pixel) {
    let (t, n) = (group.traction, group.normal);
    let length = group.length();
    let mut count = 1.0;
    while from.distance(to) / (count + 1.0) > SPACING {
        count += 1.0;
    }
    let mut index = 0.5;
    while index < count {
        let foot = from.between(to, index / count);
        let (tail, tip) = if group.tangential() {
            let middle = foot.shifted(n.x, -n.y, 7.0);
            let half = 0.5 * length.min(0.9 * from.distance(to));
            (middle.shifted(-t.x, t.y, half), middle.shifted(t.x, -t.y, half))
        } else if t.dot(&n) < 0.0 {
            (foot.shifted(-t.x, t.y, length), foot)
        } else {
            (foot, foot.shifted(t.x, -t.y, length))
        };
        canvas.arrow(tail, tip, COLOUR);
        index += 1.0;
    }
    if t.dot(&n) < 0.0 && !group.tangential() {
        let bar = [from, to].map(|end| end.shifted(-t.x, t.y, length));
        canvas.line(bar[0], bar[1], &format!("stroke=\"{COLOUR}\" stroke-width=\"1\""));
    }
}

fn draw_labels(canvas: &mut Canvas, frame: &Frame, groups: &[Group]) {
    let mut taken: Vec<[f64; 4]> = Vec::new();
    for group in groups {
        let extent = Bounds::of(group.pieces.iter().flat_map(|&(from, to)| [from, to]));
        let middle = frame.at(nalgebra::center(&extent.low, &extent.high));
        let (n, t) = (group.normal, group.traction.normalize());
        let reach = if group.tangential() { 12.0 } else { group.length() * t.dot(&n).abs() };
        let at = middle.shifted(n.x, -n.y, reach + 8.0);
        let width = text_width(&group.label, LABEL_SIZE);
        let (anchor, left) = if n.x > 0.5 {
            (Anchor::Start, at.x)
        } else if n.x < -0.5 {
            (Anchor::End, at.x - width)
        } else {
            (Anchor::Middle, at.x - 0.5 * width)
        };
        let base = at.y + 0.36 * LABEL_SIZE - n.y * 0.36 * LABEL_SIZE;
        let rectangle = [left, base - LABEL_SIZE, left + width, base];
        if !taken.iter().any(|other| overlap(&rectangle, other)) {
            canvas.rimmed_text(Pixel::new(at.x, base), anchor, LABEL_SIZE, &group.label);
            taken.push(rectangle);
        }
    }
}

fn overlap(one: &[f64; 4], other: &[f64; 4]) -> bool {
    one[0] < other[2] && other[0] < one[2] && one[1] < other[3] && other[1] < one[3]
}
