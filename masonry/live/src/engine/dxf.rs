//! A scene as a drawing: the outlines of its blocks and the lines of its supports.

use std::fmt::Write as _;

use masonry::model::Model;
use masonry::units::LengthUnit;

/// The drawing as DXF in the units of the scene, as `masonry import` reads it: blocks are closed lines on the layer `blocks`,
/// supports lines on the layer `supports`.
pub(super) fn dxf(model: &Model) -> String {
    let length = model.units.length_to_si();
    let place = |at: [f64; 2]| format!("10\n{}\n20\n{}\n", at[0] / length, at[1] / length);
    let unit = match model.units.length {
        LengthUnit::Mm => 4,
        LengthUnit::Cm => 5,
        LengthUnit::M => 6,
        LengthUnit::Km => 7,
    };
    let mut text = format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
    );
    for block in &model.blocks {
        let corners = block.corners.len();
        let _ = write!(text, "0\nLWPOLYLINE\n8\nblocks\n90\n{corners}\n70\n1\n");
        text.extend(block.corners.iter().map(|it| place([it.x, it.y])));
    }
    for support in &model.supports {
        let [from, to] = [support.from, support.to].map(|it| [it.x / length, it.y / length]);
        let _ = write!(
            text,
            "0\nLINE\n8\nsupports\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n",
            from[0], from[1], to[0], to[1]
        );
    }
    text + "0\nENDSEC\n0\nEOF\n"
}
