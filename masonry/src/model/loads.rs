//! Loads on blocks: the resultant of each load, and its nodal forces on a mesh.

use nalgebra::{Point2, Vector2};

use crate::geometry;
use crate::ids::LoadId;
use crate::model::mesh::BlockMesh;

/// A force and a moment at a place of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedForce {
    /// The place at which the force acts \[m\].
    pub at: Point2<f64>,
    /// The force in global axes \[N\].
    pub force: Vector2<f64>,
    /// The moment about the place, counter-clockwise \[N m\].
    pub moment: f64,
}

impl PlacedForce {
    /// Makes a force without a moment.
    pub(super) fn new(at: Point2<f64>, force: Vector2<f64>) -> Self {
        Self { at, force, moment: 0.0 }
    }

    /// Returns the size \[N\] of the force, plus that of a couple of two forces at this distance \[m\] for the moment.
    pub fn size(&self, distance: f64) -> f64 {
        self.force.norm() + self.moment.abs() / distance
    }
}

/// A load of the scene: its name, group, factor and mass.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadCase {
    /// The name of the load.
    pub name: String,
    /// The group of the load; by default a group with the name of the load.
    pub group: String,
    /// The factor \[-\] of the load times the factor of the step; loads on blocks include it.
    pub factor: f64,
    /// The part of the load that is the weight of a mass, from 0 to 1; `None` if the scene does not give it.
    pub mass: Option<f64>,
}

/// A load on one block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BlockLoad {
    /// A traction on a part of an edge.
    Edge(EdgeLoad),
    /// A force or a moment at one place.
    Point(PointLoad),
}

/// A traction on a part of a block's edge, uniform or linear along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeLoad {
    /// The edge of the block, from 0.
    pub edge: usize,
    /// Start of the loaded part as a fraction of the edge from its first corner.
    pub from: f64,
    /// End of the loaded part as a fraction of the edge from its first corner.
    pub to: f64,
    /// Traction on the block at the start and at the end of the loaded part \[Pa\] in global axes.
    pub traction: [Vector2<f64>; 2],
    /// The load of the scene to which the traction belongs.
    pub load: LoadId,
}

/// A force and a moment at a place inside or on the edge of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLoad {
    /// The place at which force and moment act \[m\].
    pub at: Point2<f64>,
    /// The force on the block over its whole thickness \[N\] in global axes.
    pub force: Vector2<f64>,
    /// The moment on the block over its whole thickness, counter-clockwise \[N m\].
    pub moment: f64,
    /// The load of the scene to which the force belongs.
    pub load: LoadId,
}

/// An acceleration that acts on all mass, as gravity does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Acceleration {
    /// The acceleration \[m/s^2\]; the force on a mass is the mass times this acceleration.
    pub value: Vector2<f64>,
    /// The load of the scene to which the acceleration belongs.
    pub load: LoadId,
}

impl BlockLoad {
    /// Returns the load of the scene to which this load belongs.
    pub fn load(&self) -> LoadId {
        match self {
            Self::Edge(edge) => edge.load,
            Self::Point(point) => point.load,
        }
    }

    /// Returns whether any part of the load has a component against a direction.
    pub(super) fn acts_against(&self, direction: Vector2<f64>) -> bool {
        let is_against = |force: Vector2<f64>| force.dot(&direction) < 0.0;
        match self {
            Self::Edge(load) => load.traction.into_iter().any(is_against),
            Self::Point(load) => is_against(load.force),
        }
    }

    /// Makes the load `load` of the scene at the place of this one. Its force or traction is computed by `of` from
    /// that of this one; it has no moment.
    pub(super) fn instead(&self, load: LoadId, of: impl Fn(Vector2<f64>) -> Vector2<f64>) -> Self {
        match *self {
            Self::Edge(it) => Self::Edge(EdgeLoad { traction: it.traction.map(of), load, ..it }),
            Self::Point(it) => {
                Self::Point(PointLoad { force: of(it.force), moment: 0.0, load, ..it })
            }
        }
    }

    /// Returns the resultant of the load on a block with these corners in a wall of this thickness \[m\].
    pub fn resultant(&self, corners: &[Point2<f64>], thickness: f64) -> PlacedForce {
        match self {
            Self::Edge(load) => load.resultant(corners, thickness),
            Self::Point(PointLoad { at, force, moment, .. }) => {
                PlacedForce { at: *at, force: *force, moment: *moment }
            }
        }
    }

    /// Returns the nodal forces \[N\] that do the same work as the load in all displacements of the mesh; a node may
    /// occur twice.
    pub fn nodal_forces(
        &self,
        corners: &[Point2<f64>],
        mesh: &BlockMesh,
        thickness: f64,
    ) -> Vec<(usize, Vector2<f64>)> {
        match self {
            Self::Edge(load) => {
                let [start, end] = geometry::edge(corners, load.edge);
                let area = (end - start).norm() * thickness;
                load.on_nodes(mesh).into_iter().map(|(node, force)| (node, force * area)).collect()
            }
            Self::Point(load) => load.on_nodes(mesh),
        }
    }

    /// Multiplies the load by a factor \[-\].
    pub fn scale(&mut self, factor: f64) {
        match self {
            Self::Edge(load) => load.traction.iter_mut().for_each(|it| *it *= factor),
            Self::Point(load) => {
                load.force *= factor;
                load.moment *= factor;
            }
        }
    }
}

impl EdgeLoad {
    /// Returns the traction \[Pa\] at a fraction of the edge.
    fn traction_at(&self, at: f64) -> Vector2<f64> {
        let [first, last] = self.traction;
        first + (last - first) * ((at - self.from) / (self.to - self.from))
    }

    /// Returns the resultant of the traction. If the traction has one direction, it acts at the centroid of the
    /// traction. Otherwise it acts in the middle of the loaded part, with the moment of the change of the traction
    /// along the part.
    fn resultant(&self, corners: &[Point2<f64>], thickness: f64) -> PlacedForce {
        let [start, end] = [self.from, self.to].map(|at| geometry::on_edge(corners, self.edge, at));
        let (along, [first, last]) = (end - start, self.traction);
        let area = along.norm() * thickness;
        let force = (first + last) * (0.5 * area);
        // The lengths add up only in one direction.
        let (length, sum) = ((first + last).norm(), first.norm() + last.norm());
        if first != last && length >= sum * (1.0 - f64::EPSILON) {
            let at = start + along * ((first.norm() + 2.0 * last.norm()) / (3.0 * sum));
            return PlacedForce { at, force, moment: 0.0 };
        }
        PlacedForce {
            at: nalgebra::center(&start, &end),
            force,
            moment: geometry::cross(along, last - first) * (area / 12.0),
        }
    }

    /// Integrates the traction times the shape functions over the loaded part, in fractions of the edge \[Pa\].
    fn on_nodes(&self, mesh: &BlockMesh) -> Vec<(usize, Vector2<f64>)> {
        let fractions = mesh.edge_fractions(self.edge);
        let parts = fractions.windows(2).filter_map(|part| {
            let (from, to) = (part[0].max(self.from), part[1].min(self.to));
            (from < to).then_some([from, to])
        });
        // Traction and shape function are linear on each part, and Simpson's rule is exact for their product.
        let on_part = |[from, to]: [f64; 2]| {
            let weighted = [(from, 1.0), (0.5 * (from + to), 4.0), (to, 1.0)];
            weighted.into_iter().flat_map(move |(at, weight)| {
                let force = self.traction_at(at) * (weight * (to - from) / 6.0);
                mesh.interpolate(self.edge, at).map(|(node, n)| (node, force * n))
            })
        };
        parts.flat_map(on_part).collect()
    }
}

impl PointLoad {
    /// Returns the nodal forces of force and moment. The moment does work on the mean rotation of the material at its
    /// place, `(dv/dx - du/dy) / 2`.
    fn on_nodes(&self, mesh: &BlockMesh) -> Vec<(usize, Vector2<f64>)> {
        let mut forces = mesh.interpolate_inside(self.at).map(|(node, n)| (node, self.force * n));
        if self.moment.abs() > 0.0 {
            for (it, (_, gradient)) in forces.iter_mut().zip(mesh.gradients_inside(self.at)) {
                it.1 += Vector2::new(-gradient.y, gradient.x) * (0.5 * self.moment);
            }
        }
        forces.to_vec()
    }
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
