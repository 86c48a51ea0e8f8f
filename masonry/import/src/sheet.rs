//! A drawing in metres, sorted by the meaning of its layers, with cleaned outlines.

use nalgebra::Point2;

use super::classes::Meaning;
use super::outline::{self, Cleaned};
use super::report::metres;
use super::size::{self, median};
use super::stones::{self, Piece, Stone};
use super::{ImportError, ImportErrorKind, ImportOptions, faces};
use masonry_drawing::{Change, Drawing, DrawnLine, Outline, Place, Unit};

/// The default tolerance, divided by the shortest edge. Theory: joints of mortar are wider, since they have 10 mm
/// beside bricks of 65 mm; errors of corners that are rounded to millimetres are smaller for edges of 30 mm and more.
const OF_SHORTEST: f64 = 0.05;
/// Edges shorter than this part of the median edge count as faults of the drawing. Chosen: half a brick beside a lintel
/// has a tenth of the length of the lintel.
const FAULTY: f64 = 0.05;
/// The largest tolerance, divided by the shortest edge, as in the healing of scenes.
const LARGEST: f64 = 0.25;
/// The largest number of blocks. Chosen: ten times the number that is solved in a minute.
const MOST_BLOCKS: usize = 20_000;
/// The largest number of pieces of supports, and of lines along joints; each is compared with all blocks. Chosen: a
/// surveyed ground line has some hundreds.
const MOST_PIECES: usize = 2000;

/// A drawing in metres, sorted by the meaning of its layers.
pub(crate) struct Sheet {
    pub(crate) unit: Unit,
    /// The distance up to which corners and edges are joined \[m\].
    pub(crate) tolerance: f64,
    pub(crate) thickness: Option<f64>,
    pub(crate) stones: Vec<Stone>,
    pub(crate) supports: Vec<Piece>,
    /// Lines drawn along joints, which give these joints a class.
    pub(crate) marks: Vec<Piece>,
    pub(crate) changes: Vec<Change>,
    /// All outlines and lines before any change \[m\].
    pub(crate) drawn: Vec<Vec<Point2<f64>>>,
}

/// The outline of a block before it is cleaned.
struct Raw {
    outline: Outline,
    material: String,
}

impl Sheet {
    /// Reads the blocks, supports and marked joints of a drawing.
    ///
    /// # Errors
    /// The unit is not plausible, there are too many blocks, or edges of a block cross at every tolerance.
    pub(crate) fn of(
        drawing: &Drawing,
        options: &ImportOptions,
        tolerance: Option<f64>,
    ) -> Result<Self, ImportError> {
        check(options)?;
        let unit = size::unit(drawing, options)?;
        let factor = unit.metres() * options.scale;
        let mut sheet = Self::empty(drawing, unit, factor);
        let mut sorted = Sorted::default();
        sheet.sort(drawing, factor, options, &mut sorted);
        sheet.tolerance = match tolerance.or_else(|| sorted.tolerance()) {
            Some(tolerance) => tolerance,
            None => return Err(sheet.no_blocks()),
        };
        sheet.lay(sorted)?;
        sheet.limit_tolerance(tolerance.is_some())?;
        Ok(sheet)
    }

    fn empty(drawing: &Drawing, unit: Unit, factor: f64) -> Self {
        let in_metres =
            |change: &Change| Change { by: change.by.map(|it| it * factor), ..change.clone() };
        Self {
            unit,
            tolerance: 0.0,
            thickness: drawing.thickness.map(|it| it * factor),
            stones: Vec::new(),
            supports: Vec::new(),
            marks: Vec::new(),
            changes: drawing.changes.iter().map(in_metres).collect(),
            drawn: Vec::new(),
        }
    }

    fn sort(
        &mut self,
        drawing: &Drawing,
        factor: f64,
        options: &ImportOptions,
        sorted: &mut Sorted,
    ) {
        let scaled =
            |points: &[Point2<f64>]| points.iter().map(|it| it * factor).collect::<Vec<_>>();
        for outline in &drawing.outlines {
            let outline = Outline { corners: scaled(&outline.corners), ..outline.clone() };
            let mut closed = outline.corners.clone();
            closed.extend(outline.corners.first());
            let meaning = Meaning::of(&outline.layer, &options.ignore);
            match meaning {
                Meaning::Blocks(_) if outline.is_fixed => {
                    let name = outline.name.clone().unwrap_or_else(|| "support".to_owned());
                    sorted.fixed.push((name, outline));
                }
                Meaning::Blocks(material) => sorted.raw.push(Raw { outline, material }),
                Meaning::Supports(name) => sorted.fixed.push((name, outline)),
                Meaning::Joints(name) => {
                    self.marks.extend(pieces(&name, &closed, &outline.place));
                }
                Meaning::Ignored => {
                    self.changes.push(Change::new("ignored", &outline.place));
                    continue;
                }
            }
            self.drawn.push(closed);
        }
        for line in &drawing.lines {
            let line = DrawnLine { points: scaled(&line.points), ..line.clone() };
            self.drawn.push(line.points.clone());
            match Meaning::of(&line.layer, &options.ignore) {
                Meaning::Blocks(material) => {
                    sorted.lines.push(DrawnLine { layer: material, ..line });
                }
                Meaning::Supports(name) => {
                    self.supports.extend(pieces(&name, &line.points, &line.place));
                }
                Meaning::Joints(name) => {
                    self.marks.extend(pieces(&name, &line.points, &line.place));
                }
                Meaning::Ignored => self.changes.push(Change::new("ignored", &line.place)),
            }
        }
    }

    /// Adds the stones and supports made from the sorted outlines and lines.
    fn lay(&mut self, mut sorted: Sorted) -> Result<(), ImportError> {
        let found = faces::of(&sorted.lines, self.tolerance, &mut self.changes)?;
        sorted.raw.extend(found.into_iter().map(|outline| {
            let material = outline.layer.clone();
            Raw { outline, material }
        }));
        if sorted.raw.len() > MOST_BLOCKS {
            let place = &sorted.raw[MOST_BLOCKS].outline.place;
            return Err(
                ImportErrorKind::TooMany { what: "blocks", limit: MOST_BLOCKS }.at(&[place])
            );
        }
        for Raw { outline, material } in sorted.raw {
            let Outline { corners, name, place, .. } = outline;
            if let Some(corners) = self.cleaned(&corners, &place)? {
                self.stones.push(Stone { name, material, corners, place });
            }
        }
        for (name, outline) in sorted.fixed {
            if let Some(mut corners) = self.cleaned(&outline.corners, &outline.place)? {
                corners.push(corners[0]);
                self.supports.extend(pieces(&name, &corners, &outline.place));
            }
        }
        for pieces in [&self.supports, &self.marks] {
            if let Some(piece) = pieces.get(MOST_PIECES) {
                let what = "sides of supports, or lines of joints";
                let kind = ImportErrorKind::TooMany { what, limit: MOST_PIECES };
                return Err(kind.at(&[&piece.place]));
            }
        }
        if self.stones.is_empty() {
            return Err(self.no_blocks());
        }
        stones::without_duplicates(&mut self.stones, self.tolerance, &mut self.changes)?;
        stones::check_simple(&self.stones, &mut self.changes)
    }

    fn no_blocks(&self) -> ImportError {
        let last = self.changes.last();
        let dropped = last.map_or(String::new(), |it| format!(" ({}: {})", it.place, it.what));
        ImportErrorKind::NoBlocks { dropped }.at(&[])
    }

    /// Returns the corners of an outline that remain after cleaning; `None` for a sliver.
    fn cleaned(
        &mut self,
        corners: &[Point2<f64>],
        place: &Place,
    ) -> Result<Option<Vec<Point2<f64>>>, ImportError> {
        match outline::clean(corners, place, self.tolerance, &mut self.changes) {
            Cleaned::Polygon(corners) => Ok(Some(corners)),
            Cleaned::Sliver => {
                self.changes.push(Change::new("slivers were dropped", place));
                Ok(None)
            }
            Cleaned::Crossing => Err(ImportErrorKind::Crossing.at(&[place])),
        }
    }

    /// Limits the tolerance so that it does not join the ends of an edge: reduces the default tolerance, and refuses a
    /// given tolerance that is too large.
    fn limit_tolerance(&mut self, is_given: bool) -> Result<(), ImportError> {
        let shortest = |stone: &Stone| size::edges(&stone.corners).fold(f64::INFINITY, f64::min);
        let lengths = self.stones.iter().map(|stone| (shortest(stone), stone));
        let Some((edge, stone)) = lengths.min_by(|a, b| a.0.total_cmp(&b.0)) else { return Ok(()) };
        let most = LARGEST * edge;
        if self.tolerance > most && is_given {
            let [edge, tolerance, most] = [edge, self.tolerance, most].map(metres);
            return Err(ImportErrorKind::ShortEdge { edge, tolerance, most }.at(&[&stone.place]));
        }
        self.tolerance = self.tolerance.min(most);
        Ok(())
    }
}

/// Outlines and lines of blocks and supports before they are cleaned.
#[derive(Default)]
struct Sorted {
    raw: Vec<Raw>,
    lines: Vec<DrawnLine>,
    fixed: Vec<(String, Outline)>,
}

impl Sorted {
    /// Returns the default tolerance: a part of the shortest edge that is not a fault; `None` if there is no edge.
    fn tolerance(&self) -> Option<f64> {
        let of_outlines = self.raw.iter().flat_map(|raw| size::edges(&raw.outline.corners));
        let of_lines = self.lines.iter().flat_map(|line| line.points.windows(2));
        let of_lines = of_lines.map(|pair| (pair[1] - pair[0]).norm());
        let edges: Vec<f64> = of_outlines.chain(of_lines).filter(|it| *it > 0.0).collect();
        let usual = median(edges.clone())?;
        let shortest = edges.into_iter().filter(|it| *it >= FAULTY * usual);
        Some(OF_SHORTEST * shortest.fold(f64::INFINITY, f64::min))
    }
}

fn pieces(name: &str, points: &[Point2<f64>], place: &Place) -> Vec<Piece> {
    let pairs = points.windows(2).filter(|pair| pair[0] != pair[1]);
    let piece = |pair: &[Point2<f64>]| Piece {
        name: name.to_owned(),
        ends: [pair[0], pair[1]],
        place: place.clone(),
        is_of_scene: false,
    };
    pairs.map(piece).collect()
}

fn check(options: &ImportOptions) -> Result<(), ImportError> {
    let values = [
        ("--scale", Some(options.scale)),
        ("--tolerance", options.tolerance),
        ("--thickness", options.thickness),
        ("--density", Some(options.density)),
    ];
    for (option, value) in values {
        if let Some(value) = value.filter(|it| !(it.is_finite() && *it > 0.0)) {
            return Err(ImportErrorKind::Option { option, value }.at(&[]));
        }
    }
    let (option, value) = ("--mu", options.mu);
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(ImportErrorKind::Option { option, value }.at(&[]))
    }
}
