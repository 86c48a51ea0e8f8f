//! The model: blocks, supports, joints and contact points of a scene, in SI units.
//!
//! A [`Model`] has only geometry and data: it does not assemble or solve any equations. Its blocks, supports and
//! joints are those of the [`scene`](crate::scene), placed in the structure.
//!
//! # Signs
//! At an interface `a` is the body behind and `b` the body in front: the unit normal `n` points
//! from `a` to `b`, and `t` is `n` turned by -90 degrees, `t = (n_y, -n_x)`. Then
//! * normal gap `y_n = (u_b - u_a).n + x_0` \[m\], never negative;
//! * slip `y_t = (u_b - u_a).t + s_0` \[m\];
//! * `t_n` \[N\] acts on `b` along `+n`: compression is positive; tension needs a tensile strength;
//! * `t_t` \[N\] acts on `b` along `+t`.

pub mod bending;
mod classes;
mod dry;
mod forces;
mod from_scene;
#[doc(hidden)]
pub mod heal;
pub mod joints;
pub mod loads;
pub mod mesh;
mod place_fills;
mod place_loads;
mod placement;
mod unusual;

pub use dry::DRY_JOINT;
pub use forces::Cause;
pub use heal::Healed;
pub use loads::{Acceleration, BlockLoad, EdgeLoad, LoadCase, PlacedForce, PointLoad};
use nalgebra::{Point2, Vector2};

use crate::ids::{BlockId, FilmId, JointId, SupportId};
use crate::law::{JointLaw, PointLaw};
pub use crate::material::Elasticity;
use crate::material::FilmMaterial;
use crate::material::constitutive;
use crate::model::mesh::BlockMesh;
pub use crate::scene::{Movement, Plane, PointRule};
use crate::units::Units;

/// A structure for analysis: its blocks, supports, joints, contact points and loads, in SI units (m, N, Pa, kg/m^3).
#[derive(Debug, Clone)]
pub struct Model {
    /// The blocks, in the order of the scene.
    pub blocks: Vec<PlacedBlock>,
    /// The rigid supports, in the order of the scene.
    pub supports: Vec<PlacedSupport>,
    /// The joints: overlaps of edges at which two blocks, or a block and a support, can touch.
    pub joints: Vec<PlacedJoint>,
    /// The points at which the contact law is enforced, joint by joint.
    pub contacts: Vec<JointPoint>,
    /// The classes to which the joints refer, each with its law.
    pub joint_classes: Vec<JointClass>,
    /// Plane stress or plane strain.
    pub plane: Plane,
    /// Thickness out of the plane \[m\].
    pub thickness: f64,
    /// Gravity as an acceleration \[m/s^2\]; zero if the scene has none.
    pub gravity: Vector2<f64>,
    /// Accelerations among the loads, which act on mass in addition to gravity.
    pub accelerations: Vec<Acceleration>,
    /// Names and factors of the loads, in the order of the scene.
    pub loads: Vec<LoadCase>,
    /// The corners of single blocks that were moved, and the changes that were made when a drawing was read; `None` if
    /// nothing was changed.
    pub healed: Option<Healed>,
    /// The units of the scene, in which results are reported.
    pub units: Units,
}

impl Model {
    /// Returns whether mortar films are strips, which have stresses along the joints.
    pub fn has_strips(&self) -> bool {
        self.contacts.iter().any(|it| it.film.is_some_and(|film| film.stretch.is_some()))
    }

    /// Removes cohesion and tensile strength from all joints; friction remains.
    pub(crate) fn remove_strength(&mut self) {
        for contact in &mut self.contacts {
            contact.law = PointLaw::friction(contact.law.mu);
        }
    }
}

/// A block of the structure (brick or voussoir): a simple polygon; star-shaped about its centroid if it is elastic.
#[derive(Debug, Clone)]
pub struct PlacedBlock {
    /// The name of the block in messages and files.
    pub name: String,
    /// The corners, counter-clockwise \[m\]. Edge `k` runs from corner `k` to the next.
    pub corners: Vec<Point2<f64>>,
    /// Elastic constants; `None` for a rigid block, which has no mesh and no stiffness.
    pub elasticity: Option<Elasticity>,
    /// Mass density \[kg/m^3\]; `None` for a block without self weight.
    pub density: Option<f64>,
    /// The mesh of four-node elements; `None` for a rigid block.
    pub mesh: Option<BlockMesh>,
    /// Loads on the block: tractions on its edges, and forces at places in it.
    pub loads: Vec<BlockLoad>,
}

impl PlacedBlock {
    /// Returns the loads on the edges of the block.
    pub fn edge_loads(&self) -> impl Iterator<Item = &EdgeLoad> {
        self.loads
            .iter()
            .filter_map(|it| if let BlockLoad::Edge(load) = it { Some(load) } else { None })
    }

    /// Returns the forces at places in the block.
    pub fn point_loads(&self) -> impl Iterator<Item = &PointLoad> {
        self.loads
            .iter()
            .filter_map(|it| if let BlockLoad::Point(load) = it { Some(load) } else { None })
    }
}

/// A rigid straight support of the structure.
#[derive(Debug, Clone)]
pub struct PlacedSupport {
    /// The name of the support in messages and reports.
    pub name: String,
    /// One end of the support \[m\].
    pub from: Point2<f64>,
    /// The other end of the support \[m\].
    pub to: Point2<f64>,
    /// The movement of the support from its place in the scene \[m\]; gaps and slips of its contact points include the
    /// movement.
    pub movement: Movement,
}

impl PlacedSupport {
    /// Returns the displacement \[m\] of the support at a place on or near it.
    pub fn displacement_at(&self, place: Point2<f64>) -> Vector2<f64> {
        let Movement { x, y, turn } = self.movement;
        let arm = place - nalgebra::center(&self.from, &self.to);
        Vector2::new(x - turn * arm.y, y + turn * arm.x)
    }
}

/// A class of joints: its name, law, contact points and mortar.
#[derive(Debug, Clone, PartialEq)]
pub struct JointClass {
    /// The name in the scene: `bed`, `head`, or the class of a support or of another group of joints.
    pub name: String,
    /// The law of sliding and opening of the joints.
    pub law: JointLaw,
    /// The rule for the positions of contact points on the joints; `None` for the rule of the whole scene.
    pub points: Option<PointRule>,
    /// The mortar that fills the joints; `None` for dry joints.
    pub mortar: Option<Mortar>,
}

/// A layer of mortar of some thickness and material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mortar {
    /// Thickness `t_y` \[m\].
    pub thickness: f64,
    /// The material of the mortar.
    pub material: FilmMaterial,
}

impl Mortar {
    /// Returns the normal and the tangential compliance \[m/N\] of a layer with an area \[m^2\], if it is not strained
    /// along the joint: `t_y / (C_22 area)` and `t_y / (G area)`.
    pub fn compliance(&self, area: f64) -> [f64; 2] {
        let matrix = constitutive(self.material.elasticity, self.material.plane);
        [1, 2].map(|k| self.thickness / (matrix[(k, k)] * area))
    }

    /// Returns the terms of a part of a strip that depend on the strain along the joint; the part has a length \[m\],
    /// and the wall a thickness \[m\].
    pub fn stretch(&self, length: f64, wall: f64) -> Stretch {
        let matrix = constitutive(self.material.elasticity, self.material.plane);
        let coupling = matrix[(0, 1)] / matrix[(1, 1)];
        let modulus = matrix[(0, 0)] - coupling * matrix[(1, 0)];
        Stretch { stiffness: modulus * self.thickness * wall / length, coupling }
    }
}

/// The terms of a strip of mortar (3.28)-(3.39) that need the strain `eps_x` along the joint.
///
/// The energy density `w` of a strip with `eps_x` is the sum of the energy of a bar, which acts whether the faces
/// press or not, and of the energy of the compliances:
///
/// ```text
///  w = 1/2 [ (C_11 - C_12^2 / C_22) eps_x^2 + sigma_y^2 / C_22 + tau^2 / G ],
///  sigma_x = (C_11 - C_12^2 / C_22) eps_x + (C_12 / C_22) sigma_y
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Stiffness of the bar, its force divided by its elongation: `(C_11 - C_12^2 / C_22) t_y t_z / length` \[N/m\].
    pub stiffness: f64,
    /// Ratio `C_12 / C_22` \[-\]: a film whose thickness is held opens by `t_y (C_12 / C_22) eps_x` if it is
    /// stretched, or gets tension.
    pub coupling: f64,
}

/// The film of mortar in one joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    /// The index of the film among the films of the model.
    pub id: FilmId,
    /// Thickness and material of the mortar.
    pub mortar: Mortar,
}

/// A body on one side of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum Body {
    /// A block of the model.
    Block(BlockId),
    /// A rigid support of the model.
    Support(SupportId),
}

/// A joint: the overlap of an edge of one block with an edge of another block, or with a support.
#[derive(Debug, Clone)]
pub struct PlacedJoint {
    /// The body behind the joint, from which the normal points away. A support is always on this side.
    pub a: Body,
    /// The block in front of the joint, into which the normal points.
    pub b: BlockId,
    /// The class of the joint, an index into [`Model::joint_classes`].
    pub class: usize,
    /// Start of the overlap \[m\]; for a film, it lies in the middle between the faces.
    pub from: Point2<f64>,
    /// End of the overlap \[m\]; for a film, it lies in the middle between the faces.
    pub to: Point2<f64>,
    /// Unit normal from `a` to `b`.
    pub normal: Vector2<f64>,
    /// The film of mortar between the two sides; `None` for a dry joint.
    pub film: Option<Film>,
}

impl PlacedJoint {
    /// Returns the unit tangent: the normal turned by -90 degrees.
    pub fn tangent(&self) -> Vector2<f64> {
        Vector2::new(self.normal.y, -self.normal.x)
    }

    /// Returns the length of the overlap \[m\].
    pub fn length(&self) -> f64 {
        (self.to - self.from).norm()
    }

    /// Returns start and end of the face on side `a`, and of the face on side `b` \[m\].
    pub fn faces(&self) -> [[Point2<f64>; 2]; 2] {
        let half = self.normal * (0.5 * self.film.map_or(0.0, |film| film.mortar.thickness));
        [[self.from - half, self.to - half], [self.from + half, self.to + half]]
    }
}

/// A place on the boundary of a block: a fraction of one of its edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor {
    /// The block of the place.
    pub block: BlockId,
    /// The edge of the block, from 0.
    pub edge: usize,
    /// The place as a fraction of the edge from its first corner, from 0 to 1.
    pub at: f64,
}

/// A point at which the contact law is enforced.
#[derive(Debug, Clone)]
pub struct JointPoint {
    /// The joint to which the point belongs.
    pub joint: JointId,
    /// The place of the point \[m\]; half way between the faces of a film, where the film's forces act.
    pub position: Point2<f64>,
    /// The area that the point stands for \[m^2\]: traction = force / weight.
    pub weight: f64,
    /// The place of the point on side `a`; `None` if that side is a support.
    pub a: Option<Anchor>,
    /// The place of the point on side `b`.
    pub b: Anchor,
    /// Initial gap `x_0` \[m\]. The gap of a film is the distance of its faces minus its thickness: zero for a film in
    /// contact.
    pub gap: f64,
    /// Initial slip `s_0` \[m\], due to the slip at the start of the step and the movement of a support.
    pub slip: f64,
    /// The law of the joint's class, for the area that the point stands for.
    pub law: PointLaw,
    /// Normal and tangential compliance of the joint itself, from its [stiffness](JointLaw::stiffness) \[m/N\]; zeros
    /// if the joint is rigid.
    pub compliance: [f64; 2],
    /// Additional data of a point of a film; `None` in a dry joint.
    pub film: Option<FilmPoint>,
}

impl JointPoint {
    /// Returns the normal and the tangential compliance of the joint and of a film in it, in series \[m/N\].
    pub fn gives(&self) -> [f64; 2] {
        let film = self.film.map_or([0.0; 2], |film| film.compliance);
        [0, 1].map(|k| self.compliance[k] + film[k])
    }
}

/// The data of a contact point in a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmPoint {
    /// Half the thickness of the film \[m\], the distance of the point from either face.
    pub half: f64,
    /// Length of the film that the point stands for \[m\].
    pub length: f64,
    /// Start and end, on side `a`, of the length that the point stands for, along the tangent; `None` if that side is
    /// a support.
    pub a: Option<[Anchor; 2]>,
    /// Start and end, on side `b`, of the length that the point stands for, along the tangent.
    pub b: [Anchor; 2],
    /// Normal and tangential compliance of this part of the film \[m/N\].
    pub compliance: [f64; 2],
    /// The terms that depend on the strain along the joint; `None` if films are compliances only.
    pub stretch: Option<Stretch>,
}

impl FilmPoint {
    /// Returns start and end of the film's length on side `a` and on side `b`; `None` for a support.
    pub fn faces(&self) -> [Option<[Anchor; 2]>; 2] {
        [self.a, Some(self.b)]
    }

    /// Returns the gap per unit of elongation, `t_y (C_12 / C_22) / length` \[-\]; zero if [`stretch`](Self::stretch)
    /// is `None`.
    pub fn gap_per_elongation(&self) -> f64 {
        self.stretch.map_or(0.0, |stretch| 2.0 * self.half * stretch.coupling / self.length)
    }
}
