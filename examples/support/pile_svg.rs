//! Pictures of discs in a box and of the forces between them.

/// Pixels of a metre.
const SCALE: f64 = 300.0;
const MARGIN: f64 = 40.0;
const LEGEND: f64 = 60.0;
/// Width of the line of the largest force at the last instant \[px\].
const WIDEST: f64 = 16.0;

/// An instant.
pub(crate) struct Frame {
    /// \[s\].
    pub(crate) time: f64,
    pub(crate) circles: Vec<Circle>,
    pub(crate) forces: Vec<Force>,
}

pub(crate) struct Circle {
    pub(crate) center: [f64; 2],
    pub(crate) radius: f64,
    pub(crate) angle: f64,
}

/// A contact force, drawn from the center of a disc to that of the other one, or to the wall.
pub(crate) struct Force {
    pub(crate) from: [f64; 2],
    pub(crate) to: [f64; 2],
    /// Where the bodies touch.
    pub(crate) point: [f64; 2],
    /// \[N\].
    pub(crate) normal: f64,
    pub(crate) is_slipping: bool,
}

/// The frames side by side, in boxes of this width, with one legend.
pub(crate) fn picture(frames: &[Frame], box_width: f64) -> String {
    let top = |circle: &Circle| circle.center[1] + circle.radius;
    let tops = frames.iter().flat_map(|frame| frame.circles.iter().map(top));
    let box_height = tops.fold(0.0, f64::max) + 0.05;
    let panel = box_width * SCALE + MARGIN;
    let (width, height) = (panel * frames.len() as f64 + MARGIN, box_height * SCALE + MARGIN);
    let total = height + LEGEND;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {total:.0}\" \
         width=\"{width:.0}\" height=\"{total:.0}\" font-family=\"sans-serif\" font-size=\"14\">\n\
         <style>.disc {{fill: #ecdfc8; stroke: #8a6d3b; stroke-width: 1.2}} \
         .mark {{stroke: #8a6d3b}} .wall {{stroke: #777}} .scale {{stroke: black}} \
         .stick {{stroke: #1f5fa8; fill: #1f5fa8}} .slip {{stroke: #d9480f; fill: #d9480f}} \
         .force {{stroke-opacity: 0.8}} .point {{stroke: none}}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let forces = frames.last().map_or(&[][..], |frame| &frame.forces);
    let largest = forces.iter().map(|force| force.normal).fold(0.0, f64::max);
    let per_newton = if largest > 0.0 { WIDEST / largest } else { 0.0 };
    for (k, frame) in frames.iter().enumerate() {
        let left = MARGIN + panel * k as f64;
        draw_frame(&mut svg, frame, [left, height], [box_width, box_height], per_newton);
    }
    draw_legend(&mut svg, [MARGIN, height + 35.0], largest, per_newton);
    svg + "</svg>\n"
}

/// `origin` is the lower left corner of the box \[px\].
fn draw_frame(svg: &mut String, frame: &Frame, origin: [f64; 2], size: [f64; 2], per_newton: f64) {
    const WALL: f64 = 8.0;
    let px = |point: [f64; 2]| [origin[0] + SCALE * point[0], origin[1] - SCALE * point[1]];
    for circle in &frame.circles {
        let ([x, y], r) = (px(circle.center), SCALE * circle.radius);
        disc(svg, "disc", [x, y], r);
        let end = [x + r * circle.angle.cos(), y - r * circle.angle.sin()];
        line(svg, "mark", 1.2, [x, y], end);
    }
    for force in &frame.forces {
        // Impacts would cover the picture.
        let width = (per_newton * force.normal).min(1.5 * WIDEST);
        let class = if force.is_slipping { "slip" } else { "stick" };
        line(svg, &format!("force {class}"), width, px(force.from), px(force.to));
        disc(svg, &format!("point {class}"), px(force.point), 3.0);
    }
    let ([left, top], [right, bottom]) = (px([0.0, size[1]]), px([size[0], 0.0]));
    let half = 0.5 * WALL;
    for x in [left - half, right + half] {
        line(svg, "wall", WALL, [x, top], [x, bottom + WALL]);
    }
    line(svg, "wall", WALL, [left, bottom + half], [right, bottom + half]);
    text(svg, [left + 10.0, top + 20.0], &format!("{:.2} s", frame.time));
}

fn draw_legend(svg: &mut String, [x, y]: [f64; 2], largest: f64, per_newton: f64) {
    // The largest of 1, 2 and 5 times a power of ten that is not above the largest force.
    let decade = 10.0_f64.powf(largest.max(f64::MIN_POSITIVE).log10().floor());
    let example = [5.0, 2.0].map(|digit| digit * decade).into_iter().find(|v| *v <= largest);
    let force = example.unwrap_or(decade);
    let mut at = x;
    for (class, label) in [("stick", "sticking"), ("slip", "slipping")] {
        line(svg, &format!("force {class}"), per_newton * force, [at, y], [at + 40.0, y]);
        text(svg, [at + 50.0, y + 5.0], &format!("{force} N, {label}"));
        at += 180.0;
    }
    let end = at + 0.2 * SCALE;
    line(svg, "scale", 1.0, [at, y], [end, y]);
    for x in [at, end] {
        line(svg, "scale", 1.0, [x, y - 5.0], [x, y + 5.0]);
    }
    text(svg, [end + 10.0, y + 5.0], "0.2 m");
}

fn disc(svg: &mut String, class: &str, [x, y]: [f64; 2], r: f64) {
    let element = format!("<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\"/>\n");
    svg.push_str(&element);
}

fn line(svg: &mut String, class: &str, width: f64, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
    let ends = format!("x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"");
    let element = format!("<line class=\"{class}\" stroke-width=\"{width:.2}\" {ends}/>\n");
    svg.push_str(&element);
}

fn text(svg: &mut String, [x, y]: [f64; 2], content: &str) {
    let element = format!("<text x=\"{x:.1}\" y=\"{y:.1}\">{content}</text>\n");
    svg.push_str(&element);
}
