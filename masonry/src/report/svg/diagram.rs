//! Diagrams with logarithmic axes, one or many in a picture.
//!
//! Lines and markers have classes, and coordinates are whole pixels: pages with hundreds of curves stay small.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::ops::Range;

use super::canvas::{escape, text_width, wrapped};
use super::style::{COLOURS, FONT, TEXT, TITLE};

/// Height of a line of text, and from its top to the foot of its letters.
const LINE: i32 = 19;
const FOOT: i32 = 13;
/// From the middle of a line of text to the foot of its letters.
const HALF: i32 = 5;
const EDGE: i32 = 16;
/// A diagram alone, and one of several, which stand in two columns.
const SIZES: [[i32; 2]; 2] = [[868, 430], [560, 340]];
/// Room left of, right of and below the lines of a diagram.
const LEFT: i32 = 76;
const RIGHT: i32 = 15;
const BELOW: i32 = 52;
/// Lengths of the marks at the labels of an axis.
const TICK: i32 = 5;
/// Corners of markers, in pixels.
const MARKERS: [&[[i32; 2]]; 7] = [
    &[[-1, -4], [2, -4], [4, -1], [4, 2], [2, 4], [-1, 4], [-4, 2], [-4, -1]],
    &[[-4, -4], [4, -4], [4, 4], [-4, 4]],
    &[[0, -5], [5, 4], [-5, 4]],
    &[[0, -6], [6, 0], [0, 6], [-6, 0]],
    &[[0, 5], [5, -4], [-5, -4]],
    &[[-3, 0], [0, -7], [3, 0], [0, 7]],
    &[[-6, 0], [0, -3], [6, 0], [0, 3]],
];
/// Axes of fewer decades have lines at 2 and 5 too.
const FEW: f64 = 3.0;
const MOST_LABELS: f64 = 9.0;
/// Axes within these have no exponents.
const PLAIN: Range<f64> = 0.9e-4..1.1e4;

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Look {
    /// A line with markers.
    Full,
    /// A line with the outlines of markers.
    Hollow,
    /// Dots alone.
    Dots,
    /// A grey line alone, with which others are compared; dashed unless its style is 0.
    Bound,
}

/// Points that belong together, in their order.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// In the legend, unless it is empty.
    pub name: String,
    /// Which colour and marker it has.
    pub style: usize,
    /// How it is drawn.
    pub look: Look,
    /// Positive coordinates; others are left out.
    pub points: Vec<[f64; 2]>,
}

impl Series {
    fn kind(&self) -> Kind {
        let styles = if self.look == Look::Bound { 2 } else { COLOURS.len() };
        Kind { look: self.look, style: self.style % styles }
    }

    fn drawn(&self) -> impl Iterator<Item = [f64; 2]> + Clone {
        let is_drawn = |point: &&[f64; 2]| point.iter().all(|it| it.is_finite() && *it > 0.0);
        self.points.iter().filter(is_drawn).copied()
    }
}

/// What a class of lines has in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Kind {
    look: Look,
    style: usize,
}

impl Kind {
    /// The name of its lines, and of its marker.
    fn name(self) -> String {
        let look = match self.look {
            Look::Full => "full",
            Look::Hollow => "hollow",
            Look::Dots => "dots",
            Look::Bound => "bound",
        };
        format!("{look}{}", self.style)
    }

    fn rule(self) -> String {
        let (name, colour) = (self.name(), COLOURS[self.style]);
        match self.look {
            Look::Full | Look::Hollow => {
                format!(".{name}{{stroke:{colour};stroke-width:2;marker:url(#{name})}}\n")
            }
            // A line of no length with round ends.
            Look::Dots => {
                format!(".{name}{{stroke:{colour};stroke-width:5;stroke-linecap:round}}\n")
            }
            Look::Bound => {
                let dashes = ["", ";stroke-dasharray:7 4"][self.style];
                format!(".{name}{{stroke:#aaa;stroke-width:2{dashes}}}\n")
            }
        }
    }

    /// What stands at every point of a line.
    fn marker(self) -> Option<String> {
        let fill = match self.look {
            Look::Full => COLOURS[self.style],
            Look::Hollow => "#fff",
            Look::Dots | Look::Bound => return None,
        };
        let (name, colour) = (self.name(), COLOURS[self.style]);
        let corners = MARKERS[self.style].iter().map(|[x, y]| format!("{x} {y}"));
        let corners: Vec<String> = corners.collect();
        Some(format!(
            "<marker id=\"{name}\" markerUnits=\"userSpaceOnUse\" overflow=\"visible\">\
             <path d=\"M{}z\" style=\"fill:{fill};stroke:{colour};stroke-width:1\"/></marker>\n",
            corners.join(" ")
        ))
    }

    fn path(self, text: &mut String, pixels: &[[i32; 2]]) {
        let mut data = String::new();
        for (k, [x, y]) in pixels.iter().enumerate() {
            let _ = match self.look {
                Look::Dots => write!(data, "M{x} {y}h0"),
                _ => write!(data, "{}{x} {y}", if k == 0 { "M" } else { " " }),
            };
        }
        if let ([_], true) = (pixels, self.look != Look::Dots) {
            // A point alone has no line, and so no marker.
            data += "h0";
        }
        if !data.is_empty() {
            let _ = writeln!(text, "<path class=\"{}\" d=\"{data}\"/>", self.name());
        }
    }
}

/// Two axes and what stands between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// Above it, where it is one of several.
    pub title: String,
    /// What is drawn across and up, with units.
    pub axes: [String; 2],
    /// What the vertical axis has at least, whatever the points are.
    pub least: Option<[f64; 2]>,
    /// Later ones are drawn over earlier ones.
    pub series: Vec<Series>,
}

/// The text of an SVG file; `None` where no series has a point. The legend above all is that of the first diagram.
pub fn picture(title: &str, diagrams: &[Diagram], notes: &[String]) -> Option<String> {
    let all = || diagrams.iter().flat_map(|it| &it.series);
    all().find_map(|it| it.drawn().next())?;
    let columns = diagrams.len().min(SIZES.len());
    let rows = diagrams.len().div_ceil(columns);
    let [width, height] = [columns, rows].map(|it| i32::try_from(it).unwrap_or(1));
    let [wide, high] = SIZES[columns - 1];
    let mut drawn = String::new();
    let head = draw_head(&mut drawn, title, &diagrams[0].series, notes, width * wide);
    let places = (0..height).flat_map(|row| (0..width).map(move |column| [column, row]));
    for (diagram, [column, row]) in diagrams.iter().zip(places) {
        diagram.draw(&mut drawn, [EDGE + column * wide, head + row * high], [wide, high]);
    }
    let kinds: BTreeSet<Kind> = all().map(Series::kind).collect();
    let rules: String = kinds.iter().map(|kind| kind.rule()).collect();
    let markers: String = kinds.iter().filter_map(|kind| kind.marker()).collect();
    let [width, height] = [width * wide + 2 * EDGE, head + height * high + EDGE];
    Some(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"{FONT}\" font-size=\"{TEXT}\">\n\
         <title>{}</title>\n<style>\npath{{fill:none}}\n.grid{{stroke:#ddd}}\n.axes{{stroke:#000}}\n{rules}</style>\n{markers}\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{drawn}</svg>\n",
        escape(title)
    ))
}

/// Title, legend and notes, in as many lines as they take; where they end.
fn draw_head(
    drawn: &mut String,
    title: &str,
    series: &[Series],
    notes: &[String],
    width: i32,
) -> i32 {
    let mut top = draw_lines(drawn, title, TITLE, EDGE, width);
    let (mut x, gap) = (0, 40);
    for series in series.iter().filter(|it| !it.name.is_empty()) {
        #[allow(clippy::cast_possible_truncation)]
        let wide = text_width(&series.name, TEXT) as i32 + gap;
        if x > 0 && x + wide > width {
            (x, top) = (0, top + LINE);
        }
        let [left, middle] = [EDGE + x, top + LINE / 2];
        // The marker stands in the middle of the line, which has none at its ends.
        let (kind, name) = (series.kind(), series.kind().name());
        let _ = writeln!(
            drawn,
            "<path class=\"{name}\" style=\"marker:none\" d=\"M{left} {middle}h22\"/>"
        );
        kind.path(drawn, &[[left + 11, middle]]);
        draw_text(drawn, [left + 28, middle + HALF], "", &series.name);
        x += wide;
    }
    top += LINE + LINE / 3;
    for note in notes {
        top = draw_lines(drawn, note, TEXT, top, width);
    }
    top + LINE / 2
}

/// A text in lines below `top`; where they end.
fn draw_lines(drawn: &mut String, text: &str, size: f64, mut top: i32, width: i32) -> i32 {
    let attributes = if size > TEXT { format!(" font-size=\"{size}\"") } else { String::new() };
    for line in wrapped(text, size, f64::from(width)) {
        draw_text(drawn, [EDGE, top + FOOT], &attributes, &line);
        top += LINE;
    }
    top + LINE / 3
}

fn draw_text(drawn: &mut String, [x, y]: [i32; 2], attributes: &str, text: &str) {
    let _ = writeln!(drawn, "<text x=\"{x}\" y=\"{y}\"{attributes}>{}</text>", escape(text));
}

impl Diagram {
    fn draw(&self, drawn: &mut String, [x, y]: [i32; 2], [width, height]: [i32; 2]) {
        let all = || self.series.iter().flat_map(Series::drawn);
        let least = self.least.into_iter().flatten();
        let caption = if self.title.is_empty() { 0 } else { LINE + 2 };
        let [left, right] = [x + LEFT, x + width - RIGHT];
        let [top, bottom] = [y + caption, y + height - BELOW];
        let across = Axis::around(all().map(|it| it[0]), [left, right]);
        let up = Axis::around(all().map(|it| it[1]).chain(least), [bottom, top]);
        let (Some(across), Some(up)) = (across, up) else { return };
        let centre = [x + width / 2, i32::midpoint(left, right)];
        *drawn += "<g text-anchor=\"middle\">\n";
        if caption > 0 {
            draw_text(drawn, [centre[0], y + FOOT], "", &self.title);
        }
        draw_text(drawn, [centre[1], bottom + 44], "", &self.axes[0]);
        let [side, middle] = [x + 11, i32::midpoint(top, bottom)];
        let turned = format!(" transform=\"rotate(270 {side} {middle})\"");
        draw_text(drawn, [side, middle], &turned, &self.axes[1]);
        let [mut grid, mut ticks] = [String::new(), String::new()];
        for (at, label) in across.labels() {
            let _ = write!(grid, "M{at} {bottom}V{top}");
            let _ = write!(ticks, "M{at} {bottom}v{TICK}");
            draw_text(drawn, [at, bottom + TICK + FOOT + 3], "", &label);
        }
        *drawn += "</g>\n<g text-anchor=\"end\">\n";
        for (at, label) in up.labels() {
            let _ = write!(grid, "M{left} {at}H{right}");
            let _ = write!(ticks, "M{left} {at}h-{TICK}");
            draw_text(drawn, [left - 2 * TICK, at + HALF], "", &label);
        }
        let _ = writeln!(
            drawn,
            "</g>\n<path class=\"grid\" d=\"{grid}\"/>\n\
             <path class=\"axes\" d=\"M{left} {top}V{bottom}H{right}{ticks}\"/>"
        );
        for series in &self.series {
            let pixels = series.drawn().map(|[x, y]| [across.at(x), up.at(y)]);
            series.kind().path(drawn, &pixels.collect::<Vec<_>>());
        }
    }
}

/// A logarithmic axis.
struct Axis {
    /// Decimal logarithms.
    ends: [f64; 2],
    pixels: [i32; 2],
    /// Where lines are: at decades and, where these are few, at their second and fifth multiples.
    lines: Vec<f64>,
}

impl Axis {
    /// The axis on which all values have their place; `None` without values.
    fn around(values: impl Iterator<Item = f64> + Clone, pixels: [i32; 2]) -> Option<Self> {
        let [low, high] = [values.clone().reduce(f64::min)?, values.reduce(f64::max)?];
        let [low, high] = [low, high].map(f64::log10);
        let room = (0.03 * (high - low)).max(0.1);
        let ends = [low - room, high + room];
        let span = ends[1] - ends[0];
        let step = (span / MOST_LABELS).ceil();
        let multiples: &[f64] = if span < FEW { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let decades = (0..).map(|k| (ends[0] / step).floor() * step + step * f64::from(k));
        let decades = decades.take_while(|decade| *decade <= ends[1]);
        let lines = decades.flat_map(|decade| multiples.iter().map(move |it| decade + it.log10()));
        let lines = lines.filter(|it| (ends[0]..=ends[1]).contains(it));
        Some(Self { ends, pixels, lines: lines.map(|it| 10_f64.powf(it)).collect() })
    }

    fn at(&self, value: f64) -> i32 {
        let share = (value.log10() - self.ends[0]) / (self.ends[1] - self.ends[0]);
        let [from, to] = self.pixels;
        #[allow(clippy::cast_possible_truncation)]
        let pixels = (share * f64::from(to - from)).round() as i32;
        from + pixels
    }

    /// Labels of an axis are alike: with exponents, or none with.
    fn labels(&self) -> impl Iterator<Item = (i32, String)> {
        let exponents = self.lines.iter().any(|it| !PLAIN.contains(it));
        self.lines.iter().map(move |value| {
            let decimals = (-value.log10() - 1e-9).ceil().max(0.0);
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let decimals = decimals as usize;
            let label =
                if exponents { format!("{value:.0e}") } else { format!("{value:.decimals$}") };
            (self.at(*value), label)
        })
    }
}
