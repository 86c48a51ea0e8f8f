//! Sweeps as small diagrams with logarithmic axes, two in a row.

use std::fmt::Write as _;

const PANEL: [f64; 2] = [560.0, 330.0];
/// Room of a panel left, right, above and below its frame.
const ROOM: [f64; 4] = [76.0, 16.0, 34.0, 46.0];
const HEAD: f64 = 92.0;
const EDGE: f64 = 16.0;
const COLUMNS: usize = 2;
/// Decades of the vertical axis: rounding and less at the bottom.
const ERRORS: [f64; 2] = [1e-17, 1.0];
/// Colours that differ also for those who see few of them (Okabe and Ito).
const COLOURS: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9", "#4d4d4d"];

/// One route in one diagram: at every value the error, the backward error, and whether it is an answer.
pub(crate) struct Line {
    pub(crate) name: String,
    /// Which colour and marker it has.
    pub(crate) style: usize,
    pub(crate) points: Vec<Mark>,
}

/// A point of a line.
#[derive(Clone, Copy)]
pub(crate) enum Mark {
    /// An answer: its error, and its backward error.
    Answer { x: f64, error: f64, backward: f64 },
    /// No answer, and the residual at the end.
    GaveUp { x: f64, residual: f64 },
}

/// One diagram.
pub(crate) struct Panel {
    pub(crate) title: String,
    pub(crate) x: String,
    /// The largest errors of what may be called solved, each with its value.
    pub(crate) promised: Vec<[f64; 2]>,
    pub(crate) lines: Vec<Line>,
}

/// The text of the file; every line has the same place in all panels.
pub(crate) fn picture(title: &str, panels: &[Panel]) -> String {
    let rows = panels.len().div_ceil(COLUMNS);
    let width = COLUMNS as f64 * PANEL[0] + 2.0 * EDGE;
    let height = rows as f64 * PANEL[1] + HEAD + EDGE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" \
         font-size=\"12\" fill=\"#222222\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
         <text x=\"{EDGE}\" y=\"30\" font-size=\"17\">{title}</text>\n"
    );
    if let Some(panel) = panels.first() {
        svg += &legend(panel);
    }
    for (k, panel) in panels.iter().enumerate() {
        let at = [k % COLUMNS, k / COLUMNS].map(|it| it as f64);
        let origin = [EDGE + at[0] * PANEL[0], HEAD + at[1] * PANEL[1]];
        svg += &panel.drawn(origin);
    }
    svg + "</svg>\n"
}

fn legend(panel: &Panel) -> String {
    let mut svg = String::new();
    let mut x = EDGE + 8.0;
    for line in &panel.lines {
        svg += &marker([x, 50.0], line.style, true);
        let _ = writeln!(svg, "<text x=\"{}\" y=\"54\">{}</text>", x + 10.0, line.name);
        x += 34.0 + 8.0 * line.name.len() as f64;
    }
    let alm = if panel.lines.iter().any(|line| line.name == "alm") {
        ", by alm a hundred times that"
    } else {
        ""
    };
    let words = format!(
        "full: called solved, at the worst of its checks; hollow: gave up, at the residual it reports; \
         dots: backward error; grey: promised{alm}; drawn at 1e-17: all below"
    );
    let _ = writeln!(svg, "<text x=\"{EDGE}\" y=\"76\">{words}</text>");
    svg
}

impl Panel {
    fn drawn(&self, [left, top]: [f64; 2]) -> String {
        let [x_0, x_1] = [left + ROOM[0], left + PANEL[0] - ROOM[1]];
        let [y_0, y_1] = [top + PANEL[1] - ROOM[3], top + ROOM[2]];
        let values = self.lines.iter().flat_map(|line| line.points.iter().map(|mark| mark.x()));
        let [least, most] = values
            .fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], x| [a.min(x), b.max(x)])
            .map(f64::log10);
        let span = (most - least).max(1e-3);
        let across = |x: f64| x_0 + (x_1 - x_0) * (x.log10() - least) / span;
        let [low, high] = ERRORS.map(f64::log10);
        let up = |error: f64| {
            let error = error.clamp(ERRORS[0], ERRORS[1]);
            y_0 + (y_1 - y_0) * (error.log10() - low) / (high - low)
        };
        let mut svg = format!(
            "<text x=\"{x_0}\" y=\"{}\" font-size=\"14\">{}</text>\n",
            y_1 - 10.0,
            self.title
        );
        for decade in decades([low, high], 2.0) {
            let y = up(10_f64.powf(decade));
            svg += &grid([[x_0, y], [x_1, y]]);
            let _ = writeln!(
                svg,
                "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">1e{decade}</text>",
                x_0 - 6.0,
                y + 4.0
            );
        }
        for value in ticks([least, most]) {
            let x = across(value);
            svg += &grid([[x, y_0], [x, y_1]]);
            let is_short = (1e-3..1e4).contains(&value);
            let label = if is_short { value.to_string() } else { format!("{value:.0e}") };
            let _ = writeln!(
                svg,
                "<text x=\"{x}\" y=\"{}\" text-anchor=\"middle\">{label}</text>",
                y_0 + 16.0
            );
        }
        let bound: Vec<[f64; 2]> =
            self.promised.iter().map(|[x, error]| [across(*x), up(*error)]).collect();
        svg += &polyline(&bound, "stroke=\"#999999\" stroke-width=\"2\"");
        let middle = 0.5 * (y_0 + y_1);
        let _ = writeln!(
            svg,
            "<text x=\"{0}\" y=\"{middle}\" text-anchor=\"middle\" transform=\"rotate(-90 {0} {middle})\">error [-]</text>\n\
             <rect x=\"{x_0}\" y=\"{y_1}\" width=\"{1}\" height=\"{2}\" fill=\"none\" stroke=\"#222222\"/>\n\
             <text x=\"{3}\" y=\"{4}\" text-anchor=\"middle\">{5}</text>",
            left + 14.0,
            x_1 - x_0,
            y_0 - y_1,
            0.5 * (x_0 + x_1),
            y_0 + 34.0,
            self.x
        );
        for line in &self.lines {
            let colour = COLOURS[line.style % COLOURS.len()];
            // Errors of answers and residuals of none are different numbers.
            let is_same = |a: &Mark, b: &Mark| a.backward().is_some() == b.backward().is_some();
            for run in line.points.chunk_by(is_same) {
                let path: Vec<[f64; 2]> =
                    run.iter().map(|mark| [across(mark.x()), up(mark.error())]).collect();
                let style =
                    format!("stroke=\"{colour}\" stroke-width=\"1.2\" stroke-opacity=\"0.6\"");
                svg += &polyline(&path, &style);
            }
            for mark in &line.points {
                let x = across(mark.x());
                svg += &marker([x, up(mark.error())], line.style, mark.backward().is_some());
                if let Some(backward) = mark.backward() {
                    let _ = writeln!(
                        svg,
                        "<circle cx=\"{x:.1}\" cy=\"{:.1}\" r=\"2.2\" fill=\"{colour}\"/>",
                        up(backward)
                    );
                }
            }
        }
        svg
    }
}

impl Mark {
    fn x(self) -> f64 {
        match self {
            Self::Answer { x, .. } | Self::GaveUp { x, .. } => x,
        }
    }

    fn error(self) -> f64 {
        match self {
            Self::Answer { error, .. } => error,
            Self::GaveUp { residual, .. } => residual,
        }
    }

    fn backward(self) -> Option<f64> {
        match self {
            Self::Answer { backward, .. } => Some(backward),
            Self::GaveUp { .. } => None,
        }
    }
}

/// Values of the lines of a grid: decades, and where these are few their second and fifth multiples, too.
fn ticks([low, high]: [f64; 2]) -> Vec<f64> {
    let span = high - low;
    let multiples: &[f64] = if span < 3.0 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let around = [low.floor(), high];
    let all = decades(around, (span / 7.0).ceil())
        .flat_map(|decade| multiples.iter().map(move |times| times * 10_f64.powf(decade)));
    let inside = [low - 1e-9, high + 1e-9].map(|it| 10_f64.powf(it));
    all.filter(|it| (inside[0]..=inside[1]).contains(it)).collect()
}

/// Whole decades between two ends, every `step`.
fn decades([low, high]: [f64; 2], step: f64) -> impl Iterator<Item = f64> {
    let step = step.max(1.0);
    let first = ((low - 1e-9) / step).ceil() * step;
    (0..100).map(move |k| first + step * f64::from(k)).take_while(move |it| *it <= high + 1e-9)
}

fn grid([[x_1, y_1], [x_2, y_2]]: [[f64; 2]; 2]) -> String {
    format!(
        "<line x1=\"{x_1:.1}\" y1=\"{y_1:.1}\" x2=\"{x_2:.1}\" y2=\"{y_2:.1}\" stroke=\"#e4e4e4\"/>\n"
    )
}

fn polyline(path: &[[f64; 2]], style: &str) -> String {
    let places: Vec<String> = path.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
    format!("<polyline points=\"{}\" fill=\"none\" {style}/>\n", places.join(" "))
}

/// The marker of a line: full, or hollow.
fn marker([x, y]: [f64; 2], line: usize, is_full: bool) -> String {
    let colour = COLOURS[line % COLOURS.len()];
    let fill = if is_full { colour } else { "#ffffff" };
    let style = format!("fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.2\"");
    let polygon = |corners: &[[f64; 2]]| {
        let places: Vec<String> =
            corners.iter().map(|[dx, dy]| format!("{:.1},{:.1}", x + dx, y + dy)).collect();
        format!("<polygon points=\"{}\" {style}/>\n", places.join(" "))
    };
    match line % COLOURS.len() {
        0 => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" {style}/>\n"),
        1 => polygon(&[[-3.6, -3.6], [3.6, -3.6], [3.6, 3.6], [-3.6, 3.6]]),
        2 => polygon(&[[0.0, -4.6], [4.4, 3.4], [-4.4, 3.4]]),
        3 => polygon(&[[0.0, -5.0], [5.0, 0.0], [0.0, 5.0], [-5.0, 0.0]]),
        4 => polygon(&[[0.0, 4.6], [4.4, -3.4], [-4.4, -3.4]]),
        5 => polygon(&[[-4.6, 0.0], [0.0, -2.4], [4.6, 0.0], [0.0, 2.4]]),
        _ => polygon(&[[-2.4, 0.0], [0.0, -4.6], [2.4, 0.0], [0.0, 4.6]]),
    }
}
