//! Long paths.

use lcp::faer::Mat;
use lcp::{Basis, Covering, Lcp, LemkeSettings, Side, WarmStart};
use lcp_problems::families::{self, Instance};

use super::case::Case;
use super::data::standard;
use super::problem::Problem;

pub const TITLE: &str = "Long paths";

/// The case that takes more pivots than any other.
pub const LONG: &str = "Murty in other units, all pivots";

pub fn cases() -> Vec<Case> {
    let exponential = "Lemke's method takes `2^n` pivots from all `w` with a covering vector of ones (it may choose others).";
    let mut list = Vec::new();
    for n in [10, 16, 20] {
        let murty = family(&format!("Murty, order {n}"), exponential, families::murty(n));
        list.push(
            murty.parameters(&format!("`families::murty({n})`, the first unit vector is planted")),
        );
        let fathi = family(&format!("Fathi, order {n}"), exponential, families::fathi(n));
        list.push(fathi.parameters(&format!("`families::fathi({n})`, the same")));
    }
    list.push(long());
    list
}

pub(super) fn family(name: &str, why: &'static str, instance: Instance<Lcp>) -> Case {
    Case::of(name, why, instance, (Problem::Standard, 1e6))
}

/// Murty's matrix with rows and columns in other units, so that no tableau has integers alone.
fn long() -> Case {
    const N: usize = 16;
    let why = "Rounding errors of 1e4 successive pivots accumulate in the basis.";
    let unit = |i: usize| 1.0 + i as f64 / 7.0;
    let m = families::murty(N).problem.m().to_dense();
    let m = Mat::from_fn(N, N, |i, j| unit(i) * m[(i, j)] * unit(j));
    let q: Vec<f64> = (0..N).map(|i| -unit(i)).collect();
    let settings = LemkeSettings {
        start: WarmStart::Basis(Basis::all(Side::Y, N)),
        covering: Covering::Given(
            (0..N).map(|i| unit(i) * (1.0 + 0.5_f64.powf(i as f64) / 100.0)).collect(),
        ),
        max_pivots: Some(1 << N),
        max_attempts: Some(1),
        ..LemkeSettings::default()
    };
    Case::new(LONG, why, standard(m, q))
        .parameters("`d_i m_ij d_j` with `m_ij` of Murty, `d_i = 1 + i / 7`, order 16, all `w` as the start, `(1 + 2^-i / 100) d` as the covering vector, with which no rows tie")
        .solvable("one solution, near the first unit vector")
        .lemke(settings)
}
