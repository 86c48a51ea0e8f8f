//! A picture of the drawing under the blocks made from it, as SVG.

use std::fmt::Write as _;

use nalgebra::Point2;

use super::Imported;

/// The longer side of the picture, and the margin around the drawing, in pixels.
const SIDE: f64 = 1200.0;
const MARGIN: f64 = 30.0;

/// The map from metres to pixels.
struct Frame {
    left: f64,
    top: f64,
    scale: f64,
}

impl Imported {
    /// Returns a picture as SVG: the drawing in red, under the blocks and supports of the scene.
    pub fn picture(&self) -> String {
        let blocks: Vec<Vec<Point2<f64>>> = self
            .scene
            .blocks
            .iter()
            .map(|block| block.corners.iter().copied().map(Point2::from).collect())
            .collect();
        let supports = self.scene.supports.iter().map(|it| vec![it.from.into(), it.to.into()]);
        let supports: Vec<Vec<Point2<f64>>> = supports.collect();
        let points = blocks.iter().chain(&supports).chain(&self.drawn).flatten();
        let (low, high) = points.fold(
            (
                Point2::new(f64::INFINITY, f64::INFINITY),
                Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
            ),
            |(low, high), point| (low.inf(point), high.sup(point)),
        );
        let size = high - low;
        let scale = SIDE / size.x.max(size.y);
        let frame = Frame { left: low.x, top: high.y, scale };
        let [width, height] = [size.x, size.y].map(|it| it * scale + 2.0 * MARGIN);
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.1} {height:.1}\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        );
        let styles = [
            ("drawing", &self.drawn, "fill=\"none\" stroke=\"#d62728\" stroke-width=\"3\"", ""),
            (
                "blocks",
                &blocks,
                "fill=\"#c9b79c\" fill-opacity=\"0.55\" stroke=\"#222222\" stroke-width=\"1\"",
                "Z",
            ),
            ("supports", &supports, "fill=\"none\" stroke=\"#1f77b4\" stroke-width=\"4\"", ""),
        ];
        for (class, lines, style, end) in styles {
            let _ = writeln!(text, "<g class=\"{class}\" {style}>");
            for line in lines {
                let _ = writeln!(text, "<path d=\"{}{end}\"/>", frame.path(line));
            }
            text.push_str("</g>\n");
        }
        text + "</svg>\n"
    }
}

impl Frame {
    fn path(&self, points: &[Point2<f64>]) -> String {
        let at = |point: &Point2<f64>| {
            let x = (point.x - self.left) * self.scale + MARGIN;
            let y = (self.top - point.y) * self.scale + MARGIN;
            format!("{x:.2} {y:.2}")
        };
        "M".to_owned() + &points.iter().map(at).collect::<Vec<_>>().join("L")
    }
}
