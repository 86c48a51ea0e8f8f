//! DXF as text: polylines, lines, arcs, circles and solids, of the drawing itself and of inserted blocks.
//!
//! A file is a list of pairs, a code and a value on a line each; code 0 begins an entity. Only few kinds of entities
//! bound blocks, so that a reader for DXF alone is small, gives the line of every entity, and skips unknown ones.

mod insert;
mod layers;
mod pairs;
mod shapes;

use std::collections::BTreeMap;

use self::insert::Expansion;
use self::layers::Hidden;
use self::pairs::{Record, records};
use super::{Drawing, DrawingError, DrawingErrorKind, Place, Unit};

/// The parts of a file that matter.
#[derive(Default)]
struct File<'a> {
    /// The number of the unit.
    unit: Option<i64>,
    /// Blocks by name: their first record, which has the base point, and those inside.
    blocks: BTreeMap<&'a str, Vec<Record<'a>>>,
    /// Layers that are not shown, by their names in small letters.
    hidden: BTreeMap<String, Hidden>,
    entities: Vec<Record<'a>>,
}

pub(super) fn read(text: &str) -> Result<Drawing, DrawingError> {
    let file = File::of(records(text)?)?;
    let mut drawing = Drawing::in_unit(file.unit.and_then(Unit::of_dxf));
    drawing.unknown_unit = file.unit.filter(|_| drawing.unit.is_none());
    let File { blocks, hidden, .. } = &file;
    Expansion { blocks, hidden, drawing: &mut drawing }.all(&file.entities)?;
    Ok(drawing)
}

impl<'a> File<'a> {
    fn of(records: Vec<Record<'a>>) -> Result<Self, DrawingError> {
        let mut file = Self::default();
        let mut section = "";
        let mut block: Option<&str> = None;
        let mut has_ended = false;
        let last = records.last().map_or(0, |record| record.line);
        for record in records {
            match (record.kind, section) {
                ("SECTION", _) => {
                    section = record.text(2).unwrap_or_default();
                    if section == "HEADER" {
                        file.unit = unit(&record);
                    }
                }
                ("ENDSEC", _) => (section, block) = ("", None),
                ("EOF", _) => has_ended = true,
                ("BLOCK", "BLOCKS") => {
                    let name = record.text(2).unwrap_or_default();
                    block = Some(name);
                    file.blocks.insert(name, vec![record]);
                }
                ("ENDBLK", "BLOCKS") => block = None,
                (_, "BLOCKS") => {
                    if let Some(inside) = block.and_then(|name| file.blocks.get_mut(name)) {
                        inside.push(record);
                    }
                }
                ("LAYER", "TABLES") => {
                    let name = record.text(2).unwrap_or_default().to_lowercase();
                    file.hidden.extend(Hidden::of(&record).map(|how| (name, how)));
                }
                (_, "ENTITIES") => file.entities.push(record),
                _ => {}
            }
        }
        if has_ended {
            Ok(file)
        } else {
            Err(DrawingErrorKind::Truncated.at(&Place::new("DXF", Some(last))))
        }
    }
}

/// The number of the unit in the header; zero counts as no unit.
fn unit(header: &Record) -> Option<i64> {
    let at = header.pairs.iter().position(|pair| pair.value == "$INSUNITS")?;
    header.pairs.get(at + 1)?.value.parse().ok().filter(|number| *number != 0)
}
