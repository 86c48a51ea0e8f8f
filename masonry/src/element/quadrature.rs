//! Gauss points on an interval and on the reference square.

/// The two Gauss points of the interval -1..1; both weights are 1. Exact for cubics.
pub const GAUSS_2: [f64; 2] = [-0.577_350_269_189_625_8, 0.577_350_269_189_625_8];

/// The 2 x 2 Gauss points of the reference square; all weights are 1. Exact for polynomials of
/// degree three in each direction.
pub fn square() -> impl Iterator<Item = [f64; 2]> {
    GAUSS_2.into_iter().flat_map(|eta| GAUSS_2.into_iter().map(move |xi| [xi, eta]))
}
