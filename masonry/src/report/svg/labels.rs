//! Labels that keep out of one another's way, and out of that of arrows and strokes.

use nalgebra::{Rotation2, Vector2};

use super::canvas::{Anchor, Canvas, Pixel, text_width};

/// Where else a label is tried, if its own place is taken: further away, and to the sides \[degrees\].
const FURTHER: [f64; 4] = [0.0, 7.0, 15.0, 24.0];
const ASIDE: [f64; 7] = [0.0, 40.0, -40.0, 75.0, -75.0, 110.0, -110.0];

/// The places that labels have taken, and the marks that they avoid.
#[derive(Debug)]
pub(super) struct Labels {
    /// Where labels may be: left, top, right and bottom.
    room: [f64; 4],
    taken: Vec<[f64; 4]>,
    marks: Vec<[Pixel; 2]>,
}

impl Labels {
    /// No labels yet within a rectangle: left, top, right and bottom.
    pub(super) fn within(room: [f64; 4]) -> Self {
        Self { room, taken: Vec::new(), marks: Vec::new() }
    }

    /// Keeps labels away from a stroke.
    pub(super) fn avoid(&mut self, from: Pixel, to: Pixel) {
        self.marks.push([from, to]);
    }

    /// Draws a label on the side `n`, y up, of a place, or near it; not at all where there is no room.
    pub(super) fn draw(
        &mut self,
        canvas: &mut Canvas,
        at: Pixel,
        n: Vector2<f64>,
        size: f64,
        label: &str,
    ) {
        let half = Vector2::new(0.5 * text_width(label, size), 0.5 * size);
        let tried = FURTHER.iter().flat_map(|gap| ASIDE.iter().map(move |angle| (*gap, *angle)));
        for (gap, angle) in tried {
            let n = Rotation2::new(angle.to_radians()) * n;
            let middle = beside(at, n, half, gap);
            let [x, y] = [middle.x, middle.y];
            if self.take([x - half.x, y - half.y, x + half.x, y + half.y]) {
                let base = Pixel::new(x, y + 0.36 * size);
                canvas.rimmed_text(base, Anchor::Middle, size, label);
                return;
            }
        }
    }

    /// Whether a rectangle was free; from now on it is not.
    fn take(&mut self, rectangle: [f64; 4]) -> bool {
        let [left, top, right, bottom] = self.room;
        let is_inside = rectangle[0] >= left
            && rectangle[1] >= top
            && rectangle[2] <= right
            && rectangle[3] <= bottom;
        let is_free = is_inside
            && !self.taken.iter().any(|other| overlap(&rectangle, other))
            && !self.marks.iter().any(|mark| crosses(mark, &rectangle));
        if is_free {
            self.taken.push(rectangle);
        }
        is_free
    }
}

/// The middle of a box with these half sides that touches a place, or nearly, and lies on its side `n`, y up.
fn beside(at: Pixel, n: Vector2<f64>, half: Vector2<f64>, gap: f64) -> Pixel {
    let n = n.normalize();
    // So that the box begins at the place whatever its direction.
    let [x, y] = [half.x / n.x.abs(), half.y / n.y.abs()];
    let reach = if x < y { x } else { y };
    Pixel::new(at.x + n.x * (reach + gap), at.y - n.y * (reach + gap))
}

fn overlap(one: &[f64; 4], other: &[f64; 4]) -> bool {
    one[0] < other[2] && other[0] < one[2] && one[1] < other[3] && other[1] < one[3]
}

/// Whether a stroke has a part in a rectangle.
fn crosses([from, to]: &[Pixel; 2], rectangle: &[f64; 4]) -> bool {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    let axes =
        [(from.x, to.x, rectangle[0], rectangle[2]), (from.y, to.y, rectangle[1], rectangle[3])];
    for (from, to, low, high) in axes {
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
        let up = Vector2::new(0.0, 1.0);
        let at = Pixel::new(100.0, 100.0);
        let mut labels = Labels::within([0.0, 0.0, 200.0, 200.0]);
        labels.avoid(Pixel::new(100.0, 80.0), Pixel::new(100.0, 120.0));
        let mut canvas = Canvas::default();
        for _ in 0..2 {
            labels.draw(&mut canvas, at, up, 10.0, "10 kN");
        }
        let [one, other] = labels.taken.as_slice() else { panic!("{:?}", labels.taken) };
        assert!(!overlap(one, other));
        for it in [one, other] {
            assert!(!crosses(&labels.marks[0], it), "{it:?}");
        }
        let mut narrow = Labels::within([90.0, 90.0, 110.0, 110.0]);
        narrow.draw(&mut canvas, at, up, 10.0, "10 kN");
        assert!(narrow.taken.is_empty(), "{:?}", narrow.taken);
    }
}
