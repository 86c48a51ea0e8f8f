//! What calls for each effect.

use std::collections::BTreeSet;

use super::{Effect, film_compliances, nodes, stretching_points, unknowns_per_friction};
use crate::model::{Block, Model};
use crate::routes::alm::Strips;
use crate::scene::{Films, Form, Route, Scene};

/// All effects that a scene can call for.
pub(super) fn of(scene: &Scene, model: &Model, route: Route) -> Vec<Effect> {
    vec![
        contact(scene, model),
        friction(scene, model, route),
        mortar_films(scene, model, route),
        longitudinal_terms(scene, model, route),
        deformation(scene, model),
        self_weight(scene, model),
        edge_loads(scene, model),
        stresses(scene, model),
    ]
}

fn contact(scene: &Scene, model: &Model) -> Effect {
    let limit = scene.contact.gap_limit;
    let near = if limit > 0.0 {
        format!("come within {limit} {}", scene.units.length_name())
    } else {
        "touch".to_owned()
    };
    let unknowns = model.contacts.len();
    let because = format!("{} of bodies that {near}", count(model.joints.len(), "joint"));
    Effect { name: "contact", on: unknowns > 0, because, unknowns }
}

fn friction(scene: &Scene, model: &Model, route: Route) -> Effect {
    let points = model.contacts.iter().filter(|point| point.mu > 0.0).count();
    let used: BTreeSet<&str> = model
        .joints
        .iter()
        .map(|joint| &model.joint_classes[joint.class])
        .filter(|class| class.mu > 0.0)
        .map(|class| class.name.as_str())
        .collect();
    let because = if points > 0 {
        format!("mu > 0 in {}", names(used.into_iter()))
    } else {
        "mu = 0 in all joints".to_owned()
    };
    let form = if route == Route::Lemke { scene.solver.form } else { Form::Coulomb };
    let unknowns = unknowns_per_friction(form) * points;
    Effect { name: "friction", on: points > 0, because, unknowns }
}

/// Each point of a film has a compliance across and, with friction, one along the joint. By pivots they
/// are added to the diagonal of `A` without new unknowns; on the sparse routes each is a displacement,
/// but where the augmented Lagrangian method has whole strips.
fn mortar_films(scene: &Scene, model: &Model, route: Route) -> Effect {
    let films = model.joints.iter().filter(|joint| joint.film.is_some()).count();
    let compliances = film_compliances(model);
    let without = route == Route::Lemke || route == Route::Alm && Strips::are_in(model);
    let unknowns = if without { 0 } else { compliances };
    let filled: BTreeSet<&str> = model
        .joints
        .iter()
        .filter(|joint| joint.film.is_some())
        .map(|joint| model.joint_classes[joint.class].name.as_str())
        .collect();
    let given = scene.joints.values().any(|joint| joint.mortar_thickness() > 0.0);
    let because = if films > 0 {
        let (films, entries) = (count(films, "film"), count(compliances, "compliance"));
        format!("thickness given for {}: {films}, {entries}", names(filled.into_iter()))
    } else if given {
        "no joint belongs to a class with a thickness".to_owned()
    } else {
        "no joint class has a thickness: all joints are dry".to_owned()
    };
    Effect { name: "mortar films", on: films > 0, because, unknowns }
}

/// Each point of a strip at an elastic block has the stiffness of a bar along the joint, and its gap a term
/// by the strain there. Neither is an unknown, but for the forces of the bars in the mixed form.
fn longitudinal_terms(scene: &Scene, model: &Model, route: Route) -> Effect {
    let points = stretching_points(model);
    let has_films = model.joints.iter().any(|joint| joint.film.is_some());
    let because = if points > 0 {
        format!("contact.films = \"strips\": {} along the joints", count(points, "bar"))
    } else if !has_films {
        "there are no mortar films".to_owned()
    } else if scene.contact.films == Films::Compliance {
        "contact.films = \"compliance\": films act across their joints only".to_owned()
    } else {
        "rigid blocks stretch no film".to_owned()
    };
    let mixed = route == Route::Lemke && scene.solver.form == Form::Mixed;
    let unknowns = if mixed { 2 * points } else { 0 };
    Effect { name: "longitudinal film terms", on: points > 0, because, unknowns }
}

fn deformation(scene: &Scene, model: &Model) -> Effect {
    let elastic = model.blocks.iter().filter(|block| block.elasticity.is_some()).count();
    let because = if elastic > 0 {
        let of_walls = scene.walls.iter().map(|wall| wall.material.as_str());
        let used: BTreeSet<&str> =
            of_walls.chain(scene.blocks.iter().map(|block| block.material.as_str())).collect();
        let elastic = |name: &&str| scene.materials.get(*name).is_some_and(|m| m.young.is_some());
        format!("E given for {}", names(used.into_iter().filter(elastic)))
    } else {
        "no material has E: all blocks are rigid".to_owned()
    };
    Effect { name: "deformation", on: elastic > 0, because, unknowns: 2 * nodes(model) }
}

fn self_weight(scene: &Scene, model: &Model) -> Effect {
    let pulls = model.gravity.norm() > 0.0;
    let heavy = model.blocks.iter().any(|block| block.density.is_some());
    let because = match (pulls, heavy) {
        (true, true) => {
            let given = scene.materials.iter().filter(|(_, material)| material.density.is_some());
            format!(
                "gravity, and density given for {}",
                names(given.map(|(name, _)| name.as_str()))
            )
        }
        (true, false) => "no material of a block has a density".to_owned(),
        (false, true) => "the scene gives no gravity".to_owned(),
        (false, false) => "the scene gives neither gravity nor density".to_owned(),
    };
    Effect { name: "self weight", on: pulls && heavy, because, unknowns: 0 }
}

fn edge_loads(scene: &Scene, model: &Model) -> Effect {
    let edges: usize = model.blocks.iter().map(|block| block.edge_loads.len()).sum();
    let because = if edges > 0 {
        let loads = names(scene.loads.iter().map(|load| load.name.as_str()));
        format!("{loads} on {}", count(edges, "edge"))
    } else {
        "the scene gives no loads".to_owned()
    };
    Effect { name: "edge loads", on: edges > 0, because, unknowns: 0 }
}

fn stresses(scene: &Scene, model: &Model) -> Effect {
    let wanted = scene.output.stresses;
    let elements: usize = model.blocks.iter().map(elements).sum();
    let because = match (wanted, elements) {
        (false, _) => "output.stresses = false".to_owned(),
        (true, 0) => "rigid blocks have none".to_owned(),
        (true, elements) => format!("output shows them in {}", count(elements, "element")),
    };
    Effect { name: "stresses", on: wanted && elements > 0, because, unknowns: 0 }
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
