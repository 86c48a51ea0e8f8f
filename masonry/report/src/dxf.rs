//! A structure and its results as a drawing: DXF of release 12, which CAD programs read, with a layer for each kind.
//!
//! `masonry import` reads blocks, supports and joints back, and leaves out the layers of results.

use std::fmt::Write as _;

use nalgebra::{Point2, Vector2};

use crate::format::{InUnits, significant};
use crate::joints;
use masonry::analysis::outcome::Outcome;
use masonry::model::Model;
use masonry::rounding::largest;
use masonry::units::LengthUnit;
use masonry::verify::moving::speed;

/// Name of the layer with the outlines of blocks.
const BLOCKS: &str = "blocks";
/// Name of the layer with the resultants in joints.
const FORCES: &str = "result_forces";
/// Name of the layer with the lines of thrust.
const PATHS: &str = "result_thrust";
/// Name of the layer with the outlines that a mechanism has moved.
const MECHANISM: &str = "result_mechanism";
/// Colours of layers as numbers in the palette of DXF: white or black (7), red (1), green (3), blue (5).
const COLOURS: [(&str, u8); 4] = [(BLOCKS, 7), (FORCES, 1), (PATHS, 3), (MECHANISM, 5)];
/// The colour of all layers without an entry in [`COLOURS`]: grey.
const GREY: u8 = 8;
/// Length of the longest stroke of a force and of the largest movement in a mechanism, divided by the longer side of
/// the structure. Chosen: large enough to be seen, and small enough to hide little.
const LONGEST: f64 = 0.1;
/// The height of letters, divided by the longer side of the structure. Chosen: a fifth of the longest stroke.
const LETTERS: f64 = 0.02;
/// The largest number of characters in the name of a layer in release 12.
const LONGEST_NAME: usize = 31;

/// Returns the drawing of an outcome as DXF text, in the units of the scene.
///
/// | layer | lines |
/// |---|---|
/// | `blocks` | closed outlines |
/// | `support_NAME` | supports |
/// | `joint_CLASS` | joints |
/// | `result_forces` | the resultant of every joint along its line of action, centred at its point of application; a text gives the scale |
/// | `result_thrust` | lines from the point of application of every joint force of a block to the weighted mean of these points: the line of thrust of an arch |
/// | `result_mechanism` | outlines moved by a mechanism |
pub fn drawing(outcome: &Outcome) -> String {
    let model = &outcome.model;
    let mut drawing = Drawing::of(model);
    for block in &model.blocks {
        drawing.outline(BLOCKS, block.corners.iter().copied());
    }
    for support in &model.supports {
        drawing.line(&layer("support", &support.name), [support.from, support.to]);
    }
    for joint in &model.joints {
        let class = &model.joint_classes[joint.class].name;
        drawing.line(&layer("joint", class), [joint.from, joint.to]);
    }
    if let Some(state) = &outcome.state {
        drawing.forces(&joints::forces(model, &state.contacts));
    }
    if let Some(rates) = &outcome.mechanism {
        drawing.mechanism(rates);
    }
    drawing.finish()
}

/// Returns the name of the layer for a part of the scene, with `_` for characters that names of layers cannot have.
fn layer(kind: &str, name: &str) -> String {
    let kept = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    format!("{kind}_{name}").chars().map(kept).take(LONGEST_NAME).collect()
}

/// A DXF drawing that is being written.
struct Drawing<'a> {
    model: &'a Model,
    /// The lower left corner of the structure, and the longer side of the structure \[m\].
    corner: Point2<f64>,
    side: f64,
    entities: String,
    layers: Vec<String>,
}

impl<'a> Drawing<'a> {
    fn of(model: &'a Model) -> Self {
        let corners = || model.blocks.iter().flat_map(|block| &block.corners);
        let ends = |k: usize| {
            let of = || corners().map(move |corner| corner[k]);
            [of().fold(f64::INFINITY, f64::min), of().fold(f64::NEG_INFINITY, f64::max)]
        };
        let [x, y] = [0, 1].map(ends);
        let side = (x[1] - x[0]).max(y[1] - y[0]);
        let corner = Point2::new(x[0], y[0]);
        Self { model, corner, side, entities: String::new(), layers: Vec::new() }
    }

    fn forces(&mut self, all: &[joints::JointForce]) {
        let most = largest(all.iter().map(|it| it.force.norm()));
        // A force of length zero has no direction.
        if most <= 0.0 {
            return;
        }
        let per_newton = LONGEST * self.side / most;
        for it in all {
            let half = it.force * (0.5 * per_newton);
            self.line(FORCES, [it.at - half, it.at + half]);
        }
        for path in joints::paths(self.model, all) {
            self.line(PATHS, path.ends);
        }
        let units = InUnits(self.model.units);
        let length = LONGEST * self.side / self.model.units.length_to_si();
        let (length, unit) = (significant(length, 3), self.model.units.length_name());
        let most = units.force_text(most);
        self.text(FORCES, &format!("lines of forces: {length} {unit} are {most}"));
    }

    fn mechanism(&mut self, rates: &[Vec<Vector2<f64>>]) {
        let fastest = largest(rates.iter().map(|rate| speed(rate)));
        if fastest <= 0.0 {
            return;
        }
        let factor = LONGEST * self.side / fastest;
        for (block, rates) in self.model.blocks.iter().zip(rates) {
            let moved = block.corners.iter().zip(rates);
            self.outline(MECHANISM, moved.map(|(corner, rate)| corner + rate * factor));
        }
    }

    fn outline(&mut self, layer: &str, corners: impl Iterator<Item = Point2<f64>>) {
        self.entity("POLYLINE", layer, "66\n1\n70\n1\n");
        for corner in corners {
            let place = self.place(10, corner);
            self.entity("VERTEX", layer, &place);
        }
        self.entity("SEQEND", layer, "");
    }

    fn line(&mut self, layer: &str, [from, to]: [Point2<f64>; 2]) {
        let places = self.place(10, from) + &self.place(11, to);
        self.entity("LINE", layer, &places);
    }

    /// Adds a line of text below the structure.
    fn text(&mut self, layer: &str, text: &str) {
        let height = LETTERS * self.side;
        let at = self.place(10, self.corner - Vector2::new(0.0, 4.0 * height));
        let height = height / self.model.units.length_to_si();
        self.entity("TEXT", layer, &format!("{at}40\n{height}\n1\n{text}\n"));
    }

    fn entity(&mut self, kind: &str, layer: &str, pairs: &str) {
        if !self.layers.iter().any(|it| it == layer) {
            self.layers.push(layer.to_owned());
        }
        let _ = write!(self.entities, "0\n{kind}\n8\n{layer}\n{pairs}");
    }

    /// Returns the DXF pairs of a point, in the units of the scene.
    fn place(&self, code: u8, at: Point2<f64>) -> String {
        let [x, y] = [at.x, at.y].map(|it| it / self.model.units.length_to_si());
        format!("{code}\n{x}\n{}\n{y}\n", code + 10)
    }

    fn finish(self) -> String {
        let unit = match self.model.units.length {
            LengthUnit::Mm => 4,
            LengthUnit::Cm => 5,
            LengthUnit::M => 6,
            LengthUnit::Km => 7,
        };
        let mut text = format!(
            "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n\
             0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n{}\n",
            self.layers.len()
        );
        for name in &self.layers {
            let colour = COLOURS.iter().find(|(layer, _)| layer == name).map_or(GREY, |it| it.1);
            let _ = write!(text, "0\nLAYER\n2\n{name}\n70\n0\n62\n{colour}\n6\nCONTINUOUS\n");
        }
        text + "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
            + &self.entities
            + "0\nENDSEC\n0\nEOF\n"
    }
}
