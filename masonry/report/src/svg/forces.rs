//! The forces in the joints: resultants at their points of application, the lines between them, and the used part of
//! the friction.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::arrows::{Arrows, Displaced, LEAST};
use super::canvas::{Pixel, dot, fixed, open};
use super::labels::{Label, Labels};
use super::legend;
use super::names;
use super::sheet::{Bounds, Sheet, Shown, Sides, brick_size};
use super::structure::{self, counted};
use super::style::{LARGEST_BRICK, PLACE};
use crate::format::InUnits;
use crate::joints::{self, JointForce};
use masonry::data::state::PointState;
use masonry::model::{Body, Model};

/// Resultants below this part of the largest are not drawn in structures with more than `MANY` joints.
const LEAST_OF_MANY: f64 = 1e-2;
const MANY: usize = 150;
/// The value of every resultant is shown in structures with at most this number of joints.
const FEW: usize = 24;
/// Least used part of the friction, class in the style sheet, and text of the legend.
const USES: [(f64, &str, &str); 3] = [
    (0.995, "used up", "friction used up"),
    (0.8, "used much", "80 % of friction used or more"),
    (0.5, "used", "50 % of friction used or more"),
];
/// Width of the widest line of thrust, in sizes of a brick.
const WIDEST: f64 = 0.15;
/// Half the width of the middle third, in lengths of a joint, with room for rounding errors.
const MIDDLE_THIRD: f64 = 1.0 / 6.0 + 1e-9;
/// Half the length of a joint, in lengths of a joint, with room for rounding errors.
const ENDS: f64 = 0.5 + 1e-6;

/// Scale and room that pictures of forces share, so that the pictures of a load history can be compared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shared {
    /// The largest resultant in all pictures \[N\].
    largest: f64,
    /// Side of a square as large as a median brick \[m\]; the stroke of the largest resultant is nearly as long.
    brick: f64,
    bounds: Bounds,
    /// Room for the arrows and labels of all pictures.
    margins: Sides,
}

impl Shared {
    /// Returns the scale that pictures of these structures with their contact forces share.
    pub(crate) fn of(states: &[Loaded<'_>]) -> Self {
        let (mut largest, mut brick, mut margins) = (0.0_f64, 0.0_f64, Sides::HATCH);
        for Loaded { model, contacts, .. } in states {
            let all = joints::forces(model, contacts);
            largest = all.iter().map(|it| it.force.norm()).fold(largest, f64::max);
            brick = brick.max(brick_size(model));
            let arrows = Arrows::of_loads(model, None).and_reactions(model, &all);
            margins = margins.and(arrows.margins());
        }
        let all = states.iter().flat_map(|it| structure::bounds(it.model).ends());
        Self { largest, brick, bounds: Bounds::of(all), margins }
    }
}

/// A structure with its contact forces, and the title of its picture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Loaded<'a> {
    pub(crate) title: &'a str,
    pub(crate) model: &'a Model,
    pub(crate) contacts: &'a [PointState],
}

impl<'a> From<&Shown<'a>> for Loaded<'a> {
    fn from(Shown { title, model, state }: &Shown<'a>) -> Self {
        Self { title, model, contacts: &state.contacts }
    }
}

/// Draws the structure with the resultant of every joint as a stroke in the direction of the resultant, through the
/// point at which it crosses the joint. The length of the stroke is proportional to the force.
///
/// Lines from joint to joint are drawn behind, with a width that is proportional to the force; in an arch they are the
/// line of thrust. Dots are hollow if the resultant is outside the middle third of the joint. Coloured joints use much
/// of their friction. Supports have their reactions. Loads are those of the model.
pub fn forces(title: &str, model: &Model, contacts: &[PointState]) -> String {
    let loaded = Loaded { title, model, contacts };
    compared(&loaded, &Shared::of(&[loaded]))
}

/// Draws the picture of [`forces`] with the scale that it shares with other pictures.
pub(crate) fn compared(loaded: &Loaded<'_>, by: &Shared) -> String {
    let Loaded { title, model, contacts } = *loaded;
    let all = joints::forces(model, contacts);
    let arrows = Arrows::of_loads(model, None).and_reactions(model, &all);
    let mut sheet = Sheet::new(format!("{title}: forces"), model, by.bounds, by.margins);
    sheet.brick = by.brick * sheet.frame.scale;
    structure::draw(&mut sheet, model);
    let least = if all.len() > MANY { LEAST_OF_MANY } else { LEAST };
    let is_large = |it: &&JointForce| it.force.norm() > least * by.largest;
    let large: Vec<&JointForce> = all.iter().filter(is_large).collect();
    // A joint with tensile strength can carry a moment whose resultant passes beside the joint.
    let is_on = |it: &&JointForce| it.eccentricity.abs() <= ENDS;
    let drawn =
        Drawn { model, largest: by.largest, list: large.iter().copied().filter(is_on).collect() };
    drawn.draw_paths(&mut sheet);
    drawn.draw_uses(&mut sheet);
    drawn.draw_resultants(&mut sheet);
    let mut labels = Labels::within(sheet.room);
    drawn.list.iter().for_each(|it| labels.avoid(drawn.stroke(&sheet, it)));
    arrows.draw(&mut sheet, model, &mut labels, &Displaced::NOT);
    if drawn.list.len() <= FEW {
        drawn.draw_values(&mut sheet, &mut labels);
    }
    let (small, beside) = (all.len() - large.len(), large.len() - drawn.list.len());
    if all.len() > MANY && small > 0 {
        let count = counted(small, "joint");
        sheet.legend.note(&format!("left out: {count} with less than 1 % of the largest force"));
    }
    if beside > 0 {
        let count = counted(beside, "joint");
        sheet.legend.note(&format!("left out: {count} whose resultant passes beside them"));
    }
    if by.largest > 0.0 && all.iter().all(|it| it.force.norm() < by.largest) {
        let largest = InUnits(model.units).force_text(by.largest);
        sheet.legend.note(&format!("drawn to one scale with others, up to {largest}"));
    }
    sheet.legend.note("one of many sets of forces if they are not unique");
    sheet.finish()
}

/// The resultants of a structure that are drawn.
struct Drawn<'a> {
    model: &'a Model,
    /// The largest resultant of all compared pictures \[N\].
    largest: f64,
    list: Vec<&'a JointForce>,
}

impl Drawn<'_> {
    /// Draws lines from every joint of a block to the middle of the joint forces on the block: one straight line for a
    /// block with two joints.
    fn draw_paths(&self, sheet: &mut Sheet) {
        let paths = joints::paths(self.model, self.list.iter().copied());
        if paths.is_empty() {
            return;
        }
        let widest = WIDEST * sheet.marks();
        sheet.layer("paths", |canvas, frame| {
            // One element is written for each width: viewers and scripts are slow with thousands of elements.
            let mut by_width: BTreeMap<String, String> = BTreeMap::new();
            for path in paths {
                let width = fixed((widest * path.force / self.largest).max(0.3));
                *by_width.entry(width).or_default() += &open(path.ends.map(|end| frame.at(end)));
            }
            for (width, data) in by_width {
                canvas.path(&data, &format!("style=\"stroke-width:{width}px\""));
            }
        });
        sheet.legend.add("path of forces; width proportional to the force", "paths", legend::line);
    }

    /// Draws the joints that use much of their friction.
    fn draw_uses(&self, sheet: &mut Sheet) {
        let mut below = f64::INFINITY;
        for (least, class, name) in USES {
            let is_within = |it: &&&JointForce| {
                it.utilisation.is_some_and(|use_| use_ >= least && use_ < below)
            };
            let found: Vec<_> = self.list.iter().filter(is_within).collect();
            below = least;
            if found.is_empty() {
                continue;
            }
            structure::joints(sheet, class, self.model, found.iter().map(|it| it.joint));
            let text = format!("{name}: {}", counted(found.len(), "joint"));
            sheet.legend.add(&text, class, legend::line);
        }
    }

    fn draw_resultants(&self, sheet: &mut Sheet) {
        let radius = PLACE * sheet.marks();
        let outside = "class=\"outside\"";
        for name in ["pressing", "pulling"] {
            let is_own = |it: &&JointForce| (it.normal > 0.0) == (name == "pressing");
            let own: Vec<_> = self.list.iter().copied().filter(is_own).collect();
            let Some(most) = own.iter().map(|it| it.force.norm()).reduce(f64::max) else {
                continue;
            };
            let places = format!("{name} places");
            let strokes: Vec<_> = own.iter().map(|it| self.stroke(sheet, it)).collect();
            sheet.layer(name, |canvas, _| {
                for (it, stroke) in own.iter().zip(strokes) {
                    canvas.path(&open(stroke), &names::joint(self.model, it.joint));
                }
            });
            sheet.layer(&places, |canvas, frame| {
                // Two elements hold all dots: the strokes below the dots have the names of joints.
                for (is_class, class) in [(true, ""), (false, outside)] {
                    let of_class = own.iter().filter(|it| is_inside(it) == is_class);
                    let dots: String = of_class.map(|it| dot(frame.at(it.at), radius)).collect();
                    if !dots.is_empty() {
                        canvas.path(&dots, class);
                    }
                }
            });
            let most = InUnits(self.model.units).force_text(most);
            let text = format!("resultant in a joint, {name}, up to {most}");
            let at = Pixel::new(0.0, 0.0);
            sheet.legend.add(&text, &places, |symbol| {
                legend::line(symbol);
                symbol.circle(at, PLACE * LARGEST_BRICK, "");
            });
            let count = own.iter().filter(|it| !is_inside(it)).count();
            if count > 0 {
                let text = format!("outside the middle third: {}", counted(count, "joint"));
                sheet.legend.add(&text, &places, |symbol| {
                    symbol.circle(at, PLACE * LARGEST_BRICK, outside);
                });
            }
        }
    }

    /// Returns the ends of the stroke of a resultant: the stroke of the largest resultant is nearly as long as a brick.
    fn stroke(&self, sheet: &Sheet, it: &JointForce) -> [Pixel; 2] {
        let half = 0.45 * sheet.brick * it.force.norm() / self.largest;
        [-half, half].map(|half| sheet.frame.at(it.at).along(it.force, half))
    }

    /// Writes the value of every resultant between blocks beside its stroke, if there is room. Resultants at supports
    /// have no value, since supports show their reactions.
    fn draw_values(&self, sheet: &mut Sheet, labels: &mut Labels) {
        let units = InUnits(self.model.units);
        sheet.layer("pressing labels", |canvas, frame| {
            for it in &self.list {
                if let Body::Support(_) = self.model.joints[it.joint.index()].a {
                    continue;
                }
                let across = Vector2::new(it.force.y, -it.force.x).normalize();
                let is_left = across.x < 0.0 || (across.x < 1e-9 && across.y < 0.0);
                let side = if is_left { -across } else { across };
                labels.draw(
                    canvas,
                    &Label {
                        text: &units.force_text(it.force.norm()),
                        size: 11.0,
                        at: frame.at(it.at).along(side, 5.0),
                        side,
                        name: &names::joint(self.model, it.joint),
                    },
                );
            }
        });
    }
}

fn is_inside(it: &JointForce) -> bool {
    it.eccentricity.abs() <= MIDDLE_THIRD
}
