//! Labels that keep out of one another's way.

use nalgebra::Vector2;

use super::canvas::{Anchor, Canvas, Pixel, text_width};

/// The places that labels have taken: left, top, right and bottom.
#[derive(Debug, Default)]
pub(super) struct Labels(Vec<[f64; 4]>);

impl Labels {
    /// Draws a label on the side `n`, y up, of a place, unless another one is there.
    pub(super) fn draw(
        &mut self,
        canvas: &mut Canvas,
        at: Pixel,
        n: Vector2<f64>,
        size: f64,
        label: &str,
    ) {
        let width = text_width(label, size);
        let (anchor, left) = if n.x > 0.5 {
            (Anchor::Start, at.x)
        } else if n.x < -0.5 {
            (Anchor::End, at.x - width)
        } else {
            (Anchor::Middle, at.x - 0.5 * width)
        };
        let base = at.y + 0.36 * size - n.y * 0.36 * size;
        if self.take([left, base - size, left + width, base]) {
            canvas.rimmed_text(Pixel::new(at.x, base), anchor, size, label);
        }
    }

    /// Whether a rectangle was free; from now on it is not.
    pub(super) fn take(&mut self, rectangle: [f64; 4]) -> bool {
        let is_free = !self.0.iter().any(|other| overlap(&rectangle, other));
        if is_free {
            self.0.push(rectangle);
        }
        is_free
    }
}

fn overlap(one: &[f64; 4], other: &[f64; 4]) -> bool {
    one[0] < other[2] && other[0] < one[2] && one[1] < other[3] && other[1] < one[3]
}
