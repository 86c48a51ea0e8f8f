//! Open joints in colours that go with their width, and joints that have slid.

use nalgebra::Vector2;

use super::canvas::{Canvas, Pixel, fixed};
use super::marks::{self, BRICK};
use super::names;
use super::sheet::{Frame, Margins, Sheet};
use crate::data::state::ContactState;
use crate::ids::JointId;
use crate::model::{Joint, Model};
use crate::report::format::{round_down, significant};
use crate::report::joints::{self, Opening};

/// From the narrowest to the widest: readable in grey, and by the colour-blind.
const WIDTHS: [&str; 5] = ["#fdd49e", "#fdab5f", "#ef6548", "#c41e1e", "#67000d"];
/// The lower ends of the classes in parts of a round width below the largest; all below the first are hairlines.
const CLASSES: [f64; 5] = [0.05, 0.1, 0.2, 0.5, 1.0];
const HAIRLINE: &str = "#b9b3aa";
const SLIDING: &str = "#7b3294";
/// Pieces into which a joint is divided where its width changes.
const PIECES: usize = 6;

/// A part of a joint whose widths are of one class.
#[derive(Clone)]
struct Piece {
    joint: JointId,
    ends: [Pixel; 2],
}

/// The structure with its open joints, wider ones darker; the legend is in millimetres. Joints that are closed and have
/// slid have a line of their own colour. `None` where no joint has opened or slid.
pub fn cracks(title: &str, model: &Model, contacts: &[ContactState]) -> Option<String> {
    let openings = joints::openings(model, contacts);
    (!openings.is_empty()).then(|| coloured(title, model, contacts, widest(model, contacts)))
}

/// The width \[m\] of the widest crack; zero where all joints are closed.
pub(in crate::report) fn widest(model: &Model, contacts: &[ContactState]) -> f64 {
    joints::openings(model, contacts).iter().map(|it| it.widest).fold(0.0, f64::max)
}

/// The same in the colours of a widest crack of all that are compared.
pub(in crate::report) fn coloured(
    title: &str,
    model: &Model,
    contacts: &[ContactState],
    widest_of_all: f64,
) -> String {
    let openings = joints::openings(model, contacts);
    let widest = openings.iter().map(|it| it.widest).fold(0.0, f64::max);
    let slip = openings.iter().map(|it| it.slip).fold(0.0, f64::max);
    let mut sheet =
        Sheet::new(&format!("{title}: cracks"), model, marks::bounds(model), Margins::HATCH);
    marks::bricks(&mut sheet, &model.blocks, BRICK);
    marks::supports(&mut sheet, model);
    let width = (0.07 * sheet.brick).clamp(1.0, 4.5);
    draw_slips(&mut sheet, model, &openings, slip, width);
    if widest > 0.0 {
        draw_widths(&mut sheet, model, &openings, [widest, widest_of_all], width);
    }
    if openings.is_empty() {
        sheet.note("no joint has opened or slid");
    }
    sheet.finish()
}

fn millimetres(metres: f64) -> String {
    significant(1e3 * metres, 3)
}

fn draw_widths(
    sheet: &mut Sheet,
    model: &Model,
    openings: &[Opening],
    [widest, widest_of_all]: [f64; 2],
    width: f64,
) {
    let frame = sheet.frame;
    let round = round_down(1e3 * widest_of_all) * 1e-3;
    let class_of =
        |value: f64| CLASSES.iter().rposition(|least| value >= least * round * (1.0 - 1e-9));
    let mut pieces: Vec<Vec<Piece>> = vec![Vec::new(); 1 + CLASSES.len()];
    for opening in openings.iter().filter(|it| it.widest > 0.0) {
        let joint = &model.joints[opening.joint.index()];
        let open = pieces_of(opening, joint, &frame).into_iter().filter(|(.., it)| *it > 0.0);
        let mut last = None;
        for (from, to, value) in open {
            let class = class_of(value).map_or(0, |class| class + 1);
            match pieces[class].last_mut() {
                // One stroke as long as the class and the joint stay the same.
                Some(piece) if last == Some((class, from)) => piece.ends[1] = to,
                _ => pieces[class].push(Piece { joint: opening.joint, ends: [from, to] }),
            }
            last = Some((class, to));
        }
    }
    for (index, pieces) in pieces.iter().enumerate() {
        let colour = if index == 0 { HAIRLINE } else { WIDTHS[index - 1] };
        let stroke = width * (0.5 + 0.12 * index as f64);
        let style = format!(
            "class=\"cracks\" stroke=\"{colour}\" stroke-width=\"{}\" stroke-linecap=\"round\"",
            fixed(stroke)
        );
        sheet.canvas.group(&style, |canvas: &mut Canvas| {
            for Piece { joint, ends: [from, to] } in pieces {
                canvas.stroke(*from, *to, &names::joint(model, *joint));
            }
        });
    }
    // The widest first.
    let last = CLASSES.len() - 1;
    for index in (0..=last).rev() {
        let least = millimetres(CLASSES[index] * round);
        let text = match CLASSES.get(index + 1) {
            Some(most) => format!("crack of {least} to {} mm", millimetres(most * round)),
            None if widest < widest_of_all => format!("crack of {least} mm and more"),
            None => format!("crack of {least} mm and more, widest {}\u{a0}mm", millimetres(widest)),
        };
        sheet.line_entry(&text, WIDTHS[index], "4");
    }
    if widest < widest_of_all {
        sheet.note(&format!("widest here {}\u{a0}mm", millimetres(widest)));
    }
    if !pieces[0].is_empty() {
        let text = format!("below {} mm", millimetres(CLASSES[0] * round));
        sheet.line_entry(&text, HAIRLINE, "2");
    }
}

/// Pieces of a joint, each with its width \[m\]: between its points the width changes evenly, beyond them it is that
/// of the next.
fn pieces_of(opening: &Opening, joint: &Joint, frame: &Frame) -> Vec<(Pixel, Pixel, f64)> {
    let length = joint.length();
    let direction: Vector2<f64> = (joint.to - joint.from) / length;
    let count = if opening.widths.len() > 1 { PIECES } else { 1 };
    let place = |k: usize| length * k as f64 / count as f64;
    let pixel = |along: f64| frame.at(joint.from + direction * along);
    let piece = |k: usize| {
        let (from, to) = (place(k), place(k + 1));
        (pixel(from), pixel(to), width_at(&opening.widths, 0.5 * (from + to)))
    };
    (0..count).map(piece).collect()
}

fn width_at(widths: &[[f64; 2]], along: f64) -> f64 {
    let after = widths.iter().position(|[at, _]| *at >= along);
    match after {
        None => widths.last().map_or(0.0, |[_, width]| *width),
        Some(0) => widths[0][1],
        Some(k) => {
            let ([a, from], [b, to]) = (widths[k - 1], widths[k]);
            if b > a { from + (to - from) * (along - a) / (b - a) } else { to }
        }
    }
}

/// Joints that have slid and are closed somewhere, down to a hundredth of the largest slip.
fn draw_slips(sheet: &mut Sheet, model: &Model, openings: &[Opening], largest: f64, width: f64) {
    let frame = sheet.frame;
    let slid = |it: &&Opening| it.slip > 0.0 && it.slip >= 0.01 * largest;
    let found: Vec<&Opening> = openings.iter().filter(slid).collect();
    let most = found.iter().map(|it| it.slip).fold(0.0, f64::max);
    if most <= 0.0 {
        return;
    }
    let style =
        format!("class=\"slid\" stroke=\"{SLIDING}\" stroke-width=\"{}\"", fixed(0.6 * width));
    sheet.canvas.group(&style, |canvas| {
        for it in &found {
            let joint = &model.joints[it.joint.index()];
            let name = names::joint(model, it.joint);
            canvas.stroke(frame.at(joint.from), frame.at(joint.to), &name);
        }
    });
    let count = marks::counted(found.len(), "joint");
    let text = format!("{count} slid, up to {}\u{a0}mm", millimetres(most));
    sheet.line_entry(&text, SLIDING, "2.4");
}
