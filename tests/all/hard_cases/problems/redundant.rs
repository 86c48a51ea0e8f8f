//! More contacts than equilibrium needs, and singular matrices.

use lcp::faer::{Mat, mat};
use lcp::{Contact2d, HorizontalLcp};
use lcp_problems::families;

use super::case::Case;
use super::data::block;
use super::problem::Problem;

pub const TITLE: &str = "Redundant contacts and singular matrices";

pub fn cases() -> Vec<Case> {
    let hyperstatic = "Rigid bodies have no stiffness, and equilibrium leaves most forces undetermined: `A` is singular.";
    let singular = "Columns of `A` and of `B` depend on one another.";
    let on_twelve = on_supports(12);
    let general = on_twelve.to_general();
    let dense =
        HorizontalLcp::new(general.a().to_dense(), general.b().to_dense(), general.c().to_vec());
    let on_twelve_words =
        "forces 3 to the right and 20 down, moment 10, 12 supports at distances of 1, mu = 0.5";
    vec![
        Case::new("rigid block on two supports", hyperstatic, Problem::Contact(two()))
            .parameters("forces 1 to the right and 8 down, supports at -1 and 1, mu = 0.5")
            .enumerated(),
        Case::new("rigid block on twelve supports", hyperstatic, Problem::Contact(on_twelve))
            .parameters(on_twelve_words)
            .solvable("solvable; a continuum of forces"),
        Case::new(
            "the same as a horizontal problem",
            hyperstatic,
            Problem::General(dense.unwrap()),
        )
        .parameters("`Contact2d::to_general`, n = 39, dense")
        .solvable("solvable; a continuum of forces"),
        Case::new("every contact five times", hyperstatic, Problem::Contact(repeated()))
            .parameters("a body held by springs of stiffness 2 along both axes, loads 1 to the right and 5 down, planes with the normals (0, 1), (3, 4), (-3, 4) five times each, mu = 0.5")
            .solvable("solvable; displacements are unique, forces are not"),
        Case::new("rigid block jammed in a box", hyperstatic, Problem::Contact(boxed()))
            .parameters("2 x 2, two points each on a floor and on walls on both sides, mu = 1, force 1 down")
            .solvable("solvable; walls may press with any force"),
        Case::of(
            "monotone, both matrices singular",
            singular,
            families::horizontal_monotone(30, 1),
            (Problem::General, 1.0),
        )
        .parameters("`families::horizontal_monotone(30, 1)`"),
        Case::of(
            "no class, both matrices singular",
            singular,
            families::horizontal_singular(16, 3),
            (Problem::General, 1.0),
        )
        .parameters("`families::horizontal_singular(16, 3)`"),
        Case::of(
            "free variables with a singular block",
            singular,
            families::mixed_singular(16, 1),
            (Problem::Mixed, 1.0),
        )
        .parameters("`families::mixed_singular(16, 1)`"),
        Case::of(
            "quadratic program with equations",
            singular,
            families::mixed_monotone(30, 1),
            (Problem::Mixed, 1.0),
        )
        .parameters("`families::mixed_monotone(30, 1)`, rank 10"),
    ]
}

/// At distances of 1.
pub(super) fn on_supports(number: u8) -> Contact2d {
    let places: Vec<f64> =
        (0..number).map(|i| f64::from(i) - f64::from(number - 1) / 2.0).collect();
    block(&places, [3.0, -20.0, 10.0], 0.5)
}

fn two() -> Contact2d {
    block(&[-1.0, 1.0], [1.0, -8.0, 0.0], 0.5)
}

/// Normals `(0, 1)`, `(3, 4)` and `(-3, 4)`.
fn repeated() -> Contact2d {
    let normals = [[0.0, 1.0], [3.0, 4.0], [-3.0, 4.0]];
    let m = 15;
    let k = Mat::from_fn(2, 2, |i, j| if i == j { 2.0 } else { 0.0 });
    let c_n = Mat::from_fn(m, 2, |i, j| normals[i % 3][j]);
    let c_t = Mat::from_fn(m, 2, |i, j| [normals[i % 3][1], -normals[i % 3][0]][j]);
    let zero = vec![0.0; m];
    Contact2d::new(k, vec![1.0, -5.0], c_n, c_t, zero.clone(), zero, vec![0.5; m]).unwrap()
}

/// Two by two, about its middle: motions to the right, upwards and turning to the left.
fn boxed() -> Contact2d {
    let c_n = mat![
        [0.0, 1.0, -1.0],
        [0.0, 1.0, 1.0],
        [1.0, 0.0, 1.0],
        [1.0, 0.0, -1.0],
        [-1.0, 0.0, 1.0],
        [-1.0, 0.0, -1.0],
    ];
    let c_t = mat![
        [1.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [0.0, -1.0, 1.0],
        [0.0, -1.0, 1.0],
        [0.0, 1.0, 1.0],
        [0.0, 1.0, 1.0],
    ];
    let zero = vec![0.0; 6];
    let load = vec![0.0, -1.0, 0.0];
    Contact2d::new(Mat::zeros(3, 3), load, c_n, c_t, zero.clone(), zero, vec![1.0; 6]).unwrap()
}
