//! The curve of a limit load: the factor against the displacement along the path.

use super::curve::{Chart, Curve, charts};
use crate::analysis::limit::{Path, Stand};
use crate::report::format::InUnits;

/// The load factors of the states at rest against their displacements, and the factor above which the structure falls.
/// `None` for less than two states.
pub fn path(title: &str, group: &str, path: &Path) -> Option<String> {
    let units = InUnits(path.model.units);
    let at = |it: &Stand| [units.length(it.displacement), it.load_factor];
    let points: Vec<[f64; 2]> = path.curve.iter().map(at).collect();
    let last = points.last()?[0];
    let mut curves = vec![Curve { name: "states at rest".to_owned(), points }];
    if let Some(falls) = path.falls.filter(|_| path.curve.len() > 1) {
        let points = vec![[0.0, falls], [last, falls]];
        curves.push(Curve { name: "falls".to_owned(), points });
    }
    let length = units.0.length_name();
    let axes = [format!("largest displacement [{length}]"), format!("factor of \"{group}\" [-]")];
    let chart = Chart { axes, curves, stages: Vec::new(), steps: Vec::new() };
    charts(&format!("{title}: load factor along the path"), &[chart])
}
