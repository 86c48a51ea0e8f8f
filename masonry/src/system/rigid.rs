//! Rigid motions of the blocks, and the choice of contact rows that hold the blocks in a statically determinate way.

use faer::Mat;
use nalgebra::{Matrix3, Point2, Vector2, Vector3};

use crate::geometry;
use crate::model::PlacedForce;

mod isostatic;

pub use isostatic::{FreeMotion, Isostatic, RigidError, choose};

/// The three rigid motions of a block: two translations, and a rotation about the centroid.
///
/// The rotation is divided by the distance of the farthest corner, so that all three amplitudes are
/// displacements \[m\] and none moves the block by more than its amplitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Modes {
    /// The centroid of the block.
    pub centre: Point2<f64>,
    /// Distance of the farthest corner from the centroid \[m\].
    pub length: f64,
}

impl Modes {
    /// Returns the rigid motions of a block with these corners.
    pub fn of(corners: &[Point2<f64>]) -> Self {
        let centre = geometry::centroid(corners);
        let length = corners.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max);
        Self { centre, length }
    }

    /// Returns the displacement of the material at `place` in each of the three motions, for amplitude 1.
    pub fn at(&self, place: Point2<f64>) -> [Vector2<f64>; 3] {
        let arm = (place - self.centre) / self.length;
        [Vector2::x(), Vector2::y(), Vector2::new(-arm.y, arm.x)]
    }

    /// Returns the displacement \[m\] of the material at `place` for three amplitudes \[m\].
    pub fn displacement(&self, place: Point2<f64>, amplitudes: &[f64]) -> Vector2<f64> {
        self.at(place).iter().zip(amplitudes).map(|(mode, amplitude)| mode * *amplitude).sum()
    }

    /// Returns the amplitudes \[m\] of the rigid motion nearest to given displacements \[m\] of places, and the
    /// largest remainder of the displacements \[m\].
    ///
    /// # Panics
    /// As [`amplitudes`](Self::amplitudes).
    pub fn nearest(&self, places: &[Point2<f64>], moved: &[Vector2<f64>]) -> ([f64; 3], f64) {
        let amplitudes = self.amplitudes(places, moved);
        let rest = places.iter().zip(moved);
        let rest = rest.map(|(place, u)| (u - self.displacement(*place, &amplitudes)).norm());
        // NaN stays NaN.
        (amplitudes, rest.fold(0.0, |max, it| if it > max || it.is_nan() { it } else { max }))
    }

    /// Returns the amplitudes \[m\] of the rigid motion nearest to given displacements \[m\] of places, by least
    /// squares.
    ///
    /// # Panics
    /// If all places lie on one line.
    pub fn amplitudes(&self, places: &[Point2<f64>], moved: &[Vector2<f64>]) -> [f64; 3] {
        let (mut matrix, mut rhs) = (Matrix3::zeros(), Vector3::zeros());
        for (place, u) in places.iter().zip(moved) {
            let modes = self.at(*place);
            matrix += Matrix3::from_fn(|i, j| modes[i].dot(&modes[j]));
            rhs += Vector3::from_fn(|i, _| modes[i].dot(u));
        }
        matrix.cholesky().expect("places that do not lie on one line").solve(&rhs).into()
    }

    /// Returns the work \[N\] of a force \[N\] at `place` in the three motions, for amplitude 1: the two components of
    /// the force, and its moment about the centroid divided by [`Modes::length`].
    pub fn resultant(&self, place: Point2<f64>, force: Vector2<f64>) -> [f64; 3] {
        self.at(place).map(|mode| mode.dot(&force))
    }

    /// Returns the work \[N\] of a placed force with its moment in the three motions, for amplitude 1.
    pub fn work_of(&self, it: &PlacedForce) -> [f64; 3] {
        let [x, y, turn] = self.resultant(it.at, it.force);
        [x, y, turn + it.moment / self.length]
    }
}

/// Returns the rows of a matrix with the given indices, in the order of the indices.
pub(crate) fn select_rows(matrix: &Mat<f64>, rows: &[usize]) -> Mat<f64> {
    Mat::from_fn(rows.len(), matrix.ncols(), |i, j| matrix[(rows[i], j)])
}
