//! Conversion of the problems that the method treats to contact problems, and back.

use crate::certify::{BoxedJudge, ContactJudge, Precision};
use crate::extended::Extended;
use crate::problem::ContactStatus;
use crate::refine::{ALL_DIGITS, Exact, ROUNDED, refined_states};
use crate::states::{Condensed, Point, PointRef, Scaled};
use crate::vector::ROUNDING;
use crate::{Basis, Contact2d, ContactState, MixedLcp, Residuals, Side, WarmStart};

/// A scaled point with its residuals.
pub(crate) struct Judged {
    pub(crate) u: Vec<f64>,
    pub(crate) forces: Vec<(f64, f64)>,
    pub(crate) residuals: Residuals,
}

impl Judged {
    pub(crate) fn worst(&self) -> f64 {
        self.residuals.worst()
    }

    pub(crate) fn point(&self) -> PointRef<'_> {
        PointRef { u: &self.u, forces: &self.forces }
    }
}

/// A point of the general form of a problem.
pub(crate) struct Answer {
    pub(crate) t: Vec<f64>,
    pub(crate) y: Vec<f64>,
    /// The state of a contact problem at the point.
    pub(crate) contact: Option<ContactState>,
}

/// The judge of points of a scaled problem, in the data as given.
pub(crate) trait Judge {
    /// Residuals of the [`answer`](Self::answer) at a point.
    fn residuals(&self, scaled: &Scaled, at: PointRef<'_>, precision: Precision) -> Residuals;

    /// Residuals of displacements in units of the data and scaled forces, of twice the digits.
    fn residuals_of(&self, scaled: &Scaled, at: &Exact) -> Residuals;

    /// The answer at a point.
    fn answer(&self, scaled: &Scaled, at: PointRef<'_>) -> Answer;
}

/// A point without changes, with its residuals.
pub(crate) fn judged(
    judge: &dyn Judge,
    scaled: &Scaled,
    at: PointRef<'_>,
    precision: Precision,
) -> Judged {
    let residuals = judge.residuals(scaled, at, precision);
    Judged { u: at.u.to_vec(), forces: at.forces.to_vec(), residuals }
}

/// The equations of states of contacts, and the judge of their solutions.
pub(crate) struct Refiner<'a> {
    pub(crate) judge: &'a dyn Judge,
    pub(crate) scaled: &'a Scaled,
    pub(crate) condensed: &'a mut Condensed,
}

impl Refiner<'_> {
    /// The point of the states of contacts without rounding errors, if it is better than the given one: small numbers
    /// inherit the rounding errors of large ones until they are refined.
    pub(crate) fn brought_right(
        &mut self,
        mut best: Judged,
        at: PointRef<'_>,
        contacts: &[ContactStatus],
        tolerance: f64,
    ) -> Judged {
        let Self { judge, scaled, condensed } = self;
        if best.worst() <= ROUNDING {
            return best;
        }
        let enough = if best.worst() <= tolerance { ROUNDED } else { ALL_DIGITS };
        for exact in refined_states(scaled, condensed, at, contacts, enough) {
            let mut near = rounded(*judge, scaled, &exact);
            let Residuals { equation, natural, loads, .. } = near.residuals;
            if loads > ROUNDING
                && equation.max(natural) <= tolerance
                && judge.residuals_of(scaled, &exact).worst() <= tolerance
            {
                // The residual of the loads, less the rounding of the exact point.
                near.residuals.loads =
                    judge.residuals(scaled, near.point(), Precision::Rounded).loads;
            }
            best = if near.worst() < best.worst() { near } else { best };
            if best.worst() <= tolerance {
                break;
            }
        }
        best
    }

    /// The best point that the states of contacts lead to without rounding errors.
    pub(crate) fn unrounded(
        &mut self,
        at: PointRef<'_>,
        contacts: &[ContactStatus],
    ) -> Option<Judged> {
        let Self { judge, scaled, condensed } = self;
        let exact = refined_states(scaled, condensed, at, contacts, ROUNDED);
        let mut points = exact.map(|exact| rounded(*judge, scaled, &exact));
        let first = points.next()?;
        if first.worst() <= ROUNDING {
            return Some(first);
        }
        std::iter::once(first).chain(points).min_by(|a, b| a.worst().total_cmp(&b.worst()))
    }
}

fn rounded(judge: &dyn Judge, scaled: &Scaled, (u, forces): &Exact) -> Judged {
    let u: Vec<f64> = u.iter().map(|u| u.rounded()).collect();
    let mut u = scaled.of_displacements(&u);
    let mut forces: Vec<_> = forces.iter().map(|[n, t]| (n.rounded(), t.rounded())).collect();
    scaled.settle(&mut u, &mut forces);
    judged(judge, scaled, PointRef { u: &u, forces: &forces }, Precision::Exact)
}

/// A problem as it was given.
pub(crate) trait Original {
    /// The contact problem itself, if the problem is one.
    fn contact(&self) -> Option<&Contact2d>;

    fn scaled(&self) -> Scaled;

    fn judge(&self) -> Box<dyn Judge + '_>;

    /// Number of pairs of the general form.
    fn order(&self) -> usize;

    /// Displacements and forces of the scaled problem from a point of the general form.
    fn point(&self, scaled: &Scaled, t: &[f64], y: &[f64]) -> (Vec<f64>, Vec<(f64, f64)>);

    /// The complementary basis of these states of the contacts; free variables are on the side of their
    /// sign.
    fn basis(&self, contacts: &[ContactStatus], y: &[f64], slips: &[f64]) -> Basis;

    /// The states of the contacts that belong to a basis.
    fn contacts(&self, basis: &Basis) -> Vec<ContactStatus>;
}

/// The state of a scaled point, with forces cut to their cones. The part cut off large forces may exceed the loads.
fn state(problem: &Contact2d, scaled: &Scaled, at: PointRef<'_>) -> ContactState {
    let points = scaled.points.iter().zip(at.forces).zip(problem.mu());
    let inside = points.map(|((point, (t_n, t_t)), mu)| {
        let t_n = t_n.max(0.0);
        // Forces may have overflowed.
        let bound = if *mu > 0.0 { mu * t_n } else { 0.0 };
        let t_t = t_t.clamp(-bound, bound);
        let acts = point.compliance[0] > 0.0 || point.coefficients.iter().any(|v| v[0] != 0.0);
        (if acts { t_n } else { least_bound(t_n, t_t, *mu) }, t_t)
    });
    let (normal, tangential) =
        inside.map(|(t_n, t_t)| (t_n * scaled.force(), t_t * scaled.force())).unzip();
    problem.state(scaled.displacements(at.u), normal, tangential)
}

/// The normal force that friction needs, instead of a normal force that acts on nothing and may be arbitrarily large.
fn least_bound(t_n: f64, t_t: f64, mu: f64) -> f64 {
    if t_t == 0.0 { 0.0 } else { t_n.min((1.0 + f64::EPSILON) * t_t.abs() / mu) }
}

impl Judge for (&Contact2d, ContactJudge<'_>) {
    fn residuals(&self, scaled: &Scaled, at: PointRef<'_>, precision: Precision) -> Residuals {
        self.1.residuals(&state(self.0, scaled, at).parts(), precision)
    }

    fn residuals_of(&self, scaled: &Scaled, (u, forces): &Exact) -> Residuals {
        let part = |k: usize| forces.iter().map(move |it| it[k].scaled(scaled.force()));
        let [t_n, t_t] = [0, 1].map(|k| part(k).collect::<Vec<_>>());
        self.1.residuals_of(&[u, &t_n, &t_t])
    }

    fn answer(&self, scaled: &Scaled, at: PointRef<'_>) -> Answer {
        let state = state(self.0, scaled, at);
        let (t, y) = self.0.to_pairs(&state);
        Answer { t, y, contact: Some(state) }
    }
}

/// The `(z, w)` of a scaled point, which are both judged and returned, as for contact.
fn variables(scaled: &Scaled, at: PointRef<'_>) -> (Vec<f64>, Vec<f64>) {
    let (mut u, mut w) = (at.u.to_vec(), vec![0.0; at.u.len()]);
    for (point, (t_n, _)) in scaled.points.iter().zip(at.forces) {
        let j = point.columns[0];
        u[j] = u[j].max(0.0);
        w[j] = t_n.max(0.0) * scaled.force_of(j);
    }
    (scaled.displacements(&u), w)
}

impl Judge for (&MixedLcp, BoxedJudge<'_>) {
    fn residuals(&self, scaled: &Scaled, at: PointRef<'_>, precision: Precision) -> Residuals {
        let (z, w) = variables(scaled, at);
        self.1.residuals(&[&z, &w], precision)
    }

    fn residuals_of(&self, scaled: &Scaled, (u, forces): &Exact) -> Residuals {
        let mut w = vec![Extended::ZERO; u.len()];
        for (point, [force, _]) in scaled.points.iter().zip(forces) {
            let j = point.columns[0];
            w[j] = force.scaled(scaled.force_of(j));
        }
        self.1.residuals_of(&[u, &w])
    }

    fn answer(&self, scaled: &Scaled, at: PointRef<'_>) -> Answer {
        let (z, w) = variables(scaled, at);
        let (t, y) = self.0.to_pairs(&z, &w);
        Answer { t, y, contact: None }
    }
}

impl Contact2d {
    /// A start with these states of the contacts. A simulation keeps [those of a solution](Self::statuses) by keys of
    /// its contacts, which may come and go.
    ///
    /// ```
    /// use std::collections::BTreeMap;
    /// use lcp::refine::ContactStatus;
    /// use lcp::{Auto, AutoSettings, Contact2d, ContactPoint, Solver};
    /// /// A body on springs, with a foot for each of these keys.
    /// fn standing(feet: &[&str]) -> Result<Contact2d, lcp::Error> {
    ///     let mut builder = Contact2d::builder([[3.0, 0.0], [0.0, 1.0]], vec![1.4, -2.0]);
    ///     let foot = ContactPoint { normal: &[(1, 1.0)], tangent: &[(0, 1.0)], mu: 0.5, ..Default::default() };
    ///     feet.iter().for_each(|_| drop(builder.add_point(foot)));
    ///     builder.build()
    /// }
    /// let before = standing(&["left"])?;
    /// let state = before.variables(&Auto::default().solve(&before)?);
    /// let kept: BTreeMap<_, _> = ["left"].into_iter().zip(before.statuses(&state)).collect();
    /// // A foot that is new may be open.
    /// let (feet, next) = (["right", "left"], standing(&["right", "left"])?);
    /// let statuses: Vec<_> = feet.map(|key| *kept.get(key).unwrap_or(&ContactStatus::Open)).into();
    /// let start = next.start_of(&statuses);
    /// assert!(Auto::new(AutoSettings { start, ..Default::default() }).solve(&next)?.is_solved());
    /// # Ok::<(), lcp::Error>(())
    /// ```
    ///
    /// # Panics
    /// If the number of states is not that of the points.
    pub fn start_of(&self, statuses: &[ContactStatus]) -> WarmStart {
        assert_eq!(statuses.len(), self.points(), "one state for every point");
        let (forces, slips) = (vec![0.0; self.order()], vec![0.0; self.points()]);
        WarmStart::Basis(self.basis(statuses, &forces, &slips))
    }
}

impl Original for Contact2d {
    fn contact(&self) -> Option<&Contact2d> {
        Some(self)
    }

    fn scaled(&self) -> Scaled {
        Scaled::of_contact(self)
    }

    fn judge(&self) -> Box<dyn Judge + '_> {
        Box::new((self, ContactJudge::new(self)))
    }

    fn order(&self) -> usize {
        self.order()
    }

    fn point(&self, scaled: &Scaled, t: &[f64], y: &[f64]) -> (Vec<f64>, Vec<(f64, f64)>) {
        scaled.of_state(&self.recover(t, y))
    }

    fn basis(&self, contacts: &[ContactStatus], y: &[f64], slips: &[f64]) -> Basis {
        let n = self.displacements();
        let mut sides: Vec<Side> =
            (0..n).map(|j| if y[j] > 0.0 { Side::Y } else { Side::T }).collect();
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

/// A mixed problem is a contact problem without friction: `M z + q = w` has the stiffness `M`, the load `-q` and the
/// contact forces `w`, and the gaps are the variables themselves.
impl Original for MixedLcp {
    fn contact(&self) -> Option<&Contact2d> {
        None
    }

    fn scaled(&self) -> Scaled {
        Scaled::of_mixed(self)
    }

    fn judge(&self) -> Box<dyn Judge + '_> {
        Box::new((self, BoxedJudge::of_boxed(self.boxed())))
    }

    fn order(&self) -> usize {
        self.order()
    }

    fn point(&self, scaled: &Scaled, t: &[f64], y: &[f64]) -> (Vec<f64>, Vec<(f64, f64)>) {
        let (z, w) = self.recover(t, y);
        let force = |point: Point<'_>| {
            let j = point.columns[0];
            (w[j] / scaled.force_of(j), 0.0)
        };
        (scaled.of_displacements(&z), scaled.points.iter().map(force).collect())
    }

    fn basis(&self, contacts: &[ContactStatus], y: &[f64], _: &[f64]) -> Basis {
        let mut contacts = contacts.iter();
        let side = |(j, free): (usize, &bool)| {
            let is_y = if *free {
                y[j] > 0.0
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
