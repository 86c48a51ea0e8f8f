//! Films under and between blocks against closed forms, uniform stress and bonded panels.

use crate::common::nodal_change::{NodalChange, local_axes};
use crate::common::updating::Updating;
use masonry::data::state::PointStatus;
use masonry::element::quad4;
use masonry::material::constitutive;
use masonry::model::{Elasticity, Plane};
use masonry::paper::film::pointwise::{FilmResponse, PointwiseFilm};
use masonry::paper::film::strip::Strip;
use masonry::paper::film::{FilmMaterial, Matrix8, Vector8};
use nalgebra::{DMatrix, DVector, Matrix2, Point2, SMatrix, Vector2, Vector3};

fn mortar(young: f64, poisson: f64) -> FilmMaterial {
    FilmMaterial { elasticity: Elasticity { young, poisson }, plane: Plane::Stress }
}

// A rigid block on a film: width 1 m, thickness of the wall 0.5 m.

const WIDTH: f64 = 1.0;
const WALL: f64 = 0.5;
const BED: f64 = 0.02;
const YOUNG: f64 = 3e8;

fn bed() -> Strip {
    Strip::new(WIDTH, BED, WALL, &mortar(YOUNG, 0.0)).unwrap()
}

/// Displacements of the film's nodes by a block's `u`, `v` and rotation about the middle of its lower face.
fn block_motion() -> SMatrix<f64, 8, 3> {
    let mut p = SMatrix::zeros();
    for (node, x) in [(2, -0.5 * WIDTH), (3, 0.5 * WIDTH)] {
        p[(2 * node, 0)] = 1.0;
        p[(2 * node + 1, 1)] = 1.0;
        p[(2 * node + 1, 2)] = x;
    }
    p
}

/// Newton's method for a block on the film; the number of steps, its movement and the film's answer.
fn newton(film: &PointwiseFilm, load: Vector3<f64>) -> (usize, Vector3<f64>, FilmResponse) {
    let (p, states) = (block_motion(), film.initial());
    let mut block = Vector3::zeros();
    for step in 0..20 {
        let answer = film.respond(&(p * block), &states);
        let unbalanced = load - p.transpose() * answer.force;
        if unbalanced.amax() < 1e-10 * load.amax() {
            return (step, block, answer);
        }
        let tangent = film.tangent(answer.points.iter().map(|point| point.tangent));
        block += (p.transpose() * tangent * p).lu().solve(&unbalanced).unwrap();
    }
    panic!("no equilibrium")
}

/// Largest pressure \[Pa\] and the end of contact of a force at an eccentricity to the right.
fn eccentric(force: f64, e: f64) -> (f64, f64) {
    if e <= WIDTH / 6.0 {
        (force / (WIDTH * WALL) * (1.0 + 6.0 * e / WIDTH), -0.5 * WIDTH)
    } else {
        let contact = 3.0 * (0.5 * WIDTH - e);
        (2.0 * force / (contact * WALL), 0.5 * WIDTH - contact)
    }
}

const ECCENTRICITIES: [f64; 6] = [0.0, 0.1, 1.0 / 6.0, 0.2, 1.0 / 3.0, 0.4];

#[test]
fn eccentric_force_by_the_law_in_many_parts() {
    let film = PointwiseFilm::new(bed(), 0.7, 400).unwrap();
    for e in ECCENTRICITIES {
        let force = 1e4;
        let (steps, block, answer) = newton(&film, Vector3::new(0.0, -force, -force * e));
        let (largest, from) = eccentric(force, e);
        assert!(steps <= 10, "{steps} steps");
        let u = block_motion() * block;
        let pressure = -bed().stress(0.5 * WIDTH, &u).y;
        let [x_i, x_f] = Updating::Pointwise.contact_part(&bed(), &u).unwrap();
        assert!((pressure - largest).abs() < 2e-5 * largest, "{pressure} against {largest}");
        assert!((x_i - from).abs() < 1e-5 * WIDTH, "{x_i} against {from}");
        assert!((x_f - 0.5 * WIDTH).abs() < 1e-15);
        let open = answer.points.iter().any(|point| point.contact == PointStatus::Open);
        assert_eq!(open, e > 0.17);
        assert!(answer.points.iter().all(|point| point.contact != PointStatus::Slip));
    }
}

/// The error of parts that are cut by the end of contact falls with the square of their length.
#[test]
fn parts_cut_by_the_end_of_contact_converge() {
    let load = Vector3::new(0.0, -1.0, -0.3);
    let error = |parts| {
        let (_, block, _) = newton(&PointwiseFilm::new(bed(), 0.7, parts).unwrap(), load);
        let pressure = -bed().stress(0.5 * WIDTH, &(block_motion() * block)).y;
        (pressure / eccentric(1.0, 0.3).0 - 1.0).abs()
    };
    for parts in [8, 32, 128] {
        let bound = 2.0 / f64::from(parts).powi(2);
        let count = usize::try_from(parts).unwrap();
        assert!(error(count) < bound, "{} with {parts} parts", error(count));
    }
}

#[test]
fn eccentric_force_by_one_strip_with_exact_ends() {
    let (strip, p) = (bed(), block_motion());
    for e in ECCENTRICITIES {
        for updating in [Updating::Pointwise, Updating::Printed] {
            let load = Vector3::new(0.0, -1e4, -1e4 * e);
            let mut part = strip.ends();
            let mut u = Vector8::zeros();
            for _ in 0..12 {
                let k = p.transpose() * strip.stiffness(part) * p;
                u = p * k.lu().solve(&load).unwrap();
                part = updating.contact_part(&strip, &u).unwrap();
            }
            let (largest, from) = eccentric(1e4, e);
            let pressure = -strip.stress(0.5 * WIDTH, &u).y;
            assert!((pressure - largest).abs() < 1e-11 * largest, "{pressure} against {largest}");
            assert!((part[0] - from).abs() < 1e-11 * WIDTH, "{} against {from}", part[0]);
        }
    }
}

/// `tau t_y / G` up to the bound of friction, and no more than the bound beyond it.
#[test]
fn a_film_in_shear_is_a_spring_up_to_the_bound_of_friction() {
    let film = PointwiseFilm::new(bed(), 0.6, 3).unwrap();
    let (area, shear_modulus, pressure) = (WIDTH * WALL, 0.5 * YOUNG, 2e5);
    let bound = 0.6 * pressure;
    for (share, contact) in [
        (0.5, PointStatus::Stick),
        (-0.999, PointStatus::Stick),
        (1.001, PointStatus::Slip),
        (-3.0, PointStatus::Slip),
    ] {
        // The faces stay parallel: a guide takes the moment of the shear over the film.
        let u = share * bound * BED / shear_modulus;
        let block = Vector3::new(u, -pressure * BED / YOUNG, 0.0);
        let answer = film.respond(&(block_motion() * block), &film.initial());
        let total = block_motion().transpose() * answer.force;
        let tau = share.clamp(-1.0, 1.0) * bound;
        assert!((total.x - tau * area).abs() < 1e-12 * bound);
        assert!((total.y + pressure * area).abs() < 1e-12 * pressure);
        assert!(answer.points.iter().all(|point| point.contact == contact));
        let slip = u - tau * BED / shear_modulus;
        let near = |slipped: f64| (slipped - slip).abs() < 1e-12 * u.abs();
        assert!(answer.points.iter().all(|point| near(point.state.slip)));
        assert!((answer.dissipation - tau * slip * area).abs() < 1e-12 * bound * u.abs());
    }
}

// Blocks of one element each, with films between them.

/// Elements and films assembled on the corners of blocks, two unknowns a corner.
struct Assembly {
    blocks: Vec<[Point2<f64>; 4]>,
    wall: f64,
    k: DMatrix<f64>,
    f: DVector<f64>,
}

impl Assembly {
    /// Blocks between `[x_0, x_1]` and `[y_0, y_1]`.
    fn new(rectangles: &[([f64; 2], [f64; 2])], stone: &FilmMaterial, wall: f64) -> Self {
        let blocks: Vec<_> = rectangles
            .iter()
            .map(|([x0, x1], [y0, y1])| {
                [[*x0, *y0], [*x1, *y0], [*x1, *y1], [*x0, *y1]].map(Point2::from)
            })
            .collect();
        let n = 8 * blocks.len();
        let mut assembly = Self { blocks, wall, k: DMatrix::zeros(n, n), f: DVector::zeros(n) };
        let d = constitutive(stone.elasticity, stone.plane);
        for b in 0..assembly.blocks.len() {
            let k = quad4::stiffness(&assembly.blocks[b], &d, wall).unwrap();
            assembly.add(&[4 * b, 4 * b + 1, 4 * b + 2, 4 * b + 3], &k);
        }
        assembly
    }

    fn add(&mut self, nodes: &[usize; 4], k: &Matrix8) {
        let dof = |i: usize| 2 * nodes[i / 2] + i % 2;
        for i in 0..8 {
            for j in 0..8 {
                self.k[(dof(i), dof(j))] += k[(i, j)];
            }
        }
    }

    /// A film on the overlap of block `a` with `b` above it or to the right of it: the nodes of both
    /// faces, the overlap in the joint's tangent, and the change to those nodes in local axes.
    fn joint(&self, a: usize, b: usize, tangent: Vector2<f64>) -> ([usize; 4], f64, NodalChange) {
        let bed = tangent.x > 0.5;
        let (on_a, on_b) = if bed { ([3, 2], [0, 1]) } else { ([2, 1], [3, 0]) };
        let place = |block: usize, k: usize| self.blocks[block][k].coords.dot(&tangent);
        let face_a = on_a.map(|k| place(a, k));
        let face_b = on_b.map(|k| place(b, k));
        let (from, to) = (face_a[0].max(face_b[0]), face_a[1].min(face_b[1]));
        let middle = 0.5 * (from + to);
        let faces = [face_a, face_b].map(|face| face.map(|x| x - middle));
        let change = NodalChange::of_film(to - from, faces);
        ([4 * a + on_a[0], 4 * a + on_a[1], 4 * b + on_b[0], 4 * b + on_b[1]], to - from, change)
    }

    /// A bonded film on the overlap, of the mortar and the thicknesses of a strip of another length.
    fn add_bonded_film(&mut self, film: &Strip, a: usize, b: usize, tangent: Vector2<f64>) {
        let (nodes, length, change) = self.joint(a, b, tangent);
        let q = local_axes(tangent);
        let film = Strip::new(length, film.thickness(), film.wall(), film.material()).unwrap();
        let local = change.stiffness(&film.stiffness(film.ends()));
        self.add(&nodes, &(q.transpose() * local * q));
    }

    /// A force at a place of edge `k` of a block.
    fn add_force(&mut self, block: usize, k: usize, place: Point2<f64>, force: Vector2<f64>) {
        let [p, q] = [self.blocks[block][k], self.blocks[block][(k + 1) % 4]];
        let at = (place - p).norm() / (q - p).norm();
        for (node, share) in [(k, 1.0 - at), ((k + 1) % 4, at)] {
            for i in 0..2 {
                self.f[8 * block + 2 * node + i] += share * force[i];
            }
        }
    }

    /// A uniform traction on the part of edge `k` between two places of it.
    fn add_traction(
        &mut self,
        block: usize,
        k: usize,
        part: [Point2<f64>; 2],
        traction: Vector2<f64>,
    ) {
        let force = traction * ((part[1] - part[0]).norm() * self.wall);
        self.add_force(block, k, nalgebra::center(&part[0], &part[1]), force);
    }

    /// Displacements with those of the given nodes held at zero.
    fn solve(&self, held: &[usize]) -> DVector<f64> {
        let mut k = self.k.clone();
        let mut f = self.f.clone();
        for dof in held.iter().flat_map(|node| [2 * node, 2 * node + 1]) {
            k.row_mut(dof).fill(0.0);
            k.column_mut(dof).fill(0.0);
            k[(dof, dof)] = self.k.diagonal().max();
            f[dof] = 0.0;
        }
        k.cholesky().unwrap().solve(&f)
    }
}

const BED_TANGENT: Vector2<f64> = Vector2::new(1.0, 0.0);
const HEAD_TANGENT: Vector2<f64> = Vector2::new(0.0, -1.0);

/// Three blocks of one height and two films: shortening by the sum of both.
#[test]
fn a_column_of_bricks_and_films_shortens_by_the_sum() {
    let (h, t, wall, pressure) = (0.3, 0.01, 0.25, 1e6);
    let (stone, joint) = (mortar(5e9, 0.0), mortar(8e8, 0.0));
    let course = |k: f64| ([0.0, 0.4], [k * (h + t), k * (h + t) + h]);
    let mut column = Assembly::new(&[course(0.0), course(1.0), course(2.0)], &stone, wall);
    let film = Strip::new(1.0, t, wall, &joint).unwrap();
    column.add_bonded_film(&film, 0, 1, BED_TANGENT);
    column.add_bonded_film(&film, 1, 2, BED_TANGENT);
    let top = [column.blocks[2][3], column.blocks[2][2]];
    column.add_traction(2, 2, top, Vector2::new(0.0, -pressure));
    let u = column.solve(&[0, 1]);
    let expected = -pressure * (3.0 * h / 5e9 + 2.0 * t / 8e8);
    assert!((u[8 * 2 + 2 * 2 + 1] / expected - 1.0).abs() < 1e-11);
    assert!((u[8 * 2 + 2 * 3 + 1] / expected - 1.0).abs() < 1e-11);
}

/// Two blocks that overlap by half, a film with its real thickness between them, and one material: uniform
/// stress is in equilibrium at every node, for beds and heads, whatever stress it is.
#[test]
fn uniform_stress_crosses_films_with_moved_ends() {
    let (t, wall) = (0.03, 0.4);
    let material = mortar(2.0, 0.2);
    let d = constitutive(material.elasticity, material.plane);
    let film = Strip::new(1.0, t, wall, &material).unwrap();
    let beds = [([0.0, 0.2], [0.0, 0.1]), ([0.13, 0.4], [0.1 + t, 0.3])];
    let heads = [([0.0, 0.1], [0.0, 0.2]), ([0.1 + t, 0.3], [0.13, 0.4])];
    for (rectangles, tangent, edge_a, edge_b) in
        [(beds, BED_TANGENT, 2, 0), (heads, HEAD_TANGENT, 1, 3)]
    {
        for stress in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.3, -2.0, 0.7]] {
            let stress = Vector3::from(stress);
            let tensor = Matrix2::new(stress.x, stress.z, stress.z, stress.y);
            let mut pair = Assembly::new(&rectangles, &material, wall);
            pair.add_bonded_film(&film, 0, 1, tangent);
            // Tractions on all edges but the overlap, and on the two ends of the film.
            for (block, inner) in [(0, edge_a), (1, edge_b)] {
                let corners = pair.blocks[block];
                for k in 0..4 {
                    let [p, q] = [corners[k], corners[(k + 1) % 4]];
                    let along = (q - p).normalize();
                    let traction = tensor * Vector2::new(along.y, -along.x);
                    let other = pair.blocks[1 - block].map(|c| (c - p).dot(&along));
                    let least = other.iter().copied().fold(f64::INFINITY, f64::min);
                    let most = other.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    let free = if k != inner {
                        [p, q]
                    } else if least > 0.0 {
                        [p, p + along * least]
                    } else {
                        [p + along * most, q]
                    };
                    pair.add_traction(block, k, free, traction);
                }
            }
            let (nodes, length, change) = pair.joint(0, 1, tangent);
            let end = tensor * tangent * (0.5 * t * wall);
            let ends =
                Vector8::from_fn(|i, _| if i / 2 % 2 == 0 { -end[i % 2] } else { end[i % 2] });
            let ends = change.forces(&ends);
            assert!((length - 0.07).abs() < 1e-15);
            (0..8).for_each(|i| pair.f[2 * nodes[i / 2] + i % 2] += ends[i]);

            let strain = d.try_inverse().unwrap() * stress;
            let gradient = Matrix2::new(strain.x, 0.4 * strain.z, 0.6 * strain.z, strain.y);
            let u = DVector::from_fn(16, |i, _| {
                (gradient * pair.blocks[i / 8][i % 8 / 2].coords)[i % 2]
            });
            let unbalanced = &pair.k * u - &pair.f;
            assert!(unbalanced.amax() < 1e-14, "{unbalanced}");
        }
    }
}

/// A square panel of 1.3 m: courses of bricks of 0.1 m with films of 0.02 m, every second with half
/// bricks at its ends; the number of films, largest displacement \[m\] and strain energy \[kNm\].
///
/// All films are bonded. The side walls, and the floor under the two lower corner bricks, hold the nodes.
fn bonded_panel(brick: f64) -> (usize, usize, f64, f64) {
    let (size, h, t, wall) = (1.3, 0.1, 0.02, 1.0);
    let half = 0.5 * (brick - t);
    let mut rectangles = Vec::new();
    let mut courses = Vec::new();
    for course in 0..11 {
        let y = f64::from(course) * (h + t);
        let first = rectangles.len();
        let mut x = 0.0;
        while x < size {
            let ends_half = course % 2 == 1 && (x < t || x > size - 2.0 * half);
            let length = if ends_half { half } else { brick };
            rectangles.push(([x, x + length], [y, y + h]));
            x += length + t;
        }
        courses.push(first..rectangles.len());
    }
    let material = mortar(1e5, 0.15);
    let film = Strip::new(1.0, t, wall, &material).unwrap();
    let mut panel = Assembly::new(&rectangles, &material, wall);
    let mut films = 0;
    for (k, course) in courses.iter().enumerate() {
        for a in course.clone() {
            if a + 1 < course.end {
                panel.add_bonded_film(&film, a, a + 1, HEAD_TANGENT);
                films += 1;
            }
            for b in courses.get(k + 1).cloned().unwrap_or_default() {
                let (on_a, on_b) = (rectangles[a].0, rectangles[b].0);
                if on_a[0].max(on_b[0]) + 1e-9 < on_a[1].min(on_b[1]) {
                    panel.add_bonded_film(&film, a, b, BED_TANGENT);
                    films += 1;
                }
            }
        }
    }
    for b in courses[10].clone() {
        let top = [panel.blocks[b][3], panel.blocks[b][2]];
        panel.add_traction(b, 2, top, Vector2::new(0.0, -10.0));
    }
    let corners = [courses[0].start, courses[0].end - 1];
    let held: Vec<usize> = (0..4 * rectangles.len())
        .filter(|node| {
            let p = panel.blocks[node / 4][node % 4];
            let on_wall = p.x < 1e-9 || p.x > size - 1e-9;
            on_wall || (corners.contains(&(node / 4)) && p.y < 1e-9)
        })
        .collect();
    let u = panel.solve(&held);
    (rectangles.len(), films, u.amax(), 0.5 * u.dot(&panel.f))
}

/// Found independently by another program.
#[test]
fn bonded_panels_have_the_known_displacement_and_energy() {
    for (brick, counts, largest, energy) in [
        (0.1, (126, 335), 7.761_484_33e-5, 2.941_520_80e-4),
        (0.2, (71, 180), 7.876_108_11e-5, 3.167_844_15e-4),
    ] {
        let (bricks, films, u, w) = bonded_panel(brick);
        assert_eq!((bricks, films), counts);
        assert!((u / largest - 1.0).abs() < 1e-8, "{u:e} against {largest:e}");
        assert!((w / energy - 1.0).abs() < 1e-8, "{w:e} against {energy:e}");
    }
}
