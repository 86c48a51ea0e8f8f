//! Wavefront OBJ: faces in one plane, or bodies that are prisms; and lines.

use nalgebra::Point3;

use super::error::shown;
use super::mesh::{self, Mesh};
use super::shapes::{MOST_POINTS, MOST_SHAPES};
use super::{Drawing, DrawingError, DrawingErrorKind, DrawnLine, Place};

/// The material of faces for which the file gives none.
const MATERIAL: &str = "stone";

/// The reader of a file, line by line.
#[derive(Default)]
struct Reader {
    corners: Vec<Point3<f64>>,
    /// The bodies; their faces have indices into the corners of the whole file.
    bodies: Vec<Mesh>,
    lines: Vec<SpaceLine>,
    material: Option<String>,
}

/// A line in space, before it is projected into a plane.
struct SpaceLine {
    /// Indices of the points among the corners of the file.
    points: Vec<usize>,
    layer: String,
    place: Place,
}

pub(super) fn read(text: &str) -> Result<Drawing, DrawingError> {
    let mut reader = Reader::default();
    for (number, line) in (1..).zip(text.lines()) {
        reader.line(line, number)?;
    }
    let mut drawing = Drawing::default();
    let meshes = reader.bodies.iter().map(|body| body.own(&reader.corners)).collect();
    let plane = mesh::add(&mut drawing, meshes)?;
    for SpaceLine { points, layer, place } in reader.lines {
        let points = points.iter().map(|k| plane.project(reader.corners[*k])).collect();
        drawing.add_line(DrawnLine { points, layer, place })?;
    }
    Ok(drawing)
}

impl Reader {
    fn line(&mut self, line: &str, number: usize) -> Result<(), DrawingError> {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_whitespace();
        let keyword = words.next().unwrap_or_default();
        let rest = line.trim_start().get(keyword.len()..).unwrap_or_default().trim();
        let place = Place::new(shown(keyword), Some(number));
        match keyword {
            "v" => self.corner(words, &place)?,
            "f" => {
                let face = self.indices(words, &place)?;
                self.body(number).faces.push(face);
            }
            "l" => {
                let points = self.indices(words, &place)?;
                let layer = self.material.clone().unwrap_or_else(|| MATERIAL.into());
                push(&mut self.lines, SpaceLine { points, layer, place: place.clone() }, &place)?;
            }
            "o" | "g" => {
                let place = Place::new(format!("{keyword} {}", shown(rest)), Some(number));
                let layer = self.material.clone().unwrap_or_else(|| MATERIAL.into());
                let name = Some(shown(rest)).filter(|it| !it.is_empty());
                let body = Mesh { name, layer, place: place.clone(), ..Mesh::default() };
                push(&mut self.bodies, body, &place)?;
            }
            "usemtl" => {
                self.material = Some(shown(rest));
                let layer = shown(rest);
                if let Some(body) = self.bodies.last_mut().filter(|it| it.faces.is_empty()) {
                    body.layer = layer;
                } else {
                    let place = Place::new(format!("usemtl {layer}"), Some(number));
                    let body = Mesh { layer, place: place.clone(), ..Mesh::default() };
                    push(&mut self.bodies, body, &place)?;
                }
            }
            // Normals, textures and smoothing do not matter. A file of another kind has no faces, which is an error
            // later.
            _ => {}
        }
        Ok(())
    }

    fn corner<'a>(
        &mut self,
        words: impl Iterator<Item = &'a str>,
        place: &Place,
    ) -> Result<(), DrawingError> {
        let mut corner = [0.0; 3];
        let mut count = 0;
        for (to, word) in corner.iter_mut().zip(words) {
            let wrong = |_| DrawingErrorKind::Number { text: shown(word) }.at(place);
            *to = word.parse().map_err(wrong)?;
            count += 1;
        }
        if count < corner.len() {
            return Err(DrawingErrorKind::Truncated.at(place));
        }
        if self.corners.len() == MOST_POINTS {
            let kind = DrawingErrorKind::TooMany { what: "corners", limit: MOST_POINTS };
            return Err(kind.at(place));
        }
        self.corners.push(Point3::from(corner));
        Ok(())
    }

    /// Returns the indices of the corners of a face or line. The numbers in the file count from 1, or, if negative,
    /// backwards from the last corner.
    fn indices<'a>(
        &self,
        words: impl Iterator<Item = &'a str>,
        place: &Place,
    ) -> Result<Vec<usize>, DrawingError> {
        let index = |word: &str| {
            let text = word.split('/').next().unwrap_or_default();
            let number: Option<i64> = text.parse().ok();
            let index = number.and_then(|number| match number {
                1.. => usize::try_from(number - 1).ok(),
                _ => self.corners.len().checked_sub(usize::try_from(number.unsigned_abs()).ok()?),
            });
            let unknown = || DrawingErrorKind::UnknownCorner { corner: shown(text) }.at(place);
            index.filter(|it| *it < self.corners.len()).ok_or_else(unknown)
        };
        words.map(index).collect()
    }

    /// Returns the body to which the next face belongs: the last body, or a new one if there is none.
    fn body(&mut self, number: usize) -> &mut Mesh {
        if self.bodies.is_empty() {
            let place = Place::new("OBJ", Some(number));
            self.bodies.push(Mesh { layer: MATERIAL.to_owned(), place, ..Mesh::default() });
        }
        let last = self.bodies.len() - 1;
        &mut self.bodies[last]
    }
}

/// Adds a body or a line to a list; an error if there are too many.
fn push<T>(list: &mut Vec<T>, item: T, place: &Place) -> Result<(), DrawingError> {
    if list.len() == MOST_SHAPES {
        let kind = DrawingErrorKind::TooMany { what: "bodies or lines", limit: MOST_SHAPES };
        return Err(kind.at(place));
    }
    list.push(item);
    Ok(())
}

impl Mesh {
    /// Returns the body with only those corners of the file that its faces have.
    fn own(&self, corners: &[Point3<f64>]) -> Self {
        let mut numbers = std::collections::BTreeMap::new();
        let mut own = Self { faces: Vec::new(), ..self.clone() };
        for face in &self.faces {
            let face = face.iter().map(|k| {
                *numbers.entry(*k).or_insert_with(|| {
                    own.corners.push(corners[*k]);
                    own.corners.len() - 1
                })
            });
            own.faces.push(face.collect());
        }
        own
    }
}
