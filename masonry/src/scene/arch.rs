//! Arches: voussoirs between joints, by shape, with springings or piers.

mod lines;
mod place;

use serde::{Deserialize, Serialize};

pub(crate) use lines::lines;
pub(crate) use place::{NamedBlock, blocks, supports};

use super::setters::setters;
use super::strict;

/// An arch of voussoirs, from the left springing to the right.
///
/// The voussoirs are called `name/1`, `name/2` and so on, or `name/1/1` if `rings` is given, with the ring first, from the
/// intrados; blocks of piers `name/left/1` and `name/right/1` from the bottom, and
/// the supports below both ends `name/left` and `name/right`.
///
/// ```
/// use masonry::scene::Arch;
/// let arch = Arch::segmental("bridge", "stone", 4.0, 1.0, 0.4, 21).springing("joint");
/// assert_eq!((arch.span, arch.rise), (Some(4.0), Some(1.0)));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Arch {
    /// Name of the arch.
    pub name: String,
    /// Name of the material of voussoirs and piers.
    pub material: String,
    /// Shape of the intrados.
    pub shape: Shape,
    /// The left end of the intrados \[length\].
    #[serde(default, deserialize_with = "strict::read")]
    pub origin: Option<[f64; 2]>,
    /// Distance between the ends of the intrados \[length\].
    pub span: Option<f64>,
    /// Height of the crown of the intrados above its ends \[length\].
    pub rise: Option<f64>,
    /// Angle of a segmental arch at the centre of its circle \[degrees\], instead of the rise.
    pub embrace_deg: Option<f64>,
    /// Angle of the springings of a flat arch with a straight intrados from the vertical \[degrees\].
    pub skew_deg: Option<f64>,
    /// Depth of the ring, or height of a flat arch \[length\].
    pub thickness: Option<f64>,
    /// Number of voussoirs, in every ring.
    pub voussoirs: Option<u32>,
    /// Number of rings, into which the thickness is divided.
    pub rings: Option<u32>,
    /// The class of the joints between rings, instead of `joint`.
    pub ring_joint: Option<String>,
    /// The joints from left to right, each from the intrados to the extrados \[length\], if no shape gives them.
    #[serde(default, deserialize_with = "strict::read")]
    pub lines: Option<Vec<JointLine>>,
    /// The class of the joints within the arch, instead of `bed` and `head`.
    pub joint: Option<String>,
    /// The class of the joints with rigid supports below both ends; there are no such supports without it.
    pub springing: Option<String>,
    /// Piers or buttresses below both ends.
    #[serde(default, deserialize_with = "strict::read")]
    pub piers: Option<Piers>,
    /// Elements of every block; required when the material is elastic.
    #[serde(default, deserialize_with = "strict::mesh")]
    #[cfg_attr(test, schemars(with = "Option<super::Elements>"))]
    pub mesh: Option<[u32; 2]>,
}

/// A joint from the intrados to the extrados \[length\].
pub type JointLine = [[f64; 2]; 2];

/// The shape of an arch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// An arc of a circle: `span`, and `rise` or `embrace_deg`; joints towards the centre.
    Segmental,
    /// Half a circle: `span`.
    Semicircular,
    /// Two arcs that meet at the crown: `span` and `rise`; an even number of voussoirs.
    Pointed,
    /// A level top: `span`, and `skew_deg` of a straight intrados or `rise` of an arc; joints towards one point below.
    Flat,
    /// The joints are given: `lines`.
    Joints,
}

/// Piers below both ends of an arch. The inner face is in line with the end of the intrados; if the springing is inclined, a
/// block with that face lies on top.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Piers {
    /// Width of a pier \[length\].
    pub width: f64,
    /// Height up to the end of the intrados \[length\].
    pub height: f64,
    /// Number of blocks on top of each other.
    pub courses: u32,
}

impl Arch {
    /// An arc of a circle by span and rise of the intrados, thickness \[length\] and number of voussoirs.
    pub fn segmental(
        name: &str,
        material: &str,
        span: f64,
        rise: f64,
        thickness: f64,
        voussoirs: u32,
    ) -> Self {
        Self {
            rise: Some(rise),
            ..Self::new(name, material, Shape::Segmental, span, thickness, voussoirs)
        }
    }

    /// Half a circle by the span of the intrados, thickness \[length\] and number of voussoirs.
    pub fn semicircular(
        name: &str,
        material: &str,
        span: f64,
        thickness: f64,
        voussoirs: u32,
    ) -> Self {
        Self::new(name, material, Shape::Semicircular, span, thickness, voussoirs)
    }

    /// Two arcs that meet at the crown, by span and rise of the intrados, thickness \[length\] and an even number of voussoirs.
    pub fn pointed(
        name: &str,
        material: &str,
        span: f64,
        rise: f64,
        thickness: f64,
        voussoirs: u32,
    ) -> Self {
        let rise = Some(rise);
        Self { rise, ..Self::new(name, material, Shape::Pointed, span, thickness, voussoirs) }
    }

    /// A flat arch by span, angle of the springings from the vertical \[degrees\], height \[length\] and number of voussoirs.
    pub fn flat(
        name: &str,
        material: &str,
        span: f64,
        skew_deg: f64,
        height: f64,
        voussoirs: u32,
    ) -> Self {
        let skew_deg = Some(skew_deg);
        Self { skew_deg, ..Self::new(name, material, Shape::Flat, span, height, voussoirs) }
    }

    /// Voussoirs between joints from left to right, each from the intrados to the extrados \[length\].
    ///
    /// ```
    /// use masonry::scene::Arch;
    /// let lines = vec![[[0.0, 0.0], [-0.2, 0.3]], [[0.5, 0.1], [0.5, 0.4]], [[1.0, 0.0], [1.2, 0.3]]];
    /// assert_eq!(Arch::between_joints("arch", "stone", lines).lines.unwrap().len(), 3);
    /// ```
    pub fn between_joints(name: &str, material: &str, lines: Vec<JointLine>) -> Self {
        let arch = Self::new(name, material, Shape::Joints, 0.0, 0.0, 0);
        Self { span: None, thickness: None, voussoirs: None, lines: Some(lines), ..arch }
    }

    setters! {
        /// Puts the left end of the intrados at this point \[length\].
        pub fn origin(mut self, origin: [f64; 2]) { self.origin = Some(origin) }
        /// Gives the joints between voussoirs a class, instead of `bed` and `head`.
        pub fn joint(mut self, joint: &str) { self.joint = Some(joint.to_owned()) }
        /// Divides the thickness into rings.
        pub fn rings(mut self, rings: u32) { self.rings = Some(rings) }
        /// Gives the joints between rings a class.
        pub fn ring_joint(mut self, joint: &str) { self.ring_joint = Some(joint.to_owned()) }
        /// Puts piers below both ends.
        pub fn piers(mut self, piers: Piers) { self.piers = Some(piers) }
        /// Gives every block a mesh, which elastic blocks need.
        pub fn mesh(mut self, mesh: [u32; 2]) { self.mesh = Some(mesh) }
        /// Puts rigid supports below both ends, whose joints are of a class.
        pub fn springing(mut self, joint: &str) { self.springing = Some(joint.to_owned()) }
    }

    fn new(
        name: &str,
        material: &str,
        shape: Shape,
        span: f64,
        thickness: f64,
        voussoirs: u32,
    ) -> Self {
        Self {
            name: name.to_owned(),
            material: material.to_owned(),
            shape,
            origin: None,
            span: Some(span),
            rise: None,
            embrace_deg: None,
            skew_deg: None,
            thickness: Some(thickness),
            voussoirs: Some(voussoirs),
            rings: None,
            ring_joint: None,
            lines: None,
            joint: None,
            springing: None,
            piers: None,
            mesh: None,
        }
    }
}
