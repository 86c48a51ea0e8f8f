//! The deformed structure over its undeformed outline.

use nalgebra::{Point2, Vector2};

use super::canvas::{Canvas, Pixel, fixed};
use super::marks::{self, OUTLINE};
use super::sheet::{Bounds, Frame, Margins, Sheet};
use crate::model::{Block, Model};
use crate::report::format::{InUnits, round_down, significant};
use crate::report::summary::{largest_displacement, nodes};
use crate::state::State;

const UNDEFORMED: &str = "#a8a8a8";
const FILLED: &str = "#f0dcc3";
const MESH: &str = "#bfa582";
/// What the largest displacement should come close to: parts of the structure's diagonal and of
/// its smaller side, whichever is less.
const SHOWN: (f64, f64) = (0.07, 0.3);

/// The deformed structure, magnified by a round factor that the legend states, over the undeformed
/// outline. Joints that open show the white of the paper.
pub fn deformed(title: &str, model: &Model, state: &State) -> String {
    let largest = largest_displacement(model, state).map_or(0.0, |it| it.value.abs());
    let factor = magnification(&marks::bounds(model), largest);
    let moved: Vec<Vec<Point2<f64>>> = model
        .blocks
        .iter()
        .zip(&state.displacements)
        .map(|(block, moves)| moved_nodes(block, moves, factor))
        .collect();
    let model = &with_moved_supports(model, factor);
    let still = marks::bounds(model);
    let bounds = Bounds::of(moved.iter().flatten().copied().chain([still.low, still.high]));

    let mut sheet = Sheet::new(&format!("{title}: deformed"), bounds, Margins::HATCH);
    let units = InUnits(model.units);
    let frame = sheet.frame;
    let width = marks::outline_width(marks::brick_size(model, &frame));
    let thin = fixed(0.7 * width);
    let style = format!(
        "class=\"undeformed\" fill=\"none\" stroke=\"{UNDEFORMED}\" stroke-width=\"{thin}\""
    );
    marks::blocks(&mut sheet, model, &style);
    draw_moved(&mut sheet.canvas, model, &moved, &frame, width);
    marks::supports(&mut sheet, model);
    add_legend(&mut sheet, units, factor, largest);
    sheet.length_bar(units);
    sheet.finish()
}

/// The round factor by which a largest displacement becomes a visible part of a structure within
/// `bounds`; 1 when nothing moves.
pub(super) fn magnification(bounds: &Bounds, largest: f64) -> f64 {
    let side = bounds.size().min();
    let slender = if side > 0.0 { SHOWN.1 * side } else { f64::INFINITY };
    let wanted = slender.min(SHOWN.0 * bounds.diagonal()) / largest;
    if wanted.is_finite() && wanted > 0.0 { round_down(wanted) } else { 1.0 }
}

/// The model with its supports where they have moved to, magnified like the blocks.
fn with_moved_supports(model: &Model, factor: f64) -> Model {
    let mut model = model.clone();
    for support in &mut model.supports {
        let [from, to] = [support.from, support.to].map(|end| support.displacement_at(end));
        support.from += from * factor;
        support.to += to * factor;
    }
    model
}

fn moved_nodes(block: &Block, moves: &[Vector2<f64>], factor: f64) -> Vec<Point2<f64>> {
    nodes(block).iter().zip(moves).map(|(node, u)| node + u * factor).collect()
}

fn draw_moved(
    canvas: &mut Canvas,
    model: &Model,
    moved: &[Vec<Point2<f64>>],
    frame: &Frame,
    width: f64,
) {
    let (outline, thin) = (fixed(width), fixed(0.5 * width));
    let fill = format!("class=\"deformed\" fill=\"{FILLED}\" fill-opacity=\"0.8\" stroke=\"none\"");
    let mesh = format!("class=\"mesh\" fill=\"none\" stroke=\"{MESH}\" stroke-width=\"{thin}\"");
    let rims = format!(
        "fill=\"none\" stroke=\"{OUTLINE}\" stroke-width=\"{outline}\" stroke-linejoin=\"round\""
    );
    let rim = |block: &Block, nodes: &[Point2<f64>]| -> Vec<Pixel> {
        let rim = marks::rim(block);
        rim.into_iter().filter_map(|node| nodes.get(node)).map(|p| frame.at(*p)).collect()
    };
    canvas.group(&fill, |canvas| {
        for (block, nodes) in model.blocks.iter().zip(moved) {
            canvas.polygon(&rim(block, nodes), "");
        }
    });
    canvas.group(&mesh, |canvas| {
        for (block, nodes) in model.blocks.iter().zip(moved) {
            draw_mesh(canvas, block, nodes, frame);
        }
    });
    canvas.group(&rims, |canvas| {
        for (block, nodes) in model.blocks.iter().zip(moved) {
            canvas.polygon(&rim(block, nodes), "");
        }
    });
}

/// The lines between the elements of one block.
fn draw_mesh(canvas: &mut Canvas, block: &Block, nodes: &[Point2<f64>], frame: &Frame) {
    let Some(mesh) = &block.mesh else { return };
    if nodes.len() < (mesh.nx + 1) * (mesh.ny + 1) {
        return;
    }
    let at = |i: usize, j: usize| frame.at(nodes[j * (mesh.nx + 1) + i]);
    for i in 1..mesh.nx {
        let line: Vec<Pixel> = (0..=mesh.ny).map(|j| at(i, j)).collect();
        canvas.polyline(&line);
    }
    for j in 1..mesh.ny {
        let line: Vec<Pixel> = (0..=mesh.nx).map(|i| at(i, j)).collect();
        canvas.polyline(&line);
    }
}

fn add_legend(sheet: &mut Sheet, units: InUnits, factor: f64, largest: f64) {
    sheet.entry("undeformed", |symbol| {
        let style = format!("fill=\"none\" stroke=\"{UNDEFORMED}\" stroke-width=\"0.8\"");
        symbol.rectangle(Pixel::new(-16.0, -6.0), 32.0, 12.0, &style);
    });
    let text = if largest > 0.0 {
        format!("deformed, displacements magnified {} times", significant(factor, 4))
    } else {
        "no displacement".to_owned()
    };
    sheet.entry(&text, |symbol| {
        let style = format!("fill=\"{FILLED}\" stroke=\"{OUTLINE}\" stroke-width=\"1\"");
        symbol.rectangle(Pixel::new(-16.0, -6.0), 32.0, 12.0, &style);
    });
    if largest > 0.0 {
        sheet.entry(&format!("largest component {}", units.length_text(largest)), |_| {});
    }
}
