//! The equilibrium system of a model, block by block: stiffness, loads and contact rows.
//!
//! The equations are `K u = f + C^T t` (3.2) and `y = C u + x`. `K` is block-diagonal, so that all data are kept per
//! block. Row `c` of `C`, for `c` below the number of contact points, is the normal row of contact point `c`. The
//! tangential rows follow, one for each point with friction, in the order of the points.
//!
//! The stiffness of a joint, and a film of mortar, are springs in series with the contact: `y = C u + x + c t`. The
//! diagonal matrix `c` has the sum of their compliances for each row ([`Row::compliance`]). The shear displacement of
//! a film is that of the strip (3.38): `(u_b - u_a).t` plus half the thickness times the rotations of both faces, so
//! that no rigid motion shears the film. The force of a film acts on both faces in the middle between them. Mortar
//! films as strips have two more terms if they touch elastic blocks. Both depend on the elongation `e = L u` of the
//! film: a gap of `t_y (C_12 / C_22) eps_x` in the normal row, and the force of a bar ([`StretchRow`]): `K u + L^T D L
//! u = f + C^T t`. Rigid motions do not contribute to these terms.

use faer::Mat;
use nalgebra::{Point2, Vector2};

use crate::geometry;
use crate::ids::{BlockId, ContactId};
use crate::law::Friction;
use crate::model::mesh::BlockMesh;
use crate::model::{Elasticity, Model, PlacedBlock, PlacedJoint};
use crate::rounding::cleared;
use crate::system::rigid::Modes;

mod body;
mod error;
pub(crate) mod kinematics;
mod loads;
pub(crate) mod mass;
pub mod rigid;
mod stiffness;
mod stretch;

use body::entries;
pub use body::{BodyRow, BodyStretch, BodySystem};
pub use error::SystemError;
use kinematics::Term;
pub use loads::{nodal_loads, resultant};
use stiffness::Built;
pub use stiffness::Stiffness;
pub use stretch::StretchRow;

/// The direction in which a contact row measures the relative displacement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// Along the joint's normal.
    Normal,
    /// Along the joint's tangent.
    Tangent,
}

impl Direction {
    /// Returns the unit vector of this direction in a joint.
    pub fn of(self, joint: &PlacedJoint) -> Vector2<f64> {
        match self {
            Self::Normal => joint.normal,
            Self::Tangent => joint.tangent(),
        }
    }

    fn part(self, term: &Term) -> Vector2<f64> {
        match self {
            Self::Normal => term.normal,
            Self::Tangent => term.tangent,
        }
    }
}

/// A contact row: one row of `C`, of the contact forces `t` and of the relative displacements `y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The contact point of the row.
    pub contact: ContactId,
    /// The direction of the row: normal or tangential.
    pub direction: Direction,
    /// Initial gap `x_0` or initial slip `s_0` \[m\], minus the elongation that the tensile strength causes in a joint
    /// with a compliance.
    pub offset: f64,
    /// Compliance in this direction \[m/N\]: that of the joint plus that of its mortar film; zero if both are rigid.
    pub compliance: f64,
    /// The difference between the unknown and the contact force \[N\]: the tensile strength `T` of the point in a
    /// normal row, and zero in a tangential row. The difference is added to the loads on both sides.
    pub tension: f64,
}

impl Row {
    fn of(model: &Model, contact: ContactId, direction: Direction) -> Self {
        let point = &model.contacts[contact.index()];
        let compliance = point.gives();
        let (offset, compliance, tension) = match direction {
            Direction::Normal => (point.gap, compliance[0], point.law.tension),
            Direction::Tangent => (point.slip, compliance[1], 0.0),
        };
        Self { contact, direction, offset: offset - compliance * tension, compliance, tension }
    }
}

/// Stiffness, loads and contact rows of a whole model.
#[derive(Debug, Clone)]
pub struct System {
    /// The contact rows: normals of all points, then tangents of the points with friction.
    pub rows: Vec<Row>,
    /// The points that resist sliding and their bounds, in the order of the tangential rows.
    pub friction: Vec<Friction>,
    /// The blocks, in the order of the model.
    pub bodies: Vec<BodySystem>,
    /// The elongations of strips at elastic blocks; empty unless films are strips.
    pub stretches: Vec<StretchRow>,
    /// The stiffnesses of the elastic blocks; equal blocks share one.
    pub stiffnesses: Vec<Stiffness>,
}

impl System {
    /// Builds the system of a model. Equal blocks share one stiffness and its factorisation.
    ///
    /// # Errors
    /// [`SystemError`] with the block whose stiffness cannot be built.
    pub fn new(model: &Model) -> Result<Self, SystemError> {
        Self::build(model, Built::MatrixAndFactor)
    }

    /// Builds the system for [`Sparse`](crate::forms::Sparse), without the dense factors of the stiffnesses. Such a
    /// system cannot be reduced, and cannot be used for [`elastic_displacements`](Self::elastic_displacements).
    ///
    /// # Errors
    /// As [`System::new`], except for a stiffness that is not positive definite: only its factorisation would detect
    /// it.
    pub fn without_factors(model: &Model) -> Result<Self, SystemError> {
        Self::build(model, Built::Matrix)
    }

    fn build(model: &Model, parts: Built) -> Result<Self, SystemError> {
        let points = model.contacts.iter().enumerate();
        let friction: Vec<Friction> =
            points.filter_map(|(k, contact)| contact.law.sliding(ContactId::new(k))).collect();
        let normals = (0..model.contacts.len()).map(|k| (ContactId::new(k), Direction::Normal));
        let tangents = friction.iter().map(|friction| (friction.contact, Direction::Tangent));
        let rows: Vec<Row> = normals
            .chain(tangents)
            .map(|(contact, direction)| Row::of(model, contact, direction))
            .collect();

        let mut shared = stiffness::Shared::new(parts);
        let mut bodies = Vec::with_capacity(model.blocks.len());
        for block in &model.blocks {
            let elastic = elastic_part(block)?;
            let load = elastic.map_or_else(Vec::new, |(mesh, _)| nodal_loads(model, block, mesh));
            bodies.push(BodySystem {
                modes: Modes::of(&block.corners),
                stiffness: elastic
                    .map(|(mesh, e)| shared.index_of(model, block, mesh, e))
                    .transpose()?,
                load,
                resultant: resultant(model, block),
                rows: Vec::new(),
                stretches: Vec::new(),
            });
        }
        for (k, row) in rows.iter().enumerate() {
            add_row(model, &mut bodies, k, row);
        }
        let stretches = stretch::add_rows(model, &mut bodies);
        let stiffnesses = shared.into_list();
        let mut system = Self { rows, friction, bodies, stretches, stiffnesses };
        system.pull();
        Ok(system)
    }

    /// Replaces loads, gaps and slips by those of another state of the same model ([`Model::under`]); stiffness and
    /// contact rows stay the same.
    pub fn reload(&mut self, model: &Model) {
        for (body, block) in self.bodies.iter_mut().zip(&model.blocks) {
            if let (Some(_), Some(mesh)) = (body.stiffness, &block.mesh) {
                body.load = nodal_loads(model, block, mesh);
            }
            body.resultant = resultant(model, block);
        }
        for row in &mut self.rows {
            *row = Row::of(model, row.contact, row.direction);
        }
        self.pull();
    }

    /// Adds the differences between the normal unknowns and the contact forces ([`Row::tension`]) to the loads.
    fn pull(&mut self) {
        if self.rows.iter().all(|row| row.tension <= 0.0) {
            return;
        }
        for body in &mut self.bodies {
            for row in &body.rows {
                let force = -self.rows[row.row].tension;
                row.entries.iter().for_each(|(dof, c)| body.load[*dof] += c * force);
                body.resultant.iter_mut().zip(row.modes).for_each(|(r, mode)| *r += mode * force);
            }
        }
    }

    /// Returns the number of contact points, which is the number of normal rows.
    pub fn points(&self) -> usize {
        self.rows.len() - self.friction.len()
    }

    /// Returns whether contact forces deform anything: an elastic block, a joint with a finite stiffness or a film of
    /// mortar.
    pub fn gives_way(&self) -> bool {
        let is_elastic = |body: &BodySystem| body.stiffness.is_some();
        self.bodies.iter().any(is_elastic) || self.rows.iter().any(|row| row.compliance > 0.0)
    }

    /// Returns whether the blocks can be at rest under any forces: all blocks are rigid, no gap is open, there is no
    /// initial slip and no joint has a compliance.
    pub fn is_at_rest(&self) -> bool {
        let is_closed = |row: &Row| row.offset.abs() <= 0.0 && row.compliance <= 0.0;
        !self.gives_way() && self.rows.iter().all(is_closed)
    }

    /// Returns `G = C N`, the relative displacements in the rigid motions: one row per contact row, three columns per
    /// block.
    pub fn rigid_rows(&self) -> Mat<f64> {
        let mut g = Mat::zeros(self.rows.len(), 3 * self.bodies.len());
        for (b, body) in self.bodies.iter().enumerate() {
            for row in &body.rows {
                for (k, mode) in row.modes.iter().enumerate() {
                    g[(row.row, 3 * b + k)] = *mode;
                }
            }
        }
        g
    }

    /// Returns the rates of the normal gaps of all contact points for given rates of the rigid amplitudes, three per
    /// block.
    pub fn gap_rates(&self, amplitudes: &[f64]) -> Vec<f64> {
        let mut rates = vec![0.0; self.rows.len()];
        for (body, alpha) in self.bodies.iter().zip(amplitudes.chunks(3)) {
            for row in &body.rows {
                rates[row.row] += row.modes.iter().zip(alpha).map(|(g, a)| g * a).sum::<f64>();
            }
        }
        rates.truncate(self.points());
        rates
    }

    /// Returns `N^T f`, the work of the loads in the rigid motions \[N\]: three numbers per block.
    pub fn resultants(&self) -> Vec<f64> {
        self.bodies.iter().flat_map(|body| body.resultant).collect()
    }

    /// Returns `K^+ (f + C^T t + L^T q)` of one block \[m\] for forces `t` \[N\] of all rows and `q` \[N\] of all
    /// stretches. If loads and contact forces balance, the result is the displacements of the nodes up to a rigid
    /// motion. Empty for a rigid block.
    ///
    /// # Panics
    /// If `t` or `q` is shorter than the number of rows, or the system was built without factors.
    pub fn elastic_displacements(&self, body: &BodySystem, t: &[f64], q: &[f64]) -> Vec<f64> {
        let Some(stiffness) = body.stiffness.map(|k| &self.stiffnesses[k]) else {
            return Vec::new();
        };
        let mut load = body.load.clone();
        for row in &body.rows {
            row.entries.iter().for_each(|(dof, c)| load[*dof] += c * t[row.row]);
        }
        for stretch in &body.stretches {
            stretch.entries.iter().for_each(|(dof, c)| load[*dof] += c * q[stretch.row]);
        }
        let rhs = Mat::from_fn(load.len(), 1, |i, _| load[i]);
        stiffness.solve(&rhs).col_as_slice(0).to_vec()
    }
}

/// Returns the mesh and the elastic constants of a deformable block; `None` for a rigid block.
fn elastic_part(block: &PlacedBlock) -> Result<Option<(&BlockMesh, Elasticity)>, SystemError> {
    match (&block.mesh, block.elasticity) {
        (_, None) => Ok(None),
        (Some(mesh), Some(elasticity)) => Ok(Some((mesh, elasticity))),
        (None, Some(_)) => Err(SystemError::NoMesh { block: block.name.clone() }),
    }
}

/// Adds contact row `k` to the blocks on its two sides: with its sign to the block in front, and with the opposite
/// sign to the block behind.
fn add_row(model: &Model, bodies: &mut [BodySystem], k: usize, row: &Row) {
    let contact = &model.contacts[row.contact.index()];
    let joint = &model.joints[contact.joint.index()];
    let terms = kinematics::terms(model, contact);
    for (anchor, sign) in [(Some(contact.b), 1.0), (contact.a, -1.0)] {
        let Some(anchor) = anchor else { continue };
        let direction = row.direction.of(joint) * sign;
        let block = &model.blocks[anchor.block.index()];
        let body = &mut bodies[anchor.block.index()];
        let face = geometry::on_edge(&block.corners, anchor.edge, anchor.at);
        // From the face to the middle of the film, against the normal on side `b`.
        let place = face - joint.normal * (sign * contact.film.map_or(0.0, |film| film.half));
        let modes = body.modes.at(place).map(|mode| cleared(mode.dot(&direction), 1.0));
        let entries = match (&block.mesh, body.stiffness) {
            (Some(mesh), Some(_)) => {
                let of_block = terms.iter().filter(|term| term.anchor.block == anchor.block);
                of_block.flat_map(|it| entries(mesh, it.anchor, row.direction.part(it))).collect()
            }
            _ => Vec::new(),
        };
        body.rows.push(BodyRow { row: k, entries, modes });
    }
}

/// Returns the points whose displacements describe the motion of a block: the nodes of its mesh, or the corners of a
/// rigid block.
pub fn displaced_nodes(model: &Model, block: BlockId) -> &[Point2<f64>] {
    let block = &model.blocks[block.index()];
    match (&block.mesh, block.elasticity) {
        (Some(mesh), Some(_)) => &mesh.nodes,
        _ => &block.corners,
    }
}
