//! Geometry, meshes, joints and contact points.

#![allow(clippy::float_cmp, reason = "exact values are asserted where they must be exact")]
use crate::common;

use common::{block, model, model_with, panel, rectangle, support};
use masonry::geometry::{self, PolygonError};
use masonry::law::JointLaw;
use masonry::model::joints::{ContactError, JointSearch, PointRule};
use masonry::model::mesh::BlockMesh;
use masonry::model::{Body, Model};
use nalgebra::{Point2, Rotation2, Vector2};
use proptest::prelude::*;

fn square(x: f64, y: f64, side: f64) -> [Point2<f64>; 4] {
    [[x, y], [x + side, y], [x + side, y + side], [x, y + side]].map(Point2::from)
}

#[test]
fn area_and_centroid_of_a_trapezium() {
    let quad = [[0.0, 0.0], [4.0, 0.0], [3.0, 3.0], [1.0, 3.0]].map(Point2::from);
    assert_eq!(geometry::area(&quad), 9.0);
    let centroid = geometry::centroid(&quad);
    assert!((centroid - Point2::new(2.0, 4.0 / 3.0)).norm() < 1e-15);
    let far = quad.map(|p| p + Vector2::new(1e6, -1e6));
    assert!((geometry::centroid(&far) - (centroid + Vector2::new(1e6, -1e6))).norm() < 1e-9);
}

#[test]
fn bad_polygons_are_refused() {
    let good = square(0.0, 0.0, 1.0);
    assert_eq!(geometry::check_convex(&good), Ok(()));
    let [a, b, c, d] = good;
    assert!(matches!(geometry::check_convex(&[d, c, b, a]), Err(PolygonError::Clockwise { .. })));
    let dent = Point2::new(0.4, 0.4);
    assert_eq!(geometry::check_convex(&[a, b, dent, d]), Err(PolygonError::NotConvex(2)));
    let middle = Point2::new(0.5, 0.0);
    assert_eq!(geometry::check_convex(&[a, middle, b, d]), Err(PolygonError::NotConvex(1)));
    assert!(geometry::check_convex(&[a, a, c, d]).is_err());
    let nan = Point2::new(f64::NAN, 0.0);
    assert_eq!(geometry::check_convex(&[nan, b, c, d]), Err(PolygonError::NotFinite));
    assert_eq!(geometry::check_convex(&[a, b]), Err(PolygonError::TooFew(2)));
    assert_eq!(geometry::check_convex(&[a, b, c]), Ok(()));
    // Every corner of a star turns to the left, and its edges go around twice.
    let star = [0, 2, 4, 1, 3].map(|k| regular(5)[k]);
    assert_eq!(geometry::check_convex(&star), Err(PolygonError::Crossing));
    assert_eq!(geometry::check_convex(&regular(5)), Ok(()));
}

#[test]
fn simple_polygons_may_have_corners_that_point_inwards() {
    let simple = |corners: &[[f64; 2]]| {
        let corners: Vec<_> = corners.iter().copied().map(Point2::from).collect();
        geometry::check_simple(&corners)
    };
    let hook = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    assert_eq!(simple(&hook), Ok(()));
    let backwards: Vec<_> = hook.into_iter().rev().collect();
    assert_eq!(simple(&backwards), Err(PolygonError::Clockwise(-4.0)));
    // A corner on a straight edge.
    assert_eq!(simple(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 2.0]]), Ok(()));
    assert_eq!(
        simple(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]),
        Err(PolygonError::Crossing)
    );
    assert_eq!(
        simple(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]]),
        Err(PolygonError::Crossing)
    );
    assert_eq!(
        simple(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [3.0, 1.0], [2.0, 1.0], [0.0, 2.0]]),
        Err(PolygonError::NoWidth(3))
    );
    assert_eq!(simple(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), Err(PolygonError::NoWidth(0)));
}

/// A hook of a 3 m by 1 m rectangle and a 1 m square on its left end, by the sums of both.
#[test]
fn a_hook_has_the_measures_of_its_rectangles() {
    let hook = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let hook = hook.map(Point2::from);
    assert_eq!(geometry::area(&hook), 4.0);
    assert!((geometry::centroid(&hook) - Point2::new(1.25, 0.75)).norm() < 1e-15);
    // 2.5 + 3 / 8 of the rectangle and 1 / 6 + 9 / 8 of the square.
    assert!((geometry::polar_moment(&hook) - 25.0 / 6.0).abs() < 1e-14);
    let at = |x, y| geometry::outside(&hook, Point2::new(x, y));
    assert_eq!([at(0.5, 1.0), at(2.0, 0.75), at(2.0, 1.5), at(2.0, 1.0)], [-0.5, -0.25, 0.5, 0.0]);
    // Turned by half a circle it fits the hollow, and half a metre lower it overlaps 2 m by half a metre.
    let turned = hook.map(|p| Point2::new(4.0 - p.x, 2.0 - p.y));
    assert!(geometry::overlap_area(&hook, &turned).abs() < 1e-14);
    let deeper = turned.map(|p| p - Vector2::new(0.0, 0.5));
    assert!((geometry::overlap_area(&hook, &deeper) - 1.0).abs() < 1e-14);
    let inside = |x: f64| {
        let ends = [[x, -1.0], [x, 3.0]].map(Point2::from);
        geometry::length_inside(ends, &hook, 1e-9)
    };
    for (x, length) in [(0.5, 2.0), (2.0, 1.0), (0.0, 0.0), (4.0, 0.0)] {
        assert!((inside(x) - length).abs() < 1e-14);
    }
    let level = [[-1.0, 1.0], [5.0, 1.0]].map(Point2::from);
    assert!((geometry::length_inside(level, &hook, 1e-9) - 1.0).abs() < 1e-14);
}

/// On the unit circle.
fn regular(corners: usize) -> Vec<Point2<f64>> {
    let angle = |k| 2.0 * std::f64::consts::PI * k as f64 / corners as f64;
    (0..corners).map(|k| Point2::new(angle(k).cos(), angle(k).sin())).collect()
}

/// The area of a regular polygon is `n/2 sin(2 pi / n)`, its size the diameter or, of an odd number of corners, a little
/// less, and a place is as far outside as it is beyond the middle of an edge.
#[test]
fn polygons_have_the_measures_of_the_textbook() {
    for n in 3..13 {
        let (polygon, step) = (regular(n), std::f64::consts::PI / n as f64);
        let area = 0.5 * n as f64 * (2.0 * step).sin();
        assert!((geometry::area(&polygon) - area).abs() < 1e-14);
        assert!(geometry::centroid(&polygon).coords.norm() < 1e-14);
        let size = if n % 2 == 0 { 2.0 } else { 2.0 * (0.5 * step).cos() };
        assert!((geometry::size(&polygon) - size).abs() < 1e-14);
        for k in 0..n {
            let normal = geometry::outward_normal(&polygon, k);
            let outside = geometry::outside(&polygon, Point2::from(normal * 2.0));
            assert!((outside - (2.0 - step.cos())).abs() < 1e-14);
        }
        let half = [[0.0, -3.0], [3.0, -3.0], [3.0, 3.0], [0.0, 3.0]].map(Point2::from);
        let overlap = geometry::overlap_area(&polygon, &half);
        // The polygon is symmetric about the horizontal axis, and about the vertical one where n is even.
        assert!(n % 2 == 1 || (overlap - 0.5 * area).abs() < 1e-14);
        assert!((overlap - geometry::overlap_area(&half, &polygon)).abs() < 1e-14);
    }
}

#[test]
fn overlap_area_of_squares() {
    let unit = square(0.0, 0.0, 1.0);
    assert!((geometry::overlap_area(&unit, &square(0.5, 0.25, 1.0)) - 0.375).abs() < 1e-15);
    assert_eq!(geometry::overlap_area(&unit, &square(1.0, 0.0, 1.0)), 0.0);
    assert_eq!(geometry::overlap_area(&unit, &square(3.0, 0.0, 1.0)), 0.0);
    let turned = square(-0.5, -0.5, 1.0).map(|p| Rotation2::new(0.25 * std::f64::consts::PI) * p);
    let centred = square(-0.5, -0.5, 1.0);
    let octagon = 2.0 * 2.0_f64.sqrt() - 2.0;
    assert!((geometry::overlap_area(&centred, &turned) - octagon).abs() < 1e-14);
}

#[test]
fn mesh_edges_run_from_corner_to_corner() {
    let quad = [[0.0, 0.0], [4.0, 0.0], [3.0, 3.0], [1.0, 3.0]].map(Point2::from);
    let mesh = BlockMesh::new(&quad, 3, 2);
    assert_eq!((mesh.nodes.len(), mesh.elements.len()), (12, 6));
    for edge in 0..4 {
        let (nodes, fractions) = (mesh.edge_nodes(edge), mesh.edge_fractions(edge));
        assert_eq!(nodes.len(), fractions.len());
        for (node, at) in nodes.iter().zip(fractions) {
            let place = geometry::on_edge(&quad, edge, at);
            assert!((mesh.nodes[*node] - place).norm() < 1e-15);
        }
        for at in [0.0, 0.2, 1.0 / 3.0, 0.5, 0.99, 1.0] {
            let [(i, p), (j, q)] = mesh.interpolate(edge, at);
            let place = mesh.nodes[i].coords * p + mesh.nodes[j].coords * q;
            assert!((place - geometry::on_edge(&quad, edge, at).coords).norm() < 1e-15);
            assert!(p >= 0.0 && q >= 0.0);
        }
    }
}

#[test]
fn published_panels_have_the_documented_counts() {
    let count = |m: &Model| {
        let nodes: usize = m.blocks.iter().map(|b| b.mesh.as_ref().unwrap().nodes.len()).sum();
        (m.blocks.len(), nodes, m.contacts.len())
    };
    assert_eq!(count(&panel(1, &[[0.0, 1.0]])), (105, 915, 735));
    assert_eq!(count(&panel(1, &[[0.0, 0.1], [0.9, 1.0]])), (105, 915, 711));
    assert_eq!(count(&panel(2, &[[0.0, 0.2], [0.8, 1.0]])), (55, 765, 475));
}

#[test]
fn nodal_pairs_and_vertices_agree_on_matching_meshes() {
    let blocks = common::running_bond(3, 4, 2, 0.1);
    let floor = vec![support("floor", [0.0, 0.0], [0.6, 0.0])];
    let rule = |points| {
        let options = JointSearch { points, ..JointSearch::default() };
        model_with(blocks.clone(), floor.clone(), [0.5; 3], &options).contacts
    };
    let (vertices, pairs) = (rule(PointRule::Vertices), rule(PointRule::NodalPairs));
    assert_eq!(vertices.len(), pairs.len());
    for (v, p) in vertices.iter().zip(&pairs) {
        assert!((v.position - p.position).norm() < 1e-15);
        assert!((v.weight - p.weight).abs() < 1e-15);
    }
}

#[test]
fn nodal_pairs_need_matching_nodes() {
    let blocks = vec![
        rectangle("lower", [0.0, 1.0], [0.0, 1.0], Some([1, 1])),
        rectangle("upper", [0.5, 1.5], [1.0, 2.0], Some([1, 1])),
    ];
    let options = JointSearch { points: PointRule::NodalPairs, ..JointSearch::default() };
    let classes = [masonry::model::JointClass {
        name: "bed".into(),
        law: JointLaw::friction(0.5),
        points: None,
        mortar: None,
    }];
    let found = masonry::model::joints::find(&blocks, &[], &classes, |_, _, _| 0, 1.0, &options);
    let (a, b) = ("lower".to_string(), "upper".to_string());
    assert_eq!(found.unwrap_err(), ContactError::NoNodalPair { a, b });
}

#[test]
fn normals_point_up_right_and_into_the_block() {
    let wall = common::running_bond(2, 2, 2, 0.1);
    let left = support("left", [0.0, 0.2], [0.0, 0.0]);
    let right = support("right", [0.4, 0.2], [0.4, 0.0]);
    for reversed in [false, true] {
        let mut blocks = wall.clone();
        if reversed {
            blocks.reverse();
        }
        let model = model(blocks, vec![left.clone(), right.clone()], 0.5);
        for joint in &model.joints {
            let upwards = Vector2::new(0.0, 1.0);
            let expected = match joint.a {
                Body::Block(_) if joint.class == 0 => upwards,
                Body::Block(_) => Vector2::x(),
                Body::Support(id) => Vector2::x() * if id.index() == 0 { 1.0 } else { -1.0 },
            };
            assert!((joint.normal - expected).norm() < 1e-15);
            assert!((joint.to - joint.from).normalize().dot(&joint.tangent()) > 1.0 - 1e-15);
            let b = geometry::centroid(&model.blocks[joint.b.index()].corners);
            assert!((b - joint.from).dot(&joint.normal) > 0.0);
        }
    }
}

#[test]
fn corners_that_touch_make_no_joint() {
    let blocks = vec![
        rectangle("a", [0.0, 1.0], [0.0, 1.0], None),
        rectangle("b", [1.0, 2.0], [1.0, 2.0], None),
    ];
    assert!(model(blocks, vec![], 0.5).joints.is_empty());
}

#[test]
fn gaps_are_seen_within_the_limit_and_kept() {
    let blocks = || {
        vec![
            rectangle("a", [0.0, 1.0], [0.0, 1.0], Some([1, 1])),
            rectangle("b", [0.5, 1.5], [1.02, 2.0], Some([1, 1])),
        ]
    };
    assert!(model(blocks(), vec![], 0.5).joints.is_empty());
    let options = JointSearch { gap_limit: 0.03, ..JointSearch::default() };
    let model = model_with(blocks(), vec![], [0.5; 3], &options);
    assert_eq!(model.joints.len(), 1);
    for contact in &model.contacts {
        assert!((contact.gap - 0.02).abs() < 1e-15);
    }
}

#[test]
fn slanted_joint_of_two_voussoirs() {
    let ring = |angle: f64, r: f64| Point2::new(r * angle.cos(), r * angle.sin());
    let voussoir = |name: &str, from: f64, to: f64| {
        let corners = [ring(from, 5.0), ring(from, 6.0), ring(to, 6.0), ring(to, 5.0)];
        block(name, corners, Some([3, 2]))
    };
    let blocks = vec![voussoir("first", 0.3, 0.5), voussoir("second", 0.5, 0.7)];
    let model = model(blocks, vec![], 0.5);
    assert_eq!((model.joints.len(), model.contacts.len()), (1, 4));
    assert_eq!(model.joints[0].class, 0);
    let normal = Vector2::new(-0.5_f64.sin(), 0.5_f64.cos());
    assert!((model.joints[0].normal - normal).norm() < 1e-14);
}

proptest! {
    /// Weights of every rule add up to the length of the joint, and both anchors are at the place.
    #[test]
    fn points_are_consistent(
        shift in -0.9..0.9_f64,
        width in 0.2..2.0_f64,
        meshes in prop::array::uniform2(1..6_usize),
        angle in 0.0..6.3_f64,
        rule in prop::sample::select(vec![PointRule::Vertices, PointRule::Gauss]),
    ) {
        let turn = Rotation2::new(angle);
        let make = |name: &str, x: [f64; 2], y: [f64; 2], n: usize| {
            let flat: geometry::Quad = rectangle(name, x, y, None).corners.try_into().unwrap();
            block(name, flat.map(|p| turn * p), Some([n, 1]))
        };
        let blocks = vec![
            make("lower", [0.0, 1.0], [0.0, 1.0], meshes[0]),
            make("upper", [shift, shift + width], [1.0, 1.5], meshes[1]),
        ];
        let length = 1.0_f64.min(shift + width) - 0.0_f64.max(shift);
        let options = JointSearch { points: rule, ..JointSearch::default() };
        let model = model_with(blocks, vec![], [0.5; 3], &options);
        if length > 1e-6 {
            prop_assert_eq!(model.joints.len(), 1);
            let total: f64 = model.contacts.iter().map(|c| c.weight).sum();
            prop_assert!((total - length).abs() < 1e-12);
            prop_assert!((model.joints[0].length() - length).abs() < 1e-12);
        }
        for contact in &model.contacts {
            for anchor in [contact.a.unwrap(), contact.b] {
                let corners = &model.blocks[anchor.block.index()].corners;
                let place = geometry::on_edge(corners, anchor.edge, anchor.at);
                prop_assert!((place - contact.position).norm() < 1e-9);
            }
        }
    }
}
