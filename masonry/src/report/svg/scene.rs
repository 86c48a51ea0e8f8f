//! A scene before it is solved: blocks, supports, joints, contact points, loads.

use nalgebra::Point2;

use super::canvas::{Anchor, Pixel, fixed, text_width};
use super::dimensions::Dimensions;
use super::labels::Labels;
use super::loads::Loads;
use super::marks;
use super::materials;
use super::names;
use super::sheet::{SYMBOL, Sheet};
use super::style::DARK;
use crate::geometry;
use crate::ids::JointId;
use crate::law::JointLaw;
use crate::model::Model;
use crate::report::format::{InUnits, acceleration_text, significant, stress_text};

/// Colours of joint classes, told apart by the colour-blind too (Okabe and Ito).
const CLASSES: [&str; 5] = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9"];
const NAMED_BLOCKS: usize = 120;

/// The scene as it would be solved: bricks (with their names while they fit) and what they are made of, dimensions,
/// hatched supports, joints in the colour of their class, contact points, and loads with values and units.
pub fn scene(title: &str, model: &Model) -> String {
    let units = InUnits(model.units);
    let loads = Loads::of(model, units);
    let dimensions = Dimensions::of(model, loads.margins());
    let mut sheet = Sheet::new(title, model, marks::bounds(model), dimensions.margins());
    materials::draw(&mut sheet, model);
    marks::supports(&mut sheet, model);
    draw_joints(&mut sheet, model);
    let mut labels = Labels::within(sheet.room());
    loads.mark(&sheet.frame, &mut labels);
    loads.draw(&mut sheet, model, &mut labels);
    dimensions.draw(&mut sheet, units);
    draw_names(&mut sheet, model);
    draw_gravity(&mut sheet, model);
    sheet.finish()
}

fn draw_joints(sheet: &mut Sheet, model: &Model) {
    let (frame, brick) = (sheet.frame, sheet.brick);
    let (stroke, radius) = ((0.025 * brick).clamp(0.4, 1.8), (0.032 * brick).clamp(0.5, 2.6));
    for (index, class) in model.joint_classes.iter().enumerate() {
        let colour = CLASSES[index % CLASSES.len()];
        let style =
            format!("class=\"joints\" stroke=\"{colour}\" stroke-width=\"{}\"", fixed(stroke));
        let mut used = false;
        sheet.canvas.group(&style, |canvas| {
            for (k, joint) in model.joints.iter().enumerate().filter(|(_, it)| it.class == index) {
                used = true;
                let name = names::joint(model, JointId::new(k));
                canvas.line(frame.at(joint.from), frame.at(joint.to), &name);
            }
        });
        let style = format!("class=\"contacts\" fill=\"{colour}\"");
        sheet.canvas.group(&style, |canvas| {
            let of_class = |joint: usize| model.joints[joint].class == index;
            for contact in model.contacts.iter().filter(|it| of_class(it.joint.index())) {
                let name = names::joint(model, contact.joint);
                canvas.circle(frame.at(contact.position), radius, &name);
            }
        });
        if used {
            let text = format!("{} joints, {}", class.name, law(&class.law));
            sheet.entry(&text, |symbol| {
                let style = format!("stroke=\"{colour}\" stroke-width=\"1.8\"");
                symbol.line(Pixel::new(-SYMBOL, 0.0), Pixel::new(SYMBOL, 0.0), &style);
                for x in [-SYMBOL, SYMBOL] {
                    symbol.circle(Pixel::new(x, 0.0), 2.6, &format!("fill=\"{colour}\""));
                }
            });
        }
    }
}

/// The law of a class: friction, and what strength and stiffness it has.
fn law(law: &JointLaw) -> String {
    let mut text = format!("μ\u{a0}=\u{a0}{}", significant(law.mu, 4));
    for (name, value) in [("c", law.cohesion), ("f_t", law.tension)] {
        if value > 0.0 {
            text = format!("{text}, {name}\u{a0}=\u{a0}{}", stress_text(value));
        }
    }
    if let Some(stiffness) = law.stiffness {
        for (name, value) in ["k_n", "k_t"].into_iter().zip(stiffness) {
            text = format!("{text}, {name}\u{a0}=\u{a0}{}/m", stress_text(value));
        }
    }
    text
}

/// Names in the middle of the blocks, in one size that fits all, or not at all.
fn draw_names(sheet: &mut Sheet, model: &Model) {
    if model.blocks.len() > NAMED_BLOCKS {
        return;
    }
    let frame = sheet.frame;
    let mut size: f64 = 12.0;
    for block in &model.blocks {
        let (wide, high) = room(&block.corners);
        let width = text_width(&block.name, 1.0).max(f64::MIN_POSITIVE);
        size = size.min(0.8 * wide * frame.scale / width).min(0.6 * high * frame.scale);
    }
    if size < 7.0 {
        return;
    }
    let centres = model.blocks.iter().map(|block| geometry::centroid(&block.corners));
    sheet.canvas.group("class=\"names\"", |canvas| {
        for (block, centre) in model.blocks.iter().zip(centres) {
            let at = frame.at(centre);
            let base = Pixel::new(at.x, at.y + 0.36 * size);
            canvas.text_with(base, Anchor::Middle, size, &names::block(block), &block.name);
        }
    });
}

/// Lengths of the horizontal and of the vertical line through the centroid of a block \[m\].
fn room(corners: &[Point2<f64>]) -> (f64, f64) {
    let centre = geometry::centroid(corners);
    let chord = |along: usize, across: usize| {
        let crossings = (0..corners.len()).filter_map(|k| {
            let [p, q] = geometry::edge(corners, k);
            let at = (centre[across] - p[across]) / (q[across] - p[across]);
            (0.0..=1.0).contains(&at).then(|| p[along] + (q[along] - p[along]) * at)
        });
        let (low, high) = crossings.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (f64::min(low, x), f64::max(high, x))
        });
        (high - low).max(0.0)
    };
    (chord(0, 1), chord(1, 0))
}

fn draw_gravity(sheet: &mut Sheet, model: &Model) {
    let pull = model.gravity;
    if pull.norm() > 0.0 && model.blocks.iter().any(|block| block.density.is_some()) {
        let text = format!("self weight, {}", acceleration_text(pull.norm()));
        sheet.entry(&text, |symbol| {
            let (tail, tip) = (Pixel::new(0.0, 0.0), Pixel::new(0.0, 0.0));
            let tail = tail.shifted(-pull.x, pull.y, 9.0);
            let tip = tip.shifted(pull.x, -pull.y, 9.0);
            symbol.arrow(tail, tip, DARK);
        });
    }
}
