//! How well displacements and forces solve a contact problem.

use super::{Contact2d, ContactState, column_of};
use crate::Residuals;
use crate::problem::max_abs;
use crate::residual::ratio;

impl Contact2d {
    /// Residuals of a state, dimensionless, from the original data.
    ///
    /// * equation: `|K u - f - C^T t|_i / (|K||u| + |f| + |C^T||t|)_i`, the largest over the rows, where
    ///   the denominator is at least 2^-10 of the largest term that the row could have: of a force with
    ///   the largest one, of a displacement with `sqrt(K_ii) max_j sqrt(K_jj) |u_j|`, which does not
    ///   compare translations with rotations.
    /// * feasibility, complementarity and natural: forces are measured in units of the largest one, gaps
    ///   and slips in units of the largest term of any of them. With both goes what the loads alone would
    ///   make, by the diagonal of `K`: so nothing is measured by noise where all bodies are at rest, or
    ///   all contacts open.
    ///
    /// Units do not matter, not even those of single displacements: a moment is not compared with a force.
    ///
    /// # Panics
    /// If the lengths are not those of the problem.
    pub fn residuals(&self, state: &ContactState) -> Residuals {
        let ContactState { u, t_n, t_t, gap, slip } = state;
        let all = [u, t_n, t_t, gap, slip];
        if all.iter().any(|v| v.iter().any(|v| !v.is_finite())) {
            return Residuals::infinite();
        }
        let (load_force, load_length) = self.load_sizes();
        let force = max_abs(t_n).max(max_abs(t_t)).max(load_force);
        let length = self.length(u).max(load_length);
        if !(force.is_finite() && length.is_finite()) {
            return Residuals::infinite();
        }
        let mut worst = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut pair = |t: f64, y: f64| {
            let relative = |v: f64, unit: f64| if unit > 0.0 { v / unit } else { 0.0 };
            let least = relative(t, force).min(relative(y, length));
            worst.0 = worst.0.max(-least + 0.0);
            worst.1 = worst.1.max(least);
            worst.2 = worst.2.max(least.abs());
        };
        t_n.iter().zip(gap).for_each(|(t, g)| pair(*t, *g));
        for &i in &self.friction {
            pair(self.mu[i] * t_n[i] + t_t[i], slip[i].max(0.0));
            pair(self.mu[i] * t_n[i] - t_t[i], (-slip[i]).max(0.0));
        }
        let (feasibility, complementarity, natural) = worst;
        let equation = self.equation_residual(u, t_n, t_t);
        Residuals { equation, feasibility, complementarity, natural }
    }

    fn equation_residual(&self, u: &[f64], t_n: &[f64], t_t: &[f64]) -> f64 {
        const FLOOR: f64 = 1.0 / (1 << 10) as f64;
        let t_max = max_abs(t_n).max(max_abs(t_t));
        let root = |j: usize| self.root(j);
        let energy = u.iter().enumerate().fold(0.0_f64, |max, (j, u)| max.max(root(j) * u.abs()));
        let mut worst = 0.0_f64;
        // K is symmetric: its columns are its rows.
        for (j, &f) in self.f.iter().enumerate() {
            let (mut sum, mut size, mut largest) = (-f, f.abs(), root(j) * energy);
            let mut add = |v: f64, x: f64, max: f64| {
                sum += v * x;
                size += (v * x).abs();
                largest = largest.max(v.abs() * max);
            };
            column_of(&self.k, j).for_each(|(i, v)| add(v, u[i], 0.0));
            column_of(&self.c_n, j).for_each(|(i, v)| add(-v, t_n[i], t_max));
            column_of(&self.c_t, j)
                .filter(|(i, _)| self.mu[*i] > 0.0)
                .for_each(|(i, v)| add(-v, t_t[i], t_max));
            worst = worst.max(ratio(sum, size.max(FLOOR * largest)));
        }
        worst
    }

    /// Sizes of the contact force that would balance the largest load, and of the gap that the loads
    /// would make without contact, both as if `K` were diagonal. Loads without stiffness are balanced
    /// directly, and make no gap of finite size.
    fn load_sizes(&self) -> (f64, f64) {
        let (mut load, mut contact, mut direct) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (j, f) in self.f.iter().enumerate() {
            let entries = column_of(&self.c_n, j).chain(self.friction_rows(j));
            let largest = entries.fold(0.0_f64, |max, (_, v)| max.max(v.abs()));
            let root = self.root(j);
            if root > 0.0 {
                load = load.max(f.abs() / root);
                contact = contact.max(largest / root);
            } else if largest > 0.0 {
                direct = direct.max(f.abs() / largest);
            }
        }
        let balancing = if contact > 0.0 { load / contact } else { 0.0 };
        (direct.max(balancing), load * contact)
    }

    /// The root of a diagonal entry of `K`: displacements times it can be compared.
    fn root(&self, j: usize) -> f64 {
        self.k.get(j, j).map_or(0.0, |v| v.abs().sqrt())
    }

    /// The largest term of any gap or slip.
    fn length(&self, u: &[f64]) -> f64 {
        let mut length = max_abs(&self.x_0);
        for &i in &self.friction {
            length = length.max(self.s_0[i].abs());
        }
        for (j, u) in u.iter().enumerate() {
            column_of(&self.c_n, j).for_each(|(_, v)| length = length.max((v * u).abs()));
            self.friction_rows(j).for_each(|(_, v)| length = length.max((v * u).abs()));
        }
        length
    }
}
