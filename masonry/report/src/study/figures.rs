//! The records and the meshes of a study as tables.

use crate::figures::Digits::{Power, Significant};
use crate::figures::{Columns, Table};
use crate::format::Quantity::{Energy, Force, Length, Pure};
use crate::format::{InUnits, significant};
use masonry::analysis::study::{Mesh, Record, Study};

/// Returns a table with a row for each record of a study; the text report has its own columns of tolerances and times.
pub(super) fn records<'a>(study: &Study, list: impl Iterator<Item = &'a Record>) -> Table {
    let took = |it: &&Record| it.seconds.map_or("-".to_owned(), |it| significant(it, 3));
    Columns::<&Record>::new()
        .count("mesh", |it| it.mesh as usize)
        .words("route", |it| it.route.name())
        .number("tolerance", Pure, Power, |it| it.tolerance)
        .count("asked", |it| format!("{:e}", it.tolerance))
        .named("tolerance")
        .words("status", |it| it.end.name())
        .number("residual", Pure, Power, |it| it.residual)
        .number("time_s", Pure, Power, |it| it.seconds)
        .count("took", move |it| took(it) + if it.overrun { " !" } else { "" })
        .named("time [s]")
        .words("overrun", |it| it.overrun)
        .count("iterations", |it| it.iterations)
        .named("steps")
        .number("error_force", Pure, Power, |it| it.errors?.force)
        .named("force")
        .number("error_stress", Pure, Power, |it| it.errors?.stress)
        .named("stress")
        .number("error_energy", Pure, Power, |it| it.errors?.energy)
        .named("energy")
        .words("reason", |it| it.end.reason())
        .table(InUnits(study.units), list)
}

/// Returns a table with a row for each mesh: values of its reference solution, and their errors.
pub(super) fn meshes(study: &Study) -> Table {
    let moved = |[x, y]: [f64; 2]| x.hypot(y);
    Columns::<&Mesh>::new()
        .count("mesh", |it| it.factor as usize)
        .count("elements", |it| it.elements)
        .words("reference", |it| it.reference.as_ref().map(|it| it.route.name()))
        .number("energy", Energy, Significant(5), |it| it.values.map(|it| it.strain_energy))
        .number("error", Pure, Power, |it| it.errors?.energy)
        .number("thrust", Force, Significant(5), |it| it.values.map(|it| it.thrust))
        .number("error", Pure, Power, |it| it.errors?.thrust)
        .number("moved", Length, Significant(5), move |it| {
            it.values.map(|it| moved(it.displacement))
        })
        .number("error", Pure, Power, |it| it.errors?.displacement)
        .table(InUnits(study.units), &study.meshes)
}
