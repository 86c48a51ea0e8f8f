//! Contact with friction: jams, paradoxes, and stiffnesses that do not fit together.

use lcp::faer::{Mat, mat};
use lcp::{Contact2d, Friction2d};

use super::case::Case;
use super::data::body;
use super::problem::Problem;

pub const TITLE: &str = "Contact and friction";

pub fn cases() -> Vec<Case> {
    let wedge = "The friction cone is steeper than the faces: a jammed wedge cannot be pulled out, and the data do not say whether it is jammed.";
    let paradox =
        "Friction turns a push away from the wall into a push against it (Painleve 1895).";
    let faces = [[4.0, 3.0], [-4.0, 3.0]];
    let pulled = |springs| body([springs; 2], [0.0, 1.0], &faces, 1.0);
    let impact = |q: [f64; 2]| {
        let w = mat![[1.0, 2.0], [2.0, 8.0]];
        Problem::Friction(Friction2d::new(w, q.to_vec(), vec![1.0]).unwrap())
    };
    let words = "`W = [1 2; 2 8]`, mu = 1";
    let mut list = vec![
        Case::new("wedge, rigid, smooth", wedge, body([0.0; 2], [0.0, -6.0], &faces, 0.0))
            .parameters("normals (4, 3) and (-4, 3), mu = 0, pressed down by 6")
            .enumerated(),
        Case::new("wedge pulled out, rigid", wedge, pulled(0.0))
            .parameters("the same faces, mu = 1 > 3/4, pulled up by 1")
            .enumerated(),
        Case::new("wedge pulled out, held by springs", wedge, pulled(1.0))
            .parameters("the same, springs of stiffness 1 along both axes")
            .enumerated(),
        Case::new("surface that drags into a wall", wedge, dragged())
            .parameters("`K = 1`, `f = 1`, `C_n = -1`, `C_t = -2`, `s_0 = 1`, mu = 0.5")
            .enumerated(),
        Case::new("sliding on, apart", paradox, impact([1.0, 8.0]))
            .parameters(&format!("{words}, `q = (1, 8)`"))
            .enumerated(),
        Case::new("sliding on, together", paradox, impact([-1.0, 8.0]))
            .parameters(&format!("{words}, `q = (-1, 8)`"))
            .enumerated(),
    ];
    list.extend([1e-9, 1.0, 1e6, 1e12].map(leaning));
    list.extend([20, 40].map(chain));
    list
}

/// A rigid body on a floor and against a slope.
pub(super) fn leaning(mu: f64) -> Case {
    let why = "The friction cone is nearly a line, or nearly the half plane.";
    let push = mu.min(1.0) / 2.0;
    let problem = body([0.0; 2], [push, -1.0], &[[0.0, 1.0], [3.0, 4.0]], mu);
    Case::new(&format!("mu = {mu:e}, rigid"), why, problem)
        .parameters("normals (0, 1) and (3, 4), weight 1, pushed by min(mu, 1) / 2")
        .enumerated()
}

fn dragged() -> Problem {
    let one = |v: f64| mat![[v]];
    let (zero, moves) = (vec![0.0], vec![1.0]);
    let problem = Contact2d::new(one(1.0), vec![1.0], one(-1.0), one(-2.0), zero, moves, vec![0.5]);
    Problem::Contact(problem.unwrap())
}

/// Bodies in a row between springs that are soft and stiff by turns, each over a floor.
pub(super) fn chain(bits: i32) -> Case {
    const N: usize = 8;
    let stiff = |i: usize| if i.is_multiple_of(2) { 1.0 } else { 2_f64.powi(bits) };
    let k = Mat::from_fn(N, N, |i, j| match i.abs_diff(j) {
        0 => stiff(i) + stiff(i + 1),
        1 => -stiff(i.max(j)),
        _ => 0.0,
    });
    let at = |i: usize| [1.0, 1.0, 0.0, 0.0, 2.0, 2.0, 3.0, 0.0][i];
    let force = |i: usize| if at(i) > 0.0 { 0.0 } else { 1.0 };
    let pull = |i: usize| (0..N).map(|j| k[(i, j)] * at(j)).sum::<f64>() - force(i);
    let load: Vec<f64> = (0..N).map(pull).collect();
    let (one, none) = (Mat::identity(N, N), vec![0.0; N]);
    let problem =
        Contact2d::new(k, load, one, Mat::zeros(N, N), none.clone(), none.clone(), none).unwrap();
    let (u, t_n): (Vec<f64>, Vec<f64>) = (0..N).map(|i| (at(i), force(i))).unzip();
    let (t, y) = problem.to_pairs(&problem.state(u, t_n, vec![0.0; N]));
    let why = "Displacements depend on differences of large forces, and contact forces are no larger than the allowed residual of these forces. So other points may have equally small residuals.";
    Case::new(&format!("springs that differ by 2^{bits}"), why, Problem::Contact(problem))
        .parameters(
            "eight bodies in a row, each over a floor, between springs of stiffness 1 and that by turns, without friction; displacements (1, 1, 0, 0, 2, 2, 3, 0) are planted",
        )
        .unique((t, y), f64::from(bits).exp2() * 10.0)
}
