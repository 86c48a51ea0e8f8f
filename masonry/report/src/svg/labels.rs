//! Labels that do not collide with one another, or with arrows and strokes.

use nalgebra::{Rotation2, Vector2};

use super::canvas::{Anchor, Canvas, Pixel, text_width};
use super::sheet::Sides;

/// Places at which a label is tried: distances from its point, and angles to its preferred side \[degrees\].
const FURTHER: [f64; 4] = [0.0, 7.0, 15.0, 24.0];
const ASIDE: [f64; 7] = [0.0, 40.0, -40.0, 75.0, -75.0, 110.0, -110.0];

/// A text beside a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Label<'a> {
    pub(super) text: &'a str,
    pub(super) size: f64,
    pub(super) at: Pixel,
    /// The preferred direction from the point to the label, y up.
    pub(super) side: Vector2<f64>,
    /// SVG attributes of the text.
    pub(super) name: &'a str,
}

/// The rectangles that labels have taken, and the strokes that labels avoid.
#[derive(Debug)]
pub(super) struct Labels {
    /// The area in which labels may lie.
    room: Sides,
    taken: Vec<Sides>,
    strokes: Vec<[Pixel; 2]>,
}

impl Labels {
    /// Creates an empty set of labels in an area.
    pub(super) fn within(room: Sides) -> Self {
        Self { room, taken: Vec::new(), strokes: Vec::new() }
    }

    /// Adds a stroke that labels avoid.
    pub(super) fn avoid(&mut self, stroke: [Pixel; 2]) {
        self.strokes.push(stroke);
    }

    /// Draws a label on the preferred side of its point, or near its point; draws nothing if there is no room.
    pub(super) fn draw(&mut self, canvas: &mut Canvas, label: &Label<'_>) {
        let Label { text, size, at, side, name } = *label;
        let half = Vector2::new(0.5 * text_width(text, size), 0.5 * size);
        let tried = FURTHER.iter().flat_map(|gap| ASIDE.map(move |angle| (*gap, angle)));
        let middles = tried.map(|(gap, angle)| {
            beside(at, Rotation2::new(f64::to_radians(angle)) * side, half, gap)
        });
        for Pixel { x, y } in middles {
            let (left, right) = (x - half.x, x + half.x);
            if self.take(Sides { left, right, top: y - half.y, bottom: y + half.y }) {
                let base = Pixel::new(x, y + 0.36 * size);
                return canvas.text(base, Anchor::Middle, size, name, text);
            }
        }
    }

    /// Takes a rectangle for a label; `false` if the rectangle is not free.
    fn take(&mut self, it: Sides) -> bool {
        let room = &self.room;
        let is_free = it.left >= room.left
            && it.right <= room.right
            && it.top >= room.top
            && it.bottom <= room.bottom
            && !self.taken.iter().any(|other| overlap(&it, other))
            && !self.strokes.iter().any(|stroke| crosses(stroke, &it));
        if is_free {
            self.taken.push(it);
        }
        is_free
    }
}

/// Returns the middle of a box with these half sides that lies on the side `n` (y up) of a point, and touches the point
/// or is `gap` away from it.
fn beside(at: Pixel, n: Vector2<f64>, half: Vector2<f64>, gap: f64) -> Pixel {
    let n = n.normalize();
    // The box touches the point for all directions `n` if the gap is zero.
    let reach = (half.x / n.x.abs()).min(half.y / n.y.abs());
    at.along(n, reach + gap)
}

fn overlap(one: &Sides, other: &Sides) -> bool {
    one.left < other.right
        && other.left < one.right
        && one.top < other.bottom
        && other.top < one.bottom
}

/// Whether a stroke intersects a rectangle.
fn crosses([from, to]: &[Pixel; 2], it: &Sides) -> bool {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for (from, to, low, high) in
        [(from.x, to.x, it.left, it.right), (from.y, to.y, it.top, it.bottom)]
    {
        let along = to - from;
        if along == 0.0 {
            if from <= low || from >= high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - from) / along, (high - from) / along);
        enters = enters.max(a.min(b));
        leaves = leaves.min(a.max(b));
    }
    enters < leaves
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_label_makes_way_for_strokes_and_labels_and_stays_in_its_room() {
        let at = Pixel::new(100.0, 100.0);
        let label = Label { text: "10 kN", size: 10.0, at, side: Vector2::new(0.0, 1.0), name: "" };
        let mut labels = Labels::within(Sides { left: 0.0, right: 200.0, top: 0.0, bottom: 200.0 });
        labels.avoid([Pixel::new(100.0, 80.0), Pixel::new(100.0, 120.0)]);
        let mut canvas = Canvas::default();
        for _ in 0..2 {
            labels.draw(&mut canvas, &label);
        }
        let [one, other] = labels.taken.as_slice() else { panic!("{:?}", labels.taken) };
        assert!(!overlap(one, other));
        for it in [one, other] {
            assert!(!crosses(&labels.strokes[0], it), "{it:?}");
        }
        let mut narrow =
            Labels::within(Sides { left: 90.0, right: 110.0, top: 90.0, bottom: 110.0 });
        narrow.draw(&mut canvas, &label);
        assert!(narrow.taken.is_empty(), "{:?}", narrow.taken);
    }
}
