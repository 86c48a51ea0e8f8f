//! The mechanical state of a structure: plain data, which need no other module of the crate, except the numbers of
//! parts (`ids`).

use nalgebra::{Point2, Vector2};
use serde::{Deserialize, Serialize};

use crate::ids::{BlockId, ContactId, FilmId};

/// The mechanical state of a model under its loads, in SI units.
#[derive(Debug, Clone)]
pub struct State {
    /// Displacements \[m\] of every block: of all nodes, in the order of the block's mesh, or of the corners of a rigid
    /// block.
    pub displacements: Vec<Vec<Vector2<f64>>>,
    /// Force, gap and slip at every contact point, in the order of the model.
    pub contacts: Vec<PointState>,
    /// Stresses at the contact points of the mortar films, in the order of the points; empty if there are no films, or
    /// if no output shows stresses.
    pub films: Vec<FilmStress>,
    /// Stresses at the centre of every element; empty if no output shows stresses.
    pub stresses: Vec<ElementStress>,
    /// Strain energy of all blocks, joints and films \[J\].
    pub strain_energy: f64,
}

/// Forces and relative displacements in all rows of a [`System`](crate::system::System), in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct RowState {
    /// Contact forces of all rows \[N\].
    pub t: Vec<f64>,
    /// Relative displacements of all rows \[m\].
    pub y: Vec<f64>,
}

/// The force, the gap and the slip at one contact point.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PointState {
    /// Normal contact force \[N\], compression positive.
    pub t_n: f64,
    /// Tangential contact force \[N\] that acts on side `b`, along the tangent `t` of the joint.
    pub t_t: f64,
    /// Normal gap \[m\]; the gap of a film is measured beyond the compression of the film.
    pub y_n: f64,
    /// Slip \[m\] of side `b` relative to side `a` along the tangent `t`; the slip of a film is measured beyond its
    /// shear.
    pub y_t: f64,
    /// The state of the point: open, stick or slip.
    pub status: PointStatus,
}

/// The three states of a contact point with friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PointStatus {
    /// The gap is positive, and the point carries no force.
    Open,
    /// The point is closed and does not slide.
    Stick,
    /// The point is closed, and its sides slide on each other: the force is on the edge of the friction cone.
    Slip,
}

/// Stress at one contact point of a mortar film, in the film's axes: `x` along the tangent of the
/// joint and `y` along its normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmStress {
    /// The mortar film.
    pub film: FilmId,
    /// The contact point.
    pub contact: ContactId,
    /// Stress along the joint \[Pa\], tension positive; `None` if films act only in the direction normal to their
    /// joints.
    pub sigma_x: Option<f64>,
    /// Stress normal to the joint \[Pa\], tension positive; never above zero.
    pub sigma_y: f64,
    /// Shear stress \[Pa\].
    pub tau: f64,
}

/// Stress at the centre of one element.
#[derive(Debug, Clone, Copy)]
pub struct ElementStress {
    /// The block that the element belongs to.
    pub block: BlockId,
    /// The position of the element in the mesh of the block.
    pub element: usize,
    /// The centre of the element \[m\].
    pub centre: Point2<f64>,
    /// The stresses `sigma_x, sigma_y, tau_xy` \[Pa\], tension positive.
    pub sigma: [f64; 3],
    /// The principal stresses and their direction.
    pub principal: Principal,
}

/// Principal stresses of a plane state of stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Principal {
    /// The larger (more tensile) principal stress \[Pa\].
    pub sigma_1: f64,
    /// The smaller (more compressive) principal stress \[Pa\].
    pub sigma_2: f64,
    /// Angle of the direction of `sigma_1` from the x axis \[rad\], in `(-pi/2, pi/2]`.
    pub theta: f64,
}

/// The reaction of one support: the resultant of its contact forces on the structure, in SI units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reaction {
    /// Name of the support.
    pub support: String,
    /// Horizontal force on the structure \[N\].
    pub fx: f64,
    /// Vertical force on the structure \[N\].
    pub fy: f64,
    /// Moment about the origin of coordinates, counter-clockwise \[N m\].
    pub m: f64,
}
