//! Open joints in colours that depend on their width, and joints that have slid.

use super::canvas::{Pixel, open};
use super::forces::Loaded;
use super::legend;
use super::names;
use super::sheet::{Frame, Sheet, Sides};
use super::structure::{self, counted};
use crate::format::{round_down, significant};
use crate::joints::{self, JointOpening};
use masonry::data::state::PointState;
use masonry::ids::JointId;
use masonry::model::{Model, PlacedJoint};
use masonry::rounding::largest;

/// The lower ends of the classes of widths, divided by a round width below the largest width. Widths below the second
/// number are hairline cracks.
const CLASSES: [f64; 6] = [0.0, 0.05, 0.1, 0.2, 0.5, 1.0];
/// Number of pieces into which a joint is divided if its width changes.
const PIECES: usize = 6;
/// Slips below this part of the largest slip are not drawn.
const LEAST_SLIP: f64 = 0.01;

/// Draws the structure with its open joints in colours, wider joints darker; the legend is in millimetres. Joints that
/// are closed and have slid have a separate colour. `None` if no joint has opened or slid.
pub fn cracks(title: &str, model: &Model, contacts: &[PointState]) -> Option<String> {
    let is_closed = joints::openings(model, contacts).is_empty();
    (!is_closed).then(|| cracks_or_none(title, model, contacts))
}

/// Draws the picture of [`cracks`], or the structure with a note that no joint has opened or slid.
pub fn cracks_or_none(title: &str, model: &Model, contacts: &[PointState]) -> String {
    let by = widest(&joints::openings(model, contacts));
    compared(&Loaded { title, model, contacts }, by)
}

/// Returns the width of the widest crack \[m\]; zero if all joints are closed.
pub(crate) fn widest(openings: &[JointOpening]) -> f64 {
    largest(openings.iter().map(|it| it.widest))
}

/// Draws the picture of [`cracks`] with classes for `widest_of_all`, the width of the widest crack in all compared
/// pictures \[m\].
pub(crate) fn compared(loaded: &Loaded<'_>, widest_of_all: f64) -> String {
    let Loaded { title, model, contacts } = *loaded;
    let openings = joints::openings(model, contacts);
    let bounds = structure::bounds(model);
    let mut sheet = Sheet::new(format!("{title}: cracks"), model, bounds, Sides::HATCH);
    structure::draw(&mut sheet, model);
    draw_slips(&mut sheet, model, &openings);
    if widest(&openings) > 0.0 {
        draw_widths(&mut sheet, model, &openings, widest_of_all);
    }
    if openings.is_empty() {
        sheet.legend.note("no joint has opened or slid");
    }
    sheet.finish()
}

fn millimetres(metres: f64) -> String {
    significant(1e3 * metres, 3)
}

/// A part of a joint that is drawn with one width, or with widths of one class.
#[derive(Clone, Copy)]
struct Piece {
    joint: JointId,
    ends: [Pixel; 2],
    /// The opening in the middle of the piece \[m\].
    width: f64,
}

fn draw_widths(sheet: &mut Sheet, model: &Model, openings: &[JointOpening], widest_of_all: f64) {
    let round = round_down(1e3 * widest_of_all) * 1e-3;
    let class = |piece: &Piece| {
        let is_reached = |least: &f64| piece.width >= least * round * (1.0 - 1e-9);
        CLASSES.iter().rposition(is_reached).unwrap_or(0)
    };
    let mut classes: [Vec<Piece>; CLASSES.len()] = Default::default();
    for opening in openings.iter().filter(|it| it.widest > 0.0) {
        let pieces = pieces(opening, &model.joints[opening.joint.index()], &sheet.frame);
        let open: Vec<Piece> = pieces.filter(|it| it.width > 0.0).collect();
        let is_one = |a: &Piece, b: &Piece| class(a) == class(b) && a.ends[1] == b.ends[0];
        // Neighbouring pieces of the same class are drawn as one stroke.
        for run in open.chunk_by(is_one) {
            let ends = [run[0].ends[0], run[run.len() - 1].ends[1]];
            classes[class(&run[0])].push(Piece { ends, ..run[0] });
        }
    }
    for (index, pieces) in classes.iter().enumerate() {
        sheet.layer(&format!("cracks width{index}"), |canvas, _| {
            for it in pieces {
                canvas.path(&open(it.ends), &names::joint(model, it.joint));
            }
        });
    }
    explain_widths(sheet, round, widest(openings), widest_of_all);
    if !classes[0].is_empty() {
        let text = format!("below {} mm", millimetres(CLASSES[1] * round));
        sheet.legend.add(&text, "cracks", legend::line);
    }
}

/// Adds the classes of widths to the legend, the widest first.
fn explain_widths(sheet: &mut Sheet, round: f64, widest: f64, widest_of_all: f64) {
    for (index, least) in CLASSES.iter().enumerate().skip(1).rev() {
        let least = millimetres(least * round);
        let text = match CLASSES.get(index + 1) {
            Some(most) => format!("crack of {least} to {} mm", millimetres(most * round)),
            None if widest < widest_of_all => format!("crack of {least} mm and more"),
            None => format!("crack of {least} mm and more, widest {}\u{a0}mm", millimetres(widest)),
        };
        sheet.legend.add(&text, &format!("cracks width{index}"), legend::line);
    }
    if widest < widest_of_all {
        sheet.legend.note(&format!("widest here {}\u{a0}mm", millimetres(widest)));
    }
}

/// Divides a joint into pieces. The width changes linearly between contact points, and is that of the nearest contact
/// point beyond the outer ones.
fn pieces<'a>(
    opening: &'a JointOpening,
    joint: &'a PlacedJoint,
    frame: &'a Frame,
) -> impl Iterator<Item = Piece> + 'a {
    let count = if opening.widths.len() > 1 { PIECES } else { 1 };
    let part = (joint.to - joint.from) / count as f64;
    (0..count).map(move |k| {
        let ends = [k, k + 1].map(|k| frame.at(joint.from + part * k as f64));
        let width = width_at(&opening.widths, part.norm() * (k as f64 + 0.5));
        Piece { joint: opening.joint, ends, width }
    })
}

fn width_at(widths: &[[f64; 2]], along: f64) -> f64 {
    match widths.iter().position(|[at, _]| *at >= along) {
        None => widths.last().map_or(0.0, |[_, width]| *width),
        Some(0) => widths[0][1],
        Some(k) => {
            let ([a, from], [b, to]) = (widths[k - 1], widths[k]);
            if b > a { from + (to - from) * (along - a) / (b - a) } else { to }
        }
    }
}

/// Draws the joints that have slid and are closed at some contact point.
fn draw_slips(sheet: &mut Sheet, model: &Model, openings: &[JointOpening]) {
    let most = largest(openings.iter().map(|it| it.slip));
    let has_slid = |it: &&JointOpening| it.slip > 0.0 && it.slip >= LEAST_SLIP * most;
    let found: Vec<&JointOpening> = openings.iter().filter(has_slid).collect();
    if found.is_empty() {
        return;
    }
    structure::joints(sheet, "slid", model, found.iter().map(|it| it.joint));
    let (count, most) = (counted(found.len(), "joint"), millimetres(most));
    let text = format!("{count} slid, up to {most}\u{a0}mm");
    sheet.legend.add(&text, "slid", legend::line);
}
