//! The forces in the joints: their resultants, each where it acts.

use nalgebra::{Point2, Vector2};

use super::canvas::{Pixel, fixed};
use super::loads::Loads;
use super::marks::{self, BRICK, COMPRESSION, OUTLINE, TENSION};
use super::sheet::Sheet;
use crate::model::{Joint, Model};
use crate::recover;
use crate::report::format::InUnits;
use crate::state::ContactState;

/// Resultants below this part of the largest are not drawn.
const LEAST: f64 = 1e-6;

/// The resultant of a joint.
struct Resultant {
    /// Where its line crosses the joint.
    at: Point2<f64>,
    force: Vector2<f64>,
    presses: bool,
}

/// The structure with the resultant of every joint as a stroke in its direction, through the place where it crosses the
/// joint; the length goes with the force. Loads are those of the model.
pub fn forces(title: &str, model: &Model, contacts: &[ContactState]) -> String {
    let units = InUnits(model.units);
    let loads = Loads::of(model, units);
    let mut sheet = Sheet::new(&format!("{title}: forces"), marks::bounds(model), loads.margins());
    let frame = sheet.frame;
    let brick = marks::brick_size(model, &frame);
    let outline = fixed(marks::outline_width(brick));
    let style = format!(
        "class=\"bricks\" fill=\"{BRICK}\" stroke=\"{OUTLINE}\" stroke-width=\"{outline}\" \
         stroke-linejoin=\"round\""
    );
    marks::blocks(&mut sheet, model, &style);
    marks::supports(&mut sheet, model);
    let resultants = resultants(model, contacts);
    let largest = resultants.iter().map(|it| it.force.norm()).fold(0.0, f64::max);
    let longest = 0.9 * brick;
    let (width, radius) = ((0.03 * brick).clamp(0.6, 2.0), (0.03 * brick).clamp(0.8, 2.4));
    for (presses, colour, name) in [(true, COMPRESSION, "pressing"), (false, TENSION, "pulling")] {
        let drawn = || {
            let large = move |it: &&Resultant| it.force.norm() > LEAST * largest;
            resultants.iter().filter(large).filter(move |it| it.presses == presses)
        };
        let most = drawn().map(|it| it.force.norm()).fold(0.0, f64::max);
        if most <= 0.0 {
            continue;
        }
        let style =
            format!("class=\"{name}\" stroke=\"{colour}\" stroke-width=\"{}\"", fixed(width));
        sheet.canvas.group(&style, |canvas| {
            for Resultant { at, force, .. } in drawn() {
                let half = 0.5 * longest * force.norm() / largest;
                let at = frame.at(*at);
                let ends = [-half, half].map(|half| at.shifted(force.x, -force.y, half));
                canvas.stroke(ends[0], ends[1]);
                canvas.circle(at, radius, &format!("fill=\"{colour}\" stroke=\"none\""));
            }
        });
        let text = format!("resultant in a joint, {name}, up to {}", units.force_text(most));
        sheet.entry(&text, |symbol| {
            let style = format!("stroke=\"{colour}\" stroke-width=\"1.8\"");
            symbol.line(Pixel::new(-22.0, 0.0), Pixel::new(22.0, 0.0), &style);
            symbol.circle(Pixel::new(0.0, 0.0), 2.4, &format!("fill=\"{colour}\""));
        });
    }
    loads.draw(&mut sheet, model);
    sheet.entry("one of many sets of forces where they are not unique", |_| {});
    sheet.length_bar(units);
    sheet.finish()
}

/// The resultants of all joints that press or pull.
fn resultants(model: &Model, contacts: &[ContactState]) -> Vec<Resultant> {
    let mut sums = vec![(Vector2::zeros(), 0.0, 0.0); model.joints.len()];
    for (contact, state) in model.contacts.iter().zip(contacts) {
        let joint = &model.joints[contact.joint.index()];
        let (force, normal, moment) = &mut sums[contact.joint.index()];
        *force += recover::contact_force(model, contact, state);
        *normal += state.t_n;
        *moment += state.t_n * (contact.position - joint.from).dot(&joint.tangent());
    }
    let placed = |(joint, (force, normal, moment)): (&Joint, (Vector2<f64>, f64, f64))| {
        (normal != 0.0).then(|| {
            let at = joint.from + joint.tangent() * (moment / normal);
            Resultant { at, force, presses: normal > 0.0 }
        })
    };
    model.joints.iter().zip(sums).filter_map(placed).collect()
}
