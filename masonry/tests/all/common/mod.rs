//! Small models for the tests of the mechanics.

#![allow(dead_code, reason = "every test binary uses its own part of this module")]
#![allow(unreachable_pub, reason = "a module of helpers, compiled into each test binary")]

pub mod enumerate;
pub mod nodal_change;
pub mod reference;
pub mod updating;
pub mod walls;

use masonry::ids::LoadId;
use masonry::law::JointLaw;
use masonry::model::joints::{self, JointKind, JointSearch};
use masonry::model::mesh::BlockMesh;
use masonry::model::{
    BlockLoad, EdgeLoad, Elasticity, JointClass, Model, Movement, PlacedBlock, PlacedSupport, Plane,
};
use masonry::units::Units;
use nalgebra::{Point2, Vector2};

/// Young's modulus of the bricks of the published panels, kN/m2 in Pa.
pub const YOUNG: f64 = 1e8;

/// An axis-parallel block; `mesh` `None` makes it rigid.
pub fn rectangle(name: &str, x: [f64; 2], y: [f64; 2], mesh: Option<[usize; 2]>) -> PlacedBlock {
    let corners = [
        Point2::new(x[0], y[0]),
        Point2::new(x[1], y[0]),
        Point2::new(x[1], y[1]),
        Point2::new(x[0], y[1]),
    ];
    block(name, corners, mesh)
}

/// A block of any shape; `mesh` `None` makes it rigid.
pub fn block(name: &str, corners: [Point2<f64>; 4], mesh: Option<[usize; 2]>) -> PlacedBlock {
    PlacedBlock {
        name: name.into(),
        corners: corners.into(),
        elasticity: mesh.map(|_| Elasticity { young: YOUNG, poisson: 0.15 }),
        density: None,
        mesh: mesh.map(|[nx, ny]| BlockMesh::new(&corners, nx, ny)),
        loads: Vec::new(),
    }
}

/// A uniform traction on a whole edge.
pub fn traction(edge: usize, x: f64, y: f64) -> BlockLoad {
    traction_on(edge, [0.0, 1.0], [x, y])
}

/// A uniform traction on a part of an edge.
pub fn traction_on(edge: usize, [from, to]: [f64; 2], [x, y]: [f64; 2]) -> BlockLoad {
    EdgeLoad { edge, from, to, traction: [Vector2::new(x, y); 2], load: LoadId(0) }.into()
}

/// A straight support.
pub fn support(name: &str, from: [f64; 2], to: [f64; 2]) -> PlacedSupport {
    PlacedSupport {
        name: name.into(),
        from: from.into(),
        to: to.into(),
        movement: Movement::default(),
    }
}

/// A model with one friction coefficient for beds, heads and supports.
pub fn model(blocks: Vec<PlacedBlock>, supports: Vec<PlacedSupport>, mu: f64) -> Model {
    model_with(blocks, supports, [mu; 3], &JointSearch::default())
}

/// A model with friction coefficients for beds, heads and supports.
pub fn model_with(
    blocks: Vec<PlacedBlock>,
    supports: Vec<PlacedSupport>,
    mu: [f64; 3],
    options: &JointSearch,
) -> Model {
    let joint_classes: Vec<JointClass> = ["bed", "head", "support"]
        .iter()
        .zip(mu)
        .map(|(name, mu)| JointClass {
            name: (*name).into(),
            law: JointLaw::friction(mu),
            points: None,
            mortar: None,
        })
        .collect();
    let class_of = |kind, _, _| match kind {
        JointKind::Blocks(normal) => usize::from(!joints::is_bed(normal)),
        JointKind::Support(_) => 2,
    };
    let (joints, contacts) =
        joints::find(&blocks, &supports, &joint_classes, class_of, 1.0, options)
            .expect("a model whose contact points can be placed");
    Model {
        healed: None,
        blocks,
        supports,
        joints,
        contacts,
        joint_classes,
        plane: Plane::Stress,
        thickness: 1.0,
        gravity: Vector2::new(0.0, -9.81),
        accelerations: Vec::new(),
        loads: Vec::new(),
        units: Units::SI,
    }
}

/// A running bond wall of bricks `aspect * height` by `height`, `per_course` bricks wide; every other
/// course begins and ends with half bricks. The mesh size is `height / 2`.
pub fn running_bond(
    per_course: usize,
    courses: usize,
    aspect: usize,
    height: f64,
) -> Vec<PlacedBlock> {
    let length = aspect as f64 * height;
    let mut blocks = Vec::new();
    for course in 0..courses {
        let y = [course as f64 * height, (course + 1) as f64 * height];
        let mut halves = vec![2; per_course];
        if course % 2 == 1 {
            halves = [vec![1], vec![2; per_course - 1], vec![1]].concat();
        }
        let mut start = 0;
        for (k, count) in halves.into_iter().enumerate() {
            let x = [start, start + count].map(|n| f64::from(n) * 0.5 * length);
            let mesh = if count == 2 { [2 * aspect, 2] } else { [aspect, 2] };
            blocks.push(rectangle(&format!("b{course}.{k}"), x, y, Some(mesh)));
            start += count;
        }
    }
    blocks
}

/// The published panel: 1 m by 1 m, ten courses, bricks `0.1 aspect` by 0.1 m, 10 kN/m2 on top, side
/// walls, and a floor below the given stretches.
pub fn panel(aspect: usize, floors: &[[f64; 2]]) -> Model {
    let mut blocks = running_bond(10 / aspect, 10, aspect, 0.1);
    for block in &mut blocks {
        if block.corners[2].y > 0.95 {
            block.loads.push(traction(2, 0.0, -10e3));
        }
    }
    let mut supports =
        vec![support("left", [0.0, 0.0], [0.0, 1.0]), support("right", [1.0, 0.0], [1.0, 1.0])];
    supports.extend(floors.iter().map(|[x0, x1]| support("floor", [*x0, 0.0], [*x1, 0.0])));
    model(blocks, supports, 1.0)
}
