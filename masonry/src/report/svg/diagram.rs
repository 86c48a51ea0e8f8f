//! Diagrams with two logarithmic axes: lines with markers, and a legend beside them.

use super::canvas::{Anchor, Canvas, Pixel, escape, fixed, text_width, wrapped};

const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 520.0;
const EDGE: f64 = 18.0;
const LEFT: f64 = 84.0;
const BOTTOM: f64 = 62.0;
const LEGEND: f64 = 240.0;
const TITLE_SIZE: f64 = 17.0;
const TITLE_LINE: f64 = 22.0;
const TEXT_SIZE: f64 = 13.0;
const TEXT_LINE: f64 = 17.0;
const GRID: &str = "#dddddd";
const FAINT: &str = "#f0f0f0";
const DARK: &str = "#222222";
/// More decades than these are not all labelled.
const MOST_LABELS: i32 = 10;
/// Axes of so few decades have lines at 2 and 5 too.
const FEW_DECADES: i32 = 3;
/// Axes within so many decades of one have no exponents.
const PLAIN_DECADES: i32 = 4;
const MARKER: f64 = 4.5;

/// Colours that differ also for those who see few of them (Okabe and Ito), each with its own marker.
const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9"];

/// A line through points, in their order.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// In the legend, unless it is empty.
    pub(super) name: String,
    /// Which colour and marker it has.
    pub(super) style: usize,
    /// Whether it is broken.
    pub(super) dashed: bool,
    /// Positive coordinates; others are left out.
    pub(super) points: Vec<[f64; 2]>,
}

/// Titles of a diagram, with units.
#[derive(Debug, Clone)]
pub(super) struct Titles<'a> {
    pub(super) title: &'a str,
    pub(super) x: &'a str,
    pub(super) y: &'a str,
}

/// The text of the file; `None` where no line has a point.
pub(super) fn diagram(titles: &Titles, lines: &[Line], notes: &[String]) -> Option<String> {
    let is_drawn = |point: &[f64; 2]| point.iter().all(|it| it.is_finite() && *it > 0.0);
    let lines: Vec<Line> = lines
        .iter()
        .map(|line| Line {
            points: line.points.iter().copied().filter(is_drawn).collect(),
            ..line.clone()
        })
        .collect();
    let of = |axis: usize| lines.iter().flat_map(move |it| it.points.iter().map(move |p| p[axis]));
    let title = wrapped(titles.title, TITLE_SIZE, WIDTH - 2.0 * EDGE);
    let top = EDGE + TITLE_LINE * title.len() as f64 + 8.0;
    let right = WIDTH - EDGE - LEGEND;
    let plot = Plot {
        x: Axis::around(of(0), [LEFT, right])?,
        y: Axis::around(of(1), [HEIGHT - BOTTOM, top])?,
    };

    let mut canvas = Canvas::default();
    for (k, line) in title.iter().enumerate() {
        let at = Pixel::new(EDGE, EDGE + TITLE_LINE * (k as f64 + 1.0) - 6.0);
        canvas.text(at, Anchor::Start, TITLE_SIZE, line);
    }
    plot.draw_grid(&mut canvas, titles);
    for line in lines.iter().filter(|line| !line.points.is_empty()) {
        plot.draw_line(&mut canvas, line);
    }
    let bottom = legend(&mut canvas, &lines, notes, Pixel::new(right + 22.0, top + 8.0));
    Some(page(titles.title, HEIGHT.max(bottom + EDGE), &canvas))
}

fn page(title: &str, height: f64, canvas: &Canvas) -> String {
    let (width, height) = (fixed(WIDTH), fixed(height));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" \
         font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" fill=\"{DARK}\">\n\
         <title>{}</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{}</svg>\n",
        escape(title),
        canvas.as_str()
    )
}

/// Whole decades, and the pixels of both ends.
struct Axis {
    decades: [i32; 2],
    pixels: [f64; 2],
}

impl Axis {
    /// The axis on which all values have their place; `None` without values.
    fn around(values: impl Iterator<Item = f64> + Clone, pixels: [f64; 2]) -> Option<Self> {
        let least = values.clone().reduce(f64::min)?.log10().floor();
        let most = values.reduce(f64::max)?.log10().ceil().max(least + 1.0);
        // Decades of doubles are within 400 of zero.
        #[allow(clippy::cast_possible_truncation)]
        let decades = [least as i32, most as i32];
        Some(Self { decades, pixels })
    }

    fn at(&self, value: f64) -> f64 {
        let [low, high] = self.decades.map(f64::from);
        let [from, to] = self.pixels;
        from + (to - from) * (value.log10() - low) / (high - low)
    }

    fn span(&self) -> i32 {
        self.decades[1] - self.decades[0]
    }

    /// Values of the lines of the grid, each with its label if it has one.
    fn ticks(&self) -> Vec<(f64, Option<String>)> {
        let [low, high] = self.decades;
        let step = (self.span() + MOST_LABELS - 1) / MOST_LABELS;
        let mut ticks = Vec::new();
        for decade in low..=high {
            let value = 10_f64.powi(decade);
            let is_labelled = decade % step == 0;
            ticks.push((value, is_labelled.then(|| self.label(value, decade))));
            if self.span() <= FEW_DECADES && decade < high {
                for minor in [2.0 * value, 5.0 * value] {
                    ticks.push((minor, Some(self.label(minor, decade))));
                }
            }
        }
        ticks
    }

    /// All labels of an axis are alike: with exponents, or none with.
    fn label(&self, value: f64, decade: i32) -> String {
        let [low, high] = self.decades;
        if low < -PLAIN_DECADES || high > PLAIN_DECADES {
            return format!("{value:.0e}");
        }
        let decimals = usize::try_from(-decade).unwrap_or(0);
        format!("{value:.decimals$}")
    }
}

struct Plot {
    x: Axis,
    y: Axis,
}

impl Plot {
    fn draw_grid(&self, canvas: &mut Canvas, titles: &Titles) {
        let ([left, right], [bottom, top]) = (self.x.pixels, self.y.pixels);
        for (value, label) in self.x.ticks() {
            let x = self.x.at(value);
            canvas.line(Pixel::new(x, bottom), Pixel::new(x, top), &grid(label.is_some()));
            if let Some(label) = label {
                canvas.text(Pixel::new(x, bottom + 18.0), Anchor::Middle, TEXT_SIZE, &label);
            }
        }
        for (value, label) in self.y.ticks() {
            let y = self.y.at(value);
            canvas.line(Pixel::new(left, y), Pixel::new(right, y), &grid(label.is_some()));
            if let Some(label) = label {
                canvas.text(Pixel::new(left - 8.0, y + 4.5), Anchor::End, TEXT_SIZE, &label);
            }
        }
        let frame = format!("fill=\"none\" stroke=\"{DARK}\" stroke-width=\"1\"");
        canvas.rectangle(Pixel::new(left, top), right - left, bottom - top, &frame);
        let middle = Pixel::new(0.5 * (left + right), HEIGHT - EDGE);
        canvas.text(middle, Anchor::Middle, TEXT_SIZE, titles.x);
        let at = Pixel::new(EDGE + 10.0, 0.5 * (bottom + top));
        let turned = format!("transform=\"rotate(-90 {} {})\"", fixed(at.x), fixed(at.y));
        canvas.text_with(at, Anchor::Middle, TEXT_SIZE, &turned, titles.y);
    }

    fn draw_line(&self, canvas: &mut Canvas, line: &Line) {
        let colour = COLOURS[line.style % COLOURS.len()];
        let points: Vec<Pixel> =
            line.points.iter().map(|[x, y]| Pixel::new(self.x.at(*x), self.y.at(*y))).collect();
        let dashes = dashes(line);
        let style = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\"{dashes}");
        canvas.group(&style, |canvas| canvas.polyline(&points));
        for point in points {
            marker(canvas, point, line.style);
        }
    }
}

fn grid(is_labelled: bool) -> String {
    format!("stroke=\"{}\" stroke-width=\"1\"", if is_labelled { GRID } else { FAINT })
}

fn dashes(line: &Line) -> &'static str {
    if line.dashed { " stroke-dasharray=\"6 4\"" } else { "" }
}

fn marker(canvas: &mut Canvas, at: Pixel, style: usize) {
    let colour = COLOURS[style % COLOURS.len()];
    let attributes = format!("fill=\"{colour}\" stroke=\"#ffffff\" stroke-width=\"0.8\"");
    let shifted = |dx: f64, dy: f64| Pixel::new(at.x + dx * MARKER, at.y + dy * MARKER);
    match style % COLOURS.len() {
        0 => canvas.circle(at, MARKER, &attributes),
        1 => canvas.rectangle(shifted(-0.9, -0.9), 1.8 * MARKER, 1.8 * MARKER, &attributes),
        2 => {
            let corners = [shifted(0.0, -1.3), shifted(1.2, 0.9), shifted(-1.2, 0.9)];
            canvas.polygon(&corners, &attributes);
        }
        3 => {
            let corners =
                [shifted(0.0, -1.4), shifted(1.4, 0.0), shifted(0.0, 1.4), shifted(-1.4, 0.0)];
            canvas.polygon(&corners, &attributes);
        }
        4 => {
            let corners = [shifted(0.0, 1.3), shifted(1.2, -0.9), shifted(-1.2, -0.9)];
            canvas.polygon(&corners, &attributes);
        }
        _ => {
            let corners =
                [shifted(0.0, -1.7), shifted(0.7, 0.0), shifted(0.0, 1.7), shifted(-0.7, 0.0)];
            canvas.polygon(&corners, &attributes);
        }
    }
}

/// Draws names and notes; gives where they end.
fn legend(canvas: &mut Canvas, lines: &[Line], notes: &[String], at: Pixel) -> f64 {
    let mut y = at.y;
    for line in lines.iter().filter(|line| !line.name.is_empty()) {
        let colour = COLOURS[line.style % COLOURS.len()];
        if !line.points.is_empty() {
            let stroke = format!("stroke=\"{colour}\" stroke-width=\"1.8\"{}", dashes(line));
            canvas.line(Pixel::new(at.x, y), Pixel::new(at.x + 28.0, y), &stroke);
        }
        marker(canvas, Pixel::new(at.x + 14.0, y), line.style);
        y = text(canvas, &line.name, Pixel::new(at.x + 38.0, y + 4.5)) + 6.0;
    }
    y += 8.0;
    for note in notes {
        y = text(canvas, note, Pixel::new(at.x, y + 4.5)) + 6.0;
    }
    y
}

/// Draws a text in as many lines as it takes up to the right edge; gives the middle of the next line.
fn text(canvas: &mut Canvas, words: &str, at: Pixel) -> f64 {
    let room = (WIDTH - EDGE - at.x).max(text_width("m", TEXT_SIZE));
    let mut y = at.y;
    for line in wrapped(words, TEXT_SIZE, room) {
        canvas.text(Pixel::new(at.x, y), Anchor::Start, TEXT_SIZE, &line);
        y += TEXT_LINE;
    }
    y - 4.5
}
