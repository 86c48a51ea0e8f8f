//! The points that belong to free sets.

use super::factors::Factors;
use crate::random::SplitMix;
use crate::vector::{HALF_DIGITS, ROUNDING, SMALL, max_abs};
use crate::{Lcp, Matrix};

/// A complementary point: `z` is free for some pairs, `w` for the others.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub(super) is_free: Vec<bool>,
    pub(super) z: Vec<f64>,
    pub(super) w: Vec<f64>,
    /// Pairs with a negative variable, in ascending order.
    pub(super) violated: Vec<usize>,
    /// The most negative variable, in units of the largest of its vector.
    pub(super) residual: f64,
    /// The hash of the free set.
    pub(super) hash: u64,
}

/// Whether no entry off the diagonal is positive.
pub(crate) fn is_z_matrix(m: &Matrix) -> bool {
    (0..m.ncols()).all(|j| m.column(j).all(|(i, v)| i == j || v <= 0.0))
}

/// The problem, with a factorisation for its free sets.
pub(super) struct System<'a> {
    lcp: &'a Lcp,
    pub(super) is_z_matrix: bool,
    diagonal: Vec<f64>,
    pub(super) factors: Factors<'a>,
}

impl<'a> System<'a> {
    pub(super) fn new(lcp: &'a Lcp) -> Self {
        let m = lcp.m();
        let diagonal = (0..lcp.order()).map(|i| m[(i, i)]).collect();
        Self { lcp, is_z_matrix: is_z_matrix(m), diagonal, factors: Factors::new(m) }
    }

    /// The point after the exchange of so many of the pairs with a negative variable, the first ones.
    pub(super) fn exchanged(&mut self, point: &Point, count: usize) -> Option<Point> {
        let mut is_free = point.is_free.clone();
        point.violated.iter().take(count).for_each(|&i| is_free[i] = !is_free[i]);
        self.point(&is_free)
    }

    /// The point without the free variables that may be zero. Where both variables of a pair vanish, `z` is
    /// nothing but noise, which leaves rows with nothing larger in them a residual. None where there are
    /// no such variables.
    pub(super) fn without_noise(&mut self, point: &Point) -> Option<Point> {
        let roots = self.diagonal.iter().zip(&point.z).map(|(d, z)| d.sqrt() * z.abs());
        let size: Vec<f64> = roots.collect();
        let noise = SMALL * max_abs(&size);
        let is_kept: Vec<bool> = point
            .is_free
            .iter()
            .zip(&size)
            .map(|(is_free, size)| *is_free && *size > noise)
            .collect();
        if is_kept == point.is_free { None } else { self.point(&is_kept) }
    }

    /// The point of a free set; none where its matrix is singular to working precision.
    pub(super) fn point(&mut self, is_free: &[bool]) -> Option<Point> {
        if !is_free.contains(&true) {
            let z = vec![0.0; is_free.len()];
            let image = Image::new(self.lcp, &z);
            return Some(self.judged(is_free.to_vec(), z, image));
        }
        if !self.factors.factorise(is_free) {
            return None;
        }
        let (z, image) = solved(self.lcp, &self.factors, is_free)?;
        Some(self.judged(is_free.to_vec(), z, image))
    }

    fn judged(&self, is_free: Vec<bool>, mut z: Vec<f64>, image: Image) -> Point {
        let Image { mut w, size } = image;
        let (mut violated, mut hash) = (Vec::new(), 0);
        for i in 0..z.len() {
            let value = if is_free[i] {
                hash ^= SplitMix::new(i as u64).next_u64();
                w[i] = 0.0;
                z[i] * self.diagonal[i]
            } else {
                w[i]
            };
            if value < -ROUNDING * size[i] {
                violated.push(i);
            } else if value < 0.0 {
                (z[i], w[i]) = (0.0, 0.0);
            }
        }
        let (z_max, w_max) = (max_abs(&z), max_abs(&w));
        let residual = violated.iter().fold(0.0_f64, |worst, &i| {
            worst.max(if is_free[i] { -z[i] / z_max } else { -w[i] / w_max })
        });
        Point { is_free, z, w, violated, residual, hash }
    }
}

/// `M_FF z_F = -q_F`; none where it cannot be solved.
fn solved(lcp: &Lcp, factors: &Factors<'_>, is_free: &[bool]) -> Option<(Vec<f64>, Image)> {
    let of_free = lcp.q().iter().zip(is_free).map(|(q, is_free)| if *is_free { -q } else { 0.0 });
    let mut z: Vec<f64> = of_free.collect();
    factors.solve(&mut z);
    let image = Image::new(lcp, &z);
    let is_solved = image.error(is_free) <= HALF_DIGITS && !is_in_kernel(lcp, is_free, &image.size);
    is_solved.then_some((z, image))
}

/// Whether `q` has no share in the equations of a solution: then that is in the kernel of `M_FF`, for which
/// a factorisation does not always find a vanishing pivot.
fn is_in_kernel(lcp: &Lcp, is_free: &[bool], size: &[f64]) -> bool {
    let mut rows = lcp.q().iter().zip(size).zip(is_free).filter(|(_, is_free)| **is_free);
    lcp.q().iter().zip(is_free).any(|(q, is_free)| *is_free && *q != 0.0)
        && rows.all(|((q, size), _)| q.abs() <= SMALL * size)
}

/// `w = M z + q`, and the sums of the sizes of its terms.
struct Image {
    w: Vec<f64>,
    size: Vec<f64>,
}

impl Image {
    fn new(lcp: &Lcp, z: &[f64]) -> Self {
        let mut w = lcp.q().to_vec();
        let mut size: Vec<f64> = w.iter().map(|q| q.abs()).collect();
        for (j, &z) in z.iter().enumerate().filter(|(_, z)| **z != 0.0) {
            lcp.m().slice(j).add_with_sizes(z, &mut w, &mut size);
        }
        Self { w, size }
    }

    /// The largest `|w_i|` of a free pair, relative to its terms; not finite where a `w` is not.
    fn error(&self, is_free: &[bool]) -> f64 {
        let mut worst = 0.0_f64;
        for ((w, size), is_free) in self.w.iter().zip(&self.size).zip(is_free) {
            if !w.is_finite() || !size.is_finite() {
                return f64::INFINITY;
            }
            if *is_free && *size > 0.0 {
                worst = worst.max(w.abs() / size);
            }
        }
        worst
    }
}
