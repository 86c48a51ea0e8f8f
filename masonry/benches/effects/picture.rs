//! Bars: by how much an effect multiplies time and memory.

use std::io;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// An effect, and by how much it multiplies time and memory.
pub(crate) type Bars = (&'static str, [f64; 2]);

type Drawn = Result<(), DrawingAreaErrorKind<io::Error>>;

const FONT: (&str, i32) = ("DejaVu Sans, Helvetica, Arial, sans-serif", 16);
const WIDTH: u32 = 900;
const ROW: usize = 36;
/// Room for the title of a route, and for the labels below its bars.
const ROOM: usize = 92;
const RATIOS: Range<f64> = 0.5..100.0;
/// Colours that differ also for those who see few of them (Okabe and Ito).
const KINDS: [(&str, RGBColor); 2] = [
    ("time of a solve", RGBColor(0x00, 0x72, 0xb2)),
    ("memory at the peak", RGBColor(0xd5, 0x5e, 0x00)),
];

/// Writes one block of bars for every route, all from 1, on a logarithmic axis.
pub(crate) fn write(path: &std::path::Path, routes: &[(String, Vec<Bars>)]) -> Drawn {
    let heights = routes.iter().map(|(_, bars)| ROW * bars.len() + ROOM);
    let heights: Vec<u32> = heights.map(|it| u32::try_from(it).unwrap_or(u32::MAX)).collect();
    let mut rest = SVGBackend::new(path, (WIDTH, heights.iter().sum())).into_drawing_area();
    rest.fill(&WHITE)?;
    for ((route, bars), height) in routes.iter().zip(heights) {
        let (block, below) = rest.split_vertically(height);
        draw(&block, route, bars)?;
        rest = below;
    }
    rest.present()
}

fn draw(area: &DrawingArea<SVGBackend, Shift>, route: &str, bars: &[Bars]) -> Drawn {
    let at = |side| FONT.into_text_style(&(1, 1)).pos(Pos::new(side, VPos::Center));
    let mut chart = ChartBuilder::on(area)
        .caption(format!("What effects cost, {route}"), FONT)
        .x_label_area_size(48)
        .margin_left(260)
        .margin_right(20)
        .build_cartesian_2d(RATIOS.log_scale(), bars.len() as f64..0.0)?;
    let mut mesh = chart.configure_mesh();
    mesh.disable_y_mesh().disable_y_axis().label_style(FONT).light_line_style(TRANSPARENT);
    mesh.x_desc("with the effect / without it [-]").draw()?;
    let rows = || (0..).map(f64::from).zip(bars);
    chart.draw_series(rows().map(|(row, (effect, _))| {
        let name = Text::new(*effect, (-8, 0), at(HPos::Right));
        EmptyElement::at((RATIOS.start, row + 0.5)) + name
    }))?;
    for ((name, colour), k) in KINDS.into_iter().zip([0, 1]) {
        let middle = |row: f64| row + if k == 0 { 0.33 } else { 0.67 };
        let bar = |(row, (_, ratios)): (f64, &Bars)| {
            let corners = [(1.0, middle(row) - 0.16), (ratios[k], middle(row) + 0.16)];
            Rectangle::new(corners, colour.filled())
        };
        let label = |(row, (_, ratios)): (f64, &Bars)| {
            let text = Text::new(format!("{:.2}", ratios[k]), (5, 0), at(HPos::Left));
            EmptyElement::at((ratios[k].max(1.0), middle(row))) + text
        };
        chart.draw_series(rows().map(label))?;
        let key = move |(x, y)| Rectangle::new([(x, y - 5), (x + 14, y + 5)], colour.filled());
        chart.draw_series(rows().map(bar))?.label(name).legend(key);
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerRight)
        .label_font(FONT)
        .draw()
}
