//! Lintels of their own material and joints, flat arches above openings, and walls along a line.

use masonry::analysis::solve::solve;
use masonry::data::verdict::Verdict;
use masonry::model::{Body, Model, PlacedJoint};
use masonry::scene::{Brick, Joint, Lintel, Material, Opening, Scene, Support, Wall};

use crate::common::{GRAVITY, M_KN, assert_close};

const BRICK: Brick = Brick { length: 0.4, height: 0.2 };
const COURSES: u32 = 8;

/// A wall of 2.8 m with an opening.
fn wall(opening: Opening) -> Scene {
    Scene::new("Lintel", M_KN)
        .thickness(0.3)
        .gravity([0.0, -GRAVITY])
        .material("stone", Material::rigid().density(2000.0))
        .material("timber", Material::rigid().density(500.0))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .joint("bearing", Joint::mu(0.5))
        .wall(Wall::running_bond("wall", "stone", BRICK, 2.8, COURSES).opening(opening))
        .support(Support::new("floor", [0.0, 0.0], [2.8, 0.0], "bed"))
}

fn flat_arch(skew_deg: f64, courses: u32) -> Opening {
    above_door(courses, Lintel { skew_deg: Some(skew_deg), ..Lintel::default() })
}

/// Seven voussoirs above a door of 0.8 m.
fn above_door(courses: u32, lintel: Lintel) -> Opening {
    let (voussoirs, joint) = (Some(7), Some("bearing".to_owned()));
    let lintel = Lintel { joint, voussoirs, courses: Some(courses), ..lintel };
    Opening { lintel: Some(lintel), ..Opening::door(1.0, 0.8, 3) }
}

/// A lintel of timber weighs what timber does, and all of its joints are of its class.
#[test]
fn a_lintel_has_its_own_material_and_joints() {
    let opening = Opening::door(1.0, 0.8, 3).lintel("timber", "bearing");
    let model = Model::from_scene(&wall(opening)).unwrap();
    let of_timber: Vec<usize> =
        (0..model.blocks.len()).filter(|k| model.blocks[*k].density == Some(500.0)).collect();
    let [lintel] = of_timber[..] else { panic!("{of_timber:?}") };
    assert!((masonry::geometry::area(&model.blocks[lintel].corners) - 1.2 * 0.2).abs() < 1e-12);
    for joint in &model.joints {
        let touches =
            joint.b.index() == lintel || matches!(joint.a, Body::Block(id) if id.index() == lintel);
        assert_eq!(model.joint_classes[joint.class].name == "bearing", touches);
    }
}

/// Bricks and voussoirs fill the wall around the opening, whatever the skew: cut bricks meet the springings on all of their
/// length.
#[test]
fn bricks_are_cut_to_a_flat_arch() {
    for (skew_deg, courses) in [(0.0, 1), (15.0, 1), (20.0, 2), (30.0, 3), (25.0, 5)] {
        let model = Model::from_scene(&wall(flat_arch(skew_deg, courses))).unwrap();
        let area: f64 = model.blocks.iter().map(|it| masonry::geometry::area(&it.corners)).sum();
        assert_close(area, 2.8 * 0.2 * f64::from(COURSES) - 0.8 * 0.6, 1e-12);
        let is_voussoir =
            |id: masonry::ids::BlockId| model.blocks[id.index()].name.starts_with("wall/lintel/1/");
        let springs = |joint: &&PlacedJoint| {
            let Body::Block(a) = joint.a else { return false };
            is_voussoir(a) != is_voussoir(joint.b) && joint.normal.y.abs() < 0.9
        };
        let length: f64 = model.joints.iter().filter(springs).map(PlacedJoint::length).sum();
        let height = 0.2 * f64::from(courses);
        assert_close(length, 2.0 * height / skew_deg.to_radians().cos(), 1e-9);
        for joint in &model.joints {
            let Body::Block(a) = joint.a else { continue };
            let class = &model.joint_classes[joint.class].name;
            assert_eq!(class == "bearing", is_voussoir(a) || is_voussoir(joint.b), "{class}");
        }
    }
}

#[test]
fn a_wall_on_a_flat_arch_stands() {
    for (skew_deg, courses) in [(15.0, 1), (20.0, 2)] {
        let outcome = solve(&wall(flat_arch(skew_deg, courses))).unwrap();
        assert_eq!(outcome.judgement.verdict, Verdict::Stands);
    }
}

/// An intrados that is an arc takes its polygon of seven chords from the wall, and its springings point to its centre.
#[test]
fn bricks_are_cut_to_an_arch_with_a_level_top() {
    for (rise, courses) in [(0.05, 1), (0.1, 2), (0.15, 3)] {
        let lintel = Lintel { rise: Some(rise), ..Lintel::default() };
        let scene = wall(above_door(courses, lintel));
        let model = Model::from_scene(&scene).unwrap();
        let area: f64 = model.blocks.iter().map(|it| masonry::geometry::area(&it.corners)).sum();
        // Radius and angle of a circle through the springings and the crown.
        let radius = (0.4 * 0.4 + rise * rise) / (2.0 * rise);
        let embrace = 2.0 * (0.4_f64 / radius).asin();
        let triangles = 7.0 * 0.5 * radius * radius * (embrace / 7.0).sin();
        let below = triangles - 0.4 * (radius - rise);
        assert_close(area, 2.8 * 0.2 * f64::from(COURSES) - 0.8 * 0.6 - below, 1e-12);
        for block in model.blocks.iter().filter(|it| it.name.starts_with("wall/lintel/1/")) {
            let [from, .., to] = block.corners[..] else { unreachable!() };
            let centre = nalgebra::Point2::new(1.4, 0.6 + rise - radius);
            assert_close((from - centre).norm(), radius, 1e-12);
            assert!((from - centre).perp(&(to - centre)).abs() < 1e-12);
        }
        assert_eq!(solve(&scene).unwrap().judgement.verdict, Verdict::Stands);
    }
}

/// A wall that runs to a point is the wall turned by the angle of the line, as wide as the line is long.
#[test]
fn a_wall_runs_along_a_line() {
    let base = Wall::running_bond("wall", "stone", BRICK, 2.0, 3).origin([0.5, 0.25]);
    let turned = base.clone().turn_deg(0.75_f64.atan().to_degrees());
    let along = Wall { width: None, ..base.to([2.1, 1.45]) };
    let corners = |laid: Wall| {
        let mut scene = wall(Opening::door(1.0, 0.8, 3));
        scene.walls = vec![laid];
        scene.supports = vec![Support::new("slope", [0.5, 0.25], [2.1, 1.45], "bed")];
        let model = Model::from_scene(&scene).unwrap();
        model.blocks.iter().flat_map(|it| it.corners.clone()).collect::<Vec<_>>()
    };
    let [turned, along] = [turned, along].map(corners);
    assert_eq!(turned.len(), along.len());
    assert!(turned.iter().zip(&along).all(|(a, b)| (a - b).norm() < 1e-12));
    assert!(along.iter().any(|it| (it - nalgebra::Point2::new(2.1, 1.45)).norm() < 1e-12));
}
