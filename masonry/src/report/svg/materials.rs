//! The blocks of a scene in a colour for every material, and what these are.

use super::marks::{self, BRICK};
use super::sheet::Sheet;
use crate::model::{Block, Elasticity, Model};
use crate::report::format::{InUnits, significant, stress_text};

/// Fills of materials, so light that marks stay readable; the first is that of every other picture.
const FILLS: [&str; 5] = [BRICK, "#dfe6ea", "#e6ead7", "#ecdfe6", "#e3dcc9"];

/// The constants of a material.
#[derive(Clone, Copy, PartialEq)]
struct Constants {
    elasticity: Option<Elasticity>,
    density: Option<f64>,
}

/// Draws all blocks, and a legend entry for every material; the thickness of the structure is that of all.
pub(super) fn draw(sheet: &mut Sheet, model: &Model) {
    let mut materials: Vec<(Constants, Vec<&Block>)> = Vec::new();
    for block in &model.blocks {
        let constants = Constants { elasticity: block.elasticity, density: block.density };
        match materials.iter_mut().find(|(known, _)| *known == constants) {
            Some((_, blocks)) => blocks.push(block),
            None => materials.push((constants, vec![block])),
        }
    }
    for (index, (constants, blocks)) in materials.iter().enumerate() {
        let fill = FILLS[index % FILLS.len()];
        marks::bricks(sheet, blocks.iter().copied(), fill);
        let count = marks::counted(blocks.len(), "block");
        sheet.block_entry(&format!("{count}, {}", described(*constants)), fill);
    }
    let thickness = InUnits(model.units).length_text(model.thickness);
    sheet.note(&format!("thickness out of the plane {thickness}"));
}

fn described(constants: Constants) -> String {
    let Constants { elasticity, density } = constants;
    let mut text = match elasticity {
        Some(Elasticity { young, poisson }) => {
            format!(
                "E\u{a0}=\u{a0}{}, ν\u{a0}=\u{a0}{}",
                stress_text(young),
                significant(poisson, 3)
            )
        }
        None => "rigid".to_owned(),
    };
    if let Some(density) = density {
        text = format!("{text}, {}\u{a0}kg/m³", significant(density, 4));
    }
    text
}
