//! Acceleration of a fixed point.

use faer::Mat;
use faer::prelude::SolveLstsq;

/// Steps that are remembered.
const MEMORY: usize = 5;

/// The next point of the iteration `g = T(g)` from the ones before (Anderson 1965; Walker and Ni 2011),
/// kept from going astray: an accelerated step that is worse than what was met before is taken back.
#[derive(Debug, Default)]
pub(super) struct Anderson {
    /// Points and their `T(g) - g`, the newest last.
    steps: Vec<(Vec<f64>, Vec<f64>)>,
    /// The point with the least residual.
    best: Option<(Vec<f64>, Vec<f64>, f64)>,
    /// Steps since the residual went down by more than a tenth.
    idle: usize,
    plain: bool,
}

impl Anderson {
    /// Rounds without progress so far.
    pub(super) fn idle(&self) -> usize {
        self.idle
    }

    /// Forgets the points, but not the best one, to which it goes back by half.
    pub(super) fn retreat(&mut self, from: &[f64]) -> Option<Vec<f64>> {
        self.steps.clear();
        self.plain = true;
        self.idle += 1;
        let (g, residual, _) = self.best.as_ref()?;
        let target = g.iter().zip(residual).map(|(g, r)| (g + 0.5 * r).max(0.0));
        Some(target.zip(from).map(|(target, from)| 0.5 * (target + from)).collect())
    }

    /// The next point, not negative, after `image = T(g)`.
    pub(super) fn next(&mut self, g: &[f64], image: &[f64]) -> Vec<f64> {
        let residual: Vec<f64> = image.iter().zip(g).map(|(image, g)| image - g).collect();
        let size = norm(&residual);
        let least = self.best.as_ref().map_or(f64::INFINITY, |(_, _, size)| *size);
        self.idle = if size < 0.9 * least { 0 } else { self.idle + 1 };
        let is_astray = size > 2.0 * least && !self.plain;
        if size < least {
            self.best = Some((g.to_vec(), residual.clone(), size));
        }
        if is_astray && let Some((best, residual, _)) = &self.best {
            self.steps.clear();
            self.plain = true;
            return best.iter().zip(residual).map(|(g, r)| (g + 0.5 * r).max(0.0)).collect();
        }
        self.steps.push((g.to_vec(), residual));
        if self.steps.len() > MEMORY + 1 {
            self.steps.remove(0);
        }
        let mixed = self.mixed();
        self.plain = mixed.is_none();
        mixed.unwrap_or_else(|| image.to_vec()).into_iter().map(|g| g.max(0.0)).collect()
    }

    /// The combination of the last images whose residual is least.
    fn mixed(&self) -> Option<Vec<f64>> {
        /// Keeps the weights small where the differences are nearly dependent.
        const TIKHONOV: f64 = 1e-10;
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
                    let of_image = difference(k, i) + last.0[i] - older[k].0[i];
                    weights[(k, 0)] / sizes[k] * of_image
                });
                last.0[i] + last.1[i] - change.sum::<f64>()
            })
            .collect();
        next.iter().all(|v| v.is_finite()).then_some(next)
    }
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
        for _ in 0..8 {
            g = anderson.next(&g, &map(&g));
        }
        let error = g.iter().zip([2.0, 2.0, 1.0]).map(|(g, exact)| (g - exact).abs());
        assert!(error.fold(0.0, f64::max) < 1e-8, "{g:?}");
    }
}
