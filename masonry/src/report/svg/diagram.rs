//! Diagrams, one or many in a picture: of ratios with logarithmic axes, of curves with linear ones.
//!
//! Lines and markers have classes, and coordinates are whole pixels: pages with hundreds of curves stay small.

mod axis;

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::canvas::{escape, text_width, wrapped};
use super::style::{COLOURS, FONT, TEXT, TITLE};
use axis::{Axis, Scale};

/// Height of a line of text, and from its top to the foot of its letters.
const LINE: i32 = 19;
const FOOT: i32 = 13;
/// From the middle of a line of text to the foot of its letters.
const HALF: i32 = 5;
const EDGE: i32 = 16;
/// A diagram alone, and one of several, which stand in two columns.
const SIZES: [[i32; 2]; 2] = [[868, 430], [560, 340]];
/// A chart, of which every one has a row of its own.
const CHART: [i32; 2] = [868, 300];
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
/// Lines through more points have no markers on linear axes.
const MARKED: usize = 60;

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
    /// Those that have no place on the axes are left out.
    pub points: Vec<[f64; 2]>,
}

impl Series {
    fn kind(&self) -> Kind {
        let styles = if self.look == Look::Bound { 2 } else { COLOURS.len() };
        Kind { look: self.look, style: self.style % styles }
    }

    fn drawn(&self, scale: Scale) -> impl Iterator<Item = [f64; 2]> + Clone {
        let has_place = move |it: &f64| it.is_finite() && (scale == Scale::Linear || *it > 0.0);
        self.points.iter().filter(move |it| it.iter().all(has_place)).copied()
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

    fn rule(self, scale: Scale) -> String {
        let (name, colour) = (self.name(), COLOURS[self.style]);
        match self.look {
            Look::Full | Look::Hollow if scale == Scale::Linear => {
                format!(".{name}{{stroke:{colour};stroke-width:2}}\n")
            }
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

    /// The inside of markers, if there are any.
    fn fill(self) -> Option<&'static str> {
        match self.look {
            Look::Full => Some(COLOURS[self.style]),
            Look::Hollow => Some("#fff"),
            Look::Dots | Look::Bound => None,
        }
    }

    /// The outline of a marker.
    fn outline(self, [x, y]: [i32; 2]) -> String {
        let corners = MARKERS[self.style].iter().map(|it| format!("{} {}", x + it[0], y + it[1]));
        format!("M{}z", corners.collect::<Vec<_>>().join(" "))
    }

    /// What stands at every point of a line.
    fn marker(self) -> Option<String> {
        let (name, colour, fill) = (self.name(), COLOURS[self.style], self.fill()?);
        Some(format!(
            "<marker id=\"{name}\" markerUnits=\"userSpaceOnUse\" overflow=\"visible\">\
             <path d=\"{}\" style=\"fill:{fill};stroke:{colour};stroke-width:1\"/></marker>\n",
            self.outline([0, 0])
        ))
    }

    /// Markers one by one: pages refer to nothing by an address, and so have no markers of their own.
    fn draw_markers(self, text: &mut String, pixels: &[[i32; 2]]) {
        let Some(fill) = self.fill() else { return };
        let (colour, outlines) = (COLOURS[self.style], pixels.iter().map(|it| self.outline(*it)));
        let data: String = outlines.collect();
        let _ = writeln!(text, "<path style=\"fill:{fill};stroke:{colour}\" d=\"{data}\"/>");
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

/// A diagram of curves with linear axes.
#[derive(Debug, Clone)]
pub(in crate::report) struct Chart {
    pub(in crate::report) diagram: Diagram,
    /// Where a stage begins, and its name.
    pub(in crate::report) stages: Vec<(f64, String)>,
    /// Where a page marks the step that it shows: a place for every step; none in a file.
    pub(in crate::report) steps: Vec<f64>,
}

impl Chart {
    /// A chart of full lines in colours of their own; bounds keep their style.
    pub(in crate::report) fn of(axes: [String; 2], mut series: Vec<Series>) -> Self {
        let full = series.iter_mut().filter(|it| it.look == Look::Full);
        full.enumerate().for_each(|(style, it)| it.style = style);
        let diagram = Diagram { title: String::new(), axes, least: None, series };
        Self { diagram, stages: Vec::new(), steps: Vec::new() }
    }
}

/// The text of an SVG file; `None` where no series has a point. The legend above all is that of the first diagram.
pub fn picture(title: &str, diagrams: &[Diagram], notes: &[String]) -> Option<String> {
    let all = || diagrams.iter().flat_map(|it| &it.series);
    all().find_map(|it| it.drawn(Scale::Logarithmic).next())?;
    let columns = diagrams.len().min(SIZES.len());
    let size = SIZES[columns - 1];
    let [width, height] =
        [columns, diagrams.len().div_ceil(columns)].map(|it| i32::try_from(it).unwrap_or(1));
    let mut drawn = String::new();
    let mut top = draw_lines(&mut drawn, title, TITLE, EDGE, width * size[0]);
    top = draw_legend(
        &mut drawn,
        &diagrams[0].series,
        Scale::Logarithmic,
        [EDGE, top],
        width * size[0],
    );
    for note in notes {
        top = draw_lines(&mut drawn, note, TEXT, top, width * size[0]);
    }
    top += LINE / 2;
    let places = (0..height).flat_map(|row| (0..width).map(move |column| [column, row]));
    for (diagram, [column, row]) in diagrams.iter().zip(places) {
        let corner = [EDGE + column * size[0], top + row * size[1]];
        Panel::of(diagram, Scale::Logarithmic, corner, size).draw(&mut drawn);
    }
    Some(file(title, all(), Scale::Logarithmic, [width * size[0], top + height * size[1]], &drawn))
}

/// The same of charts, one below the other, each with its legend; `None` where no series has two points.
pub(in crate::report) fn charts(title: &str, charts: &[Chart]) -> Option<String> {
    let has_curve = |it: &&Chart| it.diagram.series.iter().any(|it| it.points.len() > 1);
    let charts: Vec<&Chart> = charts.iter().filter(has_curve).collect();
    let all = charts.iter().flat_map(|it| &it.diagram.series);
    all.clone().next()?;
    let [width, height] = CHART;
    let mut drawn = String::new();
    let mut top = draw_lines(&mut drawn, title, TITLE, EDGE, width);
    for chart in &charts {
        top = draw_legend(
            &mut drawn,
            &chart.diagram.series,
            Scale::Linear,
            [EDGE + LEFT, top],
            width - LEFT,
        );
        let panel = Panel::of(&chart.diagram, Scale::Linear, [EDGE, top], CHART);
        panel.draw(&mut drawn);
        panel.draw_steps(&mut drawn, chart);
        top += height;
    }
    Some(file(title, all, Scale::Linear, [width, top], &drawn))
}

fn file<'a>(
    title: &str,
    all: impl Iterator<Item = &'a Series>,
    scale: Scale,
    [width, bottom]: [i32; 2],
    drawn: &str,
) -> String {
    let kinds: BTreeSet<Kind> = all.map(Series::kind).collect();
    let rules: String = kinds.iter().map(|kind| kind.rule(scale)).collect();
    let kinds = kinds.iter().filter(|_| scale == Scale::Logarithmic);
    let markers: String = kinds.filter_map(|kind| kind.marker()).collect();
    let [width, height] = [width + 2 * EDGE, bottom + EDGE];
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"{FONT}\" font-size=\"{TEXT}\">\n\
         <title>{}</title>\n<style>\npath{{fill:none}}\n.grid{{stroke:#ddd}}\n.axes{{stroke:#000}}\n{rules}</style>\n{markers}\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{drawn}</svg>\n",
        escape(title)
    )
}

/// Lines with their names, in as many rows as they take; where they end.
fn draw_legend(
    drawn: &mut String,
    series: &[Series],
    scale: Scale,
    [left, mut top]: [i32; 2],
    width: i32,
) -> i32 {
    let (mut x, gap) = (0, 40);
    for series in series.iter().filter(|it| !it.name.is_empty()) {
        #[allow(clippy::cast_possible_truncation)]
        let wide = text_width(&series.name, TEXT) as i32 + gap;
        if x > 0 && x + wide > width {
            (x, top) = (0, top + LINE);
        }
        let [left, middle] = [left + x, top + LINE / 2];
        // The marker stands in the middle of the line, which has none at its ends.
        let (kind, name) = (series.kind(), series.kind().name());
        let _ = writeln!(
            drawn,
            "<path class=\"{name}\" style=\"marker:none\" d=\"M{left} {middle}h22\"/>"
        );
        match scale {
            Scale::Linear => kind.draw_markers(drawn, &[[left + 11, middle]]),
            Scale::Logarithmic => kind.path(drawn, &[[left + 11, middle]]),
        }
        draw_text(drawn, [left + 28, middle + HALF], "", &series.name);
        x += wide;
    }
    top + LINE + LINE / 3
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

/// A diagram and its place.
struct Panel<'a> {
    diagram: &'a Diagram,
    scale: Scale,
    corner: [i32; 2],
    width: i32,
    /// Left, top, right and bottom of what the axes enclose.
    inner: [i32; 4],
    /// Across and up, if there is anything.
    axes: Option<[Axis; 2]>,
}

impl<'a> Panel<'a> {
    fn of(diagram: &'a Diagram, scale: Scale, corner: [i32; 2], [width, height]: [i32; 2]) -> Self {
        let all = || diagram.series.iter().flat_map(|it| it.drawn(scale));
        let least = diagram.least.into_iter().flatten();
        let caption = if diagram.title.is_empty() { 0 } else { LINE + 2 };
        let [x, y] = corner;
        let inner = [x + LEFT, y + caption, x + width - RIGHT, y + height - BELOW];
        let [left, top, right, bottom] = inner;
        let across = Axis::around(scale, all().map(|it| it[0]), [left, right]);
        let up = Axis::around(scale, all().map(|it| it[1]).chain(least), [bottom, top]);
        let axes = across.zip(up).map(|(across, up)| [across, up]);
        Self { diagram, scale, corner, width, inner, axes }
    }

    fn draw(&self, drawn: &mut String) {
        let Some([across, up]) = &self.axes else { return };
        let ([x, y], [left, top, right, bottom]) = (self.corner, self.inner);
        let (title, names) = (&self.diagram.title, &self.diagram.axes);
        *drawn += "<g text-anchor=\"middle\">\n";
        if !title.is_empty() {
            draw_text(drawn, [x + self.width / 2, y + FOOT], "", title);
        }
        draw_text(drawn, [i32::midpoint(left, right), bottom + 44], "", &names[0]);
        let [side, middle] = [x + 11, i32::midpoint(top, bottom)];
        let turned = format!(" transform=\"rotate(270 {side} {middle})\"");
        draw_text(drawn, [side, middle], &turned, &names[1]);
        let [mut grid, mut ticks] = [String::new(), String::new()];
        for (at, label) in across.labels() {
            let _ = write!(grid, "M{at} {bottom}V{top}");
            let _ = write!(ticks, "M{at} {bottom}v{TICK}");
            draw_text(drawn, [at, bottom + TICK + FOOT + 3], "", label);
        }
        *drawn += "</g>\n<g text-anchor=\"end\">\n";
        for (at, label) in up.labels() {
            let _ = write!(grid, "M{left} {at}H{right}");
            let _ = write!(ticks, "M{left} {at}h-{TICK}");
            draw_text(drawn, [left - 2 * TICK, at + HALF], "", label);
        }
        let _ = writeln!(
            drawn,
            "</g>\n<path class=\"grid\" d=\"{grid}\"/>\n\
             <path class=\"axes\" d=\"M{left} {top}V{bottom}H{right}{ticks}\"/>"
        );
        for series in &self.diagram.series {
            let pixels = series.drawn(self.scale).map(|[x, y]| [across.at(x), up.at(y)]);
            let pixels: Vec<_> = pixels.collect();
            series.kind().path(drawn, &pixels);
            if self.scale == Scale::Linear && pixels.len() <= MARKED {
                series.kind().draw_markers(drawn, &pixels);
            }
        }
    }

    /// Where stages begin, with their names where there is room, and where a page marks its step.
    fn draw_steps(&self, drawn: &mut String, chart: &Chart) {
        let Some([across, _]) = &self.axes else { return };
        let [_, top, right, bottom] = self.inner;
        // Two rows, which are free from here on.
        let mut free = [i32::MIN; 2];
        for (value, name) in &chart.stages {
            let at = across.at(*value);
            let _ = writeln!(
                drawn,
                "<path stroke=\"#8a8a8a\" stroke-dasharray=\"3 3\" d=\"M{at} {bottom}V{top}\"/>"
            );
            #[allow(clippy::cast_possible_truncation)]
            let end = at + TICK + text_width(name, TEXT) as i32;
            let rows = free.iter_mut().zip([top + LINE, top + 2 * LINE]);
            if let Some((free, y)) = rows.into_iter().find(|it| at >= *it.0 && end < right) {
                let rim = " stroke=\"#fff\" stroke-width=\"3\" stroke-linejoin=\"round\"";
                draw_text(drawn, [at + TICK, y], rim, name);
                draw_text(drawn, [at + TICK, y], "", name);
                *free = end + TICK;
            }
        }
        if let Some(last) = chart.steps.last() {
            let places = chart.steps.iter().map(|it| across.at(*it).to_string());
            let _ = writeln!(
                drawn,
                "<line class=\"step\" stroke=\"#c4161c\" stroke-width=\"1.4\" data-steps=\"{}\" x1=\"{x}\" \
                 x2=\"{x}\" y1=\"{bottom}\" y2=\"{top}\"/>",
                places.collect::<Vec<_>>().join(" "),
                x = across.at(*last)
            );
        }
    }
}
