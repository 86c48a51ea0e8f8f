//! A sheet with a structure: title on top, drawing, and a legend beside or below the drawing that never overlaps the
//! drawing.

use nalgebra::{Point2, Vector2};

use super::canvas::{Canvas, Pixel, escape, fixed, text_width};
use super::legend::{self, ENTRY_WIDTH, Legend};
use super::style::{EDGE, LARGEST_BRICK, SMALLEST_BRICK, TEXT, WIDTH};
use crate::format::{InUnits, round_down};
use masonry::data::state::State;
use masonry::geometry;
use masonry::model::Model;

const TALLEST: f64 = 760.0;
/// The length of the longest bar in the legend.
pub(super) const LONGEST_BAR: f64 = 58.0;

/// An axis-parallel box \[m\].
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    pub(super) low: Point2<f64>,
    pub(super) high: Point2<f64>,
}

impl Bounds {
    /// Returns the smallest box around all finite points; a box at the origin without points.
    pub(super) fn of(points: impl IntoIterator<Item = Point2<f64>>) -> Self {
        let points = points.into_iter().filter(|p| p.x.is_finite() && p.y.is_finite());
        let boxes = points.map(|p| Self { low: p, high: p });
        boxes
            .reduce(|a, b| Self { low: a.low.inf(&b.low), high: a.high.sup(&b.high) })
            .unwrap_or(Self { low: Point2::origin(), high: Point2::origin() })
    }

    pub(super) fn ends(&self) -> [Point2<f64>; 2] {
        [self.low, self.high]
    }

    pub(super) fn middle(&self) -> Point2<f64> {
        nalgebra::center(&self.low, &self.high)
    }

    pub(super) fn size(&self) -> Vector2<f64> {
        self.high - self.low
    }
}

/// Lengths in pixels at the four sides of the drawing, or the positions of these sides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

impl Sides {
    /// Room for the hatches of supports on all sides.
    pub(super) const HATCH: Self = Self { left: 14.0, right: 14.0, top: 14.0, bottom: 14.0 };

    /// Returns the larger room on every side.
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
    /// The number of pixels per metre.
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
pub struct Shown<'a> {
    /// The title of the picture.
    pub title: &'a str,
    /// The structure that is drawn.
    pub model: &'a Model,
    /// The state of the structure that is drawn.
    pub state: &'a State,
}

/// A picture that is being drawn.
#[derive(Debug)]
pub(super) struct Sheet {
    pub(super) frame: Frame,
    pub(super) legend: Legend,
    /// The area of the structure in pixels.
    pub(super) drawn: Sides,
    /// The area of the structure with all its marks in pixels.
    pub(super) room: Sides,
    /// The side of a square as large as a median brick, in pixels.
    pub(super) brick: f64,
    canvas: Canvas,
    units: InUnits,
    title: String,
    titles: Canvas,
    /// Attributes of the SVG file, by which a page identifies the picture.
    data: String,
    is_legend_below: bool,
}

impl Sheet {
    /// Creates a sheet with room for a model within `bounds`, and for marks of the size `margins` around it.
    pub(super) fn new(title: String, model: &Model, bounds: Bounds, margins: Sides) -> Self {
        let mut titles = Canvas::default();
        let top = legend::title(&mut titles, &title, WIDTH);
        let size = bounds.size();
        let is_legend_below = size.x > 1.5 * size.y;
        let beside = if is_legend_below { 0.0 } else { ENTRY_WIDTH };
        let width = WIDTH - 2.0 * EDGE - beside - margins.left - margins.right;
        let scales = [width.max(1.0) / size.x, TALLEST / size.y];
        let scale = scales.into_iter().filter(|it| it.is_finite()).reduce(f64::min).unwrap_or(1.0);
        let [wide, high] = [size.x * scale, size.y * scale];
        let left = EDGE + margins.left + 0.5 * (width - wide).max(0.0);
        let bottom = top + 6.0 + margins.top + high;
        let frame = Frame { scale, low: bounds.low, origin: Pixel::new(left, bottom) };
        Self {
            frame,
            legend: Legend::default(),
            drawn: Sides { left, right: left + wide, top: bottom - high, bottom },
            room: Sides {
                left: EDGE,
                right: EDGE + margins.left + width + margins.right,
                top,
                bottom: bottom + margins.bottom,
            },
            canvas: Canvas::default(),
            brick: scale * brick_size(model),
            units: InUnits(model.units),
            title,
            titles,
            data: String::new(),
            is_legend_below,
        }
    }

    /// Draws marks of a class of the style sheet, whose line widths depend on the size of bricks.
    pub(super) fn layer(&mut self, class: &str, draw: impl FnOnce(&mut Canvas, &Frame)) {
        self.layer_sized(class, self.marks(), draw);
    }

    /// Draws marks of a class of the style sheet, whose line widths depend on `size`.
    pub(super) fn layer_sized(
        &mut self,
        class: &str,
        size: f64,
        draw: impl FnOnce(&mut Canvas, &Frame),
    ) {
        let attributes = format!("class=\"{class}\" font-size=\"{}\"", fixed(size));
        self.canvas.group(&attributes, |canvas| draw(canvas, &self.frame));
    }

    /// Returns the size of a brick in pixels on which marks depend, within the bounds of the style.
    pub(super) fn marks(&self) -> f64 {
        self.brick.clamp(SMALLEST_BRICK, LARGEST_BRICK)
    }

    /// Adds an attribute of the picture that a page reads.
    pub(super) fn tell(&mut self, name: &str, value: &str) {
        self.data.extend([" data-", name, "=\"", &escape(value), "\""]);
    }

    /// Adds the frame of the drawing as an attribute for a page: the position of the origin, and the number of pixels
    /// for one unit of length (y up).
    fn tell_frame(&mut self) {
        let Frame { scale, low, origin } = self.frame;
        let (x, y) = (origin.x - low.x * scale, origin.y + low.y * scale);
        let per_unit = self.units.0.length_to_si() * scale;
        self.tell("frame", &format!("{x:.3} {y:.3} {per_unit:.9e}"));
    }

    /// Returns the text of the finished file.
    pub(super) fn finish(mut self) -> String {
        self.add_length();
        self.tell_frame();
        let mut elements = self.titles;
        elements.group("class=\"drawing\"", |it| it.append(&self.canvas));
        let Sides { top, bottom, .. } = self.room;
        let (corner, columns) = if self.is_legend_below {
            (Pixel::new(EDGE, bottom + 16.0), 3)
        } else {
            (Pixel::new(WIDTH - EDGE - ENTRY_WIDTH + 14.0, top + 24.0), 1)
        };
        let mut end = bottom;
        elements.group("class=\"legend\"", |it| {
            end = end.max(self.legend.draw(it, corner, columns));
        });
        legend::file(&self.title, [WIDTH, end + EDGE], &self.data, &elements)
    }

    /// Adds a bar to the legend that shows a round length.
    fn add_length(&mut self) {
        let units = self.units;
        let round = round_down(units.length(LONGEST_BAR / self.frame.scale));
        let half = 0.5 * round * units.0.length_to_si() * self.frame.scale;
        if half.is_finite() && half > 0.0 {
            let text = format!("{round} {}", units.0.length_name());
            self.legend.add(&text, "bar", legend::bar(half));
        }
    }
}

/// Returns the side of a square as large as a median brick \[m\].
pub(super) fn brick_size(model: &Model) -> f64 {
    middling(model.blocks.iter().map(|it| geometry::area(&it.corners)))
}

/// Returns the side of a square as large as the median of these areas.
pub(super) fn middling(areas: impl Iterator<Item = f64>) -> f64 {
    let mut areas: Vec<f64> = areas.collect();
    areas.sort_by(f64::total_cmp);
    areas.get(areas.len() / 2).copied().unwrap_or(0.0).max(0.0).sqrt()
}

/// Returns the room for a label with this text beside the drawing.
pub(super) fn label_room(text: &str) -> f64 {
    text_width(text, TEXT) + 8.0
}
