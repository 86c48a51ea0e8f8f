//! The points of single entities.

use nalgebra::Point2;

use super::pairs::Record;
use crate::DrawingError;
use crate::curve::{Arc, Chords, bulged};

/// The points of an entity, in their order.
pub(super) struct Shape {
    pub(super) points: Vec<Point2<f64>>,
    pub(super) is_closed: bool,
    /// The largest distance between an arc and its chords; zero without arcs.
    pub(super) off: f64,
}

/// A vertex, and the bulge of the side from it to the next vertex.
type Vertex = (Point2<f64>, f64);

pub(super) fn line(record: &Record) -> Result<Shape, DrawingError> {
    let points = vec![record.point(10)?, record.point(11)?];
    Ok(Shape { points, is_closed: false, off: 0.0 })
}

pub(super) fn arc(record: &Record) -> Result<Shape, DrawingError> {
    let [from, to] = [record.number(50, 0.0)?, record.number(51, 360.0)?];
    let sweep = (to - from).rem_euclid(360.0);
    if sweep == 0.0 {
        return circle(record);
    }
    let (centre, radius) = (record.point(10)?, record.number(40, 0.0)?);
    let [from, sweep] = [from, sweep].map(f64::to_radians);
    let Chords { points, off } = Arc { centre, radius, from, sweep }.chords();
    Ok(Shape { points, is_closed: false, off })
}

pub(super) fn circle(record: &Record) -> Result<Shape, DrawingError> {
    let Chords { mut points, off } =
        Arc::circle(record.point(10)?, record.number(40, 0.0)?).chords();
    points.pop();
    Ok(Shape { points, is_closed: true, off })
}

/// Returns the corners of a solid, whose third and fourth corners are exchanged in the file.
pub(super) fn solid(record: &Record) -> Result<Shape, DrawingError> {
    let mut points = Vec::new();
    for code in [10, 11, 13, 12] {
        if record.text(code).is_some() {
            points.push(record.point(code)?);
        }
    }
    Ok(Shape { points, is_closed: true, off: 0.0 })
}

pub(super) fn light_polyline(record: &Record) -> Result<Shape, DrawingError> {
    let mut vertices: Vec<Vertex> = Vec::new();
    for pair in &record.pairs {
        match (pair.code, vertices.last_mut()) {
            (10, _) => vertices.push((Point2::new(record.parsed(pair)?, 0.0), 0.0)),
            (20, Some(vertex)) => vertex.0.y = record.parsed(pair)?,
            (42, Some(vertex)) => vertex.1 = record.parsed(pair)?,
            _ => {}
        }
    }
    Ok(joined(&vertices, record.flags(70) & 1 != 0))
}

/// Returns the points of a polyline of the old kind, whose vertices are separate records.
pub(super) fn polyline(record: &Record, vertices: &[Record]) -> Result<Shape, DrawingError> {
    /// The flag of control points of a spline, which do not lie on the spline.
    const FRAME: i64 = 16;
    let mut points: Vec<Vertex> = Vec::new();
    for vertex in vertices.iter().filter(|it| it.flags(70) & FRAME == 0) {
        points.push((vertex.point(10)?, vertex.number(42, 0.0)?));
    }
    Ok(joined(&points, record.flags(70) & 1 != 0))
}

fn joined(vertices: &[Vertex], is_closed: bool) -> Shape {
    let mut shape = Shape { points: Vec::new(), is_closed, off: 0.0 };
    for (k, (point, bulge)) in vertices.iter().enumerate() {
        if k + 1 == vertices.len() && !is_closed {
            shape.points.push(*point);
            break;
        }
        let (next, _) = vertices[(k + 1) % vertices.len()];
        let Chords { points, off } = bulged([*point, next], *bulge);
        shape.points.extend(points);
        shape.off = shape.off.max(off);
    }
    shape
}
