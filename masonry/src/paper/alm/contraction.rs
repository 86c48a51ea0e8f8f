//! Estimate of the distance between the last member of a linearly convergent sequence and its limit.

/// The number of last steps whose largest is compared with the largest of as many steps before: a single small step
/// does not show convergence.
const HALF: usize = 8;

use super::ROUNDING;

/// The sizes of the last steps of a sequence of vectors, from which its distance to the limit is estimated.
#[derive(Debug, Clone)]
pub(super) struct Contraction {
    /// The least size by which a step is divided, for vectors whose own size is smaller.
    unit: f64,
    /// The sizes of the steps divided by the sizes of the vectors \[-\], the last step first.
    steps: Vec<f64>,
}

impl Contraction {
    pub(super) fn new(unit: f64) -> Self {
        Self { unit, steps: Vec::new() }
    }

    /// Records the step of the sequence from the vector `from` to the next vector `to`.
    pub(super) fn record(&mut self, from: &[f64], to: &[f64]) {
        let moved = from.iter().zip(to).fold(0.0_f64, |max, (a, b)| max.max((a - b).abs()));
        let size = to.iter().fold(self.unit, |max, v| max.max(v.abs()));
        self.steps.truncate(2 * HALF - 1);
        // Rounding errors oscillate and do not shrink.
        self.steps.insert(0, if moved > ROUNDING * size { moved / size } else { 0.0 });
    }

    /// Estimates the distance of the last vector from the limit, relative to the size of the vector: `s (q + q^2 +
    /// ...)` for a last step of size `s` and steps that shrink by the factor `q`. Infinite if the steps do not shrink,
    /// or if there are too few steps.
    pub(super) fn remaining(&self) -> f64 {
        let largest = |steps: &[f64]| steps.iter().fold(0.0_f64, |max, s| max.max(*s));
        let (late, early) = self.steps.split_at(HALF.min(self.steps.len()));
        let (late, early) = (largest(late), largest(early));
        if self.steps.len() < 2 * HALF || late >= early {
            return if late > 0.0 || self.steps.len() < 2 { f64::INFINITY } else { 0.0 };
        }
        let rate = (late / early).powf(1.0 / HALF as f64);
        // The last step is the largest of the late ones, times the ratio of the late to the early steps.
        late * (late / early) / (1.0 - rate)
    }
}
