//! The mixed problem of contact, which Lemke's method treats more safely than the general one.

use super::{Contact2d, ContactState};
use crate::matrix::{add_image, column_of};
use crate::vector::in_units_of_largest;
use crate::{Basis, Matrix, MixedLcp, Side, WarmStart};

impl Contact2d {
    /// The mixed problem with the variables `u` (free), `t_n` and, for every point with friction, the parts `b+`, `b-`
    /// of `t_t = b+ - b-` and the slip `l` to either side (Stewart and Trinkle 1996):
    /// `w = (g, l + s, l - s, mu t_n - b+ - b-)`; `g` and `s` depend on `u` and, with compliance, on the forces. The
    /// problem is copositive, which makes Lemke's method safer than on the general problem, and larger by a pair for
    /// every point with friction.
    pub fn to_mixed(&self) -> MixedLcp {
        let (n, m, count) = (self.displacements(), self.points(), self.friction.len());
        let order = n + m + 3 * count;
        let mut entries = Vec::new();
        for j in 0..n {
            entries.extend(column_of(&self.k, j).map(|(i, v)| (i, j, v)));
            for (i, v) in column_of(&self.c_n, j) {
                entries.extend([(n + i, j, v), (j, n + i, -v)]);
            }
            for (k, v) in self.friction_rows(j) {
                let [plus, minus, _] = [0, 1, 2].map(|part| n + m + part * count + k);
                entries.extend([(plus, j, v), (j, plus, -v), (minus, j, -v), (j, minus, v)]);
            }
        }
        let springs = (0..m).filter(|&i| self.compliance[i][0] > 0.0);
        entries.extend(springs.map(|i| (n + i, n + i, self.compliance[i][0])));
        let mut q: Vec<f64> = self.f.iter().map(|f| -f).chain(self.x_0.iter().copied()).collect();
        q.resize(order, 0.0);
        for (k, &point) in self.friction.iter().enumerate() {
            let [plus, minus, slip] = [0, 1, 2].map(|part| n + m + part * count + k);
            entries.extend([(plus, slip, 1.0), (minus, slip, 1.0)]);
            entries.extend([(slip, plus, -1.0), (slip, minus, -1.0)]);
            entries.push((slip, n + point, self.mu[point]));
            let gives = self.compliance[point][1];
            if gives > 0.0 {
                entries.extend([(plus, plus, gives), (plus, minus, -gives)]);
                entries.extend([(minus, plus, -gives), (minus, minus, gives)]);
            }
            (q[plus], q[minus]) = (self.s_0[point], -self.s_0[point]);
        }
        let matrix = Matrix::from_entries(order, order, entries.into_iter());
        let free = (0..order).map(|i| i < n).collect();
        MixedLcp::new(matrix, q, free).unwrap_or_else(|e| unreachable!("of checked parts: {e}"))
    }

    /// Displacements and forces from the variables `z` of the mixed problem.
    ///
    /// # Panics
    /// If `z` does not have one entry for every variable.
    pub fn from_mixed(&self, z: &[f64]) -> ContactState {
        let (n, m, count) = (self.displacements(), self.points(), self.friction.len());
        assert_eq!(z.len(), n + m + 3 * count, "one entry for every variable");
        let mut t_t = vec![0.0; m];
        for (k, &point) in self.friction.iter().enumerate() {
            t_t[point] = z[n + m + k] - z[n + m + count + k];
        }
        self.state(z[..n].to_vec(), z[n..n + m].to_vec(), t_t)
    }

    /// A start in the pairs of the mixed problem from a start in the pairs of the general problem.
    pub(crate) fn mixed_start(&self, mixed: &MixedLcp, start: &WarmStart) -> WarmStart {
        match start {
            WarmStart::None => WarmStart::None,
            WarmStart::Point { t, y } => {
                let z = self.mixed_variables(&self.recover(t, y));
                let w = mixed.boxed().image(&z);
                // Numbers that are not finite cannot be a start.
                if z.iter().chain(&w).any(|v| !v.is_finite()) {
                    return WarmStart::None;
                }
                let (t, y) = mixed.to_pairs(&z, &w);
                WarmStart::Point { t, y }
            }
            WarmStart::Basis(basis) => WarmStart::Basis(self.mixed_basis(basis)),
        }
    }

    fn mixed_variables(&self, state: &ContactState) -> Vec<f64> {
        let friction = || self.friction.iter();
        let mut z = [state.u.clone(), state.t_n.clone()].concat();
        z.extend(friction().map(|&i| state.t_t[i].max(0.0)));
        z.extend(friction().map(|&i| (-state.t_t[i]).max(0.0)));
        z.extend(friction().map(|&i| state.slip[i].abs()));
        z
    }

    /// The basis of the mixed problem. `b-` is the friction and `l` the slip of a point that slides forwards; `b+` is
    /// the friction of a point that slides backwards. Either part of the friction serves for a point that sticks.
    fn mixed_basis(&self, basis: &Basis) -> Basis {
        let (n, m, count) = (self.displacements(), self.points(), self.friction.len());
        let sides = basis.sides();
        let slides = |k: usize| (sides[n + m + k] == Side::Y, sides[n + m + count + k] == Side::Y);
        let side = |is_t: bool| if is_t { Side::T } else { Side::Y };
        let mut mixed = sides[..n + m].to_vec();
        mixed.extend((0..count).map(|k| side(!slides(k).0)));
        mixed.extend((0..count).map(|k| side(slides(k).0)));
        mixed.extend((0..count).map(|k| side(slides(k).0 || slides(k).1)));
        Basis::new(mixed)
    }

    /// The vector in the rows of the general problem that belongs to a motion of the bodies: a Farkas vector if the
    /// motion deforms no body, opens every contact by at least `mu` times its slip, and the loads do work on it.
    pub(crate) fn farkas_of_motion(&self, motion: &[f64]) -> Vec<f64> {
        let mut slips = vec![0.0; self.points()];
        add_image(&self.c_t, 1.0, motion, &mut slips);
        let bounds = self.friction.iter().map(|&i| -0.5 * slips[i].abs());
        let zeros = std::iter::repeat_n(0.0, self.points() + self.friction.len());
        in_units_of_largest(motion.iter().copied().chain(zeros).chain(bounds))
    }

    /// A Farkas vector of the general problem from a Farkas vector of the mixed problem in its general form.
    pub(crate) fn farkas_of_mixed(&self, pi: &[f64]) -> Vec<f64> {
        let (n, m, count) = (self.displacements(), self.points(), self.friction.len());
        let balance = pi[..n].iter().map(|pi| -pi);
        let gaps = pi[n..n + m].iter().copied();
        let bounds = pi[n + m + 2 * count..].iter().map(|pi| 0.5 * pi);
        let slips = std::iter::repeat_n(0.0, count);
        in_units_of_largest(balance.chain(gaps).chain(slips).chain(bounds))
    }
}
