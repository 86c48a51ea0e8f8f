//! Properties of the answer for random walls in running bond that stand on a floor.

use crate::common;

use common::{GRAVITY, M_KN, applied_load, assert_admissible, assert_sound, state};
use lcp::Status;
use masonry::analysis::outcome::{Outcome, PointState};
use masonry::analysis::solve::solve;
use masonry::data::state::RowState;
use masonry::forms::reduction::Reduction;
use masonry::forms::{DenseForm, FormKind};
use masonry::model::{Body, JointPoint, Model, Plane};
use masonry::scene::bond;
use masonry::scene::{Block, Brick, Joint, Load, Material, Scene, Support, Wall};
use masonry::system::System;
use nalgebra::Vector2;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// What a random wall is made of.
#[derive(Debug, Clone)]
struct Recipe {
    brick: Brick,
    /// Width of the wall in quarters of a brick.
    quarters: u32,
    courses: u32,
    mu: f64,
    /// Young's modulus, kN/m2, and Poisson's ratio; rigid without.
    elastic: Option<(f64, f64)>,
    mesh: [u32; 2],
    heavy: bool,
    pressure: f64,
    /// The loaded part of the top, as fractions of its width.
    loaded: [f64; 2],
    /// Horizontal force on everything as a fraction of the weight.
    lean: f64,
    walls: [bool; 2],
}

fn recipes() -> impl Strategy<Value = Recipe> {
    let shape = (0.1..0.4, 0.05..0.2, 4_u32..=13, 1_u32..=4, [1_u32..=3, 1_u32..=2]);
    let matter = (0.2..1.2, proptest::option::weighted(0.75, (4.0..7.0, 0.0..0.4)), any::<bool>());
    let lean = prop_oneof![Just(0.0), 0.0..0.2];
    let forces = (1.0..100.0, 0.0..0.4, 0.6..1.0, lean, any::<[bool; 2]>());
    (shape, matter, forces).prop_map(|(shape, matter, forces)| {
        let (length, height, quarters, courses, mesh) = shape;
        let (mu, elastic, heavy) = matter;
        let (pressure, from, to, lean, walls) = forces;
        Recipe {
            brick: Brick { length, height },
            quarters,
            courses,
            mu,
            elastic: elastic.map(|(exponent, nu)| (10_f64.powf(exponent), nu)),
            mesh,
            heavy,
            pressure,
            loaded: [from, to],
            lean,
            walls,
        }
    })
}

impl Recipe {
    fn width(&self) -> f64 {
        0.25 * f64::from(self.quarters) * self.brick.length
    }

    fn height(&self) -> f64 {
        f64::from(self.courses) * self.brick.height
    }

    /// The wall between `x = 0` and its width, all loads multiplied by `factor`.
    fn scene(&self, factor: f64) -> Scene {
        self.place(factor, false)
    }

    /// The mirror image of the wall, between minus its width and 0.
    fn mirrored(&self) -> Scene {
        self.place(1.0, true)
    }

    fn place(&self, factor: f64, mirrored: bool) -> Scene {
        let (width, height) = (self.width(), self.height());
        let side = if mirrored { -1.0 } else { 1.0 };
        let at = |x: f64, y: f64| [side * x, y];
        let material = match self.elastic {
            Some((young, poisson)) => Material::elastic(young, poisson),
            None => Material::rigid(),
        };
        let material = if self.heavy { material.density(1800.0) } else { material };
        let joint = Joint::mu(self.mu);
        let mut scene = Scene::new("Random wall", M_KN)
            .plane(Plane::Stress)
            .thickness(0.25)
            .gravity([side * factor * self.lean * GRAVITY, -factor * GRAVITY])
            .material("brick", material)
            .joint("bed", joint.clone())
            .joint("head", joint)
            .support(Support::new("floor", at(0.0, 0.0), at(width, 0.0), "bed"));
        for (name, there, x) in [("near", self.walls[0], 0.0), ("far", self.walls[1], width)] {
            if there {
                scene = scene.support(Support::new(name, at(x, 0.0), at(x, height), "head"));
            }
        }
        let [from, to] = self.loaded.map(|share| at(share * width, height));
        let top = [factor * self.lean * self.pressure * side, -factor * self.pressure];
        scene = scene.load(Load::traction("top", from, to, top));
        let wall = Wall::running_bond("wall", "brick", self.brick, width, self.courses);
        for brick in bond::bricks(&wall) {
            let mesh = brick.mesh(self.mesh).map(|count| u32::try_from(count).unwrap());
            let [a, b, c, d] = brick.corners().map(|[x, y]| at(x, y));
            let corners = if mirrored { [b, a, d, c] } else { [a, b, c, d] };
            scene = scene.block(Block::new(&brick.name(&wall), "brick", corners).mesh(mesh));
        }
        scene
    }
}

/// The largest violation of the conditions (3.27) of a scene by the forces and relative
/// displacements of all rows. Zero, but for rounding, for an answer, whether or not it is the only
/// one.
///
/// In the units of the form, in which loads and compliances are of order one: where nothing moves
/// all displacements are rounding errors, and there is nothing among them to compare with.
fn violation(scene: &Scene, rows: &RowState) -> f64 {
    let model = Model::from_scene(scene).unwrap();
    let system = System::new(&model).unwrap();
    let reduction = Reduction::new(&system, None).unwrap();
    let form = DenseForm::new(FormKind::Coulomb, &system, &reduction).unwrap();
    let (t, y) = form.pairs(rows, &[], &[]);
    let (a, b, c) = (form.problem.a(), form.problem.b(), form.problem.c());
    let equation = |i: usize| -> f64 {
        let terms = (0..form.order()).map(|j| a[(i, j)] * t[j] + b[(i, j)] * y[j]);
        terms.sum::<f64>() - c[i]
    };
    let complementarity = |i: usize| t[i].min(y[i]);
    (0..form.order()).fold(0.0, |m: f64, i| m.max(equation(i).abs()).max(complementarity(i).abs()))
}

/// The rows of an outcome: normal forces and gaps, then those along the tangents.
fn rows(contacts: &[PointState], factor: f64, side: f64) -> RowState {
    let rows = |normal: fn(&PointState) -> f64, tangent: fn(&PointState) -> f64| {
        let normals = contacts.iter().map(|it| factor * normal(it));
        normals.chain(contacts.iter().map(|it| factor * side * tangent(it))).collect()
    };
    RowState { t: rows(|it| it.t_n, |it| it.t_t), y: rows(|it| it.y_n, |it| it.y_t) }
}

/// The contact points of a scene, each with the names of its sides and its place.
fn points(model: &Model, side: f64) -> Vec<([&str; 2], Vector2<f64>)> {
    let name = |body: Body| match body {
        Body::Block(id) => model.blocks[id.index()].name.as_str(),
        Body::Support(id) => model.supports[id.index()].name.as_str(),
    };
    let point = |contact: &JointPoint| {
        let joint = &model.joints[contact.joint.index()];
        let mut sides = [name(joint.a), name(Body::Block(joint.b))];
        sides.sort_unstable();
        (sides, Vector2::new(side * contact.position.x, contact.position.y))
    };
    model.contacts.iter().map(point).collect()
}

/// The contact states of a mirror image, in the order of the points of the original.
///
/// Beds keep their normals and reverse their tangents; heads and walls keep both but swap their
/// sides. Either way forces and slips along the tangent change sign.
fn unmirrored(original: &Outcome, mirrored: &Outcome) -> Vec<PointState> {
    let (places, images) = (points(&original.model, 1.0), points(&mirrored.model, -1.0));
    assert_eq!(places.len(), images.len());
    let near = 1e-9 * places.iter().fold(0.0, |m: f64, (_, p)| m.max(p.amax()));
    let image = |(sides, place): &([&str; 2], Vector2<f64>)| {
        let same = |it: &([&str; 2], Vector2<f64>)| it.0 == *sides && (it.1 - place).amax() < near;
        state(mirrored).contacts[images.iter().position(same).unwrap()]
    };
    places.iter().map(image).collect()
}

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 96,
        rng_seed: RngSeed::Fixed(19_970_701),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(config())]

    /// A wall that stands is balanced; one that does not has a way to fall, and carries no
    /// vertical load alone.
    #[test]
    fn walls_are_balanced(recipe in recipes()) {
        let outcome = solve(&recipe.scene(1.0)).unwrap();
        if outcome.solve.status == Status::Solved {
            assert_sound(&outcome, 1e-9);
            let load = applied_load(&outcome.model);
            let reaction: Vector2<f64> =
                outcome.reactions.iter().map(|it| Vector2::new(it.fx, it.fy)).sum();
            prop_assert!((load + reaction).norm() <= 1e-9 * load.norm(), "{load} {reaction}");
        } else {
            prop_assert_eq!(outcome.solve.status, Status::RayTermination);
            prop_assert!(recipe.lean > 0.0, "a vertical load has a way down to the floor");
            assert_admissible(&outcome);
        }
    }

    /// Four times the load makes four times the forces and displacements, bit by bit; another
    /// multiple makes an answer that is an answer of the first problem when it is divided again.
    #[test]
    fn answers_are_proportional_to_loads(recipe in recipes(), factor in 0.01..100.0) {
        let scene = recipe.scene(1.0);
        let once = solve(&scene).unwrap();
        let four = solve(&recipe.scene(4.0)).unwrap();
        prop_assert_eq!(once.solve.status, four.solve.status);
        prop_assert_eq!(&once.solve.attempts, &four.solve.attempts);
        let other = solve(&recipe.scene(factor)).unwrap();
        prop_assert_eq!(once.solve.status, other.solve.status);
        if once.solve.status == Status::Solved {
            let quarter = rows(&state(&four).contacts, 0.25, 1.0);
            prop_assert_eq!(rows(&state(&once).contacts, 1.0, 1.0), quarter);
            let undone = rows(&state(&other).contacts, 1.0 / factor, 1.0);
            prop_assert!(violation(&scene, &undone) <= 1e-9);
            let doubled = rows(&state(&once).contacts, 2.0, 1.0);
            prop_assert!(violation(&scene, &doubled) > 1e-6, "the measure is blind");
        }
    }

    /// The mirror image of an answer is an answer of the mirror image.
    #[test]
    fn mirror_images_have_mirrored_answers(recipe in recipes()) {
        let scene = recipe.scene(1.0);
        let (outcome, image) = (solve(&scene).unwrap(), solve(&recipe.mirrored()).unwrap());
        prop_assert_eq!(outcome.solve.status, image.solve.status);
        if outcome.solve.status == Status::Solved {
            let states = unmirrored(&outcome, &image);
            prop_assert!(violation(&scene, &rows(&states, 1.0, -1.0)) <= 1e-9);
        }
    }
}
