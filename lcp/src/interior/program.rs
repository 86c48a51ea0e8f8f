//! Convex programs in few free variables with many forces on them.

use faer::sparse::{FaerError, SparseColMat};
use lcp_linalg::Gram;

use crate::matrix::add_image;
use crate::problem::{column_of, diagonal};
use crate::scaling::{multiply, power_of_two};
use crate::vector::{SMALL, max_abs};

/// `K u = f + A t`, `y = A^T u + D t + x_0`, `0 <= t _|_ y >= 0`, with a diagonal `D >= 0`.
pub(super) struct Program {
    pub(super) k: SparseColMat<usize, f64>,
    pub(super) f: Vec<f64>,
    /// The effect of every force on the free variables.
    pub(super) a: SparseColMat<usize, f64>,
    pub(super) x_0: Vec<f64>,
    pub(super) compliance: Vec<f64>,
}

/// The units of the variables of a program.
pub(super) struct Units {
    column: Vec<f64>,
    pub(super) force: f64,
    pub(super) length: f64,
}

impl Units {
    /// The free variables in the units of the program as it was given.
    pub(super) fn displacements(&self, u: &[f64]) -> Vec<f64> {
        u.iter().zip(&self.column).map(|(u, d)| u * d * self.length).collect()
    }
}

impl Program {
    /// Forces of least size along these columns that, together with the stiffness, balance the loads `f` on the
    /// free variables.
    pub(super) fn of_least_forces(
        k: SparseColMat<usize, f64>,
        f: Vec<f64>,
        a: SparseColMat<usize, f64>,
    ) -> Self {
        let count = a.ncols();
        Self { k, f, a, x_0: vec![0.0; count], compliance: vec![1.0; count] }
    }

    /// The program with variables of order one, and their units.
    pub(super) fn scaled(mut self) -> (Self, Units) {
        let mut largest = vec![0.0_f64; self.f.len()];
        for entry in self.a.triplet_iter() {
            largest[entry.row] = largest[entry.row].max(entry.val.abs());
        }
        let factor = |n: &f64| if *n > 0.0 { power_of_two(1.0 / n) } else { 1.0 };
        let column: Vec<f64> = largest.iter().map(factor).collect();
        self.f.iter_mut().zip(&column).for_each(|(f, d)| *f *= d);
        let (load, gap, soft) = (max_abs(&self.f), max_abs(&self.x_0), max_abs(&self.compliance));
        let stiff: Vec<f64> =
            diagonal(&self.k).iter().zip(&column).map(|(k, d)| k * d * d).collect();
        let compliance = match (soft, max_abs(&stiff)) {
            (soft, _) if soft > 0.0 => soft,
            (_, stiff) if stiff > 0.0 => 1.0 / stiff,
            _ => 1.0,
        };
        let force = if load > 0.0 { load } else { gap / compliance };
        let force = power_of_two(if force > 0.0 { force } else { 1.0 });
        let length = power_of_two(force * compliance);
        multiply(&mut self.k, |i, j| column[i] * column[j] * (length / force));
        multiply(&mut self.a, |i, _| column[i]);
        self.f.iter_mut().for_each(|f| *f /= force);
        self.x_0.iter_mut().for_each(|x| *x /= length);
        self.compliance.iter_mut().for_each(|c| *c *= force / length);
        (self, Units { column, force, length })
    }

    /// `K u`
    pub(super) fn strained(&self, u: &[f64]) -> Vec<f64> {
        let mut strained = vec![0.0; u.len()];
        add_image(&self.k, 1.0, u, &mut strained);
        strained
    }

    /// `A^T u`
    pub(super) fn opened(&self, u: &[f64]) -> Vec<f64> {
        let by = |j: usize| column_of(&self.a, j).map(|(i, v)| v * u[i]).sum();
        (0..self.x_0.len()).map(by).collect()
    }

    /// `A^T u + x_0`
    pub(super) fn gaps(&self, u: &[f64]) -> impl Iterator<Item = f64> {
        self.opened(u).into_iter().zip(&self.x_0).map(|(opened, x)| opened + x)
    }

    /// Adds `A t`.
    pub(super) fn add_forces(&self, t: &[f64], out: &mut [f64]) {
        add_image(&self.a, 1.0, t, out);
    }
}

/// The matrix of the steps of a program: order, pattern and factors.
pub(super) struct ProgramFactors {
    pub(super) gram: Gram,
    /// The springs of these factors, which replace the pairs.
    pub(super) stiffness: Vec<f64>,
    pub(super) factorisations: usize,
}

impl ProgramFactors {
    pub(super) fn of(program: &Program) -> Result<Self, FaerError> {
        let gram = Gram::new(Some(program.k.symbolic()), program.a.symbolic())?;
        Ok(Self { gram, stiffness: Vec::new(), factorisations: 0 })
    }

    /// Factorises for these springs; `None` if numbers overflow.
    pub(super) fn factorise(
        &mut self,
        program: &Program,
        stiffness: Vec<f64>,
        spring: f64,
    ) -> Option<()> {
        let (k, a) = (program.k.as_ref(), program.a.as_ref());
        self.gram.factorise(Some(k), a, &stiffness, spring).ok()?;
        self.stiffness = stiffness;
        self.factorisations += 1;
        Some(())
    }
}

/// A proof with zeros for parts that hardly move beside the rest: rounding errors would contradict each other.
pub(super) fn without_noise(mut v: Vec<f64>) -> Vec<f64> {
    let noise = SMALL * max_abs(&v);
    v.iter_mut().filter(|v| v.abs() <= noise).for_each(|v| *v = 0.0);
    v
}

/// The opposite of a motion, with a largest component of one.
pub(super) fn against(motion: Vec<f64>) -> Vec<f64> {
    let motion = without_noise(motion);
    let largest = max_abs(&motion);
    motion.into_iter().map(|v| -v / largest).collect()
}
