//! The curve of a limit load: the factor against the displacement along the path.

use super::diagram::{Chart, Look, Series, charts};
use crate::analysis::limit::Path;
use crate::report::figures::limit::curve;

/// The load factors of the states at rest against their displacements, and the factor above which the structure falls.
/// `None` for less than two states.
pub fn path(title: &str, group: &str, path: &Path) -> Option<String> {
    let table = curve(path);
    let displacements = table.numbers("displacement");
    let points = displacements.iter().copied().zip(table.numbers("load_factor"));
    let points = points.map(|(x, y)| [x, y]).collect();
    let last = *displacements.last()?;
    let mut series =
        vec![Series { name: "states at rest".to_owned(), style: 0, look: Look::Full, points }];
    if let Some(falls) = path.falls.filter(|_| path.curve.len() > 1) {
        let points = vec![[0.0, falls], [last, falls]];
        series.push(Series { name: "falls".to_owned(), style: 1, look: Look::Bound, points });
    }
    let length = path.model.units.length_name();
    let axes = [format!("largest displacement [{length}]"), format!("factor of \"{group}\" [-]")];
    charts(&format!("{title}: load factor along the path"), &[Chart::of(axes, series)])
}
