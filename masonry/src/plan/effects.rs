//! What calls for each effect, and what it costs.

use std::collections::BTreeSet;

use super::choice::Choice;
use super::effect::Effect;
use super::sizes::Sizes;
use crate::law::JointLaw;
use crate::model::{Block, Model};
use crate::scene::{Films, Form, LoadKind, Route, Scene};

/// All effects that a scene can call for in a single step, for the route that is tried first.
pub(super) fn of(scene: &Scene, model: &Model, sizes: &Sizes, first: &Choice) -> Vec<Effect> {
    let route = FirstRoute { with: first, form: scene.solver.form };
    vec![
        contact(scene, model, sizes, &route),
        friction(model, sizes, &route),
        cohesion(model, sizes, &route),
        tension(model),
        joint_stiffness(model, sizes, &route),
        mortar_films(scene, model, sizes, &route),
        longitudinal_terms(scene, model, sizes, &route),
        deformation(scene, sizes, &route),
        self_weight(scene, model),
        edge_loads(scene, model),
        point_loads(scene),
        body_acceleration(scene, model),
        stresses(scene, model),
        dense_matrices(&route),
    ]
}

/// The right-hand side of the equations is there anyway.
pub(super) const RIGHT_HAND_SIDE: &str = "numbers on the right-hand side only";

/// The route that is tried first.
struct FirstRoute<'a> {
    with: &'a Choice,
    form: Form,
}

impl FirstRoute<'_> {
    fn pivots(&self) -> bool {
        self.with.route == Route::Lemke
    }

    /// An effect without which the sizes would be these.
    fn on(&self, name: &'static str, because: String, without: &Sizes) -> Effect {
        let without = without.choice(self.with.route, self.form);
        let unknowns = self.with.order.saturating_sub(without.order);
        Effect { unknowns, ..Effect::on(name, because, self.growth(&without)) }
    }

    /// Numbers in dense matrices grow with the square of the order and the work of pivots with its cube; both
    /// of sparse factorisations like the memory.
    fn growth(&self, without: &Choice) -> String {
        let (order, before) = (self.with.order, without.order);
        let ratio = |a: usize, b: usize| a as f64 / b.max(1) as f64;
        let times = |ratio: f64| format!("{} times", rounded(ratio));
        if order <= before {
            "no unknowns of the linear systems".to_owned()
        } else if self.pivots() {
            let ratio = ratio(order, before);
            let (numbers, work) = (times(ratio.powi(2)), times(ratio.powi(3)));
            format!(
                "order {order} instead of {before}: {numbers} the numbers, {work} the work of pivots"
            )
        } else {
            let memory = times(ratio(self.with.memory_bytes, without.memory_bytes));
            format!("order {order} instead of {before}: {memory} the memory")
        }
    }
}

fn contact(scene: &Scene, model: &Model, sizes: &Sizes, route: &FirstRoute) -> Effect {
    let limit = scene.contact.gap_limit;
    let near = if limit > 0.0 {
        format!("come within {limit} {}", scene.units.length_name())
    } else {
        "touch".to_owned()
    };
    let because = format!("{} of bodies that {near}", count(model.joints.len(), "joint"));
    let effect = route.on("contact", because, &sizes.without_contact());
    Effect { cost: "a row for each point".to_owned(), ..effect }
}

fn friction(model: &Model, sizes: &Sizes, route: &FirstRoute) -> Effect {
    let used = classes_in_use(model, JointLaw::resists_sliding);
    if sizes.frictional == 0 {
        return Effect::off("friction", "mu = 0 in all joints".to_owned());
    }
    let coulomb = classes_in_use(model, |law| law.mu > 0.0);
    let because = if coulomb.is_empty() {
        format!("cohesion in {}", names(used.into_iter()))
    } else {
        format!("mu > 0 in {}", names(coulomb.into_iter()))
    };
    route.on("friction", because, &sizes.without_friction())
}

/// A constant on the right-hand side by pivots; on the sparse routes a point and a displacement more.
fn cohesion(model: &Model, sizes: &Sizes, route: &FirstRoute) -> Effect {
    let used = classes_in_use(model, |law| law.cohesion > 0.0);
    if used.is_empty() {
        return Effect::off("cohesion", "no joint has cohesion".to_owned());
    }
    let because = format!("cohesion given for {}", names(used.into_iter()));
    let effect = route.on("cohesion", because, &sizes.without_cohesion());
    if effect.unknowns == 0 {
        return Effect { cost: RIGHT_HAND_SIDE.to_owned(), ..effect };
    }
    effect
}

fn tension(model: &Model) -> Effect {
    let used = classes_in_use(model, |law| law.tension > 0.0);
    if used.is_empty() {
        return Effect::off("tension", "no joint has tensile strength".to_owned());
    }
    let because = format!("tension given for {}", names(used.into_iter()));
    Effect::on("tension", because, RIGHT_HAND_SIDE.to_owned())
}

/// Each point gives way across its joint and, with friction, along it: numbers on the diagonal of its contact rows. On the
/// sparse routes what friction and cohesion share is a displacement.
fn joint_stiffness(model: &Model, sizes: &Sizes, route: &FirstRoute) -> Effect {
    let name = "joint stiffness";
    let used = classes_in_use(model, |law| law.stiffness.is_some());
    let dry = model.dry_joints();
    if used.is_empty() && dry == 0 {
        return Effect::off(name, "no joint has a stiffness".to_owned());
    }
    let compliances = count(sizes.of_stiff_joints(), "compliance");
    let mut causes = Vec::new();
    if !used.is_empty() {
        causes.push(format!("stiffness given for {}", names(used.into_iter())));
    }
    if dry > 0 {
        causes.push(format!("rigid blocks in a load history: {dry} joints as stiff as dry ones"));
    }
    let because = format!("{}: {compliances}", causes.join("; "));
    on_the_diagonal(route.on(name, because, &sizes.without_joint_stiffness()), &compliances)
}

/// An effect that only adds numbers to the contact rows, unless it has unknowns.
fn on_the_diagonal(effect: Effect, compliances: &str) -> Effect {
    if effect.unknowns > 0 {
        return effect;
    }
    Effect { cost: format!("{compliances} on the diagonal of the contact rows"), ..effect }
}

/// The names of the classes of the joints whose law has something.
fn classes_in_use(model: &Model, has: impl Fn(&JointLaw) -> bool) -> BTreeSet<&str> {
    let used = model.joints.iter().map(|joint| &model.joint_classes[joint.class]);
    used.filter(|class| has(&class.law)).map(|class| class.name.as_str()).collect()
}

/// Each point of a film has a compliance across and, with friction, one along the joint: numbers on the diagonal of its
/// contact rows. The deformation shared by friction and cohesion is a displacement on the sparse routes, except
/// with whole strips of the augmented Lagrangian method.
fn mortar_films(scene: &Scene, model: &Model, sizes: &Sizes, route: &FirstRoute) -> Effect {
    let name = "mortar films";
    let films = model.joints.iter().filter(|joint| joint.film.is_some()).count();
    let filled: BTreeSet<&str> = model
        .joints
        .iter()
        .filter(|joint| joint.film.is_some())
        .map(|joint| model.joint_classes[joint.class].name.as_str())
        .collect();
    let given = scene.joints.values().any(|joint| joint.mortar_thickness() > 0.0);
    if films == 0 {
        let because = if given {
            "no joint belongs to a class with a thickness"
        } else {
            "no joint class has a thickness: all joints are dry"
        };
        return Effect::off(name, because.to_owned());
    }
    let compliances = count(sizes.of_films(), "compliance");
    let films = count(films, "film");
    let because =
        format!("thickness given for {}: {films}, {compliances}", names(filled.into_iter()));
    on_the_diagonal(route.on(name, because, &sizes.without_films()), &compliances)
}

/// Each point of a strip at an elastic block has the stiffness of a bar along the joint, and its gap a term
/// by the strain there. Neither is an unknown, except the forces of the bars in the mixed form.
fn longitudinal_terms(scene: &Scene, model: &Model, sizes: &Sizes, route: &FirstRoute) -> Effect {
    let name = "longitudinal film terms";
    let has_films = model.joints.iter().any(|joint| joint.film.is_some());
    if sizes.bars == 0 {
        let because = if !has_films {
            "there are no mortar films"
        } else if scene.contact.films == Films::Compliance {
            "contact.films = \"compliance\": films act across their joints only"
        } else {
            "rigid blocks stretch no film"
        };
        return Effect::off(name, because.to_owned());
    }
    let bars = count(sizes.bars, "bar");
    let because = format!("contact.films = \"strips\": {bars} along the joints");
    let effect = route.on(name, because, &sizes.without_bars());
    let cost = if route.pivots() {
        format!("a dense matrix of {bars}, which couples all blocks in A")
    } else {
        "entries of K between the blocks on both sides".to_owned()
    };
    Effect { cost, ..effect }
}

fn deformation(scene: &Scene, sizes: &Sizes, route: &FirstRoute) -> Effect {
    if sizes.nodal == 0 {
        let because = "no material of a block has E: all blocks are rigid";
        return Effect::off("deformation", because.to_owned());
    }
    let used: BTreeSet<&str> = scene.used_materials().collect();
    let elastic = |name: &&str| scene.materials.get(*name).is_some_and(|m| m.young.is_some());
    let because = format!("E given for {}", names(used.into_iter().filter(elastic)));
    let effect = route.on("deformation", because, &sizes.without_deformation());
    if route.pivots() {
        let displacements = count(sizes.nodal, "displacement");
        let cost = format!("{displacements}, eliminated block by block; a dense A");
        return Effect { cost, ..effect };
    }
    effect
}

fn self_weight(scene: &Scene, model: &Model) -> Effect {
    let name = "self weight";
    let pulls = model.gravity.norm() > 0.0;
    let heavy = model.blocks.iter().any(|block| block.density.is_some());
    let missing = match (pulls, heavy) {
        (true, true) => {
            let given = scene.materials.iter().filter(|(_, material)| material.density.is_some());
            let given = names(given.map(|(name, _)| name.as_str()));
            let because = format!("gravity, and density given for {given}");
            return Effect::on(name, because, RIGHT_HAND_SIDE.to_owned());
        }
        (true, false) => "no material of a block has a density",
        (false, true) => "the scene gives no gravity",
        (false, false) => "the scene gives neither gravity nor density",
    };
    Effect::off(name, missing.to_owned())
}

fn edge_loads(scene: &Scene, model: &Model) -> Effect {
    let edges: usize = model.blocks.iter().map(|block| block.edge_loads().count()).sum();
    let called = called(scene, |kind| matches!(kind, LoadKind::Edge { .. }));
    loads("edge loads", scene, called, "acts on an edge", |loads| {
        format!("{loads} on {}", count(edges, "edge"))
    })
}

fn point_loads(scene: &Scene) -> Effect {
    let called = called(scene, |kind| matches!(kind, LoadKind::Force { .. }));
    loads("point loads", scene, called, "is a force on a block", |loads| {
        format!("{loads} at places of blocks")
    })
}

fn body_acceleration(scene: &Scene, model: &Model) -> Effect {
    let heavy = model.blocks.iter().filter(|block| block.density.is_some()).count();
    let called = called(scene, |kind| matches!(kind, LoadKind::Acceleration(_)));
    loads("body acceleration", scene, called, "is an acceleration", |loads| {
        format!("{loads} on {}", count(heavy, "block"))
    })
}

/// The names of the loads of a kind.
fn called(scene: &Scene, is_kind: impl Fn(LoadKind<'_>) -> bool) -> String {
    let of_kind = scene.loads.iter().filter(|load| load.kind().is_some_and(&is_kind));
    names(of_kind.map(|load| load.name.as_str()))
}

/// The effect of the loads of a kind, which are named, or none.
fn loads(
    name: &'static str,
    scene: &Scene,
    called: String,
    kind: &str,
    because: impl FnOnce(String) -> String,
) -> Effect {
    if !called.is_empty() {
        return Effect::on(name, because(called), RIGHT_HAND_SIDE.to_owned());
    }
    let missing = if scene.loads.is_empty() {
        "the scene gives no loads".to_owned()
    } else {
        format!("no load of the scene {kind}")
    };
    Effect::off(name, missing)
}

fn stresses(scene: &Scene, model: &Model) -> Effect {
    let name = "stresses";
    let elements: usize = model.blocks.iter().map(elements).sum();
    let films = model.joints.iter().filter(|joint| joint.film.is_some()).count();
    let places: Vec<String> = [(elements, "element"), (films, "film")]
        .into_iter()
        .filter(|(number, _)| *number > 0)
        .map(|(number, what)| count(number, what))
        .collect();
    if !scene.output.stresses {
        return Effect::off(name, "output.stresses = false".to_owned());
    }
    if places.is_empty() {
        return Effect::off(name, "rigid blocks have none".to_owned());
    }
    let because = format!("output shows them in {}", places.join(" and "));
    Effect::on(name, because, "once, after the solve".to_owned())
}

fn dense_matrices(route: &FirstRoute) -> Effect {
    let name = "dense matrices";
    let numbers = route.with.dense_numbers;
    let route_name = route.with.route.name();
    if numbers == 0 {
        let because = format!("the route {route_name} works on sparse matrices");
        return Effect::off(name, because);
    }
    let because = format!("the route {route_name} works on the problem reduced to contact forces");
    let cost = format!("{:.0e} numbers at the peak", numbers as f64);
    Effect::on(name, because, cost)
}

fn elements(block: &Block) -> usize {
    block.mesh.as_ref().map_or(0, |mesh| mesh.elements.len())
}

fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

fn names<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(", ")
}

fn rounded(ratio: f64) -> String {
    if ratio < 10.0 { format!("{ratio:.1}") } else { format!("{ratio:.0}") }
}
