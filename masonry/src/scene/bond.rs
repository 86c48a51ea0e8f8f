//! The bricks of a wall: laid in a bond and cut at openings, or given in courses, brick by brick.

mod openings;

use crate::geometry::SAME_PLACE;
use crate::scene::{Bond, Courses, Joint, Scene, Wall};

pub(crate) use openings::{taken, voussoirs};

/// Thicknesses \[length\] of the joints between the bricks of a wall; zero for dry joints.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointThickness {
    /// Thickness of the bed joints: the vertical distance of courses is the height of a brick plus this thickness.
    pub bed: f64,
    /// Thickness of the head joints: the distance of bricks in a course is the length of a brick plus this thickness.
    pub head: f64,
}

impl JointThickness {
    /// Returns the thicknesses of the joint classes of a wall.
    pub fn of(scene: &Scene, wall: &Wall) -> Self {
        let of = |class: &str| scene.joints.get(class).map_or(0.0, Joint::mortar_thickness);
        let [bed, head] = wall.joints.names().map(of);
        Self { bed, head }
    }
}

/// A brick of a wall at its place, in the units of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedBrick {
    /// The course, from 1 at the bottom.
    pub course: usize,
    /// The number of the brick in its course, from 1 at the left; openings are not counted.
    pub place: usize,
    /// Lower left corner of the brick \[length\].
    pub low: [f64; 2],
    /// Upper right corner of the brick \[length\].
    pub high: [f64; 2],
    /// Length of the brick divided by that of a whole brick, without mortar \[-\].
    pub fraction: f64,
    /// The lengths by which the bottom of a brick beside a flat arch reaches beyond its top, left and right
    /// \[length\].
    pub leans: [f64; 2],
    /// The index of the opening above which the brick is the lintel; `None` for other bricks.
    pub lintel: Option<usize>,
}

impl PlacedBrick {
    /// Returns the name of the brick, `wall/course/place`.
    pub fn name(&self, wall: &Wall) -> String {
        format!("{}/{}/{}", wall.name, self.course, self.place)
    }

    /// Returns the corners of the brick, counter-clockwise from the lower left \[length\].
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let ([x0, y0], [x1, y1], [left, right]) = (self.low, self.high, self.leans);
        [[x0 - left, y0], [x1 + right, y0], [x1, y1], [x0, y1]]
    }

    /// Returns the numbers of elements of this brick if a whole brick has `mesh`: along the length, a cut brick gets
    /// its share of the elements, rounded up.
    pub fn mesh(&self, mesh: [u32; 2]) -> [usize; 2] {
        let [whole, high] = mesh;
        let share = f64::from(whole) * (self.fraction - SAME_PLACE);
        let mut along = 1;
        while (along as f64) < share {
            along += 1;
        }
        [along, high as usize]
    }
}

/// Returns the bricks of a wall with dry joints: course by course from the bottom, each course from left to right.
///
/// Ends of bricks that meet, in one course or in courses above one another, have exactly equal coordinates if the
/// lengths are multiples of half a brick.
pub fn bricks(wall: &Wall) -> Vec<PlacedBrick> {
    bricks_in_mortar(wall, JointThickness::default())
}

/// Returns the bricks of a wall with mortar between them, in the order of [`bricks`].
///
/// Every brick is laid with a head joint at its right end, so that lengths in courses count a brick and its joint:
/// whole bricks have their length `l`, half bricks `(l - t_y) / 2`. The last joint of a course is left out: a wall of
/// `n` whole bricks is `n (l + t_y) - t_y` wide, and a wall of `n` courses is `n (h + t_y) - t_y` high.
///
/// ```
/// use masonry::scene::bond::{JointThickness, bricks_in_mortar};
/// use masonry::scene::{Brick, Wall};
///
/// let brick = Brick { length: 0.2, height: 0.1 };
/// let wall = Wall::running_bond("wall", "brick", brick, 1.3, 2);
/// let laid = bricks_in_mortar(&wall, JointThickness { bed: 0.02, head: 0.02 });
/// let half = &laid[6];
/// assert!((half.high[0] - half.low[0] - 0.09).abs() < 1e-15);
/// assert!((laid[12].high[0] - 1.3).abs() < 1e-15 && (laid[12].low[1] - 0.12).abs() < 1e-15);
/// ```
pub fn bricks_in_mortar(wall: &Wall, joints: JointThickness) -> Vec<PlacedBrick> {
    courses(wall, joints)
        .enumerate()
        .flat_map(|(course, stretches)| lay(wall, joints, course, &stretches))
        .collect()
}

/// Finds the first brick that has no length left after its head joint is subtracted. Returns its course and its place
/// in the course, both from 0, with openings counted.
pub(crate) fn first_without_length(wall: &Wall, joints: JointThickness) -> Option<[usize; 2]> {
    let gone = |&[start, end]: &Span| left_of(end - start, wall, joints) <= SAME_PLACE;
    // Two courses represent all courses of a bond without openings.
    let is_bond = matches!(wall.courses, Courses::RunningBond(_)) && wall.openings.is_empty();
    let repeated = if is_bond { 2 } else { usize::MAX };
    let mut places = courses(wall, joints).take(repeated).enumerate();
    places.find_map(|(course, stretches)| {
        let brick = stretches.iter().position(gone)?;
        let Courses::List(lists) = &wall.courses else { return Some([course, brick]) };
        let bricks = lists[course].iter().enumerate().filter(|(_, length)| **length > 0.0);
        bricks.map(|(place, _)| [course, place]).nth(brick)
    })
}

/// Returns the stretches of the bricks in all courses, in units of one brick and its head joint.
fn courses(wall: &Wall, joints: JointThickness) -> Box<dyn Iterator<Item = Vec<Span>> + '_> {
    match &wall.courses {
        Courses::RunningBond(count) => {
            let width = wall.width_given().unwrap_or(wall.brick.length);
            let width = snap((width + joints.head) / (wall.brick.length + joints.head));
            let laid = move |course: usize| {
                let bricks = bricks_between(&ends(wall.bond.unwrap_or_default(), course, width));
                openings::cut(wall, joints, course, bricks)
            };
            Box::new((0..*count as usize).map(laid))
        }
        Courses::List(lists) => Box::new(lists.iter().map(|lengths| given(lengths))),
    }
}

/// Returns the length of the brick on a stretch, without the head joint, in units of one brick.
fn left_of(stretch: f64, wall: &Wall, joints: JointThickness) -> f64 {
    stretch + joints.head / wall.brick.length * (stretch - 1.0)
}

/// Rounds a length in bricks to half bricks if the difference is at most [`SAME_PLACE`].
fn snap(bricks: f64) -> f64 {
    let halves = 0.5 * (2.0 * bricks).round();
    if (bricks - halves).abs() < SAME_PLACE { halves } else { bricks }
}

/// A stretch of a course, from its start to its end, in units of one brick and its head joint.
type Span = [f64; 2];

/// Returns the ends of the bricks in a course of a wall that is `width` bricks wide, starting with 0.
fn ends(bond: Bond, course: usize, width: f64) -> Vec<f64> {
    let is_even = course.is_multiple_of(2);
    // The first end after a closer, if there is one, and the alternating lengths of the bricks that follow.
    let (first, lengths) = match bond {
        Bond::Running if !is_even => (0.5, [1.0, 1.0]),
        Bond::English if !is_even => (0.75, [0.5, 0.5]),
        Bond::Flemish if !is_even => (0.75, [1.0, 0.5]),
        Bond::Flemish => (1.0, [0.5, 1.0]),
        Bond::Running | Bond::Stack | Bond::English => (1.0, [1.0, 1.0]),
    };
    let has_closers = matches!(bond, Bond::English | Bond::Flemish) && !is_even;
    let mut ends = vec![0.0];
    if has_closers && width > 0.5 + SAME_PLACE {
        ends.push(0.5);
    }
    // A course of up to 1.5 bricks has no room for two closers.
    let closed = has_closers && width > 1.5 + SAME_PLACE;
    let last = if closed { width - 0.75 } else { width };
    let end = |k: u32| {
        first + f64::from(k / 2) * (lengths[0] + lengths[1]) + f64::from(k % 2) * lengths[0]
    };
    ends.extend((0..).map(end).take_while(|end| *end < last - SAME_PLACE));
    if closed {
        ends.extend([last, width - 0.5]);
    }
    ends.push(width);
    ends
}

fn bricks_between(ends: &[f64]) -> Vec<Span> {
    ends.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// Returns the interval of each brick of a course that is given as a list of lengths. A negative length is an opening,
/// which has no interval.
fn given(lengths: &[f64]) -> Vec<Span> {
    let mut end = 0.0;
    let mut stretches = Vec::with_capacity(lengths.len());
    for length in lengths {
        let start = end;
        end += length.abs();
        if *length > 0.0 {
            stretches.push([start, end]);
        }
    }
    stretches
}

fn lay(wall: &Wall, joints: JointThickness, course: usize, stretches: &[Span]) -> Vec<PlacedBrick> {
    let pitch = [wall.brick.length + joints.head, wall.brick.height + joints.bed];
    let x = |bricks: f64| wall.origin[0] + bricks * pitch[0];
    let y = |course: usize| wall.origin[1] + course as f64 * pitch[1];
    let laid = stretches.iter().enumerate().map(|(place, [start, end])| PlacedBrick {
        course: course + 1,
        place: place + 1,
        low: [x(*start), y(course)],
        high: [x(*end) - joints.head, y(course + 1) - joints.bed],
        fraction: left_of(end - start, wall, joints),
        leans: openings::leans(wall, joints, course, [*start, *end]),
        lintel: openings::lintel_at(wall, joints, course, *start),
    });
    laid.collect()
}
