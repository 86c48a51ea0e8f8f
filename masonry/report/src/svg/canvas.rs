//! Text of SVG elements, with at most two decimals: files stay small, and equal input gives equal bytes.

use std::f64::consts::PI;
use std::fmt::{Display, Write as _};

use nalgebra::Vector2;

use crate::format::trim_zeros;

/// A point of the sheet in the units of the sheet (pixels at the nominal width), y down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pixel {
    pub(super) x: f64,
    pub(super) y: f64,
}

impl Pixel {
    pub(super) const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// Returns the vector from this point to another point, y up.
    pub(super) fn towards(self, other: Self) -> Vector2<f64> {
        Vector2::new(other.x - self.x, self.y - other.y)
    }

    /// Returns the point at `distance` from this point in a direction (y up), whose length does not matter; the same
    /// point for a zero direction.
    pub(super) fn along(self, direction: Vector2<f64>, distance: f64) -> Self {
        let way = direction.try_normalize(0.0).unwrap_or_default() * distance;
        Self::new(self.x + way.x, self.y - way.y)
    }

    pub(super) fn distance(self, other: Self) -> f64 {
        self.towards(other).norm()
    }

    pub(super) fn between(self, other: Self, at: f64) -> Self {
        Self::new(self.x + (other.x - self.x) * at, self.y + (other.y - self.y) * at)
    }
}

/// The part of a text (start, middle or end) that lies at the point of the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A growing list of SVG elements.
#[derive(Debug, Clone, Default)]
pub(super) struct Canvas(String);

impl Canvas {
    /// Adds a group whose attributes hold for all elements that `draw` adds.
    pub(super) fn group(&mut self, attributes: &str, draw: impl FnOnce(&mut Self)) {
        self.push(format_args!("<g {attributes}>\n"));
        draw(self);
        self.push("</g>\n");
    }

    /// Adds lines and areas with the path data of [`open`], [`closed`] or [`arrow`], one after the other.
    pub(super) fn path(&mut self, data: &str, attributes: &str) {
        self.push(format_args!("<path d=\"{data}\"{}/>\n", spaced(attributes)));
    }

    pub(super) fn circle(&mut self, centre: Pixel, radius: f64, attributes: &str) {
        let [x, y, radius] = [centre.x, centre.y, radius].map(fixed);
        let attributes = spaced(attributes);
        self.push(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{attributes}/>\n"));
    }

    pub(super) fn text(
        &mut self,
        at: Pixel,
        anchor: Anchor,
        size: f64,
        attributes: &str,
        text: &str,
    ) {
        let [x, y, size] = [at.x, at.y, size].map(fixed);
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (attributes, text) = (spaced(attributes), escape(text));
        self.push(format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{attributes}>{text}</text>\n"
        ));
    }

    pub(super) fn append(&mut self, other: &Self) {
        self.0.push_str(&other.0);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn as_str(&self) -> &str {
        &self.0
    }

    fn push(&mut self, element: impl Display) {
        // Writing to a `String` never fails.
        let _ = write!(self.0, "{element}");
    }
}

/// Returns SVG path data of a circle.
pub(super) fn dot(Pixel { x, y }: Pixel, radius: f64) -> String {
    let [left, y, radius, across] = [x - radius, y, radius, 2.0 * radius].map(fixed);
    format!("M{left} {y}a{radius} {radius} 0 1 0 {across} 0a{radius} {radius} 0 1 0 -{across} 0")
}

/// Returns SVG path data of a line through points.
pub(super) fn open(points: impl IntoIterator<Item = Pixel>) -> String {
    let mut data = String::new();
    for (k, Pixel { x, y }) in points.into_iter().enumerate() {
        let _ = write!(data, "{}{} {}", if k == 0 { 'M' } else { 'L' }, fixed(x), fixed(y));
    }
    data
}

/// Returns SVG path data of a polygon.
pub(super) fn closed(points: impl IntoIterator<Item = Pixel>) -> String {
    open(points) + "Z"
}

/// Returns SVG path data of an arrow: a line with a filled head.
pub(super) fn arrow([tail, tip]: [Pixel; 2]) -> String {
    let along = tail.towards(tip);
    let aside = Vector2::new(-along.y, along.x);
    let head = (0.4 * along.norm()).min(7.0);
    let neck = tip.along(-along, head);
    let [left, right] = [aside, -aside].map(|side| neck.along(side, 0.42 * head));
    open([tail, neck]) + &closed([left, tip, right])
}

/// Returns SVG path data of an arrow along three quarters of a circle, counter-clockwise if `sign` is positive.
pub(super) fn turning(centre: Pixel, radius: f64, sign: f64) -> String {
    // Chords of 30 degrees; the last one has the head.
    let place = |k: u32| {
        let angle = (f64::from(k) - 4.5) * PI / 6.0;
        centre.along(Vector2::new(angle.sin() * -sign, angle.cos()), radius)
    };
    // Each chord is a separate line, since paths are filled.
    let chords: String = (0..8).map(|k| open([place(k), place(k + 1)])).collect();
    chords + &arrow([place(8), place(9)])
}

/// Returns the smallest number of equal parts of a line whose length is at most `most`.
pub(super) fn parts([from, to]: [Pixel; 2], most: f64) -> u32 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let count = (from.distance(to) / most).ceil() as u32;
    count
}

/// Writes a number with at most two decimals.
pub(super) fn fixed(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = trim_zeros(&text);
    if text == "-0" { "0" } else { text }.to_owned()
}

/// Escapes the characters of a text that have a meaning in XML; control characters, which XML forbids, become spaces.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

/// Estimates the width of a text in a font of the given size, rather too large than too small.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let ems = |character: char| match character {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | ' ' | '\u{a0}' => 0.34,
        'f' | 't' | 'r' | '(' | ')' | '/' | '-' | 'I' => 0.42,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '±' => 0.98,
        'A'..='Z' => 0.72,
        '\u{2e80}'.. => 1.05,
        _ => 0.63,
    };
    text.chars().map(ems).sum::<f64>() * size
}

/// Breaks a text into lines, each at most `width` wide, at plain spaces if that is possible.
pub(super) fn wrapped(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split([' ', '\n', '\t']).filter(|word| !word.is_empty()) {
        let mut rest = word;
        while text_width(rest, size) > width {
            let (start, end) = rest.split_at(fitting(rest, size, width));
            lines.push(start.to_owned());
            rest = end;
        }
        if let Some(line) = lines.last_mut()
            && text_width(line, size) + text_width(" ", size) + text_width(rest, size) <= width
        {
            line.push(' ');
            line.push_str(rest);
        } else if !rest.is_empty() {
            lines.push(rest.to_owned());
        }
    }
    lines
}

/// Returns the number of bytes of the longest beginning of `text` that fits into `width`; at least one character.
fn fitting(text: &str, size: f64, width: f64) -> usize {
    let ends = text.char_indices().map(|(at, character)| at + character.len_utf8());
    let first = ends.clone().next().unwrap_or(0);
    ends.take_while(|end| text_width(&text[..*end], size) <= width).last().unwrap_or(first)
}

fn spaced(attributes: &str) -> String {
    if attributes.is_empty() { String::new() } else { format!(" {attributes}") }
}
