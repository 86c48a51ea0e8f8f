//! What an answer has to satisfy, recomputed from forces, displacements and data alone.
//!
//! Forces are compared with those on the same block, down to finer digits than in `masonry::verify::checks`: a light one is
//! not excused by a heavy neighbour.

use masonry::analysis::outcome::{ContactState, Outcome, State};
use masonry::element::quad4;
use masonry::geometry;
use masonry::material::constitutive;
use masonry::model::{Anchor, Block, ContactPoint, EdgeLoad, Model};
use masonry::system::nodal_loads;
use nalgebra::Vector2;

use super::common::state;
use super::double::Double;

/// Blocks whose forces are below this part of the largest count as having these: their own are
/// rounding errors of what goes on around them.
pub const LIGHTEST: f64 = 1e-6;

/// What is wrong, dimensionless.
#[derive(Debug, Clone, Copy)]
pub struct Errors {
    /// Forces and moments left over on a block, relative to those on it.
    pub balance: f64,
    /// Pull, and friction beyond its bound, relative to the forces on the lighter of the blocks that meet.
    pub cone: f64,
    /// Bodies in one another, forces across gaps, and sliding at less than the friction bound.
    pub gaps: f64,
    /// Nodal forces of the elements against loads and contact forces.
    pub nodes: f64,
    /// `f.u = 2 U + D + t.x`, and friction that does work, relative to all terms.
    pub energy: f64,
    /// The smallest change of loads, stiffness and contact forces, relative to them, with which the forces at
    /// all nodes are in equilibrium; of rigid blocks that of loads and contact forces. No error by itself.
    pub backward: f64,
    /// Forces on the block with the largest ones relative to those on the one with the smallest.
    pub spread: f64,
}

impl Errors {
    /// The largest.
    pub fn worst(&self) -> f64 {
        larger(self.of_equations(), self.energy)
    }

    /// The largest but for the energy, which also has the errors of the displacements.
    pub fn of_equations(&self) -> f64 {
        [self.balance, self.cone, self.gaps, self.nodes].into_iter().fold(0.0, larger)
    }

    /// Of the last state of a solved scene.
    pub fn of(outcome: &Outcome) -> Self {
        let (model, state) = (&outcome.model, state(outcome));
        let bodies = Bodies::of(model, state);
        let contacts = model.contacts.iter().zip(&state.contacts);
        let pairs: Vec<Pair> =
            contacts.map(|(contact, it)| Pair::of(model, state, &bodies, (contact, it))).collect();
        let moved = state.displacements.iter().flatten().map(Vector2::norm);
        let gaps = model.contacts.iter().map(|contact| contact.gap.abs());
        let size = moved.chain(gaps).fold(0.0, larger);
        let nodes = at_nodes(model, state, &bodies.sizes);
        Self {
            balance: bodies.balance,
            cone: pairs.iter().map(Pair::outside_cone).fold(0.0, larger),
            gaps: pairs.iter().map(|pair| pair.against_law(size)).fold(0.0, larger),
            nodes: nodes[0],
            energy: energy(model, state, &pairs),
            backward: larger(bodies.balance, nodes[1]),
            spread: bodies.spread(),
        }
    }
}

/// The larger one; what is no number is larger than all.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// Zero where nothing is wrong, also where there is nothing to compare with.
fn share(part: f64, whole: f64) -> f64 {
    if part <= 0.0 { 0.0 } else { part / whole }
}

/// The forces on every block.
struct Bodies {
    /// Sum of their magnitudes, or what counts instead \[N\].
    sizes: Vec<f64>,
    balance: f64,
}

impl Bodies {
    fn of(model: &Model, state: &State) -> Self {
        let mut resultants: Vec<Resultant> =
            model.blocks.iter().map(|block| Resultant::of_loads(model, block)).collect();
        for (contact, it) in model.contacts.iter().zip(&state.contacts) {
            let normal = model.joints[contact.joint.index()].normal;
            for (anchor, sign) in [(Some(contact.b), 1.0), (contact.a, -1.0)] {
                let Some(anchor) = anchor else { continue };
                let block = &model.blocks[anchor.block.index()];
                // Both faces of a film feel its force in the middle between them.
                let place = match contact.film {
                    Some(_) => [contact.position.x, contact.position.y].map(Double::from),
                    None => on_edge(block, (anchor.edge, anchor.at)),
                };
                let [n, t] = [sign * it.t_n, sign * it.t_t].map(Double::from);
                let [x, y] = [normal.x, normal.y].map(Double::from);
                resultants[anchor.block.index()].add(place, [n * x + t * y, n * y - t * x]);
            }
        }
        let largest = resultants.iter().map(|it| it.size).fold(0.0, larger);
        let sizes: Vec<f64> = resultants.iter().map(|it| it.size.max(LIGHTEST * largest)).collect();
        let left = resultants.iter().zip(&sizes).zip(&model.blocks);
        let left = left.map(|((it, size), block)| {
            let [x, y] = it.force.map(Double::rounded);
            let moment = it.moment.rounded().abs() / geometry::size(&block.corners);
            share(larger(x.hypot(y), moment), *size)
        });
        Self { balance: left.fold(0.0, larger), sizes }
    }

    fn spread(&self) -> f64 {
        let least = self.sizes.iter().copied().fold(f64::INFINITY, f64::min);
        let most = self.sizes.iter().copied().fold(0.0, larger);
        if least > 0.0 { most / least } else { 1.0 }
    }
}

/// Force, moment about a place, and how large the forces are.
struct Resultant {
    about: [Double; 2],
    force: [Double; 2],
    moment: Double,
    size: f64,
}

impl Resultant {
    fn of_loads(model: &Model, block: &Block) -> Self {
        let zero = Double::from(0.0);
        let centroid = geometry::centroid(&block.corners);
        let about = [centroid.x, centroid.y].map(Double::from);
        let mut all = Self { about, force: [zero; 2], moment: zero, size: 0.0 };
        let weight = self_weight(model, block);
        all.add(about, [weight.x, weight.y].map(Double::from));
        for (place, force) in edge_forces(model, block) {
            all.add(on_edge(block, place), [force.x, force.y].map(Double::from));
        }
        all
    }

    fn add(&mut self, [x, y]: [Double; 2], [fx, fy]: [Double; 2]) {
        self.force = [self.force[0] + fx, self.force[1] + fy];
        self.moment = self.moment + (x - self.about[0]) * fy - (y - self.about[1]) * fx;
        self.size += fx.rounded().hypot(fy.rounded());
    }
}

fn self_weight(model: &Model, block: &Block) -> Vector2<f64> {
    model.gravity
        * (block.density.unwrap_or(0.0) * geometry::area(&block.corners) * model.thickness)
}

/// An edge of a block, and a fraction of it.
type Place = (usize, f64);

/// The resultants of the loads on the edges, each in the middle of what it covers.
fn edge_forces(model: &Model, block: &Block) -> Vec<(Place, Vector2<f64>)> {
    let of = |load: &EdgeLoad| {
        let [start, end] = geometry::edge(&block.corners, load.edge);
        let area = (end - start).norm() * (load.to - load.from) * model.thickness;
        ((load.edge, 0.5 * (load.from + load.to)), load.traction * area)
    };
    block.edge_loads().map(of).collect()
}

fn on_edge(block: &Block, (edge, at): Place) -> [Double; 2] {
    let [start, end] = geometry::edge(&block.corners, edge);
    let between = |a: f64, b: f64| {
        let [a, b, at] = [a, b, at].map(Double::from);
        a + (b - a) * at
    };
    [between(start.x, end.x), between(start.y, end.y)]
}

/// How a displacement of a place enters gap and slip of a contact point.
struct Term {
    anchor: Anchor,
    normal: Vector2<f64>,
    tangent: Vector2<f64>,
}

fn terms(model: &Model, contact: &ContactPoint) -> Vec<Term> {
    let joint = &model.joints[contact.joint.index()];
    let (n, t) = (joint.normal, joint.tangent());
    let mut list = vec![Term { anchor: contact.b, normal: n, tangent: t }];
    list.extend(contact.a.map(|anchor| Term { anchor, normal: -n, tangent: -t }));
    if let Some(film) = &contact.film {
        // The rotation of both faces shears a film, too.
        let turn = n * (film.half / film.length);
        for [start, end] in film.faces().into_iter().flatten() {
            let none = Vector2::zeros();
            list.push(Term { anchor: end, normal: none, tangent: turn });
            list.push(Term { anchor: start, normal: none, tangent: -turn });
        }
        let opened = film.gap_per_elongation();
        list.extend(stretched(model, contact).into_iter().map(|(anchor, along)| Term {
            anchor,
            normal: along * opened,
            tangent: Vector2::zeros(),
        }));
    }
    list
}

/// How displacements of the ends of a part of a film enter its elongation, the mean of both faces.
fn stretched(model: &Model, contact: &ContactPoint) -> Vec<(Anchor, Vector2<f64>)> {
    let Some(film) = contact.film.filter(|film| film.stretch.is_some()) else { return Vec::new() };
    let half = model.joints[contact.joint.index()].tangent() * 0.5;
    let is_elastic = |face: &[Anchor; 2]| model.blocks[face[0].block.index()].elasticity.is_some();
    let faces = film.faces().into_iter().flatten().filter(is_elastic);
    faces.flat_map(|[start, end]| [(start, -half), (end, half)]).collect()
}

/// Elongation of a part of a film and the stiffness of its bar, which always acts.
fn bar(model: &Model, state: &State, contact: &ContactPoint) -> [f64; 2] {
    let Some(stretch) = contact.film.and_then(|film| film.stretch) else { return [0.0; 2] };
    let moved =
        |(anchor, along): (Anchor, Vector2<f64>)| displaced(model, state, anchor).dot(&along);
    [stretched(model, contact).into_iter().map(moved).sum(), stretch.stiffness]
}

fn displaced(model: &Model, state: &State, anchor: Anchor) -> Vector2<f64> {
    let block = anchor.block.index();
    let shares = shares(&model.blocks[block], (anchor.edge, anchor.at));
    shares.iter().map(|(node, part)| state.displacements[block][*node] * *part).sum()
}

/// The displacement of a place on an edge as a sum over nodes.
fn shares(block: &Block, (edge, at): Place) -> [(usize, f64); 2] {
    match &block.mesh {
        Some(mesh) => mesh.interpolate(edge, at),
        None => [(edge, 1.0 - at), ((edge + 1) % 4, at)],
    }
}

/// Gap, slip and forces of a contact point, with what forces on its blocks are compared with.
struct Pair {
    gap: f64,
    slip: f64,
    t_n: f64,
    t_t: f64,
    mu: f64,
    size: f64,
    /// `t.x + c t^2`: what initial gaps, slips and films contribute to the work.
    other_work: [f64; 2],
}

impl Pair {
    fn of(
        model: &Model,
        state: &State,
        bodies: &Bodies,
        (contact, it): (&ContactPoint, &ContactState),
    ) -> Self {
        let [c_n, c_t] = contact.film.map_or([0.0; 2], |film| film.compliance);
        let mut gap = contact.gap + c_n * it.t_n;
        let mut slip = contact.slip + c_t * it.t_t;
        for term in terms(model, contact) {
            let u = displaced(model, state, term.anchor);
            gap += u.dot(&term.normal);
            slip += u.dot(&term.tangent);
        }
        let blocks = [Some(contact.b), contact.a].into_iter().flatten();
        let sizes = blocks.map(|anchor| bodies.sizes[anchor.block.index()]);
        let (t_n, t_t) = (it.t_n, it.t_t);
        let other_work =
            [t_n * contact.gap + t_t * contact.slip, c_n * t_n * t_n + c_t * t_t * t_t];
        Self {
            gap,
            slip,
            t_n,
            t_t,
            mu: contact.law.mu,
            size: sizes.fold(f64::MAX, f64::min),
            other_work,
        }
    }

    /// The forces that friction is compared with: it is `mu` times as sensitive as `t_n`.
    fn friction_size(&self) -> f64 {
        self.size * self.mu.max(1.0)
    }

    fn outside_cone(&self) -> f64 {
        let friction = self.t_t.abs() - self.mu * self.t_n;
        larger(share(-self.t_n, self.size), share(friction, self.friction_size()))
    }

    fn against_law(&self, moved: f64) -> f64 {
        let inside = share(-self.gap, moved);
        let across = share(self.gap, moved).min(share(self.t_n, self.size));
        let bound = -self.mu * self.t_n * self.slip.signum();
        let lacks = share((self.t_t - bound).abs(), self.friction_size());
        let slides = share(self.slip.abs(), moved).min(lacks);
        [inside, across, slides].into_iter().fold(0.0, larger)
    }
}

/// The largest nodal force left over in an elastic block, relative to those that act on it from outside, and
/// to all of which it is the sum.
fn at_nodes(model: &Model, state: &State, sizes: &[f64]) -> [f64; 2] {
    let loads = |block: &Block| -> Vec<Nodal> {
        let mesh = block.mesh.as_ref();
        let loads = mesh.map_or_else(Vec::new, |mesh| nodal_loads(model, block, mesh));
        loads.chunks(2).map(|f| Nodal::of(Vector2::new(f[0], f[1]))).collect()
    };
    let mut outside: Vec<Vec<Nodal>> = model.blocks.iter().map(loads).collect();
    for (contact, it) in model.contacts.iter().zip(&state.contacts) {
        for Term { anchor, normal, tangent } in terms(model, contact) {
            let block = anchor.block.index();
            for (node, part) in shares(&model.blocks[block], (anchor.edge, anchor.at)) {
                if let Some(nodal) = outside[block].get_mut(node) {
                    nodal.add((normal * it.t_n + tangent * it.t_t) * part);
                }
            }
        }
        let [elongation, stiffness] = bar(model, state, contact);
        for (anchor, along) in stretched(model, contact) {
            let block = anchor.block.index();
            for (node, part) in shares(&model.blocks[block], (anchor.edge, anchor.at)) {
                outside[block][node].add(along * (-stiffness * elongation * part));
            }
        }
    }
    let blocks = model.blocks.iter().zip(&state.displacements).zip(&outside).zip(sizes);
    let left = blocks
        .map(|(((block, u), outside), size)| of_elements((model, block), u, (outside, *size)));
    left.fold([0.0; 2], |[a, b], [c, d]| [larger(a, c), larger(b, d)])
}

/// The force at a node, and the sum of the magnitudes of its parts, which may circulate \[N\].
struct Nodal {
    force: Vector2<f64>,
    size: f64,
}

impl Nodal {
    fn of(force: Vector2<f64>) -> Self {
        Self { force, size: force.norm() }
    }

    fn add(&mut self, force: Vector2<f64>) {
        self.force += force;
        self.size += force.norm();
    }
}

/// What the elements of a block lack of the forces from outside.
fn of_elements(
    (model, block): (&Model, &Block),
    u: &[Vector2<f64>],
    (outside, size): (&[Nodal], f64),
) -> [f64; 2] {
    let (Some(mesh), Some(elasticity)) = (&block.mesh, block.elasticity) else { return [0.0; 2] };
    let d = constitutive(elasticity, model.plane);
    let mut inside: Vec<Nodal> = u.iter().map(|_| Nodal::of(Vector2::zeros())).collect();
    for element in &mesh.elements {
        let nodes = element.map(|n| mesh.nodes[n]);
        let stiffness = quad4::stiffness(&nodes, &d, model.thickness).unwrap();
        for (i, node) in element.iter().enumerate() {
            for (j, other) in element.iter().enumerate() {
                let part = stiffness.fixed_view::<2, 2>(2 * i, 2 * j) * u[*other];
                inside[*node].add(part);
            }
        }
    }
    let rest = inside.iter().zip(outside).map(|(a, b)| (a.force - b.force).norm());
    let rest = rest.fold(0.0, larger);
    let [inside_size, outside_size] =
        [&inside[..], outside].map(|list| list.iter().map(|it| it.size).fold(0.0, larger));
    // Bricks that move far as rigid bodies have rounding errors of the terms that cancel.
    // The forces on the block, which may be those of a heavy neighbour, spread over its nodes.
    let least = size / inside.len() as f64;
    let sizes = [LIGHTEST * inside_size, inside_size].map(|it| outside_size.max(least).max(it));
    sizes.map(|size| share(rest, size))
}

fn energy(model: &Model, state: &State, pairs: &[Pair]) -> f64 {
    let (mut work, mut size) = (0.0, 0.0);
    for (block, u) in model.blocks.iter().zip(&state.displacements) {
        let mut add = |force: Vector2<f64>, u: Vector2<f64>| {
            work += force.dot(&u);
            size += force.norm() * u.norm();
        };
        if let Some(mesh) = &block.mesh {
            let loads = nodal_loads(model, block, mesh);
            loads.chunks(2).zip(u).for_each(|(f, u)| add(Vector2::new(f[0], f[1]), *u));
        } else {
            add(self_weight(model, block), rigid_displacement(block, u));
            for (place, force) in edge_forces(model, block) {
                add(force, shares(block, place).iter().map(|(k, part)| u[*k] * *part).sum());
            }
        }
    }
    // The work of contact forces on both bodies cancels, but not its rounding errors.
    for (contact, it) in model.contacts.iter().zip(&state.contacts) {
        let anchors = [Some(contact.b), contact.a].into_iter().flatten();
        let moved = anchors.map(|anchor| displaced(model, state, anchor).norm());
        size += it.t_n.hypot(it.t_t) * moved.sum::<f64>();
    }
    let dissipated: f64 = pairs.iter().map(|pair| -pair.t_t * pair.slip).sum();
    let of_gaps: f64 = pairs.iter().map(|pair| pair.other_work[0]).sum();
    let stored = 2.0 * state.strain_energy;
    size += stored
        + pairs.iter().map(|it| (it.t_t * it.slip).abs() + it.other_work[0].abs()).sum::<f64>();
    larger(share((work - stored - dissipated - of_gaps).abs(), size), share(-dissipated, size))
}

/// The displacement of the centroid of a rigid block, from those of its corners.
fn rigid_displacement(block: &Block, u: &[Vector2<f64>]) -> Vector2<f64> {
    let [from, _, to, _] = block.corners;
    let turn = geometry::cross(to - from, u[2] - u[0]) / (to - from).norm_squared();
    let arm: Vector2<f64> = geometry::centroid(&block.corners) - from;
    u[0] + Vector2::new(-arm.y, arm.x) * turn
}
