//! The Q4 element, block stiffness and loads against closed forms.

use crate::common;

use common::{YOUNG, block, model, rectangle, traction_on};
use faer::Side;
use masonry::analysis::outcome::Principal;
use masonry::element::quad4;
use masonry::geometry;
use masonry::ids::LoadId;
use masonry::material::constitutive;
use masonry::model::mesh::BlockMesh;
use masonry::model::{Acceleration, BlockLoad, Elasticity, Plane, PointLoad};
use masonry::system::rigid::Modes;
use masonry::system::{System, SystemError, nodal_loads, resultant};
use nalgebra::{Matrix2, Matrix3, Point2, SVector, Vector2, Vector3};

const E: Elasticity = Elasticity { young: 200.0, poisson: 0.3 };

fn skew() -> [Point2<f64>; 4] {
    [[0.1, -0.2], [2.3, 0.1], [1.9, 1.8], [-0.3, 1.2]].map(Point2::from)
}

#[test]
fn plane_stress_and_plane_strain_matrices() {
    let stress = constitutive(E, Plane::Stress);
    let scale = 200.0 / 0.91;
    let expected = Matrix3::new(1.0, 0.3, 0.0, 0.3, 1.0, 0.0, 0.0, 0.0, 0.35) * scale;
    assert!((stress - expected).amax() < 1e-12);
    let strain = constitutive(E, Plane::Strain);
    let scale = 200.0 / (1.3 * 0.4);
    let expected = Matrix3::new(0.7, 0.3, 0.0, 0.3, 0.7, 0.0, 0.0, 0.0, 0.2) * scale;
    assert!((strain - expected).amax() < 1e-12);
}

/// Displacements that are linear in the coordinates give the exact stress in every element and
/// no force at inner nodes.
#[test]
fn linear_displacements_pass_the_patch_test() {
    let mesh = BlockMesh::new(&skew(), 3, 2);
    let d = constitutive(E, Plane::Stress);
    let gradient = Matrix2::new(1e-3, 2e-3, -5e-4, 3e-3);
    let strain = Vector3::new(1e-3, 3e-3, 2e-3 - 5e-4);
    let mut forces = vec![Vector2::zeros(); mesh.nodes.len()];
    for element in &mesh.elements {
        let nodes = element.map(|n| mesh.nodes[n]);
        let u = SVector::<f64, 8>::from_fn(|i, _| (gradient * nodes[i / 2].coords)[i % 2]);
        let stress = quad4::stress_at_centre(&nodes, &d, &u).unwrap();
        assert!((stress - d * strain).amax() < 1e-13);
        let f = quad4::stiffness(&nodes, &d, 0.7).unwrap() * u;
        element.iter().enumerate().for_each(|(k, n)| forces[*n] += f.fixed_rows::<2>(2 * k));
    }
    let inner = [5, 6];
    assert!(inner.iter().all(|n| forces[*n].norm() < 1e-13));
    assert!(forces[0].norm() > 1e-2);
}

/// A triangle, a pentagon, hexagons, a rectangle with a corner on an edge, and an L.
fn polygons() -> Vec<Vec<Point2<f64>>> {
    let listed: [&[[f64; 2]]; 6] = [
        &[[0.0, 0.0], [2.0, 0.0], [0.7, 1.4]],
        &[[0.0, 0.0], [2.0, 0.0], [2.3, 0.8], [1.1, 1.7], [-0.2, 1.1]],
        &[[0.0, 0.0], [1.0, 0.0], [1.5, 0.75], [1.0, 1.5], [0.0, 1.5], [-0.5, 0.75]],
        &[[0.0, 0.0], [2.0, 0.0], [2.6, 0.3], [2.7, 0.9], [0.9, 1.9], [-0.3, 0.2]],
        &[[0.0, 0.0], [0.3, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]],
        &[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]],
    ];
    listed.map(|corners| corners.iter().copied().map(Point2::from).collect()).to_vec()
}

/// As [`linear_displacements_pass_the_patch_test`], for the patches of all polygons: no force at nodes that are not on the rim.
#[test]
fn linear_displacements_pass_the_patch_test_in_every_polygon() {
    let d = constitutive(E, Plane::Stress);
    let gradient = Matrix2::new(1e-3, 2e-3, -5e-4, 3e-3);
    let strain = Vector3::new(1e-3, 3e-3, 2e-3 - 5e-4);
    for corners in polygons() {
        for count in [1, 2, 3] {
            let mesh = BlockMesh::of(&corners, [count; 2]).unwrap();
            let mut forces = vec![Vector2::zeros(); mesh.nodes.len()];
            let mut area = 0.0;
            for element in &mesh.elements {
                let nodes = element.map(|n| mesh.nodes[n]);
                area += geometry::area(&nodes);
                let u = SVector::<f64, 8>::from_fn(|i, _| (gradient * nodes[i / 2].coords)[i % 2]);
                let stress = quad4::stress_at_centre(&nodes, &d, &u).unwrap();
                assert!((stress - d * strain).amax() < 1e-13);
                let f = quad4::stiffness(&nodes, &d, 0.7).unwrap() * u;
                element
                    .iter()
                    .enumerate()
                    .for_each(|(k, n)| forces[*n] += f.fixed_rows::<2>(2 * k));
            }
            assert!((area - geometry::area(&corners)).abs() < 1e-14 * area);
            let rim: Vec<usize> = mesh.rim().collect();
            let inner = (0..forces.len()).filter(|n| !rim.contains(n));
            assert!(
                inner.clone().count() > 0 && inner.into_iter().all(|n| forces[n].norm() < 1e-13)
            );
        }
    }
}

/// Euler: nodes, sides and elements of a polygon without holes; and every point has a place between four nodes.
#[test]
fn meshes_of_polygons_are_whole() {
    for corners in polygons() {
        let is_convex = geometry::check_convex(&corners).is_ok();
        let patches = if is_convex { corners.len() } else { 3 * corners.len() };
        for count in [1, 2, 5] {
            let mesh = BlockMesh::of(&corners, [count; 2]).unwrap();
            assert_eq!(mesh.elements.len(), patches * count * count);
            let rim = mesh.rim().count();
            assert_eq!(rim, 2 * count * corners.len());
            // Every side of an element is shared by two, or lies on the rim.
            let sides = 2 * mesh.elements.len() + rim / 2;
            assert_eq!(mesh.nodes.len() + mesh.elements.len(), sides + 1);
            assert!(mesh.corner_nodes().map(|node| mesh.nodes[node]).eq(corners.iter().copied()));
            let drawn: usize = mesh.lines().iter().map(|line| line.len() - 1).sum();
            assert_eq!(drawn, sides - rim);
            for edge in 0..corners.len() {
                for (node, at) in mesh.edge_nodes(edge).iter().zip(mesh.edge_fractions(edge)) {
                    let place = geometry::on_edge(&corners, edge, at);
                    assert!((mesh.nodes[*node] - place).norm() < 1e-15 * 4.0);
                }
            }
            let places =
                (0..30).flat_map(|i| (0..20).map(move |j| [i, j].map(|k| 0.1 * f64::from(k))));
            let places = places.map(|[x, y]| Point2::new(x - 0.5, y));
            for place in places.filter(|it| geometry::outside(&corners, *it) <= 0.0) {
                let shares = mesh.interpolate_inside(place);
                assert!(shares.iter().all(|(_, share)| *share >= 0.0));
                let back: Vector2<f64> =
                    shares.iter().map(|(node, share)| mesh.nodes[*node].coords * *share).sum();
                assert!((back - place.coords).norm() < 1e-13, "{place} is {back}");
            }
        }
    }
    assert!(BlockMesh::of(&polygons()[0], [1, 2]).is_none());
    let hollow = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [2.5, 3.0],
        [2.5, 0.5],
        [0.5, 0.5],
        [0.5, 3.0],
        [0.0, 3.0],
    ];
    assert!(BlockMesh::of(&hollow.map(Point2::from), [1, 1]).is_none());
}

#[test]
fn rectangle_stretched_uniformly_stores_the_exact_energy() {
    let nodes = rectangle("r", [0.0, 3.0], [0.0, 2.0], None).corners;
    let nodes: geometry::Quad = nodes.try_into().unwrap();
    let d = constitutive(Elasticity { young: 200.0, poisson: 0.0 }, Plane::Stress);
    let u = SVector::<f64, 8>::from_fn(|i, _| if i % 2 == 0 { 0.01 * nodes[i / 2].x } else { 0.0 });
    let k = quad4::stiffness(&nodes, &d, 0.5).unwrap();
    let energy = 0.5 * (u.transpose() * k * u)[0];
    assert!((energy - 0.5 * 200.0 * 1e-4 * 6.0 * 0.5).abs() < 1e-14);
}

#[test]
fn folded_elements_are_refused() {
    let [a, b, _, d] = skew();
    let folded = [a, b, a + (b - a) * 0.2 + (d - a) * 0.1, d];
    let d = constitutive(E, Plane::Stress);
    assert!(quad4::stiffness(&folded, &d, 1.0).is_none());
}

/// A free block has three zero modes, not more and not fewer, and all else is positive.
#[test]
fn stiffness_has_exactly_three_zero_modes() {
    for divisions in [[1, 1], [3, 2]] {
        let model = model(vec![block("skew", skew(), Some(divisions))], vec![], 0.5);
        let system = System::new(&model).unwrap();
        let k = &system.stiffnesses[0].matrix.to_dense();
        let values = k.self_adjoint_eigenvalues(Side::Lower).unwrap();
        let largest = values[values.len() - 1];
        assert!(values[..3].iter().all(|v| v.abs() < 1e-14 * largest));
        assert!(values[3] > 1e-3 * largest, "{:?}", &values[..5]);
        let mesh = model.blocks[0].mesh.as_ref().unwrap();
        let modes = Modes::of(&skew());
        for mode in 0..3 {
            let u: Vec<f64> =
                mesh.nodes.iter().flat_map(|p| <[f64; 2]>::from(modes.at(*p)[mode])).collect();
            for i in 0..u.len() {
                let force: f64 = u.iter().enumerate().map(|(j, u)| k[(i, j)] * u).sum();
                assert!(force.abs() < 1e-13 * largest);
            }
        }
    }
}

/// `K K^+ K = K`.
#[test]
fn generalised_inverse() {
    let model = model(vec![block("skew", skew(), Some([2, 3]))], vec![], 0.5);
    let stiffness = &System::new(&model).unwrap().stiffnesses[0];
    let k = &stiffness.matrix.to_dense();
    let back = k * stiffness.solve(k);
    assert!((&back - k).norm_max() < 1e-13 * k.norm_max());
}

#[test]
fn equal_blocks_share_a_stiffness() {
    let panel = common::panel(1, &[[0.0, 1.0]]);
    assert_eq!(System::new(&panel).unwrap().stiffnesses.len(), 2);
    let panel = common::panel(2, &[[0.0, 1.0]]);
    assert_eq!(System::new(&panel).unwrap().stiffnesses.len(), 2);
}

#[test]
fn nodal_loads_have_the_geometric_resultant() {
    let mut loaded = block("skew", skew(), Some([3, 2]));
    loaded.density = Some(2000.0);
    let parts = [[0.0, 1.0], [0.3, 0.45], [0.1, 0.9], [0.0, 1.0]];
    let traction = |(edge, part)| traction_on(edge, part, [1e3, -3e3]);
    loaded.loads = parts.into_iter().enumerate().map(traction).collect();
    for load in &mut loaded.loads {
        let BlockLoad::Edge(load) = load else { continue };
        load.traction[1] = Vector2::new(-2e3, 5e2);
    }
    let at = |at: Point2<f64>, force: [f64; 2]| {
        PointLoad { at, force: force.into(), moment: 70.0, load: LoadId(0) }.into()
    };
    loaded.loads.push(at(geometry::centroid(&skew()), [2e3, 1e3]));
    loaded.loads.push(at(geometry::on_edge(&skew(), 1, 0.4), [-1e3, 5e2]));
    let mut model = model(vec![loaded.clone()], vec![], 0.5);
    model.gravity = Vector2::new(1.5, -9.81);
    model.accelerations = vec![Acceleration { value: Vector2::new(0.7, 0.4), load: LoadId(0) }];
    model.thickness = 0.3;
    let mesh = loaded.mesh.as_ref().unwrap();
    let load = nodal_loads(&model, &loaded, mesh);
    let modes = Modes::of(&loaded.corners);
    let mut work = [0.0; 3];
    for (n, place) in mesh.nodes.iter().enumerate() {
        let force = Vector2::new(load[2 * n], load[2 * n + 1]);
        let add = modes.resultant(*place, force);
        work.iter_mut().zip(add).for_each(|(w, a)| *w += a);
    }
    let expected = resultant(&model, &loaded);
    let size = expected.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    work.iter().zip(expected).for_each(|(w, e)| assert!((w - e).abs() < 1e-14 * size));
}

/// Shape functions at a place are those of the element that holds it: they add up to one, give the place back, and
/// on an edge are those of the edge.
#[test]
fn places_of_a_block_and_their_shape_functions() {
    // A parallelogram, a trapezium that widens fourfold, one that narrows, and thin and flat ones far from the origin.
    let trapezium = [[0.0, 0.0], [1.0, 0.0], [2.5, 1.0], [-1.5, 1.0]];
    let narrows = [[0.0, 0.0], [4.0, 0.0], [2.5, 1.0], [1.5, 1.0]];
    let thin = [[1e3, 1e3], [1e3 + 50.0, 1e3], [1e3 + 50.0, 1e3 + 0.01], [1e3, 1e3 + 0.02]];
    let slanted = [[0.0, 0.0], [2.0, 1.0], [1.5, 2.5], [-0.5, 1.5]];
    let quads = [trapezium, narrows, thin, slanted].map(|quad| quad.map(Point2::from));
    for corners in quads.into_iter().chain([skew()]) {
        let mesh = BlockMesh::new(&corners, 3, 4);
        let size = geometry::size(&corners);
        let places = (0..=8).flat_map(|i| (0..=8).map(move |j| [i, j].map(|k| f64::from(k) / 8.0)));
        for [r, s] in places {
            let [a, b, c, d] = corners.map(|p| p.coords);
            let place =
                Point2::from((a * (1.0 - r) + b * r) * (1.0 - s) + (d * (1.0 - r) + c * r) * s);
            let found = geometry::reference(&corners, place);
            // What rounding makes of the place is a part of the shortest edge.
            assert!(
                (found[0] - r).abs() < 1e-10 && (found[1] - s).abs() < 1e-10,
                "{found:?} for {r}, {s}"
            );
            assert!(geometry::outside(&corners, place) < 1e-13 * (size + place.coords.norm()));
            let shares = mesh.interpolate_inside(place);
            let sum: f64 = shares.iter().map(|(_, share)| share).sum();
            let back: Vector2<f64> =
                shares.iter().map(|(node, share)| mesh.nodes[*node].coords * *share).sum();
            assert!(
                (sum - 1.0).abs() < 1e-15
                    && (back - place.coords).norm() < 1e-15 * back.norm().max(4.0 * size)
            );
        }
        for edge in 0..4 {
            let place = geometry::on_edge(&corners, edge, 0.3);
            let on_edge = mesh.interpolate(edge, 0.3);
            for (node, share) in mesh.interpolate_inside(place) {
                let expected: f64 =
                    on_edge.iter().filter(|(of, _)| *of == node).map(|(_, share)| share).sum();
                // As above: rounding of the place is a part of the shortest edge.
                assert!((share - expected).abs() < 1e-10, "edge {edge}, node {node}");
            }
        }
    }
}

#[test]
fn bad_material_and_missing_mesh_are_named() {
    let mut bad = rectangle("bad brick", [0.0, 1.0], [0.0, 1.0], Some([1, 1]));
    bad.elasticity = Some(Elasticity { young: -YOUNG, poisson: 0.2 });
    let error = System::new(&model(vec![bad.clone()], vec![], 0.5)).unwrap_err();
    assert!(matches!(&error, SystemError::NotElastic { block, .. } if block == "bad brick"));
    bad.mesh = None;
    let error = System::new(&model(vec![bad], vec![], 0.5)).unwrap_err();
    assert!(matches!(&error, SystemError::NoMesh { block } if block == "bad brick"));
}

#[test]
fn principal_stresses() {
    let p = Principal::of([-2.0, -10.0, 3.0]);
    assert!((p.sigma_1 + 1.0).abs() < 1e-15 && (p.sigma_2 + 11.0).abs() < 1e-15);
    assert!((p.theta - 0.5 * 6.0_f64.atan2(8.0)).abs() < 1e-15);
    let quarter = std::f64::consts::FRAC_PI_4;
    assert!((Principal::of([0.0, 0.0, -1.0]).theta + quarter).abs() < 1e-15);
    for zero in [0.0, -0.0] {
        assert!((Principal::of([-1.0, 2.0, zero]).theta - 2.0 * quarter).abs() < 1e-15);
    }
}
