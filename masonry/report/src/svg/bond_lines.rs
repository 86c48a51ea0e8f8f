//! The lines of a running bond, with which principal stresses are compared.

use nalgebra::Point2;

use masonry::scene::bond::{self, JointThickness, PlacedBrick};
use masonry::scene::{Scene, Wall};

/// Two thin lines with which the flow of stresses is compared; they lean towards each other.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceLines {
    /// The points at which the two lines start \[m\]. The left line rises to the right and the right line to the left,
    /// until they meet or leave the structure.
    pub origins: [Point2<f64>; 2],
    /// Angle between each line and the vertical \[rad\], in `[0, pi/2)`.
    pub angle: f64,
    /// The name of the lines in the legend, such as `arctan(l / 2h) = 26.57°`.
    pub label: String,
}

impl ReferenceLines {
    /// Returns the running-bond lines with which principal stresses are compared. The lines start at the inner ends of
    /// the lowest supports at both corners of the first wall, and go half a brick and half a head joint sideways for
    /// every course with its bed joint. `None` for a scene without such a wall, and if the wall is turned, has a
    /// support all along its foot, or has an opening on a line.
    pub fn of(scene: &Scene) -> Option<Self> {
        let wall = scene.walls.first().filter(|wall| wall.turn().abs() <= 0.0)?;
        let [_, foot] = wall.origin;
        let level = |y: f64| (y - foot).abs() <= 1e-9 * wall.brick.height;
        let supports = scene.supports.iter().filter(|it| level(it.from[1]) && level(it.to[1]));
        let feet = supports.map(|it| [it.from[0].min(it.to[0]), it.from[0].max(it.to[0])]);
        let [_, left] = feet.clone().min_by(|a, b| a[0].total_cmp(&b[0]))?;
        let [right, _] = feet.max_by(|a, b| a[0].total_cmp(&b[0]))?;
        let joints = JointThickness::of(scene, wall);
        if left >= right || !is_filled(wall, joints, [left, right]) {
            return None;
        }
        let (length, height) = (wall.brick.length + joints.head, wall.brick.height + joints.bed);
        let dry = joints == JointThickness::default();
        let label = if dry { "arctan(l / 2h)" } else { "arctan((l + t) / 2(h + t))" };
        let origins = [left, right].map(|x| Point2::new(x, foot) * scene.units.length_to_si());
        Some(Self { origins, angle: (length / (2.0 * height)).atan(), label: label.to_owned() })
    }

    /// Returns the two lines up to the same height: the height at which they meet, or the top of the structure \[m\].
    pub(super) fn within(&self, top: f64) -> [[Point2<f64>; 2]; 2] {
        let [mut left, mut right] = self.origins;
        if left.x > right.x {
            (left, right) = (right, left);
        }
        let slope = self.angle.tan().max(0.0);
        let meeting = left.y.max(right.y) + 0.5 * (right.x - left.x) / slope;
        let end = meeting.min(top);
        let rise = |origin: Point2<f64>, lean: f64| {
            [origin, Point2::new(origin.x + lean * (end - origin.y), end)]
        };
        [rise(left, slope), rise(right, -slope)]
    }
}

/// Whether there are bricks all along the lines from the points `left` and `right` at the foot of a wall up to the
/// point at which they meet, and every whole brick lies half over a joint of the course below: the bond is a running
/// bond.
fn is_filled(wall: &Wall, joints: JointThickness, [left, right]: [f64; 2]) -> bool {
    /// Lengths below this part of the length of a brick count as zero.
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
    courses.iter().enumerate().all(|(k, course)| {
        // The point of the line is taken half a course below the top of the course.
        let along = (course[0].course as f64 - 0.5) * 0.5 * length;
        let is_laid = |x: f64| {
            let reach = |it: &PlacedBrick| it.low[0] - joints.head..=it.high[0] + joints.head;
            let mut met = course.iter().filter(|it| reach(it).contains(&x)).peekable();
            met.peek().is_some() && met.all(|brick| k == 0 || steps(brick, courses[k - 1]))
        };
        2.0 * along >= right - left || is_laid(left + along) && is_laid(right - along)
    })
}
