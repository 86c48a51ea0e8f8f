//! The width and the height of a structure, on lines beside it.

use super::canvas::{Anchor, Pixel};
use super::sheet::{Bounds, Margins, Sheet};
use super::style::TEXT;
use crate::model::Model;
use crate::report::format::InUnits;

const COLOUR: &str = "#555555";
/// From what else stands beside the structure to a dimension line, and room for its text.
const GAP: f64 = 10.0;
const ROOM: f64 = GAP + TEXT + 8.0;
const TICK: f64 = 5.0;

/// Width and height of the box around all blocks.
#[derive(Debug)]
pub(super) struct Dimensions {
    bounds: Bounds,
    /// Room of all else beside the structure.
    others: Margins,
}

impl Dimensions {
    pub(super) fn of(model: &Model, others: Margins) -> Self {
        let corners = model.blocks.iter().flat_map(|block| block.corners.iter().copied());
        Self { bounds: Bounds::of(corners), others }
    }

    /// Room with that of all else.
    pub(super) fn margins(&self) -> Margins {
        let Margins { left, right, top, bottom } = self.others;
        Margins { left: left + ROOM, right, top, bottom: bottom + ROOM }
    }

    /// The width below and the height left of the structure.
    pub(super) fn draw(&self, sheet: &mut Sheet, units: InUnits) {
        let (frame, size) = (sheet.frame, self.bounds.size());
        let (low, high) = (frame.at(self.bounds.low), frame.at(self.bounds.high));
        let [left, _, _, bottom] = sheet.drawn();
        let (x, y) = (left - self.others.left - GAP, bottom + self.others.bottom + GAP);
        sheet.canvas.group(&format!("class=\"dimensions\" stroke=\"{COLOUR}\""), |canvas| {
            let mut line = |from: Pixel, to: Pixel, [dx, dy]: [f64; 2]| {
                canvas.line(from, to, "");
                for end in [from, to] {
                    let [a, b] = [-TICK, TICK].map(|t| Pixel::new(end.x + t * dx, end.y + t * dy));
                    canvas.line(a, b, "");
                }
            };
            line(Pixel::new(low.x, y), Pixel::new(high.x, y), [0.0, 1.0]);
            line(Pixel::new(x, low.y), Pixel::new(x, high.y), [1.0, 0.0]);
        });
        sheet.canvas.group(&format!("class=\"dimensions\" fill=\"{COLOUR}\""), |canvas| {
            let at = Pixel::new(0.5 * (low.x + high.x), y + TEXT + 2.0);
            canvas.text(at, Anchor::Middle, TEXT, &units.length_text(size.x));
            let at = Pixel::new(x - 5.0, 0.5 * (low.y + high.y));
            let turned = format!("transform=\"rotate(-90 {:.2} {:.2})\"", at.x, at.y);
            canvas.text_with(at, Anchor::Middle, TEXT, &turned, &units.length_text(size.y));
        });
    }
}
