//! Acceleration of a fixed point.

use faer::Mat;
use faer::prelude::SolveLstsq;

use super::constants::{DAMPING, IDLE, MEMORY, PLAIN_IDLE, TIKHONOV};

/// The next point of the iteration `g = T(g)` from the ones before (Anderson 1965; Walker and Ni 2011),
/// damped and kept from going astray: an accelerated step that is worse than what was met before is taken
/// back, and where there is no progress the iteration goes on with damped steps alone.
#[derive(Debug, Default)]
pub(super) struct Anderson {
    /// Points and their `T(g) - g`, the newest last.
    steps: Vec<(Vec<f64>, Vec<f64>)>,
    /// The point with the least residual.
    best: Option<(Vec<f64>, Vec<f64>, f64)>,
    /// Steps since the residual went down by more than a tenth.
    idle: usize,
    /// Whether the last step was a damped one without acceleration.
    was_plain: bool,
    is_plain: bool,
}

impl Anderson {
    /// Steps without progress so far.
    pub(super) fn idle(&self) -> usize {
        self.idle
    }

    /// Whether the iteration does not contract.
    pub(super) fn is_stalled(&self) -> bool {
        self.is_plain && self.idle > PLAIN_IDLE
    }

    /// A point between the best one and one that has no image; none where there is no best one.
    pub(super) fn retreat(&mut self, from: &[f64]) -> Option<Vec<f64>> {
        let (g, residual, _) = self.best.as_ref()?;
        let target = damped(g, residual);
        self.steps.clear();
        self.was_plain = true;
        self.count(false);
        Some(target.iter().zip(from).map(|(target, from)| 0.5 * (target + from)).collect())
    }

    /// The next point, not negative, after `image = T(g)`.
    pub(super) fn next(&mut self, g: &[f64], image: &[f64]) -> Vec<f64> {
        let residual: Vec<f64> = image.iter().zip(g).map(|(image, g)| image - g).collect();
        let size = norm(&residual);
        let least = self.best.as_ref().map_or(f64::INFINITY, |(_, _, size)| *size);
        let is_first = self.best.is_none();
        self.count(size < 0.9 * least);
        let is_astray = size > 2.0 * least && !self.was_plain;
        if size < least {
            self.best = Some((g.to_vec(), residual.clone(), size));
        }
        if is_first {
            // The first bounds are a guess from which nothing is to be kept.
            return image.iter().map(|v| v.max(0.0)).collect();
        }
        self.was_plain = true;
        if self.is_plain {
            return damped(g, &residual);
        }
        if is_astray && let Some((best, residual, _)) = &self.best {
            self.steps.clear();
            return damped(best, residual);
        }
        self.steps.push((g.to_vec(), residual));
        if self.steps.len() > MEMORY + 1 {
            self.steps.remove(0);
        }
        if let Some(mixed) = self.mixed() {
            self.was_plain = false;
            return mixed.into_iter().map(|v| v.max(0.0)).collect();
        }
        self.steps.last().map_or_else(|| image.to_vec(), |(g, residual)| damped(g, residual))
    }

    fn count(&mut self, is_progress: bool) {
        self.idle = if is_progress { 0 } else { self.idle + 1 };
        if !self.is_plain && self.idle > IDLE {
            (self.is_plain, self.idle) = (true, 0);
        }
    }

    /// The combination of the last images whose residual is least.
    fn mixed(&self) -> Option<Vec<f64>> {
        let (last, older) = self.steps.split_last()?;
        let (n, count) = (last.0.len(), older.len());
        if count == 0 {
            return None;
        }
        let difference = |k: usize, i: usize| last.1[i] - older[k].1[i];
        let sizes: Vec<f64> = (0..count)
            .map(|k| norm(&(0..n).map(|i| difference(k, i)).collect::<Vec<_>>()))
            .collect();
        if sizes.iter().any(|size| *size <= 0.0) {
            return None;
        }
        let matrix = Mat::from_fn(n + count, count, |i, k| match i.checked_sub(n) {
            None => difference(k, i) / sizes[k],
            Some(row) if row == k => TIKHONOV,
            Some(_) => 0.0,
        });
        let rhs = Mat::from_fn(n + count, 1, |i, _| if i < n { last.1[i] } else { 0.0 });
        let weights = matrix.qr().solve_lstsq(&rhs);
        let next: Vec<f64> = (0..n)
            .map(|i| {
                let change = (0..count).map(|k| {
                    let of_image = DAMPING * difference(k, i) + last.0[i] - older[k].0[i];
                    weights[(k, 0)] / sizes[k] * of_image
                });
                last.0[i] + DAMPING * last.1[i] - change.sum::<f64>()
            })
            .collect();
        next.iter().all(|v| v.is_finite()).then_some(next)
    }
}

fn damped(g: &[f64], residual: &[f64]) -> Vec<f64> {
    g.iter().zip(residual).map(|(g, r)| (g + DAMPING * r).max(0.0)).collect()
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A linear map that contracts slowly: with as many remembered steps as it has modes it is solved.
    #[test]
    fn a_linear_map_is_solved_in_a_few_steps() {
        let map = |g: &[f64]| vec![0.99 * g[0] + 0.02, -0.95 * g[1] + 3.9, 0.5 * g[2] + 0.5];
        let mut anderson = Anderson::default();
        let mut g = vec![0.0; 3];
        for _ in 0..12 {
            g = anderson.next(&g, &map(&g));
        }
        let error = g.iter().zip([2.0, 2.0, 1.0]).map(|(g, exact)| (g - exact).abs());
        assert!(error.fold(0.0, f64::max) < 1e-8, "{g:?}");
    }
}
