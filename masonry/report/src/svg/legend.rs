//! Legends: symbols and texts in columns; and the SVG file around a picture, with its title.

use super::canvas::{Anchor, Canvas, Pixel, closed, escape, fixed, open, wrapped};
use super::style::{EDGE, LARGEST_BRICK, STYLE, TEXT, TEXT_LINE, TITLE, TITLE_LINE};

const FONT: &str = "DejaVu Sans, Helvetica, Arial, sans-serif";
const GAP: f64 = 9.0;
const SYMBOL: f64 = 64.0;
pub(super) const ENTRY_WIDTH: f64 = 280.0;

/// A symbol, drawn about the origin, and the text beside it.
#[derive(Debug)]
struct Entry {
    symbol: Canvas,
    lines: Vec<String>,
}

/// The entries of a legend, in their order.
#[derive(Debug, Default)]
pub(super) struct Legend(Vec<Entry>);

impl Legend {
    /// Adds a text and its symbol, which `draw` draws about the origin, within 60 by 16 pixels.
    pub(super) fn add(&mut self, text: &str, class: &str, draw: impl FnOnce(&mut Canvas)) {
        let mut symbol = Canvas::default();
        symbol.group(&format!("class=\"{class}\" font-size=\"{LARGEST_BRICK}\""), draw);
        self.0.push(Entry { symbol, lines: lines(text) });
    }

    /// Adds a text without a symbol.
    pub(super) fn note(&mut self, text: &str) {
        self.0.push(Entry { symbol: Canvas::default(), lines: lines(text) });
    }

    /// Draws the entries in rows of `columns` entries, beginning at a corner, and returns the lower end of the last
    /// row.
    pub(super) fn draw(&self, canvas: &mut Canvas, corner: Pixel, columns: usize) -> f64 {
        let mut top = corner.y;
        for row in self.0.chunks(columns) {
            let mut left = corner.x;
            for entry in row {
                let middle = [left + 0.5 * SYMBOL, top + 0.5 * TEXT_LINE].map(fixed);
                if !entry.symbol.is_empty() {
                    let place = format!("transform=\"translate({})\"", middle.join(" "));
                    canvas.group(&place, |canvas| canvas.append(&entry.symbol));
                }
                let mut base = top + 0.5 * TEXT_LINE + 0.36 * TEXT;
                for line in &entry.lines {
                    let at = Pixel::new(left + SYMBOL + 8.0, base);
                    canvas.text(at, Anchor::Start, TEXT, "", line);
                    base += TEXT_LINE;
                }
                left += ENTRY_WIDTH + 10.0;
            }
            let lines = row.iter().map(|it| it.lines.len()).max().unwrap_or(0);
            top += lines.max(1) as f64 * TEXT_LINE + GAP;
        }
        top
    }
}

fn lines(text: &str) -> Vec<String> {
    wrapped(text, TEXT, ENTRY_WIDTH - SYMBOL - 12.0)
}

/// Draws a line as a symbol.
pub(super) fn line(symbol: &mut Canvas) {
    symbol.path(&open([-22.0, 22.0].map(|x| Pixel::new(x, 0.0))), "");
}

/// Draws a block as a symbol.
pub(super) fn block(symbol: &mut Canvas) {
    let corners = [[-16.0, -6.0], [16.0, -6.0], [16.0, 6.0], [-16.0, 6.0]];
    symbol.path(&closed(corners.map(|[x, y]| Pixel::new(x, y))), "");
}

/// Returns a function that draws a bar of half length `half`, with marks at its ends, as a symbol.
pub(super) fn bar(half: f64) -> impl FnOnce(&mut Canvas) {
    move |symbol| {
        let end = |x: f64| open([-4.0, 4.0].map(|y| Pixel::new(x, y)));
        let line = open([-half, half].map(|x| Pixel::new(x, 0.0)));
        symbol.path(&[line, end(-half), end(half)].concat(), "");
    }
}

/// Draws a title at the top of a picture of this width, and returns the lower end of the title.
pub(super) fn title(canvas: &mut Canvas, text: &str, width: f64) -> f64 {
    let mut top = EDGE;
    canvas.group("class=\"title\"", |canvas| {
        for line in wrapped(text, TITLE, width - 2.0 * EDGE) {
            top += TITLE_LINE;
            canvas.text(Pixel::new(EDGE, top - 6.0), Anchor::Start, TITLE, "", &line);
        }
    });
    top
}

/// Returns the text of an SVG file of this size; `data` are attributes that a page uses.
pub(super) fn file(
    title: &str,
    [width, height]: [f64; 2],
    data: &str,
    elements: &Canvas,
) -> String {
    let [width, height] = [width, height].map(fixed);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\"{data} font-family=\"{FONT}\" fill=\"#222\" color=\"#222\">\n\
         <title>{}</title>\n{STYLE}\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}</svg>\n",
        escape(title),
        elements.as_str()
    )
}
