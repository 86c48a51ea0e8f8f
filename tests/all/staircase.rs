//! The arch over an open base: bed joints open along a staircase that rises from the inner ends of the feet,
//! half a brick and half a head joint sideways for every course and its bed joint, and the bricks below it
//! are unloaded. Of both bricks, dry and in mortar.

use crate::common;

use common::routes::solved_by;
use common::{panels, state};
use masonry::analysis::outcome::{Outcome, PointState, PointStatus};
use masonry::scene::Route;
use nalgebra::Point2;

/// Pressure on top \[Pa\].
const PRESSURE: f64 = 10e3;
/// Height of a brick \[m\].
const HEIGHT: f64 = 0.1;

/// A panel, and how far its staircase reaches.
struct Panel {
    scene: &'static str,
    /// Length of a brick \[m\].
    length: f64,
    /// Thickness of the joints \[m\].
    mortar: f64,
    width: f64,
    courses: u8,
}

const SQUARE: [Panel; 2] = [
    Panel { scene: "panel_square", length: 0.1, mortar: 0.0, width: 1.0, courses: 4 },
    Panel { scene: "panel_square_mortar", length: 0.1, mortar: 0.02, width: 1.3, courses: 5 },
];
const RECTANGULAR: [Panel; 2] = [
    Panel { scene: "panel_rectangular", length: 0.2, mortar: 0.0, width: 1.0, courses: 2 },
    Panel { scene: "panel_rectangular_mortar", length: 0.2, mortar: 0.02, width: 1.3, courses: 2 },
];

/// A bed joint: its ends from the left, and its points from the left.
struct Bed {
    ends: [f64; 2],
    points: Vec<PointState>,
}

impl Bed {
    fn force(&self) -> f64 {
        self.points.iter().map(|point| point.t_n).sum()
    }

    fn is_open(&self, point: usize) -> bool {
        self.points[point].status == PointStatus::Open
    }
}

impl Panel {
    fn solved(&self) -> Outcome {
        solved_by(&panels::scene(self.scene), Route::Interior)
    }

    /// Where the edge of the arch crosses a course, from the wall: half a brick further in every course.
    fn edge(&self, course: u8) -> f64 {
        (self.length + self.mortar) * 0.5 * (f64::from(course) + 1.0)
    }

    /// Height of the foot of a course.
    fn foot(&self, course: u8) -> f64 {
        (f64::from(course) - 1.0) * (HEIGHT + self.mortar)
    }

    /// The bed joints on top of a course, from the left.
    fn beds(&self, outcome: &Outcome, course: u8) -> Vec<Bed> {
        let level = self.foot(course) + HEIGHT + 0.5 * self.mortar;
        let model = &outcome.model;
        let mut beds: Vec<Bed> = Vec::new();
        for (k, joint) in model.joints.iter().enumerate() {
            if joint.normal.y.abs() < 0.5 || (joint.from.y - level).abs() > 1e-9 {
                continue;
            }
            let all = model.contacts.iter().zip(&state(outcome).contacts);
            let mut points: Vec<_> = all.filter(|(point, _)| point.joint.index() == k).collect();
            points.sort_by(|a, b| a.0.position.x.total_cmp(&b.0.position.x));
            let ends = [joint.from.x.min(joint.to.x), joint.from.x.max(joint.to.x)];
            beds.push(Bed { ends, points: points.into_iter().map(|(_, state)| *state).collect() });
        }
        beds.sort_by(|a, b| a.ends[0].total_cmp(&b.ends[0]));
        beds
    }

    /// The points of the upper half of the head joint at `x` in a course.
    fn upper_head(&self, outcome: &Outcome, x: f64, course: u8) -> Vec<PointState> {
        let middle = self.foot(course) + 0.5 * HEIGHT;
        let points = outcome.model.contacts.iter().zip(&state(outcome).contacts);
        let is_there = |at: Point2<f64>| {
            (at.x - x).abs() < 1e-9 && (at.y - middle - 0.25 * HEIGHT).abs() < 0.3 * HEIGHT
        };
        let found = points.filter(|(point, _)| {
            let joint = &outcome.model.joints[point.joint.index()];
            joint.normal.x.abs() > 0.5 && is_there(point.position)
        });
        found.map(|(_, state)| *state).collect()
    }

    /// Mean of the compressive principal stress \[Pa\] in a course between two abscissas.
    fn compression(&self, outcome: &Outcome, [from, to]: [f64; 2], course: u8) -> f64 {
        let foot = self.foot(course);
        let is_there = |x: f64, y: f64| x > from && x < to && y > foot && y < foot + HEIGHT;
        let stresses = state(outcome).stresses.iter();
        let found: Vec<f64> = stresses
            .filter(|it| is_there(it.centre.x, it.centre.y))
            .map(|it| -it.principal.sigma_2)
            .collect();
        assert!(!found.is_empty());
        found.iter().sum::<f64>() / found.len() as f64
    }
}

/// From either wall inwards, the first bed joint that carries next to nothing of what the one before it
/// carries is the step of the staircase.
#[test]
fn the_steps_rise_by_half_a_brick_a_course() {
    for panel in SQUARE.iter().chain(&RECTANGULAR) {
        let outcome = panel.solved();
        for course in 1..=panel.courses {
            let mut beds = panel.beds(&outcome, course);
            for side in ["left", "right"] {
                let step = beds.windows(2).position(|it| it[1].force() < 0.12 * it[0].force());
                let step = &beds[step.unwrap() + 1];
                let from_wall = match side {
                    "left" => step.ends[0],
                    _ => panel.width - step.ends[1],
                };
                let wrong = (from_wall - panel.edge(course)).abs();
                assert!(wrong < 1e-9, "{}, {side}, course {course}: {from_wall} m", panel.scene);
                beds.reverse();
            }
        }
    }
}

/// Of square bricks a step is open from end to end. Rectangular ones turn on it, and open it on the side of the
/// arch, and the head joint below it in its upper half.
#[test]
fn the_steps_are_open() {
    for panel in &SQUARE {
        let outcome = panel.solved();
        for course in 1..=panel.courses {
            for bed in panel.beds(&outcome, course) {
                let from_wall = bed.ends[0].min(panel.width - bed.ends[1]);
                if (from_wall - panel.edge(course)).abs() < 1e-9 {
                    assert!(bed.is_open(0) && bed.is_open(bed.points.len() - 1), "course {course}");
                    assert!(bed.force().abs() < 1e-9 * PRESSURE);
                }
            }
        }
    }
    for panel in &RECTANGULAR {
        let outcome = panel.solved();
        for course in 1..=panel.courses {
            let at_step = |bed: &Bed, from_wall: f64| {
                let is_it = (from_wall - panel.edge(course)).abs() < 1e-9;
                is_it.then_some(bed.points.len() - 1)
            };
            let mut steps = 0;
            for bed in panel.beds(&outcome, course) {
                if at_step(&bed, bed.ends[0]).is_some() {
                    assert!(bed.is_open(0), "{}, course {course}", panel.scene);
                    steps += 1;
                }
                if let Some(last) = at_step(&bed, panel.width - bed.ends[1]) {
                    assert!(bed.is_open(last), "{}, course {course}", panel.scene);
                    steps += 1;
                }
            }
            assert_eq!(steps, 2);
            let head = panel.edge(course) - 0.5 * panel.mortar;
            for x in [head, panel.width - head] {
                let points = panel.upper_head(&outcome, x, course);
                let is_open = |it: &PointState| it.status == PointStatus::Open;
                assert!(points.len() >= 2 && points.iter().all(is_open), "{x} m, course {course}");
            }
        }
    }
}

/// The brick before a step carries more than two and a half times the mean compression of the one behind it, on
/// either side, and in the middle of the lowest course it is less than a tenth of the pressure on top.
#[test]
fn bricks_below_the_staircase_are_unloaded() {
    for panel in SQUARE.iter().chain(&RECTANGULAR) {
        let outcome = panel.solved();
        for course in 1..=panel.courses {
            let edge = panel.edge(course);
            let before = [edge - panel.mortar - panel.length, edge - panel.mortar];
            let behind = [edge, edge + panel.length];
            let mirrored = |[from, to]: [f64; 2]| [panel.width - to, panel.width - from];
            let pairs = [(before, behind), (mirrored(before), mirrored(behind))];
            for (before, behind) in pairs {
                let [before, behind] =
                    [before, behind].map(|it| panel.compression(&outcome, it, course));
                let at = (panel.scene, course);
                assert!(before > 2.5 * behind, "{at:?}: {before} Pa and {behind} Pa");
            }
        }
        let middle = [0.5 * panel.width - 0.1, 0.5 * panel.width + 0.1];
        let middle = panel.compression(&outcome, middle, 1);
        assert!(middle < 0.1 * PRESSURE, "{}: {middle} Pa", panel.scene);
    }
}
