//! Mixed problems: Lemke's method on the general form, the quadratic program where the blocks are symmetric,
//! and the interior-point method.

use faer::Mat;
use lcp::{Error, HorizontalLcp, InteriorPoint, MixedLcp, Solution, Solver};
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::cases;
use super::measure::{ROUNDING, distance, dot, largest, times, worst_of_general};
use super::routes::Owes::{Refusal, Solution as Solves};
use super::routes::{Route, Routes, TOLERANCES, all, interior, lemke, solved};

/// `M = [P, -G^T; G, S]`, with `u` planted free and `z`, `w` complementary.
#[derive(Debug, Clone)]
struct Planted {
    mixed: MixedLcp,
    m: Mat<f64>,
    z: Vec<f64>,
    is_definite: bool,
    is_symmetric: bool,
}

/// `P` definite or of half the rank, and `S` likewise, symmetric or with a skew part.
fn planted() -> impl Strategy<Value = Planted> {
    let shape = (1..=5_usize, 2..=7_usize, any::<bool>(), any::<bool>());
    shape.prop_flat_map(|(free, paired, is_definite, is_symmetric)| {
        let n = free + paired;
        let data = (vec(-2..=2_i8, 3 * n * n), vec((0..3_u8, 1..=3_i8), n));
        data.prop_map(move |(entries, mut pairs)| {
            (pairs[free].0, pairs[free + 1].0) = (0, 1);
            let entry = |k: usize, i: usize, j: usize| f64::from(entries[(k * n + i) * n + j]);
            let gram = |order: usize, first: usize| {
                let rank = if is_definite { order } else { order / 2 };
                let c = Mat::from_fn(order, rank, |i, j| entry(0, first + i, first + j));
                let one = if is_definite { 1.0 } else { 0.0 };
                &c * c.transpose() + Mat::<f64>::identity(order, order) * faer::Scale(one)
            };
            let (p, s) = (gram(free, 0), gram(paired, free));
            let skew = |i: usize, j: usize| {
                if is_symmetric { 0.0 } else { entry(2, i, j) - entry(2, j, i) }
            };
            let m = Mat::from_fn(n, n, |i, j| match (i < free, j < free) {
                (true, true) => p[(i, j)],
                (true, false) => -entry(1, j, i),
                (false, true) => entry(1, i, j),
                (false, false) => s[(i - free, j - free)] + skew(i, j),
            });
            let all = || (free..n).flat_map(|j| (free..j).map(move |i| (i, j)));
            let is_symmetric = all().all(|(i, j)| m[(i, j)].total_cmp(&m[(j, i)]).is_eq());
            let value = |i: usize, (state, v): (u8, i8)| {
                if i < free || state == 0 { f64::from(v) } else { 0.0 }
            };
            let z: Vec<f64> = pairs.iter().enumerate().map(|(i, pair)| value(i, *pair)).collect();
            let w =
                |i: usize| if i >= free && pairs[i].0 == 1 { f64::from(pairs[i].1) } else { 0.0 };
            let q: Vec<f64> = times(&m, &z).iter().enumerate().map(|(i, mz)| w(i) - mz).collect();
            let mixed = MixedLcp::new(m.clone(), q, (0..n).map(|i| i < free).collect()).unwrap();
            Planted { mixed, m, z, is_definite, is_symmetric }
        })
    })
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn mixed_problems(planted in planted()) {
        let Planted { mixed, m, z: expected, is_definite, is_symmetric } = planted;
        let general = mixed.to_general();
        let n = mixed.order();
        for tolerance in TOLERANCES {
            let mut found = Vec::new();
            let by_lemke: (Route, Box<dyn Solver<HorizontalLcp>>) =
                (Route::Lemke, Box::new(lemke(tolerance)));
            found.extend(solved(&by_lemke, &general, Solves));
            let mut routes: Routes<MixedLcp> = vec![(Route::Interior, Box::new(interior(tolerance)))];
            #[cfg(feature = "clarabel")]
            routes.push((Route::Program, Box::new(super::routes::program(tolerance))));
            for route in &routes {
                let is_refused = route.0 == Route::Program && !is_symmetric;
                let owes = if is_refused { Refusal } else { Solves };
                found.extend(solved(route, &mixed, owes).map(Solution::of_pairs));
            }
            for solution in found {
                let solver = solution.info.method;
                let worst = worst_of_general(&general, &solution.t, &solution.y);
                prop_assert!(worst <= ROUNDING * tolerance, "{solver}: {worst:e}");
                let (z, _) = mixed.recover(&solution.t, &solution.y);
                if is_definite {
                    let error = distance(&z, &expected);
                    prop_assert!(error <= 1e3 * tolerance, "{solver}: {error:e} at {tolerance:e}");
                }
                // `e M e` has only what is unique: the skew parts cancel.
                let error: Vec<f64> = z.iter().zip(&expected).map(|(a, b)| a - b).collect();
                let size = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
                let size = size.map(|place| m[place].abs()).fold(0.0, f64::max);
                let size = size * largest(&error).max(largest(&z)) * largest(&error);
                let energy = dot(&error, &times(&m, &error));
                prop_assert!(energy <= 1e2 * n as f64 * tolerance * size, "{solver}: {energy:e}");
            }
        }
    }

    /// A free variable has no column of a single entry, so that the general form is no standard one: the
    /// methods for those refuse it.
    #[test]
    fn in_the_general_form_only_lemke_treats_them(planted in planted()) {
        let general = planted.mixed.to_general();
        prop_assume!(general.to_standard().is_none());
        for route in all::<HorizontalLcp>(1e-8) {
            solved(&route, &general, if route.0 == Route::Lemke { Solves } else { Refusal });
        }
        let refused = Solver::<HorizontalLcp>::solve(&InteriorPoint::default(), &general);
        prop_assert!(matches!(refused, Err(Error::NotTreated { .. })), "{:?}", refused);
    }
}
