//! What finer and finer meshes converge to (Richardson 1911).

use super::{Mesh, MeshErrors, Values, relative};

/// Orders in the size of the elements in which values may converge. Below, differences fall too slowly to add
/// them up; above, they fell by accident: the energy of elements with linear displacements is of order two.
const ORDERS: std::ops::RangeInclusive<f64> = 0.5..=2.5;

/// Gives all meshes their errors against the limit of the three finest.
pub(super) fn add(meshes: &mut [Mesh]) {
    let of: [fn(&Values) -> f64; 3] = [|it| it.strain_energy, |it| it.thrust, |it| it.displacement];
    let limits = of.map(|of| limit(meshes, of));
    for mesh in meshes {
        let Some(values) = &mesh.values else { continue };
        let error = |k: usize| relative(&[of[k](values)], &[limits[k]?]);
        mesh.extrapolated = limits.iter().any(Option::is_some).then(|| MeshErrors {
            energy: error(0),
            thrust: error(1),
            displacement: error(2),
        });
    }
}

/// The limit of a value: its differences over the three finest meshes, which are to be refined evenly, go on to
/// fall by the same ratio. `None` where they do not fall, or not at a rate that can be trusted.
fn limit(meshes: &[Mesh], of: fn(&Values) -> f64) -> Option<f64> {
    let mut values: Vec<(u32, f64)> =
        meshes.iter().filter_map(|mesh| Some((mesh.factor, of(mesh.values.as_ref()?)))).collect();
    values.sort_by_key(|(factor, _)| *factor);
    values.dedup_by_key(|(factor, _)| *factor);
    let [.., coarse, fine, finest] = values[..] else { return None };
    let is_even = u64::from(fine.0).pow(2) == u64::from(coarse.0) * u64::from(finest.0);
    let falls = (fine.1 - coarse.1) / (finest.1 - fine.1);
    let order = falls.ln() / (f64::from(finest.0) / f64::from(fine.0)).ln();
    (is_even && ORDERS.contains(&order)).then(|| finest.1 + (finest.1 - fine.1) / (falls - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn meshes(values: &[(u32, f64)]) -> Vec<Mesh> {
        let mesh = |&(factor, energy)| Mesh {
            factor,
            name: String::new(),
            blocks: 1,
            elements: 1,
            contact_points: 0,
            refusal: None,
            reference: None,
            refinings: Vec::new(),
            values: Some(Values { strain_energy: energy, thrust: 0.0, displacement: 1.0 }),
            errors: None,
            extrapolated: None,
            corners: Vec::new(),
        };
        values.iter().map(mesh).collect()
    }

    fn energies(values: &[(u32, f64)]) -> Vec<Option<f64>> {
        let mut meshes = meshes(values);
        add(&mut meshes);
        meshes.iter().map(|mesh| mesh.extrapolated?.energy).collect()
    }

    #[test]
    fn a_power_of_the_size_is_extrapolated_exactly() {
        for order in [0.75, 1.0, 2.0] {
            let at = |factor: u32| (factor, 3.0 - f64::from(factor).powf(-order));
            // In any order, and coarser ones do not count.
            let found = energies(&[at(4), (1, 100.0), at(2), at(8)]);
            for (factor, found) in [4, 1, 2, 8].into_iter().zip(found) {
                let value = if factor == 1 { 100.0 } else { at(factor).1 };
                let expected = f64::abs(value - 3.0) / 3.0;
                assert!((found.unwrap() - expected).abs() < 1e-12 * expected.max(1.0), "{order}");
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
            assert_eq!(energies(&values), [None; 3], "{values:?}");
        }
        assert_eq!(energies(&[(1, 1.0), (2, 2.0)]), [None; 2]);
    }
}
