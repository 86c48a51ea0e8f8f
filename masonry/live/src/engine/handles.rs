//! Handles in the picture: openings of walls and ends of supports. The places of handles come from the text alone, so
//! that a handle that was dragged too far can be dragged back.

use serde::Serialize;

use super::controls::Edit;
use super::schema::Entry;
use super::text::{Number, Text, Value, text_of, value_of};

/// A part of the picture that changes numbers of the text when a user drags it. Lengths are in units of the scene.
#[derive(Debug, Serialize)]
pub(super) struct Handle {
    /// The name of the handle, which stays the same when the scene is changed.
    label: String,
    /// The lower left and the upper right corner of the handle; equal if the handle is a point.
    low: [f64; 2],
    high: [f64; 2],
    /// The numbers that change when the handle is dragged to the right.
    right: Vec<Target>,
    /// The numbers that change when the handle is dragged upwards.
    up: Vec<Target>,
}

/// A number in the text that changes when a handle is dragged.
#[derive(Debug, Serialize)]
struct Target {
    #[serde(flatten)]
    edit: Edit,
    value: f64,
    whole: bool,
    least: Option<f64>,
    /// The change of the number, divided by the distance over which the handle is dragged.
    per_length: f64,
}

impl Target {
    fn of(number: Number, per_length: f64) -> Self {
        let Number { value, whole, least, .. } = number;
        Self { edit: Edit::of(number), value, whole, least, per_length }
    }
}

/// Returns all handles of a scene.
pub(super) fn handles(text: &Text<'_>) -> Vec<Handle> {
    let walls = text.tables("walls").into_iter().filter_map(|table| wall(text, table));
    let supports = text.tables("supports").into_iter().flat_map(|table| support(text, table));
    walls.flatten().chain(supports).collect()
}

/// Returns the handles of the openings of a wall; `None` for a turned wall or one without openings, and if a number is
/// missing.
fn wall(text: &Text<'_>, table: &Value<'_>) -> Option<Vec<Handle>> {
    let name = text_of(table, "name")?;
    // The sides of openings in a turned wall are not parallel to the axes.
    if value_of(table, "turn_deg").is_some() {
        return None;
    }
    let [left, foot] = pair(text, value_of(table, "origin")?)?.map(|it| it.value);
    let brick = value_of(table, "brick")?;
    let height = text.number(value_of(brick, "height")?, &[])?.value;
    let course = height + bed(text, table).unwrap_or(0.0);
    let openings = value_of(table, "openings")?.get_ref().as_array()?;
    let of = |(index, it)| {
        opening(text, it, [left, foot], course, &format!("{name}, opening {}", index + 1))
    };
    Some(openings.iter().enumerate().filter_map(of).flatten().collect())
}

/// Returns the thickness of the bed joints of a wall with mortar.
fn bed(text: &Text<'_>, wall: &Value<'_>) -> Option<f64> {
    let class = value_of(wall, "joints").and_then(|it| text_of(it, "bed")).unwrap_or("bed");
    let joint = text.named("joints").into_iter().find(|(name, _)| *name == class)?.1;
    Some(text.number(value_of(joint, "thickness")?, &[])?.value)
}

/// Returns the handles of an opening: its place, its right side and its top.
fn opening(
    text: &Text<'_>,
    table: &Value<'_>,
    origin: [f64; 2],
    course: f64,
    name: &str,
) -> Option<Vec<Handle>> {
    let path = [Entry::Key("walls"), Entry::Item, Entry::Key("openings"), Entry::Item];
    let number =
        |key| text.number(value_of(table, key)?, &[&path[..], &[Entry::Key(key)]].concat());
    let (x, width, first, courses) =
        (number("x")?, number("width")?, number("course"), number("courses")?);
    let left = origin[0] + x.value;
    let bottom = origin[1] + course * first.map_or(0.0, |it| it.value - 1.0);
    let (right, top) = (left + width.value, bottom + course * courses.value);
    let handle = |part: &str, low, high, right: Option<Number>, up: Option<Number>| Handle {
        label: format!("{part} of {name}"),
        low,
        high,
        right: right.map(|it| Target::of(it, 1.0)).into_iter().collect(),
        up: up.map(|it| Target::of(it, 1.0 / course)).into_iter().collect(),
    };
    Some(vec![
        handle("place", [left, bottom], [right, top], Some(x), first),
        handle("right side", [right, bottom], [right, top], Some(width), None),
        handle("top", [left, top], [right, top], None, Some(courses)),
    ])
}

/// Returns the handles of the ends of a support.
fn support(text: &Text<'_>, table: &Value<'_>) -> Vec<Handle> {
    let end = |key: &str| {
        let at = pair(text, value_of(table, key)?)?;
        let [right, up] = at.map(|it| vec![Target::of(it, 1.0)]);
        let label = format!("{key} of support {}", text_of(table, "name")?);
        let place = at.map(|it| it.value);
        Some(Handle { label, low: place, high: place, right, up })
    };
    ["from", "to"].into_iter().filter_map(end).collect()
}

/// Reads a list of two numbers.
fn pair(text: &Text<'_>, value: &Value<'_>) -> Option<[Number; 2]> {
    let [x, y] = value.get_ref().as_array()?.as_ref() else { return None };
    Some([text.number(x, &[Entry::Item])?, text.number(y, &[Entry::Item])?])
}
