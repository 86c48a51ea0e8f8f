//! Friction reduced to the contacts.

use faer::Mat;
use lcp::{Friction2d, Solver};
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::cases;
use super::measure::{ROUNDING, distance, sparse, worst_of_general};
use super::routes::Owes::{Honesty, Solution as Solves};
use super::routes::{Route, Routes, TOLERANCES, interior, lemke, solved, sweeps};

/// `W = G G^T / n + 1`, with coefficients of friction so small that there is one solution, or of any size.
fn friction(largest: f64) -> impl Strategy<Value = Friction2d> {
    (1..=8_usize, any::<bool>()).prop_flat_map(move |(contacts, is_sparse)| {
        let n = 2 * contacts;
        let data = (vec(-1.0..1.0_f64, n * n), vec(-3.0..1.0_f64, n), vec(0.0..largest, contacts));
        data.prop_map(move |(g, mut q, mut mu)| {
            // Some contact is closed, and another one is smooth.
            q[0] = -3.0;
            if contacts > 2 {
                mu[1] = 0.0;
            }
            let g = Mat::from_fn(n, n, |i, j| g[i * n + j]);
            let w = &g * g.transpose() / faer::Scale(n as f64) + Mat::<f64>::identity(n, n);
            Friction2d::new(if is_sparse { sparse(&w) } else { w.into() }, q, mu).unwrap()
        })
    })
}

/// The sweeps and the interior-point method have no guarantee with friction.
fn routes(tolerance: f64) -> Routes<Friction2d> {
    vec![
        (Route::Lemke, Box::new(lemke(tolerance)) as Box<dyn Solver<Friction2d>>),
        (Route::Sweeps, Box::new(sweeps(tolerance))),
        (Route::Interior, Box::new(interior(tolerance))),
    ]
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn little_friction(friction in friction(0.3)) {
        let general = friction.standard().clone().into();
        let reference = lemke(1e-12).solve(&general).unwrap();
        prop_assert!(reference.is_solved());
        let expected = friction.forces(&reference.t);
        for tolerance in TOLERANCES {
            for route in routes(tolerance) {
                let owes = if route.0 == Route::Interior { Honesty } else { Solves };
                let Some(solution) = solved(&route, &friction, owes) else { continue };
                let worst = worst_of_general(&general, &solution.t, &solution.y);
                prop_assert!(worst <= ROUNDING * tolerance, "{:?}: {worst:e}", route.0);
                let forces = friction.forces(&solution.t);
                for (found, expected) in
                    [(&forces.normal, &expected.normal), (&forces.tangential, &expected.tangential)]
                {
                    // Tangential forces in units of the normal ones.
                    let size = expected.iter().chain(&[1.0]).fold(0.0_f64, |max, v| max.max(v.abs()));
                    let error: f64 = distance(found, expected)
                        * expected.iter().fold(0.0_f64, |max, v| max.max(v.abs())) / size;
                    prop_assert!(error <= 1e2 * tolerance, "{:?}: {error:e}", route.0);
                }
            }
        }
    }

    /// There may be several solutions: each is judged by itself.
    #[test]
    fn any_friction(friction in friction(3.0)) {
        let general = friction.standard().clone().into();
        for tolerance in TOLERANCES {
            for route in routes(tolerance) {
                let Some(solution) = solved(&route, &friction, Honesty) else { continue };
                let worst = worst_of_general(&general, &solution.t, &solution.y);
                prop_assert!(worst <= ROUNDING * tolerance, "{:?}: {worst:e}", route.0);
            }
        }
    }
}
