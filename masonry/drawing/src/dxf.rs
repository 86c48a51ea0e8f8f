//! DXF as text: polylines, lines, arcs, circles and solids, both in the drawing itself and in inserted blocks.
//!
//! A file is a list of pairs of a code and a value, each on its own line; code 0 begins an entity. Only few kinds of
//! entities bound blocks, so that this reader is small, gives the line of every entity, and skips unknown entities.

mod insert;
mod layers;
mod pairs;
mod shapes;

use std::collections::BTreeMap;

use self::insert::Expansion;
use self::layers::Hidden;
use self::pairs::{Record, records};
use super::{Drawing, DrawingError, DrawingErrorKind, Place, Unit};

/// The parts of a DXF file that a drawing needs.
#[derive(Default)]
struct File<'a> {
    /// The number of the unit in `$INSUNITS`; `None` if the file gives no unit.
    unit: Option<i64>,
    /// Blocks of the file by name: the first record of a block has its base point; the other records are its entities.
    blocks: BTreeMap<&'a str, Vec<Record<'a>>>,
    /// Layers that are not shown, by their names in lower case.
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

/// Returns the number of the unit in the header; `None` if there is none or the number is zero.
fn unit(header: &Record) -> Option<i64> {
    let at = header.pairs.iter().position(|pair| pair.value == "$INSUNITS")?;
    header.pairs.get(at + 1)?.value.parse().ok().filter(|number| *number != 0)
}
