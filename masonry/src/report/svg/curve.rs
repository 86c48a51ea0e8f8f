//! Curves in charts with linear axes, one chart below the other.

use super::canvas::{Anchor, Canvas, Pixel, fixed, text_width};
use super::style::{self, COLOURS, DARK, EDGE, TEXT, TEXT_LINE, WIDTH};
use crate::report::format::round_down;

/// Room left of, right of and below the part of a chart where curves are, and its height.
const LEFT: f64 = 92.0;
const RIGHT: f64 = 230.0;
const BELOW: f64 = 46.0;
const HEIGHT: f64 = 210.0;
/// Lines on an axis are at most so many.
const TICKS: f64 = 7.0;
const GRID: &str = "#e2e2e2";
const DASHES: [&str; 3] = ["", "7 3", "2 3"];

/// A curve through points.
#[derive(Debug, Clone)]
pub(in crate::report) struct Curve {
    pub(in crate::report) name: String,
    pub(in crate::report) points: Vec<[f64; 2]>,
}

/// Two axes and the curves between them.
#[derive(Debug, Clone)]
pub(in crate::report) struct Chart {
    /// What is drawn across and up, with units.
    pub(in crate::report) axes: [String; 2],
    pub(in crate::report) curves: Vec<Curve>,
    /// Where a stage begins, and its name.
    pub(in crate::report) stages: Vec<(f64, String)>,
    /// Where a page marks the step that it shows: a place for every step; none in a file.
    pub(in crate::report) steps: Vec<f64>,
}

/// Values along an axis, and where they are in pixels.
struct Axis {
    low: f64,
    high: f64,
    pixels: [f64; 2],
    /// Whether all values are whole numbers.
    is_count: bool,
}

impl Axis {
    fn around(values: impl Iterator<Item = f64> + Clone, pixels: [f64; 2]) -> Self {
        let is_count = values.clone().all(|value| value.fract() == 0.0);
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        // Zero belongs to an axis that would begin or end near it.
        let (low, high) = match (low, high) {
            _ if !(low.is_finite() && high.is_finite()) => (0.0, 1.0),
            _ if low > 0.0 && low < 0.7 * high => (0.0, high),
            _ if high < 0.0 && high > 0.7 * low => (low, 0.0),
            _ => (low, high),
        };
        let span = high - low;
        let room = if span > 0.0 { 0.04 * span } else { 0.5 * high.abs().max(1.0) };
        let below = if low == 0.0 && span > 0.0 { 0.0 } else { room };
        let above = if high == 0.0 && span > 0.0 { 0.0 } else { room };
        Self { low: low - below, high: high + above, pixels, is_count }
    }

    fn at(&self, value: f64) -> f64 {
        let [from, to] = self.pixels;
        from + (to - from) * (value - self.low) / (self.high - self.low)
    }

    /// Round values with their texts; of what is counted, whole ones.
    fn ticks(&self) -> Vec<(f64, String)> {
        let least = (self.high - self.low) / TICKS;
        let least = if self.is_count { least.max(1.0) } else { least };
        let mut step = round_down(least);
        // The next of 1, 2, 5 that is not smaller.
        for larger in [2.0, 2.5, 5.0, 10.0] {
            if step >= least {
                break;
            }
            step = round_down(round_down(least) * larger * (1.0 + 1e-9));
        }
        let decimals = (-step.log10() - 1e-9).ceil().max(0.0);
        let first = (self.low / step - 1e-9).ceil();
        let values = (0..).map(|k| (first + f64::from(k)) * step);
        values
            .take_while(|value| *value <= self.high + 1e-9 * step)
            .map(|value| (value, text(value, decimals)))
            .collect()
    }
}

fn text(value: f64, decimals: f64) -> String {
    if decimals > 5.0 {
        return if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") };
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let text = format!("{value:.*}", decimals as usize);
    let is_zero = text.bytes().all(|byte| matches!(byte, b'-' | b'.' | b'0'));
    if is_zero { "0".to_owned() } else { text }
}

/// The text of an SVG file; `None` where no curve has two points.
pub(in crate::report) fn charts(title: &str, charts: &[Chart]) -> Option<String> {
    let has_curve = |chart: &&Chart| chart.curves.iter().any(|it| it.points.len() > 1);
    let charts: Vec<&Chart> = charts.iter().filter(has_curve).collect();
    if charts.is_empty() {
        return None;
    }
    let mut canvas = Canvas::default();
    let mut y = style::draw_title(&mut canvas, &style::title_lines(title));
    for chart in charts {
        y = draw(&mut canvas, chart, y + 14.0);
    }
    Some(style::file(title, y + EDGE, "", canvas.as_str()))
}

/// Draws a chart below `top`; its bottom.
fn draw(canvas: &mut Canvas, chart: &Chart, top: f64) -> f64 {
    let (left, right) = (EDGE + LEFT, WIDTH - EDGE - RIGHT);
    let (top, bottom) = (top + TEXT_LINE, top + TEXT_LINE + HEIGHT);
    let points = || chart.curves.iter().flat_map(|it| &it.points);
    let x = Axis::around(points().map(|it| it[0]), [left, right]);
    let y = Axis::around(points().map(|it| it[1]), [bottom, top]);
    canvas.text(Pixel::new(EDGE, top - 7.0), Anchor::Start, TEXT, &chart.axes[1]);
    let grid = format!("stroke=\"{GRID}\"");
    for (value, text) in y.ticks() {
        let at = y.at(value);
        canvas.line(Pixel::new(left, at), Pixel::new(right, at), &grid);
        canvas.text(Pixel::new(left - 6.0, at + 4.5), Anchor::End, TEXT, &text);
    }
    for (value, text) in x.ticks() {
        let at = x.at(value);
        canvas.line(Pixel::new(at, top), Pixel::new(at, bottom), &grid);
        canvas.text(Pixel::new(at, bottom + TEXT_LINE), Anchor::Middle, TEXT, &text);
    }
    draw_stages(canvas, chart, &x, [top, bottom]);
    let frame = format!("fill=\"none\" stroke=\"{DARK}\"");
    canvas.rectangle(Pixel::new(left, top), right - left, bottom - top, &frame);
    let middle = Pixel::new(0.5 * (left + right), bottom + TEXT_LINE + 18.0);
    canvas.text(middle, Anchor::Middle, TEXT, &chart.axes[0]);
    for (index, curve) in chart.curves.iter().enumerate() {
        let (colour, dash) = (COLOURS[index % COLOURS.len()], DASHES[index % DASHES.len()]);
        let style = format!(
            "class=\"curve\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\" \
             stroke-linejoin=\"round\" stroke-dasharray=\"{dash}\""
        );
        let pixels = |it: &[f64; 2]| Pixel::new(x.at(it[0]), y.at(it[1]));
        let pixels: Vec<Pixel> = curve.points.iter().map(pixels).collect();
        canvas.polyline(&pixels, &style);
        if pixels.len() <= 60 {
            let style = format!("fill=\"{colour}\"");
            for at in pixels {
                canvas.circle(at, 2.4, &style);
            }
        }
        let row = top + 12.0 + TEXT_LINE * 1.15 * index as f64;
        let (from, to) = (Pixel::new(right + 14.0, row), Pixel::new(right + 40.0, row));
        canvas.polyline(&[from, to], &style);
        let room = RIGHT - 52.0;
        let mut name = curve.name.clone();
        while text_width(&name, TEXT) > room && name.pop().is_some() {}
        canvas.text(Pixel::new(right + 46.0, row + 4.5), Anchor::Start, TEXT, &name);
    }
    if let Some(last) = chart.steps.last() {
        let places: Vec<String> = chart.steps.iter().map(|it| fixed(x.at(*it))).collect();
        let attributes = format!(
            "class=\"step\" stroke=\"#c4161c\" stroke-width=\"1.4\" data-steps=\"{}\"",
            places.join(" ")
        );
        let at = x.at(*last);
        canvas.line(Pixel::new(at, top), Pixel::new(at, bottom), &attributes);
    }
    bottom + BELOW
}

/// Where stages begin, with their names where there is room.
fn draw_stages(canvas: &mut Canvas, chart: &Chart, x: &Axis, [top, bottom]: [f64; 2]) {
    let style = "stroke=\"#8a8a8a\" stroke-dasharray=\"3 3\"";
    // Two rows, which are free from here on.
    let mut free = [f64::NEG_INFINITY; 2];
    for (value, name) in &chart.stages {
        let at = x.at(*value);
        canvas.line(Pixel::new(at, top), Pixel::new(at, bottom), style);
        let end = at + 4.0 + text_width(name, TEXT);
        let rows = free.iter_mut().zip([top + 14.0, top + 14.0 + TEXT_LINE]);
        let place = rows.into_iter().find(|(free, _)| at >= **free && end < x.pixels[1]);
        if let Some((free, y)) = place {
            canvas.rimmed_text(Pixel::new(at + 4.0, y), Anchor::Start, TEXT, name);
            *free = end + 6.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_few_and_within_the_axis() {
        for (low, high) in
            [(0.0, 11.0), (-3.2e-3, 1.7e-3), (0.0, 0.9), (1.0, 4.0), (120.0, 180.5), (0.0, 7e5)]
        {
            let axis = Axis::around([low, high].into_iter(), [0.0, 100.0]);
            let ticks = axis.ticks();
            assert!((3..=8).contains(&ticks.len()), "{low} {high}: {ticks:?}");
            for (value, _) in &ticks {
                assert!((-1e-6..=100.000_001).contains(&axis.at(*value)), "{low} {high}: {value}");
            }
            let mut texts: Vec<&str> = ticks.iter().map(|(_, text)| text.as_str()).collect();
            texts.dedup();
            assert_eq!(texts.len(), ticks.len(), "{ticks:?}");
        }
    }

    #[test]
    fn a_constant_has_an_axis_and_no_points_give_no_picture() {
        let axis = Axis::around([5.0].into_iter(), [0.0, 100.0]);
        assert!(axis.low < 5.0 && axis.high > 5.0);
        let chart = Chart {
            axes: ["x", "y"].map(str::to_owned),
            curves: vec![Curve { name: "one".to_owned(), points: vec![[0.0, 1.0]] }],
            stages: Vec::new(),
            steps: Vec::new(),
        };
        assert!(charts("none", &[chart]).is_none());
    }
}
