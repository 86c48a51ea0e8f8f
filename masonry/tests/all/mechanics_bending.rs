//! Slender blocks in bending: what meshes of four-node elements make of beam theory.

use masonry::element::{quad4, quadrature};
use masonry::material::constitutive;
use masonry::model::bending::Bending;
use masonry::model::mesh::BlockMesh;
use masonry::model::{Elasticity, Model, Plane};
use masonry::scene::{Block, Joint, Material, Scene, Support};
use masonry::units::Units;
use nalgebra::{DMatrix, DVector, Matrix3, Point2, SVector, Vector3};

const NU: f64 = 0.3;

fn d() -> Matrix3<f64> {
    constitutive(Elasticity { young: 200.0, poisson: NU }, Plane::Stress)
}

fn points(corners: &[[f64; 2]]) -> Vec<Point2<f64>> {
    corners.iter().copied().map(Point2::from).collect()
}

/// The energy that the stress `y` along x stores by that which nodes take under it: the quotient of the stiffnesses of the mesh and
/// of the block, whose centroid is on the x axis. The displacements are solved for.
fn measured(mesh: &BlockMesh) -> f64 {
    let count = 2 * mesh.nodes.len();
    let (mut k, mut f, mut exact) = (DMatrix::zeros(count, count), DVector::zeros(count), 0.0);
    for element in &mesh.elements {
        let nodes = element.map(|node| mesh.nodes[node]);
        let stiffness = quad4::stiffness(&nodes, &d(), 1.0).unwrap();
        let mut force = SVector::<f64, 8>::zeros();
        for place in quadrature::square() {
            let (b, determinant) = quad4::strain_matrix(&nodes, place).unwrap();
            let y: f64 = nodes.iter().zip(quad4::shape(place)).map(|(it, n)| it.y * n).sum();
            force += b.transpose() * Vector3::new(y, 0.0, 0.0) * determinant;
            exact += y * y / 200.0 * determinant;
        }
        let at = |i: usize| 2 * element[i / 2] + i % 2;
        for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (i, j))) {
            k[(at(i), at(j))] += stiffness[(i, j)];
        }
        (0..8).for_each(|i| f[at(i)] += force[i]);
    }
    // Rigid motions have no force; each gets a stiffness.
    for mode in 0..3 {
        let motion = DVector::from_fn(count, |i, _| {
            let node = mesh.nodes[i / 2];
            [[1.0, 0.0], [0.0, 1.0], [-node.y, node.x]][mode][i % 2]
        });
        k += &motion * motion.transpose();
    }
    let u = k.cholesky().unwrap().solve(&f);
    exact / f.dot(&u)
}

/// R. D. Cook et al., Concepts and Applications of Finite Element Analysis, for elements in rows.
#[test]
fn rectangles_are_too_stiff_by_the_known_factor() {
    for (length, divisions) in [(8.0, [4, 4]), (8.0, [16, 2]), (5.0, [3, 1]), (1.0, [2, 2])] {
        let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
        let corners = points(&corners.map(|[x, y]| [length * x, y]));
        let mesh = BlockMesh::of(&corners, divisions).unwrap();
        let [along, rows] = divisions.map(|it| it as f64);
        let expected = 1.0
            + (length / along).powi(2) / (2.0 * (1.0 + NU))
            + NU * NU / ((1.0 - NU * NU) * rows * rows);
        let found = Bending::of(&mesh, &d()).unwrap();
        assert!((found.stiffness / expected - 1.0).abs() < 1e-12, "{found:?} and {expected}");
        assert!((found.slenderness - length).abs() < 1e-12);
        // Nodes of inner rows may still move.
        let part = measured(&mesh) / expected;
        let least = if divisions[1] > 2 { 0.98 } else { 1.0 - 1e-9 };
        assert!(part > least && part < 1.0 + 1e-9, "{part} of {found:?}");
    }
}

/// Meshes of other polygons are no stiffer than is said.
#[test]
fn other_meshes_are_no_stiffer_than_the_bound() {
    let listed: [&[[f64; 2]]; 4] = [
        &[[-4.0, 0.0], [-3.5, -0.5], [3.5, -0.5], [4.0, 0.0], [3.5, 0.5], [-3.5, 0.5]],
        &[[-4.0, -0.5], [4.0, -0.5], [4.0, 0.2], [3.7, 0.5], [-3.7, 0.5], [-4.0, 0.2]],
        &[[-4.0, -0.3], [4.0, -0.6], [4.0, 0.6], [-4.0, 0.3]],
        &[[-4.0, -0.5], [4.0, -0.5], [4.0, 0.5], [0.0, 0.7], [-4.0, 0.5]],
    ];
    for corners in listed {
        for count in [2, 4, 8] {
            let mesh = BlockMesh::of(&points(corners), [count; 2]).unwrap();
            let found = Bending::of(&mesh, &d()).unwrap();
            let part = measured(&mesh) / found.stiffness;
            let least = if count < 8 { 0.2 } else { 0.75 };
            assert!(part > least && part <= 1.0, "{part} of {found:?}");
        }
    }
}

/// A corner on a straight edge, such as that of a neighbour that ends there, changes neither the mesh nor the numbers that it takes.
#[test]
fn corners_on_straight_edges_do_not_change_the_mesh() {
    let scene = |corners: &[[f64; 2]]| {
        Scene::new("Lintel", Units::SI)
            .plane(Plane::Stress)
            .thickness(0.3)
            .gravity([0.0, -9.81])
            .material("stone", Material::elastic(2e10, 0.2).density(2400.0))
            .joint("bed", Joint::mu(0.6))
            .block(Block::new("lintel", "stone", corners.to_vec()).mesh([16, 2]))
            .support(Support::new("left", [0.0, 0.0], [0.3, 0.0], "bed"))
            .support(Support::new("right", [2.1, 0.0], [2.4, 0.0], "bed"))
    };
    let plain = [[0.0, 0.0], [2.4, 0.0], [2.4, 0.3], [0.0, 0.3]];
    let knotted =
        [[0.0, 0.0], [0.3, 0.0], [2.1, 0.0], [2.4, 0.0], [2.4, 0.3], [1.0, 0.3], [0.0, 0.3]];
    let [plain, knotted] =
        [scene(&plain), scene(&knotted)].map(|it| Model::from_scene(&it).unwrap());
    assert_eq!(plain.blocks[0].mesh, knotted.blocks[0].mesh);
    assert_eq!(plain.contacts.len(), knotted.contacts.len());
    assert!(
        plain.unusual().iter().all(|it| !it.contains("stiff in bending")),
        "{:?}",
        plain.unusual()
    );
}

#[test]
fn slender_blocks_with_few_elements_are_told() {
    let block = |name: &str, y: f64, mesh: [u32; 2]| {
        let corners = vec![[0.0, y], [2.4, y], [2.4, y + 0.3], [0.0, y + 0.3]];
        Block::new(name, "stone", corners).mesh(mesh)
    };
    let told = |blocks: [Block; 2]| {
        let scene = Scene::new("Beams", Units::SI)
            .plane(Plane::Stress)
            .thickness(0.3)
            .gravity([0.0, -9.81])
            .material("stone", Material::elastic(2e10, 0.2).density(2400.0))
            .joint("bed", Joint::mu(0.6))
            .support(Support::new("ground", [0.0, 0.0], [2.4, 0.0], "bed"));
        let scene = blocks.into_iter().fold(scene, Scene::block);
        let mut list = Model::from_scene(&scene).unwrap().unusual();
        list.retain(|it| it.contains("in bending"));
        list
    };
    // 1 + 2^2 / 2.4 + 0.04 / 0.96 / 16 is 2.67, and five times as many elements leave 1.07.
    assert_eq!(
        told([block("low", 0.0, [8, 1]), block("high", 0.3, [4, 4])]),
        [
            "Block \"high\" (and 1 more) is 8 times as long as high, and its mesh may be up to 2.7 times as stiff in bending as the block: \
             set a `mesh` with 5 times as many elements along it."
        ]
    );
    assert!(told([block("low", 0.0, [24, 1]), block("high", 0.3, [20, 4])]).is_empty());
}
