//! The load history as a table of comma-separated values.

use std::borrow::Cow;

use super::quoted;
use crate::history::History;
use crate::model::Model;
use crate::report::format::{InUnits, shortest};

/// The text of `history.csv`: one row per step that was solved.
///
/// Columns carry the units of the scene in their names, here m and kN:
///
/// * `stage` and `step` (from 1 in each stage);
/// * the factor `gravity`, and a factor `load NAME` for each load;
/// * `SUPPORT x_m`, `SUPPORT y_m` and `SUPPORT turn_rad` for each support;
/// * `work_kJ`, `dissipation_kJ`, `friction_power` and `energy_created_kJ` of the step;
/// * `strain_energy_kJ` and `max_displacement_m` after it;
/// * the numbers `open`, `stick` and `slip` of contact points;
/// * `SUPPORT fx_kN`, `SUPPORT fy_kN` and `SUPPORT m_kNm` (about the origin) for each support;
/// * the `residual`, the `way` in which the step was found (`law` or `motion`), and its `factorisations`.
pub fn history(model: &Model, history: &History) -> String {
    let units = InUnits(model.units);
    let mut text = header(model, history, units);
    for record in &history.records {
        let actions = &record.step.actions;
        let mut numbers = vec![actions.gravity];
        numbers.extend(&actions.loads);
        for moved in &actions.movements {
            numbers.extend([units.length(moved.x), units.length(moved.y), moved.turn]);
        }
        numbers.extend([record.work, record.dissipation].map(|e| units.energy(e)));
        let power = record.friction_power.map_or_else(String::new, shortest);
        let after = [
            units.energy(record.energy_created),
            units.energy(record.strain_energy),
            units.length(record.largest_displacement),
        ];
        let counts = record.contacts.map(|count| count.to_string());
        let reactions = record.reactions.iter().flat_map(|it| {
            [units.force(it.fx), units.force(it.fy), units.energy(it.m)].map(shortest)
        });
        let fields: Vec<String> = [quoted(&record.step.stage).into_owned()]
            .into_iter()
            .chain([record.step.number.to_string()])
            .chain(numbers.into_iter().map(shortest))
            .chain([power])
            .chain(after.map(shortest))
            .chain(counts)
            .chain(reactions)
            .chain([shortest(record.residuals.worst())])
            .chain([record.way.name().to_owned(), record.factorisations.to_string()])
            .collect();
        text += &fields.join(",");
        text += "\r\n";
    }
    text
}

fn header(model: &Model, history: &History, units: InUnits) -> String {
    let (length, force) = (units.0.length_name(), units.0.force_name());
    let energy = units.0.energy_name();
    let supports = || model.supports.iter().map(|support| support.name.as_str());
    let mut heads = vec!["stage".to_owned(), "step".to_owned(), "gravity".to_owned()];
    heads.extend(history.loads.iter().map(|name| format!("load {name}")));
    let moves = ["x", "y"].map(|axis| format!("{axis}_{length}"));
    heads.extend(supports().flat_map(|name| {
        [moves[0].as_str(), &moves[1], "turn_rad"].map(|column| format!("{name} {column}"))
    }));
    heads.extend(["work", "dissipation"].map(|it| format!("{it}_{energy}")));
    heads.push("friction_power".to_owned());
    heads.extend(["energy_created", "strain_energy"].map(|it| format!("{it}_{energy}")));
    heads.push(format!("max_displacement_{length}"));
    heads.extend(["open", "stick", "slip"].map(str::to_owned));
    let forces = [format!("fx_{force}"), format!("fy_{force}"), format!("m_{energy}")];
    heads.extend(supports().flat_map(|name| forces.each_ref().map(|it| format!("{name} {it}"))));
    heads.extend(["residual", "way", "factorisations"].map(str::to_owned));
    let heads: Vec<Cow<'_, str>> = heads.iter().map(|head| quoted(head)).collect();
    heads.join(",") + "\r\n"
}
