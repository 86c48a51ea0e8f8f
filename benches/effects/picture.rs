//! Bars: by how much an effect multiplies time and memory.

use std::fmt::Write as _;

/// What an effect costs on one route.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bar {
    pub(crate) effect: &'static str,
    pub(crate) time: f64,
    pub(crate) memory: f64,
}

const WIDTH: f64 = 900.0;
const LEFT: f64 = 270.0;
const RIGHT: f64 = 870.0;
const LINE: f64 = 13.0;
const ROW: f64 = 2.0 * LINE + 10.0;
const HEAD: f64 = 34.0;
const TICKS: [f64; 7] = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 40.0];
const LOW: f64 = 0.5;
const HIGH: f64 = 40.0;
const FOOT: f64 = 52.0;
/// Time and memory (Okabe and Ito).
const COLOURS: [&str; 2] = ["#0072b2", "#d55e00"];

/// The text of an SVG file: one block of bars for every route, all from 1, on a logarithmic axis.
pub(crate) fn bars(routes: &[(String, Vec<Bar>)]) -> String {
    let heights = routes.iter().map(|(_, bars)| HEAD + ROW * bars.len() as f64 + FOOT);
    let height = 66.0 + heights.sum::<f64>();
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" \
         viewBox=\"0 0 {WIDTH} {height}\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" \
         font-size=\"13\" fill=\"#222222\">\n<title>What effects cost</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    text(&mut svg, [18.0, 28.0], "start", "What effects cost");
    for (k, name) in ["time of a solve", "memory at the peak"].into_iter().enumerate() {
        let x = LEFT + 170.0 * k as f64;
        rectangle(&mut svg, [x, 40.0], [14.0, LINE - 2.0], COLOURS[k]);
        text(&mut svg, [x + 22.0, 50.0], "start", name);
    }
    let mut top = 66.0;
    for (route, bars) in routes {
        top = block(&mut svg, route, bars, top);
    }
    svg + "</svg>\n"
}

/// Draws the bars of one route; gives where they end.
fn block(svg: &mut String, route: &str, bars: &[Bar], top: f64) -> f64 {
    let bottom = top + HEAD + ROW * bars.len() as f64;
    text(svg, [18.0, top + 22.0], "start", route);
    for tick in TICKS {
        let x = place(tick);
        let colour = if tick.total_cmp(&1.0).is_eq() { "#222222" } else { "#dddddd" };
        let (from, to) = (top + HEAD - 6.0, bottom);
        let _ = writeln!(
            svg,
            "<line x1=\"{x:.1}\" y1=\"{from:.1}\" x2=\"{x:.1}\" y2=\"{to:.1}\" stroke=\"{colour}\"/>"
        );
        text(svg, [x, bottom + 16.0], "middle", &tick.to_string());
    }
    for (k, bar) in bars.iter().enumerate() {
        let y = top + HEAD + ROW * k as f64;
        text(svg, [LEFT - 10.0, y + LINE + 4.0], "end", bar.effect);
        for (j, ratio) in [bar.time, bar.memory].into_iter().enumerate() {
            let (from, to) = (place(ratio.min(1.0)), place(ratio.max(1.0)));
            let at = [from, y + LINE * j as f64];
            rectangle(svg, at, [(to - from).max(1.5), LINE - 2.0], COLOURS[j]);
            let label = [to + 5.0, at[1] + LINE - 2.5];
            text(svg, label, "start", &format!("{ratio:.2}"));
        }
    }
    let middle = 0.5 * (place(LOW) + place(HIGH));
    text(svg, [middle, bottom + 34.0], "middle", "with the effect / without it [-]");
    bottom + FOOT
}

fn place(ratio: f64) -> f64 {
    let share = (ratio.clamp(LOW, HIGH) / LOW).ln() / (HIGH / LOW).ln();
    LEFT + (RIGHT - 40.0 - LEFT) * share
}

fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, words: &str) {
    let _ =
        writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>");
}

fn rectangle(svg: &mut String, [x, y]: [f64; 2], [width, height]: [f64; 2], colour: &str) {
    let _ = writeln!(
        svg,
        "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"{colour}\"/>"
    );
}
