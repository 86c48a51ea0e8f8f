//! The movement by which a structure without equilibrium gives way.

use nalgebra::{Point2, Vector2};

use super::canvas::{Pixel, fixed};
use super::deformed::magnification;
use super::marks::{self, BRICK, OUTLINE};
use super::sheet::{Bounds, Margins, Sheet};
use crate::model::{Anchor, Model};
use crate::report::format::InUnits;

const MOVING: &str = "#f0b98d";
const STILL: &str = "#a8a8a8";
/// Blocks slower than this part of the fastest are drawn as at rest.
const AT_REST: f64 = 1e-6;

/// The structure displaced along `rates`, the displacement rates of the corners of every block,
/// over its outline. Only ratios between rates mean something: the picture has no displacement
/// scale.
pub fn mechanism(title: &str, model: &Model, rates: &[Vec<Vector2<f64>>]) -> String {
    let fastest = rates.iter().map(|rate| speed(rate)).fold(0.0, f64::max);
    let still = marks::bounds(model);
    let factor = magnification(&still, fastest);
    let moved: Vec<Vec<Point2<f64>>> = model
        .blocks
        .iter()
        .zip(rates)
        .map(|(block, rate)| {
            block.corners.iter().zip(rate).map(|(corner, rate)| corner + rate * factor).collect()
        })
        .collect();
    let bounds = Bounds::of(moved.iter().flatten().copied().chain([still.low, still.high]));

    let mut sheet = Sheet::new(&format!("{title}: mechanism"), bounds, Margins::HATCH);
    let frame = sheet.frame;
    let width = marks::outline_width(marks::brick_size(model, &frame));
    let (outline, thin) = (fixed(width), fixed(0.7 * width));
    let style =
        format!("class=\"undeformed\" fill=\"none\" stroke=\"{STILL}\" stroke-width=\"{thin}\"");
    marks::blocks(&mut sheet, model, &style);
    let mut moving = 0_usize;
    let style = format!(
        "fill-opacity=\"0.8\" stroke=\"{OUTLINE}\" stroke-width=\"{outline}\" stroke-linejoin=\"round\""
    );
    sheet.canvas.group(&style, |canvas| {
        for (corners, rate) in moved.iter().zip(rates) {
            let moves = speed(rate) > AT_REST * fastest;
            moving += usize::from(moves);
            let style = if moves {
                format!("class=\"moving\" fill=\"{MOVING}\"")
            } else {
                format!("class=\"still\" fill=\"{BRICK}\"")
            };
            let corners: Vec<_> = corners.iter().map(|corner| frame.at(*corner)).collect();
            canvas.polygon(&corners, &style);
        }
    });
    marks::supports(&mut sheet, model);
    for (text, fill) in [
        (format!("{moving} blocks move"), MOVING),
        (format!("{} at rest", model.blocks.len().saturating_sub(moving)), BRICK),
    ] {
        sheet.entry(&text, |symbol| {
            let style = format!("fill=\"{fill}\" stroke=\"{OUTLINE}\" stroke-width=\"1\"");
            symbol.rectangle(Pixel::new(-16.0, -6.0), 32.0, 12.0, &style);
        });
    }
    sheet.entry("amplitude is arbitrary", |_| {});
    if dilates(model, rates) {
        // A motion that proves collapse.
        sheet.entry("joints that slide open by mu times the slip: a bound, not the path", |_| {});
    }
    sheet.length_bar(InUnits(model.units));
    sheet.finish()
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
        let edge = contact.law.mu * slides;
        edge > AT_REST.sqrt() && (opens - edge).abs() <= AT_REST * edge.max(opens)
    })
}

fn speed(rate: &[Vector2<f64>]) -> f64 {
    rate.iter().map(Vector2::norm).fold(0.0, f64::max)
}
