//! Arches: voussoirs of an arch of some shape, with the springings or piers on which it rests.

mod lines;
mod place;

use serde::{Deserialize, Serialize};

pub(crate) use lines::lines;
pub(crate) use place::{NamedBlock, blocks, supports};

use super::setters::setters;
use super::strict;

/// An arch of voussoirs, which are counted from the left springing to the right.
///
/// The names of the voussoirs are `name/1`, `name/2` and so on, or, if `rings` is given, `name/1/1` with the number of
/// the ring first, from the intrados. Blocks of piers are `name/left/1` and `name/right/1` from the bottom, and the
/// supports below both ends `name/left` and `name/right`.
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
    /// Shape of the arch.
    pub shape: Shape,
    /// The left end of the intrados \[length\].
    #[serde(default, deserialize_with = "strict::read")]
    pub origin: Option<[f64; 2]>,
    /// Distance between the ends of the intrados \[length\].
    pub span: Option<f64>,
    /// Height of the crown of the intrados above its ends \[length\].
    pub rise: Option<f64>,
    /// Angle of a segmental arch, seen from the centre of its circle \[degrees\], instead of the rise.
    pub embrace_deg: Option<f64>,
    /// Angle between the springings and the vertical, of a flat arch with a straight intrados \[degrees\].
    pub skew_deg: Option<f64>,
    /// Depth of the ring, or height of a flat arch \[length\].
    pub thickness: Option<f64>,
    /// Number of voussoirs in each ring.
    pub voussoirs: Option<u32>,
    /// Number of rings, into which the thickness is divided.
    pub rings: Option<u32>,
    /// The class of the joints between rings, instead of `joint`.
    pub ring_joint: Option<String>,
    /// The joints of the shape `joints`, from left to right, each from the intrados to the extrados \[length\].
    #[serde(default, deserialize_with = "strict::read")]
    pub lines: Option<Vec<JointLine>>,
    /// The class of the joints within the arch, instead of `bed` and `head`.
    pub joint: Option<String>,
    /// The class of the joints with the rigid supports below both ends; without it there are no such supports.
    pub springing: Option<String>,
    /// Piers or buttresses below both ends.
    #[serde(default, deserialize_with = "strict::read")]
    pub piers: Option<Piers>,
    /// Numbers of elements of every block; required if the material is elastic.
    #[serde(default, deserialize_with = "strict::mesh")]
    #[cfg_attr(test, schemars(with = "Option<super::Elements>"))]
    pub mesh: Option<[u32; 2]>,
}

/// The two ends of a joint, on the intrados and on the extrados \[length\].
pub type JointLine = [[f64; 2]; 2];

/// The shape of an arch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// An arc of a circle, given by `span` and either `rise` or `embrace_deg`; joints point towards the centre.
    Segmental,
    /// Half a circle, given by `span`.
    Semicircular,
    /// Two arcs that meet at the crown, given by `span` and `rise`; the number of voussoirs is even.
    Pointed,
    /// An arch with a level top, given by `span` and either `skew_deg` for a straight intrados or `rise` for an arc;
    /// joints point towards one point below.
    Flat,
    /// An arch whose joints are given by `lines`.
    Joints,
}

/// Piers below both ends of an arch. The inner face of a pier is in line with the end of the intrados. If the
/// springing is inclined, a block with the face of the springing lies on top of the pier.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Piers {
    /// Width of a pier \[length\].
    pub width: f64,
    /// Height of a pier up to the springing, the lower end of the intrados \[length\].
    pub height: f64,
    /// Number of blocks on top of each other in a pier.
    pub courses: u32,
}

impl Arch {
    /// Makes a segmental arch by span and rise of the intrados and thickness \[length\], and number of voussoirs.
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

    /// Makes a semicircular arch by the span of the intrados and thickness \[length\], and number of voussoirs.
    pub fn semicircular(
        name: &str,
        material: &str,
        span: f64,
        thickness: f64,
        voussoirs: u32,
    ) -> Self {
        Self::new(name, material, Shape::Semicircular, span, thickness, voussoirs)
    }

    /// Makes a pointed arch by span and rise of the intrados and thickness \[length\], and an even number of
    /// voussoirs.
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

    /// Makes a flat arch by span \[length\], angle of the springings from the vertical \[degrees\], height \[length\]
    /// and number of voussoirs.
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

    /// Makes an arch by its joints from left to right, each from the intrados to the extrados \[length\].
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
        /// Sets the class of the joints within the arch, instead of `bed` and `head`.
        pub fn joint(mut self, joint: &str) { self.joint = Some(joint.to_owned()) }
        /// Divides the thickness into this number of rings.
        pub fn rings(mut self, rings: u32) { self.rings = Some(rings) }
        /// Sets the class of the joints between rings.
        pub fn ring_joint(mut self, joint: &str) { self.ring_joint = Some(joint.to_owned()) }
        /// Puts piers below both ends of the arch.
        pub fn piers(mut self, piers: Piers) { self.piers = Some(piers) }
        /// Sets the numbers of elements of every block, which elastic blocks need.
        pub fn mesh(mut self, mesh: [u32; 2]) { self.mesh = Some(mesh) }
        /// Puts rigid supports below both ends, and sets the class of their joints.
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
