//! The sliders of a scene: friction of joint classes, factors of load groups, thicknesses of arches.

use serde::{Deserialize, Serialize};

use super::schema::Entry;
use super::text::{Number, Text, Value, text_of, value_of};

/// A slider that changes one or several numbers of the text.
#[derive(Debug, Serialize)]
pub(super) struct Control {
    label: String,
    value: f64,
    /// Whether the numbers differ, so that `value` is only the largest of them.
    is_largest: bool,
    /// The value at the right end of the slider; the left end is zero.
    most: f64,
    /// The places in the text at which the number is written.
    edits: Vec<Edit>,
}

/// A place in the text at which a number is written. Positions are in UTF-16 code units.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Edit {
    pub(super) from: usize,
    pub(super) to: usize,
    /// The text to write before the number if the text does not have the key yet.
    pub(super) before: String,
    /// The number to write, divided by the number of the control.
    pub(super) part: f64,
}

impl Edit {
    pub(super) fn of(number: Number) -> Self {
        Self { from: number.from, to: number.to, before: String::new(), part: 1.0 }
    }
}

/// The right end of a slider for a coefficient of friction; rough rock has larger coefficients.
const MOST_FRICTION: f64 = 1.2;
/// The right end of a slider for an angle of friction \[degrees\]: the angle of `MOST_FRICTION`, rounded up.
const MOST_ANGLE: f64 = 60.0;
/// The usual right end of a slider for a load factor.
const MOST_FACTOR: f64 = 3.0;

/// Returns all sliders of a scene.
pub(super) fn controls(text: &Text<'_>) -> Vec<Control> {
    [friction(text), factors(text), thicknesses(text)].into_iter().flatten().collect()
}

fn friction(text: &Text<'_>) -> Vec<Control> {
    let mut list = Vec::new();
    for (key, sign, most) in [("mu", "μ", MOST_FRICTION), ("phi_deg", "φ [°]", MOST_ANGLE)] {
        let of_class = |(class, table): (&str, &Value<'_>)| {
            let path = [Entry::Key("joints"), Entry::Key(class), Entry::Key(key)];
            let number = text.number(value_of(table, key)?, &path)?;
            Some(Control {
                label: format!("{sign} of {class}"),
                value: number.value,
                is_largest: false,
                most: at_least(most, number.value),
                edits: vec![Edit::of(number)],
            })
        };
        let classes: Vec<Control> = text.named("joints").into_iter().filter_map(of_class).collect();
        let all = together(&classes, sign);
        list.extend(classes.into_iter().chain(all));
    }
    list
}

/// Returns a slider that changes the friction of all classes at once and keeps their ratios; its value is the largest
/// of them. `None` for fewer than two classes.
fn together(classes: &[Control], sign: &str) -> Option<Control> {
    let largest = classes.iter().max_by(|a, b| a.value.total_cmp(&b.value))?;
    let (value, most) = (largest.value, largest.most);
    let part = |it: &Control| if value == 0.0 { 1.0 } else { it.value / value };
    let edit = |it: &Control| {
        it.edits.iter().map(|edit| Edit { part: part(it), ..edit.clone() }).collect()
    };
    let edits: Vec<Vec<Edit>> = classes.iter().map(edit).collect();
    let label = format!("{sign} of all joints");
    let is_largest = classes.iter().any(|it| it.value < value);
    (classes.len() > 1).then(|| Control { label, value, is_largest, most, edits: edits.concat() })
}

/// Returns a slider for every group of loads, which changes all factors of the group and keeps their ratios.
fn factors(text: &Text<'_>) -> Vec<Control> {
    let mut list: Vec<Control> = Vec::new();
    for load in &text.tables("loads") {
        let Some(name) = text_of(load, "name") else { continue };
        let label = format!("factor of {}", text_of(load, "group").unwrap_or(name));
        let Some((value, edit)) = factor(text, load) else { continue };
        match list.iter_mut().find(|it| it.label == label) {
            Some(control) => {
                let part = if control.value == 0.0 { 1.0 } else { value / control.value };
                control.edits.push(Edit { part, ..edit });
            }
            None => {
                list.push(Control {
                    label,
                    value,
                    is_largest: false,
                    most: at_least(MOST_FACTOR, value),
                    edits: vec![edit],
                });
            }
        }
    }
    list
}

/// Returns the factor of a load and the place of its number; 1 and the place for a new key if the text has no factor.
fn factor(text: &Text<'_>, load: &Value<'_>) -> Option<(f64, Edit)> {
    if let Some(number) = text.number_in("loads", load, &[Entry::Key("factor")]) {
        return Some((number.value, Edit::of(number)));
    }
    let name = load.get_ref().as_table()?.get("name")?;
    let (at, separator) = text.room_after(load, name);
    Some((1.0, Edit { from: at, to: at, before: format!("{separator}factor = "), part: 1.0 }))
}

fn thicknesses(text: &Text<'_>) -> Vec<Control> {
    let of = |arch: &&Value<'_>| {
        let number = text.number_in("arches", arch, &[Entry::Key("thickness")])?;
        let label = format!("thickness of {}", text_of(arch, "name")?);
        Some(Control {
            label,
            value: number.value,
            is_largest: false,
            most: 2.0 * number.value,
            edits: vec![Edit::of(number)],
        })
    };
    text.tables("arches").iter().filter_map(of).collect()
}

/// Returns the usual end of a slider, or twice the value if the value has reached that end.
fn at_least(usual: f64, value: f64) -> f64 {
    if value >= usual { 2.0 * value } else { usual }
}
