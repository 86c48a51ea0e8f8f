//! The sliders of a scene: friction of joint classes, factors of load groups, thicknesses of arches.

use serde::{Deserialize, Serialize};

use super::schema::Entry;
use super::text::{Number, Text, Value, text_of, value_of};

/// A slider.
#[derive(Debug, Serialize)]
pub(super) struct Control {
    label: String,
    value: f64,
    /// Whether the controlled numbers differ; `value` is the largest of them.
    is_largest: bool,
    /// The end of the slider, which begins at zero.
    most: f64,
    /// The places of the text that get the number.
    edits: Vec<Edit>,
}

/// A place of the text that gets a new number. Places are in units of UTF-16.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Edit {
    pub(super) from: usize,
    pub(super) to: usize,
    /// The text to write before the number, if the key is not there yet.
    pub(super) before: String,
    /// The number is this factor times the number of the control.
    pub(super) part: f64,
}

impl Edit {
    pub(super) fn of(number: Number) -> Self {
        Self { from: number.from, to: number.to, before: String::new(), part: 1.0 }
    }
}

/// A larger coefficient of friction is that of rough rock.
const MOST_FRICTION: f64 = 1.2;
/// The angle of that coefficient of friction, rounded up.
const MOST_ANGLE: f64 = 60.0;
/// The usual end of the slider of a load factor.
const MOST_FACTOR: f64 = 3.0;

/// All sliders of a scene.
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

/// A slider for the friction of all classes, if there are several: its value is the largest, and their ratios stay.
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

/// A slider for every group of loads, which keeps the ratios of the factors within it.
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

/// The factor of a load, and the place of its number, which may still be missing.
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

/// The usual end of a slider, or twice a value that has reached it.
fn at_least(usual: f64, value: f64) -> f64 {
    if value >= usual { 2.0 * value } else { usual }
}
