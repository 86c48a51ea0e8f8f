//! The law of a joint: unilateral contact with Coulomb friction, cohesion, and a tensile strength.
//!
//! A point has the contact force `(t_n, t_t)`, compression positive, the gap `y_n` and the slip `y_t`:
//!
//! ```text
//!   t_n >= -T,   y_n >= 0,   (t_n + T) y_n = 0
//!   |t_t| <= mu t_n + C,     slip only where |t_t| is at this bound, and against it
//! ```
//!
//! `C = c A` and `T = f_t A` are the cohesion and the tensile strength of the area `A` of the point. The strength is
//! not lost after the joint has slid or opened: the law is ideally plastic. It needs `mu T <= C`, so that the force
//! `-T` lies inside the cone.
//!
//! A change of variable gives the law of a joint without tension:
//!
//! ```text
//!   t_n' >= 0,   |t_t| <= mu t_n' + C_0,   C_0 = C - mu T
//! ```
//!
//! Here `t_n' = t_n + T`, and the constant force `-T` along the normal becomes a load on both sides.
//! [`System`](crate::system::System) and everything built on it use `t_n'`; [`State`](crate::data::state::State) has
//! `t_n` again. The forces that the law admits form a [`Cone`]. It is the sum of edges, along which forces may have
//! any size, and of caps, which bound a force in both directions. Only the forms of the problem write the bound as
//! equations. A compressive strength would be a cap along the normal.
//!
//! The faces of a joint may have a compliance. In this case springs with a stiffness `k_n` and `k_t` \[Pa/m\] act in
//! series with the law; their compliance at a point is `1 / (k A)` \[m/N\]. Gap and slip are the parts of the relative
//! displacement that are not the deformation of these springs.

use crate::ids::ContactId;

/// The law of a class of joints: resistance to sliding and opening, and stiffness in compression and shear.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointLaw {
    /// Coefficient of Coulomb friction \[-\].
    pub mu: f64,
    /// Cohesion `c` \[Pa\].
    pub cohesion: f64,
    /// Tensile strength `f_t` \[Pa\], at most `c / mu`.
    pub tension: f64,
    /// Stiffness of the joint: `k_n` perpendicular to the joint and `k_t` along it \[Pa/m\]; `None` if the joint is
    /// rigid.
    pub stiffness: Option<[f64; 2]>,
}

impl JointLaw {
    /// Returns the law of a joint with friction only.
    pub fn friction(mu: f64) -> Self {
        Self { mu, ..Self::default() }
    }

    /// Returns whether the joints resist sliding; only the points of such joints have tangential unknowns.
    pub fn resists_sliding(&self) -> bool {
        self.mu > 0.0 || self.cohesion > 0.0
    }

    /// Returns the law of a contact point that stands for an area \[m^2\].
    pub fn at(&self, area: f64) -> PointLaw {
        PointLaw { mu: self.mu, cohesion: self.cohesion * area, tension: self.tension * area }
    }

    /// Returns the normal and the tangential compliance \[m/N\] of a point that stands for an area \[m^2\]: `1 / (k_n
    /// A)` and `1 / (k_t A)`, or zeros if the joint is rigid.
    ///
    /// ```
    /// use masonry::law::JointLaw;
    /// let law = JointLaw { stiffness: Some([4e9, 2e9]), ..JointLaw::friction(0.6) };
    /// assert_eq!(law.compliance(0.5), [5e-10, 1e-9]);
    /// assert_eq!(JointLaw::friction(0.6).compliance(0.5), [0.0, 0.0]);
    /// ```
    pub fn compliance(&self, area: f64) -> [f64; 2] {
        self.stiffness.map_or([0.0; 2], |stiffness| stiffness.map(|k| 1.0 / (k * area)))
    }
}

/// The law of one contact point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PointLaw {
    /// Coefficient of Coulomb friction \[-\].
    pub mu: f64,
    /// Cohesion `C` of the area of the point \[N\].
    pub cohesion: f64,
    /// Tensile strength `T` of the area of the point \[N\].
    pub tension: f64,
}

impl PointLaw {
    /// Returns the law of a point with friction only.
    pub fn friction(mu: f64) -> Self {
        Self { mu, ..Self::default() }
    }

    /// Returns whether the point resists sliding; only such a point has a tangential unknown.
    pub fn resists_sliding(&self) -> bool {
        self.mu > 0.0 || self.cohesion > 0.0
    }

    /// Returns the cone of the forces that the point can carry, in terms of `t_n' = t_n + T`.
    pub fn cone(&self) -> Cone {
        let base = (self.cohesion - self.mu * self.tension).max(0.0);
        Cone { mu: self.mu, base }
    }

    /// Returns the largest tangential force \[N\] that the point can carry under the normal force `t_n` \[N\].
    ///
    /// ```
    /// use masonry::law::PointLaw;
    /// let law = PointLaw { mu: 0.5, cohesion: 3.0, tension: 2.0 };
    /// assert_eq!((law.bound(4.0), law.bound(-2.0), law.cone().base), (5.0, 2.0, 2.0));
    /// ```
    pub fn bound(&self, t_n: f64) -> f64 {
        self.cone().bound(t_n + self.tension)
    }

    /// Returns the violation \[N\] of the law by a force; zero or negative if the force obeys the law.
    pub fn violation(&self, t_n: f64, t_t: f64) -> f64 {
        (-self.tension - t_n).max(t_t.abs() - self.mu * t_n - self.cohesion)
    }

    /// Returns the work \[J\] that cohesion and tensile strength dissipate in a motion that opens and slides the joint
    /// by these lengths \[m\]. It holds for motions against which no force of the cone does work.
    pub fn strength(&self, opens: f64, slides: f64) -> f64 {
        self.tension * opens + self.cone().base * slides.abs()
    }

    /// Returns the data of the tangential unknown of a point; `None` if the point does not resist sliding.
    pub(crate) fn sliding(&self, contact: ContactId) -> Option<Friction> {
        self.resists_sliding().then(|| Friction { contact, cone: self.cone() })
    }
}

/// The cone that bounds one tangential force in a [`System`](crate::system::System).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// The contact point at which the force acts.
    pub contact: ContactId,
    /// The forces that the point can carry.
    pub cone: Cone,
}

/// The cone of the forces that a point can carry: `t_n' >= 0` and `|t_t| <= mu t_n' + C_0`. Its forces are sums of
/// nonnegative forces along the [edges](Self::edges) and of a tangential force that does not exceed the
/// [cap](Self::cap). The default is the cone of contact without friction, which has one edge along the normal.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cone {
    /// Coefficient of Coulomb friction \[-\].
    pub mu: f64,
    /// Tangential resistance `C_0 = C - mu T` \[N\] of a joint that is about to open.
    pub base: f64,
}

/// A unit vector along an edge of a cone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// The normal part \[-\].
    pub normal: f64,
    /// The tangential part \[-\].
    pub tangential: f64,
}

impl Cone {
    /// Returns the cone of friction without cohesion and tensile strength.
    pub fn friction(mu: f64) -> Self {
        Self { mu, base: 0.0 }
    }

    /// Returns the edges of the cone: without friction one edge along the normal; with friction the edge of positive
    /// tangential forces, and then its mirror image.
    ///
    /// ```
    /// use masonry::law::{Cone, Edge};
    /// let edges: Vec<Edge> = Cone::friction(0.75).edges().collect();
    /// let (normal, tangential) = (0.8, 0.6);
    /// assert_eq!(edges, [Edge { normal, tangential }, Edge { normal, tangential: -tangential }]);
    /// assert_eq!(Cone::default().edges().count(), 1);
    /// ```
    pub fn edges(&self) -> impl Iterator<Item = Edge> + use<> {
        let length = self.mu.hypot(1.0);
        let (normal, tangential) = (1.0 / length, self.mu / length);
        let other = (self.mu > 0.0).then_some(Edge { normal, tangential: -tangential });
        [Edge { normal, tangential }].into_iter().chain(other)
    }

    /// Returns the largest tangential force without a normal force, `C_0` \[N\]; `None` if it is zero.
    pub fn cap(&self) -> Option<f64> {
        (self.base > 0.0).then_some(self.base)
    }

    /// Returns the normal and the tangential part \[N\] of a sum of forces along the edges; `along` has their sizes in
    /// multiples of `unit` \[N\].
    pub(crate) fn force(&self, along: &[f64], unit: f64) -> [f64; 2] {
        let length = self.mu.hypot(1.0);
        let across = along.get(1).map_or(0.0, |other| along[0] - other);
        [unit * along.iter().sum::<f64>() * (1.0 / length), unit * (self.mu / length) * across]
    }

    /// Returns the largest tangential force \[N\] under the normal force `t_n'` \[N\].
    pub fn bound(&self, normal: f64) -> f64 {
        self.mu * normal.max(0.0) + self.base
    }

    /// Returns the distances \[N\] of a force from the two sides of the cone, `p+ = mu t_n' + C_0 + t_t` and `p- = mu
    /// t_n' + C_0 - t_t` (3.24).
    pub fn distances(&self, normal: f64, tangential: f64) -> [f64; 2] {
        [1.0, -1.0].map(|sign| self.mu * normal + self.base + sign * tangential)
    }

    /// Splits a tangential force into the part that friction carries and the part that the cap carries \[N\].
    pub(crate) fn shares(&self, normal: f64, tangential: f64) -> [f64; 2] {
        let bound = self.mu * normal.max(0.0);
        let friction = tangential.clamp(-bound, bound);
        [friction, tangential - friction]
    }

    /// Returns the derivative of a tangential force at its bound with respect to the normal force \[-\].
    pub(crate) fn slope(&self, tangential: f64) -> f64 {
        self.mu.copysign(tangential)
    }

    /// Returns the factor by which the bound magnifies errors of the normal force \[-\]; at least one.
    pub(crate) fn sensitivity(&self) -> f64 {
        self.mu.max(1.0)
    }

    /// Returns the opening \[m\] of a joint that slides by `slides` \[m\] under associated friction.
    pub fn lift(&self, slides: f64) -> f64 {
        self.mu * slides.abs()
    }

    /// Returns the largest work \[J\] that a unit force along an edge does against a motion in which the joint opens
    /// and slides by these lengths \[m\]. The work is positive only if the opening is less than the
    /// [lift](Self::lift).
    pub fn against(&self, opens: f64, slides: f64) -> f64 {
        (self.lift(slides) - opens) / self.mu.hypot(1.0)
    }
}
