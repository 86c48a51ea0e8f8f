//! What can be dragged in the picture: openings of walls and ends of supports.

use masonry::Scene;
use masonry::scene::Wall;
use masonry::scene::bond::JointThickness;
use serde::Serialize;

use super::controls::Edit;
use super::schema::Step;
use super::text::{Number, Text, Value};

/// Something in the picture that changes numbers of the text when it is dragged. Lengths are in units of the scene.
#[derive(Debug, Serialize)]
pub(super) struct Handle {
    /// The same for the same handle of a changed scene.
    label: String,
    /// Two opposite corners, or twice the same point.
    low: [f64; 2],
    high: [f64; 2],
    /// What changes when it goes to the right.
    right: Vec<Target>,
    /// What changes when it goes up.
    up: Vec<Target>,
}

/// A number that follows a handle.
#[derive(Debug, Serialize)]
struct Target {
    #[serde(flatten)]
    edit: Edit,
    value: f64,
    whole: bool,
    least: Option<f64>,
    /// How much it grows where the handle goes on by one unit of length.
    per_length: f64,
}

impl Target {
    fn of(number: Number, per_length: f64) -> Self {
        let Number { value, whole, least, .. } = number;
        Self { edit: Edit::of(number), value, whole, least, per_length }
    }
}

/// All handles of a scene that was read from the text.
pub(super) fn handles(scene: &Scene, text: &Text<'_>) -> Vec<Handle> {
    let mut list = Vec::new();
    for (wall, table) in scene.walls.iter().zip(text.tables("walls")) {
        let openings = table.get_ref().as_table().and_then(|it| it.get("openings"));
        let openings = openings.and_then(|it| it.get_ref().as_array()).into_iter().flatten();
        for (index, opening) in openings.enumerate() {
            list.extend(opening_handles(scene, text, wall, index, opening));
        }
    }
    for (support, table) in scene.supports.iter().zip(text.tables("supports")) {
        let ends = [("from", support.from), ("to", support.to)];
        list.extend(ends.into_iter().filter_map(|(key, at)| {
            let label = format!("{key} of support {}", support.name);
            Some(end_handle(text, label, at, table.get_ref().as_table()?.get(key)?))
        }));
    }
    list
}

/// The handles of an opening: all of it, its right side and its top.
fn opening_handles(
    scene: &Scene,
    text: &Text<'_>,
    wall: &Wall,
    index: usize,
    table: &Value<'_>,
) -> Vec<Handle> {
    let Some(opening) = wall.openings.get(index) else { return Vec::new() };
    let course = wall.brick.height + JointThickness::of(scene, wall).bed;
    let left = wall.origin[0] + opening.x;
    let bottom = wall.origin[1] + course * f64::from(opening.course.saturating_sub(1));
    let (right, top) = (left + opening.width, bottom + course * f64::from(opening.courses));
    let path = [Step::Key("walls"), Step::Item, Step::Key("openings"), Step::Item];
    let target = |key: &str, per_length: f64| {
        let value = table.get_ref().as_table()?.get(key)?;
        let number = text.number(value, &[&path[..], &[Step::Key(key)]].concat())?;
        Some(Target::of(number, per_length))
    };
    let handle = |part: &str, low, high, right: Option<Target>, up: Option<Target>| Handle {
        label: format!("{part} of {}, opening {}", wall.name, index + 1),
        low,
        high,
        right: right.into_iter().collect(),
        up: up.into_iter().collect(),
    };
    let per_course = 1.0 / course;
    let [x, width] = ["x", "width"].map(|key| target(key, 1.0));
    let [first, courses] = ["course", "courses"].map(|key| target(key, per_course));
    vec![
        handle("place", [left, bottom], [right, top], x, first),
        handle("right side", [right, bottom], [right, top], width, None),
        handle("top", [left, top], [right, top], None, courses),
    ]
}

/// The end of a support, which is a pair of numbers.
fn end_handle(text: &Text<'_>, label: String, at: [f64; 2], pair: &Value<'_>) -> Handle {
    let target = |index: usize| {
        let number = text.number(pair.get_ref().as_array()?.get(index)?, &[Step::Item])?;
        Some(Target::of(number, 1.0))
    };
    let [right, up] = [0, 1].map(|index| target(index).into_iter().collect());
    Handle { label, low: at, high: at, right, up }
}
