//! Hard problems of the library `lcp` itself: by every method a right answer, or the word that there is none.

#[path = "problems/case.rs"]
mod case;
#[path = "problems/conditioning.rs"]
mod conditioning;
#[path = "problems/data.rs"]
mod data;
#[path = "problems/edges.rs"]
mod edges;
#[path = "problems/friction.rs"]
mod friction;
#[path = "problems/measure.rs"]
mod measure;
#[path = "problems/page.rs"]
mod page;
#[path = "problems/pivots.rs"]
mod pivots;
#[path = "problems/problem.rs"]
mod problem;
#[path = "problems/redundant.rs"]
mod redundant;
#[path = "problems/scaling.rs"]
mod scaling;
#[path = "problems/several.rs"]
mod several;
#[path = "problems/sweeps.rs"]
mod sweeps;
#[path = "problems/ties.rs"]
mod ties;
#[path = "problems/unsolvable.rs"]
mod unsolvable;

use std::sync::LazyLock;

use super::double;
use case::{Case, End, Theme, Tried};
use data::{dominant, rescaled, strict};
use lcp::faer::{Mat, mat};
use lcp::{BoxedLcp, Contact2d, Error, Friction2d, HorizontalLcp, Lcp, MixedLcp, Status};
use measure::{largest, of_general};
pub use page::page;
#[allow(unused_imports, reason = "the bench of stability draws them")]
pub use problem::Method;
#[allow(unused_imports, reason = "the bench of stability draws them")]
pub use sweeps::{Found, Sweep, sweeps};

/// All themes, solved once for all tests.
pub static THEMES: LazyLock<Vec<Theme>> = LazyLock::new(|| {
    let tried = |title, cases: Vec<Case>| Theme {
        title,
        cases: cases.into_iter().map(Case::tried).collect(),
    };
    vec![
        tried(ties::TITLE, ties::cases()),
        tried(redundant::TITLE, redundant::cases()),
        tried(conditioning::TITLE, conditioning::cases()),
        tried(scaling::TITLE, scaling::cases()),
        tried(unsolvable::TITLE, unsolvable::cases()),
        tried(several::TITLE, several::cases()),
        tried(pivots::TITLE, pivots::cases()),
        tried(friction::TITLE, friction::cases()),
        tried(edges::TITLE, edges::cases()),
    ]
});

/// What is called solved is, what is called unsolvable is proved to be, and what is known is true.
#[test]
fn answers_and_proofs() {
    let tried = THEMES.iter().flat_map(|theme| &theme.cases);
    let wrong: Vec<String> = tried.flat_map(Tried::wrong).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The errors of ten thousand pivots are those of one.
#[test]
fn long_paths_do_not_drift() {
    let tried = THEMES.iter().flat_map(|theme| &theme.cases);
    let long = tried.into_iter().find(|tried| tried.case.name == pivots::LONG).unwrap();
    for (method, end) in Method::ALL.into_iter().zip(&long.ends) {
        let End::Ended { solution, measure } = end else { continue };
        if matches!(method, Method::LemkeDense | Method::LemkeSparse) {
            assert!(solution.info.pivots >= 10_000, "{method:?}: {}", solution.info.pivots);
            assert!(measure.residual <= 1e-14, "{method:?}: {measure:?}");
        }
    }
}

#[test]
fn sweeps_over_parameters() {
    for sweep in sweeps() {
        assert!(sweep.wrong.is_empty(), "{}:\n{}", sweep.name, sweep.wrong.join("\n"));
        for (method, found) in &sweep.methods {
            assert_eq!(found.len(), sweep.values.len());
            for (value, found) in sweep.values.iter().zip(found.iter().flatten()) {
                let words = format!("{}, {} = {value:e}: {found:?}", sweep.name, sweep.parameter);
                let is_right = found.residual <= 1.0001e-10 && found.backward <= 1e-8;
                assert!(found.status != Status::Solved || is_right, "{method:?}, {words}");
            }
        }
        if !sweep.is_solvable {
            continue;
        }
        let is_solved = |it: &&Found| it.status == Status::Solved;
        for (k, value) in sweep.values.iter().enumerate() {
            let mut found = sweep.methods.iter().filter_map(|(_, found)| found[k].as_ref());
            assert!(found.any(|it| is_solved(&it)), "{}: {value:e} by no method", sweep.name);
        }
        // Pivots on dense matrices do not mind.
        let lemke = sweep.methods[0].1.iter().flatten();
        assert!(lemke.clone().filter(is_solved).count() == lemke.count(), "{}", sweep.name);
    }
}

/// What is no number is refused with its place, before any method sees it.
#[test]
fn numbers_that_are_none_are_refused() {
    let one = |v: f64| mat![[v]];
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let none = || vec![bad];
        let zero = || vec![0.0];
        let refused = [
            Lcp::new(one(bad), zero()).err(),
            Lcp::new(one(1.0), none()).err(),
            HorizontalLcp::new(one(1.0), one(bad), zero()).err(),
            HorizontalLcp::new(one(1.0), one(1.0), none()).err(),
            MixedLcp::new(one(bad), zero(), vec![true]).err(),
            BoxedLcp::new(one(1.0), none(), zero(), zero()).err(),
            Friction2d::new(Mat::full(2, 2, bad), vec![0.0; 2], zero()).err(),
            Friction2d::new(Mat::full(2, 2, 1.0), vec![0.0; 2], none()).err(),
            Contact2d::new(one(bad), zero(), one(1.0), one(1.0), zero(), zero(), zero()).err(),
            Contact2d::new(one(1.0), zero(), one(1.0), one(1.0), none(), zero(), zero()).err(),
            Contact2d::new(one(1.0), zero(), one(1.0), one(1.0), zero(), zero(), none()).err(),
        ];
        for error in refused {
            assert!(matches!(error, Some(Error::NotFinite { row: 0, .. })), "{error:?}");
        }
        let bounds = BoxedLcp::new(one(1.0), zero(), vec![f64::NAN], zero()).err();
        assert!(matches!(bounds, Some(Error::Bounds { index: 0, .. })), "{bounds:?}");
    }
}

/// A millionth more or less of any number of an answer is seen.
#[test]
fn measures_see_what_is_wrong() {
    let (problem, (t, y)) = rescaled(&dominant(6), &strict(6), (&[498.0; 6], &[-996.0; 6]));
    let general = problem.general();
    assert!(of_general(&general, (&t, &y)).residual <= 0.0);
    for i in 0..6 {
        let change = |x: &[f64], by: f64| {
            let mut x = x.to_vec();
            x[i] += by * largest(&x);
            x
        };
        for by in [1e-6, -1e-6, f64::NAN] {
            for point in [(change(&t, by), y.clone()), (t.clone(), change(&y, by))] {
                let measure = of_general(&general, (&point.0, &point.1));
                assert!(
                    measure.residual > 1e-9 && measure.backward > 1e-9,
                    "{i}, {by}: {measure:?}"
                );
            }
        }
    }
}
