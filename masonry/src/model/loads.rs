//! Loads on blocks by kind: the resultant of each load and its nodal forces on a mesh.

use nalgebra::{Point2, Vector2};

use crate::geometry;
use crate::ids::LoadId;
use crate::model::mesh::BlockMesh;

/// A force \[N\] and the place at which it acts \[m\].
pub type PlacedForce = (Point2<f64>, Vector2<f64>);

/// A load of the scene: its name and its factor.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadCase {
    /// Its name.
    pub name: String,
    /// Its group; if the scene gives none, a group of its own with its own name.
    pub group: String,
    /// Its factor \[-\], times that of the step; loads on blocks include it.
    pub factor: f64,
    /// The part of the load that is the weight of a mass, from 0 to 1; `None` if the scene does not say.
    pub mass: Option<f64>,
}

/// A load on one block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BlockLoad {
    /// A traction on a part of an edge.
    Edge(EdgeLoad),
    /// A force at one place.
    Point(PointLoad),
}

/// A uniform traction on a part of a block's edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeLoad {
    /// The edge, from 0.
    pub edge: usize,
    /// Start of the loaded part as a fraction of the edge, from its first corner.
    pub from: f64,
    /// End of the loaded part as a fraction of the edge.
    pub to: f64,
    /// Traction on the block \[Pa\] in global axes.
    pub traction: Vector2<f64>,
    /// The load of the scene that it is a part of.
    pub load: LoadId,
}

/// A force at a place inside or on the edge of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLoad {
    /// The place \[m\].
    pub at: Point2<f64>,
    /// The force on the block over its whole thickness \[N\] in global axes.
    pub force: Vector2<f64>,
    /// The load of the scene that it is.
    pub load: LoadId,
}

/// An acceleration that acts like gravity on all that has mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Acceleration {
    /// The acceleration \[m/s^2\]: the force on a mass is the mass times this.
    pub value: Vector2<f64>,
    /// The load of the scene that it is.
    pub load: LoadId,
}

impl BlockLoad {
    /// The load of the scene that it is a part of.
    pub fn load(&self) -> LoadId {
        match self {
            Self::Edge(edge) => edge.load,
            Self::Point(point) => point.load,
        }
    }

    /// The traction \[Pa\] of a load on an edge, or the force \[N\] at a place.
    pub(super) fn force_or_traction(&self) -> Vector2<f64> {
        match self {
            Self::Edge(load) => load.traction,
            Self::Point(load) => load.force,
        }
    }

    /// A part of another load in this place, with another force or traction.
    pub(super) fn instead(&self, load: LoadId, of: impl Fn(Vector2<f64>) -> Vector2<f64>) -> Self {
        match *self {
            Self::Edge(it) => Self::Edge(EdgeLoad { traction: of(it.traction), load, ..it }),
            Self::Point(it) => Self::Point(PointLoad { force: of(it.force), load, ..it }),
        }
    }

    /// Its resultant on a block with these corners in a wall of a thickness \[m\].
    pub fn resultant(&self, corners: &[Point2<f64>], thickness: f64) -> PlacedForce {
        match self {
            Self::Edge(load) => {
                let [start, end] = geometry::edge(corners, load.edge);
                let loaded = (load.to - load.from) * (end - start).norm() * thickness;
                let middle = geometry::on_edge(corners, load.edge, 0.5 * (load.from + load.to));
                (middle, load.traction * loaded)
            }
            Self::Point(load) => (load.at, load.force),
        }
    }

    /// The forces \[N\] at nodes that do the same work on all displacements of the mesh; a node may come twice.
    pub fn nodal_forces(
        &self,
        corners: &[Point2<f64>],
        mesh: &BlockMesh,
        thickness: f64,
    ) -> Vec<(usize, Vector2<f64>)> {
        let (shares, force) = match self {
            Self::Edge(load) => {
                let [start, end] = geometry::edge(corners, load.edge);
                (edge_shares(mesh, load), load.traction * ((end - start).norm() * thickness))
            }
            Self::Point(load) => {
                (mesh.interpolate_inside(mesh.reference(load.at)).to_vec(), load.force)
            }
        };
        shares.into_iter().map(|(node, share)| (node, force * share)).collect()
    }

    /// Multiplies it.
    pub fn scale(&mut self, factor: f64) {
        match self {
            Self::Edge(load) => load.traction *= factor,
            Self::Point(load) => load.force *= factor,
        }
    }
}

/// Integrals of the shape functions over the loaded part of the edge, as fractions of the edge.
fn edge_shares(mesh: &BlockMesh, load: &EdgeLoad) -> Vec<(usize, f64)> {
    let fractions = mesh.edge_fractions(load.edge);
    let parts = fractions.windows(2).filter_map(|part| {
        let (from, to) = (part[0].max(load.from), part[1].min(load.to));
        (from < to).then_some((from, to))
    });
    // A shape function is linear on each part: its value in the middle times the length is exact.
    parts
        .flat_map(|(from, to)| {
            let nodes = mesh.interpolate(load.edge, 0.5 * (from + to));
            nodes.map(|(node, n)| (node, n * (to - from)))
        })
        .collect()
}

impl From<EdgeLoad> for BlockLoad {
    fn from(load: EdgeLoad) -> Self {
        Self::Edge(load)
    }
}

impl From<PointLoad> for BlockLoad {
    fn from(load: PointLoad) -> Self {
        Self::Point(load)
    }
}
