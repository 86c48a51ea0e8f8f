//! The width and the height of a structure, on lines beside it.

use super::canvas::{Anchor, Pixel, open};
use super::sheet::{Bounds, Sheet, Sides};
use super::structure;
use super::style::{TEXT, TICK};
use crate::format::InUnits;
use masonry::model::Model;

/// The distance between a dimension line and the other marks beside the structure, and the room for the line with its
/// text.
const GAP: f64 = 10.0;
const ROOM: f64 = GAP + TEXT + 8.0;

/// Width and height of the box around all blocks, shown by dimension lines.
#[derive(Debug)]
pub(super) struct Dimensions {
    bounds: Bounds,
    /// Room for the other marks between the structure and the dimension lines.
    others: Sides,
}

impl Dimensions {
    pub(super) fn of(model: &Model, others: Sides) -> Self {
        Self { bounds: structure::blocks(model), others }
    }

    /// Returns the room for the dimensions and the other marks.
    pub(super) fn margins(&self) -> Sides {
        let Sides { left, bottom, .. } = self.others;
        Sides { left: left + ROOM, bottom: bottom + ROOM, ..self.others }
    }

    /// Draws the width of the structure below it, and its height left of it.
    pub(super) fn draw(&self, sheet: &mut Sheet, units: InUnits) {
        let [low, high] = self.bounds.ends().map(|end| sheet.frame.at(end));
        let x = sheet.drawn.left - self.others.left - GAP;
        let y = sheet.drawn.bottom + self.others.bottom + GAP;
        sheet.layer("dimensions", |canvas, _| {
            let mut line = |[from, to]: [Pixel; 2], [dx, dy]: [f64; 2]| {
                let tick = |end: Pixel| {
                    open([-TICK, TICK].map(|t| Pixel::new(end.x + t * dx, end.y + t * dy)))
                };
                canvas.path(&[open([from, to]), tick(from), tick(to)].concat(), "");
            };
            line([Pixel::new(low.x, y), Pixel::new(high.x, y)], [0.0, 1.0]);
            line([Pixel::new(x, low.y), Pixel::new(x, high.y)], [1.0, 0.0]);
        });
        let [width, height] = [self.bounds.size().x, self.bounds.size().y];
        sheet.layer("sizes", |canvas, _| {
            let at = Pixel::new(0.5 * (low.x + high.x), y + TEXT + 2.0);
            canvas.text(at, Anchor::Middle, TEXT, "", &units.length_text(width));
            let at = Pixel::new(x - 5.0, 0.5 * (low.y + high.y));
            let turned = format!("transform=\"rotate(-90 {:.2} {:.2})\"", at.x, at.y);
            canvas.text(at, Anchor::Middle, TEXT, &turned, &units.length_text(height));
        });
    }
}
