//! The blocks of a scene in a colour for every material, and what these are.

use super::canvas::{Pixel, fixed};
use super::marks::{self, BRICK, OUTLINE};
use super::sheet::Sheet;
use crate::model::{Block, Elasticity, Model};
use crate::report::format::{InUnits, significant, stress_text};

/// Fills of materials, so light that marks stay readable; the first is that of every other picture.
const FILLS: [&str; 5] = [BRICK, "#dfe6ea", "#e6ead7", "#ecdfe6", "#e3dcc9"];

/// The constants of a material: those of elastic blocks, and the density.
type Constants = (Option<Elasticity>, Option<f64>);

/// Draws all blocks, and a legend entry for every material; the thickness of the structure is that of all.
pub(super) fn draw(sheet: &mut Sheet, model: &Model, brick: f64) {
    let mut materials: Vec<(Constants, Vec<&Block>)> = Vec::new();
    for block in &model.blocks {
        let constants = (block.elasticity, block.density);
        match materials.iter_mut().find(|(known, _)| *known == constants) {
            Some((_, blocks)) => blocks.push(block),
            None => materials.push((constants, vec![block])),
        }
    }
    let (frame, width) = (sheet.frame, fixed(marks::outline_width(brick)));
    for (index, (constants, blocks)) in materials.iter().enumerate() {
        let fill = FILLS[index % FILLS.len()];
        let style = format!(
            "class=\"bricks\" fill=\"{fill}\" stroke=\"{OUTLINE}\" stroke-width=\"{width}\" \
             stroke-linejoin=\"round\""
        );
        sheet.canvas.group(&style, |canvas| {
            for block in blocks {
                let corners: Vec<_> = block.corners.iter().map(|it| frame.at(*it)).collect();
                canvas.polygon(&corners, "");
            }
        });
        let count = marks::counted(blocks.len(), "block");
        sheet.entry(&format!("{count}, {}", described(*constants)), |symbol| {
            let style = format!("fill=\"{fill}\" stroke=\"{OUTLINE}\" stroke-width=\"1\"");
            symbol.rectangle(Pixel::new(-16.0, -6.0), 32.0, 12.0, &style);
        });
    }
    let thickness = InUnits(model.units).length_text(model.thickness);
    sheet.entry(&format!("thickness out of the plane {thickness}"), |_| {});
}

fn described((elasticity, density): Constants) -> String {
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
