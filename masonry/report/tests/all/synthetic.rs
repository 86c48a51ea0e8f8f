//! A running-bond wall with an invented state: reports are tested whatever solvers find.

use masonry::analysis::outcome::{
    ElementStress, Outcome, PhaseTime, PointState, PointStatus, Principal, Reaction, RouteAttempt,
    State,
};
use masonry::analysis::solve::solve;
use masonry::data::verdict::{Evidence, Verdict};
use masonry::ids::{BlockId, JointId, LoadId, SupportId};
use masonry::law::JointLaw;
use masonry::model::mesh::BlockMesh;
use masonry::model::{
    Anchor, Body, EdgeLoad, Elasticity, JointClass, JointPoint, LoadCase, Model, Movement,
    PlacedBlock, PlacedJoint, PlacedSupport, Plane,
};
use masonry::plan::{Effect, Plan, PlannedRoute};
use masonry::scene::{self, Material, Route, Scene};
use masonry::units::{ForceUnit, LengthUnit, Units};
use nalgebra::{Point2, Vector2};

/// Sizes of the wall.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wall {
    pub(crate) length: f64,
    pub(crate) height: f64,
    pub(crate) bricks: usize,
    pub(crate) courses: usize,
    pub(crate) elements: (usize, usize),
    pub(crate) rigid: bool,
}

impl Wall {
    /// Eight courses of five bricks, 1.0 x 0.8 m.
    pub(crate) const PANEL: Self =
        Self { length: 0.2, height: 0.1, bricks: 5, courses: 8, elements: (4, 2), rigid: false };

    fn width(self) -> f64 {
        self.length * self.bricks as f64
    }
}

/// A solved wall of running bond on its two lower corner bricks between two side walls.
pub(crate) fn solved(wall: Wall) -> Outcome {
    let model = model(wall);
    let state = state(&model, wall);
    let count = |status| state.contacts.iter().filter(|contact| contact.status == status).count();
    // Results may get more fields: they are those of an answer, with other values.
    let mut outcome = solve(&seed()).expect("a block on the floor stands");
    let checks = outcome.checks.as_mut().expect("an answer has checks");
    (checks.force_balance, checks.moment_balance) = (3.1e-15, 8.0e-15);
    (checks.nodal_balance, checks.penetration) = (4.0e-15, 2.2e-16);
    (checks.complementarity, checks.backward) = (1.0e-15, 8.0e-15);
    (checks.uncarried, checks.cone_violation) = (0.0, 0.0);
    (checks.energy, checks.deformation, checks.spread) = (0.0, 0.0, 1.0);
    checks.open = count(PointStatus::Open);
    checks.stick = count(PointStatus::Stick);
    checks.slip = count(PointStatus::Slip);
    outcome.reactions =
        [("floor, left", 0.0, 4.0e3, 0.4e3), ("floor \"right\"", 0.0, 4.0e3, 3.6e3)]
            .into_iter()
            .chain([("left <wall>", 1.2e3, 1.0e3, -0.5e3), ("right wall", -1.2e3, 1.0e3, 1.5e3)])
            .map(|(support, fx, fy, m)| Reaction { support: support.to_owned(), fx, fy, m })
            .collect();
    let solve = &mut outcome.solve;
    (solve.status, solve.route) = (lcp::Status::Solved, Route::Lemke);
    "the order is below 3000".clone_into(&mut solve.because);
    solve.routes.truncate(1);
    solve.routes[0].route = Route::Lemke;
    solve.routes[0].because.clone_from(&solve.because);
    "Solved".clone_into(&mut solve.routes[0].end);
    solve.routes[0].seconds = 0.8;
    "coulomb".clone_into(&mut solve.form);
    (solve.order, solve.pivots, solve.iterations, solve.factorisations) = (339, 412, 0, 3);
    solve.residuals = lcp::Residuals {
        equation: 2.3e-15,
        feasibility: 0.0,
        complementarity: 0.0,
        natural: 2.3e-15,
        loads: 2.3e-15,
    };
    outcome.judgement.verdict = Verdict::Stands;
    outcome.judgement.evidence = Evidence::Equilibrium;
    "The wall stands: equilibrium found and verified.".clone_into(&mut outcome.judgement.sentence);
    outcome.judgement.warnings.clear();
    "Panel of 0.2 x 0.1 m bricks <open base>".clone_into(&mut outcome.title);
    outcome.plan = plan(&model);
    outcome.times = [("model", 0.0012), ("assembly", 0.031), ("reduction", 0.22), ("solve", 1.75)]
        .map(|(phase, seconds)| PhaseTime { phase: phase.to_owned(), seconds })
        .to_vec();
    (outcome.model, outcome.state) = (model, Some(state));
    outcome
}

/// A block on the floor, by pivots.
fn seed() -> Scene {
    Scene::new("", Units::SI)
        .thickness(1.0)
        .gravity([0.0, -9.81])
        .material("stone", Material::rigid().density(2000.0))
        .joint("bed", scene::Joint::mu(0.6))
        .block(scene::Block::new(
            "block",
            "stone",
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        ))
        .support(scene::Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"))
        .route(Route::Lemke)
}

/// The same wall without an equilibrium, with the mechanism of a falling middle.
pub(crate) fn unsolved(wall: Wall) -> Outcome {
    let mut outcome = solved(wall);
    outcome.solve.status = lcp::Status::RayTermination;
    let left = RouteAttempt::Left { route: Route::Lemke, iterations: 412 };
    outcome.solve.attempts.push(left);
    outcome.state = None;
    outcome.checks = None;
    outcome.reactions.clear();
    let rates = outcome.model.blocks.iter().map(|block| {
        let middle = nalgebra::center(&block.corners[0], &block.corners[2]);
        vec![Vector2::new(0.0, if hangs(middle, wall) { -1.0 } else { 0.0 }); 4]
    });
    outcome.mechanism = Some(rates.collect());
    outcome.judgement.verdict = Verdict::Undecided;
    outcome.judgement.evidence = Evidence::None;
    "Undecided: neither was found.".clone_into(&mut outcome.judgement.sentence);
    outcome
}

pub(crate) fn model(wall: Wall) -> Model {
    let (l, h) = (wall.length, wall.height);
    let (width, top) = (wall.width(), h * wall.courses as f64);
    let courses: Vec<Vec<f64>> = (0..wall.courses).map(|course| cuts(wall, course)).collect();
    let mut blocks = Vec::new();
    for (course, cuts) in courses.iter().enumerate() {
        for (index, ends) in cuts.windows(2).enumerate() {
            let bottom = h * course as f64;
            let mut block = brick([ends[0], ends[1]], [bottom, bottom + h], wall);
            block.name = format!("{}.{}", course + 1, index + 1);
            if course + 1 == wall.courses {
                let traction = Vector2::new(0.0, -10e3);
                let load = EdgeLoad {
                    edge: 2,
                    from: 0.0,
                    to: 1.0,
                    traction: [traction; 2],
                    load: LoadId(0),
                };
                block.loads.push(load.into());
            }
            blocks.push(block);
        }
    }
    let support = |name: &str, from: [f64; 2], to: [f64; 2]| PlacedSupport {
        name: name.to_owned(),
        from: from.into(),
        to: to.into(),
        movement: Movement::default(),
    };
    let supports = vec![
        support("floor, left", [0.0, 0.0], [l, 0.0]),
        support("floor \"right\"", [width - l, 0.0], [width, 0.0]),
        support("left <wall>", [0.0, 0.0], [0.0, top]),
        support("right wall", [width, 0.0], [width, top]),
    ];
    let mut model = Model {
        healed: None,
        blocks,
        supports,
        joints: Vec::new(),
        contacts: Vec::new(),
        joint_classes: ["bed", "head", "support, dry"]
            .map(|name| JointClass {
                name: name.to_owned(),
                law: JointLaw::friction(1.0),
                points: None,
                mortar: None,
            })
            .to_vec(),
        plane: Plane::Stress,
        thickness: 1.0,
        gravity: Vector2::new(0.0, -9.81),
        accelerations: Vec::new(),
        loads: vec![LoadCase {
            name: "top".to_owned(),
            group: "top".to_owned(),
            factor: 1.0,
            mass: None,
        }],
        units: Units { length: LengthUnit::M, force: ForceUnit::Kn },
    };
    add_joints(&mut model, wall, &courses);
    model
}

/// Ends of the bricks of a course: every other course starts and ends with half a brick.
fn cuts(wall: Wall, course: usize) -> Vec<f64> {
    let whole = (0..=wall.bricks).map(|k| k as f64 * wall.length);
    if course.is_multiple_of(2) {
        return whole.collect();
    }
    let halves = (0..wall.bricks).map(|k| (k as f64 + 0.5) * wall.length);
    std::iter::once(0.0).chain(halves).chain([wall.width()]).collect()
}

fn brick(x: [f64; 2], y: [f64; 2], wall: Wall) -> PlacedBlock {
    let (nx, ny) = wall.elements;
    let corners = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]].map(Point2::from);
    PlacedBlock {
        name: String::new(),
        corners: corners.into(),
        elasticity: (!wall.rigid).then_some(Elasticity { young: 1e8, poisson: 0.15 }),
        density: None,
        mesh: (!wall.rigid).then_some(BlockMesh::new(&corners, nx, ny)),
        loads: Vec::new(),
    }
}

fn add_joints(model: &mut Model, wall: Wall, courses: &[Vec<f64>]) {
    let h = wall.height;
    let mut first = 0;
    for (course, cuts) in courses.iter().enumerate() {
        let (low, high) = (h * course as f64, h * (course + 1) as f64);
        let bricks = cuts.len() - 1;
        for index in 0..bricks {
            let b = BlockId::new(first + index);
            if index > 0 {
                let a = Body::Block(BlockId::new(first + index - 1));
                add_joint(model, (a, b, 1), [[cuts[index], low], [cuts[index], high]]);
            }
            if course == 0 && (index == 0 || index + 1 == bricks) {
                let a = Body::Support(SupportId::new(usize::from(index > 0)));
                add_joint(model, (a, b, 2), [[cuts[index], low], [cuts[index + 1], low]]);
            }
            if let Some(above) = courses.get(course + 1) {
                for (upper, ends) in above.windows(2).enumerate() {
                    let from = ends[0].max(cuts[index]);
                    let to = ends[1].min(cuts[index + 1]);
                    if to - from > 1e-9 {
                        let upper = BlockId::new(first + bricks + upper);
                        add_joint(model, (Body::Block(b), upper, 0), [[from, high], [to, high]]);
                    }
                }
            }
        }
        for (support, index, x) in [(2, 0, cuts[0]), (3, bricks - 1, cuts[bricks])] {
            let b = BlockId::new(first + index);
            let a = Body::Support(SupportId::new(support));
            add_joint(model, (a, b, 2), [[x, low], [x, high]]);
        }
        first += bricks;
    }
}

fn add_joint(model: &mut Model, (a, b, class): (Body, BlockId, usize), ends: [[f64; 2]; 2]) {
    let [from, to] = ends.map(Point2::from);
    let middle = nalgebra::center(&from, &to);
    let corners = &model.blocks[b.index()].corners;
    let inward = nalgebra::center(&corners[0], &corners[2]) - middle;
    let along = (to - from).normalize();
    let normal = (inward - along * inward.dot(&along)).normalize();
    let joint = JointId::new(model.joints.len());
    model.joints.push(PlacedJoint { a, b, class, from, to, normal, film: None });
    for position in [from, to] {
        let anchor = |block| Anchor { block, edge: 0, at: 0.0 };
        model.contacts.push(JointPoint {
            joint,
            position,
            weight: 0.5 * (to - from).norm() * model.thickness,
            a: if let Body::Block(block) = a { Some(anchor(block)) } else { None },
            b: anchor(b),
            gap: 0.0,
            slip: 0.0,
            law: model.joint_classes[class].law.at(1.0),
            compliance: [0.0; 2],
            film: None,
        });
    }
}

/// Whether a point is below the arch that spans the open base.
fn hangs(p: Point2<f64>, wall: Wall) -> bool {
    let half = 0.5 * wall.width() - wall.length;
    let from_middle = (p.x - 0.5 * wall.width()).abs();
    p.y * 0.5 * wall.length / wall.height < half - from_middle
}

fn state(model: &Model, wall: Wall) -> State {
    let displacements = model
        .blocks
        .iter()
        .map(|block| {
            let middle = nalgebra::center(&block.corners[0], &block.corners[2]);
            let down = if hangs(middle, wall) { -1.1e-4 } else { 0.0 };
            let sway = 1e-5 * (9.0 * middle.x).sin();
            let nodes = block.mesh.as_ref().map_or(&block.corners[..], |mesh| &mesh.nodes);
            let of = |p: &Point2<f64>| {
                let turn = 3e-4 * (middle.x - 0.5 * wall.width());
                let arm = p - middle;
                Vector2::new(sway - turn * arm.y, down - 6e-5 * p.y + turn * arm.x)
            };
            nodes.iter().map(of).collect()
        })
        .collect();
    State {
        films: Vec::new(),
        displacements,
        contacts: model.contacts.iter().map(|contact| contact_state(contact, wall)).collect(),
        stresses: stresses(model, wall),
        strain_energy: 0.567_259,
    }
}

fn contact_state(contact: &JointPoint, wall: Wall) -> PointState {
    let p = contact.position;
    if hangs(p, wall) {
        let status = PointStatus::Open;
        return PointState { t_n: 0.0, t_t: 0.0, y_n: 1.0e-4 / 3.0, y_t: -2e-6, status };
    }
    let t_n = 1e4 * contact.weight * (1.0 + p.y);
    let outer = (p.x - 0.5 * wall.width()).abs() > 0.49 * wall.width();
    if outer && p.y > 0.3 {
        return PointState { t_n, t_t: -t_n, y_n: 0.0, y_t: 3e-6, status: PointStatus::Slip };
    }
    PointState { t_n, t_t: 0.3 * t_n, y_n: 0.0, y_t: 0.0, status: PointStatus::Stick }
}

fn stresses(model: &Model, wall: Wall) -> Vec<ElementStress> {
    let mut stresses = Vec::new();
    for (index, block) in model.blocks.iter().enumerate() {
        let Some(mesh) = &block.mesh else { continue };
        for (element, corners) in mesh.elements.iter().enumerate() {
            let centre = nalgebra::center(&mesh.nodes[corners[0]], &mesh.nodes[corners[2]]);
            let side = (centre.x - 0.5 * wall.width()).signum();
            let slender = if hangs(centre, wall) { 0.02 } else { 1.0 + 3.0 * (0.8 - centre.y) };
            let sigma = [
                if centre.y < 0.1 { 2.5e3 } else { -3e3 * slender },
                -10e3 * slender,
                3e3 * slender * side,
            ];
            stresses.push(ElementStress {
                block: BlockId::new(index),
                element,
                centre,
                sigma,
                principal: principal(sigma),
            });
        }
    }
    stresses
}

fn principal([x, y, xy]: [f64; 3]) -> Principal {
    let (mean, radius) = (0.5 * (x + y), (0.5 * (x - y)).hypot(xy));
    let theta = 0.5 * xy.atan2(0.5 * (x - y));
    Principal { sigma_1: mean + radius, sigma_2: mean - radius, theta }
}

fn plan(model: &Model) -> Plan {
    let effect = |name, on, because: &str, unknowns| Effect {
        name,
        on,
        because: because.to_owned(),
        unknowns,
        cost: if on { "some memory" } else { "none" }.to_owned(),
    };
    let m = model.contacts.len();
    Plan {
        effects: vec![
            effect("deformation", true, "every block has an elastic modulus", 1230),
            effect("friction", true, "mu > 0 on the joint classes bed, head and support", 2 * m),
            effect(
                "self weight",
                false,
                "no block has a density, and the scene gives no gravity that could act on one",
                0,
            ),
        ],
        blocks: model.blocks.len(),
        nodes: model.blocks.iter().filter_map(|b| b.mesh.as_ref()).map(|m| m.nodes.len()).sum(),
        joints: model.joints.len(),
        contact_points: m,
        frictional_points: m,
        rigid_modes: 3 * model.blocks.len(),
        order: 3 * m,
        largest_order: 3 * m,
        largest_block: 18,
        steps: 1,
        solver: "lemke".to_owned(),
        because: "friction makes the matrix nonsymmetric, and the order is below 3000".to_owned(),
        routes: vec![PlannedRoute {
            route: Route::Lemke,
            because: "the order is below 3000".to_owned(),
            order: 3 * m,
            largest_order: 3 * m,
            dense_numbers: 81 * m * m,
            memory_bytes: 648 * m * m,
        }],
        refused: None,
    }
}
