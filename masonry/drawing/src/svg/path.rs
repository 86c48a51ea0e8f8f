//! Paths: their parts as polylines, with chords in place of curves.

use nalgebra::Point2;
use svgtypes::{SimplePathSegment, SimplifyingPathParser};

use crate::curve::{Chords, cubic};
use crate::shapes::MOST_CORNERS;
use crate::{DrawingError, DrawingErrorKind, Place};

/// The points of one part of a path.
pub(super) struct Part {
    pub(super) points: Vec<Point2<f64>>,
    pub(super) is_closed: bool,
    /// The largest distance between a curve and its chords; zero without curves.
    pub(super) off: f64,
}

pub(super) fn parts(text: &str, place: &Place) -> Result<Vec<Part>, DrawingError> {
    let mut parts: Vec<Part> = Vec::new();
    let mut part = start(Point2::origin());
    for segment in SimplifyingPathParser::from(text) {
        let segment = segment.map_err(|error| {
            DrawingErrorKind::Syntax { message: format!("path: {error}") }.at(place)
        })?;
        match segment {
            SimplePathSegment::MoveTo { x, y } => {
                parts.push(std::mem::replace(&mut part, start(Point2::new(x, y))));
            }
            SimplePathSegment::LineTo { x, y } => part.points.push(Point2::new(x, y)),
            SimplePathSegment::CurveTo { x1, y1, x2, y2, x, y } => {
                part.bend([[x1, y1], [x2, y2], [x, y]].map(Point2::from));
            }
            SimplePathSegment::Quadratic { x1, y1, x, y } => {
                let (from, middle, to) = (part.last(), Point2::new(x1, y1), Point2::new(x, y));
                let toward = |end: Point2<f64>| end + (middle - end) * (2.0 / 3.0);
                part.bend([toward(from), toward(to), to]);
            }
            SimplePathSegment::ClosePath => {
                part.is_closed = true;
                let first = part.points[0];
                parts.push(std::mem::replace(&mut part, start(first)));
            }
        }
        if part.points.len() >= MOST_CORNERS {
            let kind =
                DrawingErrorKind::TooMany { what: "corners of one path", limit: MOST_CORNERS };
            return Err(kind.at(place));
        }
    }
    parts.push(part);
    parts.retain(|part| part.points.len() > 1);
    Ok(parts)
}

fn start(point: Point2<f64>) -> Part {
    Part { points: vec![point], is_closed: false, off: 0.0 }
}

impl Part {
    fn last(&self) -> Point2<f64> {
        self.points.last().copied().unwrap_or_default()
    }

    fn bend(&mut self, [one, other, to]: [Point2<f64>; 3]) {
        let Chords { points, off } = cubic([self.last(), one, other, to]);
        self.points.extend(points);
        self.off = self.off.max(off);
    }
}
