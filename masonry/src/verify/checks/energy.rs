//! The balance between the work of the loads and the stored and dissipated energy; and the change of the shape of
//! rigid blocks.

use nalgebra::Vector2;

use super::contact::Pair;
use super::{larger, relative};
use crate::data::state::State;
use crate::model::{Model, PlacedBlock, PlacedForce};
use crate::recover;
use crate::system::nodal_loads;
use crate::system::rigid::Modes;

/// Returns the error of `f.u + t.y = 2 U + t.x`, plus the work of friction if it is positive, relative to the sizes of
/// all terms \[-\].
pub(super) fn error(model: &Model, state: &State, pairs: &[Pair]) -> f64 {
    let (mut work, mut size) = (0.0, 0.0);
    for (block, u) in model.blocks.iter().zip(&state.displacements) {
        for [force, u] in loads(model, block, u) {
            work += force.dot(&u);
            size += force.norm() * u.norm();
        }
    }
    // The work of contact forces on both sides cancels, except for its rounding errors.
    for (contact, it) in model.contacts.iter().zip(&state.contacts) {
        let sides = [Some(contact.b), contact.a].into_iter().flatten();
        let moved: f64 = sides
            .map(|anchor| recover::displacement_at(model, &state.displacements, anchor).norm())
            .sum();
        size += it.t_n.hypot(it.t_t) * moved;
    }
    let (mut rest, mut dissipated) = (work - 2.0 * state.strain_energy, 0.0);
    size += 2.0 * state.strain_energy.abs();
    for Pair { gap, slip, t_n, t_t, initial: [gap_0, slip_0], .. } in pairs {
        let terms = [t_n * gap, t_t * slip, -t_n * gap_0, -t_t * slip_0];
        rest += terms.iter().sum::<f64>();
        size += terms.iter().map(|term| term.abs()).sum::<f64>();
        dissipated -= t_t * slip;
    }
    larger(relative(rest.abs(), size), relative(-dissipated, size))
}

/// Returns the loads of a block, each with its displacement: at the nodes, or at their places if the block is rigid. A
/// moment on a rigid block becomes a force at the distance of the farthest corner.
fn loads(model: &Model, block: &PlacedBlock, u: &[Vector2<f64>]) -> Vec<[Vector2<f64>; 2]> {
    if let Some(mesh) = &block.mesh {
        let loads = nodal_loads(model, block, mesh);
        return loads.chunks(2).zip(u).map(|(f, u)| [Vector2::new(f[0], f[1]), *u]).collect();
    }
    let modes = Modes::of(&block.corners);
    let motion = modes.amplitudes(&block.corners, u);
    let of_load = |load: &PlacedForce| {
        let turned = [load.moment / modes.length, motion[2]].map(|it| Vector2::new(it, 0.0));
        [[load.force, modes.displacement(load.at, &motion)], turned]
    };
    model.forces_on(block).iter().flat_map(of_load).collect()
}

/// Returns the largest change of the shape of a rigid block, relative to its largest displacement \[-\].
pub(super) fn deformation(model: &Model, state: &State) -> f64 {
    let blocks = model.blocks.iter().zip(&state.displacements);
    let rigid = blocks.filter(|(block, _)| block.mesh.is_none());
    let of_block = |(block, u): (&PlacedBlock, &Vec<Vector2<f64>>)| {
        let (_, off) = Modes::of(&block.corners).nearest(&block.corners, u);
        relative(off, u.iter().map(Vector2::norm).fold(0.0, larger))
    };
    rigid.map(of_block).fold(0.0, larger)
}
