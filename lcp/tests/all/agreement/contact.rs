//! Contact: elastic bodies, bodies that float, redundant contacts, with friction and without.

use faer::Mat;
use lcp::{Contact2d, ContactState, Solver};
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::cases;
use super::measure::{ROUNDING, dot, largest, times, transposed};
use super::routes::Owes::{Honesty, Refusal, Solution as Solves};
use super::routes::{Owes, Route, Routes, TOLERANCES, interior, lemke, solved, sweeps};

/// What every method owes. The sweeps eliminate the displacements, for which `K` must be definite; with
/// friction only pivoting on a copositive problem has a guarantee.
///
/// | class | Lemke | sweeps | program | interior |
/// |---|---|---|---|---|
/// | elastic, no friction | solves | solves | solves | solves |
/// | elastic, little friction | solves | honest | honest | honest |
/// | elastic, any friction | solves | honest | honest | honest |
/// | floating, no friction | solves | refuses | solves | solves |
/// | floating, with friction | honest | refuses | honest | honest |
fn owes(route: Route, is_floating: bool, has_friction: bool) -> Owes {
    match route {
        Route::Sweeps if is_floating => Refusal,
        _ if !has_friction => Solves,
        Route::Lemke if !is_floating => Solves,
        _ => Honesty,
    }
}

fn routes(tolerance: f64) -> Routes<Contact2d> {
    let mut routes: Routes<Contact2d> = vec![
        (Route::Lemke, Box::new(lemke(tolerance))),
        (Route::Sweeps, Box::new(sweeps(tolerance))),
        (Route::Interior, Box::new(interior(tolerance))),
    ];
    #[cfg(feature = "clarabel")]
    routes.push((Route::Program, Box::new(super::routes::program(tolerance))));
    routes
}

/// A problem with its data as dense matrices.
#[derive(Debug, Clone)]
struct Data {
    problem: Contact2d,
    k: Mat<f64>,
    c_n: Mat<f64>,
    c_t: Mat<f64>,
}

impl Data {
    fn new(
        k: Mat<f64>,
        f: Vec<f64>,
        [c_n, c_t]: [Mat<f64>; 2],
        x_0: Vec<f64>,
        mu: Vec<f64>,
    ) -> Self {
        let s_0 = vec![0.0; mu.len()];
        let problem = Contact2d::new(k.clone(), f, c_n.clone(), c_t.clone(), x_0, s_0, mu).unwrap();
        Self { problem, k, c_n, c_t }
    }

    fn has_friction(&self) -> bool {
        !self.problem.frictional().is_empty()
    }

    /// Gaps and slips of displacements.
    fn kinematics(&self, u: &[f64]) -> [Vec<f64>; 2] {
        let sum = |c: &Mat<f64>, offset: &[f64]| -> Vec<f64> {
            times(c, u).iter().zip(offset).map(|(cu, offset)| cu + offset).collect()
        };
        [sum(&self.c_n, self.problem.initial_gaps()), sum(&self.c_t, self.problem.initial_slips())]
    }

    /// `f + C^T t`, which the bodies carry.
    fn carried(&self, state: &ContactState) -> Vec<f64> {
        let forces = [transposed(&self.c_n, &state.t_n), transposed(&self.c_t, &state.t_t)];
        let [normal, tangential] = forces;
        let all = self.problem.loads().iter().zip(normal).zip(tangential);
        all.map(|((f, n), t)| f + n + t).collect()
    }

    /// The largest residual, by the definitions of the library, from dense matrices.
    fn worst(&self, state: &ContactState) -> f64 {
        let (f, mu) = (self.problem.loads(), self.problem.mu());
        let ContactState { u, t_n, t_t, .. } = state;
        let [gap, slip] = self.kinematics(u);
        let (n, m) = (u.len(), mu.len());
        let root: Vec<f64> = (0..n).map(|j| self.k[(j, j)].sqrt()).collect();
        // Every row of contact that counts: (its coefficients, its force).
        let with_friction = || (0..m).filter(|i| mu[*i] > 0.0);
        let rows = (0..m).map(|i| (&self.c_n, i, t_n[i]));
        let rows: Vec<_> = rows.chain(with_friction().map(|i| (&self.c_t, i, t_t[i]))).collect();
        let t_max = rows.iter().fold(0.0_f64, |max, (_, _, t)| max.max(t.abs()));
        let energy = (0..n).fold(0.0_f64, |max, j| max.max(root[j] * u[j].abs()));
        let mut worst = 0.0_f64;
        let (mut load, mut contact, mut direct) = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut length = largest(self.problem.initial_gaps());
        for j in 0..n {
            let elastic = (0..n).map(|i| self.k[(j, i)] * u[i]);
            let forces = rows.iter().map(|(c, i, t)| -c[(*i, j)] * t);
            let terms: Vec<f64> = elastic.chain(forces).chain([-f[j]]).collect();
            let coefficient = rows.iter().fold(0.0_f64, |max, (c, i, _)| max.max(c[(*i, j)].abs()));
            let possible = (root[j] * energy).max(coefficient * t_max);
            let size = terms.iter().map(|v| v.abs()).sum::<f64>().max(possible / 1024.0);
            if size > 0.0 {
                worst = worst.max(terms.iter().sum::<f64>().abs() / size);
            }
            length = length.max(coefficient * u[j].abs());
            if root[j] > 0.0 {
                load = load.max(f[j].abs() / root[j]);
                contact = contact.max(coefficient / root[j]);
            } else if coefficient > 0.0 {
                direct = direct.max(f[j].abs() / coefficient);
            }
        }
        let force = t_max.max(direct).max(if contact > 0.0 { load / contact } else { 0.0 });
        let length = length.max(load * contact);
        let unit = |v: f64| if v > 0.0 { v } else { 1.0 };
        let pair = |t: f64, y: f64| (t / unit(force)).min(y / unit(length)).abs();
        let normals = (0..m).map(|i| pair(t_n[i], gap[i]));
        let sides = with_friction().flat_map(|i| {
            let bound = mu[i] * t_n[i];
            [pair(bound + t_t[i], slip[i].max(0.0)), pair(bound - t_t[i], (-slip[i]).max(0.0))]
        });
        normals.chain(sides).fold(worst, f64::max)
    }

    /// `u K u = f u - t_n x_0 - sum mu t_n |s|`: what the loads do goes into the bodies and into friction.
    /// The two sides may differ by what the residuals allow of every term.
    fn assert_energy(&self, state: &ContactState, tolerance: f64) {
        let [gap, slip] = self.kinematics(&state.u);
        let elastic = dot(&state.u, &times(&self.k, &state.u));
        let load = dot(&state.u, self.problem.loads());
        let gaps = dot(&state.t_n, self.problem.initial_gaps());
        let friction: f64 =
            (0..slip.len()).map(|i| self.problem.mu()[i] * state.t_n[i] * slip[i].abs()).sum();
        let (t_max, length) = (largest(&state.t_n), largest(&gap).max(largest(&slip)));
        let n = state.u.len() + 3 * slip.len();
        let moved = largest(&state.u) * largest(self.problem.loads());
        // What the loads would store in bodies without contact, as if `K` were diagonal.
        let loads = self.problem.loads().iter().enumerate();
        let alone = loads.map(|(j, f)| if f.abs() > 0.0 { f * f / self.k[(j, j)] } else { 0.0 });
        let alone: f64 = alone.filter(|energy| energy.is_finite()).sum();
        let size =
            elastic.abs() + load.abs() + gaps.abs() + friction + t_max * length + moved + alone;
        let lack = (elastic - load + gaps + friction).abs();
        let bound = 2.0 * n as f64 * tolerance * size;
        assert!(lack <= bound, "{lack:e} > {bound:e}");
    }
}

/// The state of a method, with its own residual, equilibrium and energy checked.
fn state(
    data: &Data,
    route: &(Route, Box<dyn Solver<Contact2d>>),
    is_floating: bool,
    tolerance: f64,
) -> Option<ContactState> {
    let owes = owes(route.0, is_floating, data.has_friction());
    let solution = solved(route, &data.problem, owes)?;
    let state = data.problem.recover(&solution.t, &solution.y);
    let worst = data.worst(&state);
    assert!(worst <= ROUNDING * tolerance, "{:?}: {worst:e}", route.0);
    data.assert_energy(&state, ROUNDING * tolerance);
    Some(state)
}

fn integers(n: usize, low: i8, high: i8) -> impl Strategy<Value = Vec<f64>> {
    vec((low..=high).prop_map(f64::from), n)
}

/// Nodes in a row, each tied to the ground and to its neighbours, above the ground or on it: all contacts
/// independent, `K` positive definite with a condition below 10.
fn elastic(mu: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = Data> {
    (1..=8_usize).prop_flat_map(move |nodes| {
        let loads = (integers(nodes, -4, 4), integers(nodes, -8, 4));
        let ties = (vec(1..=2_i8, nodes), integers(nodes, 0, 1), vec(mu.clone(), nodes));
        (loads, ties).prop_map(move |((push, weight), (ties, gaps, mu))| {
            let n = 2 * nodes;
            let mut k = Mat::zeros(n, n);
            for j in 0..n {
                k[(j, j)] += f64::from(ties[j / 2]);
                for i in [j.wrapping_sub(2), j + 2].into_iter().filter(|i| *i < n) {
                    k[(j, j)] += 1.0;
                    k[(i, j)] -= 1.0;
                }
                // A shear that couples both directions.
                k[(j, j ^ 1)] += 0.25;
            }
            let mut f: Vec<f64> = push.iter().zip(&weight).flat_map(|(x, y)| [*x, *y]).collect();
            f[1] -= 5.0;
            let rows = [1, 0]
                .map(|axis| Mat::from_fn(nodes, n, |i, j| f64::from(u8::from(j == 2 * i + axis))));
            Data::new(k, f, rows, gaps.iter().map(|g| 0.25 * g).collect(), mu)
        })
    })
}

/// Blocks on each other, each of two faces that a spring joins and on two points, so that the contacts share
/// their forces: `K` is singular, since nothing but contact holds them.
fn floating(mu: impl Strategy<Value = f64>) -> impl Strategy<Value = Data> {
    (1..=5_usize, mu).prop_flat_map(|(blocks, mu)| {
        (integers(blocks, 1, 6), integers(blocks, 1, 4)).prop_map(move |(weights, springs)| {
            // Lower face, upper face, to the side.
            let (n, m) = (3 * blocks, 2 * blocks);
            let mut k = Mat::zeros(n, n);
            let (mut c_n, mut c_t) = (Mat::zeros(m, n), Mat::zeros(m, n));
            let mut f = vec![0.0; n];
            for (block, (weight, spring)) in weights.iter().zip(&springs).enumerate() {
                let low = 3 * block;
                for (i, j) in [(low, low), (low + 1, low + 1)] {
                    k[(i, j)] = *spring;
                }
                (k[(low, low + 1)], k[(low + 1, low)]) = (-spring, -spring);
                (f[low], f[low + 1]) = (-0.5 * weight, -0.5 * weight);
                // Less than friction at any joint can hold.
                f[low + 2] = if mu > 0.0 { 0.5 * mu * weight } else { 0.0 };
                for point in [2 * block, 2 * block + 1] {
                    (c_n[(point, low)], c_t[(point, low + 2)]) = (1.0, 1.0);
                    if block > 0 {
                        (c_n[(point, low - 2)], c_t[(point, low - 1)]) = (-1.0, -1.0);
                    }
                }
            }
            Data::new(k, f, [c_n, c_t], vec![0.0; m], vec![mu; m])
        })
    })
}

proptest! {
    #![proptest_config(cases(100))]

    /// Without friction, and with little, there is one solution.
    #[test]
    fn elastic_bodies_have_one_state(
        data in elastic(prop::sample::select(vec![0.0, 0.05, 0.1, 0.2])),
    ) {
        let reference = state(&data, &routes(1e-12)[0], false, 1e-12).unwrap();
        // Of forces, and of displacements without contact.
        let size = largest(&reference.t_n).max(largest(data.problem.loads()));
        let length = largest(data.problem.loads()) / data.k[(0, 0)];
        for tolerance in TOLERANCES {
            for route in routes(tolerance) {
                let Some(state) = state(&data, &route, false, tolerance) else { continue };
                assert_near("u", route.0, (&state.u, &reference.u), length, tolerance);
                assert_near("t_n", route.0, (&state.t_n, &reference.t_n), size, tolerance);
                assert_near("t_t", route.0, (&state.t_t, &reference.t_t), size, tolerance);
            }
        }
    }

    /// With much friction there may be several solutions, so that every state is judged by itself.
    #[test]
    fn friction_of_any_size(data in elastic(prop::sample::select(vec![0.5, 1.0, 3.0]))) {
        for tolerance in TOLERANCES {
            for route in routes(tolerance) {
                state(&data, &route, false, tolerance);
            }
        }
    }

    /// The joints share what is above them, so that only sums of forces, and what the bodies store, are
    /// unique; without friction nothing says where the blocks are to the side.
    #[test]
    fn floating_bodies_carry_what_is_above(
        data in floating(prop::sample::select(vec![0.0, 0.25, 1.0])),
    ) {
        let blocks = data.problem.points() / 2;
        let load = |j: usize| data.problem.loads()[j];
        let weights: Vec<f64> = (0..blocks).map(|b| -2.0 * load(3 * b)).collect();
        let pushes: Vec<f64> = (0..blocks).map(|b| -load(3 * b + 2)).collect();
        let above = |v: &[f64]| (0..blocks).map(|b| v[b..].iter().sum()).collect::<Vec<f64>>();
        let (weight, push) = (above(&weights), above(&pushes));
        // The spring of a block carries what stands on it, and the upper half of its weight.
        let spring = |b: usize| (weight[b] - 0.5 * weights[b]) / data.k[(3 * b, 3 * b)];
        let shortening: Vec<f64> = (0..blocks).map(spring).collect();
        for tolerance in TOLERANCES {
            for route in routes(tolerance) {
                let Some(state) = state(&data, &route, true, tolerance) else { continue };
                let sums = |t: &[f64]| t.chunks(2).map(|t| t[0] + t[1]).collect::<Vec<f64>>();
                let short = |b: usize| state.u[3 * b] - state.u[3 * b + 1];
                let short: Vec<f64> = (0..blocks).map(short).collect();
                let (size, ku) = (weight[0], times(&data.k, &state.u));
                assert_near("t_n", route.0, (&sums(&state.t_n), &weight), size, tolerance);
                assert_near("t_t", route.0, (&sums(&state.t_t), &push), size, tolerance);
                assert_near("springs", route.0, (&short, &shortening), 0.0, tolerance);
                assert_near("K u", route.0, (&data.carried(&state), &ku), size, tolerance);
            }
        }
    }
}

/// Within a hundred times the tolerance, in units of the largest entry expected, or of a size that is larger.
fn assert_near(
    what: &str,
    route: Route,
    (found, expected): (&[f64], &[f64]),
    size: f64,
    tolerance: f64,
) {
    let differences = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
    let (error, size) = (differences.fold(0.0, f64::max), size.max(largest(expected)));
    assert!(error <= 1e2 * tolerance * size, "{what} of {route:?}: {error:e} of {size:e}");
}
