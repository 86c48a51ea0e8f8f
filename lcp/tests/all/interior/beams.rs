//! Beams on a floor, which bend a thousand times as far as their elements are deformed.

use faer::Mat;
use lcp::Contact2d;
use proptest::collection::vec;
use proptest::prelude::*;

use super::{common, solve, state};

/// Nodes with these loads upwards and gaps below them, and between every three of them a hinge with this
/// stiffness against bending.
fn beam(stiffness: &[f64], loads: Vec<f64>, gaps: Vec<f64>) -> Contact2d {
    let n = loads.len();
    let mut k = Mat::zeros(n, n);
    for (first, stiffness) in stiffness.iter().enumerate() {
        let bent = [1.0, -2.0, 1.0];
        for (i, a) in bent.iter().enumerate() {
            for (j, b) in bent.iter().enumerate() {
                k[(first + i, first + j)] += stiffness * a * b;
            }
        }
    }
    let none = vec![0.0; n];
    Contact2d::new(k, loads, Mat::identity(n, n), Mat::zeros(n, n), gaps, none.clone(), none)
        .unwrap()
}

/// Loads of one downwards at all nodes, and `P` upwards at the end. With `M_j = j P - j (j + 1) / 2`, the
/// moment at the node `j` from the end, all nodes before the last with `M_j > 0`, `l`, leave the floor, it keeps
/// as much force as makes the next moment zero, and the end rises by the sum of `j M_j`.
#[test]
fn a_heavy_beam_is_lifted_at_its_end() {
    for (n, pull) in [(31, 10.25), (121, 40.25), (481, 160.25)] {
        let mut loads = vec![-1.0; n];
        loads[n - 1] += pull;
        let state = state(&beam(&vec![1.0; n - 2], loads, vec![0.0; n]));
        let moment = |j: usize| j as f64 * (pull - (j + 1) as f64 / 2.0);
        let last = (1..n).rfind(|j| moment(*j) > 0.0).unwrap();
        let edge = [-moment(last + 1), 2.0 * moment(last + 1) - moment(last + 2)];
        let force = |j: usize| match j {
            j if j < last => 0.0,
            j if j < last + 2 => edge[j - last],
            _ => 1.0,
        };
        let forces: Vec<f64> = (0..n).rev().map(force).collect();
        // Bending is worse conditioned by the fourth power of the number of nodes.
        let near = |a: f64, b: f64| (a - b).abs() <= f64::EPSILON * (n as f64).powi(4) * b.max(1.0);
        let mut pairs = state.t_n.iter().zip(&forces);
        assert!(pairs.all(|(a, b)| near(*a, *b)), "{:?}", state.t_n);
        let rise: f64 = (1..=last).map(|j| j as f64 * moment(j)).sum();
        assert!(near(state.u[n - 1], rise), "{} instead of {rise}", state.u[n - 1]);
    }
}

proptest! {
    #![proptest_config(common::cases(64))]

    /// Without friction there is one energy, and nothing may come in the way of its minimum: neither how
    /// uneven the stiffness is nor how far parts are lifted.
    #[test]
    fn uneven_beams_are_lifted(
        digits in vec(-2.0..2.0_f64, 3..30),
        loads in vec(-1.0..0.0_f64, 32),
        gaps in vec(0.0..1.0_f64, 32),
        pull in 0.0..0.1_f64,
    ) {
        let n = digits.len() + 2;
        let stiffness: Vec<f64> = digits.iter().map(|d| 10_f64.powf(*d)).collect();
        let mut loads = loads[..n].to_vec();
        let weight: f64 = loads.iter().sum();
        loads[0] -= pull * weight;
        loads[n - 1] -= 2.0 * pull * weight;
        let problem = beam(&stiffness, loads, gaps[..n].to_vec());
        let solution = solve(&problem);
        prop_assert!(solution.is_solved(), "{:?}: {:?}", solution.status, solution.residuals);
        prop_assert!(solution.residuals.worst() < 1e-12, "{:?}", solution.residuals);
    }
}
