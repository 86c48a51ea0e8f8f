//! The problems that the method treats, as contact problems, and back.

use super::crossover::nearest;
use super::scaled::{Point, Scaled};
use crate::refine::ContactStatus;
use crate::refine::lack_of_loads;
use crate::{Basis, Contact2d, ContactState, MixedLcp, Residuals, Side};

/// A point of the general form of a problem.
#[derive(Debug, Clone)]
pub(crate) struct Judged {
    pub(crate) t: Vec<f64>,
    pub(crate) y: Vec<f64>,
    /// The state that it is, of a contact problem.
    pub(crate) contact: Option<ContactState>,
    pub(crate) residuals: Residuals,
    /// The largest of the residuals, and of what the equations lack in units of the loads.
    pub(crate) worst: f64,
}

impl Judged {
    fn new((t, y): (Vec<f64>, Vec<f64>), residuals: Residuals, drift: f64) -> Self {
        Self { t, y, contact: None, worst: residuals.worst().max(drift), residuals }
    }
}

/// What a point lacks in units of the loads; or, where that is more than the tolerance, what the equations of its
/// states then lack.
pub(crate) fn lack_of_pairs(problem: &MixedLcp, (t, y): (&[f64], &[f64]), tolerance: f64) -> f64 {
    let scaled = problem.scaled();
    let (u, forces) = problem.point(&scaled, t, y);
    lack(&scaled, (u, forces), tolerance)
}

/// The same of a contact problem, of which pairs may have fewer digits than states.
pub(crate) fn lack_of_state(problem: &Contact2d, state: &ContactState, tolerance: f64) -> f64 {
    let scaled = problem.scaled();
    lack(&scaled, scaled.of_state(state), tolerance)
}

fn lack(scaled: &Scaled, (u, forces): (Vec<f64>, Vec<(f64, f64)>), tolerance: f64) -> f64 {
    lack_of_loads(scaled, (&u, &forces), &nearest(scaled, &u, &forces), tolerance)
}

/// A problem as it was given.
pub(crate) trait Original {
    /// Whether soft springs that keep their share of the load are evidence against a solution. They are none
    /// where the stiffness may be that of no body.
    fn has_bodies(&self) -> bool;

    fn scaled(&self) -> Scaled;

    /// The point that belongs to displacements and forces of the scaled problem.
    fn judge(&self, scaled: &Scaled, u: &[f64], forces: &[(f64, f64)]) -> Judged;

    /// Number of pairs of the general form.
    fn order(&self) -> usize;

    /// Displacements and forces of the scaled problem from a point of the general form.
    fn point(&self, scaled: &Scaled, t: &[f64], y: &[f64]) -> (Vec<f64>, Vec<(f64, f64)>);

    /// The complementary basis of these states of the contacts; free variables are on the side of their
    /// sign.
    fn basis(&self, contacts: &[ContactStatus], judged: &Judged, slips: &[f64]) -> Basis;

    /// The states of the contacts that belong to a basis.
    fn contacts(&self, basis: &Basis) -> Vec<ContactStatus>;
}

impl Original for Contact2d {
    fn has_bodies(&self) -> bool {
        true
    }

    fn scaled(&self) -> Scaled {
        Scaled::of_contact(self)
    }

    fn judge(&self, scaled: &Scaled, u: &[f64], forces: &[(f64, f64)]) -> Judged {
        // What is given back are forces inside their cones: where these are large, what was cut off may be
        // more than the loads.
        let inside = forces.iter().zip(self.mu()).map(|((t_n, t_t), mu)| {
            let t_n = t_n.max(0.0);
            // Forces may have overflowed.
            let bound = if *mu > 0.0 { mu * t_n } else { 0.0 };
            (t_n, t_t.clamp(-bound, bound))
        });
        let forces: Vec<(f64, f64)> = inside.collect();
        let drift = scaled.drift(u, &forces).max(scaled.slack(u, &forces));
        let u = scaled.displacements(u);
        let [normal, tangential] = [|it: &(f64, f64)| it.0, |it: &(f64, f64)| it.1]
            .map(|part| forces.iter().map(|it| part(it) * scaled.force()).collect());
        let state = self.state(u, normal, tangential);
        let (pairs, residuals) = (self.to_pairs(&state), self.residuals(&state));
        Judged { contact: Some(state), ..Judged::new(pairs, residuals, drift) }
    }

    fn order(&self) -> usize {
        self.order()
    }

    fn point(&self, scaled: &Scaled, t: &[f64], y: &[f64]) -> (Vec<f64>, Vec<(f64, f64)>) {
        scaled.of_state(&self.recover(t, y))
    }

    fn basis(&self, contacts: &[ContactStatus], judged: &Judged, slips: &[f64]) -> Basis {
        let n = self.displacements();
        let mut sides: Vec<Side> =
            (0..n).map(|j| if judged.y[j] > 0.0 { Side::Y } else { Side::T }).collect();
        sides.extend(
            contacts.iter().map(|c| if *c == ContactStatus::Open { Side::Y } else { Side::T }),
        );
        // An open contact slides to the side of its motion, without a force.
        let slides = |i: usize, forwards: bool| match contacts[i] {
            ContactStatus::Open => (slips[i] >= 0.0) == forwards,
            ContactStatus::Stick => false,
            ContactStatus::Forwards => forwards,
            ContactStatus::Backwards => !forwards,
        };
        for forwards in [true, false] {
            let side = |&i: &usize| if slides(i, forwards) { Side::Y } else { Side::T };
            sides.extend(self.frictional().iter().map(side));
        }
        Basis::new(sides)
    }

    fn contacts(&self, basis: &Basis) -> Vec<ContactStatus> {
        let (n, m) = (self.displacements(), self.points());
        let sides = basis.sides();
        let mut contacts: Vec<ContactStatus> = sides[n..n + m]
            .iter()
            .map(|side| if *side == Side::T { ContactStatus::Stick } else { ContactStatus::Open })
            .collect();
        let count = self.frictional().len();
        for (k, &i) in self.frictional().iter().enumerate() {
            if contacts[i] == ContactStatus::Stick {
                contacts[i] = match (sides[n + m + k], sides[n + m + count + k]) {
                    (Side::Y, _) => ContactStatus::Forwards,
                    (Side::T, Side::Y) => ContactStatus::Backwards,
                    (Side::T, Side::T) => ContactStatus::Stick,
                };
            }
        }
        contacts
    }
}

/// A mixed problem is one of contact without friction: `M z + q = w` has the stiffness `M`, the load `-q`
/// and the contact forces `w`, and the gaps are the variables themselves.
impl Original for MixedLcp {
    fn has_bodies(&self) -> bool {
        false
    }

    fn scaled(&self) -> Scaled {
        Scaled::of_mixed(self)
    }

    fn judge(&self, scaled: &Scaled, u: &[f64], forces: &[(f64, f64)]) -> Judged {
        // As for contact, what is judged is what is given back.
        let (mut u, mut forces) = (u.to_vec(), forces.to_vec());
        let mut w = vec![0.0; u.len()];
        for (point, (t_n, _)) in scaled.points.iter().zip(&mut forces) {
            let j = point.columns[0];
            u[j] = u[j].max(0.0);
            *t_n = t_n.max(0.0);
            w[j] = *t_n * scaled.force_of(j);
        }
        let z = scaled.displacements(&u);
        let residuals = self.residuals(&z, &w);
        let own = scaled.own_units().map_or(0.0, |own| own.residual(&z, &w));
        let drift = scaled.drift(&u, &forces).max(own);
        Judged::new(self.to_pairs(&z, &w), residuals, drift)
    }

    fn order(&self) -> usize {
        self.order()
    }

    fn point(&self, scaled: &Scaled, t: &[f64], y: &[f64]) -> (Vec<f64>, Vec<(f64, f64)>) {
        let (z, w) = self.recover(t, y);
        let force = |point: &Point| {
            let j = point.columns[0];
            (w[j] / scaled.force_of(j), 0.0)
        };
        (scaled.of_displacements(&z), scaled.points.iter().map(force).collect())
    }

    fn basis(&self, contacts: &[ContactStatus], judged: &Judged, _: &[f64]) -> Basis {
        let mut contacts = contacts.iter();
        let side = |(j, free): (usize, &bool)| {
            let is_y = if *free {
                judged.y[j] > 0.0
            } else {
                // A closed contact has a force, w, and no gap, z.
                contacts.next().is_some_and(|contact| *contact != ContactStatus::Open)
            };
            if is_y { Side::Y } else { Side::T }
        };
        Basis::new(self.free().iter().enumerate().map(side).collect())
    }

    fn contacts(&self, basis: &Basis) -> Vec<ContactStatus> {
        let sides = basis.sides().iter().zip(self.free()).filter(|(_, free)| !**free);
        sides
            .map(|(s, _)| if *s == Side::Y { ContactStatus::Stick } else { ContactStatus::Open })
            .collect()
    }
}
