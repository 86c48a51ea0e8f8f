//! Gauss points on an interval and on the reference square.

/// The two Gauss points of the interval -1..1, which integrate cubic polynomials exactly; both weights are 1.
pub const GAUSS_2: [f64; 2] = [-0.577_350_269_189_625_8, 0.577_350_269_189_625_8];

/// Returns the 2 x 2 Gauss points of the reference square, which integrate polynomials of degree three in each
/// direction exactly; all weights are 1.
pub fn square() -> impl Iterator<Item = [f64; 2]> {
    GAUSS_2.into_iter().flat_map(|eta| GAUSS_2.into_iter().map(move |xi| [xi, eta]))
}
