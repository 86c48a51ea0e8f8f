//! One contact alone.

/// A contact in the plane whose velocities depend on its forces `r` by `v = W r + p`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coulomb {
    /// The matrix by rows, the normal one first.
    pub(super) w: [[f64; 2]; 2],
    pub(super) mu: f64,
}

impl Coulomb {
    /// Forces within the friction cone that satisfy Coulomb's law together with the velocities
    /// `W r + p`; `None` if no state of the contact does.
    ///
    /// If the contact closes without forces, `p_N < 0`, sticking gives the forces `(n, t) / det W`. The
    /// tangential velocity for sliding to either side, `r_T = +-mu r_N`, is
    /// `-(t -+ mu n) / (W_NN +- W_NT mu)`: the same two numbers `t -+ mu n` decide whether the contact
    /// sticks, and the direction of sliding. If `det W` and both denominators are positive, exactly one
    /// state fits.
    pub(super) fn forces(&self, p: [f64; 2]) -> Option<[f64; 2]> {
        let Self { w: [[nn, nt], [tn, tt]], mu } = *self;
        if p[0] >= 0.0 {
            return Some([0.0, 0.0]);
        }
        let determinant = nn * tt - nt * tn;
        let (n, t) = (nt * p[1] - tt * p[0], tn * p[0] - nn * p[1]);
        let slip = |side: f64| {
            let stiffness = nn + side * mu * nt;
            let fits = stiffness > 0.0 && side * (t - side * mu * n) >= 0.0;
            let normal = -p[0] / stiffness;
            // The zero without friction has no sign.
            fits.then_some([normal, side * mu * normal + 0.0])
        };
        let stick = || {
            let sign = determinant.signum();
            let fits = determinant != 0.0 && (sign * t).abs() <= mu * (sign * n);
            let normal = n / determinant;
            let bound = mu * normal;
            fits.then_some([normal, (t / determinant).max(-bound).min(bound)])
        };
        // Sliding is preferred at the borders of the states since it needs no division by the
        // determinant.
        slip(1.0).or_else(|| slip(-1.0)).or_else(stick)
    }

    /// The normal force for the present tangential one, then the tangential one for it.
    pub(super) fn in_turn(&self, p: [f64; 2], tangential: f64) -> [f64; 2] {
        let Self { w: [[nn, nt], [tn, tt]], mu } = *self;
        let normal = (-(p[0] + nt * tangential) / nn).max(0.0);
        let bound = mu * normal;
        if bound > 0.0 {
            [normal, (-(p[1] + tn * normal) / tt).max(-bound).min(bound)]
        } else {
            [normal, 0.0]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The state found obeys the law over a grid of contacts and velocities, and a state is found
    /// whenever the theory guarantees one.
    #[test]
    fn the_state_found_obeys_the_law() {
        let steps = || (-4..=4_i8).map(f64::from);
        let mut found = [0; 4];
        for (nt, tn) in steps().flat_map(|nt| steps().map(move |tn| (nt, tn))) {
            for mu in [0.0, 0.25, 1.0, 3.0] {
                let contact = Coulomb { w: [[2.0, nt], [tn, 3.0]], mu };
                let is_regular = 6.0 > nt * tn && 2.0 > mu * f64::abs(nt);
                for p in steps().flat_map(|n| steps().map(move |t| [n, t])) {
                    let Some(r) = contact.forces(p) else {
                        assert!(!is_regular, "{contact:?} {p:?}");
                        continue;
                    };
                    found[state(&contact, p, r)] += 1;
                }
            }
        }
        assert!(found.iter().all(|count| *count > 500), "{found:?}");
    }

    /// Open, sticking, sliding either way.
    fn state(contact: &Coulomb, p: [f64; 2], r: [f64; 2]) -> usize {
        let v = [0, 1].map(|i| contact.w[i][0] * r[0] + contact.w[i][1] * r[1] + p[i]);
        let rounding = 1e-13 * (1.0 + r[0].abs() + r[1].abs());
        let bound = contact.mu * r[0];
        assert!(r[0] >= 0.0 && r[1].abs() <= bound, "{contact:?} {p:?} {r:?}");
        assert!(v[0] >= -rounding && r[0].min(v[0]) <= rounding, "{contact:?} {p:?} {r:?}");
        if r[0] <= 0.0 {
            return 0;
        }
        let pushes = r[1] >= bound && v[1] <= rounding;
        let pulls = r[1] <= -bound && v[1] >= -rounding;
        assert!(pushes || pulls || v[1].abs() <= rounding, "{contact:?} {p:?} {r:?} {v:?}");
        if pushes {
            2
        } else if pulls {
            3
        } else {
            1
        }
    }
}
