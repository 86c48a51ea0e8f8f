//! A sheet: title on top, drawing, and a legend beside or below it that never overlaps it.

use nalgebra::{Point2, Vector2};

use super::canvas::{Anchor, Canvas, Pixel, escape, fixed, text_width, wrapped};
use super::style::{self, DARK, EDGE, OUTLINE, TEXT, TEXT_LINE, TITLE_LINE, WIDTH};
use crate::data::state::State;
use crate::geometry;
use crate::model::Model;
use crate::report::format::{InUnits, round_down};

const ENTRY_GAP: f64 = 9.0;
const SYMBOL_WIDTH: f64 = 64.0;
const ENTRY_WIDTH: f64 = 280.0;
const TALLEST: f64 = 760.0;
/// Half the length of a line in the legend, and the corner of a block there.
pub(super) const SYMBOL: f64 = 22.0;
pub(super) const BLOCK: Pixel = Pixel { x: -16.0, y: -6.0 };

/// An axis-parallel box \[m\].
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    pub(super) low: Point2<f64>,
    pub(super) high: Point2<f64>,
}

impl Bounds {
    /// The smallest box around all finite points; the origin when there is none.
    pub(super) fn of(points: impl IntoIterator<Item = Point2<f64>>) -> Self {
        let mut points = points.into_iter().filter(|p| p.x.is_finite() && p.y.is_finite());
        let first = points.next().unwrap_or_else(Point2::origin);
        points.fold(Self { low: first, high: first }, |bounds, p| Self {
            low: Point2::new(bounds.low.x.min(p.x), bounds.low.y.min(p.y)),
            high: Point2::new(bounds.high.x.max(p.x), bounds.high.y.max(p.y)),
        })
    }

    pub(super) fn size(&self) -> Vector2<f64> {
        self.high - self.low
    }

    pub(super) fn diagonal(&self) -> f64 {
        self.size().norm()
    }
}

/// Room around the drawing for what has a size in pixels: hatches, arrows, labels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Margins {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

impl Margins {
    pub(super) const HATCH: Self = Self { left: 14.0, right: 14.0, top: 14.0, bottom: 14.0 };

    /// Room for both.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            left: self.left.max(other.left),
            right: self.right.max(other.right),
            top: self.top.max(other.top),
            bottom: self.bottom.max(other.bottom),
        }
    }
}

/// The map from metres to pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    /// Pixels per metre.
    pub(super) scale: f64,
    low: Point2<f64>,
    origin: Pixel,
}

impl Frame {
    pub(super) fn at(&self, point: Point2<f64>) -> Pixel {
        let from_low = (point - self.low) * self.scale;
        Pixel::new(self.origin.x + from_low.x, self.origin.y - from_low.y)
    }
}

/// A structure in a state, and the title of its pictures.
#[derive(Debug, Clone, Copy)]
pub(in crate::report) struct Shown<'a> {
    pub(in crate::report) title: &'a str,
    pub(in crate::report) model: &'a Model,
    pub(in crate::report) state: &'a State,
}

/// One line of the legend: a symbol drawn about the origin, and its text.
#[derive(Debug)]
struct Entry {
    symbol: Canvas,
    lines: Vec<String>,
}

/// A page under construction.
#[derive(Debug)]
pub(super) struct Sheet {
    pub(super) frame: Frame,
    pub(super) canvas: Canvas,
    /// Size of a middling brick in pixels, from which widths of strokes and marks follow.
    pub(super) brick: f64,
    units: InUnits,
    title: String,
    title_lines: Vec<String>,
    legend: Vec<Entry>,
    /// What a page is told about the picture: attributes of the file.
    data: String,
    /// Where the structure is drawn, and where it may be with all its marks: left, top, right and bottom.
    drawn: [f64; 4],
    room: [f64; 4],
    legend_below: bool,
}

impl Sheet {
    /// A sheet on which everything of a model within `bounds` has its place.
    pub(super) fn new(title: &str, model: &Model, bounds: Bounds, margins: Margins) -> Self {
        let title_lines = style::title_lines(title);
        let size = bounds.size();
        let legend_below = size.x > 1.5 * size.y;
        let beside = if legend_below { 0.0 } else { ENTRY_WIDTH };
        let width = WIDTH - 2.0 * EDGE - beside - margins.left - margins.right;
        let mut scale = f64::INFINITY;
        for (room, extent) in [(width, size.x), (TALLEST, size.y)] {
            if extent > 0.0 {
                scale = scale.min(room.max(1.0) / extent);
            }
        }
        if !scale.is_finite() {
            scale = 1.0;
        }
        let titles: f64 = title_lines.iter().map(|_| TITLE_LINE).sum();
        let drawn = size * scale;
        let origin = Pixel::new(
            EDGE + margins.left + 0.5 * (width - drawn.x).max(0.0),
            EDGE + titles + 6.0 + margins.top + drawn.y,
        );
        let frame = Frame { scale, low: bounds.low, origin };
        Self {
            frame,
            canvas: Canvas::default(),
            brick: brick_size(model, &frame),
            units: InUnits(model.units),
            title: title.to_owned(),
            title_lines,
            legend: Vec::new(),
            data: String::new(),
            drawn: [origin.x, origin.y - drawn.y, origin.x + drawn.x, origin.y],
            room: [
                EDGE,
                EDGE + titles,
                EDGE + margins.left + width + margins.right,
                origin.y + margins.bottom,
            ],
            legend_below,
        }
    }

    /// Where everything within the bounds is drawn: left, top, right and bottom.
    pub(super) fn drawn(&self) -> [f64; 4] {
        self.drawn
    }

    /// Where the drawing may be with all its marks: left, top, right and bottom.
    pub(super) fn room(&self) -> [f64; 4] {
        self.room
    }

    /// Tells a page something about the picture.
    pub(super) fn tell(&mut self, name: &str, value: &str) {
        self.data.extend([" data-", name, "=\"", &escape(value), "\""]);
    }

    /// Adds a legend entry; `draw` draws its symbol about the origin within 60 by 16 pixels.
    pub(super) fn entry(&mut self, text: &str, draw: impl FnOnce(&mut Canvas)) {
        let mut symbol = Canvas::default();
        draw(&mut symbol);
        let lines = wrapped(text, TEXT, ENTRY_WIDTH - SYMBOL_WIDTH - 12.0);
        self.legend.push(Entry { symbol, lines });
    }

    /// Adds a legend entry without a symbol.
    pub(super) fn note(&mut self, text: &str) {
        self.entry(text, |_| {});
    }

    /// Adds a legend entry with a line.
    pub(super) fn line_entry(&mut self, text: &str, colour: &str, width: &str) {
        let style = format!("stroke=\"{colour}\" stroke-width=\"{width}\"");
        let [from, to] = [-SYMBOL, SYMBOL].map(|x| Pixel::new(x, 0.0));
        self.entry(text, |symbol| symbol.line(from, to, &style));
    }

    /// Adds a legend entry with a block.
    pub(super) fn block_entry(&mut self, text: &str, fill: &str) {
        let style = format!("fill=\"{fill}\" stroke=\"{OUTLINE}\" stroke-width=\"1\"");
        self.entry(text, |symbol| symbol.rectangle(BLOCK, -2.0 * BLOCK.x, -2.0 * BLOCK.y, &style));
    }

    /// Adds a bar that shows a round length.
    fn length_bar(&mut self) {
        let units = self.units;
        let bar = round_down(units.length(58.0 / self.frame.scale));
        let half = 0.5 * bar * units.0.length_to_si() * self.frame.scale;
        if half.is_finite() && half > 0.0 {
            let text = format!("{bar} {}", units.0.length_name());
            self.entry(&text, |symbol| draw_bar(symbol, half, DARK, 1.4));
        }
    }

    /// The finished file.
    pub(super) fn finish(mut self) -> String {
        self.length_bar();
        let mut legend = Canvas::default();
        let [.., drawn] = self.room;
        let bottom = if self.legend_below {
            self.place_legend(&mut legend, EDGE, drawn + 16.0, 3)
        } else {
            let titles: f64 = self.title_lines.iter().map(|_| TITLE_LINE).sum();
            let top = EDGE + titles + 24.0;
            self.place_legend(&mut legend, WIDTH - EDGE - ENTRY_WIDTH + 14.0, top, 1)
        };
        let mut titles = Canvas::default();
        style::draw_title(&mut titles, &self.title_lines);
        let elements = format!(
            "<g class=\"title\">\n{}</g>\n<g class=\"drawing\">\n{}</g>\n<g class=\"legend\">\n{}</g>\n",
            titles.as_str(),
            self.canvas.as_str(),
            legend.as_str(),
        );
        style::file(&self.title, bottom.max(drawn) + EDGE, &self.data, &elements)
    }

    /// Draws the entries in rows of `columns` and returns the bottom of the last.
    fn place_legend(&self, canvas: &mut Canvas, left: f64, top: f64, columns: usize) -> f64 {
        let mut y = top;
        for row in self.legend.chunks(columns) {
            let mut x = left;
            let mut height: f64 = 0.0;
            for entry in row {
                let middle = format!(
                    "transform=\"translate({} {})\"",
                    fixed(x + 0.5 * SYMBOL_WIDTH),
                    fixed(y + 0.5 * TEXT_LINE)
                );
                canvas.group(&middle, |canvas| canvas.append(&entry.symbol));
                let mut base = y + 0.5 * TEXT_LINE + 0.36 * TEXT;
                for line in &entry.lines {
                    let at = Pixel::new(x + SYMBOL_WIDTH + 8.0, base);
                    canvas.text(at, Anchor::Start, TEXT, line);
                    base += TEXT_LINE;
                }
                let lines: f64 = entry.lines.iter().map(|_| TEXT_LINE).sum();
                height = height.max(lines.max(TEXT_LINE));
                x += ENTRY_WIDTH + 10.0;
            }
            y += height + ENTRY_GAP;
        }
        y
    }
}

/// Size of a middling brick in pixels, from which widths of strokes and marks follow.
fn brick_size(model: &Model, frame: &Frame) -> f64 {
    let mut areas: Vec<f64> =
        model.blocks.iter().map(|block| geometry::area(&block.corners)).collect();
    areas.sort_by(f64::total_cmp);
    areas.get(areas.len() / 2).copied().unwrap_or(0.0).max(0.0).sqrt() * frame.scale
}

/// A horizontal bar with end ticks about the origin.
pub(super) fn draw_bar(canvas: &mut Canvas, half: f64, colour: &str, width: f64) {
    let attributes = format!("stroke=\"{colour}\" stroke-width=\"{}\"", fixed(width));
    canvas.line(Pixel::new(-half, 0.0), Pixel::new(half, 0.0), &attributes);
    for x in [-half, half] {
        canvas.line(Pixel::new(x, -4.0), Pixel::new(x, 4.0), &attributes);
    }
}

/// Room for a label of this size beside the drawing.
pub(super) fn label_room(text: &str) -> f64 {
    text_width(text, TEXT) + 8.0
}
