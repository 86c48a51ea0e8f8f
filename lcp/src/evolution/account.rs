//! Works and energies of the steps.

/// Works and energies of an [`Evolution`](crate::Evolution), summed over its steps.
///
/// The two sides are equal in every step, up to rounding:
///
/// ```text
/// work = stored + kinetic + dissipation + dragged + lost
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Account {
    /// Work of the loads and of supports that move, with the forces at the ends of the steps.
    pub work: f64,
    /// Change of the strain energy of bodies and joints.
    pub stored: f64,
    /// Change of the kinetic energy; zero without inertia.
    pub kinetic: f64,
    /// Energy dissipated by friction: the sum of `-t_t ds` over all slips.
    pub dissipation: f64,
    /// Largest energy that friction can dissipate in these slips, the sum of `mu t_n |ds|`: equal to the dissipation by
    /// Coulomb's law.
    pub capacity: f64,
    /// Energy that friction gave back, the negative part of the dissipation: zero by Coulomb's law.
    pub created: f64,
    /// Energy dissipated by the drag.
    pub dragged: f64,
    /// Energy dissipated by the implicit scheme itself: never negative, and small if steps are short.
    pub lost: f64,
}

impl Account {
    /// The dissipation divided by the capacity: one if friction obeyed Coulomb's law in every slip. `None` without any
    /// slip.
    pub fn friction_power(&self) -> Option<f64> {
        (self.capacity > 0.0).then(|| self.dissipation / self.capacity)
    }

    /// The sums since an earlier account of the same bodies.
    #[must_use]
    pub fn since(&self, before: &Self) -> Self {
        self.with(before, |now, before| now - before)
    }

    pub(super) fn add(&mut self, step: &Self) {
        *self = self.with(step, |sum, step| sum + step);
    }

    fn with(&self, other: &Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            work: of(self.work, other.work),
            stored: of(self.stored, other.stored),
            kinetic: of(self.kinetic, other.kinetic),
            dissipation: of(self.dissipation, other.dissipation),
            capacity: of(self.capacity, other.capacity),
            created: of(self.created, other.created),
            dragged: of(self.dragged, other.dragged),
            lost: of(self.lost, other.lost),
        }
    }
}
