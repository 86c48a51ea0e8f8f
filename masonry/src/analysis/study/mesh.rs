//! Finer meshes of a scene, and the changes of the results between meshes.

use nalgebra::Vector2;
use serde::Serialize;

use super::figures::{Figures, relative};
use super::reference::{self, FoundReference, Reference};
use super::runs::Runner;
use crate::data::state::State;
use crate::model::{Body, Model, PlacedBlock};
use crate::recover;
use crate::scene::Scene;

/// A mesh of a study, with its reference and its errors.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mesh {
    /// The refinement factor: the numbers of elements in the scene are multiplied by it in every direction.
    pub factor: u32,
    /// The name of the mesh in reports.
    pub name: String,
    /// Number of blocks.
    pub blocks: usize,
    /// Number of elements.
    pub elements: usize,
    /// Number of contact points.
    pub contact_points: usize,
    /// The reason for which the mesh cannot be made: too many elements, for example; `None` if it was made.
    pub refusal: Option<String>,
    /// The most accurate solution on the mesh; `None` if no route found one within the time limit.
    pub reference: Option<Reference>,
    /// The values of the reference that are compared between meshes; `None` without a reference.
    pub values: Option<Values>,
    /// Errors of the mesh: distances of its values from those of the finest mesh with a reference. `None` for that mesh
    /// itself, and without a reference.
    pub errors: Option<MeshErrors>,
    /// Displacements \[m\] of the corners of every block; `None` for blocks that carry no load.
    #[serde(skip)]
    corners: Vec<Option<Vec<Vector2<f64>>>>,
}

/// Values of a solution that can be compared between meshes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Values {
    /// Strain energy \[J\].
    pub strain_energy: f64,
    /// Horizontal force \[N\] on the structure from all supports left of its middle.
    pub thrust: f64,
    /// Displacement \[m\] of one corner on this mesh: the corner of a loaded block that moves most on the finest mesh.
    pub displacement: [f64; 2],
}

/// Errors of the values on a mesh, relative to those on the finest mesh \[-\]; an error is `None` if the values cannot
/// be compared.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeshErrors {
    /// Error of the strain energy.
    pub energy: Option<f64>,
    /// Error of the thrust.
    pub thrust: Option<f64>,
    /// Error of the displacement: the length of the difference vector.
    pub displacement: Option<f64>,
}

impl MeshErrors {
    /// Returns the largest of the errors. A single error may be as small as that of a finer mesh by accident.
    pub fn worst(&self) -> Option<f64> {
        [self.energy, self.thrust, self.displacement].into_iter().flatten().reduce(f64::max)
    }
}

/// A thrust is only rounding error if it is below this part of the sum of all forces of the supports.
const NO_THRUST: f64 = 1e-9;

/// Returns the scene with `factor` times as many elements in every direction.
pub fn refined(scene: &Scene, factor: u32) -> Scene {
    let mut scene = scene.clone();
    let meshes = scene.walls.iter_mut().map(|wall| &mut wall.mesh);
    let meshes = meshes.chain(scene.blocks.iter_mut().map(|block| &mut block.mesh));
    let meshes = meshes.chain(scene.arches.iter_mut().map(|arch| &mut arch.mesh));
    for mesh in meshes.flatten() {
        *mesh = mesh.map(|elements| elements.saturating_mul(factor));
    }
    scene
}

/// Finds the reference on a mesh, and returns the mesh, not yet compared with others, with the figures of the
/// reference.
pub(super) fn studied(scene: &Scene, factor: u32, runner: &mut Runner) -> (Mesh, Option<Figures>) {
    let mut mesh = Mesh {
        factor,
        name: runner.mesh_name(factor),
        blocks: 0,
        elements: 0,
        contact_points: 0,
        refusal: None,
        reference: None,
        values: None,
        errors: None,
        corners: Vec::new(),
    };
    match Model::from_scene(scene) {
        Ok(model) => {
            mesh.blocks = model.blocks.len();
            let meshes = model.blocks.iter().filter_map(|block| block.mesh.as_ref());
            mesh.elements = meshes.map(|mesh| mesh.elements.len()).sum();
            mesh.contact_points = model.contacts.len();
        }
        Err(error) => {
            mesh.refusal = Some(error.to_string());
            return (mesh, None);
        }
    }
    let Some(FoundReference { reference, outcome, figures, exact }) =
        reference::find(scene, factor, runner)
    else {
        return (mesh, None);
    };
    let state = exact.as_ref().map(|it| &it.state).or(outcome.state.as_ref());
    let Some(state) = state else { return (mesh, None) };
    mesh.reference = Some(reference);
    mesh.values = Some(Values {
        strain_energy: state.strain_energy,
        thrust: thrust(&outcome.model, state),
        displacement: [0.0; 2],
    });
    mesh.corners = corners(&outcome.model, state, &figures);
    (mesh, Some(figures))
}

/// Adds displacements and errors to all meshes, by comparison with the finest mesh that has values.
pub(super) fn compared(mut meshes: Vec<Mesh>) -> Vec<Mesh> {
    let with_values = meshes.iter().filter(|mesh| mesh.values.is_some());
    let Some(finest) = with_values.max_by_key(|mesh| mesh.factor).cloned() else { return meshes };
    let place = most_moved(&finest.corners);
    let moved = |mesh: &Mesh| {
        let (block, corner) = place?;
        mesh.corners.get(block)?.as_ref().map(|corners| corners[corner])
    };
    let expected = moved(&finest);
    for mesh in &mut meshes {
        let displacement = moved(mesh);
        let Some(values) = &mut mesh.values else { continue };
        values.displacement = displacement.map_or([0.0; 2], Into::into);
        let (values, Some(exact)) = (*values, finest.values) else { continue };
        if mesh.factor == finest.factor {
            continue;
        }
        mesh.errors = Some(MeshErrors {
            energy: relative(&[values.strain_energy], &[exact.strain_energy]),
            thrust: relative(&[values.thrust], &[exact.thrust]),
            displacement: displacement
                .zip(expected)
                .map(|(found, it)| (found - it).norm() / it.norm())
                .filter(|error| error.is_finite()),
        });
    }
    meshes
}

/// Computes the horizontal force \[N\] on the structure from the supports left of its middle; zero if there are only
/// rounding errors.
fn thrust(model: &Model, state: &State) -> f64 {
    let corners = || model.blocks.iter().flat_map(|block| block.corners.iter().map(|it| it.x));
    let (low, high) = (corners().fold(f64::MAX, f64::min), corners().fold(f64::MIN, f64::max));
    let middle = 0.5 * (low + high);
    let (mut thrust, mut all) = (0.0, 0.0);
    for (contact, found) in model.contacts.iter().zip(&state.contacts) {
        if let Body::Support(_) = model.joints[contact.joint.index()].a {
            let force = recover::contact_force(model, contact, found);
            all += force.norm();
            if contact.position.x < middle {
                thrust += force.x;
            }
        }
    }
    if thrust.abs() > NO_THRUST * all { thrust } else { 0.0 }
}

fn corners(model: &Model, state: &State, figures: &Figures) -> Vec<Option<Vec<Vector2<f64>>>> {
    let of_block = |(block, moves): (&PlacedBlock, &Vec<Vector2<f64>>)| match &block.mesh {
        Some(mesh) => mesh.corner_nodes().map(|node| moves[node]).collect(),
        None => moves.clone(),
    };
    let corners = model.blocks.iter().zip(&state.displacements).map(of_block);
    let loaded = figures.loaded_blocks();
    corners.zip(loaded).map(|(corners, is_loaded)| is_loaded.then_some(corners)).collect()
}

/// Finds the block and the corner with the largest displacement; `None` if no block carries load.
fn most_moved(corners: &[Option<Vec<Vector2<f64>>>]) -> Option<(usize, usize)> {
    let places =
        corners.iter().enumerate().filter_map(|(block, corners)| Some((block, corners.as_ref()?)));
    let all = places.flat_map(|(block, corners)| {
        corners.iter().enumerate().map(move |(corner, u)| ((block, corner), u.norm()))
    });
    all.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(place, _)| place)
}
