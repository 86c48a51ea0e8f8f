//! Principal stresses: a cross of two strokes in every element.

use nalgebra::Point2;

use super::canvas::{Canvas, Pixel, fixed};
use super::marks::{self, BRICK, COMPRESSION, TENSION};
use super::sheet::{Frame, Margins, SYMBOL, Sheet, Shown, draw_bar};
use super::style::DARK;
use crate::data::state::{ElementStress, State};
use crate::geometry;
use crate::model::Model;
use crate::report::format::{InUnits, round_down, stress_text};
use crate::report::summary::extreme_stresses;
use crate::scene::bond::{self, JointThickness, PlacedBrick};
use crate::scene::{Scene, Wall};

const REFERENCE: &str = "#009e73";

/// Two thin lines to compare the flow of stresses with, leaning towards each other.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceLines {
    /// Where the lines start \[m\]. The left one rises to the right and the right one to the left,
    /// until they meet or leave the structure.
    pub origins: [Point2<f64>; 2],
    /// Angle from the vertical \[rad\], in `[0, pi/2)`.
    pub angle: f64,
    /// What the legend calls them, such as `arctan(l / 2h) = 26.57°`.
    pub label: String,
}

impl ReferenceLines {
    /// The running-bond lines to compare the principal stresses with: from the inner ends of the
    /// lowest supports at both corners of the first wall, half a brick and half a head joint sideways
    /// for every course and its bed joint.
    /// `None` for a scene without such a wall, with a support all along its foot, or with an opening where a line would
    /// run.
    pub fn of(scene: &Scene) -> Option<Self> {
        let wall = scene.walls.first()?;
        let [_, foot] = wall.origin;
        let level = |y: f64| (y - foot).abs() <= 1e-9 * wall.brick.height;
        let mut feet: Vec<(f64, f64)> = scene
            .supports
            .iter()
            .filter(|support| level(support.from[1]) && level(support.to[1]))
            .map(|support| (support.from[0].min(support.to[0]), support.from[0].max(support.to[0])))
            .collect();
        feet.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ((_, left), (right, _)) = (*feet.first()?, *feet.last()?);
        if left >= right {
            return None;
        }
        let metres = scene.units.length_to_si();
        let origins = [left, right].map(|x| Point2::new(x, foot) * metres);
        let joints = JointThickness::of(scene, wall);
        let (length, height) = (wall.brick.length + joints.head, wall.brick.height + joints.bed);
        if !is_filled(wall, joints, [left, right]) {
            return None;
        }
        let dry = joints == JointThickness::default();
        let label = if dry { "arctan(l / 2h)" } else { "arctan((l + t) / 2(h + t))" };
        Some(Self { origins, angle: (length / (2.0 * height)).atan(), label: label.to_owned() })
    }
}

/// Whether there are bricks all along the lines that rise from these places at the foot of a wall until they meet, and
/// every whole one lies half over a joint of the course below: the lines are those of running bond.
fn is_filled(wall: &Wall, joints: JointThickness, [left, right]: [f64; 2]) -> bool {
    /// In lengths of a brick.
    const NEAR: f64 = 1e-6;
    let length = wall.brick.length + joints.head;
    let bricks = bond::bricks_in_mortar(wall, joints);
    let courses: Vec<&[PlacedBrick]> = bricks.chunk_by(|a, b| a.course == b.course).collect();
    let steps = |brick: &PlacedBrick, below: &[PlacedBrick]| {
        let middle = 0.5 * (brick.low[0] + brick.high[0]);
        let ends = below.iter().flat_map(|it| [it.low[0] - joints.head, it.high[0] + joints.head]);
        let mut distances = ends.map(|end| (end - middle).abs() - 0.5 * joints.head);
        (brick.fraction - 1.0).abs() > NEAR || distances.any(|it| it.abs() <= NEAR * length)
    };
    let lines = courses.iter().enumerate().map_while(|(k, course)| {
        // In the middle of the height.
        let along = (course[0].course as f64 - 0.5) * 0.5 * length;
        (2.0 * along < right - left).then_some((k.checked_sub(1), course, along))
    });
    lines.into_iter().all(|(below, course, along)| {
        let is_laid = |x: f64| {
            let reach =
                |brick: &PlacedBrick| brick.low[0] - joints.head..=brick.high[0] + joints.head;
            let mut met = course.iter().filter(|brick| reach(brick).contains(&x)).peekable();
            met.peek().is_some()
                && met.all(|brick| below.is_none_or(|below| steps(brick, courses[below])))
        };
        is_laid(left + along) && is_laid(right - along)
    })
}

/// Principal stresses of every element as crosses whose strokes are proportional to the stresses,
/// with the contact points that are open or slide.
///
/// Strokes along which the element is compressed and stretched differ in colour. The legend shows
/// the length of a round stress.
pub fn principal_stresses(
    title: &str,
    model: &Model,
    state: &State,
    reference: Option<&ReferenceLines>,
) -> String {
    compared(&Shown { title, model, state }, reference, large(&state.stresses))
}

/// The same with strokes as long as those of others: a large stress and the largest one of all.
pub(in crate::report) fn compared(
    shown: &Shown<'_>,
    reference: Option<&ReferenceLines>,
    large: [f64; 2],
) -> String {
    let Shown { title, model, state } = *shown;
    let title = format!("{title}: principal stresses");
    let mut sheet = Sheet::new(&title, model, marks::bounds(model), Margins::HATCH);
    marks::bricks(&mut sheet, &model.blocks, BRICK);
    draw_strokes(&mut sheet, model, state, large);
    marks::supports(&mut sheet, model);
    if let Some(lines) = reference {
        draw_reference(&mut sheet, model, lines);
    }
    marks::contact_marks(&mut sheet, model, &state.contacts);
    sheet.finish()
}

fn draw_strokes(sheet: &mut Sheet, model: &Model, state: &State, large: [f64; 2]) {
    let units = InUnits(model.units);
    let frame = sheet.frame;
    let element = element_size(model, state) * frame.scale;
    let width = (0.055 * element).clamp(0.3, 1.8);
    let pixels_per_pascal = stroke_scale(large, element);
    for (name, colour, compressed) in
        [("compression", COMPRESSION, true), ("tension", TENSION, false)]
    {
        let style = format!(
            "class=\"{name}\" stroke=\"{colour}\" stroke-width=\"{}\" stroke-linecap=\"butt\"",
            fixed(width)
        );
        sheet.canvas.group(&style, |canvas| {
            for stress in &state.stresses {
                let principal = stress.principal;
                let turned = principal.theta + std::f64::consts::FRAC_PI_2;
                for (value, angle) in
                    [(principal.sigma_1, principal.theta), (principal.sigma_2, turned)]
                {
                    if (value <= 0.0) == compressed {
                        let half = 0.5 * value.abs() * pixels_per_pascal;
                        draw_stroke(canvas, &frame, stress.centre, half, angle);
                    }
                }
            }
        });
    }
    let (compression, tension) = extreme_stresses(state);
    if compression.is_none() && tension.is_none() {
        sheet.note("no stress in any element");
        return;
    }
    let largest = [compression, tension].into_iter().flatten().map(|it| it.value.abs());
    let largest = largest.fold(0.0, f64::max).max(14.0 / pixels_per_pascal);
    let round = round_down(units.stress(largest.min(58.0 / pixels_per_pascal)));
    let round = round * units.0.stress_to_si();
    for (name, colour, extreme) in
        [("compression", COMPRESSION, compression), ("tension", TENSION, tension)]
    {
        let most = extreme
            .map_or("none".to_owned(), |it| format!("largest {}", stress_text(it.value.abs())));
        sheet.line_entry(&format!("{name}, {most}"), colour, &fixed(width.max(1.2)));
    }
    sheet.entry(&format!("stroke of {}", stress_text(round)), |symbol| {
        draw_bar(symbol, 0.5 * round * pixels_per_pascal, DARK, 1.4);
    });
}

fn draw_stroke(canvas: &mut Canvas, frame: &Frame, centre: Point2<f64>, half: f64, angle: f64) {
    let centre = frame.at(centre);
    let (dx, dy) = (half * angle.cos(), -half * angle.sin());
    let [from, to] = [-1.0, 1.0].map(|way| Pixel::new(centre.x + way * dx, centre.y + way * dy));
    canvas.stroke(from, to, "");
}

/// Pixels per pascal: large stresses fill an element, and the largest overlap the next one or two
/// where a few are far above the rest.
fn stroke_scale([large, largest]: [f64; 2], element: f64) -> f64 {
    if largest > 0.0 { (element / large).min(2.2 * element / largest) } else { 1.0 }
}

/// The size that a twentieth of all stresses exceed, and the largest \[Pa\]; zeros where there are none.
pub(in crate::report) fn large(stresses: &[ElementStress]) -> [f64; 2] {
    let mut sizes: Vec<f64> = stresses
        .iter()
        .map(|it| it.principal.sigma_1.abs().max(it.principal.sigma_2.abs()))
        .filter(|size| *size > 0.0 && size.is_finite())
        .collect();
    sizes.sort_by(f64::total_cmp);
    match (sizes.get(sizes.len() * 19 / 20), sizes.last()) {
        (Some(&large), Some(&largest)) => [large, largest],
        _ => [0.0; 2],
    }
}

/// Side of a square as large as a middling element \[m\].
fn element_size(model: &Model, state: &State) -> f64 {
    let mut areas: Vec<f64> = Vec::with_capacity(state.stresses.len());
    for stress in &state.stresses {
        if let Some(mesh) = &model.blocks[stress.block.index()].mesh {
            let corners = mesh.elements[stress.element].map(|node| mesh.nodes[node]);
            areas.push(geometry::area(&corners));
        }
    }
    areas.sort_by(f64::total_cmp);
    areas.get(areas.len() / 2).copied().unwrap_or(0.0).max(0.0).sqrt()
}

fn draw_reference(sheet: &mut Sheet, model: &Model, lines: &ReferenceLines) {
    let frame = sheet.frame;
    let style = format!(
        "class=\"reference\" stroke=\"{REFERENCE}\" stroke-width=\"1.2\" stroke-dasharray=\"7 4\""
    );
    let [mut left, mut right] = lines.origins;
    if left.x > right.x {
        (left, right) = (right, left);
    }
    let slope = lines.angle.tan().max(0.0);
    let top = marks::bounds(model).high.y;
    // Both rise to the same height: where they meet, or the top of the structure.
    let base = left.y.max(right.y);
    let meeting = if slope > 0.0 { base + 0.5 * (right.x - left.x) / slope } else { top };
    let end = meeting.min(top);
    sheet.canvas.group(&style, |canvas| {
        for (origin, lean) in [(left, slope), (right, -slope)] {
            let tip = Point2::new(origin.x + lean * (end - origin.y), end);
            canvas.line(frame.at(origin), frame.at(tip), "");
        }
    });
    sheet.entry(&lines.label, |symbol| {
        symbol.group(&style, |symbol| {
            symbol.line(Pixel::new(-SYMBOL, 0.0), Pixel::new(SYMBOL, 0.0), "");
        });
    });
}
