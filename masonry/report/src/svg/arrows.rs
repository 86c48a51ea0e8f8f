//! Loads and reactions as arrows with their values: on edges, at points, and, for accelerations of all mass, beside the
//! structure.

use nalgebra::{Point2, Vector2};

use super::canvas::{Anchor, Canvas, Pixel, arrow, open, parts, turning};
use super::labels::{Label, Labels};
use super::motion::Motion;
use super::names;
use super::sheet::{Bounds, Frame, Sheet, Sides, label_room};
use super::structure;
use super::style::TEXT;
use crate::format::{InUnits, acceleration_text, significant, stress_text};
use crate::joints::{self, JointForce};
use crate::summary::loaded_part;
use masonry::geometry;
use masonry::ids::{BlockId, LoadId};
use masonry::model::{Model, PlacedBlock, PointLoad};
use masonry::rounding::largest;

/// Lengths of the arrow of the largest load of a kind (`LONGEST`), and of a load that is small compared with the
/// largest (`SHORTEST`).
const LONGEST: f64 = 34.0;
const SHORTEST: f64 = 14.0;
/// Largest distance between arrows on an edge, and distance from an edge to arrows that are parallel to the edge.
const SPACING: f64 = 24.0;
const ASIDE: f64 = 7.0;
/// Height of an acceleration beside the structure: arrow, label, and the room between accelerations.
const ROW: f64 = LONGEST + 2.0 * TEXT;
/// The beginning of the label of a load that is not uniform: the label shows the largest value.
const UP_TO: &str = "up to ";
/// Forces of joints and supports below this part of the largest are not drawn.
pub(super) const LEAST: f64 = 1e-6;

/// The group of loads that grows, and its load factor in a picture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Growth<'a> {
    pub(crate) group: &'a str,
    pub(crate) factor: f64,
}

/// The target of a load: a part of an edge of a block, or a point, which is then both ends. `block` is `None` for
/// reactions, which do not act on a single block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pushed {
    pub(super) block: Option<BlockId>,
    pub(super) ends: [Point2<f64>; 2],
    /// The tractions at both ends of the part of the edge, or twice the force at the point.
    values: [Vector2<f64>; 2],
}

impl Pushed {
    fn at_place(block: Option<BlockId>, place: Point2<f64>, value: Vector2<f64>) -> Self {
        Self { block, ends: [place; 2], values: [value; 2] }
    }

    fn is_uniform(&self) -> bool {
        self.values[0] == self.values[1]
    }

    /// Returns the larger of the values at both ends.
    fn largest(&self) -> Vector2<f64> {
        let [first, last] = self.values;
        if first.norm() < last.norm() { last } else { first }
    }
}

/// A load or a reaction whose arrows share a label. A moment has an arrow around its point.
#[derive(Debug)]
struct Push {
    /// The parts of edges on one straight line, or one point, on which the load acts; empty for an acceleration of all
    /// mass.
    on: Vec<Pushed>,
    /// The largest value of the load.
    value: Vector2<f64>,
    /// Direction away from the pushed blocks, or from a point to its arrow.
    outwards: Vector2<f64>,
    /// The sign of a moment, counter-clockwise positive; `None` for a force.
    turn: Option<f64>,
    /// The text of the largest value.
    label: String,
    /// SVG attributes of the arrows and the label.
    name: String,
    /// The largest value, divided by the largest value of all pushes of the same kind.
    part: f64,
}

/// Pushes of one kind, which share an entry in the legend.
#[derive(Debug)]
struct Kind {
    names: [&'static str; 2],
    class: &'static str,
    pushes: Vec<Push>,
}

/// The displacement of pushed blocks in a picture \[m\]: `rate`, magnified by `motion`.
pub(super) struct Displaced<'a> {
    pub(super) motion: Motion,
    pub(super) rate: &'a dyn Fn(&Pushed) -> Vector2<f64>,
}

impl Displaced<'_> {
    /// No displacement: the blocks stay in their places.
    pub(super) const NOT: Displaced<'static> =
        Displaced { motion: Motion::NONE, rate: &|_| Vector2::new(0.0, 0.0) };

    fn ends(&self, frame: &Frame, on: &Pushed) -> [Pixel; 2] {
        let movement = (self.rate)(on) * self.motion.factor;
        on.ends.map(|end| frame.at(end + movement))
    }

    fn name(&self, frame: &Frame, push: &Push, on: &Pushed) -> String {
        push.name.clone() + &self.motion.of_mark(frame, (self.rate)(on))
    }
}

impl Push {
    fn length(&self) -> f64 {
        SHORTEST + (LONGEST - SHORTEST) * self.part
    }

    /// Returns the cosine of the angle between the value and the outward direction.
    fn outward_part(&self) -> f64 {
        self.value.normalize().dot(&self.outwards)
    }

    /// Whether a traction is nearly parallel to the edge, so that its arrows stand beside the edge.
    fn is_tangential(&self) -> bool {
        self.outward_part().abs() < 0.2
    }

    /// Returns the arrows on a part of an edge, or at a point.
    fn arrows(&self, on: &Pushed, [from, to]: [Pixel; 2]) -> Vec<[Pixel; 2]> {
        let count = parts([from, to], SPACING).saturating_sub(1).max(1);
        let arrow = |at: f64| {
            let (foot, t) = (from.between(to, at), on.values[0].lerp(&on.values[1], at));
            let length = self.length_of(t);
            if self.is_tangential() {
                let middle = foot.along(self.outwards, ASIDE);
                let half = 0.5 * length.min(0.9 * from.distance(to));
                [middle.along(-t, half), middle.along(t, half)]
            } else if t.dot(&self.outwards) < 0.0 {
                [foot.along(-t, length), foot]
            } else {
                [foot, foot.along(t, length)]
            }
        };
        (0..count).map(|k| arrow((f64::from(k) + 0.5) / f64::from(count))).collect()
    }

    /// Returns the length of an arrow, proportional to its value.
    fn length_of(&self, value: Vector2<f64>) -> f64 {
        self.length() * (value.norm() / self.value.norm())
    }

    /// Returns the line that joins the tails of arrows that press on an edge.
    fn bar(&self, on: &Pushed, ends: [Pixel; 2]) -> Option<[Pixel; 2]> {
        let presses = on.values.iter().all(|it| it.dot(&self.outwards) <= 0.0);
        let tails = [0, 1].map(|k| ends[k].along(-on.values[k], self.length_of(on.values[k])));
        (presses && !self.is_tangential() && ends[0] != ends[1]).then_some(tails)
    }

    fn draw(&self, canvas: &mut Canvas, frame: &Frame, displaced: &Displaced<'_>) {
        for on in &self.on {
            let ends = displaced.ends(frame, on);
            let arrows: String = match self.turn {
                Some(sign) => turning(ends[0], 0.5 * self.length(), sign),
                None => self.arrows(on, ends).into_iter().map(arrow).collect(),
            };
            let bar = self.bar(on, ends).map_or_else(String::new, open);
            canvas.group(&displaced.name(frame, self, on), |canvas| {
                canvas.path(&(arrows + &bar), "");
                if ends[0] == ends[1] {
                    canvas.circle(ends[0], 1.8, "");
                }
            });
        }
    }

    /// Returns the place at which the label is tried first.
    fn label_at(&self, frame: &Frame, displaced: &Displaced<'_>) -> Pixel {
        let ends = self.on.iter().flat_map(|on| displaced.ends(frame, on));
        let extent = Bounds::of(ends.map(|it| Point2::new(it.x, it.y))).middle();
        let beside = self.length() * self.outward_part().abs();
        let reach = if self.is_tangential() { ASIDE + 5.0 } else { beside };
        Pixel::new(extent.x, extent.y).along(self.outwards, reach + 5.0)
    }

    /// Returns the room for arrows and label around the structure.
    fn margins(&self) -> Sides {
        let (n, length) = (self.outwards, self.length() + 14.0);
        let beside = |part: f64| if part > 0.5 { length + label_room(&self.label) } else { 0.0 };
        let above = |part: f64| if part > 0.0 { length * part + TEXT + 6.0 } else { 0.0 };
        Sides { left: beside(-n.x), right: beside(n.x), top: above(n.y), bottom: above(-n.y) }
    }

    /// Whether an acceleration is drawn right of the structure: an acceleration to the left pushes from the right.
    fn is_right(&self) -> bool {
        self.value.x < -0.5 * self.value.norm()
    }

    /// Returns the width of an acceleration beside the structure.
    fn width(&self) -> f64 {
        label_room(&self.label).max(LONGEST) + 8.0
    }
}

impl Kind {
    fn new(names: [&'static str; 2], class: &'static str, mut pushes: Vec<Push>) -> Self {
        pushes.retain(|it| it.value.norm() > 0.0);
        let sizes: Vec<f64> = pushes.iter().map(|it| it.value.norm()).collect();
        let most = largest(&sizes);
        pushes.iter_mut().zip(sizes).for_each(|(it, size)| it.part = size / most);
        Self { names, class, pushes }
    }

    /// Adds the legend entry: the least and the largest value, and an arrow in the direction of all pushes, if they
    /// have one direction.
    fn explain(&self, sheet: &mut Sheet) {
        let by_size = |a: &&Push, b: &&Push| a.part.total_cmp(&b.part);
        let ends = self.pushes.iter().min_by(by_size).zip(self.pushes.iter().max_by(by_size));
        let Some((least, most)) = ends else { return };
        let [one, many] = self.names;
        let text = if least.label == most.label {
            format!("{one}, {}", most.label)
        } else {
            let [least, most] = [least, most].map(|it| it.label.trim_start_matches(UP_TO));
            format!("{many}, {least} to {most}")
        };
        let way = most.value.normalize();
        let is_one = self.pushes.iter().all(|it| it.value.normalize().dot(&way) > 1.0 - 1e-9);
        let way = if is_one { way } else { -Vector2::y() };
        let middle = Pixel::new(0.0, 0.0);
        sheet.legend.add(&text, self.class, |symbol| {
            symbol.path(&arrow([-10.0, 10.0].map(|it| middle.along(way, it))), "");
        });
    }
}

/// The arrows of all loads of a picture, and of reactions.
#[derive(Debug)]
pub(super) struct Arrows(Vec<Kind>);

impl Arrows {
    /// Returns the arrows of the loads that are not zero; labels of the growing group have its load factor in addition.
    pub(super) fn of_loads(model: &Model, growth: Option<Growth<'_>>) -> Self {
        let labelled = |load: LoadId, value: String| {
            let group = model.loads.get(load.index()).map(|it| it.group.as_str());
            match growth.filter(|it| Some(it.group) == group) {
                Some(it) => format!("{value} (factor {})", significant(it.factor, 4)),
                None => value,
            }
        };
        let acceleration = |it: &masonry::model::Acceleration| Push {
            on: Vec::new(),
            value: it.value,
            outwards: Vector2::zeros(),
            turn: None,
            label: labelled(it.load, acceleration_text(it.value.norm())),
            name: names::load(model, it.load),
            part: 1.0,
        };
        let accelerations = model.accelerations.iter().map(acceleration).collect();
        Self(vec![
            Kind::new(["edge load", "edge loads"], "loads", tractions(model, &labelled)),
            Kind::new(["point load", "point loads"], "loads", forces(model, &labelled)),
            Kind::new(["moment", "moments"], "loads", moments(model, &labelled)),
            Kind::new(["body acceleration", "body accelerations"], "accelerations", accelerations),
        ])
    }

    /// Adds the reactions of supports to the arrows.
    pub(super) fn and_reactions(mut self, model: &Model, forces: &[JointForce]) -> Self {
        let units = InUnits(model.units);
        let mut all = joints::reactions(model, forces);
        let sizes: Vec<f64> = all.iter().map(|it| it.force.norm()).collect();
        all.retain(|it| it.force.norm() > LEAST * largest(&sizes));
        let push = |it: joints::SupportForce| Push {
            on: vec![Pushed::at_place(None, it.at, it.force)],
            value: it.force,
            outwards: -it.force.normalize(),
            turn: None,
            label: units.force_text(it.force.norm()),
            name: names::support(&model.supports[it.support.index()]),
            part: 1.0,
        };
        let pushes = all.into_iter().map(push).collect();
        self.0.push(Kind::new(
            ["reaction of a support", "reactions of supports"],
            "reactions",
            pushes,
        ));
        self
    }

    fn pushes(&self) -> impl Iterator<Item = &Push> {
        self.0.iter().flat_map(|kind| &kind.pushes)
    }

    /// Returns the room that arrows and labels need around the structure.
    pub(super) fn margins(&self) -> Sides {
        let on_blocks = self.pushes().filter(|it| !it.on.is_empty()).map(Push::margins);
        let mut margins = on_blocks.fold(Sides::HATCH, Sides::and);
        margins.left += self.beside(false);
        margins.right += self.beside(true);
        margins
    }

    /// Returns the accelerations on one side of the structure.
    fn accelerations(&self, is_right: bool) -> impl Iterator<Item = &Push> {
        self.pushes().filter(move |it| it.on.is_empty() && it.is_right() == is_right)
    }

    /// Returns the room for the accelerations on one side of the structure.
    fn beside(&self, is_right: bool) -> f64 {
        largest(self.accelerations(is_right).map(Push::width))
    }

    /// Draws arrows, labels that do not collide, and legend entries.
    pub(super) fn draw(
        &self,
        sheet: &mut Sheet,
        model: &Model,
        labels: &mut Labels,
        displaced: &Displaced<'_>,
    ) {
        structure::avoid_supports(&sheet.frame, model, labels);
        for Kind { class, pushes, .. } in self.0.iter().filter(|kind| !kind.pushes.is_empty()) {
            sheet.layer(class, |canvas, frame| {
                for push in pushes {
                    push.draw(canvas, frame, displaced);
                }
            });
            for push in pushes {
                let strokes = push.on.iter().flat_map(|on| {
                    let ends = displaced.ends(&sheet.frame, on);
                    push.arrows(on, ends).into_iter().chain(push.bar(on, ends))
                });
                strokes.for_each(|stroke| labels.avoid(stroke));
            }
        }
        for Kind { class, pushes, .. } in self.0.iter().filter(|kind| !kind.pushes.is_empty()) {
            sheet.layer(&format!("{class} labels"), |canvas, frame| {
                for it in pushes.iter().filter(|it| !it.on.is_empty()) {
                    let (at, side) = (it.label_at(frame, displaced), it.outwards);
                    let name = displaced.name(frame, it, &it.on[0]);
                    labels.draw(
                        canvas,
                        &Label { text: &it.label, size: TEXT, at, side, name: &name },
                    );
                }
            });
        }
        self.draw_accelerations(sheet, model);
        self.0.iter().for_each(|kind| kind.explain(sheet));
    }

    /// Draws accelerations outside all other marks, one below the other at half the height of the structure.
    fn draw_accelerations(&self, sheet: &mut Sheet, model: &Model) {
        let margins = self.margins();
        let [low, high] = structure::bounds(model).ends().map(|end| sheet.frame.at(end));
        for is_right in [false, true] {
            let half = 0.5 * self.beside(is_right);
            let x =
                if is_right { high.x + margins.right - half } else { low.x - margins.left + half };
            let count = self.accelerations(is_right).count() as f64;
            let mut middle = Pixel::new(x, 0.5 * (low.y + high.y - count * ROW + LONGEST));
            for it in self.accelerations(is_right) {
                let ends = [-0.5, 0.5].map(|part| middle.along(it.value, part * LONGEST));
                sheet.layer("accelerations", |canvas, _| {
                    canvas.group(&it.name, |canvas| canvas.path(&arrow(ends), ""));
                });
                let base = Pixel::new(x, middle.y + 0.5 * LONGEST + TEXT);
                sheet.layer("accelerations labels", |canvas, _| {
                    canvas.text(base, Anchor::Middle, TEXT, &it.name, &it.label);
                });
                middle.y += ROW;
            }
        }
    }
}

/// Returns all loads on edges. Parts of one load are joined into one push if they have one traction on one straight
/// line, or if they are linear on one straight line or in one direction.
fn tractions(model: &Model, labelled: &dyn Fn(LoadId, String) -> String) -> Vec<Push> {
    let near = 1e-9 * structure::bounds(model).size().norm();
    let mut list: Vec<(LoadId, Push)> = Vec::new();
    for (index, block) in model.blocks.iter().enumerate() {
        for load in block.edge_loads() {
            let (from, to) = loaded_part(block, load);
            let Some(along) = (to - from).try_normalize(0.0) else { continue };
            let (block, values) = (Some(BlockId::new(index)), load.traction);
            let on = Pushed { block, ends: [from, to], values };
            let (outwards, name) = (Vector2::new(along.y, -along.x), names::load(model, load.load));
            let is_same = |(_, it): &&mut (LoadId, Push)| {
                let is_in_line = it.outwards.dot(&outwards) > 1.0 - 1e-9
                    && (from - it.on[0].ends[0]).dot(&outwards).abs() <= near;
                // A fill presses down on edges of all directions.
                let is_one_way = it.value.angle(&on.largest()) < 1e-9;
                let is_equal = it.on[0].values == values;
                let is_linear = !it.on[0].is_uniform() || !on.is_uniform();
                it.name == name
                    && (is_equal && is_in_line || is_linear && (is_in_line || is_one_way))
            };
            if let Some((_, same)) = list.iter_mut().find(is_same) {
                same.value = Pushed { values: [same.value, on.largest()], ..on }.largest();
                // Edges of several directions are pushed along the load.
                if same.outwards.dot(&outwards) < 1.0 - 1e-9 {
                    same.outwards = same.value.normalize() * same.outward_part().signum();
                }
                same.on.push(on);
                continue;
            }
            let (value, label) = (on.largest(), String::new());
            let push = Push { on: vec![on], value, outwards, turn: None, label, name, part: 1.0 };
            list.push((load.load, push));
        }
    }
    let with_label = |(load, push): (LoadId, Push)| {
        let size = stress_text(push.value.norm());
        let is_uniform = push.on.iter().all(Pushed::is_uniform);
        let value = if is_uniform { size } else { format!("{UP_TO}{size}") };
        Push { label: labelled(load, value), ..push }
    };
    list.into_iter().map(with_label).collect()
}

/// Returns all forces at points of blocks. The arrow of a force that pulls at an edge begins at its point; all other
/// arrows end at their points.
fn forces(model: &Model, labelled: &dyn Fn(LoadId, String) -> String) -> Vec<Push> {
    let units = InUnits(model.units);
    let blocks = model.blocks.iter().enumerate();
    let all = blocks.flat_map(|(k, block)| block.point_loads().map(move |load| (k, block, load)));
    let push = |(index, block, load): (usize, &PlacedBlock, &PointLoad)| {
        let near = 1e-9 * geometry::size(&block.corners);
        let pulls = (0..block.corners.len()).any(|k| {
            let normal = geometry::outward_normal(&block.corners, k);
            let nearest = geometry::nearest_on_segment(geometry::edge(&block.corners, k), load.at);
            (load.at - nearest).norm() < near && load.force.dot(&normal) > 0.0
        });
        let way = load.force.try_normalize(0.0).unwrap_or_default();
        Push {
            on: vec![Pushed::at_place(Some(BlockId::new(index)), load.at, load.force)],
            value: load.force,
            outwards: if pulls { way } else { -way },
            turn: None,
            label: labelled(load.load, units.force_text(load.force.norm())),
            name: names::load(model, load.load),
            part: 1.0,
        }
    };
    all.map(push).collect()
}

/// Returns all moments at points of blocks. The values of moments point up, so that the labels are above.
fn moments(model: &Model, labelled: &dyn Fn(LoadId, String) -> String) -> Vec<Push> {
    let units = InUnits(model.units);
    let blocks = model.blocks.iter().enumerate();
    let all = blocks.flat_map(|(k, block)| block.point_loads().map(move |load| (k, load)));
    let push = |(index, load): (usize, &PointLoad)| {
        let value = Vector2::y() * load.moment.abs();
        Push {
            on: vec![Pushed::at_place(Some(BlockId::new(index)), load.at, value)],
            value,
            outwards: Vector2::y(),
            turn: Some(load.moment.signum()),
            label: labelled(load.load, units.moment_text(load.moment.abs())),
            name: names::load(model, load.load),
            part: 1.0,
        }
    };
    all.map(push).collect()
}
