//! Bricks and whole strips at the nodes of a model, by elements and changes of nodes: nothing of contact points.

#[path = "../../../masonry/tests/all/common/nodal_change.rs"]
mod nodal_change;

use super::{assert_close, state};
use masonry::analysis::outcome::Outcome;
use masonry::element::quad4;
use masonry::material::constitutive;
use masonry::model::{Body, Model, PlacedJoint};
use masonry::paper::film::law::FilmState;
use masonry::paper::film::pointwise::{FilmResponse, PointwiseFilm};
use masonry::paper::film::strip::Strip;
use masonry::paper::film::{Matrix8, Vector8};
use masonry::recover::contact_force;
use masonry::system::nodal_loads;
use nalgebra::{DMatrix, DVector, Point2, Vector2};
use nodal_change::{NodalChange, local_axes};

/// A part of a film between nodes of its faces, one after another along it.
pub struct Part {
    pub joint: usize,
    pub length: f64,
    /// Places of the nodes of both faces along the film, from the middle of the part.
    faces: [[f64; 2]; 2],
    /// First unknowns of the nodes; none on a support.
    nodes: [Option<usize>; 4],
    q: Matrix8,
}

/// Unknowns of all nodes, two each, block by block.
pub struct Nodes {
    starts: Vec<usize>,
    pub count: usize,
}

impl Nodes {
    pub fn of(model: &Model) -> Self {
        let mut starts = Vec::new();
        let mut count = 0;
        for block in &model.blocks {
            starts.push(count);
            count += 2 * block.mesh.as_ref().unwrap().nodes.len();
        }
        Self { starts, count }
    }

    /// The first unknown of a block.
    pub fn start(&self, block: usize) -> usize {
        self.starts[block]
    }

    /// Displacements or forces of all nodes in one vector.
    pub fn gathered(&self, values: &[Vec<Vector2<f64>>]) -> DVector<f64> {
        DVector::from_iterator(self.count, values.iter().flatten().flat_map(|u| [u.x, u.y]))
    }

    /// Consistent loads of all blocks.
    pub fn loads(&self, model: &Model) -> DVector<f64> {
        let of_block = |block: &masonry::model::PlacedBlock| {
            nodal_loads(model, block, block.mesh.as_ref().unwrap())
        };
        DVector::from_iterator(self.count, model.blocks.iter().flat_map(of_block))
    }

    /// The stiffness of all blocks, without films.
    pub fn stiffness(&self, model: &Model) -> DMatrix<f64> {
        let mut k = DMatrix::zeros(self.count, self.count);
        for (block, start) in model.blocks.iter().zip(&self.starts) {
            let mesh = block.mesh.as_ref().unwrap();
            let d = constitutive(block.elasticity.unwrap(), model.plane);
            for element in &mesh.elements {
                let nodes = element.map(|n| mesh.nodes[n]);
                let matrix = quad4::stiffness(&nodes, &d, model.thickness).unwrap();
                add(&mut k, &element.map(|n| Some(start + 2 * n)), &matrix);
            }
        }
        k
    }

    /// All parts of all films, joint by joint along the tangent.
    pub fn parts(&self, model: &Model) -> Vec<Part> {
        let filled = model.joints.iter().enumerate().filter(|(_, joint)| joint.film.is_some());
        filled.flat_map(|(k, joint)| self.parts_of(model, k, joint)).collect()
    }

    fn parts_of(&self, model: &Model, k: usize, joint: &PlacedJoint) -> Vec<Part> {
        let (tangent, length) = (joint.tangent(), joint.length());
        let [face_a, face_b] = joint.faces();
        let b = Some(self.on_line(model, joint.b.index(), face_b[0], joint));
        let a = match joint.a {
            Body::Block(id) => Some(self.on_line(model, id.index(), face_a[0], joint)),
            Body::Support(_) => None,
        };
        let mut ends: Vec<f64> = [&a, &b]
            .into_iter()
            .flatten()
            .flatten()
            .map(|(x, _)| *x)
            .filter(|x| *x > 1e-9 * length && *x < length * (1.0 - 1e-9))
            .chain([0.0, length])
            .collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|x, y| *x - *y < 1e-9 * length);
        let around = |nodes: &Option<Vec<(f64, usize)>>, middle: f64, half: f64| {
            let Some(nodes) = nodes else { return ([-half, half], [None; 2]) };
            let next = nodes.iter().position(|(x, _)| *x > middle).unwrap();
            let pair = [nodes[next - 1], nodes[next]];
            (pair.map(|(x, _)| x - middle), pair.map(|(_, node)| Some(node)))
        };
        let part = |ends: &[f64]| {
            let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
            let (on_a, nodes_a) = around(&a, middle, half);
            let (on_b, nodes_b) = around(&b, middle, half);
            Part {
                joint: k,
                length: 2.0 * half,
                faces: [on_a, on_b],
                nodes: [nodes_a[0], nodes_a[1], nodes_b[0], nodes_b[1]],
                q: local_axes(tangent),
            }
        };
        ends.windows(2).map(part).collect()
    }

    /// The nodes of a block on the line of a face: places from `origin` along the tangent, and unknowns.
    fn on_line(
        &self,
        model: &Model,
        block: usize,
        origin: Point2<f64>,
        joint: &PlacedJoint,
    ) -> Vec<(f64, usize)> {
        let nodes = &model.blocks[block].mesh.as_ref().unwrap().nodes;
        let near = nodes
            .iter()
            .enumerate()
            .filter(|(_, p)| (*p - origin).dot(&joint.normal).abs() < 1e-9 * joint.length());
        let mut found: Vec<_> = near
            .map(|(n, p)| ((p - origin).dot(&joint.tangent()), self.starts[block] + 2 * n))
            .collect();
        found.sort_by(|x, y| x.0.total_cmp(&y.0));
        found
    }
}

impl Part {
    fn change(&self) -> NodalChange {
        NodalChange::of_film(self.length, self.faces)
    }

    /// Adds the stiffness of the part, bonded along the whole of it.
    pub fn add_bonded(&self, model: &Model, k: &mut DMatrix<f64>) {
        let mortar = model.joints[self.joint].film.unwrap().mortar;
        let strip =
            Strip::new(self.length, mortar.thickness, model.thickness, &mortar.material).unwrap();
        let local = self.change().stiffness(&strip.stiffness(strip.ends()));
        add(k, &self.nodes, &(self.q.transpose() * local * self.q));
    }

    /// The answer of the part, with the law at its two Gauss points after slips \[m\], to displacements of all
    /// nodes; its forces are added to `forces`.
    pub fn respond(
        &self,
        model: &Model,
        before: &[f64],
        u: &DVector<f64>,
        forces: &mut DVector<f64>,
    ) -> FilmResponse {
        let joint = &model.joints[self.joint];
        let mortar = joint.film.unwrap().mortar;
        let strip =
            Strip::new(self.length, mortar.thickness, model.thickness, &mortar.material).unwrap();
        let film = PointwiseFilm::new(strip, model.joint_classes[joint.class].law.mu, 1).unwrap();
        let before: Vec<_> = before.iter().map(|slip| FilmState { slip: *slip }).collect();
        let at_nodes = Vector8::from_fn(|i, _| self.nodes[i / 2].map_or(0.0, |n| u[n + i % 2]));
        let ends = self.change().displacements(&(self.q * at_nodes));
        let answer = film.respond(&ends, &before);
        let back = self.q.transpose() * self.change().forces(&answer.force);
        for (i, force) in back.iter().enumerate() {
            if let Some(node) = self.nodes[i / 2] {
                forces[node + i % 2] += force;
            }
        }
        answer
    }
}

fn add(k: &mut DMatrix<f64>, nodes: &[Option<usize>; 4], matrix: &Matrix8) {
    let unknown = |i: usize| nodes[i / 2].map(|node| node + i % 2);
    for i in 0..8 {
        for j in 0..8 {
            if let Some((row, column)) = unknown(i).zip(unknown(j)) {
                k[(row, column)] += matrix[(i, j)];
            }
        }
    }
}

/// `f.u = 2 U + dissipation`, where nothing had a gap before.
pub fn assert_energy(outcome: &Outcome, tolerance: f64) {
    let state = state(outcome);
    let nodes = Nodes::of(&outcome.model);
    let work = nodes.loads(&outcome.model).dot(&nodes.gathered(&state.displacements));
    let dissipated: f64 = state.contacts.iter().map(|it| -it.t_t * it.y_t).sum();
    assert!(dissipated >= 0.0);
    assert_close(work, 2.0 * state.strain_energy + dissipated, tolerance);
}

/// Forces of bricks and films at all nodes less what loads and contacts of dry joints give, largest relative to
/// the loads; and the films' own answers, against stresses and status of the points.
pub fn assert_films_balance(outcome: &Outcome, tolerance: f64) {
    assert_films_balance_after(outcome, &vec![0.0; outcome.model.contacts.len()], tolerance);
}

/// The same after slips \[m\] at all contact points.
pub fn assert_films_balance_after(outcome: &Outcome, slips: &[f64], tolerance: f64) {
    let (model, state) = (&outcome.model, state(outcome));
    let nodes = Nodes::of(model);
    let u = nodes.gathered(&state.displacements);
    let mut rest = nodes.stiffness(model) * &u - nodes.loads(model);
    let load = nodes.loads(model).amax();
    let mut points = state.films.chunks(2);
    let pressure = state.films.iter().fold(0.0, |m: f64, film| m.max(film.sigma_y.abs()));
    for part in nodes.parts(model) {
        let films = points.next().unwrap();
        let before: Vec<f64> = films.iter().map(|film| slips[film.contact.index()]).collect();
        let answer = part.respond(model, &before, &u, &mut rest);
        for (film, point) in films.iter().zip(answer.points) {
            assert_eq!(model.contacts[film.contact.index()].joint.index(), part.joint);
            let found = [film.sigma_x.unwrap(), film.sigma_y, film.tau];
            for (found, expected) in found.iter().zip(point.stress.iter()) {
                assert!((found - expected).abs() < tolerance * pressure, "{found} and {expected}");
            }
            // The law calls a point open where the film would be pulled, however little.
            if film.sigma_y.abs() > tolerance * pressure {
                assert_eq!(state.contacts[film.contact.index()].status, point.contact);
            }
        }
    }
    assert!(points.next().is_none());
    for (contact, it) in model.contacts.iter().zip(&state.contacts) {
        if contact.film.is_some() {
            continue;
        }
        assert!(contact.a.is_none());
        let mesh = model.blocks[contact.b.block.index()].mesh.as_ref().unwrap();
        let force = contact_force(model, contact, it);
        for (node, share) in mesh.interpolate(contact.b.edge, contact.b.at) {
            let start = nodes.start(contact.b.block.index()) + 2 * node;
            rest[start] -= share * force.x;
            rest[start + 1] -= share * force.y;
        }
    }
    assert!(rest.amax() < tolerance * load, "{:e} of {load:e}", rest.amax());
}

/// `sigma_x`, `sigma_y` and `tau` of all points of strips \[Pa\].
pub fn film_stresses(outcome: &Outcome) -> Vec<f64> {
    let films = state(outcome).films.iter();
    films.flat_map(|film| [film.sigma_x.unwrap(), film.sigma_y, film.tau]).collect()
}
