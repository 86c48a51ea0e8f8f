//! Diagrams of curves, one or several in a picture, with logarithmic or linear axes.

use super::axis::Axis;
pub use super::axis::AxisScale;
use super::canvas::{Anchor, Canvas, Pixel, closed, open, wrapped};
use super::labels::{Label, Labels};
use super::legend::{self, Legend};
use super::sheet::Sides;
use super::style::{COLOURS, EDGE, TEXT, TEXT_LINE, TICK, WIDTH};

/// Height of a single diagram with logarithmic axes, height of a diagram with linear axes, and width and height of one
/// of several diagrams.
const HEIGHT: f64 = 430.0;
const LINEAR_HEIGHT: f64 = 300.0;
const ONE_OF_MANY: [f64; 2] = [560.0, 340.0];
/// Number of columns of a legend.
const COLUMNS: usize = 3;
/// Room left of, right of and below the area that the axes enclose.
const LEFT: f64 = 76.0;
const RIGHT: f64 = 15.0;
const BELOW: f64 = 52.0;
/// The distance between rows of diagrams.
const GAP: f64 = 8.0;
/// Corners of the markers about the point that they mark, in pixels.
const SHAPES: [&[[f64; 2]]; COLOURS] = [
    &[[-1., -4.], [2., -4.], [4., -1.], [4., 2.], [2., 4.], [-1., 4.], [-4., 2.], [-4., -1.]],
    &[[-4., -4.], [4., -4.], [4., 4.], [-4., 4.]],
    &[[0., -5.], [5., 4.], [-5., 4.]],
    &[[0., -6.], [6., 0.], [0., 6.], [-6., 0.]],
    &[[0., 5.], [5., -4.], [-5., -4.]],
    &[[-3., 0.], [0., -7.], [3., 0.], [0., 7.]],
    &[[-6., 0.], [0., -3.], [6., 0.], [0., 3.]],
];
/// Lines through more points than this number have no markers.
const MARKED: usize = 60;

/// The look of a series of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// A line with markers.
    Full,
    /// A line with hollow markers.
    Hollow,
    /// Dots without a line.
    Dots,
    /// A grey line without markers, with which other series are compared; dashed unless its style is 0.
    Bound,
}

/// Points of one curve, in their order.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// The name in the legend, unless it is empty.
    pub name: String,
    /// The number of the colour and of the marker.
    pub style: usize,
    /// The look of the series.
    pub look: Look,
    /// The points \[horizontal, vertical\]. Points without a place on the axes, such as negative values on logarithmic
    /// axes, are left out.
    pub points: Vec<[f64; 2]>,
}

impl Series {
    /// Returns the points that have a place on the axes.
    fn placed(&self, scale: AxisScale) -> impl Iterator<Item = [f64; 2]> + Clone {
        let has_place = move |it: &f64| it.is_finite() && (scale == AxisScale::Linear || *it > 0.0);
        self.points.iter().filter(move |it| it.iter().all(has_place)).copied()
    }

    /// Returns the class of the lines in the style sheet.
    fn class(&self) -> String {
        let line = match self.look {
            Look::Full | Look::Hollow => "curve",
            Look::Dots => "dots",
            Look::Bound if self.style == 0 => return "curve bound".to_owned(),
            Look::Bound => return "curve bound dashed".to_owned(),
        };
        format!("{line} colour{}", self.style % COLOURS)
    }

    fn draw(&self, canvas: &mut Canvas, pixels: &[Pixel]) {
        let data = match self.look {
            // A line of length zero with round ends is a dot.
            Look::Dots => pixels.iter().map(|it| open([*it, *it])).collect(),
            _ => open(pixels.iter().copied()),
        };
        canvas.path(&data, &format!("class=\"{}\"", self.class()));
        let inside = match self.look {
            Look::Full => "",
            Look::Hollow => " hollow",
            Look::Dots | Look::Bound => return,
        };
        if pixels.len() <= MARKED {
            let index = self.style % COLOURS;
            let marker = |at: &Pixel| {
                closed(SHAPES[index].iter().map(|[x, y]| Pixel::new(at.x + x, at.y + y)))
            };
            let markers: String = pixels.iter().map(marker).collect();
            canvas.path(&markers, &format!("class=\"markers colour{index}{inside}\""));
        }
    }

    /// Draws the symbol for the legend: a line with a marker in its middle, or a dot.
    fn draw_symbol(&self, symbol: &mut Canvas) {
        let [from, middle, to] = [-22.0, 0.0, 22.0].map(|x| Pixel::new(x, 0.0));
        if self.look != Look::Dots {
            symbol.path(&open([from, to]), "");
        }
        self.draw(symbol, &[middle]);
    }
}

/// The place on the horizontal axis at which a stage begins, and the name of the stage.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveStart {
    /// The value on the horizontal axis at which the stage begins.
    pub at: f64,
    /// The text beside the vertical line at `at`.
    pub name: String,
}

/// A diagram: two axes and the curves between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Diagram {
    /// The title above the diagram; empty if the picture has a single diagram.
    pub title: String,
    /// Names of the horizontal and the vertical values, with units.
    pub axes: [String; 2],
    /// The scale of both axes, linear or logarithmic.
    pub scale: AxisScale,
    /// Values that the vertical axis includes in any case.
    pub least: Option<[f64; 2]>,
    /// The curves; later curves are drawn over earlier ones.
    pub series: Vec<Series>,
    /// The places at which stages begin.
    pub stages: Vec<CurveStart>,
    /// The values on the horizontal axis at which a page marks a step, one for every step; empty in a file.
    pub steps: Vec<f64>,
}

impl Diagram {
    /// Returns a diagram of full lines with linear axes. Series get separate colours, except bounds, which keep their
    /// style.
    pub(crate) fn linear(axes: [&str; 2], mut series: Vec<Series>) -> Self {
        let full = series.iter_mut().filter(|it| it.look == Look::Full);
        full.enumerate().for_each(|(style, it)| it.style = style);
        let axes = axes.map(str::to_owned);
        Self { axes, scale: AxisScale::Linear, series, ..Self::default() }
    }

    fn is_empty(&self) -> bool {
        self.series.iter().all(|it| it.placed(self.scale).next().is_none())
    }

    fn draw_legend(&self, canvas: &mut Canvas, top: f64) -> f64 {
        let mut legend = Legend::default();
        for series in self.series.iter().filter(|it| !it.name.is_empty()) {
            legend.add(&series.name, &series.class(), |symbol| series.draw_symbol(symbol));
        }
        legend.draw(canvas, Pixel::new(EDGE, top), COLUMNS)
    }
}

/// Returns the text of an SVG file. Diagrams in which no series has a point are left out; `None` if no diagram remains.
/// Diagrams with logarithmic axes share a legend and stand in two columns; other diagrams stand one below the other,
/// each with its legend.
pub fn picture(title: &str, diagrams: &[Diagram], notes: &[String]) -> Option<String> {
    let drawn: Vec<&Diagram> = diagrams.iter().filter(|it| !it.is_empty()).collect();
    let first = drawn.first()?;
    let are_linear = first.scale == AxisScale::Linear;
    let columns = if are_linear || drawn.len() == 1 { 1 } else { 2 };
    let [wide, high] = match (columns, are_linear) {
        (2, _) => ONE_OF_MANY,
        (_, true) => [WIDTH - 2.0 * EDGE, LINEAR_HEIGHT],
        (_, false) => [WIDTH - 2.0 * EDGE, HEIGHT],
    };
    let width = wide * columns as f64 + 2.0 * EDGE;
    let mut canvas = Canvas::default();
    let mut top = legend::title(&mut canvas, title, width) + 6.0;
    for line in notes.iter().flat_map(|it| wrapped(it, TEXT, width - 2.0 * EDGE)) {
        top += TEXT_LINE;
        canvas.text(Pixel::new(EDGE, top - 4.0), Anchor::Start, TEXT, "", &line);
    }
    top += 10.0;
    for row in drawn.chunks(columns) {
        if are_linear || std::ptr::eq(row[0], *first) {
            top = row[0].draw_legend(&mut canvas, top);
        }
        for (column, diagram) in row.iter().enumerate() {
            let corner = Pixel::new(EDGE + column as f64 * wide, top);
            if let Some(panel) = Panel::of(diagram, corner, [wide, high]) {
                panel.draw(&mut canvas);
            }
        }
        top += high + GAP;
    }
    Some(legend::file(title, [width, top + EDGE], "", &canvas))
}

/// A diagram at its place in the picture.
struct Panel<'a> {
    diagram: &'a Diagram,
    corner: Pixel,
    width: f64,
    /// The area that the axes enclose.
    inner: Sides,
    across: Axis,
    up: Axis,
}

impl<'a> Panel<'a> {
    fn of(diagram: &'a Diagram, corner: Pixel, [width, height]: [f64; 2]) -> Option<Self> {
        let scale = diagram.scale;
        let all = || diagram.series.iter().flat_map(|it| it.placed(scale));
        let least = diagram.least.into_iter().flatten();
        let caption = if diagram.title.is_empty() { 0.0 } else { TEXT_LINE + 4.0 };
        let inner = Sides {
            left: corner.x + LEFT,
            right: corner.x + width - RIGHT,
            top: (corner.y + caption).round(),
            bottom: (corner.y + height - BELOW).round(),
        };
        let across = Axis::around(scale, all().map(|it| it[0]), [inner.left, inner.right])?;
        let values = all().map(|it| it[1]).chain(least);
        let up = Axis::around(scale, values, [inner.bottom, inner.top])?;
        Some(Self { diagram, corner, width, inner, across, up })
    }

    fn draw(&self, canvas: &mut Canvas) {
        self.draw_axes(canvas);
        let mut labels = Labels::within(self.inner);
        for series in &self.diagram.series {
            let points = series.placed(self.diagram.scale);
            let pixel = |[x, y]: [f64; 2]| Pixel::new(self.across.at(x), self.up.at(y));
            let pixels: Vec<Pixel> = points.map(pixel).collect();
            series.draw(canvas, &pixels);
            pixels.windows(2).for_each(|it| labels.avoid([it[0], it[1]]));
        }
        self.draw_stages(canvas, &mut labels);
        self.draw_step(canvas);
    }

    fn draw_axes(&self, canvas: &mut Canvas) {
        let Sides { left, right, top, bottom } = self.inner;
        let [across, up] = &self.diagram.axes;
        let title = Pixel::new(self.corner.x + 0.5 * self.width, self.corner.y + TEXT);
        canvas.text(title, Anchor::Middle, TEXT, "", &self.diagram.title);
        let below = Pixel::new(0.5 * (left + right), bottom + 44.0);
        canvas.text(below, Anchor::Middle, TEXT, "", across);
        let side = Pixel::new(self.corner.x + 11.0, 0.5 * (top + bottom));
        let turned = format!("transform=\"rotate(-90 {} {})\"", side.x, side.y);
        canvas.text(side, Anchor::Middle, TEXT, &turned, up);
        let mut axes = line([[left, top], [left, bottom], [right, bottom]]);
        let mut grid = String::new();
        for (x, label) in self.across.labels() {
            grid += &line([[x, bottom], [x, top]]);
            axes += &line([[x, bottom], [x, bottom + TICK]]);
            let at = Pixel::new(x, bottom + TICK + TEXT + 3.0);
            canvas.text(at, Anchor::Middle, TEXT, "", label);
        }
        for (y, label) in self.up.labels() {
            grid += &line([[left, y], [right, y]]);
            axes += &line([[left, y], [left - TICK, y]]);
            let at = Pixel::new(left - 2.0 * TICK, y + 0.36 * TEXT);
            canvas.text(at, Anchor::End, TEXT, "", label);
        }
        canvas.path(&grid, "class=\"grid\"");
        canvas.path(&axes, "class=\"axes\"");
    }

    /// Draws the places at which stages begin, with their names if there is room.
    fn draw_stages(&self, canvas: &mut Canvas, labels: &mut Labels) {
        let Sides { top, bottom, .. } = self.inner;
        let line = |at: f64| [bottom, top].map(|y| Pixel::new(self.across.at(at), y));
        for it in &self.diagram.stages {
            canvas.path(&open(line(it.at)), "class=\"stages\"");
            labels.avoid(line(it.at));
        }
        canvas.group("class=\"labels\"", |canvas| {
            for CurveStart { at, name: text } in &self.diagram.stages {
                let at = Pixel::new(self.across.at(*at) + TICK, top + TEXT_LINE);
                let side = nalgebra::Vector2::x();
                labels.draw(canvas, &Label { text, size: TEXT, at, side, name: "" });
            }
        });
    }

    /// Draws the mark of the step that a page shows: at first the last one.
    fn draw_step(&self, canvas: &mut Canvas) {
        let places: Vec<f64> = self.diagram.steps.iter().map(|it| self.across.at(*it)).collect();
        let Some(last) = places.last() else { return };
        let list: Vec<String> = places.iter().map(f64::to_string).collect();
        let moved = format!("data-steps=\"{}\" transform=\"translate({last} 0)\"", list.join(" "));
        let line = line([[0.0, self.inner.bottom], [0.0, self.inner.top]]);
        canvas.path(&line, &format!("class=\"step\" {moved}"));
    }
}

fn line<const N: usize>(points: [[f64; 2]; N]) -> String {
    open(points.map(|[x, y]| Pixel::new(x, y)))
}
