//! A heavy beam on a rigid floor, lifted at one end, and what beam theory says about it.
//!
//! Of the part that leaves the floor, of the length `l`, moment and slope vanish where it leaves:
//! `P l = q l^2 / 2`, so `l = 2 P / q`, and the end rises by `P l^3 / (3 E I) - q l^4 / (8 E I)`, which is
//! `q l^4 / (24 E I)` or `2 P^4 / (3 q^3 E I)`.

use masonry::analysis::outcome::Outcome;
use masonry::model::Plane;
use masonry::scene::{Block, Joint, Load, Material, Route, Scene, Support};
use masonry::units::{ForceUnit, LengthUnit, Units};

/// Height \[m\]; the thickness is 1 m.
const HEIGHT: f64 = 0.1;
/// Weight for each length \[kN/m\].
const WEIGHT: f64 = 1.0;
/// Young's modulus \[kN/m2\].
const YOUNG: f64 = 1e6;
const GRAVITY: f64 = 10.0;

/// A beam, half as long again as its part that is lifted.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beam {
    /// Length of the lifted part, in heights.
    pub(crate) slenderness: u32,
    /// Elements over a length of one height.
    pub(crate) elements_per_height: u32,
    /// Elements over the height.
    pub(crate) rows: u32,
}

/// What came out for a beam.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Uplift {
    /// Length without contact, relative to that of beam theory.
    pub(crate) length: f64,
    /// Rise of the end, relative to that of beam theory.
    pub(crate) lift: f64,
}

impl Beam {
    /// Elements along the beam.
    pub(crate) fn elements(self) -> u32 {
        self.slenderness * self.elements_per_height * 3 / 2
    }

    /// The length of an element by its height, for one row of them.
    pub(crate) fn aspect(self) -> f64 {
        1.0 / f64::from(self.elements_per_height)
    }

    /// An element with straight edges cannot bend without shear. One row of them, without lateral strain, is
    /// stiffer than a beam by `1 + (G / E) (a / h)^2` with `G = E / 2`: so much of the rise is left.
    pub(crate) fn locking(self) -> f64 {
        1.0 / (1.0 + 0.5 * self.aspect().powi(2))
    }

    /// Length \[m\] of the lifted part.
    fn lifted(self) -> f64 {
        f64::from(self.slenderness) * HEIGHT
    }

    pub(crate) fn scene(self, route: Route) -> Scene {
        let (length, force) = (1.5 * self.lifted(), 0.5 * WEIGHT * self.lifted());
        let corners = [[0.0, 0.0], [length, 0.0], [length, HEIGHT], [0.0, HEIGHT]];
        let stuff = Material::elastic(YOUNG, 0.0).density(WEIGHT * 1e3 / GRAVITY / HEIGHT);
        Scene::new("Lifted beam", Units { length: LengthUnit::M, force: ForceUnit::Kn })
            .plane(Plane::Stress)
            .thickness(1.0)
            .gravity([0.0, -GRAVITY])
            .material("stuff", stuff)
            .joint("floor", Joint::mu(0.5))
            .block(Block::new("beam", "stuff", corners).mesh([self.elements(), self.rows]))
            .support(Support::new("floor", [0.0, 0.0], [length, 0.0], "floor"))
            .load(Load::traction("P", corners[1], corners[2], [0.0, force / HEIGHT]))
            .route(route)
    }

    /// Compares an outcome with beam theory; `None` without an answer.
    pub(crate) fn uplift(self, outcome: &Outcome) -> Option<Uplift> {
        let state = outcome.state.as_ref()?;
        let inertia = HEIGHT.powi(3) / 12.0;
        let end = state.displacements[0].iter().fold(0.0, |max: f64, u| max.max(u.y));
        let points = outcome.model.contacts.iter().zip(&state.contacts);
        let pressed = points.filter(|(_, it)| it.t_n > 0.0).map(|(point, _)| point.position.x);
        let last = pressed.fold(0.0, f64::max);
        Some(Uplift {
            length: 1.5 - last / self.lifted(),
            lift: end * 24.0 * YOUNG * inertia / (WEIGHT * self.lifted().powi(4)),
        })
    }
}
