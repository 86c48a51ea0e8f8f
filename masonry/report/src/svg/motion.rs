//! Movements, magnified so that they are seen; a page can change the magnification.

use nalgebra::Vector2;

use super::canvas::{Canvas, fixed};
use super::sheet::{Bounds, Frame};
use crate::format::round_down;

/// The length that the largest movement should come close to: the lesser of these parts of the diagonal and of the
/// smaller side of the structure.
const OF_DIAGONAL: f64 = 0.07;
const OF_SIDE: f64 = 0.3;
/// The largest magnification on a page, relative to that in a file.
const PAGE: f64 = 2.0;

/// The magnification of movements, equal in pictures that are compared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    pub(super) factor: f64,
    /// Whether a page changes the factor.
    pub(super) for_page: bool,
}

impl Motion {
    /// Nothing moves.
    pub(super) const NONE: Self = Self { factor: 0.0, for_page: false };

    /// A round factor by which the largest movement of a structure within `bounds` is seen; 1 if nothing moves.
    pub(super) fn seen(largest: f64, bounds: &Bounds, for_page: bool) -> Self {
        let (side, diagonal) = (bounds.size().min(), bounds.size().norm());
        let slender = if side > 0.0 { OF_SIDE * side } else { f64::INFINITY };
        let wanted = slender.min(OF_DIAGONAL * diagonal) / largest;
        let factor = if wanted.is_finite() && wanted > 0.0 { round_down(wanted) } else { 1.0 };
        Self { factor, for_page }
    }

    /// The largest factor of a page.
    pub(super) fn furthest(self) -> f64 {
        if self.for_page { PAGE * self.factor } else { self.factor }
    }

    /// Draws a path whose data depend on the factor; a path for a page also has the data before the movement.
    pub(super) fn path(self, canvas: &mut Canvas, name: &str, data: impl Fn(f64) -> String) {
        let now = data(self.factor);
        let before = if self.for_page { data(0.0) } else { now.clone() };
        if before == now {
            canvas.path(&now, name);
        } else {
            canvas.path(&now, &format!("{name} data-before=\"{before}\""));
        }
    }

    /// The attribute by which a page moves a mark \[m\] that keeps its shape.
    pub(super) fn of_mark(self, frame: &Frame, movement: Vector2<f64>) -> String {
        let [x, y] = [movement.x, -movement.y].map(|it| fixed(it * self.factor * frame.scale));
        if self.for_page { format!(" data-moved=\"{x},{y}\"") } else { String::new() }
    }
}
