//! Movements, magnified so that they are seen; a page can change the magnification.

use nalgebra::Vector2;

use super::canvas::{Canvas, fixed};
use super::sheet::{Bounds, Frame};
use crate::format::round_down;

/// The displayed length of the largest displacement is close to the smaller of two lengths: this part of the diagonal
/// of the structure (`OF_DIAGONAL`), and of its smaller side (`OF_SIDE`).
const OF_DIAGONAL: f64 = 0.07;
const OF_SIDE: f64 = 0.3;
/// The largest magnification on a page, divided by the magnification in a file.
const PAGE: f64 = 2.0;

/// The magnification of displacements, equal in pictures that are compared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    pub(super) factor: f64,
    /// Whether the picture is on a page, which can change the factor.
    pub(super) for_page: bool,
}

impl Motion {
    /// No motion: the factor is zero.
    pub(super) const NONE: Self = Self { factor: 0.0, for_page: false };

    /// Returns a round factor by which the largest displacement of a structure within `bounds` is visible; 1 if nothing
    /// moves.
    pub(super) fn seen(largest: f64, bounds: &Bounds, for_page: bool) -> Self {
        let (side, diagonal) = (bounds.size().min(), bounds.size().norm());
        let slender = if side > 0.0 { OF_SIDE * side } else { f64::INFINITY };
        let wanted = slender.min(OF_DIAGONAL * diagonal) / largest;
        let factor = if wanted.is_finite() && wanted > 0.0 { round_down(wanted) } else { 1.0 };
        Self { factor, for_page }
    }

    /// Returns the largest factor that a page can choose, or the factor itself in a file.
    pub(super) fn furthest(self) -> f64 {
        if self.for_page { PAGE * self.factor } else { self.factor }
    }

    /// Draws a path whose data depend on the factor; a path on a page has the data before the motion in addition.
    pub(super) fn path(self, canvas: &mut Canvas, name: &str, data: impl Fn(f64) -> String) {
        let now = data(self.factor);
        let before = if self.for_page { data(0.0) } else { now.clone() };
        if before == now {
            canvas.path(&now, name);
        } else {
            canvas.path(&now, &format!("{name} data-before=\"{before}\""));
        }
    }

    /// Returns the attribute by which a page moves a mark that keeps its shape; `movement` is in metres.
    pub(super) fn of_mark(self, frame: &Frame, movement: Vector2<f64>) -> String {
        let [x, y] = [movement.x, -movement.y].map(|it| fixed(it * self.factor * frame.scale));
        if self.for_page { format!(" data-moved=\"{x},{y}\"") } else { String::new() }
    }
}
