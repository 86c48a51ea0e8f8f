//! The bricks of a wall: running bond, or courses given brick by brick.

use crate::scene::{Courses, Wall};

/// Parts of a brick shorter than this fraction of it are rounding errors, not bricks.
const SLIVER: f64 = 1e-9;

/// A brick in its place, in the units of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedBrick {
    /// The course, from 1 at the bottom.
    pub course: usize,
    /// The place in the course, from 1 at the left; openings are not counted.
    pub place: usize,
    /// Lower left corner \[length\].
    pub low: [f64; 2],
    /// Upper right corner \[length\].
    pub high: [f64; 2],
    /// Length in units of one brick \[-\].
    pub fraction: f64,
}

impl PlacedBrick {
    /// The name of the brick, `wall/course/place`.
    pub fn name(&self, wall: &Wall) -> String {
        format!("{}/{}/{}", wall.name, self.course, self.place)
    }

    /// The corners, counter-clockwise from the lower left \[length\].
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let ([x0, y0], [x1, y1]) = (self.low, self.high);
        [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
    }

    /// The mesh of this brick when a whole one has `mesh`: a cut brick gets its share of the
    /// elements along its length, rounded up.
    pub fn mesh(&self, mesh: [u32; 2]) -> [usize; 2] {
        let [whole, high] = mesh.map(|n| n as usize);
        let share = whole as f64 * (self.fraction - SLIVER);
        let along = (1..).take_while(|n| ((n - 1) as f64) < share).last().unwrap_or(1);
        [along, high]
    }
}

/// The bricks of a wall, course by course from the bottom, each from left to right.
///
/// Ends of bricks that meet, in one course or one above another, have the same coordinates bit by
/// bit wherever the lengths are halves of a brick.
pub fn bricks(wall: &Wall) -> Vec<PlacedBrick> {
    match &wall.courses {
        Courses::RunningBond(count) => {
            let width = snap(wall.width.unwrap_or(wall.brick.length) / wall.brick.length);
            (0..*count as usize)
                .flat_map(|course| lay(wall, course, &running_bond(course, width)))
                .collect()
        }
        Courses::List(courses) => courses
            .iter()
            .enumerate()
            .flat_map(|(course, lengths)| lay(wall, course, &given(lengths)))
            .collect(),
    }
}

/// A number of half bricks where it is one but for rounding.
fn snap(bricks: f64) -> f64 {
    let halves = 0.5 * (2.0 * bricks).round();
    if (bricks - halves).abs() < SLIVER { halves } else { bricks }
}

/// A stretch of a course in units of one brick, from its start to its end.
type Stretch = [f64; 2];

/// A course of a wall `width` bricks wide; every other one begins with a half brick.
fn running_bond(course: usize, width: f64) -> Vec<Stretch> {
    let first = if course.is_multiple_of(2) { 1.0 } else { 0.5 };
    let inner = (0..).map(|k| first + f64::from(k)).take_while(|end| *end < width - SLIVER);
    let ends: Vec<f64> = std::iter::once(0.0).chain(inner).chain(std::iter::once(width)).collect();
    ends.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// The bricks of a course given as a list of lengths, without the openings.
fn given(lengths: &[f64]) -> Vec<Stretch> {
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

fn lay(wall: &Wall, course: usize, stretches: &[Stretch]) -> Vec<PlacedBrick> {
    let x = |bricks: f64| wall.origin[0] + bricks * wall.brick.length;
    let y = |course: usize| wall.origin[1] + course as f64 * wall.brick.height;
    let laid = stretches.iter().enumerate().map(|(place, [start, end])| PlacedBrick {
        course: course + 1,
        place: place + 1,
        low: [x(*start), y(course)],
        high: [x(*end), y(course + 1)],
        fraction: end - start,
    });
    laid.collect()
}
