//! Loads on edges, at places in blocks and on all mass, and their errors.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::fill::{Axle, Fill};
use super::setters::setters;
use super::stress::{Earth, EdgeStress, Pressure};
use super::strict;

/// A load of exactly one kind: [`LoadKind`] lists the keys of each.
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
    /// Group of the load; by default a group of its own, with the name of the load.
    pub group: Option<String>,
    /// Factor of the load \[-\].
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub factor: f64,
    /// One end of a segment \[length\].
    #[serde(default, deserialize_with = "strict::read")]
    pub from: Option<[f64; 2]>,
    /// The other end \[length\].
    #[serde(default, deserialize_with = "strict::read")]
    pub to: Option<[f64; 2]>,
    /// Force per area against the outward normal of the edge \[force/length^2\]: a number, or two for a pressure that is
    /// linear from one end of the segment to the other.
    pub pressure: Option<Pressure>,
    /// Force per area in global axes \[force/length^2\].
    #[serde(default, deserialize_with = "strict::read")]
    pub traction: Option<[f64; 2]>,
    /// Earth or water that presses against the outward normal of the edge, in proportion to the depth below its level.
    #[serde(default, deserialize_with = "strict::read")]
    pub earth: Option<Earth>,
    /// Whether the segment may lie within joints: the traction acts on the edges that it presses, such as those below a floor.
    #[serde(default, skip_serializing_if = "is_false")]
    pub inside: bool,
    /// Name of a block.
    pub block: Option<String>,
    /// A place inside or on the edge of that block \[length\].
    #[serde(default, deserialize_with = "strict::read")]
    pub at: Option<[f64; 2]>,
    /// The force over the whole thickness in global axes \[force\].
    #[serde(default, deserialize_with = "strict::read")]
    pub force: Option<[f64; 2]>,
    /// The moment over the whole thickness at that place, counter-clockwise \[force length\].
    pub moment: Option<f64>,
    /// An acceleration that acts on mass like gravity \[m/s^2\]: an acceleration to the right pushes to the right.
    #[serde(default, deserialize_with = "strict::read")]
    pub acceleration: Option<[f64; 2]>,
    /// Fill over an arch, a wall or a block.
    #[serde(default, deserialize_with = "strict::read")]
    pub fill: Option<Fill>,
    /// An axle on a fill or on blocks.
    #[serde(default, deserialize_with = "strict::read")]
    pub axle: Option<Axle>,
    /// The part of a load on edges or at a place, from 0 to 1, that is the weight of a mass, such as that of a roof:
    /// accelerations act on this mass at the place of the load. `true` is 1 and `false` 0. The mass is that of the
    /// component along gravity, times the factor of the load; factors of stages and limit loads do not change it. Earth
    /// and water have no mass unless it is given.
    #[serde(default, deserialize_with = "strict::part")]
    #[cfg_attr(test, schemars(with = "Option<AllOrPart>"))]
    pub mass: Option<f64>,
}

/// The whole, nothing, or a part.
#[cfg(test)]
#[derive(schemars::JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "it describes what is read")]
enum AllOrPart {
    All(bool),
    Of(f64),
}

/// The kinds of loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LoadKind<'a> {
    /// A load on the free edges of blocks that lie on a segment: `from`, `to`, and exactly one of `pressure`,
    /// `traction` and `earth`. An edge that the segment covers in part is loaded in part.
    Edge {
        /// One end of the segment \[length\].
        from: [f64; 2],
        /// The other end \[length\].
        to: [f64; 2],
        /// The force per area.
        stress: EdgeStress,
        /// Whether edges within joints are loaded as well, if the traction presses them.
        inside: bool,
    },
    /// A force at a place of a block: `block`, `at` and `force`.
    Force {
        /// Name of the block.
        block: &'a str,
        /// The place \[length\].
        at: [f64; 2],
        /// The force \[force\].
        force: [f64; 2],
    },
    /// A moment at a place of a block: `block`, `at` and `moment`.
    Moment {
        /// Name of the block.
        block: &'a str,
        /// The place \[length\].
        at: [f64; 2],
        /// The moment, counter-clockwise \[force length\].
        moment: f64,
    },
    /// An acceleration of all mass \[m/s^2\]: `acceleration`.
    Acceleration([f64; 2]),
    /// Fill over an arch, a wall or a block: `fill`.
    Fill(&'a Fill),
    /// An axle: `axle`.
    Axle(&'a Axle),
}

impl Load {
    /// A pressure \[force/length^2\] against the outward normal of the edges on a segment; two numbers are the pressures at
    /// its two ends.
    pub fn pressure(
        name: &str,
        from: [f64; 2],
        to: [f64; 2],
        pressure: impl Into<Pressure>,
    ) -> Self {
        let (from, to) = (Some(from), Some(to));
        Self { from, to, pressure: Some(pressure.into()), ..Self::named(name) }
    }

    /// A traction \[force/length^2\] in global axes on the edges on a segment.
    pub fn traction(name: &str, from: [f64; 2], to: [f64; 2], traction: [f64; 2]) -> Self {
        let (from, to) = (Some(from), Some(to));
        Self { from, to, traction: Some(traction), ..Self::named(name) }
    }

    /// The pressure of earth or water against the outward normal of the edges on a segment.
    pub fn earth(name: &str, from: [f64; 2], to: [f64; 2], earth: Earth) -> Self {
        let (from, to) = (Some(from), Some(to));
        Self { from, to, earth: Some(earth), ..Self::named(name) }
    }

    /// A force \[force\] over the whole thickness at a place \[length\] inside or on the edge of a block.
    pub fn force(name: &str, block: &str, at: [f64; 2], force: [f64; 2]) -> Self {
        let (block, at) = (Some(block.to_owned()), Some(at));
        Self { block, at, force: Some(force), ..Self::named(name) }
    }

    /// A moment \[force length\] over the whole thickness, counter-clockwise, at a place \[length\] inside or on the edge of a
    /// block.
    pub fn moment(name: &str, block: &str, at: [f64; 2], moment: f64) -> Self {
        let (block, at) = (Some(block.to_owned()), Some(at));
        Self { block, at, moment: Some(moment), ..Self::named(name) }
    }

    /// An acceleration \[m/s^2\] that acts on all mass like gravity.
    pub fn acceleration(name: &str, acceleration: [f64; 2]) -> Self {
        Self { acceleration: Some(acceleration), ..Self::named(name) }
    }

    /// Fill over an arch, a wall or a block, up to a level \[length\], with a weight \[force/length^3\].
    pub fn fill(name: &str, over: &str, level: f64, gamma: f64) -> Self {
        let fill = Some(Fill { over: over.to_owned(), level, gamma });
        Self { fill, ..Self::named(name) }
    }

    /// An axle on a fill or on blocks.
    pub fn axle(name: &str, axle: Axle) -> Self {
        Self { axle: Some(axle), ..Self::named(name) }
    }

    setters! {
        /// Puts the load into a group.
        pub fn group(mut self, group: &str) { self.group = Some(group.to_owned()) }
        /// Multiplies the load by a factor \[-\], instead of one.
        pub fn factor(mut self, factor: f64) { self.factor = factor }
        /// Makes a part of the load, from 0 to 1, the weight of a mass on which accelerations act.
        pub fn mass(mut self, part: f64) { self.mass = Some(part) }
    }

    /// Lets a traction act on edges within joints too, if it presses them.
    #[must_use]
    pub fn inside(self) -> Self {
        Self { inside: true, ..self }
    }

    /// The name of the group of the load.
    pub fn group_name(&self) -> &str {
        self.group.as_deref().unwrap_or(&self.name)
    }

    /// Whether the load is the weight of a mass, at least in part, which keeps its direction in an earthquake.
    pub(super) fn has_mass(&self) -> bool {
        self.mass.is_some_and(|part| part > 0.0)
    }

    /// Whether a stage or a combination refers to the load by this name: the name of the load or of its group.
    pub fn is_called(&self, name: &str) -> bool {
        self.name == name || self.group_name() == name
    }

    /// The kind of the load; `None` if its keys are not those of exactly one kind, which
    /// [`Scene::check`](super::Scene::check) refuses.
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

    /// The places of action for which keys are given, each with the first of these keys.
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

/// The place at which a load acts, by its keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Acts {
    OnEdges,
    AtPlace,
    OnMass,
    AsFill,
    AsAxle,
}

impl Acts {
    /// The place of action in messages.
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
    /// The load of this name is of no kind.
    #[error(
        "load \"{0}\" has no keys of any kind of load: add `from`, `to` and `pressure`, `traction` or `earth` (on \
         edges), or `block`, `at` and `force` or `moment` (at a place of a block), or `acceleration` (on all mass), \
         or `fill`, or `axle`"
    )]
    NoKind(String),
    /// A segment has no force per area.
    #[error("none of `pressure`, `traction` and `earth` is given: add one of them")]
    NoStress,
    /// A traction inside a wall presses neither side of its segment.
    #[error(
        "the traction is zero or parallel to the segment, so that it presses no block: give it a component across the \
         segment, or leave `inside` out"
    )]
    Along,
    /// The load of this name inside a wall presses no block.
    #[error(
        "load \"{0}\" acts on nothing: the traction presses on no block edge along the segment: move the segment onto an edge \
         of a block (a mortar joint lies between two edges), or remove the load"
    )]
    IdleInside(String),
    /// A fill lies on no edge.
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
    /// Keys of two kinds are given.
    #[error(
        "`{first}` is for a load {one} and `{second}` for one {other}: keep the keys of one kind, or make two loads"
    )]
    TwoKinds {
        /// A key of one kind.
        first: &'static str,
        /// The place at which a load of the first kind acts.
        one: &'static str,
        /// A key of another kind.
        second: &'static str,
        /// The place at which a load of the second kind acts.
        other: &'static str,
    },
    /// A mass is given for a load that is not a weight.
    #[error("load \"{load}\" has a `mass`, but {because}")]
    NoWeight {
        /// Name of the load.
        load: String,
        /// The reason.
        because: &'static str,
    },
    /// A force acts on a block that does not exist.
    #[error(
        "there is no block \"{name}\" in the scene; names near to it are {}: correct the name; bricks are called \
         WALL/COURSE/PLACE, counted from 1",
        listed(.near)
    )]
    NoBlock {
        /// The name that was given.
        name: String,
        /// The names of blocks that are nearest to that name.
        near: Vec<String>,
    },
    /// A force acts outside of its block.
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
    /// The load of this name accelerates, but nothing has a mass.
    #[error(
        "load \"{0}\" accelerates nothing, because no material of a block has a density: add `density` to a \
         material, or remove the load"
    )]
    NoMass(String),
    /// A load or a group has the name of the axles of a train.
    #[error("the name \"{0}\" belongs to the axles of `[limit.train]`: give it another name")]
    OfTrain(String),
    /// A combination has the name of one whose earthquake comes from the opposite side.
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
    /// A stage or a combination uses a name of a load that is also the group of others.
    #[error(
        "\"{name}\" is the name of a load, and of the group of {}: give one of them another name; there are the \
         loads {} and the groups {}",
        listed(.members), listed(.loads), listed(.groups)
    )]
    Ambiguous {
        /// The name.
        name: String,
        /// The loads of the group.
        members: Vec<String>,
        /// All loads.
        loads: Vec<String>,
        /// All groups.
        groups: Vec<String>,
    },
    /// A stage or a combination names a load twice.
    #[error("load \"{load}\" is named twice, as \"{first}\" and as \"{second}\": keep one of them")]
    Twice {
        /// Name of the load.
        load: String,
        /// One name.
        first: String,
        /// The other name.
        second: String,
    },
}

fn listed(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    names.join(", ")
}

/// The factor of a load by its name or that of its group; `None` if neither is named.
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
