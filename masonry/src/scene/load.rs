//! Loads on edges, at places in blocks and on all mass, and their errors.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::fill::{Axle, Fill};
use super::setters::setters;
use super::stress::{Earth, EdgeStress, Pressure};
use super::strict;

/// A load of exactly one kind; [`LoadKind`] lists the keys of each kind.
///
/// ```
/// use masonry::scene::Load;
/// let wind = Load::traction("wind", [0.0, 0.0], [0.0, 3.0], [400.0, 0.0]);
/// let beam = Load::force("beam", "wall/3/2", [0.5, 0.3], [0.0, -2e3]).group("roof").factor(1.35);
/// let quake = Load::acceleration("quake", [0.98, 0.0]);
/// assert_eq!([&wind, &beam, &quake].map(Load::group_name), ["wind", "roof", "quake"]);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Name of the load.
    pub name: String,
    /// Group of the load; by default the load has a group of its own, with the name of the load.
    pub group: Option<String>,
    /// Factor of the load \[-\].
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub factor: f64,
    /// One end of the segment on which edges are loaded \[length\].
    #[serde(default, deserialize_with = "strict::read")]
    pub from: Option<[f64; 2]>,
    /// The other end of the segment \[length\].
    #[serde(default, deserialize_with = "strict::read")]
    pub to: Option<[f64; 2]>,
    /// Force per area against the outward normal of the edge \[force/length^2\]: one number, or two for a pressure
    /// that varies linearly from one end of the segment to the other.
    pub pressure: Option<Pressure>,
    /// Force per area in global axes \[force/length^2\].
    #[serde(default, deserialize_with = "strict::read")]
    pub traction: Option<[f64; 2]>,
    /// Earth or water that presses against the outward normal of the edge; the pressure is proportional to the depth
    /// below its level.
    #[serde(default, deserialize_with = "strict::read")]
    pub earth: Option<Earth>,
    /// Whether the segment may lie within joints. If it may, the traction acts on the edges that it presses, such as
    /// the edges below a floor.
    #[serde(default, skip_serializing_if = "is_false")]
    pub inside: bool,
    /// Name of the block on which a force or a moment acts.
    pub block: Option<String>,
    /// The place of the force or the moment, inside or on the edge of the block \[length\].
    #[serde(default, deserialize_with = "strict::read")]
    pub at: Option<[f64; 2]>,
    /// A force over the whole thickness, in global axes \[force\].
    #[serde(default, deserialize_with = "strict::read")]
    pub force: Option<[f64; 2]>,
    /// A moment over the whole thickness, counter-clockwise \[force length\].
    pub moment: Option<f64>,
    /// An acceleration that acts on all mass as gravity does \[m/s^2\]: an acceleration to the right pushes to the
    /// right.
    #[serde(default, deserialize_with = "strict::read")]
    pub acceleration: Option<[f64; 2]>,
    /// Fill on an arch, a wall or a block, whose weight is a load on the edges below it.
    #[serde(default, deserialize_with = "strict::read")]
    pub fill: Option<Fill>,
    /// An axle on a fill or on the top edge of a block.
    #[serde(default, deserialize_with = "strict::read")]
    pub axle: Option<Axle>,
    /// The part of the load, from 0 to 1, that is the weight of a mass, such as the mass of a roof; `true` is 1 and
    /// `false` 0. Only loads on edges or at a place have it. Accelerations act on this mass at the place of the load.
    /// The mass follows from the component of the load along gravity, times the factor of the load; factors of stages
    /// and limit loads do not change it. Earth and water have no mass unless it is given.
    #[serde(default, deserialize_with = "strict::part")]
    #[cfg_attr(test, schemars(with = "Option<AllOrPart>"))]
    pub mass: Option<f64>,
}

/// A part of a load: all of it, nothing, or a number.
#[cfg(test)]
#[derive(schemars::JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "it describes what is read")]
enum AllOrPart {
    All(bool),
    Of(f64),
}

/// The kinds of loads, each with its keys.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LoadKind<'a> {
    /// A load on the free edges of blocks that lie on a segment, with the keys `from`, `to`, and exactly one of
    /// `pressure`, `traction` and `earth`. An edge that the segment covers in part is loaded in part.
    Edge {
        /// One end of the segment \[length\].
        from: [f64; 2],
        /// The other end of the segment \[length\].
        to: [f64; 2],
        /// The force per area on the edges.
        stress: EdgeStress,
        /// Whether edges within joints are loaded as well, if the traction presses them.
        inside: bool,
    },
    /// A force at a place of a block, with the keys `block`, `at` and `force`.
    Force {
        /// Name of the block.
        block: &'a str,
        /// The place of the force \[length\].
        at: [f64; 2],
        /// The force in global axes \[force\].
        force: [f64; 2],
    },
    /// A moment at a place of a block, with the keys `block`, `at` and `moment`.
    Moment {
        /// Name of the block.
        block: &'a str,
        /// The place of the moment \[length\].
        at: [f64; 2],
        /// The moment, counter-clockwise \[force length\].
        moment: f64,
    },
    /// An acceleration of all mass \[m/s^2\], with the key `acceleration`.
    Acceleration([f64; 2]),
    /// Fill over an arch, a wall or a block, with the key `fill`.
    Fill(&'a Fill),
    /// An axle, with the key `axle`.
    Axle(&'a Axle),
}

impl Load {
    /// Makes a load by a pressure \[force/length^2\] against the outward normal of the edges on a segment; two numbers
    /// are the pressures at the two ends of the segment.
    pub fn pressure(
        name: &str,
        from: [f64; 2],
        to: [f64; 2],
        pressure: impl Into<Pressure>,
    ) -> Self {
        let (from, to) = (Some(from), Some(to));
        Self { from, to, pressure: Some(pressure.into()), ..Self::named(name) }
    }

    /// Makes a load by a traction \[force/length^2\] in global axes on the edges on a segment.
    pub fn traction(name: &str, from: [f64; 2], to: [f64; 2], traction: [f64; 2]) -> Self {
        let (from, to) = (Some(from), Some(to));
        Self { from, to, traction: Some(traction), ..Self::named(name) }
    }

    /// Makes a load by the pressure of earth or water against the outward normal of the edges on a segment.
    pub fn earth(name: &str, from: [f64; 2], to: [f64; 2], earth: Earth) -> Self {
        let (from, to) = (Some(from), Some(to));
        Self { from, to, earth: Some(earth), ..Self::named(name) }
    }

    /// Makes a load by a force \[force\] over the whole thickness at a place \[length\] inside or on the edge of a
    /// block.
    pub fn force(name: &str, block: &str, at: [f64; 2], force: [f64; 2]) -> Self {
        let (block, at) = (Some(block.to_owned()), Some(at));
        Self { block, at, force: Some(force), ..Self::named(name) }
    }

    /// Makes a load by a counter-clockwise moment \[force length\] over the whole thickness at a place \[length\]
    /// inside or on the edge of a block.
    pub fn moment(name: &str, block: &str, at: [f64; 2], moment: f64) -> Self {
        let (block, at) = (Some(block.to_owned()), Some(at));
        Self { block, at, moment: Some(moment), ..Self::named(name) }
    }

    /// Makes a load by an acceleration \[m/s^2\] that acts on all mass as gravity does.
    pub fn acceleration(name: &str, acceleration: [f64; 2]) -> Self {
        Self { acceleration: Some(acceleration), ..Self::named(name) }
    }

    /// Makes a load by fill over an arch, a wall or a block, up to a level \[length\], with a weight per volume
    /// \[force/length^3\].
    pub fn fill(name: &str, over: &str, level: f64, gamma: f64) -> Self {
        let fill = Some(Fill { over: over.to_owned(), level, gamma });
        Self { fill, ..Self::named(name) }
    }

    /// Makes a load by an axle on a fill or on blocks.
    pub fn axle(name: &str, axle: Axle) -> Self {
        Self { axle: Some(axle), ..Self::named(name) }
    }

    setters! {
        /// Puts the load into a group.
        pub fn group(mut self, group: &str) { self.group = Some(group.to_owned()) }
        /// Sets the factor of the load \[-\], which is one by default.
        pub fn factor(mut self, factor: f64) { self.factor = factor }
        /// Sets the part of the load, from 0 to 1, that is the weight of a mass on which accelerations act.
        pub fn mass(mut self, part: f64) { self.mass = Some(part) }
    }

    /// Lets a traction act also on edges within joints, if it presses them.
    #[must_use]
    pub fn inside(self) -> Self {
        Self { inside: true, ..self }
    }

    /// Returns the name of the group of the load.
    pub fn group_name(&self) -> &str {
        self.group.as_deref().unwrap_or(&self.name)
    }

    /// Returns whether the load is, at least in part, the weight of a mass; such a load keeps its direction in an
    /// earthquake.
    pub(super) fn has_mass(&self) -> bool {
        self.mass.is_some_and(|part| part > 0.0)
    }

    /// Returns whether a name in a stage or a combination refers to this load: it is the name of the load or of its
    /// group.
    pub fn is_called(&self, name: &str) -> bool {
        self.name == name || self.group_name() == name
    }

    /// Returns the kind of the load; `None` if its keys are not those of exactly one kind.
    /// [`Scene::check`](super::Scene::check) refuses such a load.
    pub fn kind(&self) -> Option<LoadKind<'_>> {
        let [(acts, _)] = self.given()[..] else { return None };
        Some(match acts {
            Acts::OnEdges => {
                let stress = match (self.pressure, self.traction, self.earth) {
                    (Some(pressure), None, None) => EdgeStress::Pressure(pressure),
                    (None, Some(traction), None) => EdgeStress::Traction(traction),
                    (None, None, Some(earth)) => EdgeStress::Earth(earth),
                    _ => return None,
                };
                LoadKind::Edge { from: self.from?, to: self.to?, stress, inside: self.inside }
            }
            Acts::AtPlace => {
                let (block, at) = (self.block.as_deref()?, self.at?);
                match (self.force, self.moment) {
                    (Some(force), None) => LoadKind::Force { block, at, force },
                    (None, Some(moment)) => LoadKind::Moment { block, at, moment },
                    _ => return None,
                }
            }
            Acts::OnMass => LoadKind::Acceleration(self.acceleration?),
            Acts::AsFill => LoadKind::Fill(self.fill.as_ref()?),
            Acts::AsAxle => LoadKind::Axle(self.axle.as_ref()?),
        })
    }

    /// Returns the places of action for which the load has keys, each with the first of these keys.
    pub(super) fn given(&self) -> Vec<(Acts, &'static str)> {
        let keys = [
            (Acts::OnEdges, "from", self.from.is_some()),
            (Acts::OnEdges, "to", self.to.is_some()),
            (Acts::OnEdges, "pressure", self.pressure.is_some()),
            (Acts::OnEdges, "traction", self.traction.is_some()),
            (Acts::OnEdges, "earth", self.earth.is_some()),
            (Acts::OnEdges, "inside", self.inside),
            (Acts::AtPlace, "block", self.block.is_some()),
            (Acts::AtPlace, "at", self.at.is_some()),
            (Acts::AtPlace, "force", self.force.is_some()),
            (Acts::AtPlace, "moment", self.moment.is_some()),
            (Acts::OnMass, "acceleration", self.acceleration.is_some()),
            (Acts::AsFill, "fill", self.fill.is_some()),
            (Acts::AsAxle, "axle", self.axle.is_some()),
        ];
        let mut kinds: Vec<_> = keys
            .into_iter()
            .filter(|(.., given)| *given)
            .map(|(acts, key, _)| (acts, key))
            .collect();
        kinds.dedup_by_key(|(acts, _)| *acts);
        kinds
    }

    fn named(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            group: None,
            factor: 1.0,
            from: None,
            to: None,
            pressure: None,
            traction: None,
            earth: None,
            inside: false,
            block: None,
            at: None,
            force: None,
            moment: None,
            acceleration: None,
            fill: None,
            axle: None,
            mass: None,
        }
    }
}

/// The place at which a load acts, as its keys determine it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Acts {
    OnEdges,
    AtPlace,
    OnMass,
    AsFill,
    AsAxle,
}

impl Acts {
    /// Returns the words for the place of action in messages.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::OnEdges => "on edges",
            Self::AtPlace => "at a place of a block",
            Self::OnMass => "on all mass",
            Self::AsFill => "of fill",
            Self::AsAxle => "of an axle",
        }
    }
}

/// A mistake in a load.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The load of this name has no keys of any kind of load.
    #[error(
        "load \"{0}\" has no keys of any kind of load: add `from`, `to` and `pressure`, `traction` or `earth` (on \
         edges), or `block`, `at` and `force` or `moment` (at a place of a block), or `acceleration` (on all mass), \
         or `fill`, or `axle`"
    )]
    NoKind(String),
    /// A load on a segment has no force per area.
    #[error("none of `pressure`, `traction` and `earth` is given: add one of them")]
    NoStress,
    /// The traction of a load with `inside` presses neither side of its segment.
    #[error(
        "the traction is zero or parallel to the segment, so that it presses no block: give it a component across the \
         segment, or leave `inside` out"
    )]
    Along,
    /// The load of this name, with `inside`, presses no block.
    #[error(
        "load \"{0}\" acts on nothing: the traction presses on no block edge along the segment: move the segment onto an edge \
         of a block (a mortar joint lies between two edges), or remove the load"
    )]
    IdleInside(String),
    /// No edge lies below the level of a fill.
    #[error(
        "load \"{load}\" acts on nothing: no free edge of \"{over}\" that faces upwards lies below its level: raise \
         `level`, or name another body in `over`"
    )]
    IdleFill {
        /// Name of the load.
        load: String,
        /// Name of the body that should carry the fill.
        over: String,
    },
    /// A load has keys of two kinds.
    #[error(
        "`{first}` is for a load {one} and `{second}` for one {other}: keep the keys of one kind, or make two loads"
    )]
    TwoKinds {
        /// A key of the first kind.
        first: &'static str,
        /// The place at which a load of the first kind acts.
        one: &'static str,
        /// A key of the second kind.
        second: &'static str,
        /// The place at which a load of the second kind acts.
        other: &'static str,
    },
    /// A mass is given for a load that is not a weight.
    #[error("load \"{load}\" has a `mass`, but {because}")]
    NoWeight {
        /// Name of the load.
        load: String,
        /// The reason why the load is not a weight.
        because: &'static str,
    },
    /// The block on which a force acts does not exist.
    #[error(
        "there is no block \"{name}\" in the scene; names near to it are {}: correct the name; bricks are called \
         WALL/COURSE/PLACE, counted from 1",
        listed(.near)
    )]
    NoBlock {
        /// The given name of the block.
        name: String,
        /// The names of blocks that are nearest to that name.
        near: Vec<String>,
    },
    /// The place of a force is outside of its block.
    #[error(
        "the place [{}, {}] lies {distance} {unit} outside of block \"{block}\": move it to [{}, {}], or farther \
         into the block",
        .place[0], .place[1], .nearest[0], .nearest[1]
    )]
    Outside {
        /// Name of the block.
        block: String,
        /// The place in units of the scene.
        place: [f64; 2],
        /// The nearest place of the block in units of the scene.
        nearest: [f64; 2],
        /// The distance of the two places in units of the scene.
        distance: f64,
        /// Unit of length.
        unit: &'static str,
    },
    /// An acceleration, the load of this name, acts on nothing, since nothing has a mass.
    #[error(
        "load \"{0}\" accelerates nothing, because no material of a block has a density: add `density` to a \
         material, or remove the load"
    )]
    NoMass(String),
    /// A load or a group has the name of the axles of a train; the value is the name.
    #[error("the name \"{0}\" belongs to the axles of `[limit.train]`: give it another name")]
    OfTrain(String),
    /// A combination has a name that ends in ", opposite", as combinations in the opposite direction do; the value is
    /// the name.
    #[error(
        "\"{0}\" ends in \", opposite\", which is added to the names of combinations whose earthquake comes from the other \
         side: give it another name"
    )]
    Opposite(String),
    /// The growing load is the support of this name, which has no limit load.
    #[error(
        "\"{0}\" is a support. Rigid blocks follow every movement of a support, so there is no limit: name a load or a \
         group of loads"
    )]
    Support(String),
    /// A stage or a combination uses a name that is both that of a load and that of a group of other loads.
    #[error(
        "\"{name}\" is the name of a load, and of the group of {}: give one of them another name; there are the \
         loads {} and the groups {}",
        listed(.members), listed(.loads), listed(.groups)
    )]
    Ambiguous {
        /// The ambiguous name.
        name: String,
        /// The loads of the group with this name.
        members: Vec<String>,
        /// The names of all loads.
        loads: Vec<String>,
        /// The names of all groups.
        groups: Vec<String>,
    },
    /// A stage or a combination names a load twice, for example by its own name and by its group.
    #[error("load \"{load}\" is named twice, as \"{first}\" and as \"{second}\": keep one of them")]
    Twice {
        /// Name of the load.
        load: String,
        /// The first name that refers to the load.
        first: String,
        /// The second name that refers to the load.
        second: String,
    },
}

fn listed(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    names.join(", ")
}

/// Returns the factor of a load, by the name of the load or of its group; `None` if neither is named.
pub(crate) fn factor_in(factors: &BTreeMap<String, f64>, load: &Load) -> Option<f64> {
    factors.iter().find(|(name, _)| load.is_called(name)).map(|(_, factor)| *factor)
}

pub(super) fn one() -> f64 {
    1.0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
fn is_false(it: &bool) -> bool {
    !it
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
pub(super) fn is_one(factor: &f64) -> bool {
    // The bits are compared, since a value that differs in any bit is written.
    factor.to_bits() == 1_f64.to_bits()
}
