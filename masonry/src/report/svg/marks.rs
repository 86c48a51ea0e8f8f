//! What several pictures draw: blocks, hatched supports, contact marks.

use nalgebra::{Point2, Vector2};

use super::canvas::{Canvas, Pixel, before, fixed};
use super::labels::Labels;
use super::names;
use super::sheet::{Bounds, Frame, Sheet};
use super::style::OUTLINE;
use crate::data::state::{ContactState, ContactStatus};
use crate::ids::SupportId;
use crate::model::{Block, Body, ContactPoint, Model, Support};

/// Compression: a blue that the colour-blind tell from [`TENSION`].
pub(super) const COMPRESSION: &str = "#0072b2";
/// Tension: vermillion.
pub(super) const TENSION: &str = "#d55e00";
/// Fill of a brick.
pub(super) const BRICK: &str = "#f5efe6";
/// Ground and walls.
const GROUND: &str = "#444444";
/// Rim of an open contact point.
const OPEN: &str = "#222222";
/// Fill of a sliding contact point.
const SLIDING: &str = "#cc3399";
/// Length of the strokes of a hatch.
const TICK: f64 = 7.0;
/// The line of a support is wider than its hatch.
const LINE: &str = "stroke-width=\"2.2\"";

/// The box around all blocks and supports.
pub(super) fn bounds(model: &Model) -> Bounds {
    let corners = model.blocks.iter().flat_map(|block| block.corners.iter().copied());
    let ends = model.supports.iter().flat_map(|support| [support.from, support.to]);
    Bounds::of(corners.chain(ends))
}

/// Width of a brick's outline.
pub(super) fn outline_width(brick: f64) -> f64 {
    (0.02 * brick).clamp(0.25, 1.2)
}

/// Blocks of one colour, with outlines.
pub(super) fn bricks<'a>(
    sheet: &mut Sheet,
    blocks: impl IntoIterator<Item = &'a Block>,
    fill: &str,
) {
    let width = fixed(outline_width(sheet.brick));
    let style = format!(
        "class=\"bricks\" fill=\"{fill}\" stroke=\"{OUTLINE}\" stroke-width=\"{width}\" \
         stroke-linejoin=\"round\""
    );
    outlines(sheet, blocks, &style);
}

/// Blocks in their undeformed place, under one style.
pub(super) fn outlines<'a>(
    sheet: &mut Sheet,
    blocks: impl IntoIterator<Item = &'a Block>,
    style: &str,
) {
    let frame = sheet.frame;
    sheet.canvas.group(style, |canvas| {
        for block in blocks {
            let corners: Vec<_> = block.corners.iter().map(|corner| frame.at(*corner)).collect();
            canvas.polygon(&corners, &names::block(block));
        }
    });
}

/// The nodes around a block, as positions in the list of its nodes.
pub(super) fn rim(block: &Block) -> Vec<usize> {
    let Some(mesh) = &block.mesh else { return (0..block.corners.len()).collect() };
    let row = mesh.nx + 1;
    let bottom = 0..mesh.nx;
    let right = (0..mesh.ny).map(|j| j * row + mesh.nx);
    let top = (1..=mesh.nx).rev().map(|i| mesh.ny * row + i);
    let left = (1..=mesh.ny).rev().map(|j| j * row);
    bottom.chain(right).chain(top).chain(left).collect()
}

/// All supports, hatched on the side away from the structure, and their legend entry.
pub(super) fn supports(sheet: &mut Sheet, model: &Model) {
    moved_supports(sheet, model, 0.0, false);
}

/// The same with supports where they have moved to, magnified; for a page also where they were.
pub(super) fn moved_supports(sheet: &mut Sheet, model: &Model, factor: f64, for_page: bool) {
    if model.supports.is_empty() {
        return;
    }
    let frame = sheet.frame;
    let attributes = format!("stroke=\"{GROUND}\" stroke-width=\"1\" class=\"supports\"");
    sheet.canvas.group(&attributes, |canvas| {
        for (index, support) in model.supports.iter().enumerate() {
            let inward = side_of_structure(model, SupportId::new(index), support);
            let ends = [support.from, support.to];
            let at =
                |factor: f64| ends.map(|end| frame.at(end + support.displacement_at(end) * factor));
            let ticks = ticks(at(0.0));
            let (still, moved) = (hatch(at(0.0), ticks, inward), hatch(at(factor), ticks, inward));
            canvas.group(&names::support(support), |canvas| {
                for (index, (from, to)) in still.into_iter().zip(moved).enumerate() {
                    let mut attributes = String::from(if index == 0 { LINE } else { "" });
                    if for_page && from != to {
                        attributes = format!("{attributes} {}", before(&from));
                    }
                    canvas.line(to[0], to[1], attributes.trim_start());
                }
            });
        }
    });
    sheet.entry("support", |symbol| {
        let attributes = format!("stroke=\"{GROUND}\" stroke-width=\"1\"");
        symbol.group(&attributes, |symbol| {
            let ends = [Pixel::new(-22.0, -3.0), Pixel::new(22.0, -3.0)];
            let hatch = hatch(ends, ticks(ends), Vector2::new(0.0, 1.0));
            for (index, [from, to]) in hatch.into_iter().enumerate() {
                symbol.line(from, to, if index == 0 { LINE } else { "" });
            }
        });
    });
}

/// Contact points that are open (hollow circles) or slide (filled squares on a corner).
///
/// Each mark is moved along its joint by nearly two radii towards the joint's middle, so that the marks
/// of joints which meet in one place stay apart.
pub(super) fn contact_marks(sheet: &mut Sheet, model: &Model, states: &[ContactState]) {
    let frame = sheet.frame;
    let radius = (0.05 * sheet.brick).clamp(0.8, 3.6);
    for (status, name) in [(ContactStatus::Open, "open"), (ContactStatus::Slip, "sliding")] {
        let mut count = 0_usize;
        sheet.canvas.group(&mark_style(status, radius), |canvas| {
            for (contact, _) in
                model.contacts.iter().zip(states).filter(|(_, state)| state.status == status)
            {
                draw_mark(canvas, mark_place(model, contact, &frame, radius), radius, status);
                count += 1;
            }
        });
        if count > 0 {
            let text = format!("{name}: {}", counted(count, "contact point"));
            sheet.entry(&text, |symbol| {
                symbol.group(&mark_style(status, 3.6), |symbol| {
                    draw_mark(symbol, Pixel::new(0.0, 0.0), 3.6, status);
                });
            });
        }
    }
}

fn mark_style(status: ContactStatus, radius: f64) -> String {
    let width = fixed((0.36 * radius).max(0.3));
    match status {
        ContactStatus::Open => {
            format!("class=\"open\" fill=\"#ffffff\" stroke=\"{OPEN}\" stroke-width=\"{width}\"")
        }
        ContactStatus::Stick => "class=\"stick\"".to_owned(),
        ContactStatus::Slip => format!("class=\"slip\" fill=\"{SLIDING}\""),
    }
}

fn draw_mark(canvas: &mut Canvas, at: Pixel, radius: f64, status: ContactStatus) {
    match status {
        ContactStatus::Open => canvas.circle(at, radius, ""),
        ContactStatus::Stick => canvas.circle(at, 0.5 * radius, ""),
        ContactStatus::Slip => {
            let tip = 1.35 * radius;
            let corners = [(tip, 0.0), (0.0, tip), (-tip, 0.0), (0.0, -tip)];
            canvas.polygon(&corners.map(|(x, y)| Pixel::new(at.x + x, at.y + y)), "");
        }
    }
}

fn mark_place(model: &Model, contact: &ContactPoint, frame: &Frame, radius: f64) -> Pixel {
    let joint = &model.joints[contact.joint.index()];
    let at = frame.at(contact.position);
    let middle = frame.at(nalgebra::center(&joint.from, &joint.to));
    at.shifted(middle.x - at.x, middle.y - at.y, (1.7 * radius).min(at.distance(middle)))
}

/// A vector, y up, from the support to the structure.
fn side_of_structure(model: &Model, id: SupportId, support: &Support) -> Vector2<f64> {
    if let Some(joint) = model.joints.iter().find(|joint| joint.a == Body::Support(id)) {
        return joint.normal;
    }
    let box_of_blocks =
        Bounds::of(model.blocks.iter().flat_map(|block| block.corners.iter().copied()));
    let centre: Point2<f64> = nalgebra::center(&box_of_blocks.low, &box_of_blocks.high);
    centre - nalgebra::center(&support.from, &support.to)
}

/// Keeps labels away from the supports.
pub(super) fn avoid_supports(frame: &Frame, model: &Model, labels: &mut Labels) {
    for (index, support) in model.supports.iter().enumerate() {
        let inward = side_of_structure(model, SupportId::new(index), support);
        let [from, to] = [support.from, support.to].map(|end| frame.at(end));
        let [a, b] = [from, to].map(|end| end.shifted(-inward.x, inward.y, TICK));
        labels.avoid(from, to);
        labels.avoid(a, b);
    }
}

/// How many strokes a hatch along a line has.
fn ticks([from, to]: [Pixel; 2]) -> f64 {
    let mut ticks = 2.0;
    while from.distance(to) / ticks > TICK {
        ticks += 1.0;
    }
    ticks
}

/// The line of a support and the strokes of its hatch, away from the structure, which is on the side `inward`, y up.
fn hatch([from, to]: [Pixel; 2], ticks: f64, inward: Vector2<f64>) -> Vec<[Pixel; 2]> {
    let (tx, ty) = (to.x - from.x, to.y - from.y);
    // The normal of the line away from the structure; pixels count y downwards.
    let (mut nx, mut ny) = (-ty, tx);
    if nx * inward.x - ny * inward.y > 0.0 {
        (nx, ny) = (-nx, -ny);
    }
    let mut strokes = vec![[from, to]];
    let mut index = 0.5;
    while index < ticks {
        let foot = from.between(to, index / ticks);
        strokes.push([foot, foot.shifted(nx, ny, TICK).shifted(-tx, -ty, 0.6 * TICK)]);
        index += 1.0;
    }
    strokes
}

/// A number of things: `1 joint`, `2 joints`.
pub(in crate::report) fn counted(count: usize, name: &str) -> String {
    if count == 1 { format!("1 {name}") } else { format!("{count} {name}s") }
}
