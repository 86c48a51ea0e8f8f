//! The deformed structure over its undeformed outline.

use nalgebra::{Point2, Vector2};

use super::canvas::{Pixel, closed, open};
use super::legend;
use super::motion::Motion;
use super::names;
use super::sheet::{Bounds, Frame, Sheet, Shown, Sides};
use super::structure;
use crate::format::{InUnits, significant};
use crate::summary::{largest_displacement, nodes};
use masonry::data::state::State;
use masonry::model::mesh::BlockMesh;
use masonry::model::{Model, PlacedBlock};
use masonry::rounding;

/// The magnification and the room that pictures of displacements share, so that the pictures of a load history can be
/// compared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Magnified {
    motion: Motion,
    bounds: Bounds,
    /// The largest displacement in all pictures \[m\].
    largest: f64,
}

impl Magnified {
    /// Returns a magnification at which the largest displacement of the states is readable, with room for larger
    /// magnifications on a page.
    pub(crate) fn of(all: &[Shown<'_>], for_page: bool) -> Self {
        let largest = rounding::largest(all.iter().map(largest));
        let still = Bounds::of(all.iter().flat_map(|it| structure::bounds(it.model).ends()));
        let motion = Motion::seen(largest, &still, for_page);
        let room = motion.furthest();
        let moved = all.iter().flat_map(|Shown { model, state, .. }| {
            let blocks = model.blocks.iter().zip(&state.displacements);
            let supports = model.supports.iter().flat_map(move |support| {
                [support.from, support.to].map(|end| end + support.displacement_at(end) * room)
            });
            blocks.flat_map(move |(block, moves)| moved(nodes(block), moves, room)).chain(supports)
        });
        Self { motion, bounds: Bounds::of(moved.chain(still.ends())), largest }
    }
}

fn largest(shown: &Shown<'_>) -> f64 {
    largest_displacement(shown.model, shown.state).map_or(0.0, |it| it.value.abs())
}

/// Returns points after their displacements, which are magnified by `factor`.
pub(super) fn moved<'a>(
    points: &'a [Point2<f64>],
    moves: &'a [Vector2<f64>],
    factor: f64,
) -> impl Iterator<Item = Point2<f64>> + 'a {
    points.iter().zip(moves).map(move |(point, u)| point + u * factor)
}

/// Draws the deformed structure over the undeformed outline, magnified by a round factor that the legend shows. Joints
/// that open show the white of the paper.
pub fn deformed(title: &str, model: &Model, state: &State) -> String {
    let shown = Shown { title, model, state };
    compared(&shown, &Magnified::of(&[shown], false))
}

/// Draws the picture of [`deformed`] with the magnification that it shares with other pictures.
pub(crate) fn compared(shown: &Shown<'_>, by: &Magnified) -> String {
    let Shown { title, model, state } = *shown;
    let mut sheet = Sheet::new(format!("{title}: deformed"), model, by.bounds, Sides::HATCH);
    structure::outlines(&mut sheet, "undeformed", &model.blocks);
    let blocks = || model.blocks.iter().zip(&state.displacements);
    sheet.layer("deformed", |canvas, frame| {
        for (block, moves) in blocks() {
            let rim = structure::rim(block);
            by.motion.path(canvas, &names::block(block), |factor| {
                closed(pixels(frame, block, moves, &rim, factor))
            });
        }
    });
    sheet.layer("mesh", |canvas, frame| {
        for (block, moves) in blocks() {
            for line in mesh_lines(block, moves.len()) {
                let data = |factor| open(pixels(frame, block, moves, &line, factor));
                by.motion.path(canvas, "", data);
            }
        }
    });
    structure::supports(&mut sheet, model, by.motion);
    explain(&mut sheet, shown, by);
    sheet.finish()
}

/// Returns the pixels of some nodes of a block; `nodes` are indices into its list of nodes.
fn pixels(
    frame: &Frame,
    block: &PlacedBlock,
    moves: &[Vector2<f64>],
    positions: &[usize],
    factor: f64,
) -> Vec<Pixel> {
    let nodes: Vec<Point2<f64>> = moved(nodes(block), moves, factor).collect();
    positions.iter().filter_map(|k| nodes.get(*k)).map(|node| frame.at(*node)).collect()
}

/// Returns the lines between the elements of one block, as indices into the list of its nodes.
fn mesh_lines(block: &PlacedBlock, nodes: usize) -> Vec<Vec<usize>> {
    let mesh = block.mesh.as_ref().filter(|it| nodes >= it.nodes.len());
    mesh.map_or_else(Vec::new, BlockMesh::lines)
}

fn explain(sheet: &mut Sheet, shown: &Shown<'_>, by: &Magnified) {
    let factor = significant(by.motion.factor, 4);
    if by.motion.for_page && by.largest > 0.0 {
        sheet.tell("magnified", &factor);
    }
    sheet.legend.add("undeformed", "undeformed", legend::block);
    let largest = largest(shown);
    let text = if largest > 0.0 { "deformed" } else { "no displacement" };
    sheet.legend.add(text, "deformed", legend::block);
    if largest > 0.0 {
        // The note is a separate line, since a page changes it.
        sheet.legend.note(&format!("magnified {factor} times"));
        let largest = InUnits(shown.model.units).length_text(largest);
        sheet.legend.note(&format!("largest component {largest}"));
    }
}
