//! Drawings made for tests: walls, and files of them.

use std::fmt::Write as _;

use masonry_drawing::{Drawing, DrawingFormat};
use masonry_import::{ImportOptions, Imported, import};

pub type Polygon = Vec<[f64; 2]>;

/// The length and the height of a brick \[m\].
pub const BRICK: [f64; 2] = [0.25, 0.125];

/// A wall in running bond, with joints open by a gap inside, its faces in place.
pub fn wall(bricks: usize, courses: usize, gap: f64) -> Vec<Polygon> {
    let [length, height] = BRICK;
    let width = bricks as f64 * length;
    let mut polygons = Vec::new();
    for course in 0..courses {
        let shift = if course % 2 == 0 { 0.0 } else { 0.5 * length };
        let inner = |k: usize| (k as f64 * length + shift).min(width);
        let mut ends = vec![0.0];
        ends.extend((0..=bricks).map(inner).filter(|x| *x > 0.0));
        ends.dedup();
        let is_face = |at: f64, last: f64| at < 1e-9 || at > last - 1e-9;
        let open = |at: f64, last: f64, to: f64| if is_face(at, last) { at } else { at + to };
        let y = |k: usize, to: f64| open(k as f64 * height, courses as f64 * height, to);
        for pair in ends.windows(2) {
            let (left, right) = (open(pair[0], width, 0.5 * gap), open(pair[1], width, -0.5 * gap));
            let (low, high) = (y(course, 0.5 * gap), y(course + 1, -0.5 * gap));
            polygons.push(vec![[left, low], [right, low], [right, high], [left, high]]);
        }
    }
    polygons
}

/// Each point by a function.
pub fn mapped(polygons: &[Polygon], map: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<Polygon> {
    polygons.iter().map(|polygon| polygon.iter().map(|it| map(*it)).collect()).collect()
}

pub fn turned(degrees: f64) -> impl Fn([f64; 2]) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    move |[x, y]| [cos * x - sin * y, sin * x + cos * y]
}

pub fn rounded(step: f64) -> impl Fn([f64; 2]) -> [f64; 2] {
    move |point| point.map(|it| (it / step).round() * step)
}

/// A DXF file, entity by entity.
#[derive(Default)]
pub struct Dxf {
    unit: u32,
    blocks: String,
    entities: String,
    count: usize,
}

impl Dxf {
    /// A file with a number of `$INSUNITS`.
    pub fn new(unit: u32) -> Self {
        Self { unit, ..Self::default() }
    }

    pub fn polygons(mut self, layer: &str, polygons: &[Polygon]) -> Self {
        for polygon in polygons {
            let bulged: Vec<_> = polygon.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
            self = self.polyline(layer, &bulged, true);
        }
        self
    }

    /// A polyline of points and bulges.
    pub fn polyline(self, layer: &str, points: &[[f64; 3]], is_closed: bool) -> Self {
        let mut pairs = format!("90\n{}\n70\n{}\n", points.len(), u8::from(is_closed));
        for [x, y, bulge] in points {
            let _ = write!(pairs, "10\n{x}\n20\n{y}\n");
            if *bulge != 0.0 {
                let _ = write!(pairs, "42\n{bulge}\n");
            }
        }
        self.entity("LWPOLYLINE", layer, &pairs)
    }

    pub fn line(self, layer: &str, from: [f64; 2], to: [f64; 2]) -> Self {
        let [[x, y], [u, v]] = [from, to];
        self.entity("LINE", layer, &format!("10\n{x}\n20\n{y}\n11\n{u}\n21\n{v}\n"))
    }

    pub fn entity(mut self, kind: &str, layer: &str, pairs: &str) -> Self {
        self.count += 1;
        let _ = write!(self.entities, "0\n{kind}\n5\n{:X}\n8\n{layer}\n{pairs}", self.count);
        self
    }

    /// What was drawn so far becomes a block.
    pub fn into_block(mut self, name: &str, base: [f64; 2]) -> Self {
        let [x, y] = base;
        let inside = std::mem::take(&mut self.entities);
        let _ =
            write!(self.blocks, "0\nBLOCK\n8\n0\n2\n{name}\n10\n{x}\n20\n{y}\n{inside}0\nENDBLK\n");
        self
    }

    /// Inserts a block at a place, turned and scaled; `more` are further pairs.
    pub fn insert(self, name: &str, at: [f64; 2], more: &str) -> Self {
        let [x, y] = at;
        self.entity("INSERT", "0", &format!("2\n{name}\n10\n{x}\n20\n{y}\n{more}"))
    }

    pub fn text(&self) -> String {
        let Self { unit, blocks, entities, .. } = self;
        format!(
            "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n\
             0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
        )
    }

    pub fn read(&self) -> Drawing {
        Drawing::read(self.text().as_bytes(), DrawingFormat::Dxf).unwrap()
    }

    #[track_caller]
    pub fn import(&self) -> Imported {
        self.import_with(&ImportOptions::default())
    }

    #[track_caller]
    pub fn import_with(&self, options: &ImportOptions) -> Imported {
        import(&self.read(), options).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// How the changes of a kind count.
pub fn changes(imported: &Imported, what: &str) -> usize {
    imported.changes.iter().filter(|change| change.what.contains(what)).count()
}
