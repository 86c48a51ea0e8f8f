//! The exact arithmetic itself: textbook answers, and each part against the others.

use crate::common;

use common::cases;
use faer::{Mat, mat};
use lcp::{Basis, Error, HorizontalLcp, Lcp, Side};
use lcp_problems::exact::{
    EnumerationSettings, ExactEnumeration, ExactPoint, ExactVerdict, Face, Feasibility, RBig,
    enumerate, feasibility, verify_basis,
};
use proptest::collection::vec;
use proptest::prelude::*;

fn lcp(m: Mat<f64>, q: &[f64]) -> HorizontalLcp {
    Lcp::new(m, q.to_vec()).unwrap().into()
}

fn all(problem: &HorizontalLcp) -> ExactEnumeration {
    enumerate(problem, &EnumerationSettings::default()).unwrap()
}

fn ratio(numerator: i32, denominator: u8) -> RBig {
    RBig::from(numerator) / RBig::from(denominator)
}

/// The vertices of all faces in `t`, dimension by dimension.
fn faces_in_t(problem: &HorizontalLcp) -> Vec<(usize, Vec<Vec<RBig>>)> {
    let in_t = |face: &Face| (face.dimension, face.vertices.iter().map(|v| v.t.clone()).collect());
    let mut faces: Vec<_> = all(problem).faces.iter().map(in_t).collect();
    faces.sort();
    faces
}

fn integers<const N: usize>(values: [i32; N]) -> Vec<RBig> {
    values.map(RBig::from).to_vec()
}

#[test]
fn unique_answers_are_exact() {
    let problem = lcp(mat![[2.0, 1.0], [1.0, 2.0]], &[-5.0, -6.0]);
    assert_eq!(all(&problem).unique().unwrap().t, [ratio(4, 3), ratio(7, 3)]);
    let kostreva = mat![[1.0, 2.0, 0.0], [0.0, 1.0, 2.0], [2.0, 0.0, 1.0]];
    let third = ratio(1, 3);
    let unique = all(&lcp(kostreva, &[-1.0; 3]));
    assert_eq!(unique.unique().unwrap().t, [third.clone(), third.clone(), third]);
}

#[test]
fn order_one_in_all_its_cases() {
    let solutions = |m: f64, q: f64| faces_in_t(&lcp(mat![[m]], &[q]));
    assert_eq!(solutions(-1.0, -1.0), []);
    assert_eq!(solutions(0.0, -1.0), []);
    let point = |z| (0, vec![integers([z])]);
    assert_eq!(solutions(-1.0, 1.0), [point(0), point(1)]);
    assert_eq!(solutions(0.0, 1.0), [point(0)]);
    let half_line = all(&lcp(mat![[0.0]], &[0.0])).faces;
    assert_eq!((half_line.len(), half_line[0].dimension), (1, 1));
    assert_eq!(half_line[0].rays[0].t, integers([1]));
}

#[test]
fn order_zero_has_its_one_solution() {
    let problem = HorizontalLcp::new(Mat::new(), Mat::new(), Vec::new()).unwrap();
    assert!(all(&problem).unique().is_some() && all(&problem).has_basis);
}

/// A bimatrix game with three equilibria.
#[test]
fn every_solution_of_a_game_is_found() {
    let m = mat![
        [0.0, 0.0, 10.0, 20.0],
        [0.0, 0.0, 30.0, 15.0],
        [10.0, 20.0, 0.0, 0.0],
        [30.0, 15.0, 0.0, 0.0]
    ];
    let problem = lcp(m, &[-1.0; 4]);
    let (tenth, fifteenth) = (ratio(1, 10), ratio(1, 15));
    let pure = [
        (0, vec![vec![RBig::ZERO, fifteenth.clone(), RBig::ZERO, fifteenth]]),
        (0, vec![vec![ratio(1, 90), ratio(2, 45), ratio(1, 90), ratio(2, 45)]]),
        (0, vec![vec![tenth.clone(), RBig::ZERO, tenth, RBig::ZERO]]),
    ];
    assert_eq!(faces_in_t(&problem), pure);
}

/// A point and a half-line from it are one face.
#[test]
fn a_ray_of_solutions() {
    let problem = lcp(mat![[1.0, -1.0], [-1.0, 1.0]], &[1.0, -1.0]);
    let faces = all(&problem).faces;
    let [ray] = faces.as_slice() else { panic!("{faces:?}") };
    assert_eq!((ray.dimension, &ray.vertices[0].t), (1, &integers([0, 1])));
    assert_eq!(ray.rays[0].t, integers([1, 1]));
}

#[test]
fn a_square_of_solutions() {
    // w = (z1 + z2 - 1, the same, z3 + z4 - 1, the same).
    let m = Mat::from_fn(4, 4, |i, j| f64::from(u8::from(i / 2 == j / 2)));
    let faces = all(&lcp(m, &[-1.0; 4])).faces;
    let [square] = faces.as_slice() else { panic!("{faces:?}") };
    assert_eq!((square.dimension, square.vertices.len(), square.rays.len()), (2, 4, 0));
}

#[test]
fn kostreva_2_is_infeasible() {
    let m = mat![[1.0, -1.0, 3.0], [2.0, -1.0, 3.0], [-1.0, -2.0, 0.0]];
    let found = all(&lcp(m, &[-1.0; 3]));
    assert!(!found.is_solvable() && !found.is_feasible() && found.has_basis);
}

#[test]
fn a_problem_without_a_basis_can_have_solutions() {
    let ones = Mat::full(2, 2, 1.0);
    let found = all(&HorizontalLcp::new(ones.clone(), ones, vec![1.0, 1.0]).unwrap());
    assert!(!found.has_basis && found.is_solvable());
}

/// Extreme exponents are numbers like others, and the rounding at the end is the nearest.
#[test]
fn all_floating_point_numbers_are_exact() {
    let tiny = f64::from_bits(1);
    for (m, q, z) in [
        (1.0, -tiny, tiny),
        (3.0, -tiny, 0.0),
        (f64::MAX, -tiny, 0.0),
        (tiny, -tiny, 1.0),
        (1e300, -1e-10, 1e-310),
        (3.0, -1.0, 1.0 / 3.0),
        (0.1, -0.3, 0.3 / 0.1),
    ] {
        let verdict = verify_basis(&lcp(mat![[m]], &[q]), &Basis::all(Side::T, 1));
        assert_eq!(verdict, ExactVerdict::Solution { t: vec![z], y: vec![0.0] });
    }
}

#[test]
fn verdicts_say_what_is_wrong() {
    let problem = lcp(mat![[1.0, 1.0], [1.0, 1.0]], &[-4.0, 1.0]);
    let verdict = |sides: [Side; 2]| verify_basis(&problem, &Basis::new(sides.to_vec()));
    assert_eq!(verdict([Side::T, Side::T]), ExactVerdict::Singular { rank: 1 });
    assert_eq!(
        verdict([Side::Y, Side::Y]),
        ExactVerdict::Infeasible { pair: 0, side: Side::Y, relative: -1.0 }
    );
    assert_eq!(
        verdict([Side::T, Side::Y]),
        ExactVerdict::Solution { t: vec![4.0, 0.0], y: vec![0.0, 5.0] }
    );
}

#[test]
fn limits_are_errors() {
    let problem = lcp(Mat::identity(17, 17), &[-1.0; 17]);
    let too_large = enumerate(&problem, &EnumerationSettings::default()).unwrap_err();
    let expected = Error::Limit {
        what: "order of the problem to enumerate",
        value: 17,
        name: "max_order",
        limit: 16,
    };
    assert_eq!(too_large, expected);
    let settings = EnumerationSettings { max_order: 33, ..EnumerationSettings::default() };
    assert!(matches!(
        enumerate(&problem, &settings),
        Err(Error::Setting { name: "max_order", .. })
    ));
    let square = lcp(Mat::zeros(8, 8), &[0.0; 8]);
    let settings = EnumerationSettings { max_generators: 8, ..EnumerationSettings::default() };
    assert!(matches!(
        enumerate(&square, &settings),
        Err(Error::Limit { name: "max_generators", .. })
    ));
}

/// Small integers with many zeros, times powers of two.
fn problems() -> impl Strategy<Value = HorizontalLcp> {
    let entry = || (-2..=2_i8, any::<bool>()).prop_map(|(v, keep)| if keep { v } else { 0 });
    (0..6_usize).prop_flat_map(move |n| {
        let data = (vec(entry(), n * n), vec(entry(), n * n), vec(entry(), n));
        (data, vec(-9..=9_i32, 3 * n)).prop_map(move |((a, b, c), exponents)| {
            let power = |group: usize, k: usize| f64::from(exponents[group * n + k]).exp2();
            let of = |values: &[i8], group: usize| {
                Mat::from_fn(n, n, |i, j| {
                    f64::from(values[i * n + j]) * power(0, i) * power(group, j)
                })
            };
            let c: Vec<f64> = (0..n).map(|i| f64::from(c[i]) * power(0, i)).collect();
            HorizontalLcp::new(of(&a, 1), of(&b, 2), c).unwrap()
        })
    })
}

fn exact(value: f64) -> RBig {
    RBig::try_from(value).unwrap()
}

/// `A t + B y`, straight from the data.
fn image(problem: &HorizontalLcp, point: &ExactPoint) -> Vec<RBig> {
    let n = problem.order();
    let term = |i: usize, j: usize| {
        exact(problem.a()[(i, j)]) * &point.t[j] + exact(problem.b()[(i, j)]) * &point.y[j]
    };
    (0..n).map(|i| (0..n).fold(RBig::ZERO, |sum, j| sum + term(i, j))).collect()
}

/// `pi.A`, `pi.B` and `pi.c`.
fn products(problem: &HorizontalLcp, pi: &[RBig]) -> (Vec<RBig>, RBig) {
    let n = problem.order();
    let times = |entry: &dyn Fn(usize) -> f64| {
        (0..n).fold(RBig::ZERO, |sum, i| sum + exact(entry(i)) * &pi[i])
    };
    let columns =
        (0..n).flat_map(|j| [times(&|i| problem.a()[(i, j)]), times(&|i| problem.b()[(i, j)])]);
    (columns.collect(), times(&|i| problem.c()[i]))
}

fn is_nonnegative(point: &ExactPoint) -> bool {
    point.t.iter().chain(&point.y).all(|v| *v >= RBig::ZERO)
}

/// The sides that every point of a face has positive somewhere.
fn positive(face: &Face) -> (Vec<bool>, Vec<bool>) {
    let n = face.vertices[0].t.len();
    let points = || face.vertices.iter().chain(&face.rays);
    let t = (0..n).map(|j| points().any(|point| point.t[j] > RBig::ZERO)).collect();
    let y = (0..n).map(|j| points().any(|point| point.y[j] > RBig::ZERO)).collect();
    (t, y)
}

/// The columns of some variables, and zeros: the conditions of a face as linear ones.
fn restricted(problem: &HorizontalLcp, t: &[bool], y: &[bool]) -> HorizontalLcp {
    let n = problem.order();
    let keep = |keep: bool, v: f64| if keep { v } else { 0.0 };
    let a = Mat::from_fn(n, n, |i, j| keep(t[j], problem.a()[(i, j)]));
    let b = Mat::from_fn(n, n, |i, j| keep(y[j], problem.b()[(i, j)]));
    HorizontalLcp::new(a, b, problem.c().to_vec()).unwrap()
}

fn bases(n: usize) -> impl Iterator<Item = Basis> {
    let side = |bit: bool| if bit { Side::T } else { Side::Y };
    (0..1_u32 << n).map(move |bits| Basis::new((0..n).map(|j| side(bits >> j & 1 == 1)).collect()))
}

proptest! {
    #![proptest_config(cases(512))]

    /// What is reported solves the problem: vertices, rays, and any mixture of them.
    #[test]
    fn faces_consist_of_solutions(problem in problems()) {
        for face in all(&problem).faces {
            let c: Vec<RBig> = problem.c().iter().map(|&c| exact(c)).collect();
            let zero = vec![RBig::ZERO; problem.order()];
            prop_assert!(!face.vertices.is_empty());
            prop_assert!(face.vertices.iter().all(|v| is_nonnegative(v) && image(&problem, v) == c));
            prop_assert!(face.rays.iter().all(|r| is_nonnegative(r) && image(&problem, r) == zero));
            let (t, y) = positive(&face);
            prop_assert!(t.iter().zip(&y).all(|(t, y)| !(t & y)));
            // Inside a face the equations alone restrict the positive variables.
            let sides = t.iter().map(|&t| if t { Side::T } else { Side::Y }).collect();
            let rank = match verify_basis(&restricted(&problem, &t, &y), &Basis::new(sides)) {
                ExactVerdict::Singular { rank } => rank,
                _ => problem.order(),
            };
            let count = t.iter().chain(&y).filter(|positive| **positive).count();
            prop_assert_eq!(face.dimension, count - rank);
        }
    }

    /// What is a solution is reported: by the tree and the cones as by each basis alone.
    #[test]
    fn no_basis_is_forgotten(problem in problems()) {
        let found = all(&problem);
        let supports: Vec<_> = found.faces.iter().map(positive).collect();
        let mut has_basis = false;
        for basis in bases(problem.order()) {
            let is_t: Vec<bool> = basis.sides().iter().map(|&side| side == Side::T).collect();
            let is_y: Vec<bool> = is_t.iter().map(|t| !t).collect();
            let verdict = verify_basis(&problem, &basis);
            has_basis |= !matches!(verdict, ExactVerdict::Singular { .. });
            let covers = |inner: &[bool], outer: &[bool]| inner.iter().zip(outer).all(|(i, o)| !i || *o);
            match verdict {
                ExactVerdict::Solution { t, y } => {
                    let (in_t, in_y): (Vec<bool>, Vec<bool>) =
                        (t.iter().map(|&v| v > 0.0).collect(), y.iter().map(|&v| v > 0.0).collect());
                    prop_assert!(supports.iter().any(|(t, y)| covers(&in_t, t) && covers(&in_y, y)));
                    let vertices = || found.faces.iter().flat_map(|face| &face.vertices);
                    prop_assert!(vertices().any(|v| v.rounded() == (t.clone(), y.clone())));
                }
                ExactVerdict::Singular { .. } => {
                    let alone = feasibility(&restricted(&problem, &is_t, &is_y));
                    let Feasibility::Feasible(point) = alone else { continue };
                    let in_t: Vec<bool> = point.t.iter().map(|v| *v > RBig::ZERO).collect();
                    let in_y: Vec<bool> = point.y.iter().map(|v| *v > RBig::ZERO).collect();
                    prop_assert!(supports.iter().any(|(t, y)| covers(&in_t, t) && covers(&in_y, y)));
                }
                ExactVerdict::Infeasible { .. } => {}
            }
        }
        prop_assert_eq!(found.has_basis, has_basis);
    }

    /// Either a point or a proof, and both hold exactly.
    #[test]
    fn feasibility_comes_with_its_proof(problem in problems()) {
        match feasibility(&problem) {
            Feasibility::Feasible(point) => {
                let c: Vec<RBig> = problem.c().iter().map(|&c| exact(c)).collect();
                prop_assert!(is_nonnegative(&point));
                prop_assert_eq!(image(&problem, &point), c);
            }
            Feasibility::Infeasible { farkas } => {
                let (columns, right) = products(&problem, &farkas);
                prop_assert!(columns.iter().all(|v| *v <= RBig::ZERO) && right > RBig::ZERO);
                prop_assert!(!all(&problem).is_solvable());
            }
        }
    }
}
