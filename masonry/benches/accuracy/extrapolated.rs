//! What finer and finer meshes converge to (Richardson 1911).

use masonry::analysis::study::{Mesh, MeshErrors, Values};
use nalgebra::Vector2;

/// Orders in the size of the elements in which values may converge. Below, differences fall too slowly to add
/// them up; above, they fell by accident: the energy of elements with linear displacements is of order two.
const ORDERS: std::ops::RangeInclusive<f64> = 0.5..=2.5;

/// A factor of the mesh, and a value on it.
pub(crate) type Value = (u32, Vector2<f64>);

/// The errors of all meshes against the limit of the three finest: larger than those against the finest mesh, which has an
/// error too.
pub(crate) fn errors(meshes: &[Mesh]) -> Vec<MeshErrors> {
    let of = |what: fn(Values) -> [f64; 2]| {
        let value = |mesh: &Mesh| Some((mesh.factor, mesh.values.map(what)?.into()));
        relative(&meshes.iter().map(value).collect::<Vec<_>>())
    };
    let energies = of(|it| [it.strain_energy, 0.0]);
    let [thrusts, moved] = [of(|it| [it.thrust, 0.0]), of(|it| it.displacement)];
    let errors = (0..meshes.len()).map(|k| MeshErrors {
        energy: energies[k],
        thrust: thrusts[k],
        displacement: moved[k],
    });
    errors.collect()
}

/// The relative errors of the values of all meshes.
pub(crate) fn relative(values: &[Option<Value>]) -> Vec<Option<f64>> {
    let limit = limit(values.iter().copied().flatten().collect());
    let error = |value: &Option<Value>| {
        let limit = limit?;
        let error = ((*value)?.1 - limit).norm() / limit.norm();
        error.is_finite().then_some(error)
    };
    values.iter().map(error).collect()
}

/// The limit of a value: its differences over the three finest meshes, which are to be refined evenly, go on to
/// fall by the same ratio. `None` where they do not fall, or not at a rate that can be trusted.
fn limit(mut values: Vec<Value>) -> Option<Vector2<f64>> {
    values.sort_by_key(|(factor, _)| *factor);
    values.dedup_by_key(|(factor, _)| *factor);
    let [.., coarse, fine, finest] = values[..] else { return None };
    let is_even = u64::from(fine.0).pow(2) == u64::from(coarse.0) * u64::from(finest.0);
    let [first, second] = [fine.1 - coarse.1, finest.1 - fine.1];
    let falls = first.norm() / second.norm();
    let order = falls.ln() / (f64::from(finest.0) / f64::from(fine.0)).ln();
    let is_regular = is_even && first.dot(&second) > 0.0 && ORDERS.contains(&order);
    is_regular.then(|| finest.1 + second / (falls - 1.0))
}
