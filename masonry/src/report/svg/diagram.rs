//! Diagrams with logarithmic axes, one or many in a picture, drawn by `plotters`.

use std::io;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::canvas::{text_width, wrapped};

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), DrawingAreaErrorKind<io::Error>>;

const FONT: &str = "DejaVu Sans, Helvetica, Arial, sans-serif";
/// Sizes of letters, which `plotters` divides by [`SCALE`] where it writes them down.
const TITLE: i32 = 21;
const TEXT: i32 = 16;
const SCALE: f64 = 1.24;
/// Height of a line of text.
const LINE: i32 = 19;
const EDGE: i32 = 16;
/// A diagram alone, and one of several, which stand in two columns.
const SIZES: [[i32; 2]; 2] = [[868, 430], [560, 340]];
const GRID: RGBColor = RGBColor(0xdd, 0xdd, 0xdd);
const GREY: RGBColor = RGBColor(0xaa, 0xaa, 0xaa);
/// Colours that differ also for those who see few of them (Okabe and Ito), each with its own marker.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0xb8, 0x86, 0x0b),
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0x4d, 0x4d, 0x4d),
];
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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// A line with markers.
    Full,
    /// A line with the outlines of markers.
    Hollow,
    /// Dots alone.
    Dots,
    /// A grey line alone, with which others are compared.
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
    fn colour(&self) -> RGBColor {
        if self.look == Look::Bound { GREY } else { COLOURS[self.style % COLOURS.len()] }
    }

    fn drawn(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        let is_drawn = |point: &&[f64; 2]| point.iter().all(|it| it.is_finite() && *it > 0.0);
        self.points.iter().filter(is_drawn).map(|[x, y]| (*x, *y))
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
    diagrams.iter().flat_map(|it| &it.series).find_map(|it| it.drawn().next())?;
    let columns = diagrams.len().min(SIZES.len());
    let rows = diagrams.len().div_ceil(columns);
    let [width, height] = [columns, rows].map(|it| i32::try_from(it).unwrap_or(1));
    let [width, height] = [width * SIZES[columns - 1][0], height * SIZES[columns - 1][1]];
    let head = Head::of(title, &diagrams[0].series, notes, width);
    let size = [width + 2 * EDGE, head.height + height + EDGE].map(i32::unsigned_abs);
    let mut text = String::new();
    let area = SVGBackend::with_string(&mut text, size.into()).into_drawing_area();
    let draw = || -> Drawn {
        area.fill(&WHITE)?;
        head.draw(&area)?;
        let below = area.margin(head.height, EDGE, EDGE, EDGE);
        for (diagram, part) in diagrams.iter().zip(below.split_evenly((rows, columns))) {
            diagram.draw(&area, &part)?;
        }
        area.present()
    };
    draw().ok()?;
    drop(area);
    Some(text)
}

/// Title, legend and notes.
struct Head<'a> {
    texts: Vec<(i32, i32, String)>,
    names: Vec<([i32; 2], &'a Series)>,
    height: i32,
}

impl<'a> Head<'a> {
    /// In as many lines as they take.
    fn of(title: &str, series: &'a [Series], notes: &[String], width: i32) -> Self {
        let mut head = Self { texts: Vec::new(), names: Vec::new(), height: EDGE };
        head.add(title, TITLE, width);
        let (mut x, gap) = (0, 40);
        for series in series.iter().filter(|it| !it.name.is_empty()) {
            #[allow(clippy::cast_possible_truncation)]
            let wide = text_width(&series.name, f64::from(TEXT) / SCALE) as i32 + gap;
            if x > 0 && x + wide > width {
                (x, head.height) = (0, head.height + LINE);
            }
            head.names.push(([EDGE + x, head.height], series));
            x += wide;
        }
        head.height += LINE + LINE / 3;
        for note in notes {
            head.add(note, TEXT, width);
        }
        head.height += LINE / 2;
        head
    }

    fn add(&mut self, text: &str, size: i32, width: i32) {
        for line in wrapped(text, f64::from(size) / SCALE, f64::from(width)) {
            self.texts.push((self.height, size, line));
            self.height += LINE;
        }
        self.height += LINE / 3;
    }

    fn draw(&self, area: &Area) -> Drawn {
        for (y, size, text) in &self.texts {
            area.draw(&Text::new(text.as_str(), (EDGE, *y), font(*size)))?;
        }
        let left = Pos::new(HPos::Left, VPos::Center);
        for ([x, y], series) in &self.names {
            let middle = y + LINE / 2;
            join(area, &[(*x, middle), (x + 22, middle)], &[(x + 11, middle)], series)?;
            area.draw(&Text::new(series.name.as_str(), (x + 28, middle), font(TEXT).pos(left)))?;
        }
        Ok(())
    }
}

impl Diagram {
    fn draw(&self, whole: &Area, part: &Area) -> Drawn {
        let all = || self.series.iter().flat_map(Series::drawn);
        let least = self.least.into_iter().flatten();
        let [x, y] =
            [Axis::around(all().map(|it| it.0)), Axis::around(all().map(|it| it.1).chain(least))];
        let (Some(x), Some(y)) = (x, y) else { return Ok(()) };
        let mut builder = ChartBuilder::on(part);
        builder.x_label_area_size(46).y_label_area_size(76).margin_right(14).margin_bottom(4);
        if !self.title.is_empty() {
            builder.caption(&self.title, font(TEXT));
        }
        let mut chart = builder.build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .bold_line_style(GRID)
            .light_line_style(TRANSPARENT)
            .label_style(font(TEXT))
            .x_desc(&self.axes[0])
            .y_desc(&self.axes[1])
            .draw()?;
        for series in &self.series {
            let pixels: Vec<_> = series.drawn().map(|it| chart.backend_coord(&it)).collect();
            join(whole, &pixels, &pixels, series)?;
        }
        Ok(())
    }
}

fn font(size: i32) -> TextStyle<'static> {
    (FONT, size).into_text_style(&(1, 1))
}

/// What joins points, with what stands at them.
fn join(area: &Area, pixels: &[(i32, i32)], marked: &[(i32, i32)], it: &Series) -> Drawn {
    let colour = it.colour();
    if it.look != Look::Dots {
        area.draw(&PathElement::new(pixels, colour.stroke_width(2)))?;
    }
    for (x, y) in marked {
        let corners = MARKERS[it.style % MARKERS.len()].iter().map(|[dx, dy]| (x + dx, y + dy));
        let corners: Vec<_> = corners.collect();
        let outline = PathElement::new([&corners[..], &corners[..1]].concat(), colour);
        match it.look {
            Look::Full => area.draw(&Polygon::new(corners, colour))?,
            Look::Hollow => area.draw(&Polygon::new(corners, WHITE))?,
            Look::Dots => area.draw(&Circle::new((*x, *y), 2, colour.filled()))?,
            Look::Bound => {}
        }
        if matches!(it.look, Look::Full | Look::Hollow) {
            area.draw(&outline)?;
        }
    }
    Ok(())
}

/// A logarithmic axis. That of `plotters` has no lines below the distance of neighbouring numbers at one.
struct Axis {
    /// Decimal logarithms.
    ends: [f64; 2],
    /// Where lines are: at decades and, where these are few, at their second and fifth multiples.
    lines: Vec<f64>,
}

impl Axis {
    /// The axis on which all values have their place; `None` without values.
    fn around(values: impl Iterator<Item = f64> + Clone) -> Option<Self> {
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
        Some(Self { ends, lines: lines.map(|it| 10_f64.powf(it)).collect() })
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let share = (value.log10() - self.ends[0]) / (self.ends[1] - self.ends[0]);
        #[allow(clippy::cast_possible_truncation)]
        let pixels = (share * f64::from(limit.1 - limit.0)).round() as i32;
        limit.0 + pixels
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.lines.clone() }
    }

    fn range(&self) -> Range<f64> {
        10_f64.powf(self.ends[0])..10_f64.powf(self.ends[1])
    }
}

impl ValueFormatter<f64> for Axis {
    /// Labels of an axis are alike: with exponents, or none with.
    fn format_ext(&self, value: &f64) -> String {
        if self.lines.iter().any(|it| !PLAIN.contains(it)) {
            return format!("{value:.0e}");
        }
        let decimals = (-value.log10() - 1e-9).ceil().max(0.0);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let decimals = decimals as usize;
        format!("{value:.decimals$}")
    }
}
