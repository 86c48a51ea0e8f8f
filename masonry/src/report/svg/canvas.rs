//! Text of SVG elements, with a fixed number of digits so that files are reproducible.

use std::fmt::{Display, Write as _};

/// A point of the sheet in its own units (pixels at the nominal width), y down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pixel {
    pub(super) x: f64,
    pub(super) y: f64,
}

impl Pixel {
    pub(super) fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The point at `distance` in the direction `(dx, dy)`, which need not be of unit length.
    pub(super) fn shifted(self, dx: f64, dy: f64, distance: f64) -> Self {
        let length = dx.hypot(dy);
        if length > 0.0 {
            Self::new(self.x + dx / length * distance, self.y + dy / length * distance)
        } else {
            self
        }
    }

    pub(super) fn distance(self, other: Self) -> f64 {
        (self.x - other.x).hypot(self.y - other.y)
    }

    pub(super) fn between(self, other: Self, at: f64) -> Self {
        Self::new(self.x + (other.x - self.x) * at, self.y + (other.y - self.y) * at)
    }
}

/// Where a text stands relative to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
}

impl Anchor {
    fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
        }
    }
}

/// A growing list of SVG elements.
#[derive(Debug, Clone, Default)]
pub(super) struct Canvas(String);

impl Canvas {
    /// A group whose attributes hold for everything that `draw` adds.
    pub(super) fn group(&mut self, attributes: &str, draw: impl FnOnce(&mut Self)) {
        self.push(format_args!("<g {attributes}>\n"));
        draw(self);
        self.push("</g>\n");
    }

    pub(super) fn line(&mut self, from: Pixel, to: Pixel, attributes: &str) {
        let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(fixed);
        let attributes = spaced(attributes);
        self.push(format_args!(
            "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"{attributes}/>\n"
        ));
    }

    /// A line in the shortest form, for the thousands of strokes of a stress picture.
    pub(super) fn stroke(&mut self, from: Pixel, to: Pixel, attributes: &str) {
        let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(fixed);
        let attributes = spaced(attributes);
        self.push(format_args!("<path d=\"M{x1} {y1}L{x2} {y2}\"{attributes}/>\n"));
    }

    /// A closed polygon.
    pub(super) fn polygon(&mut self, points: &[Pixel], attributes: &str) {
        let (points, attributes) = (joined(points), spaced(attributes));
        self.push(format_args!("<polygon points=\"{points}\"{attributes}/>\n"));
    }

    /// An open line through several points.
    pub(super) fn polyline(&mut self, points: &[Pixel], attributes: &str) {
        let (points, attributes) = (joined(points), spaced(attributes));
        self.push(format_args!("<polyline points=\"{points}\"{attributes}/>\n"));
    }

    pub(super) fn rectangle(&mut self, corner: Pixel, width: f64, height: f64, attributes: &str) {
        let [x, y, width, height] = [corner.x, corner.y, width, height].map(fixed);
        let attributes = spaced(attributes);
        self.push(format_args!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"{attributes}/>\n"
        ));
    }

    pub(super) fn circle(&mut self, centre: Pixel, radius: f64, attributes: &str) {
        let [x, y, radius] = [centre.x, centre.y, radius].map(fixed);
        let attributes = spaced(attributes);
        self.push(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{attributes}/>\n"));
    }

    /// A line with a filled head at `to`.
    pub(super) fn arrow(&mut self, from: Pixel, to: Pixel, colour: &str) {
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let head = (0.4 * from.distance(to)).min(7.0);
        let neck = to.shifted(-dx, -dy, head);
        self.line(from, neck, &format!("stroke=\"{colour}\" stroke-width=\"1.4\""));
        let sides = [neck.shifted(-dy, dx, 0.42 * head), neck.shifted(dy, -dx, 0.42 * head)];
        self.polygon(&[to, sides[0], sides[1]], &format!("fill=\"{colour}\""));
    }

    pub(super) fn text(&mut self, at: Pixel, anchor: Anchor, size: f64, text: &str) {
        self.text_with(at, anchor, size, "", text);
    }

    /// A text with a white rim, readable on top of other marks.
    pub(super) fn rimmed_text(&mut self, at: Pixel, anchor: Anchor, size: f64, text: &str) {
        let rim = "stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\"";
        self.text_with(at, anchor, size, rim, text);
        self.text(at, anchor, size, text);
    }

    pub(super) fn text_with(
        &mut self,
        at: Pixel,
        anchor: Anchor,
        size: f64,
        attributes: &str,
        text: &str,
    ) {
        let [x, y, size] = [at.x, at.y, size].map(fixed);
        let (anchor, attributes, text) = (anchor.name(), spaced(attributes), escape(text));
        self.push(format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{attributes}>\
             {text}</text>\n"
        ));
    }

    pub(super) fn append(&mut self, other: &Self) {
        self.0.push_str(&other.0);
    }

    pub(super) fn as_str(&self) -> &str {
        &self.0
    }

    fn push(&mut self, element: impl Display) {
        // Writing to a String never fails.
        let _ = write!(self.0, "{element}");
    }
}

/// Two decimals: a hundredth of a pixel.
pub(super) fn fixed(value: f64) -> String {
    let text = format!("{value:.2}");
    if text == "-0.00" { "0.00".to_owned() } else { text }
}

/// Text with the characters escaped that mean something in XML; control characters, which XML
/// forbids, become spaces.
pub(in crate::report) fn escape(text: &str) -> String {
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

/// Width of a text in a font of the given size, rather too large than too small.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let ems: f64 = text
        .chars()
        .map(|character| match character {
            'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | ' ' | '\u{a0}' => 0.34,
            'f' | 't' | 'r' | '(' | ')' | '/' | '-' | 'I' => 0.42,
            'm' | 'w' | 'M' | 'W' | '@' | '%' | '±' => 0.98,
            'A'..='Z' => 0.72,
            '\u{2e80}'.. => 1.05,
            _ => 0.63,
        })
        .sum();
    ems * size
}

/// Lines of a text, each at most `width` wide, broken at plain spaces where that is possible.
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

/// Bytes of the longest start of `text` that fits, at least one character.
fn fitting(text: &str, size: f64, width: f64) -> usize {
    let ends = text.char_indices().map(|(at, character)| at + character.len_utf8());
    let first = ends.clone().next().unwrap_or(0);
    ends.take_while(|end| text_width(&text[..*end], size) <= width).last().unwrap_or(first)
}

/// The attribute by which a page changes the scale of movements: where the points of an element were before.
pub(super) fn before(points: &[Pixel]) -> String {
    format!("data-before=\"{}\"", joined(points))
}

fn joined(points: &[Pixel]) -> String {
    let mut list = String::new();
    for (index, point) in points.iter().enumerate() {
        let gap = if index == 0 { "" } else { " " };
        let _ = write!(list, "{gap}{},{}", fixed(point.x), fixed(point.y));
    }
    list
}

fn spaced(attributes: &str) -> String {
    if attributes.is_empty() { String::new() } else { format!(" {attributes}") }
}
