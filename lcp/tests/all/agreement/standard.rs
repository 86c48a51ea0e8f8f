//! Standard problems, also in disguise, with planted solutions, of which a part is not strictly
//! complementary.

use faer::{Mat, Scale, Side as Triangle};
use lcp::{HorizontalLcp, Lcp, Solution};
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::cases;
use super::measure::{
    Lack, ROUNDING, distance, dot, largest, norm, sparse, times, worst_of_general,
};
use super::routes::Owes::{Honesty, Refusal, Solution as Solves};
use super::routes::{Owes, Route, Routes, TOLERANCES, all, solved};

const LARGEST: usize = 14;

type Pairs = (Vec<f64>, Vec<f64>);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Class {
    /// Symmetric positive definite, `C C^T + 1`.
    Definite,
    /// `C C^T + 1/64`, condition up to 1e4.
    Moderate,
    /// `C C^T` of half the rank.
    Semidefinite,
    /// The five-point Laplacian: symmetric positive definite, an M-matrix.
    Laplacian,
    /// Rows that dominate, nothing positive off the diagonal, not symmetric.
    MMatrix,
    /// Rows that dominate, any signs, in any units: a P-matrix that is not positive definite.
    PMatrix,
    /// `C C^T + K - K^T + 1`: positive definite and not symmetric.
    Monotone,
    /// `C C^T + K - K^T`, with half the rank: monotone, with many solutions.
    WeaklyMonotone,
}

impl Class {
    /// How many times the residual that was asked for the relative error of what is unique may be, for a
    /// point inside that is no vertex. The diagonal in units of the largest eigenvalue, or less.
    fn condition(self) -> f64 {
        if self == Self::Moderate { 64.0 * 100.0 } else { 100.0 }
    }

    fn is_semidefinite(self) -> bool {
        matches!(self, Self::Semidefinite | Self::WeaklyMonotone)
    }
}

/// What every method owes, by the guarantees of its documentation. A row without a positive diagonal
/// entry is refused by the sweeps and by Newton's method, whatever the class. For semidefinite matrices the
/// sweeps converge, but at a rate without a bound, so that they may run into their limits. Programs are refused unless the
/// matrix is that of the variables and multipliers of one.
///
/// | class | Lemke | sweeps | program | interior | Newton |
/// |---|---|---|---|---|---|
/// | symmetric positive definite | solves | solves | solves | solves | solves |
/// | symmetric semidefinite | solves | honest | solves | solves | honest |
/// | M-matrix, not symmetric | solves | solves | refuses | honest | solves |
/// | P-matrix, not symmetric | solves | honest | refuses | honest | solves |
/// | positive definite, not symmetric | solves | honest | refuses | solves | solves |
/// | semidefinite, not symmetric | solves | honest | refuses | solves | honest |
fn owes(class: Class, route: Route, m: &Mat<f64>) -> Owes {
    let by_route = match class {
        Class::Definite | Class::Moderate | Class::Laplacian => [Solves; 5],
        Class::Semidefinite => [Solves, Honesty, Solves, Solves, Honesty],
        Class::MMatrix => [Solves, Solves, Refusal, Honesty, Solves],
        Class::PMatrix => [Solves, Honesty, Refusal, Honesty, Solves],
        Class::Monotone => [Solves, Honesty, Refusal, Solves, Solves],
        Class::WeaklyMonotone => [Solves, Honesty, Refusal, Solves, Honesty],
    };
    let needs_diagonal = matches!(route, Route::Sweeps | Route::Newton);
    if needs_diagonal && (0..m.nrows()).any(|i| m[(i, i)] <= 0.0) {
        return Refusal;
    }
    // The conditions of a program are skew between its variables and its multipliers.
    if route == Route::Program && has_groups(m) { Solves } else { by_route[route as usize] }
}

/// Whether the variables are of two groups, within which the matrix is symmetric, and skew between them.
fn has_groups(m: &Mat<f64>) -> bool {
    let n = m.nrows();
    let mut groups: Vec<Option<bool>> = vec![None; n];
    for first in 0..n {
        let mut waiting = vec![first];
        groups[first].get_or_insert(true);
        while let Some(i) = waiting.pop() {
            for j in (0..n).filter(|&j| m[(i, j)] != 0.0 || m[(j, i)] != 0.0) {
                let is_symmetric = m[(i, j)].total_cmp(&m[(j, i)]).is_eq();
                if !is_symmetric && m[(i, j)].total_cmp(&-m[(j, i)]).is_ne() {
                    return false;
                }
                let group = groups[i].map(|group| group == is_symmetric);
                if groups[j].is_none() {
                    groups[j] = group;
                    waiting.push(j);
                } else if groups[j] != group {
                    return false;
                }
            }
        }
    }
    true
}

#[derive(Debug, Clone)]
struct Planted {
    class: Class,
    lcp: Lcp,
    z: Vec<f64>,
    w: Vec<f64>,
    /// Units of the rows and of the columns.
    units: (Vec<f64>, Vec<f64>),
}

impl Planted {
    /// The class says whether the matrix is symmetric.
    fn is_of_its_class(&self) -> bool {
        let (m, n) = (self.lcp.m(), self.lcp.order());
        let is_symmetric = (0..n).all(|j| (0..j).all(|i| m[(i, j)].total_cmp(&m[(j, i)]).is_eq()));
        let symmetric = [Class::Definite, Class::Moderate, Class::Semidefinite, Class::Laplacian];
        is_symmetric == symmetric.contains(&self.class)
    }
}

fn diagonal(n: usize, value: f64) -> Mat<f64> {
    Mat::<f64>::identity(n, n) * Scale(value)
}

/// Rows whose diagonal is larger by one than all the rest.
fn dominant(n: usize, entry: impl Fn(usize, usize) -> f64) -> Mat<f64> {
    Mat::from_fn(n, n, |i, j| {
        if i == j {
            1.0 + (0..n).filter(|k| *k != i).map(|k| entry(i, k).abs()).sum::<f64>()
        } else {
            entry(i, j)
        }
    })
}

fn laplacian(n: usize) -> Mat<f64> {
    const COLUMNS: usize = 4;
    Mat::from_fn(n, n, |i, j| {
        let (low, high) = (i.min(j), i.max(j));
        let is_beside = high == low + 1 && high % COLUMNS != 0;
        match high - low {
            0 => 4.0,
            COLUMNS => -1.0,
            _ if is_beside => -1.0,
            _ => 0.0,
        }
    })
}

/// Data that are multiples of small powers of two, so that the planted solution is exact.
///
/// With `both` neither `z` nor `w` is all zero.
fn planted(both: bool) -> impl Strategy<Value = Planted> {
    use Class::{
        Definite, Laplacian, MMatrix, Moderate, Monotone, PMatrix, Semidefinite, WeaklyMonotone,
    };
    let classes =
        [Definite, Moderate, Semidefinite, Laplacian, MMatrix, PMatrix, Monotone, WeaklyMonotone];
    let shape = (prop::sample::select(classes.to_vec()), 2..=LARGEST, any::<bool>());
    shape.prop_flat_map(move |(class, n, is_sparse)| {
        let entries = || {
            let thinned = (-2..=2_i8, 0..3_u8);
            let entry =
                move |(v, draw): (i8, u8)| f64::from(if is_sparse && draw > 0 { 0 } else { v });
            vec(thinned.prop_map(entry), n * n)
        };
        let units = (vec(-3..=3_i32, n), vec(-3..=3_i32, n));
        let solution = vec((0..3_u8, 1..=3_i8), n);
        (entries(), entries(), units, solution).prop_map(move |(c, k, (rows, cols), mut pairs)| {
            if both {
                (pairs[0].0, pairs[1].0) = (0, 1);
            }
            let square = |v: &[f64], i: usize, j: usize| v[i * n + j];
            let gram = |rank: usize| {
                let c = Mat::from_fn(n, rank, |i, j| square(&c, i, j));
                &c * c.transpose()
            };
            let skew = Mat::from_fn(n, n, |i, j| square(&k, i, j) - square(&k, j, i));
            let unit = |v: &[i32]| -> Vec<f64> {
                let in_units = class == PMatrix;
                v.iter().map(|&e| if in_units { f64::from(e).exp2() } else { 1.0 }).collect()
            };
            let units = (unit(&rows), unit(&cols));
            let m = match class {
                Definite => gram(n) + diagonal(n, 1.0),
                Moderate => gram(n) + diagonal(n, 1.0 / 64.0),
                Semidefinite => gram(n.div_ceil(2)),
                Laplacian => laplacian(n),
                MMatrix => dominant(n, |i, j| -square(&c, i, j).abs()),
                PMatrix => {
                    let m = dominant(n, |i, j| square(&c, i, j));
                    Mat::from_fn(n, n, |i, j| units.0[i] * m[(i, j)] * units.1[j])
                }
                Monotone => gram(n) + skew + diagonal(n, 1.0),
                WeaklyMonotone => gram(n.div_ceil(2)) + skew,
            };
            let of = |state: u8| pairs.iter().map(move |&(it, v)| (it == state, f64::from(v)));
            let z: Vec<f64> = of(0).map(|(is_it, v)| if is_it { v } else { 0.0 }).collect();
            let w: Vec<f64> = of(1).map(|(is_it, v)| if is_it { v } else { 0.0 }).collect();
            let q: Vec<f64> = times(&m, &z).iter().zip(&w).map(|(mz, w)| w - mz).collect();
            let lcp = Lcp::new(if is_sparse { sparse(&m) } else { m.into() }, q).unwrap();
            Planted { class, lcp, z, w, units }
        })
    })
}

/// That a point with such a residual is as near to the planted solution as the class allows.
fn assert_near(planted: &Planted, (z, w): (&[f64], &[f64]), residual: f64) {
    let Planted { class, lcp, z: expected, units, .. } = planted;
    let m = lcp.m().to_dense();
    let lack = Lack::new(lcp, (z, w), residual);
    let error: Vec<f64> = z.iter().zip(expected).map(|(a, b)| a - b).collect();
    let moved_error: Vec<f64> = lack.z.iter().zip(expected).map(|(a, b)| a - b).collect();
    let n = z.len() as f64;
    match class {
        // `|e|^2 modulus <= e M e <= |e| |change|`.
        Class::Definite | Class::Moderate | Class::Laplacian | Class::Monotone => {
            let symmetric =
                Mat::from_fn(m.nrows(), m.nrows(), |i, j| 0.5 * (m[(i, j)] + m[(j, i)]));
            let eigenvalues = symmetric.self_adjoint_eigenvalues(Triangle::Lower).unwrap();
            let modulus = eigenvalues.into_iter().fold(f64::INFINITY, f64::min);
            let bound = n.sqrt() * lack.moved + norm(&lack.change) / modulus;
            assert!(norm(&error) <= bound, "{} > {bound:e}", norm(&error));
        }
        // Where `|e|` is largest, `w - w'` has not its sign, and `M e` at least its size.
        Class::MMatrix | Class::PMatrix => {
            let (rows, columns) = units;
            let change = lack.change.iter().zip(rows).map(|(v, unit)| v / unit);
            let unit = columns.iter().fold(0.0_f64, |max, unit| max.max(*unit));
            let bound = unit * lack.moved + change.fold(0.0, f64::max);
            for (error, unit) in error.iter().zip(columns) {
                assert!(error.abs() * unit <= bound, "{error} > {bound:e} / {unit}");
            }
        }
        // `z` is not unique; `e M e <= |e| |change|`.
        Class::Semidefinite | Class::WeaklyMonotone => {
            let energy = dot(&moved_error, &times(&m, &moved_error));
            let bound = norm(&moved_error) * norm(&lack.change);
            assert!(energy <= bound, "{energy} > {bound:e}");
        }
    }
}

/// The error of what is unique: of `z` itself, or of the symmetric part of `M` times it and of `q z`, in
/// units of the largest term that there could be, since the solutions may form an unbounded set.
fn error_of_unique_part(planted: &Planted, z: &[f64]) -> f64 {
    if !planted.class.is_semidefinite() {
        return distance(z, &planted.z);
    }
    let m = planted.lcp.m().to_dense();
    let n = z.len();
    let mut rows = &m + m.transpose();
    rows.resize_with(n + 1, n, |_, j| planted.lcp.q()[j]);
    let entries = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let stiffness = entries.map(|place| m[place].abs()).fold(0.0, f64::max);
    let size = stiffness * largest(z).max(largest(&planted.z));
    let error: Vec<f64> = z.iter().zip(&planted.z).map(|(a, b)| a - b).collect();
    let error = times(&rows, &error).into_iter().fold(0.0_f64, |max, v| max.max(v.abs()));
    if size > 0.0 { error / size } else { error }
}

/// Solves a problem to every tolerance by every method, each of which must find what the class lets it.
fn check<P>(
    planted: &Planted,
    problem: &P,
    restore: impl Fn(&Solution<P>) -> Pairs,
    routes: impl Fn(f64) -> Routes<P>,
) {
    let m = planted.lcp.m().to_dense();
    let general: HorizontalLcp = planted.lcp.clone().into();
    for tolerance in TOLERANCES {
        for route in routes(tolerance) {
            let owes = owes(planted.class, route.0, &m);
            let Some(solution) = solved(&route, problem, owes) else { continue };
            let (z, w) = restore(&solution);
            let worst = worst_of_general(&general, &z, &w);
            assert!(worst <= ROUNDING * tolerance, "{:?} {worst:e}", route.0);
            assert_near(planted, (&z, &w), tolerance);
            // Those that end with a basis are exact, whatever was asked for.
            let error = error_of_unique_part(planted, &z);
            let bound = match route.0 {
                Route::Lemke | Route::Newton => 1e-10,
                // By `e M e <= |e| |change|` alone.
                Route::Sweeps if planted.class.is_semidefinite() => {
                    (planted.class.condition() * tolerance).sqrt()
                }
                _ => planted.class.condition() * tolerance,
            };
            assert!(error <= bound, "{:?}: {error:e}, asked for {tolerance:e}", route.0);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { max_global_rejects: 100_000, ..cases(300) })]

    #[test]
    fn standard_problems(planted in planted(true)) {
        prop_assume!(planted.is_of_its_class());
        check(&planted, &planted.lcp, |it| (it.t.clone(), it.y.clone()), all::<Lcp>);
    }

    /// The general problem with some pairs the other way round, and rows in another order and in other
    /// units.
    #[test]
    fn standard_problems_in_disguise(
        planted in planted(true),
        swaps in vec(any::<bool>(), LARGEST),
        exponents in vec(-9..=9_i32, LARGEST),
        order in Just((0..LARGEST).collect::<Vec<_>>()).prop_shuffle(),
    ) {
        prop_assume!(planted.is_of_its_class());
        let n = planted.lcp.order();
        let m = planted.lcp.m().to_dense();
        // Else it may be another standard problem that is recognised.
        let is_single = |j: usize| (0..n).filter(|i| m[(*i, j)] != 0.0).count() <= 1;
        prop_assume!(!(0..n).any(is_single));
        let order: Vec<usize> = order.into_iter().filter(|i| *i < n).collect();
        let entry = |row: usize, j: usize, is_w: bool| {
            let i = order[row];
            let one = if i == j { 1.0 } else { 0.0 };
            f64::from(exponents[i]).exp2() * if is_w { one } else { -m[(i, j)] }
        };
        let matrix = |is_b: bool| Mat::from_fn(n, n, |i, j| entry(i, j, swaps[j] != is_b));
        let [a, b] = [false, true].map(matrix);
        let c = order.iter().map(|&i| f64::from(exponents[i]).exp2() * planted.lcp.q()[i]);
        let general = HorizontalLcp::new(a, b, c.collect::<Vec<f64>>()).unwrap();
        let restore = |solution: &Solution| {
            let pairs = solution.t.iter().zip(&solution.y).zip(&swaps);
            pairs.map(|((t, y), swap)| if *swap { (*y, *t) } else { (*t, *y) }).unzip()
        };
        // Else nothing is left to measure by, see below.
        let of = |is_y: bool| {
            let pairs = planted.z.iter().zip(&planted.w).zip(&swaps);
            pairs.map(|((z, w), swap)| if *swap == is_y { *z } else { *w }).fold(0.0, f64::max)
        };
        prop_assume!(of(false) > 0.0 && of(true) > 0.0);
        check(&planted, &general, restore, all::<HorizontalLcp>);
    }

    /// All `z` or all `w` are zero: there is nothing to measure them by.
    #[test]
    fn where_a_vector_vanishes(mut planted in planted(false), is_z in any::<bool>()) {
        prop_assume!(planted.is_of_its_class());
        let vector = if is_z { &mut planted.z } else { &mut planted.w };
        vector.fill(0.0);
        let is_loaded = planted.z.iter().chain(&planted.w).any(|v| *v > 0.0);
        prop_assume!(is_loaded);
        check_vanishing(planted);
    }

    #[test]
    fn where_both_vectors_vanish(mut planted in planted(false)) {
        prop_assume!(planted.is_of_its_class());
        planted.z.fill(0.0);
        planted.w.fill(0.0);
        check_vanishing(planted);
    }
}

/// Makes `z` and `w` the solution, which every method must find that owes one.
fn check_vanishing(mut planted: Planted) {
    let m = planted.lcp.m().to_dense();
    let q: Vec<f64> = times(&m, &planted.z).iter().zip(&planted.w).map(|(mz, w)| w - mz).collect();
    planted.lcp = Lcp::new(planted.lcp.m().clone(), q).unwrap();
    let general: HorizontalLcp = planted.lcp.clone().into();
    for tolerance in TOLERANCES {
        for route in all::<Lcp>(tolerance) {
            let owes = owes(planted.class, route.0, &m);
            let Some(solution) = solved(&route, &planted.lcp, owes) else { continue };
            let worst = worst_of_general(&general, &solution.t, &solution.y);
            assert!(worst <= ROUNDING * tolerance, "{:?} {worst:e}", route.0);
            assert_near(&planted, (&solution.t, &solution.y), tolerance);
        }
    }
}
