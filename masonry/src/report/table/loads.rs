//! The loads of a scene as a table, group by group.

use super::table;
use crate::model::Model;
use crate::report::format::{InUnits, aligned, significant};
use crate::report::summary::{Resultant, load_groups};

/// Loads with factor and resultant; groups of several loads with their sum.
pub(super) fn loads(model: &Model) -> String {
    let units = InUnits(model.units);
    let (force, energy) = (units.0.force_name(), units.0.energy_name());
    let heads = [
        "group",
        "load",
        "factor",
        &format!("fx [{force}]"),
        &format!("fy [{force}]"),
        &format!("m [{energy}]"),
    ];
    let mut rows: Vec<([String; 3], Resultant)> = Vec::new();
    for group in load_groups(model) {
        for (k, (load, resultant)) in group.loads.iter().enumerate() {
            let name = if k == 0 { group.name } else { "" };
            let texts = [name.to_owned(), load.name.clone(), significant(load.factor, 6)];
            rows.push((texts, *resultant));
        }
        if group.loads.len() > 1 {
            rows.push((["", "sum", ""].map(str::to_owned), group.sum));
        }
    }
    let forces: Vec<f64> = rows
        .iter()
        .flat_map(|(_, it)| [it.force.x, it.force.y])
        .map(|it| units.force(it))
        .collect();
    let moments: Vec<f64> = rows.iter().map(|(_, it)| units.energy(it.moment)).collect();
    let (forces, moments) = (aligned(&forces, 6), aligned(&moments, 6));
    let mut table = table(&heads, &[2, 3, 4, 5]);
    for (k, (texts, _)) in rows.iter().enumerate() {
        let [group, load, factor] = texts;
        table.add_row(vec![group, load, factor, &forces[2 * k], &forces[2 * k + 1], &moments[k]]);
    }
    table.trim_fmt() + "\n"
}
