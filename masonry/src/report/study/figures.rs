//! The records and the meshes of a study as tables.

use crate::analysis::study::{Errors, Mesh, Record, Study, Values};
use crate::report::figures::{Column, Digits, Table, values};
use crate::report::format::{InUnits, Quantity, significant};

/// A row for each mesh, route and tolerance: text has its own columns of tolerances and times.
pub(super) fn records<'a>(study: &Study, list: impl Iterator<Item = &'a Record>) -> Table {
    let right = |key| Column { is_right: true, ..Column::words(key) };
    let columns = vec![
        Column::count("mesh"),
        Column::words("route"),
        number("tolerance"),
        right("asked").named("tolerance"),
        Column::words("status"),
        number("residual"),
        Column::number("time", Quantity::Seconds, Digits::Power),
        right("took").named("time [s]"),
        Column::words("overrun"),
        Column::count("iterations").named("steps"),
        number("error_force").named("force"),
        number("error_stress").named("stress"),
        number("error_energy").named("energy"),
        Column::words("reason"),
    ];
    let mut table = Table::new(InUnits(study.units), columns);
    for it in list {
        let error = |of: fn(Errors) -> Option<f64>| it.errors.and_then(of);
        let took = it.seconds.map_or("-".to_owned(), |seconds| significant(seconds, 3));
        table.row(values![
            it.mesh as usize,
            it.route.name(),
            it.tolerance,
            format!("{:e}", it.tolerance),
            it.end.name(),
            it.residual,
            it.seconds,
            took + if it.overrun { " !" } else { "" },
            it.overrun,
            it.iterations,
            error(|it| it.force),
            error(|it| it.stress),
            error(|it| it.energy),
            it.end.reason(),
        ]);
    }
    table
}

fn number(key: &str) -> Column {
    Column::number(key, Quantity::Pure, Digits::Power)
}

/// A row for each mesh: values of its reference, and their errors.
pub(super) fn meshes(study: &Study) -> Table {
    let value = |key, quantity| Column::number(key, quantity, Digits::Significant(5));
    let columns = vec![
        Column::count("mesh"),
        Column::count("elements"),
        Column::words("reference"),
        value("energy", Quantity::Energy),
        number("error"),
        value("thrust", Quantity::Force),
        number("error"),
        value("moved", Quantity::Length),
        number("error"),
    ];
    let mut table = Table::new(InUnits(study.units), columns);
    for Mesh { factor, elements, reference, values, errors, .. } in &study.meshes {
        let value = |of: fn(Values) -> f64| values.map(of);
        table.row(values![
            *factor as usize,
            *elements,
            reference.as_ref().map(|it| it.route.name()),
            value(|it| it.strain_energy),
            errors.and_then(|it| it.energy),
            value(|it| it.thrust),
            errors.and_then(|it| it.thrust),
            value(|it| it.displacement[0].hypot(it.displacement[1])),
            errors.and_then(|it| it.displacement),
        ]);
    }
    table
}
