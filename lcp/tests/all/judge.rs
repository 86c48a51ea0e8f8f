//! The judge of points can say no: problems of all classes that are made for a point, in all units, with blocks a
//! trillion times larger than others, and what must be seen when a little of that is changed.

#![allow(clippy::float_cmp)] // zeros of small integers

use crate::common;

mod bounded;
mod contact;
use crate::common::draw;
mod friction;
mod general;
mod planted;

use bounded::{Boxed, Mixed, Standard};
use common::cases;
use contact::{Contact, Rough, Smooth};
use friction::Reduced;
use general::General;
use lcp::Friction2d;
use planted::{
    Planted, assert_components_are_seen, assert_conditions_are_seen, assert_rows_are_seen,
    assert_solved, planted,
};
use proptest::prelude::*;

fn assert_judged<P: Planted>(seed: u64) {
    let planted: P = planted(seed);
    assert_solved(&planted);
    assert_components_are_seen(&planted);
    assert_rows_are_seen(&planted);
    assert_conditions_are_seen(&planted);
}

proptest! {
    #![proptest_config(cases(1024))]

    #[test]
    fn general_problems(seed in any::<u64>()) {
        assert_judged::<General>(seed);
    }

    #[test]
    fn standard_problems(seed in any::<u64>()) {
        assert_judged::<Standard>(seed);
    }

    #[test]
    fn mixed_problems(seed in any::<u64>()) {
        assert_judged::<Mixed>(seed);
    }

    #[test]
    fn boxed_problems(seed in any::<u64>()) {
        assert_judged::<Boxed>(seed);
    }

    #[test]
    fn contact_with_friction(seed in any::<u64>()) {
        assert_judged::<Contact<Rough>>(seed);
    }

    #[test]
    fn contact_without_friction(seed in any::<u64>()) {
        assert_judged::<Contact<Smooth>>(seed);
    }

    #[test]
    fn contact_that_is_reduced_to_the_contacts(seed in any::<u64>()) {
        assert_judged::<Reduced>(seed);
    }
}

/// A normal force whose column is zero is felt by no row. What rounding leaves of the velocity beside it is no contradiction.
#[test]
fn a_force_that_no_row_feels_is_not_the_smaller_of_its_pair() {
    let w = [[0.0, 3.0], [0.0, -3.0]];
    let solved = Friction2d::new(w, [-7.0, 3.0], [0.5]).unwrap();
    // The velocity is 3 r_T - 7, which the nearest number to 7/3 leaves at 4e-16.
    let normal = 14.0 / 3.0;
    let forces = solved.forces(&[normal, normal, 4.0]);
    assert!(3.0 * (7.0 / 3.0_f64) - 7.0 == 0.0 && forces.tangential[0] == 7.0 / 3.0);
    assert!(solved.residuals(&forces).worst() < 1e-15);
    // A velocity of one is.
    let opening = Friction2d::new(w, [-6.0, 3.0], [0.5]).unwrap();
    assert!(opening.residuals(&forces).worst() > 0.05);
}
