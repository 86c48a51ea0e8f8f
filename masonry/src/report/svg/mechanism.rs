//! The movement by which a structure without equilibrium gives way, with its hinges and sliding joints.

use nalgebra::{Point2, Vector2};

use super::canvas::{Canvas, Pixel, before, fixed};
use super::deformed::{PAGE, magnification};
use super::labels::Labels;
use super::marks::{self, BRICK, counted};
use super::names;
use super::sheet::{Bounds, Margins, Sheet};
use super::style::OUTLINE;
use crate::model::{Anchor, Model};
use crate::report::hinges::{Yield, YieldingJoint, yielding};
use crate::verify::moving::{SLOW, speed};

const MOVING: &str = "#f0b98d";
const MOVING_SLOWLY: &str = "#f9e3d0";
const STILL: &str = "#a8a8a8";
const HINGE: &str = "#a50026";
const SLIDING: &str = "#7b3294";
/// Blocks slower than this part of the fastest are drawn as at rest.
const AT_REST: f64 = 1e-6;
/// So many hinges and sliding joints have numbers; of more, numbers would hide the structure, and slow ones have no marks.
const NUMBERED: usize = 48;

/// The structure displaced along `rates`, the displacement rates of the corners of every block,
/// over its outline. Only ratios between rates mean something: the picture has no displacement
/// scale. Hinges and sliding joints are marked and, where they are few, numbered in the order of the joints.
pub fn mechanism(title: &str, model: &Model, rates: &[Vec<Vector2<f64>>]) -> String {
    drawn(title, model, rates, false)
}

/// The same with the places before, by which a page changes the amplitude.
pub(in crate::report) fn mechanism_on_page(
    title: &str,
    model: &Model,
    rates: &[Vec<Vector2<f64>>],
) -> String {
    drawn(title, model, rates, true)
}

fn drawn(title: &str, model: &Model, rates: &[Vec<Vector2<f64>>], for_page: bool) -> String {
    let fastest = rates.iter().map(|rate| speed(rate)).fold(0.0, f64::max);
    let still = marks::bounds(model);
    let factor = magnification(&still, fastest);
    let moved = |factor: f64| -> Vec<Vec<Point2<f64>>> {
        let blocks = model.blocks.iter().zip(rates);
        let corners = blocks.map(|(block, rate)| block.corners.iter().zip(rate));
        corners.map(|it| it.map(|(corner, rate)| corner + rate * factor).collect()).collect()
    };
    let furthest = moved(if for_page { PAGE * factor } else { factor });
    let bounds = Bounds::of(furthest.into_iter().flatten().chain([still.low, still.high]));

    let mut sheet = Sheet::new(&format!("{title}: mechanism"), model, bounds, Margins::HATCH);
    let frame = sheet.frame;
    let width = marks::outline_width(sheet.brick);
    let (outline, thin) = (fixed(width), fixed(0.7 * width));
    let style =
        format!("class=\"undeformed\" fill=\"none\" stroke=\"{STILL}\" stroke-width=\"{thin}\"");
    marks::outlines(&mut sheet, &model.blocks, &style);
    let (mut moving, mut slow) = (0_usize, 0_usize);
    let style = format!(
        "fill-opacity=\"0.8\" stroke=\"{OUTLINE}\" stroke-width=\"{outline}\" stroke-linejoin=\"round\""
    );
    sheet.canvas.group(&style, |canvas| {
        for ((corners, rate), block) in moved(factor).iter().zip(rates).zip(&model.blocks) {
            let moves = speed(rate) > AT_REST * fastest;
            let is_slow = moves && speed(rate) < SLOW * fastest;
            moving += usize::from(moves && !is_slow);
            slow += usize::from(is_slow);
            let (class, fill) = match (moves, is_slow) {
                (true, false) => ("moving", MOVING),
                (true, true) => ("moving", MOVING_SLOWLY),
                (false, _) => ("still", BRICK),
            };
            let name = names::block(block);
            let mut style = format!("class=\"{class}\" fill=\"{fill}\" {name}");
            let pixels = |corners: &[Point2<f64>]| -> Vec<Pixel> {
                corners.iter().map(|corner| frame.at(*corner)).collect()
            };
            if for_page && moves {
                style = format!("{style} {}", before(&pixels(&block.corners)));
            }
            canvas.polygon(&pixels(corners), &style);
        }
    });
    marks::supports(&mut sheet, model);
    if for_page {
        sheet.tell("amplitude", "1");
    }
    let still = model.blocks.len().saturating_sub(moving + slow);
    for (count, what, fill) in [
        (moving, "moving".to_owned(), MOVING),
        (slow, format!("slower than {} % of the fastest", 100.0 * SLOW), MOVING_SLOWLY),
        (still, "at rest".to_owned(), BRICK),
    ] {
        if count > 0 {
            sheet.block_entry(&format!("{what}: {}", counted(count, "block")), fill);
        }
    }
    let by = Amplitude { factor, for_page };
    draw_yielding(&mut sheet, model, &yielding(model, rates), by);
    sheet.note("amplitude is arbitrary");
    if dilates(model, rates) {
        sheet.note("associated flow: joints that slide also open, by mu times the slip");
    }
    sheet.finish()
}

/// The factor of all rates, and whether a page changes it.
#[derive(Clone, Copy)]
struct Amplitude {
    factor: f64,
    for_page: bool,
}

/// Marks of hinges and sliding joints where they have moved to, with their numbers.
fn draw_yielding(sheet: &mut Sheet, model: &Model, joints: &[YieldingJoint], by: Amplitude) {
    let Amplitude { factor, for_page } = by;
    let frame = sheet.frame;
    let radius = (0.09 * sheet.brick).clamp(1.2, 4.5);
    let yields = |it: &&YieldingJoint| it.does.is_marked();
    let mut marked: Vec<(usize, &YieldingJoint)> =
        (1..).zip(joints.iter().filter(yields)).collect();
    let all = marked.len();
    if all > NUMBERED {
        marked.retain(|(_, it)| it.opens.max(it.slides) >= SLOW);
    }
    let place = |it: &YieldingJoint| frame.at(it.at + it.rate * factor);
    let mut labels = Labels::within(sheet.room());
    for (_, it) in &marked {
        let [from, to] = mark(it, model, place(it), radius);
        labels.avoid(from, to);
    }
    sheet.canvas.group("class=\"yielding\"", |canvas| {
        for (number, it) in &marked {
            let (at, still) = (place(it), frame.at(it.at));
            let class = format!("class=\"{}\" {}", it.does.name(), names::joint(model, it.joint));
            let [dx, dy] = [at.x - still.x, at.y - still.y].map(fixed);
            let moves = format!("{class} data-moved=\"{dx},{dy}\"");
            canvas.group(if for_page { &moves } else { &class }, |canvas| {
                draw_mark(canvas, it.does, mark(it, model, at, radius), radius);
                if all <= NUMBERED {
                    let side = model.joints[it.joint.index()].normal;
                    let side = if side.y < 0.0 { -side } else { side };
                    let at = at.shifted(side.x, -side.y, radius + 2.0);
                    labels.draw(canvas, at, side, 12.0, &number.to_string());
                }
            });
        }
    });
    let horizontal = [Pixel::new(-10.0, 0.0), Pixel::new(10.0, 0.0)];
    for (does, name) in [(Yield::Hinge, "hinge"), (Yield::Slides, "sliding")] {
        let count = joints.iter().filter(|it| it.does == does).count();
        if count > 0 {
            let text = format!("{name}: {}", counted(count, "joint"));
            sheet.entry(&text, |symbol| draw_mark(symbol, does, horizontal, 4.5));
        }
    }
    if marked.len() < all {
        let text = format!(
            "no mark: {}, slower than {} % of the fastest",
            counted(all - marked.len(), "joint"),
            100.0 * SLOW
        );
        sheet.note(&text);
    }
    let apart = joints.len() - all;
    if apart > 0 {
        sheet.note(&format!("coming apart: {}", counted(apart, "joint")));
    }
}

/// The ends of a mark, along its joint.
fn mark(it: &YieldingJoint, model: &Model, at: Pixel, radius: f64) -> [Pixel; 2] {
    let along = model.joints[it.joint.index()].tangent();
    let half = if it.does == Yield::Hinge { radius } else { 2.2 * radius };
    [-half, half].map(|half| at.shifted(along.x, -along.y, half))
}

/// A hinge is a ring, a sliding joint a line with half arrows on both sides.
fn draw_mark(canvas: &mut Canvas, does: Yield, [from, to]: [Pixel; 2], radius: f64) {
    if does == Yield::Hinge {
        let style = format!(
            "fill=\"#ffffff\" stroke=\"{HINGE}\" stroke-width=\"{}\"",
            fixed((0.4 * radius).max(0.8))
        );
        canvas.circle(from.between(to, 0.5), radius, &style);
        return;
    }
    let style = format!("stroke=\"{SLIDING}\" stroke-width=\"{}\"", fixed((0.4 * radius).max(0.8)));
    let (dx, dy) = (to.x - from.x, to.y - from.y);
    for (tip, way) in [(to, 1.0), (from, -1.0)] {
        let start = if way > 0.0 { from } else { to };
        let side = |it: Pixel, by: f64| it.shifted(-dy * way, dx * way, by * radius);
        let barb = side(tip, 1.3).shifted(-dx * way, -dy * way, 1.3 * radius);
        canvas.line(side(start, 0.45), side(tip, 0.45), &style);
        canvas.line(side(tip, 0.45), barb, &style);
    }
}

/// Whether joints open just so far that no force inside their friction cones does work.
fn dilates(model: &Model, rates: &[Vec<Vector2<f64>>]) -> bool {
    let at = |anchor: Anchor| {
        let corners = &rates[anchor.block.index()];
        corners[anchor.edge] * (1.0 - anchor.at)
            + corners[(anchor.edge + 1) % corners.len()] * anchor.at
    };
    model.contacts.iter().any(|contact| {
        let joint = &model.joints[contact.joint.index()];
        let apart = at(contact.b) - contact.a.map_or_else(Vector2::zeros, at);
        let (opens, slides) = (apart.dot(&joint.normal), apart.dot(&joint.tangent()).abs());
        let edge = contact.law.cone().lift(slides);
        edge > AT_REST.sqrt() && (opens - edge).abs() <= AT_REST * edge.max(opens)
    })
}
