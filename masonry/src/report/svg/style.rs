//! What all pictures share: sizes, colours and letters, the title, and the file around them.

use super::canvas::{Anchor, Canvas, Pixel, escape, fixed, wrapped};

/// Width of a picture, and what stays free at its edges.
pub(super) const WIDTH: f64 = 900.0;
pub(super) const EDGE: f64 = 18.0;
/// Heights of letters and of lines of them.
pub(super) const TITLE: f64 = 17.0;
pub(super) const TITLE_LINE: f64 = 22.0;
pub(super) const TEXT: f64 = 13.0;
pub(super) const TEXT_LINE: f64 = 17.0;
pub(super) const FONT: &str = "DejaVu Sans, Helvetica, Arial, sans-serif";
/// Outline of a brick.
pub(super) const OUTLINE: &str = "#857868";
pub(super) const DARK: &str = "#222222";
/// Colours of curves, which differ also for those who see few of them (Okabe and Ito).
pub(super) const COLOURS: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9", "#4d4d4d"];

/// The lines of a title.
pub(super) fn title_lines(title: &str) -> Vec<String> {
    wrapped(title, TITLE, WIDTH - 2.0 * EDGE)
}

/// Draws a title at the top; where it ends.
pub(super) fn draw_title(canvas: &mut Canvas, lines: &[String]) -> f64 {
    lines.iter().fold(EDGE, |top, line| {
        let bottom = top + TITLE_LINE;
        canvas.text(Pixel::new(EDGE, bottom - 6.0), Anchor::Start, TITLE, line);
        bottom
    })
}

/// The text of a file with this title, height, attributes for a page, and elements.
pub(super) fn file(title: &str, height: f64, data: &str, elements: &str) -> String {
    let (width, height) = (fixed(WIDTH), fixed(height));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\"{data} font-family=\"{FONT}\" fill=\"{DARK}\">\n\
         <title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{elements}</svg>\n",
        escape(title),
    )
}
