//! A heavy beam on a rigid floor, lifted at one end: convergence to beam theory, with the shear locking of
//! four-node elements as it is known in closed form.

#[path = "../../examples/support/beam.rs"]
mod beam;
use crate::common;

use beam::{Beam, Uplift};
use common::assert_close;
use common::routes::solved_by;
use masonry::scene::{Joint, Route, Support};

fn uplift(slenderness: u32, elements_per_height: u32, rows: u32, route: Route) -> Uplift {
    let beam = Beam { slenderness, elements_per_height, rows };
    beam.uplift(&solved_by(&beam.scene(route), route)).unwrap()
}

/// What is lost of the rise falls as the square of the length of elements, and is what locking takes.
#[test]
fn locking_vanishes_with_the_square_of_the_element() {
    let missing = |per_height| 1.0 / uplift(40, per_height, 1, Route::Qp).lift - 1.0;
    let missing = [1, 2, 4].map(missing);
    for (k, missing) in missing.iter().enumerate() {
        // (a / h)^2 / 2.
        assert_close(*missing, 0.5 / 4_f64.powi(i32::try_from(k).unwrap()), 0.02);
    }
    for pair in missing.windows(2) {
        let rate = (pair[0] / pair[1]).log2();
        assert!((rate - 2.0).abs() < 0.03, "{missing:?}");
    }
}

/// Without what locking takes the rise tends to that of beam theory as the square of `h / l`; the length,
/// which ends in a contact about as long as the beam is high, as `h / l`.
#[test]
fn slender_beams_obey_beam_theory() {
    let differences = [10, 20, 40].map(|slenderness| {
        let beam = Beam { slenderness, elements_per_height: 8, rows: 1 };
        let Uplift { length, lift } =
            beam.uplift(&solved_by(&beam.scene(Route::Qp), Route::Qp)).unwrap();
        [lift / beam.locking() - 1.0, 1.0 - length]
    });
    assert!(differences[2][0].abs() < 5e-4 && differences[2][1].abs() < 0.02, "{differences:?}");
    for pair in differences.windows(2) {
        let rates = [0, 1].map(|k| (pair[0][k] / pair[1][k]).log2());
        assert!((rates[0] - 2.0).abs() < 0.1, "rise: {rates:?} of {differences:?}");
        assert!((rates[1] - 1.0).abs() < 0.1, "length: {rates:?} of {differences:?}");
    }
}

/// A second row of elements changes little, and all routes have the same answer.
#[test]
fn rows_and_routes_do_not_matter() {
    let program = uplift(20, 4, 1, Route::Qp);
    for route in [Route::Lemke, Route::Interior] {
        let other = uplift(20, 4, 1, route);
        assert_close(program.lift, other.lift, 1e-9);
        assert_close(program.length, other.length, 1e-9);
    }
    assert_close(uplift(20, 4, 2, Route::Qp).lift, program.lift, 1e-3);
}

/// Against a smooth stop, on a smooth floor, a beam may go away by any distance and is not pushed back: neither
/// its place nor a force at the stop is determined, and programs become as ill-conditioned as bending is.
#[test]
fn a_smooth_stop_that_nothing_presses_on() {
    for elements_per_height in [1, 2, 4] {
        let beam = Beam { slenderness: 20, elements_per_height, rows: 1 };
        let with_stop = |route| {
            let scene = beam
                .scene(route)
                .joint("smooth", Joint::mu(0.0))
                .joint("floor", Joint::mu(0.0))
                .support(Support::new("stop", [0.0, 0.1], [0.0, 0.0], "smooth"));
            beam.uplift(&solved_by(&scene, route)).unwrap()
        };
        let pivots = with_stop(Route::Lemke);
        for route in [Route::Qp, Route::Interior] {
            let other = with_stop(route);
            assert_close(other.lift, pivots.lift, 1e-8);
            assert_close(other.length, pivots.length, 1e-9);
        }
    }
}

/// The rise is thousands to millions of times what elements are deformed by.
#[test]
fn interior_points_find_how_far_a_beam_bends() {
    for (slenderness, elements_per_height) in [(20, 1), (40, 1), (10, 8), (40, 8)] {
        let [program, interior] = [Route::Qp, Route::Interior]
            .map(|route| uplift(slenderness, elements_per_height, 1, route));
        assert_close(interior.lift, program.lift, 1e-7);
        assert_close(interior.length, program.length, 1e-9);
    }
}
