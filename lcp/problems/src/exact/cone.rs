//! Extreme rays of a polyhedral cone, by the double description method.

use std::time::Instant;

use dashu_int::ops::{Gcd, UnsignedAbs};
use dashu_int::{IBig, UBig};

use lcp::Error;

/// The limits of an enumeration on time and on the number of vertices and rays.
pub(super) struct Budget {
    pub(super) deadline: Option<Instant>,
    pub(super) generators: usize,
}

/// The reason for which an enumeration ends early.
pub(super) enum Stop {
    Time,
    Limit(Error),
}

impl Budget {
    /// Checks that time is left, and that this number of vertices and rays is allowed.
    pub(super) fn check(&self, value: usize) -> Result<(), Stop> {
        let limit = self.generators;
        if value > limit {
            let what = "number of vertices and rays";
            return Err(Stop::Limit(Error::Limit { what, value, name: "max_generators", limit }));
        }
        if is_over(self.deadline) { Err(Stop::Time) } else { Ok(()) }
    }
}

/// A generator of a cone with the inequalities that it meets with equality, as bits.
struct Generator {
    entries: Vec<IBig>,
    tight: u64,
}

/// The extreme rays, as primitive integer vectors, of `{x >= 0 : g.x >= 0 for every g}`.
///
/// Starting from the orthant, one inequality after the other cuts the cone. A new ray lies between
/// two neighbours on opposite sides of the cut; two rays are neighbours if no third one meets with
/// equality all inequalities that both of them do (Fukuda and Prodon 1996). The number of
/// inequalities is at most 64, including those of the orthant.
///
/// # Errors
/// If the budget is exhausted.
pub(super) fn extreme_rays(
    dimension: usize,
    inequalities: &[Vec<IBig>],
    budget: &Budget,
) -> Result<Vec<Vec<IBig>>, Stop> {
    let unit = |k: usize| {
        let entries = (0..dimension).map(|j| IBig::from(u8::from(j == k))).collect();
        Generator { entries, tight: ((1 << dimension) - 1) & !(1 << k) }
    };
    let mut rays: Vec<Generator> = (0..dimension).map(unit).collect();
    for (k, inequality) in inequalities.iter().enumerate() {
        rays = cut(rays, inequality, 1 << (dimension + k), budget)?;
    }
    Ok(rays.into_iter().map(|ray| ray.entries).collect())
}

fn cut(
    rays: Vec<Generator>,
    inequality: &[IBig],
    bit: u64,
    budget: &Budget,
) -> Result<Vec<Generator>, Stop> {
    let values: Vec<IBig> = rays.iter().map(|ray| product(inequality, &ray.entries)).collect();
    let mut new = Vec::new();
    for (above, a) in rays.iter().zip(&values).filter(|(_, a)| **a > IBig::ZERO) {
        budget.check(new.len())?;
        for (below, b) in rays.iter().zip(&values).filter(|(_, b)| **b < IBig::ZERO) {
            let shared = above.tight & below.tight;
            if rays.iter().filter(|ray| ray.tight & shared == shared).count() == 2 {
                let pairs = above.entries.iter().zip(&below.entries);
                let entries = pairs.map(|(above, below)| a * below - b * above).collect();
                new.push(Generator { entries: primitive(entries), tight: shared | bit });
            }
        }
    }
    for (mut ray, value) in rays.into_iter().zip(values).filter(|(_, v)| *v >= IBig::ZERO) {
        ray.tight |= if value.is_zero() { bit } else { 0 };
        new.push(ray);
    }
    budget.check(new.len())?;
    Ok(new)
}

pub(super) fn product(a: &[IBig], b: &[IBig]) -> IBig {
    a.iter().zip(b).fold(IBig::ZERO, |sum, (a, b)| sum + a * b)
}

/// The vector divided by the largest integer that divides all of its entries.
fn primitive(entries: Vec<IBig>) -> Vec<IBig> {
    let magnitudes = entries.iter().filter(|v| !v.is_zero()).map(UnsignedAbs::unsigned_abs);
    let content = IBig::from(
        magnitudes.fold(UBig::ZERO, |gcd, v| if gcd.is_zero() { v } else { gcd.gcd(v) }),
    );
    entries.into_iter().map(|v| v / &content).collect()
}

pub(super) fn is_over(deadline: Option<Instant>) -> bool {
    deadline.is_some_and(|deadline| Instant::now() >= deadline)
}
