//! Nodes of elements and films moved to other places, against direct assembly.

use crate::common::nodal_change::NodalChange;
use masonry::element::quad4::{self, Nodes, StrainMatrix};
use masonry::element::quadrature::GAUSS_2;
use masonry::material::constitutive;
use masonry::model::{Elasticity, Plane};
use masonry::paper::film::strip::Strip;
use masonry::paper::film::{FilmMaterial, Matrix8, Vector8};
use nalgebra::{Matrix2, Matrix4, Point2, Vector2, Vector4};
use proptest::prelude::*;

const MATERIAL: FilmMaterial =
    FilmMaterial { elasticity: Elasticity { young: 3.0, poisson: 0.2 }, plane: Plane::Strain };

fn close(a: &Matrix8, b: &Matrix8) -> bool {
    (a - b).amax() <= 1e-12 * b.amax()
}

fn symmetric_and_semidefinite(k: &Matrix8) -> bool {
    let values = ((k + k.transpose()) * 0.5).symmetric_eigenvalues();
    (k - k.transpose()).amax() <= 1e-13 * k.amax() && values.min() >= -1e-13 * values.max()
}

/// The three rigid motions of points, as displacements.
fn rigid(points: &[Point2<f64>; 4]) -> [Vector8; 3] {
    [Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0), Vector2::zeros()].map(|shift| {
        let turns = if shift == Vector2::zeros() { 1.0 } else { 0.0 };
        Vector8::from_fn(|i, _| {
            let p = points[i / 2];
            let motion = shift + Vector2::new(-p.y, p.x) * turns;
            motion[i % 2]
        })
    })
}

fn stress_free(k: &Matrix8, points: &[Point2<f64>; 4]) -> bool {
    rigid(points).iter().all(|u| (k * u).amax() <= 1e-12 * k.amax() * u.amax())
}

// Quadrilaterals.

prop_compose! {
    /// A convex quadrilateral near the square of side 2.
    fn quad()(d in prop::array::uniform8(-0.3..0.3_f64)) -> Nodes {
        std::array::from_fn(|k| Point2::new(CORNERS[k][0] + d[2 * k], CORNERS[k][1] + d[2 * k + 1]))
    }
}

const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

prop_compose! {
    /// A node and a place of the reference square on its own side of the middle, in- or outside.
    fn node_and_place()(node in 0..4_usize, x in 0.3..1.7_f64, y in 0.3..1.7_f64)
        -> (usize, [f64; 2]) {
        (node, [CORNERS[node][0] * x, CORNERS[node][1] * y])
    }
}

/// Moves of quadrilateral nodes, the second in terms of what the first has made.
fn move_both(moves: [(usize, [f64; 2]); 2]) -> Option<NodalChange> {
    let mut change = NodalChange::identity();
    for (node, place) in moves {
        let delta = change.matrix() * Vector4::from(quad4::shape(place));
        // Some moves amplify rounding.
        if delta[node].abs() < 0.2 {
            return None;
        }
        change = change.then(&NodalChange::at(node, delta.into()));
    }
    Some(change)
}

/// The places of the four nodes after the moves, in the reference square.
fn places(moves: [(usize, [f64; 2]); 2]) -> [[f64; 2]; 4] {
    let mut places = CORNERS;
    for (node, place) in moves {
        places[node] = place;
    }
    places
}

proptest! {
    #[test]
    fn moved_quads_equal_direct_assembly(
        nodes in quad(), first in node_and_place(), second in node_and_place(),
    ) {
        let moves = [first, second];
        let change = move_both(moves);
        prop_assume!(change.is_some());
        let change = change.unwrap();
        let d = constitutive(MATERIAL.elasticity, Plane::Stress);
        let k = change.stiffness(&quad4::stiffness(&nodes, &d, 0.3).unwrap());

        // Values at the new places from values at the old ones, and the other way round.
        let at = places(moves).map(quad4::shape);
        let to_new = Matrix4::from_fn(|new, old| at[new][old]).kronecker(&Matrix2::identity());
        let to_old = to_new.try_inverse().unwrap();
        let mut direct = Matrix8::zeros();
        for x in GAUSS_2 {
            for y in GAUSS_2 {
                let (b, determinant) = quad4::strain_matrix(&nodes, [x, y]).unwrap();
                let b = b * to_old;
                direct += b.transpose() * d * b * (determinant * 0.3);
            }
        }
        prop_assert!(close(&k, &direct));
        prop_assert!(symmetric_and_semidefinite(&k));
        let points = at.map(|phi| {
            Point2::from((0..4).map(|j| nodes[j].coords * phi[j]).sum::<Vector2<f64>>())
        });
        prop_assert!(stress_free(&k, &points));
    }

    /// The new functions are one at their own node and zero at the others.
    #[test]
    fn moved_functions_are_nodal(moves in [node_and_place(), node_and_place()]) {
        let change = move_both(moves);
        prop_assume!(change.is_some());
        let change = change.unwrap();
        for (node, place) in places(moves).into_iter().enumerate() {
            let phi = change.matrix() * Vector4::from(quad4::shape(place));
            let unit = Vector4::from_fn(|j, _| f64::from(u8::from(j == node)));
            prop_assert!((phi - unit).amax() < 1e-12);
        }
    }

    #[test]
    fn a_move_forth_and_back_changes_nothing((node, place) in node_and_place()) {
        let change = move_both([(node, place), (node, CORNERS[node])]);
        prop_assume!(change.is_some());
        prop_assert!((change.unwrap().matrix() - Matrix4::identity()).amax() < 1e-12);
    }

    /// Along its lower and upper edge a quadrilateral is a film.
    #[test]
    fn film_ends_and_general_elements_have_the_same_change(
        node in 0..4_usize, length in 0.1..10.0_f64, growth in -0.8..3.0_f64,
    ) {
        let shift = length * growth * if node % 2 == 1 { 1.0 } else { -1.0 };
        let special = NodalChange::of_film_end(node, length, shift);
        let x = shift + length * if node % 2 == 1 { 0.5 } else { -0.5 };
        let mut delta = [0.0; 4];
        delta[node / 2 * 2] = 0.5 - x / length;
        delta[node / 2 * 2 + 1] = 0.5 + x / length;
        let general = NodalChange::at(node, delta);
        prop_assert!((special.matrix() - general.matrix()).amax() < 1e-13);

        // Quadrilaterals count their nodes round, films face by face.
        let round = [0, 1, 3, 2];
        let y = if node < 2 { -1.0 } else { 1.0 };
        let quad = NodalChange::of_quad(round[node], [2.0 * x / length, y]);
        let quad = Matrix4::from_fn(|i, j| quad.matrix()[(round[i], round[j])]);
        prop_assert!((special.matrix() - quad).amax() < 1e-13);
    }
}

// Films.

/// `B(x)` with displacements interpolated linearly between any two places of each face.
fn direct_strain(faces: [[f64; 2]; 2], thickness: f64, x: f64) -> StrainMatrix {
    let mut b = StrainMatrix::zeros();
    for (face, [left, right]) in faces.into_iter().enumerate() {
        let side = if face == 0 { -1.0 } else { 1.0 };
        let span = right - left;
        let phi = [(right - x) / span, (x - left) / span];
        for (end, slope) in [-1.0 / span, 1.0 / span].into_iter().enumerate() {
            let u = 4 * face + 2 * end;
            b[(0, u)] = 0.5 * slope;
            b[(1, u + 1)] = side * phi[end] / thickness;
            b[(2, u)] = side * phi[end] / thickness;
            b[(2, u + 1)] = 0.5 * slope;
        }
    }
    b
}

fn direct_stiffness(strip: &Strip, faces: [[f64; 2]; 2], [from, to]: [f64; 2]) -> Matrix8 {
    let half = 0.5 * (to - from);
    GAUSS_2
        .map(|xi| {
            let b = direct_strain(faces, strip.thickness(), 0.5 * (from + to) + half * xi);
            let weight = half * strip.thickness() * strip.wall();
            b.transpose() * strip.elasticity() * b * weight
        })
        .iter()
        .sum()
}

prop_compose! {
    fn strip()(length in 0.2..2.0_f64, slim in 0.02..0.5_f64, wall in 0.1..2.0_f64) -> Strip {
        Strip::new(length, slim * length, wall, &MATERIAL).unwrap()
    }
}

prop_compose! {
    /// Two places on a face, for a film of length one: inside it, around it or beside it.
    fn face()(left in -2.0..1.5_f64, span in 0.3..4.0_f64) -> [f64; 2] { [left, left + span] }
}

prop_compose! {
    fn part()(from in -0.5..0.4_f64, size in 0.1..1.0_f64) -> [f64; 2] {
        [from, from + size * (0.5 - from)]
    }
}

proptest! {
    #[test]
    fn moved_films_equal_direct_assembly(
        strip in strip(), faces in [face(), face()], part in part(),
    ) {
        let l = strip.length();
        let faces = faces.map(|face| face.map(|x| x * l));
        let part = part.map(|x| x * l);
        let change = NodalChange::of_film(l, faces);
        let k = change.stiffness(&strip.stiffness(part));
        prop_assert!(close(&k, &direct_stiffness(&strip, faces, part)));
        prop_assert!(symmetric_and_semidefinite(&k));
        let y = 0.5 * strip.thickness();
        let [[x1, x2], [x3, x4]] = faces;
        let points = [[x1, -y], [x2, -y], [x3, y], [x4, y]].map(Point2::from);
        prop_assert!(stress_free(&k, &points));
        let b = change.strain_matrix(&strip.strain_matrix(0.1 * l));
        let direct = direct_strain(faces, strip.thickness(), 0.1 * l);
        prop_assert!((b - direct).amax() <= 1e-12 * direct.amax());
    }

    /// A film in contact on a part is the film of that part, its ends moved back.
    #[test]
    fn films_in_contact_on_a_part_are_shorter_films(strip in strip(), part in part()) {
        let part = part.map(|x| x * strip.length());
        let middle = 0.5 * (part[0] + part[1]);
        let ends = strip.ends().map(|x| x - middle);
        let length = part[1] - part[0];
        let short =
            Strip::new(length, strip.thickness(), strip.wall(), strip.material()).unwrap();
        let whole = short.stiffness(short.ends());
        let k = NodalChange::of_film(length, [ends; 2]).stiffness(&whole);
        prop_assert!((k - strip.stiffness(part)).amax() <= 1e-12 * k.amax());
    }

    /// Ends move in any order; work and forces are those of the old nodes.
    #[test]
    fn the_order_of_moves_does_not_matter(
        left in -1.0..0.3_f64, right in -0.3..1.0_f64, u in prop::array::uniform8(-1.0..1.0_f64),
    ) {
        let places = [left - 0.5, right + 0.5];
        let change = NodalChange::of_film(1.0, [places, [-0.5, 0.5]]);
        for order in [[0, 1], [1, 0]] {
            let shift = |node: usize| if node == 0 { left } else { right };
            let grown = if order[0] == 0 { 1.0 - left } else { 1.0 + right };
            let [first, second] = order;
            let by_hand = NodalChange::of_film_end(first, 1.0, shift(first))
                .then(&NodalChange::of_film_end(second, grown, shift(second)));
            prop_assert!((by_hand.matrix() - change.matrix()).amax() < 1e-12);
        }
        let strip = Strip::new(1.0, 0.1, 1.0, &MATERIAL).unwrap();
        let k = strip.stiffness(strip.ends());
        let moved = Vector8::from(u);
        let old = change.displacements(&moved);
        let force = change.forces(&(k * old));
        prop_assert!((force - change.stiffness(&k) * moved).amax() < 1e-10 * k.amax());
        prop_assert!((force.dot(&moved) - (k * old).dot(&old)).abs() < 1e-10 * k.amax());
    }
}

#[test]
fn ends_that_pass_the_other_old_end_are_moved_in_the_order_that_works() {
    // The right end moves onto the old place of the left, which has to leave first.
    let places = [-3.0, -0.5];
    let change = NodalChange::of_film(1.0, [places, places]);
    let strip = Strip::new(1.0, 0.1, 1.0, &MATERIAL).unwrap();
    let k = change.stiffness(&strip.stiffness(strip.ends()));
    assert!(close(&k, &direct_stiffness(&strip, [places, places], strip.ends())));
}
