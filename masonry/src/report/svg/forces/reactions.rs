//! Reactions of the supports as arrows with their values.

use nalgebra::{Point2, Vector2};

use crate::model::Model;
use crate::report::format::InUnits;
use crate::report::joints::{self, JointForce};
use crate::report::svg::canvas::Pixel;
use crate::report::svg::labels::Labels;
use crate::report::svg::names;
use crate::report::svg::sheet::{Frame, Margins, Sheet, label_room};
use crate::report::svg::style::TEXT;

const COLOUR: &str = "#1b7837";
const LONGEST: f64 = 36.0;
const SHORTEST: f64 = 16.0;
/// Reactions below this part of the largest are not drawn.
const LEAST: f64 = 1e-6;

/// The reactions of a model.
#[derive(Debug)]
pub(super) struct Reactions(Vec<Reaction>);

#[derive(Debug)]
struct Reaction {
    at: Point2<f64>,
    /// From the structure to where the arrow begins.
    outwards: Vector2<f64>,
    length: f64,
    label: String,
    /// The attributes of its elements.
    name: String,
}

impl Reaction {
    /// Tail and tip.
    fn arrow(&self, frame: &Frame) -> [Pixel; 2] {
        let (tip, n) = (frame.at(self.at), self.outwards);
        [tip.shifted(n.x, -n.y, self.length), tip]
    }
}

impl Reactions {
    pub(super) fn of(model: &Model, forces: &[JointForce], units: InUnits) -> Self {
        let all = joints::reactions(model, forces);
        let largest = all.iter().map(|it| it.force.norm()).fold(0.0, f64::max);
        let large = all.iter().filter(|it| it.force.norm() > LEAST * largest);
        let reaction = |it: &joints::SupportForce| Reaction {
            at: it.at,
            outwards: -it.force.normalize(),
            length: SHORTEST + (LONGEST - SHORTEST) * it.force.norm() / largest,
            label: units.force_text(it.force.norm()),
            name: names::support(&model.supports[it.support.index()]),
        };
        Self(large.map(reaction).collect())
    }

    /// Room that arrows and labels need around the structure.
    pub(super) fn margins(&self) -> Margins {
        let mut margins = Margins::HATCH;
        for it in &self.0 {
            let n = it.outwards;
            let beside = |part: f64| it.length * part + 14.0 + label_room(&it.label);
            margins.right = margins.right.max(if n.x > 0.5 { beside(n.x) } else { 0.0 });
            margins.left = margins.left.max(if n.x < -0.5 { beside(-n.x) } else { 0.0 });
            let above = |part: f64| it.length * part + 14.0 + TEXT;
            margins.top = margins.top.max(if n.y > 0.0 { above(n.y) } else { 0.0 });
            margins.bottom = margins.bottom.max(if n.y < 0.0 { above(-n.y) } else { 0.0 });
        }
        margins
    }

    /// Keeps labels away from all arrows.
    pub(super) fn mark(&self, frame: &Frame, labels: &mut Labels) {
        for [tail, tip] in self.0.iter().map(|it| it.arrow(frame)) {
            labels.avoid(tail, tip);
        }
    }

    pub(super) fn draw(&self, sheet: &mut Sheet, labels: &mut Labels) {
        if self.0.is_empty() {
            return;
        }
        let frame = sheet.frame;
        sheet.canvas.group("class=\"reactions\"", |canvas| {
            for it in &self.0 {
                let [tail, tip] = it.arrow(&frame);
                canvas.group(&it.name, |canvas| canvas.arrow(tail, tip, COLOUR));
            }
        });
        sheet.canvas.group(&format!("class=\"reactions\" fill=\"{COLOUR}\""), |canvas| {
            for it in &self.0 {
                let n = it.outwards;
                let [tail, _] = it.arrow(&frame);
                let at = tail.shifted(n.x, -n.y, 4.0);
                labels.draw(canvas, at, n, TEXT, &it.label);
            }
        });
        sheet.entry("reaction of a support", |symbol| {
            symbol.arrow(Pixel::new(0.0, 10.0), Pixel::new(0.0, -10.0), COLOUR);
        });
    }
}
