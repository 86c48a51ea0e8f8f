//! The deformed structure over its undeformed outline.

use crate::data::state::State;
use nalgebra::{Point2, Vector2};

use super::canvas::{Pixel, before, fixed};
use super::marks;
use super::names;
use super::sheet::{BLOCK, Bounds, Margins, Sheet};
use super::style::OUTLINE;
use crate::model::{Block, Model};
use crate::report::format::{InUnits, round_down, significant};
use crate::report::summary::{largest_displacement, nodes};

const UNDEFORMED: &str = "#a8a8a8";
const FILLED: &str = "#f0dcc3";
const MESH: &str = "#bfa582";
/// What the largest displacement should come close to: parts of the structure's diagonal and of
/// its smaller side, whichever is less.
const SHOWN: (f64, f64) = (0.07, 0.3);
/// A page magnifies up to so many times as much as a file.
pub(super) const PAGE: f64 = 2.0;

/// How displacements are magnified, alike in all pictures of a load history.
#[derive(Debug, Clone, Copy)]
pub(in crate::report) struct Magnified {
    factor: f64,
    /// The largest displacement of all \[m\].
    largest: f64,
    bounds: Bounds,
    /// Whether a page changes the factor.
    for_page: bool,
}

impl Magnified {
    /// So that the largest displacement of these states is readable; for a page with room for more.
    pub(in crate::report) fn of(states: &[(&Model, &State)], for_page: bool) -> Self {
        let largest_of = |(model, state): &(&Model, &State)| {
            largest_displacement(model, state).map_or(0.0, |it| it.value.abs())
        };
        let largest = states.iter().map(largest_of).fold(0.0, f64::max);
        let all = states.iter().map(|(model, _)| marks::bounds(model));
        let still = Bounds::of(all.flat_map(|bounds| [bounds.low, bounds.high]));
        let factor = magnification(&still, largest);
        let room = if for_page { PAGE * factor } else { factor };
        let moved = states.iter().flat_map(|(model, state)| {
            let blocks = model.blocks.iter().zip(&state.displacements);
            let supports = model.supports.iter().flat_map(move |support| {
                [support.from, support.to].map(|end| end + support.displacement_at(end) * room)
            });
            blocks.flat_map(move |(block, moves)| moved_nodes(block, moves, room)).chain(supports)
        });
        let bounds = Bounds::of(moved.chain([still.low, still.high]));
        Self { factor, largest, bounds, for_page }
    }
}

/// The deformed structure, magnified by a round factor that the legend states, over the undeformed
/// outline. Joints that open show the white of the paper.
pub fn deformed(title: &str, model: &Model, state: &State) -> String {
    magnified(title, model, state, &Magnified::of(&[(model, state)], false))
}

/// The same, magnified like others.
pub(in crate::report) fn magnified(
    title: &str,
    model: &Model,
    state: &State,
    by: &Magnified,
) -> String {
    let mut sheet = Sheet::new(&format!("{title}: deformed"), model, by.bounds, Margins::HATCH);
    let width = marks::outline_width(sheet.brick);
    let thin = fixed(0.7 * width);
    let style = format!(
        "class=\"undeformed\" fill=\"none\" stroke=\"{UNDEFORMED}\" stroke-width=\"{thin}\""
    );
    marks::outlines(&mut sheet, &model.blocks, &style);
    draw_moved(&mut sheet, model, state, by, width);
    marks::moved_supports(&mut sheet, model, by.factor, by.for_page);
    if by.for_page && by.largest > 0.0 {
        sheet.tell("magnified", &significant(by.factor, 4));
    }
    add_legend(&mut sheet, InUnits(model.units), by, model, state);
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

fn moved_nodes(block: &Block, moves: &[Vector2<f64>], factor: f64) -> Vec<Point2<f64>> {
    nodes(block).iter().zip(moves).map(|(node, u)| node + u * factor).collect()
}

fn draw_moved(sheet: &mut Sheet, model: &Model, state: &State, by: &Magnified, width: f64) {
    let frame = sheet.frame;
    let (outline, thin) = (fixed(width), fixed(0.5 * width));
    let fill = format!("class=\"deformed\" fill=\"{FILLED}\" fill-opacity=\"0.8\" stroke=\"none\"");
    let mesh = format!("class=\"mesh\" fill=\"none\" stroke=\"{MESH}\" stroke-width=\"{thin}\"");
    let rims = format!(
        "fill=\"none\" stroke=\"{OUTLINE}\" stroke-width=\"{outline}\" stroke-linejoin=\"round\""
    );
    // Lines through nodes of a block where they are, and for a page where they were.
    let line = |block: &Block, moves: &[Vector2<f64>], nodes_of_line: &[usize]| {
        let pixels = |factor: f64| -> Vec<Pixel> {
            let nodes = moved_nodes(block, moves, factor);
            nodes_of_line.iter().filter_map(|k| nodes.get(*k)).map(|p| frame.at(*p)).collect()
        };
        let name = names::block(block);
        let still = if by.for_page { format!("{name} {}", before(&pixels(0.0))) } else { name };
        (pixels(by.factor), still)
    };
    let blocks = || model.blocks.iter().zip(&state.displacements);
    for (style, is_mesh) in [(fill, false), (mesh, true), (rims, false)] {
        sheet.canvas.group(&style, |canvas| {
            for (block, moves) in blocks() {
                if is_mesh {
                    for nodes in mesh_lines(block, moves.len()) {
                        let (points, still) = line(block, moves, &nodes);
                        canvas.polyline(&points, &still);
                    }
                } else {
                    let (points, still) = line(block, moves, &marks::rim(block));
                    canvas.polygon(&points, &still);
                }
            }
        });
    }
}

/// The lines between the elements of one block, as positions in the list of its nodes.
fn mesh_lines(block: &Block, nodes: usize) -> Vec<Vec<usize>> {
    let Some(mesh) = block.mesh.as_ref().filter(|it| nodes >= (it.nx + 1) * (it.ny + 1)) else {
        return Vec::new();
    };
    let at = |i: usize, j: usize| j * (mesh.nx + 1) + i;
    let upright = (1..mesh.nx).map(|i| (0..=mesh.ny).map(|j| at(i, j)).collect());
    let level = (1..mesh.ny).map(|j| (0..=mesh.nx).map(|i| at(i, j)).collect());
    upright.chain(level).collect()
}

fn add_legend(sheet: &mut Sheet, units: InUnits, by: &Magnified, model: &Model, state: &State) {
    sheet.entry("undeformed", |symbol| {
        let style = format!("fill=\"none\" stroke=\"{UNDEFORMED}\" stroke-width=\"0.8\"");
        symbol.rectangle(BLOCK, -2.0 * BLOCK.x, -2.0 * BLOCK.y, &style);
    });
    let largest = largest_displacement(model, state).map_or(0.0, |it| it.value.abs());
    let factor = significant(by.factor, 4);
    let text = match (largest > 0.0, by.for_page) {
        (true, false) => format!("deformed, displacements magnified {factor} times"),
        (true, true) => "deformed".to_owned(),
        (false, _) => "no displacement".to_owned(),
    };
    sheet.block_entry(&text, FILLED);
    if largest > 0.0 && by.for_page {
        // A line of its own, which the page changes.
        sheet.note(&format!("magnified {factor} times"));
    }
    if largest > 0.0 {
        sheet.note(&format!("largest component {}", units.length_text(largest)));
    }
}
