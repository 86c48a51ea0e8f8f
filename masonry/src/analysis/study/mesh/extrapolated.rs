//! What finer and finer meshes converge to (Richardson 1911).

use nalgebra::Vector2;

use super::{Mesh, MeshErrors};

/// Orders in the size of the elements in which values may converge. Below, differences fall too slowly to add
/// them up; above, they fell by accident: the energy of elements with linear displacements is of order two.
const ORDERS: std::ops::RangeInclusive<f64> = 0.5..=2.5;

/// Gives all meshes their errors against the limit of the three finest; `moved` are the displacements.
pub(super) fn add(meshes: &mut [Mesh], moved: &[Option<Vector2<f64>>]) {
    let number = |value: f64| Vector2::new(value, 0.0);
    let of = |what: fn(&Mesh) -> Option<f64>| -> Vec<Option<Vector2<f64>>> {
        meshes.iter().map(|mesh| what(mesh).map(number)).collect()
    };
    let energies = of(|mesh| Some(mesh.values?.strain_energy));
    let thrusts = of(|mesh| Some(mesh.values?.thrust));
    let factors: Vec<u32> = meshes.iter().map(|mesh| mesh.factor).collect();
    let [energies, thrusts, moved] =
        [&energies, &thrusts, moved].map(|values| errors(&factors, values));
    for (k, mesh) in meshes.iter_mut().enumerate() {
        let errors = MeshErrors { energy: energies[k], thrust: thrusts[k], displacement: moved[k] };
        mesh.extrapolated = errors.worst().map(|_| errors);
    }
}

/// The relative errors of the values of all meshes.
fn errors(factors: &[u32], values: &[Option<Vector2<f64>>]) -> Vec<Option<f64>> {
    let known = factors.iter().zip(values);
    let limit = limit(known.filter_map(|(factor, value)| Some((*factor, (*value)?))).collect());
    let error = |value: &Option<Vector2<f64>>| {
        let limit = limit?;
        Some(((*value)? - limit).norm() / limit.norm()).filter(|error| error.is_finite())
    };
    values.iter().map(error).collect()
}

/// The limit of a value: its differences over the three finest meshes, which are to be refined evenly, go on to
/// fall by the same ratio. `None` where they do not fall, or not at a rate that can be trusted.
fn limit(mut values: Vec<(u32, Vector2<f64>)>) -> Option<Vector2<f64>> {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn found(values: &[(u32, f64)]) -> Vec<Option<f64>> {
        let (factors, values): (Vec<u32>, Vec<f64>) = values.iter().copied().unzip();
        let along = |value: f64| Some(value * Vector2::new(3.0, -4.0));
        errors(&factors, &values.into_iter().map(along).collect::<Vec<_>>())
    }

    #[test]
    fn a_power_of_the_size_is_extrapolated_exactly() {
        for order in [0.75, 1.0, 2.0] {
            let at = |factor: u32| (factor, 3.0 - f64::from(factor).powf(-order));
            // In any order, and coarser ones do not count.
            let errors = found(&[at(4), (1, 100.0), at(2), at(8)]);
            for (factor, error) in [4, 1, 2, 8].into_iter().zip(errors) {
                let value = if factor == 1 { 100.0 } else { at(factor).1 };
                let expected = f64::abs(value - 3.0) / 3.0;
                assert!((error.unwrap() - expected).abs() < 1e-12 * expected.max(1.0), "{order}");
            }
        }
    }

    #[test]
    fn what_does_not_converge_is_not_extrapolated() {
        for values in [
            [(1, 1.0), (2, 3.0), (4, 2.0)],
            [(1, 1.0), (2, 2.0), (4, 4.0)],
            [(1, 1.0), (2, 2.0), (4, 2.9)],
            [(1, 1.0), (2, 2.0), (4, 2.001)],
            [(1, 1.0), (2, 1.0), (4, 1.0)],
            [(1, 1.0), (2, 2.0), (3, 2.4)],
        ] {
            assert_eq!(found(&values), [None; 3], "{values:?}");
        }
        assert_eq!(found(&[(1, 1.0), (2, 2.0)]), [None; 2]);
    }
}
