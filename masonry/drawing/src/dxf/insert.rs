//! Entities at their places: those of the drawing itself, and those of blocks that are inserted, moved, turned and
//! scaled.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Point2, Vector2};

use super::layers::Hidden;
use super::pairs::Record;
use super::shapes::{self, Shape};
use crate::error::shown;
use crate::shapes::MOST_SHAPES;
use crate::{Change, Drawing, DrawingError, DrawingErrorKind, DrawnLine, Outline, Place};

/// The deepest nesting of blocks. Chosen: drawings have three or four levels; a block that contains itself has no end.
const DEEPEST: usize = 16;

/// A drawing to which entities are added, with the blocks that can be inserted and the layers that are hidden.
pub(super) struct Expansion<'a> {
    pub(super) blocks: &'a BTreeMap<&'a str, Vec<Record<'a>>>,
    pub(super) hidden: &'a BTreeMap<String, Hidden>,
    pub(super) drawing: &'a mut Drawing,
}

/// The map from coordinates of entities to the drawing, and the insertions around the entities.
#[derive(Clone)]
struct Frame<'a> {
    map: Matrix3<f64>,
    /// The layer that entities on layer 0 of a block get.
    layer: &'a str,
    depth: usize,
    /// Text that follows the place of an entity in messages: the blocks around it.
    inside: String,
}

impl<'a> Expansion<'a> {
    pub(super) fn all(&mut self, records: &'a [Record<'a>]) -> Result<(), DrawingError> {
        let frame = Frame { map: Matrix3::identity(), layer: "0", depth: 0, inside: String::new() };
        let mut entities = 0;
        self.add(records, &frame, &mut entities)
    }

    fn add(
        &mut self,
        records: &'a [Record<'a>],
        frame: &Frame<'a>,
        entities: &mut usize,
    ) -> Result<(), DrawingError> {
        let mut k = 0;
        while let Some(record) = records.get(k) {
            *entities += 1;
            if *entities > MOST_SHAPES {
                let kind = DrawingErrorKind::TooMany { what: "entities", limit: MOST_SHAPES };
                return Err(kind.at(&frame.place(record)));
            }
            let is_vertex = |it: &&Record| it.kind == "VERTEX";
            let vertices = records[k + 1..].iter().take_while(is_vertex).count();
            let vertices = &records[k + 1..k + 1 + vertices];
            k += 1 + vertices.len();
            // Entities of the paper space belong to a printed sheet, not to the model.
            if record.flags(67) != 1 {
                self.add_one(record, vertices, frame, entities)?;
            }
        }
        Ok(())
    }

    fn add_one(
        &mut self,
        record: &'a Record<'a>,
        vertices: &[Record<'a>],
        frame: &Frame<'a>,
        entities: &mut usize,
    ) -> Result<(), DrawingError> {
        /// The flags of polylines that are meshes.
        const MESH: i64 = 16 | 64;
        let layer = frame.layer_of(record);
        let hidden = self.hidden.get(&layer.to_lowercase());
        let shape = match record.kind {
            // Ends of lists and attributes of blocks are not shapes.
            "SEQEND" | "ATTRIB" | "ATTDEF" | "VIEWPORT" => return Ok(()),
            _ if record.flags(60) == 1 => {
                let what = "invisible entities were left out";
                self.drawing.changes.push(Change::new(what, &frame.place(record)));
                return Ok(());
            }
            // The contents of a block that is inserted on a layer that is off have layers of their own.
            kind if hidden.is_some_and(|it| kind != "INSERT" || *it == Hidden::Frozen) => {
                let how = hidden.map_or("off", |it| it.name());
                let layer = shown(layer);
                let what = format!("entities of layer \"{layer}\", which is {how}, were left out");
                self.drawing.changes.push(Change::new(what, &frame.place(record)));
                return Ok(());
            }
            "LINE" => shapes::line(record)?,
            "ARC" => shapes::arc(record)?,
            "CIRCLE" => shapes::circle(record)?,
            "SOLID" | "TRACE" => shapes::solid(record)?,
            "LWPOLYLINE" => shapes::light_polyline(record)?,
            "POLYLINE" if record.flags(70) & MESH == 0 => shapes::polyline(record, vertices)?,
            "INSERT" => return self.insert(record, frame, entities),
            kind => {
                let kind = shown(kind);
                let what =
                    format!("{kind} was left out: only polylines, lines and arcs bound blocks");
                self.drawing.changes.push(Change::new(what, &frame.place(record)));
                return Ok(());
            }
        };
        self.add_shape(&shape, record, frame)
    }

    fn add_shape(
        &mut self,
        shape: &Shape,
        record: &Record<'a>,
        frame: &Frame<'a>,
    ) -> Result<(), DrawingError> {
        let place = frame.place(record);
        if shape.off > 0.0 {
            let by = shape.off * frame.map.determinant().abs().sqrt();
            self.drawing.changes.push(Change::by("arcs became chords", &place, by));
        }
        let map = if record.is_mirrored()? { frame.map * mirror() } else { frame.map };
        let points = shape.points.iter().map(|it| map.transform_point(it)).collect();
        let layer = frame.layer_of(record).to_owned();
        if shape.is_closed {
            let (name, is_fixed) = (None, false);
            self.drawing.add_outline(Outline { corners: points, layer, name, is_fixed, place })
        } else {
            self.drawing.add_line(DrawnLine { points, layer, place })
        }
    }

    fn insert(
        &mut self,
        record: &'a Record<'a>,
        frame: &Frame<'a>,
        entities: &mut usize,
    ) -> Result<(), DrawingError> {
        let place = frame.place(record);
        if frame.depth == DEEPEST {
            return Err(DrawingErrorKind::Nested { depth: DEEPEST }.at(&place));
        }
        let name = record.text(2).unwrap_or_default();
        let Some((first, inside)) = self.blocks.get(name).and_then(|it| it.split_first()) else {
            return Err(DrawingErrorKind::UnknownBlock { name: shown(name) }.at(&place));
        };
        let to_base = Matrix3::new_translation(&-first.point(10)?.coords);
        let layer = frame.layer_of(record);
        let depth = frame.depth + 1;
        let inserted = Place::new(format!("{}{}", record.place(), frame.inside), None);
        let of = format!(" in block {} of {inserted}", shown(name));
        for cell in cells(record, &place)? {
            let map = frame.map * placement(record, cell)? * to_base;
            self.add(inside, &Frame { map, layer, depth, inside: of.clone() }, entities)?;
            *entities += 1;
        }
        Ok(())
    }
}

impl<'a> Frame<'a> {
    fn layer_of(&self, record: &Record<'a>) -> &'a str {
        if record.layer() == "0" { self.layer } else { record.layer() }
    }

    fn place(&self, record: &Record) -> Place {
        let place = record.place();
        Place { entity: place.entity + &self.inside, ..place }
    }
}

/// Returns the map of an insertion of a block whose base point is the origin; `cell` is the offset of the copy in a
/// grid of copies.
fn placement(record: &Record, cell: Vector2<f64>) -> Result<Matrix3<f64>, DrawingError> {
    let scale = Vector2::new(record.number(41, 1.0)?, record.number(42, 1.0)?);
    let Point2 { coords: at, .. } = record.point(10)?;
    let turned = Matrix3::new_rotation(record.number(50, 0.0)?.to_radians());
    let map = Matrix3::new_translation(&at)
        * turned
        * Matrix3::new_translation(&cell)
        * Matrix3::new_nonuniform_scaling(&scale);
    Ok(if record.is_mirrored()? { mirror() * map } else { map })
}

/// Returns the offsets of copies in rows and columns.
fn cells(record: &Record, place: &Place) -> Result<Vec<Vector2<f64>>, DrawingError> {
    let most = i64::try_from(MOST_SHAPES).unwrap_or(i64::MAX);
    let [columns, rows] = [70, 71].map(|code| record.flags(code).clamp(1, most));
    if columns.saturating_mul(rows) > most {
        let kind = DrawingErrorKind::TooMany { what: "copies of a block", limit: MOST_SHAPES };
        return Err(kind.at(place));
    }
    let (dx, dy) = (record.number(44, 0.0)?, record.number(45, 0.0)?);
    let cell = |row: i64, column: i64| Vector2::new(dx * column as f64, dy * row as f64);
    Ok((0..rows).flat_map(|row| (0..columns).map(move |column| cell(row, column))).collect())
}

/// Returns a mirror image, in which x changes its sign: for entities that are seen from behind.
fn mirror() -> Matrix3<f64> {
    Matrix3::new_nonuniform_scaling(&Vector2::new(-1.0, 1.0))
}
