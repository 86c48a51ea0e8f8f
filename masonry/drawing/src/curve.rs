//! Curves as polylines of chords.

use std::f64::consts::{FRAC_PI_6, TAU};

use nalgebra::{Point2, Rotation2, Vector2};

/// The largest angle of one chord \[rad\]. Chosen: voussoirs have one chord on each side if a semicircle has six or
/// more voussoirs, so that the intrados does not make them concave; a chord of 30 degrees differs from its arc by 3 %
/// of its length.
const CHORD: f64 = FRAC_PI_6;
/// The part of a chord's angle that counts as a rounding error, so that an arc of 30 degrees is one chord.
const ROUNDING: f64 = 1e-6;

/// Points of a curve, and the largest distance `off` between the curve and its chords.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chords {
    pub(super) points: Vec<Point2<f64>>,
    pub(super) off: f64,
}

/// An arc about a centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    pub(super) centre: Point2<f64>,
    pub(super) radius: f64,
    /// The angle of the first point of the arc \[rad\].
    pub(super) from: f64,
    /// The angle from the first to the last point, counter-clockwise \[rad\].
    pub(super) sweep: f64,
}

impl Arc {
    /// Returns a whole circle.
    pub(super) fn circle(centre: Point2<f64>, radius: f64) -> Self {
        Self { centre, radius, from: 0.0, sweep: TAU }
    }

    pub(super) fn chords(self) -> Chords {
        let count = chords_of(self.sweep);
        let angle = self.sweep / f64::from(count);
        let at = |k: u32| {
            let (sin, cos) = (self.from + angle * f64::from(k)).sin_cos();
            self.centre + Vector2::new(cos, sin) * self.radius
        };
        let off = self.radius.abs() * (1.0 - (0.5 * angle).cos());
        Chords { points: (0..=count).map(at).collect(), off }
    }
}

/// Returns the chords of an arc between two points; `bulge` is the tangent of a quarter of the angle of the arc. The
/// points include the first point, but not the last.
pub(super) fn bulged([from, to]: [Point2<f64>; 2], bulge: f64) -> Chords {
    if bulge == 0.0 || from == to || !bulge.is_finite() {
        return Chords { points: vec![from], off: 0.0 };
    }
    let chord = to - from;
    let left = Vector2::new(-chord.y, chord.x);
    let centre = from + chord * 0.5 + left * ((1.0 - bulge * bulge) / (4.0 * bulge));
    let sweep = 4.0 * bulge.atan();
    let count = chords_of(sweep);
    let angle = sweep / f64::from(count);
    let at = |k: u32| match k {
        0 => from,
        _ => centre + Rotation2::new(angle * f64::from(k)) * (from - centre),
    };
    let off = (from - centre).norm() * (1.0 - (0.5 * angle).cos());
    Chords { points: (0..count).map(at).collect(), off }
}

/// Returns the chords of a cubic Bezier curve. The points include the last point, but not the first.
pub(super) fn cubic(points: [Point2<f64>; 4]) -> Chords {
    let sides: Vec<_> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let sides: Vec<_> = sides.into_iter().filter(|side| side.norm() > 0.0).collect();
    let turned: f64 = sides.windows(2).map(|pair| pair[0].angle(&pair[1])).sum();
    let count = chords_of(turned);
    let at = |t: f64| {
        let s = 1.0 - t;
        let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        let sum = weights.iter().zip(&points).map(|(weight, point)| point.coords * *weight);
        Point2::from(sum.fold(Vector2::zeros(), |sum, it| sum + it))
    };
    let step = 1.0 / f64::from(count);
    let off = |k: u32| {
        let [from, middle, to] = [0.0, 0.5, 1.0].map(|part| at(step * (f64::from(k) + part)));
        (middle - nalgebra::center(&from, &to)).norm()
    };
    let off = (0..count).map(off).fold(0.0, f64::max);
    let last = |k: u32| if k == count { points[3] } else { at(step * f64::from(k)) };
    Chords { points: (1..=count).map(last).collect(), off }
}

/// Returns the number of chords of an arc with this angle \[rad\].
fn chords_of(angle: f64) -> u32 {
    let turns = (angle.abs() / TAU).min(1.0);
    // The number of chords is at most twelve.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 12")]
    let count = (turns * (TAU / CHORD) - ROUNDING).ceil() as u32;
    count.max(1)
}
