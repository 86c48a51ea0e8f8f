//! Recovery of the state of a structure from contact forces and relative displacements.

use std::borrow::Cow;

use nalgebra::{SVector, Vector2};

use crate::data::state::{
    ElementStress, FilmStress, PointState, PointStatus, Principal, Reaction, RowState, State,
};
use crate::element::quad4;
use crate::forms::Sparse;
use crate::forms::reduction::Reduction;
use crate::ids::{BlockId, ContactId};
use crate::material::constitutive;
use crate::model::{Anchor, Body, JointPoint, Model};
use crate::system::kinematics::shares;
use crate::system::{Direction, System, displaced_nodes};

/// Threshold of zero \[-\]: gaps and slips below this part of the largest displacement, or compression of a joint,
/// count as zero, and rates of gaps and slips below this part of the largest rate.
const STILL: f64 = 1e-8;

/// Threshold of rest \[-\]: motions of rigid blocks below this fraction of their size, or below the tolerance, count
/// as rest.
const REST: f64 = 1e-9;

mod motion;

pub use motion::mechanism;
pub(crate) use motion::{flow, largest, of_corners};

/// Computes the state of the structure from `rows`, the contact forces and relative displacements of all contact rows.
/// Rigid amplitudes `alpha` follow from the isostatic rows, then displacements `u = K^+ (f + C^T t + L^T q) + N alpha`
/// block by block.
///
/// Stresses are recovered only if `with_stresses` is true.
pub fn recover(
    model: &Model,
    system: &System,
    reduction: &Reduction,
    rows: &RowState,
    with_stresses: bool,
) -> State {
    let amplitudes = reduction.amplitudes(&rows.t, &rows.y);
    let bar_forces = reduction.bar_forces(&rows.t);
    let motions = system.bodies.iter().zip(amplitudes.chunks(3)).map(|(body, alpha)| BlockMotion {
        rigid: alpha,
        elastic: Cow::Owned(system.elastic_displacements(body, &rows.t, &bar_forces)),
    });
    of_motions(model, system, rows, motions, with_stresses)
}

/// Computes the state of the structure from forces and displacements of the sparse problem, which was solved to
/// `tolerance`.
///
/// Displacements have no natural size if all blocks are rigid, nothing has an initial gap and no joint has a
/// compliance. In this case displacements within rounding errors count as zero.
pub fn from_displacements(
    model: &Model,
    system: &System,
    sparse: &Sparse,
    rows: &RowState,
    u: &[f64],
    tolerance: f64,
    with_stresses: bool,
) -> State {
    let rest = vec![0.0; u.len()];
    let at_rest = RowState { t: rows.t.clone(), y: vec![0.0; rows.y.len()] };
    let (u, rows) = if is_at_rest(system, u, tolerance) { (&*rest, &at_rest) } else { (u, rows) };
    let motions = system.bodies.iter().enumerate().map(|(b, body)| {
        let (u, none): (_, &[f64]) = (sparse.of_block(b, u), &[]);
        let (rigid, elastic) = if body.stiffness.is_some() { (none, u) } else { (u, none) };
        BlockMotion { rigid, elastic: Cow::Borrowed(elastic) }
    });
    of_motions(model, system, rows, motions, with_stresses)
}

fn is_at_rest(system: &System, u: &[f64], tolerance: f64) -> bool {
    let size = system.bodies.iter().map(|body| body.modes.length).fold(0.0, f64::max);
    let rest = tolerance.max(REST) * size;
    system.is_at_rest() && u.iter().all(|u| u.abs() <= rest)
}

/// The motion of a block: its rigid motion plus its deformation.
struct BlockMotion<'a> {
    /// Amplitudes \[m\] of the rigid motions of the block; empty if all are zero.
    rigid: &'a [f64],
    /// Displacements \[m\] of the nodes due to deformation; empty for a rigid block.
    elastic: Cow<'a, [f64]>,
}

fn of_motions<'a>(
    model: &Model,
    system: &System,
    rows: &RowState,
    motions: impl Iterator<Item = BlockMotion<'a>>,
    with_stresses: bool,
) -> State {
    let mut strain_energy = 0.0;
    let mut displacements = Vec::with_capacity(model.blocks.len());
    for (b, (body, BlockMotion { rigid, elastic })) in system.bodies.iter().zip(motions).enumerate()
    {
        strain_energy += body.stiffness.map_or(0.0, |k| system.stiffnesses[k].energy(&elastic));
        let nodes = displaced_nodes(model, BlockId::new(b)).iter().enumerate();
        let moved = nodes.map(|(n, place)| {
            let rigid = body.modes.displacement(*place, rigid);
            elastic.get(2 * n..2 * n + 2).map_or(rigid, |u| rigid + Vector2::new(u[0], u[1]))
        });
        displacements.push(moved.collect());
    }
    let contacts = contact_states(model, system, rows, &displacements);
    strain_energy += joints_energy(model, system, &contacts, &displacements);
    let (stresses, films) = wanted_stresses(model, &displacements, &contacts, with_stresses);
    State { displacements, contacts, films, stresses, strain_energy }
}

/// Computes the stresses of blocks and films; returns empty lists if `wanted` is false.
pub(crate) fn wanted_stresses(
    model: &Model,
    displacements: &[Vec<Vector2<f64>>],
    contacts: &[PointState],
    wanted: bool,
) -> (Vec<ElementStress>, Vec<FilmStress>) {
    if wanted {
        (stresses(model, displacements), film_stresses(model, displacements, contacts))
    } else {
        (Vec::new(), Vec::new())
    }
}

/// Computes the energy of all joints and films \[J\]: the energy of compression and shear, and of the elongation of
/// strips.
fn joints_energy(
    model: &Model,
    system: &System,
    contacts: &[PointState],
    displacements: &[Vec<Vector2<f64>>],
) -> f64 {
    let across = system.rows.iter().map(|row| {
        let PointState { t_n, t_t, .. } = contacts[row.contact.index()];
        let force = if row.direction == Direction::Normal { t_n } else { t_t };
        0.5 * row.compliance * force * force
    });
    let along = system.stretches.iter().map(|stretch| {
        let contact = &model.contacts[stretch.contact.index()];
        let elongation = film_elongation(model, displacements, contact);
        0.5 * stretch.stiffness * elongation * elongation
    });
    across.sum::<f64>() + along.sum::<f64>()
}

/// Computes the stresses at the contact points of all films, in the order of the points.
pub fn film_stresses(
    model: &Model,
    displacements: &[Vec<Vector2<f64>>],
    contacts: &[PointState],
) -> Vec<FilmStress> {
    let points = model.contacts.iter().zip(contacts).enumerate();
    let of_point = |(k, (point, state)): (usize, (&JointPoint, &PointState))| {
        let film = model.joints[point.joint.index()].film?;
        let part = point.film?;
        // Adding zero turns a stress of -0.0 into 0.0.
        let [sigma_y, tau] = [state.t_n, state.t_t].map(|force| 0.0 - force / point.weight);
        let sigma_x = part.stretch.map(|stretch| {
            let bar = stretch.stiffness * film_elongation(model, displacements, point);
            bar / (2.0 * part.half * model.thickness) + stretch.coupling * sigma_y
        });
        Some(FilmStress { film: film.id, contact: ContactId::new(k), sigma_x, sigma_y, tau })
    };
    points.filter_map(of_point).collect()
}

/// Returns the displacement \[m\] of a place on the edge of a block; `displacements` are those of [`State`].
pub fn displacement_at(
    model: &Model,
    displacements: &[Vec<Vector2<f64>>],
    anchor: Anchor,
) -> Vector2<f64> {
    let u = &displacements[anchor.block.index()];
    let shares = shares(&model.blocks[anchor.block.index()], anchor);
    shares.iter().map(|(node, part)| u[*node] * *part).sum()
}

/// Returns the relative displacement `u_b - u_a` \[m\] at a contact point. Across a film it is the value in the middle
/// between the faces, which moves with the faces and their mean rotations; it includes the gap that the elongation of
/// a strip causes.
///
/// The function does not use the terms of the rows of the problem, so that the checks find errors in these terms.
pub fn relative_displacement(
    model: &Model,
    displacements: &[Vec<Vector2<f64>>],
    contact: &JointPoint,
) -> Vector2<f64> {
    let side = |anchor| displacement_at(model, displacements, anchor);
    let apart = side(contact.b) - contact.a.map_or_else(Vector2::zeros, side);
    let Some(film) = &contact.film else { return apart };
    let joint = &model.joints[contact.joint.index()];
    let turned = |[start, end]: [Anchor; 2]| (side(end) - side(start)).dot(&joint.normal);
    let turned = turned(film.b) + film.a.map_or(0.0, turned);
    let opened = film.gap_per_elongation() * film_elongation(model, displacements, contact);
    apart + joint.tangent() * (turned * film.half / film.length) + joint.normal * opened
}

/// Returns the elongation \[m\] of the part of a film that a contact point stands for: the mean of the elongations of
/// its two faces. Faces on supports and rigid blocks do not stretch. Zero in a dry joint.
pub fn film_elongation(
    model: &Model,
    displacements: &[Vec<Vector2<f64>>],
    contact: &JointPoint,
) -> f64 {
    let Some(film) = &contact.film else { return 0.0 };
    let tangent = model.joints[contact.joint.index()].tangent();
    let is_elastic = |face: &[Anchor; 2]| model.blocks[face[0].block.index()].elasticity.is_some();
    let of_face = |[start, end]: [Anchor; 2]| {
        let [start, end] = [start, end].map(|end| displacement_at(model, displacements, end));
        0.5 * (end - start).dot(&tangent)
    };
    film.faces().into_iter().flatten().filter(is_elastic).map(of_face).sum()
}

fn contact_states(
    model: &Model,
    system: &System,
    rows: &RowState,
    displacements: &[Vec<Vector2<f64>>],
) -> Vec<PointState> {
    let points = system.points();
    let mut states: Vec<PointState> = model
        .contacts
        .iter()
        .enumerate()
        .map(|(k, contact)| {
            // The slip is overwritten below if there is a tangential row.
            let tangent = model.joints[contact.joint.index()].tangent();
            let y_t =
                relative_displacement(model, displacements, contact).dot(&tangent) + contact.slip;
            let (t_n, y_n) = (rows.t[k] - system.rows[k].tension, rows.y[k]);
            PointState { t_n, t_t: 0.0, y_n, y_t, status: PointStatus::Open }
        })
        .collect();
    for (k, friction) in system.friction.iter().enumerate() {
        let state = &mut states[friction.contact.index()];
        (state.t_t, state.y_t) = (rows.t[points + k], rows.y[points + k]);
    }
    let relative = states.iter().map(|s| s.y_n.abs().max(s.y_t.abs())).fold(0.0, f64::max);
    let absolute = displacements.iter().flatten().map(nalgebra::Matrix::amax).fold(0.0, f64::max);
    // Joints may be compressed although no block moves and none is deformed.
    let pressed = system.rows.iter().zip(&rows.t).map(|(row, t)| row.compliance * t.abs());
    let zero = STILL * pressed.fold(relative.max(absolute), f64::max);
    for state in &mut states {
        state.status = status(state, zero);
    }
    states
}

/// Returns the status of a contact point by its gap and slip, which are unique even if contact forces are not: forces
/// may circulate between the points around a corner without any effect.
fn status(state: &PointState, zero: f64) -> PointStatus {
    if state.y_n > zero {
        PointStatus::Open
    } else if state.y_t.abs() > zero {
        PointStatus::Slip
    } else {
        PointStatus::Stick
    }
}

/// Computes the stresses at the centres of all elements, block by block.
pub fn stresses(model: &Model, displacements: &[Vec<Vector2<f64>>]) -> Vec<ElementStress> {
    let mut list = Vec::new();
    for (b, (block, u)) in model.blocks.iter().zip(displacements).enumerate() {
        let (Some(mesh), Some(elasticity)) = (&block.mesh, block.elasticity) else { continue };
        let d = constitutive(elasticity, model.plane);
        for (k, element) in mesh.elements.iter().enumerate() {
            let nodes = element.map(|n| mesh.nodes[n]);
            let local = SVector::<f64, 8>::from_fn(|i, _| u[element[i / 2]][i % 2]);
            // Folded elements were refused when the stiffness was built.
            let Some(stress) = quad4::stress_at_centre(&nodes, &d, &local) else { continue };
            let sigma: [f64; 3] = stress.into();
            list.push(ElementStress {
                block: BlockId::new(b),
                element: k,
                centre: quad4::centre(&nodes),
                sigma,
                principal: Principal::of(sigma),
            });
        }
    }
    list
}

impl Principal {
    /// Computes the principal stresses of `sigma_x, sigma_y, tau_xy` and their angle.
    ///
    /// ```
    /// use masonry::analysis::outcome::Principal;
    /// let p = Principal::of([-2.0, -10.0, 3.0]);
    /// assert_eq!((p.sigma_1, p.sigma_2), (-1.0, -11.0));
    /// assert!((p.theta.to_degrees() - 18.4349488229).abs() < 1e-9);
    /// ```
    pub fn of([sigma_x, sigma_y, tau]: [f64; 3]) -> Self {
        let mean = 0.5 * (sigma_x + sigma_y);
        let half = 0.5 * (sigma_x - sigma_y);
        let radius = half.hypot(tau);
        // Adding zero turns a shear of -0.0 into 0.0, for which the angle is +90 degrees.
        let theta = 0.5 * (tau + 0.0).atan2(half);
        Self { sigma_1: mean + radius, sigma_2: mean - radius, theta }
    }
}

/// Returns the states of the contact points of blocks at rest from the forces \[N\] of all rows of the [`System`].
pub fn forces_at_rest(model: &Model, rows: &[f64]) -> Vec<PointState> {
    let (normals, mut tangents) =
        (&rows[..model.contacts.len()], rows[model.contacts.len()..].iter());
    let states = model.contacts.iter().zip(normals).map(|(contact, normal)| PointState {
        t_n: normal - contact.law.tension,
        t_t: if contact.law.resists_sliding() {
            tangents.next().copied().unwrap_or(0.0)
        } else {
            0.0
        },
        y_n: 0.0,
        y_t: 0.0,
        status: PointStatus::Stick,
    });
    states.collect()
}

/// Returns the force \[N\] that a contact point exerts on the block in front, in global axes.
pub fn contact_force(model: &Model, contact: &JointPoint, state: &PointState) -> Vector2<f64> {
    let joint = &model.joints[contact.joint.index()];
    joint.normal * state.t_n + joint.tangent() * state.t_t
}

/// Returns for every support the resultant of its contact forces on the structure, in the order of the model.
pub fn reactions(model: &Model, contacts: &[PointState]) -> Vec<Reaction> {
    let name = |support: &crate::model::PlacedSupport| support.name.clone();
    let mut list: Vec<Reaction> = model
        .supports
        .iter()
        .map(|support| Reaction { support: name(support), fx: 0.0, fy: 0.0, m: 0.0 })
        .collect();
    for (contact, state) in model.contacts.iter().zip(contacts) {
        let Body::Support(id) = model.joints[contact.joint.index()].a else { continue };
        let force = contact_force(model, contact, state);
        let reaction = &mut list[id.index()];
        reaction.fx += force.x;
        reaction.fy += force.y;
        reaction.m += contact.position.x * force.y - contact.position.y * force.x;
    }
    list
}
