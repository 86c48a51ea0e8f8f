//! The physical effects of a plan: for each, the reason why it is on or off, its unknowns and its cost.

use std::collections::BTreeSet;

use serde::Serialize;

use super::sizes::{PlannedRoute, Sizes};
use crate::history::moving_supports;
use crate::law::JointLaw;
use crate::model::Model;
use crate::scene::{Films, LoadKind, Route, Scene};

/// A physical effect of a plan, such as friction: whether it is on, why, and what it costs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Effect {
    /// Name of the effect, such as `friction`.
    pub name: &'static str,
    /// Whether the effect is part of the equations that are built.
    pub on: bool,
    /// The reason why the effect is on or off: a property of the scene.
    pub because: String,
    /// Number of unknowns that the effect adds to the [`order`](super::Plan::order) of the plan for the same contact
    /// points. Displacements count only on routes that do not eliminate them; the pivoting route does.
    pub unknowns: usize,
    /// The expected cost of the effect on the first route, in words; `none` if the effect is off.
    pub cost: String,
}

/// Lists all effects that a scene can need, with their costs on the route that is tried first.
pub(super) fn of(scene: &Scene, model: &Model, sizes: &Sizes, first: &PlannedRoute) -> Vec<Effect> {
    let it = Called { scene, model, sizes, first };
    let history = it.load_history();
    let dissipation = dissipation(&history);
    vec![
        it.contact(),
        it.friction(),
        it.cohesion(),
        it.tension(),
        it.joint_stiffness(),
        it.mortar_films(),
        it.longitudinal_terms(),
        it.deformation(),
        it.self_weight(),
        it.edge_loads(),
        it.point_loads(),
        it.body_acceleration(),
        it.stresses(),
        it.dense_matrices(),
        history,
        it.support_movements(),
        dissipation,
    ]
}

/// Returns the number of steps that are solved: one, unless the answer depends on the load path.
pub(super) fn steps(scene: &Scene, model: &Model) -> usize {
    if model.depends_on_way(scene) { scene.steps() } else { 1 }
}

/// Words for the cost of effects that change only the right-hand side, which the equations have anyway.
const RIGHT_HAND_SIDE: &str = "numbers on the right-hand side only";

impl Effect {
    fn off(name: &'static str, because: impl Into<String>) -> Self {
        Self { name, on: false, because: because.into(), unknowns: 0, cost: "none".to_owned() }
    }

    /// Makes an effect that is on and adds no unknowns.
    fn on(name: &'static str, because: impl Into<String>, cost: impl Into<String>) -> Self {
        Self { name, on: true, because: because.into(), unknowns: 0, cost: cost.into() }
    }

    /// Replaces the cost of the effect by `cost` if the effect adds no unknowns.
    fn costing_without_unknowns(self, cost: String) -> Self {
        if self.unknowns == 0 { Self { cost, ..self } } else { self }
    }
}

/// The data that decide which effects are on.
struct Called<'a> {
    scene: &'a Scene,
    model: &'a Model,
    sizes: &'a Sizes,
    /// The route that is tried first.
    first: &'a PlannedRoute,
}

impl Called<'_> {
    fn contact(&self) -> Effect {
        let limit = self.scene.contact.gap_limit;
        let near = if limit > 0.0 {
            format!("come within {limit} {}", self.scene.units.length_name())
        } else {
            "touch".to_owned()
        };
        let because = format!("{} of bodies that {near}", count(self.model.joints.len(), "joint"));
        let without = self.sizes.with(|it| it.presses = false);
        let effect = self.beside("contact", because, &without);
        Effect { cost: "a row for each point".to_owned(), ..effect }
    }

    fn friction(&self) -> Effect {
        let name = "friction";
        if self.sizes.frictional() == 0 {
            return Effect::off(name, "mu = 0 in all joints");
        }
        let coulomb = self.classes(|law| law.mu > 0.0);
        let because = if coulomb.is_empty() {
            format!("cohesion in {}", self.classes(JointLaw::resists_sliding))
        } else {
            format!("mu > 0 in {coulomb}")
        };
        let without = self.sizes.with(|it| {
            (it.coulomb, it.cohesive, it.sheared) = (false, false, false);
        });
        self.beside(name, because, &without)
    }

    /// Describes the effect of cohesion: a constant on the right-hand side if pivots are used, and one more point and
    /// displacement on the sparse routes.
    fn cohesion(&self) -> Effect {
        let used = self.classes(|law| law.cohesion > 0.0);
        if used.is_empty() {
            return Effect::off("cohesion", "no joint has cohesion");
        }
        // Only `cohesive` changes: points that slide keep their compliances along the joint.
        let without = self.sizes.with(|it| it.cohesive = false);
        let effect = self.beside("cohesion", format!("cohesion given for {used}"), &without);
        effect.costing_without_unknowns(RIGHT_HAND_SIDE.to_owned())
    }

    fn tension(&self) -> Effect {
        let used = self.classes(|law| law.tension > 0.0);
        if used.is_empty() {
            return Effect::off("tension", "no joint has tensile strength");
        }
        Effect::on("tension", format!("tension given for {used}"), RIGHT_HAND_SIDE)
    }

    /// Describes the effect of joint stiffness: each point has a compliance perpendicular to the joint and, with
    /// friction, one along it. The compliances are numbers on the diagonal of the contact rows. On the sparse routes
    /// the deformation that friction and cohesion share is one more displacement.
    fn joint_stiffness(&self) -> Effect {
        let name = "joint stiffness";
        let used = self.classes(|law| law.stiffness.is_some());
        let dry = self.model.dry_joints();
        let mut causes = Vec::new();
        if !used.is_empty() {
            causes.push(format!("stiffness given for {used}"));
        }
        if dry > 0 {
            causes
                .push(format!("rigid blocks in a load history: {dry} joints as stiff as dry ones"));
        }
        if causes.is_empty() {
            return Effect::off(name, "no joint has a stiffness");
        }
        let compliances = count(self.sizes.rows(|it| it.stiff), "compliance");
        let because = format!("{}: {compliances}", causes.join("; "));
        self.giving_way(name, because, &self.sizes.with(|it| it.stiff = false), &compliances)
    }

    /// Describes the effect of mortar films: each point has a compliance perpendicular to the joint and, with
    /// friction, one along it. The compliances are numbers on the diagonal of the contact rows. On the sparse routes
    /// the deformation that friction and cohesion share is one more displacement, except with films as strips in the
    /// augmented Lagrangian method.
    fn mortar_films(&self) -> Effect {
        let name = "mortar films";
        let films = self.films();
        if films == 0 {
            let mut classes = self.scene.joints.values();
            let is_given = classes.any(|joint| joint.mortar_thickness() > 0.0);
            return Effect::off(
                name,
                if is_given {
                    "no joint belongs to a class with a thickness"
                } else {
                    "no joint class has a thickness: all joints are dry"
                },
            );
        }
        let filled = self.model.joints.iter().filter(|joint| joint.film.is_some());
        let filled = names(filled.map(|joint| &*self.model.joint_classes[joint.class].name));
        let compliances = count(self.sizes.rows(|it| it.film), "compliance");
        let because =
            format!("thickness given for {filled}: {}, {compliances}", count(films, "film"));
        self.giving_way(name, because, &self.sizes.without_films(), &compliances)
    }

    /// Describes the effect of strips: each point at an elastic block has the stiffness of a bar along the joint, and
    /// its gap has a term from the strain at the point. Stiffness and term add no unknowns, except the forces of the
    /// bars in the mixed form.
    fn longitudinal_terms(&self) -> Effect {
        let name = "longitudinal film terms";
        if self.sizes.bars == 0 {
            let because = if self.films() == 0 {
                "there are no mortar films"
            } else if self.scene.contact.films == Films::Compliance {
                "contact.films = \"compliance\": films act across their joints only"
            } else {
                "rigid blocks stretch no film"
            };
            return Effect::off(name, because);
        }
        let bars = count(self.sizes.bars, "bar");
        let because = format!("contact.films = \"strips\": {bars} along the joints");
        let cost = if self.pivots() {
            format!("a dense matrix of {bars}, which couples all blocks in A")
        } else {
            "entries of K between the blocks on both sides".to_owned()
        };
        Effect { cost, ..self.beside(name, because, &self.sizes.without_bars()) }
    }

    fn deformation(&self) -> Effect {
        let name = "deformation";
        if self.sizes.nodal == 0 {
            return Effect::off(name, "no material of a block has E: all blocks are rigid");
        }
        let materials = &self.scene.materials;
        let is_elastic = |name: &&str| materials.get(*name).is_some_and(|it| it.young.is_some());
        let because =
            format!("E given for {}", names(self.scene.used_materials().filter(is_elastic)));
        let effect = self.beside(name, because, &self.sizes.without_deformation());
        if !self.pivots() {
            return effect;
        }
        let displacements = count(self.sizes.nodal, "displacement");
        Effect { cost: format!("{displacements}, eliminated block by block; a dense A"), ..effect }
    }

    fn self_weight(&self) -> Effect {
        let name = "self weight";
        let pulls = self.model.gravity.norm() > 0.0;
        let missing = match (pulls, self.heavy_blocks() > 0) {
            (true, true) => {
                let materials = self.scene.materials.iter();
                let given = materials.filter(|(_, material)| material.density.is_some());
                let given = names(given.map(|(name, _)| name.as_str()));
                let because = format!("gravity, and density given for {given}");
                return Effect::on(name, because, RIGHT_HAND_SIDE);
            }
            (true, false) => "no material of a block has a density",
            (false, true) => "the scene gives no gravity",
            (false, false) => "the scene gives neither gravity nor density",
        };
        Effect::off(name, missing)
    }

    fn edge_loads(&self) -> Effect {
        let edges = self.model.blocks.iter().map(|block| block.edge_loads().count()).sum();
        let place = format!("on {}", count(edges, "edge"));
        let is_kind = |kind: LoadKind<'_>| {
            matches!(kind, LoadKind::Edge { .. } | LoadKind::Fill(_) | LoadKind::Axle(_))
        };
        self.loads("edge loads", is_kind, &place, "acts on an edge")
    }

    fn point_loads(&self) -> Effect {
        let is_kind =
            |kind: LoadKind<'_>| matches!(kind, LoadKind::Force { .. } | LoadKind::Moment { .. });
        self.loads(
            "point loads",
            is_kind,
            "at places of blocks",
            "is a force or a moment on a block",
        )
    }

    fn body_acceleration(&self) -> Effect {
        let place = format!("on {}", count(self.heavy_blocks(), "block"));
        let is_kind = |kind: LoadKind<'_>| matches!(kind, LoadKind::Acceleration(_));
        self.loads("body acceleration", is_kind, &place, "is an acceleration")
    }

    fn stresses(&self) -> Effect {
        let name = "stresses";
        if !self.scene.output.stresses {
            return Effect::off(name, "output.stresses = false");
        }
        let meshes = self.model.blocks.iter().filter_map(|block| block.mesh.as_ref());
        let elements: usize = meshes.map(|mesh| mesh.elements.len()).sum();
        let places = [(elements, "element"), (self.films(), "film")];
        let places = places.into_iter().filter(|(number, _)| *number > 0);
        let places: Vec<String> = places.map(|(number, what)| count(number, what)).collect();
        if places.is_empty() {
            return Effect::off(name, "rigid blocks have none");
        }
        let because = format!("output shows them in {}", places.join(" and "));
        Effect::on(name, because, "once, after the solve")
    }

    fn dense_matrices(&self) -> Effect {
        let (name, route) = ("dense matrices", self.first.route.name());
        if self.first.dense_numbers == 0 {
            return Effect::off(name, format!("the route {route} works on sparse matrices"));
        }
        let because = format!("the route {route} works on the problem reduced to contact forces");
        let cost = format!("{:.0e} numbers at the peak", self.first.dense_numbers as f64);
        Effect::on(name, because, cost)
    }

    fn load_history(&self) -> Effect {
        let name = "load history";
        let (stages, asked) = (self.scene.stages.len(), self.scene.steps());
        match (stages, asked, steps(self.scene, self.model)) {
            (0, ..) => Effect::off(name, "the scene has no stages: all loads act at once"),
            (_, 1, _) => Effect::off(name, "one stage of one step: the law of one step"),
            (_, _, 1) => {
                let because = "mu = 0 in all joints: the last state does not depend on the way";
                Effect::off(name, because)
            }
            (_, _, steps) => {
                let stages = count(stages, "stage");
                let because =
                    format!("{stages} of {asked} steps in all, and friction: slip is carried over");
                Effect::on(name, because, format!("{steps} solves instead of one"))
            }
        }
    }

    fn support_movements(&self) -> Effect {
        let name = "support movements";
        let moving = moving_supports(self.scene).join(", ");
        if moving.is_empty() {
            return Effect::off(name, "no stage moves a support");
        }
        let because = format!("stages move {moving}: gaps and slips are shifted");
        Effect::on(name, because, RIGHT_HAND_SIDE)
    }

    /// Describes an effect that is on; `without` are the sizes if the effect were off.
    fn beside(&self, name: &'static str, because: String, without: &Sizes) -> Effect {
        let without = without.choice(self.first.route, self.scene.solver.form);
        let unknowns = self.first.order.saturating_sub(without.order);
        Effect { unknowns, ..Effect::on(name, because, self.growth(&without)) }
    }

    /// Describes an effect that is on and adds compliances to the contact rows; `without` are the sizes if the effect
    /// were off. The words `compliances` describe the cost if the effect adds no unknowns.
    fn giving_way(
        &self,
        name: &'static str,
        because: String,
        without: &Sizes,
        compliances: &str,
    ) -> Effect {
        let cost = format!("{compliances} on the diagonal of the contact rows");
        self.beside(name, because, without).costing_without_unknowns(cost)
    }

    /// Describes the growth of the cost in words. Storage in dense matrices grows with the square of the order, and
    /// the work of pivots with its cube; storage and work of sparse factorisations grow with the memory.
    fn growth(&self, without: &PlannedRoute) -> String {
        let (order, before) = (self.first.order, without.order);
        if order <= before {
            return "no unknowns of the linear systems".to_owned();
        }
        let ratio = |a: usize, b: usize| a as f64 / b.max(1) as f64;
        let change = if self.pivots() {
            let ratio = ratio(order, before);
            let (numbers, work) = (times(ratio.powi(2)), times(ratio.powi(3)));
            format!("{numbers} the numbers, {work} the work of pivots")
        } else {
            format!("{} the memory", times(ratio(self.first.memory_bytes, without.memory_bytes)))
        };
        format!("order {order} instead of {before}: {change}")
    }

    fn pivots(&self) -> bool {
        self.first.route == Route::Lemke
    }

    /// Lists the names of the joint classes whose law has a property.
    fn classes(&self, has: impl Fn(&JointLaw) -> bool) -> String {
        let used = self.model.joints.iter().map(|joint| &self.model.joint_classes[joint.class]);
        names(used.filter(|class| has(&class.law)).map(|class| class.name.as_str()))
    }

    /// Counts the joints with mortar.
    fn films(&self) -> usize {
        self.model.joints.iter().filter(|joint| joint.film.is_some()).count()
    }

    fn heavy_blocks(&self) -> usize {
        self.model.blocks.iter().filter(|block| block.density.is_some()).count()
    }

    /// Describes the effect of the loads of one kind, which act at `place`. The effect is off, with the reason
    /// `missing`, if there is no such load.
    fn loads(
        &self,
        name: &'static str,
        is_kind: impl Fn(LoadKind<'_>) -> bool,
        place: &str,
        missing: &str,
    ) -> Effect {
        let loads = &self.scene.loads;
        let of_kind = loads.iter().filter(|load| load.kind().is_some_and(&is_kind));
        let called: Vec<&str> = of_kind.map(|load| load.name.as_str()).collect();
        if !called.is_empty() {
            return Effect::on(name, format!("{} {place}", called.join(", ")), RIGHT_HAND_SIDE);
        }
        if loads.is_empty() {
            return Effect::off(name, "the scene gives no loads");
        }
        Effect::off(name, format!("no load of the scene {missing}"))
    }
}

fn dissipation(history: &Effect) -> Effect {
    let name = "dissipation";
    if !history.on {
        return Effect::off(name, "there is no load history");
    }
    let because = "friction and a load history";
    Effect::on(name, because, "a sum over contact points in every step")
}

fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

/// Lists each of the names once, in alphabetical order.
fn names<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<BTreeSet<_>>().into_iter().collect::<Vec<_>>().join(", ")
}

fn times(ratio: f64) -> String {
    if ratio < 10.0 { format!("{ratio:.1} times") } else { format!("{ratio:.0} times") }
}
